/* SPDX-License-Identifier: MIT
 *
 * Truth and totals of scene images. */
#include "survey.h"
#include "tolerance.h"

#include <math.h>

enum { truth_steps = 10000 };

/* A zero of f: far below every tolerance, far above what double resolves. */
static const double zero = 1e-9;
/* Least step behind a surface, and the length there after which a ray is through it even where f is
 * no distance bound, so that its depth says nothing. */
static const double stride = 5e-4, thickness = 0.05;

/* f over lipschitz at t. */
static double scene_value(const scene *shown, const spt_ray *ray, double t) {
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    shown->reference(1, &p[0], &p[1], &p[2], &f);
    return f / (double)shown->lipschitz;
}

static survey_truth find_truth(const scene *shown, const spt_settings *settings,
                               const spt_ray *ray) {
    survey_truth truth = {HUGE_VAL, HUGE_VAL};
    const double length = oracle_length(ray);
    double t = (double)ray->t_min, behind = 0, before = 0, step = HUGE_VAL;
    int bound = 1;
    for (int i = 0; i < truth_steps && t <= (double)ray->t_max; ++i) {
        const double f = scene_value(shown, ray, t);
        const double depth =
            oracle_tolerance(settings, ray, t) + 2 * oracle_floor(settings, ray, t);
        if (fabs(f - before) > 1.001 * step + zero) bound = 0;
        if (f < zero && !(truth.t < HUGE_VAL)) truth.t = t;
        if (f >= zero) behind = 0;
        if ((bound && f < -depth) || behind > thickness) {
            truth.through = t;
            break;
        }
        step = f >= zero ? f : fmax(fabs(f), stride);
        if (f < zero) behind += step;
        before = f;
        t += step / length;
    }
    return truth;
}

void survey_find_truth(const scene *shown, const spt_settings *settings, size_t count,
                       const spt_ray *rays, survey_truth *truth) {
    for (size_t i = 0; i < count; ++i) truth[i] = find_truth(shown, settings, &rays[i]);
}

static void judge(survey *sum, const spt_hit *hit, const survey_truth *truth) {
    const int steep = (hit->flags & SPT_FLAG_STEEP) != 0;
    if (!(truth->through < HUGE_VAL) || hit->outcome == SPT_LIMIT) return;
    if (hit->outcome != SPT_HIT || ((double)hit->t > truth->through && !steep)) ++sum->lost;
    if (hit->outcome == SPT_HIT && (double)hit->t > truth->through && steep) ++sum->doubtful;
}

survey survey_trace(const scene *shown, const spt_settings *settings, size_t count,
                    const spt_ray *rays, const survey_truth *truth, spt_hit *hits) {
    survey sum = {0, 0, 0, 0, 0, 0, {0, 0, 0, 0, 0}};
    const spt_field field = scene_field(shown, spt_lanes());
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    if (spt_trace(&field, settings, count, &from, &to, NULL) != SPT_OK) return sum;
    for (size_t i = 0; i < count; ++i) {
        ++sum.rays;
        sum.evaluations += hits[i].evaluations;
        sum.fallbacks += hits[i].fallbacks;
        sum.steep += (hits[i].flags & SPT_FLAG_STEEP) != 0;
        if (hits[i].outcome >= 0 && hits[i].outcome < SPT_OUTCOMES) {
            ++sum.outcomes[hits[i].outcome];
        }
        if (truth != NULL) judge(&sum, &hits[i], &truth[i]);
    }
    return sum;
}

double survey_mean(const survey *sum) {
    return (double)sum->evaluations / (double)sum->rays;
}
