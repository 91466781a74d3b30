/* SPDX-License-Identifier: MIT
 *
 * Basic sphere tracing in double, through the surface and on. */
#include "truth.h"

#include <float.h>
#include <math.h>

enum { MOST_STEPS = 10000 };

static double scene_at(const scene *shown, const spt_ray *ray, double t) {
    double p[3], distance;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    shown->reference(1, &p[0], &p[1], &p[2], &distance);
    return distance;
}

/* A float position is off by at most 2.5 u of the magnitudes that go into it, u = 2^-24, and so is
 * f of an exact field; 8 u leaves room for the rounding inside the callback. What penetrates less
 * may be seen or not. */
static double resolution(const spt_ray *ray, double t) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) reach = fmax(reach, fabs((double)ray->origin[axis]));
    return 8 * 0x1p-24 * (reach + t);
}

/* Where a ray enters a ball, by its quadratic in double; t_min where it does not. */
static double ball_entry(const spt_bound *ball, const spt_ray *ray) {
    double square = 0, along = 0, apart = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double ahead = (double)ray->direction[axis];
        const double to = (double)ball->center[axis] - (double)ray->origin[axis];
        square += ahead * ahead;
        along += to * ahead;
        apart += to * to;
    }
    const double outside = apart - (double)ball->radius * (double)ball->radius;
    const double room = along * along - square * outside;
    if (!(room > 0)) return (double)ray->t_min;
    return fmax((along - sqrt(room)) / square, (double)ray->t_min);
}

/* A field that is no distance bound has no truth but what basic tracing meets from where its ball
 * is entered, which is where every tracer samples it first. Others are walked from t_min. */
static double start_of(const scene *shown, const spt_ray *ray) {
    const int ball = shown->bound != NULL && shown->bound->kind == SPT_BOUND_SPHERE;
    return ball ? ball_entry(shown->bound, ray) : (double)ray->t_min;
}

double truth_last_t(const scene *shown, const spt_settings *settings, const spt_ray *ray) {
    double t = start_of(shown, ray);
    int entered = 0;
    for (int i = 0; i < MOST_STEPS && t <= (double)ray->t_max; ++i) {
        const double noise = resolution(ray, t);
        const double f = scene_at(shown, ray, t) / (double)shown->lipschitz;
        const double tolerance =
            fmax((double)settings->epsilon, (double)settings->pixel_radius * t);
        if (f < -(tolerance + noise)) return t;
        if (entered && f > noise) return t;
        entered |= f < -noise;
        /* |f| is a safe step on both sides; a quarter of what counts leads over the zero. */
        t += fmax(fabs(f), noise / 4);
    }
    return HUGE_VAL;
}

int truth_lost(double last_t, const bench_hit *hit) {
    return last_t <= DBL_MAX && hit->outcome != SPT_LIMIT && hit->outcome != SPT_HIT;
}

int truth_late(double last_t, const bench_hit *hit) {
    return hit->outcome == SPT_HIT && (double)hit->t > last_t;
}
