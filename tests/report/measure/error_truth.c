/* SPDX-License-Identifier: MIT
 *
 * The truth that errors are measured against: basic tracing in double with 10 000 steps (Bálint &
 * Valasek 2018, section 5), through the surface and on until it is clear that it is one. */
#include <math.h>

#include "../../oracle/tolerance.h"
#include "error_runs.h"

enum { most_steps = 10000 };

/* A zero of f: far below every stop, far above what double resolves. */
static const double zero = 1e-9;
/* Least step behind a surface, and the length there after which a ray is through it even where f is
 * no distance bound, so that its depth says nothing (as in tests/oracle/survey.c). */
static const double stride = 5e-4, thickness = 0.05;
/* In stops. A sample within three of a surface may count as a hit, by one stop and what rounding
 * makes of f, at most two of them; above six no point between two samples is within three, since
 * along a ray f falls to no less than half of it before the next. */
static const double near_by = 3, clear_of = 6;

/* Where a ray of direction length 1 enters a ball; where it starts if it misses it. */
static double ball_entry(const spt_bound *ball, const spt_ray *ray) {
    double along = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double to = (double)ball->center[axis] - (double)ray->origin[axis];
        along += to * (double)ray->direction[axis];
        square += to * to;
    }
    const double room = (double)ball->radius * (double)ball->radius - (square - along * along);
    return room > 0 ? fmax(along - sqrt(room), (double)ray->t_min) : (double)ray->t_min;
}

/* A field that is no distance bound has no truth but what basic tracing meets, from where the
 * library samples it first, which is its ball. The others are walked from the eye. */
static double start_of(const scene *shown, const spt_ray *ray) {
    const int ball = shown->bound != NULL && shown->bound->kind == SPT_BOUND_SPHERE;
    return ball ? ball_entry(shown->bound, ray) : (double)ray->t_min;
}

static double value_at(const scene *shown, const spt_ray *ray, double t) {
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    shown->reference(1, &p[0], &p[1], &p[2], &f);
    return f / (double)shown->lipschitz;
}

error_truth error_truth_of(const scene *shown, const spt_settings *settings, const spt_ray *ray) {
    error_truth truth = {HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
    double t = start_of(shown, ray), before = 0, behind = 0, step = HUGE_VAL;
    int bound = 1;
    for (int i = 0; i < most_steps && t <= (double)ray->t_max; ++i) {
        const double f = value_at(shown, ray, t);
        const double stop = oracle_tolerance(settings, ray, t);
        const double depth = stop + 2 * oracle_floor(settings, ray, t);
        const int entered = truth.t < HUGE_VAL;
        if (fabs(f - before) > 1.001 * step + zero) bound = 0;
        if (f < zero && !entered) truth.t = t;
        if (f >= zero) {
            truth.grazed |=
                (entered && bound) || (truth.clearance < near_by && f > clear_of * stop);
            truth.clearance = entered ? truth.clearance : fmin(truth.clearance, f / stop);
            behind = 0;
        }
        if ((bound && f < -depth) || behind > thickness) {
            truth.through = t;
            break;
        }
        step = f >= zero ? f : fmax(fabs(f), stride);
        if (f < zero) behind += step;
        before = f;
        t += step;
    }
    return truth;
}

int error_clear_hit(const error_truth *truth) {
    return truth->through < HUGE_VAL && !truth->grazed;
}

int error_clear_miss(const error_truth *truth) {
    return !(truth->t < HUGE_VAL) && truth->clearance > clear_of;
}
