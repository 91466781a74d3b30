/* SPDX-License-Identifier: MIT
 *
 * The ways to cast rays, and what their hits are worth. */
#include "keinert_cast.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <oracle/listings.h>

#include "keinert_depth.h"

enum { BUDGET = 80 }; /* evaluations a ray, as in the paper */

/* ---- Casting ------------------------------------------------------------------------------- */

static int is_listing(const cast_rule *rule) {
    return rule->kind == CAST_LISTING_1 || rule->kind == CAST_LISTING_2;
}

static spt_settings settings_of(const cast_runner *runner, int lanes) {
    spt_settings settings =
        bench_settings(runner->rule->method, runner->track->picture->pixel_radius, lanes);
    settings.budget = BUDGET;
    settings.relaxation = runner->rule->relaxation;
    return settings;
}

void cast_enter(cast_runner *runner, const cast_rule *rule, const cast_track *track) {
    static const frame_way cones = {SCENE_WHOLE, 1, 1};
    runner->rule = rule;
    runner->track = track;
    runner->tracer = NULL;
    runner->depth = keinert_allocate(track->picture->count * sizeof *runner->depth);
    if (rule->kind != CAST_FRAME) return;
    runner->tracer = frame_tracer_of(track->picture, &cones, rule->method, 0);
    runner->tracer->frame.settings.budget = BUDGET;
}

void cast_leave(cast_runner *runner) {
    if (runner->tracer != NULL) frame_tracer_free(runner->tracer);
    free(runner->depth);
}

static void cast_library(const cast_runner *runner, size_t begin, size_t count, int lanes,
                         bench_hit *hits) {
    const int scalar = runner->rule->kind == CAST_SCALAR;
    const spt_field field = scene_field(&runner->track->shown, scalar ? 1 : lanes);
    const spt_settings settings = settings_of(runner, lanes);
    const spt_rays rays = spt_rays_of(runner->track->picture->rays + begin);
    const spt_hits sinks = bench_hits_of(hits);
    keinert_expect(spt_trace(&field, &settings, count, &rays, &sinks, NULL), "spt_trace");
}

/* A listing is handed where the ray is in the field's bound, as the library finds out by itself. It
 * gives no outcome: without a hit the evaluations tell whether the ray came to an end. */
static void cast_listing(const cast_runner *runner, size_t begin, size_t count, bench_hit *hits) {
    const scene *const shown = &runner->track->shown;
    const spt_settings settings = settings_of(runner, 1);
    listing in;
    memset(&in, 0, sizeof in);
    in.distance = shown->point;
    in.max_iterations = BUDGET;
    for (size_t i = 0; i < count; ++i) {
        const spt_ray *const ray = &runner->track->picture->rays[begin + i];
        float t_min = ray->t_min, t_max = ray->t_max, t = INFINITY;
        if (shown->bound != NULL) {
            spt_bound_interval(shown->bound, ray->origin, ray->direction, ray->t_min, ray->t_max,
                               &t_min, &t_max);
        }
        in.evaluations = 0;
        if (t_min <= t_max) {
            memcpy(in.origin, ray->origin, sizeof in.origin);
            memcpy(in.direction, ray->direction, sizeof in.direction);
            t = runner->rule->kind == CAST_LISTING_1
                    ? keinert_listing_1(&in, t_min, t_max, settings.epsilon)
                    : keinert_listing_2(&in, t_min, t_max, settings.relaxation,
                                        settings.pixel_radius, 0);
        }
        hits[i].t = t;
        hits[i].residual = 0.0f;
        hits[i].outcome = t <= FLT_MAX ? SPT_HIT : in.evaluations >= BUDGET ? SPT_LIMIT : SPT_MISS;
        hits[i].evaluations = in.evaluations;
    }
}

void cast_slice(const cast_runner *runner, frame_slice slice) {
    const cast_track *const track = runner->track;
    const size_t begin = track->picture->first[slice.begin];
    const size_t count = frame_slice_rays(track->picture, slice);
    if (runner->tracer != NULL) {
        frame_tracer_run(runner->tracer, track->picture, slice, track->image);
    } else if (is_listing(runner->rule)) {
        cast_listing(runner, begin, count, track->hits + begin);
    } else {
        cast_library(runner, begin, count, spt_lanes(), track->hits + begin);
    }
}

/* ---- What the hits are worth --------------------------------------------------------------- */

static void cast_picture(const cast_runner *runner) {
    const cast_track *const track = runner->track;
    const frame_slice whole = {0, track->picture->tiles};
    cast_slice(runner, whole);
    for (size_t i = 0; i < track->picture->count && runner->tracer != NULL; ++i) {
        track->hits[i] = track->image[track->picture->pixel[i]];
    }
}

void cast_judge(cast_runner *runner, keinert_row *row) {
    const cast_track *const track = runner->track;
    const spt_settings settings = settings_of(runner, 1);
    cast_picture(runner);
    row->rays = (double)track->picture->count;
    row->evaluations = row->lost = row->late = row->passed = row->undecided = 0;
    for (size_t i = 0; i < track->picture->count; ++i) {
        const bench_hit *const hit = &track->hits[i];
        const spt_ray *const ray = &track->picture->rays[i];
        const int late = truth_late(track->last_t[i], hit);
        row->evaluations += (double)hit->evaluations;
        row->undecided += hit->outcome == SPT_LIMIT;
        row->lost += truth_lost(track->last_t[i], hit);
        row->late += late;
        runner->depth[i] = NAN;
        if (hit->outcome != SPT_HIT || late) continue;
        runner->depth[i] =
            (float)keinert_depth(&track->shown, &settings, ray, 0.0f, 1.0, (double)hit->t);
        row->passed += isnan(runner->depth[i]);
    }
    if (runner->tracer == NULL) return;
    const spt_statistics counted = frame_tracer_count(runner->tracer, track->picture);
    row->evaluations = (double)(counted.evaluations + counted.cone_evaluations);
}

size_t cast_count_different(const cast_runner *runner) {
    enum { SLICE = 65536 };
    static bench_hit one_lane[SLICE];
    const cast_track *const track = runner->track;
    size_t different = 0;
    if (runner->rule->kind != CAST_TRACE) return 0;
    for (size_t begin = 0; begin < track->picture->count; begin += SLICE) {
        const size_t left = track->picture->count - begin, count = left < SLICE ? left : SLICE;
        cast_library(runner, begin, count, 1, one_lane);
        for (size_t i = 0; i < count; ++i) {
            different += memcmp(&one_lane[i], &track->hits[begin + i], sizeof one_lane[i]) != 0;
        }
    }
    return different;
}
