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

/* Where the library starts, so that a field that is no distance bound is sampled alike. */
static double start_of(const scene *shown, const spt_ray *ray) {
    float entry = ray->t_min, leaving = ray->t_max;
    if (shown->bound != NULL) {
        spt_bound_interval(shown->bound, ray->origin, ray->direction, ray->t_min, ray->t_max,
                           &entry, &leaving);
    }
    return (double)entry;
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
