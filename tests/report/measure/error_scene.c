/* SPDX-License-Identifier: MIT
 *
 * A scene with the rays that errors are measured over, and the judgement of a run on them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../oracle/tolerance.h"
#include "error_runs.h"

/* The stop of all runs, absolute: a few times what float positions resolve in the ten kinds, so
 * that neither rounding nor a pixel's size hides what a budget leaves. Where the floor of trace.h
 * is larger, in the deeper scenes, that is the stop. */
static const float stop = 1e-5f;

const uint32_t error_budgets[error_budget_count] = {8,  12, 16,  24,  32,  48,
                                                    64, 96, 128, 192, 256, 512};

/* Every second one, and 512 in the place of 256. */
int error_budget_wanted(const report_options *options, uint32_t budget) {
    return !options->quick || budget == 512 || (budget != 256 && (budget & (budget - 1)) == 0);
}

/* The largest coordinate of a bounding volume: of what the library makes its rounding floor. */
static float size_of(const spt_bound *bound) {
    float size = 0;
    if (bound == NULL) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        size = fmaxf(size, bound->kind == SPT_BOUND_SPHERE
                               ? fabsf(bound->center[axis]) + bound->radius
                               : fmaxf(fabsf(bound->low[axis]), fabsf(bound->high[axis])));
    }
    return size;
}

error_scene *error_scene_of(const report_options *options, const char *name) {
    error_scene *const in = report_allocate(sizeof *in);
    in->shown = scene_named(name);
    report_expect(in->shown != NULL, "a scene of the report is not there");
    in->picture = options->quick ? frame_picture_of(in->shown, 96, 72)
                                 : frame_picture_of(in->shown, 160, 120);
    in->count = in->picture->count;
    in->bound = strcmp(name, "mandelbulb") != 0; /* the only one that estimates */
    in->settings = spt_settings_default();
    in->settings.epsilon = stop;
    in->settings.pixel_radius = 0;
    in->settings.size = size_of(in->shown->bound);
    in->truth = report_allocate(in->count * sizeof *in->truth);
    in->identity = report_allocate(in->count * sizeof *in->identity);
    in->hits = report_allocate(in->count * sizeof *in->hits);
    for (size_t i = 0; i < in->count; ++i) {
        in->truth[i] = error_truth_of(in->shown, &in->settings, &in->picture->rays[i]);
        in->identity[i] = i;
    }
    return in;
}

void error_scene_free(error_scene *in) {
    frame_picture_free(in->picture);
    free(in->truth);
    free(in->identity);
    free(in->hits);
    free(in);
}

/* ---- Judgement ------------------------------------------------------------------------------ */

/* How far a result says the surface is: a ray that ran out of budget as far as it came, as in the
 * paper; one that says it hits nothing, or nothing sensible, as far as its end. */
static double distance_of(const spt_hit *hit, const spt_ray *ray) {
    const int reached = hit->outcome == SPT_HIT || hit->outcome == SPT_LIMIT;
    return reached ? (double)hit->t : (double)ray->t_max;
}

error_score error_judge(const error_scene *in, const error_runner *runner) {
    error_score score = {0, 0, 0, 0, 0, (double)NAN, 0, (double)NAN, (double)NAN, 0};
    double squares = 0, squares_both = 0;
    size_t clear = 0, both = 0, either = 0;
    for (size_t i = 0; i < in->count; ++i) {
        const error_truth *const truth = &in->truth[i];
        const spt_hit *const hit = &in->hits[runner->place[i]];
        const int hits = hit->outcome == SPT_HIT, surface = truth->t < HUGE_VAL;
        const int due = truth->through < HUGE_VAL;
        score.evaluations += (double)hit->evaluations;
        score.undecided += hit->outcome == SPT_LIMIT;
        score.lost += due && !hits && hit->outcome != SPT_LIMIT;
        score.late += due && hits && (double)hit->t > truth->through;
        score.ghosts += hits && error_clear_miss(truth);
        both += hits && surface;
        either += hits || surface;
        if (!error_clear_hit(truth)) continue;
        const double error = fabs(distance_of(hit, &in->picture->rays[i]) - truth->t);
        ++score.truth_hits;
        squares += error * error;
        score.maximum = fmax(score.maximum, error);
        if (!hits) continue;
        ++clear;
        squares_both += error * error;
    }
    if (score.truth_hits > 0) score.rms = sqrt(squares / (double)score.truth_hits);
    if (clear > 0) score.rms_both = sqrt(squares_both / (double)clear);
    if (either > 0) score.iou = (double)both / (double)either;
    score.evaluations = score.evaluations / (double)in->count + runner->cones;
    return score;
}

void error_check_promises(const error_scene *in, const error_runner *runner) {
    for (size_t i = 0; i < in->count; ++i) {
        const spt_ray *const ray = &in->picture->rays[i];
        const spt_hit *const hit = &in->hits[runner->place[i]];
        const int hits = hit->outcome == SPT_HIT;
        report_expect(hits || hit->outcome == SPT_MISS || hit->outcome == SPT_LIMIT,
                      "a finite field and a good ray had another end than hit, miss or limit");
        report_expect(!isnan(hit->t) && !isnan(hit->residual) && !isnan(hit->candidate_t) &&
                          !isnan(hit->candidate_ratio),
                      "a result is NaN");
        report_expect(hit->evaluations <= runner->budget, "a ray took more than its budget");
        /* Beyond its tolerance a hit may be where f jumps or is no distance bound, and says so. */
        if (!hits || (!in->bound && (hit->flags & SPT_FLAG_STEEP) != 0)) continue;
        /* Eight roundings of 2^-24 lie between the library's comparison in float and this one. */
        const double tolerance = oracle_tolerance(&in->settings, ray, (double)hit->t);
        const double radius = fabs((double)hit->residual) / (double)in->shown->lipschitz;
        report_expect(radius < tolerance * (1 + 0x1p-21), "a hit is beyond its tolerance");
    }
}
