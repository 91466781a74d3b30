/* SPDX-License-Identifier: MIT
 *
 * Basic tracing in double, through the surface and on. */
#include "frame_truth.h"
#include "tolerance.h"

#include <math.h>

enum { truth_steps = 10000 };

/* A zero of f: far below every tolerance, far above what double resolves. */
static const double zero = 1e-9;
/* The length behind a surface after which a ray is through it even where f is no distance bound, and
 * the least step there once the depth that matters is found or will not be. */
static const double thickness = 0.05, stride = 5e-4;
enum { patient_steps = 2000 };

static double scene_distance(const void *user, const double position[3]) {
    const scene *shown = user;
    double f;
    shown->reference(1, &position[0], &position[1], &position[2], &f);
    return f / (double)shown->lipschitz;
}

truth_field truth_of_scene(const scene *shown) {
    truth_field field = {scene_distance, NULL};
    field.user = shown;
    return field;
}

static double value_at(const truth_field *field, const spt_ray *ray, double t) {
    double p[3];
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    return field->distance(field->user, p);
}

/* The law of trace.h with the path: the pixel cone counts it, the floor does not. */
static double tolerance_at(const spt_settings *settings, const spt_ray *ray, double path,
                           double t) {
    return fmax(oracle_tolerance(settings, ray, t),
                (double)settings->pixel_radius * (path + t * oracle_length(ray)));
}

/* On the way from a surface to the depth that counts as inside a step must not pass it by more than
 * a part of it. */
static double least_step(const ray_truth *truth, int steps, double rounding) {
    return truth->deep < HUGE_VAL || steps > patient_steps ? stride : rounding / 4;
}

/* A float position is off by at most 2.5 u of |origin| + t + size, u = 2^-24, and f of a field
 * computed in float by a few u of the coordinates more: two floors are 8 u. */
ray_truth truth_walk(const truth_field *field, const spt_settings *settings, const spt_ray *ray,
                     double path) {
    ray_truth truth = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const double length = oracle_length(ray), last = (double)ray->t_max;
    double t = (double)ray->t_min, behind = 0, before = 0, step = HUGE_VAL, side = 0;
    int bound = 1;
    for (int i = 0; i < truth_steps && t <= last; ++i) {
        const double raw = value_at(field, ray, t);
        const double rounding = 2 * oracle_floor(settings, ray, t);
        const double tolerance = tolerance_at(settings, ray, path, t);
        double f;
        if (i == 0) side = raw < 0 ? -1 : 1;
        f = side * raw;
        if (fabs(f - before) > 1.001 * step + zero) bound = 0;
        if (f < zero && !(truth.zero < HUGE_VAL)) truth.zero = t;
        if (f < -rounding && !(truth.deep < HUGE_VAL)) truth.deep = t;
        if (!(truth.zero < HUGE_VAL)) truth.clearance = fmin(truth.clearance, f / tolerance);
        if (f >= zero) behind = 0;
        if ((bound && f < -(tolerance + rounding)) || behind > thickness) {
            truth.through = t;
            break;
        }
        step = f >= zero ? f : fmax(fabs(f), least_step(&truth, i, rounding));
        if (f < zero) behind += step;
        before = f;
        t += step / length;
    }
    return truth;
}

int truth_judge(const truth_field *field, const spt_settings *settings, const spt_ray *ray,
                double path, const ray_truth *truth, const spt_hit *hit) {
    const double t = (double)hit->t;
    const int steep = (hit->flags & SPT_FLAG_STEEP) != 0;
    if (hit->outcome == SPT_MISS) return truth->through < HUGE_VAL ? TRUTH_LOST : TRUTH_AGREES;
    if (hit->outcome == SPT_LIMIT) return t > truth->deep ? TRUTH_LATE : TRUTH_AGREES;
    if (hit->outcome != SPT_HIT) return TRUTH_FALSE;
    if (steep) return TRUTH_AGREES; /* "not certainly the first" */
    if (t > truth->through) return TRUTH_LATE;
    if (fabs(value_at(field, ray, t)) >
        tolerance_at(settings, ray, path, t) + 2 * oracle_floor(settings, ray, t)) {
        return TRUTH_FALSE;
    }
    return TRUTH_AGREES;
}

void truth_count(truth_sum *sum, const ray_truth *truth, const spt_hit *hit, int judgement) {
    const int due = truth->through < HUGE_VAL;
    ++sum->rays;
    sum->due += (uint64_t)due;
    sum->found += (uint64_t)(due && hit->outcome == SPT_HIT);
    sum->undecided += (uint64_t)(hit->outcome == SPT_LIMIT);
    sum->lost += (uint64_t)(judgement == TRUTH_LOST);
    sum->late += (uint64_t)(judgement == TRUTH_LATE);
    sum->false_hits += (uint64_t)(judgement == TRUTH_FALSE);
}
