/* SPDX-License-Identifier: MIT
 *
 * The library's ways through the same rays: as rays alone, as a frame with cones, and in passes of
 * rising resolution. Scenes are traced in one piece, so that an evaluation is one everywhere. */
#include "error_runs.h"

#include <stdlib.h>
#include <string.h>

typedef struct error_way {
    const char *schedule;
    size_t passes; /* 0: not in passes */
    int frame;
} error_way;

/* passes_N: spt_passes(N), the schedules of Bálint & Valasek 2018, section 5. Their tiles walk
 * cones of 16x16 and 4x4 pixels in the first pass, as those of a frame do. */
static const error_way ways[] = {{"direct", 0, 0},   {"frame", 0, 1},    {"passes_1", 1, 1},
                                 {"passes_2", 2, 1}, {"passes_4", 4, 1}, {"passes_6", 6, 1}};

/* What a runner of ours has. */
typedef struct error_own {
    spt_field field;
    spt_settings settings;
    frame_tracer *tracer;
    void *state;
    size_t state_size;
} error_own;

/* Every result, or what a picture needs. */
static spt_hits sinks_of(spt_hit *hits, int all) {
    spt_hits sinks = spt_hits_of(hits);
    if (all) return sinks;
    sinks.flags.first = sinks.component.first = sinks.fallbacks.first = NULL;
    sinks.candidate_t.first = sinks.candidate_ratio.first = NULL;
    return sinks;
}

static double run_direct(error_runner *runner, const error_scene *in, int all) {
    const error_own *const own = runner->own;
    const spt_rays rays = spt_rays_of(in->picture->rays);
    const spt_hits sinks = sinks_of(in->hits, all);
    const double before = bench_seconds();
    const spt_status status =
        spt_trace(&own->field, &own->settings, in->count, &rays, &sinks, NULL);
    const double seconds = bench_seconds() - before;
    frame_expect(status, "spt_trace");
    return seconds;
}

static double run_frame(error_runner *runner, const error_scene *in, int all) {
    const error_own *const own = runner->own;
    const spt_hits sinks = sinks_of(in->hits, all);
    spt_frame *const frame = &own->tracer->frame;
    spt_statistics statistics = spt_statistics_default();
    frame->statistics = all ? &statistics : NULL;
    const double before = bench_seconds();
    const spt_status status = spt_frame_trace(frame, 0, in->picture->tiles, &sinks, NULL);
    const double seconds = bench_seconds() - before;
    frame_expect(status, "spt_frame_trace");
    if (all) runner->cones = (double)statistics.cone_evaluations / (double)in->count;
    return seconds;
}

static double run_passes(error_runner *runner, const error_scene *in, int all) {
    const error_own *const own = runner->own;
    const spt_hits sinks = sinks_of(in->hits, all);
    spt_frame *const frame = &own->tracer->frame;
    spt_statistics statistics = spt_statistics_default();
    spt_frame_progress progress;
    frame->statistics = all ? &statistics : NULL;
    const double before = bench_seconds();
    spt_status status = spt_frame_restart(frame, own->state, own->state_size);
    if (status == SPT_OK) {
        status =
            spt_frame_advance(frame, own->state, own->state_size, UINT64_MAX, &sinks, &progress);
    }
    const double seconds = bench_seconds() - before;
    frame_expect(status, "spt_frame_advance");
    report_expect(progress.pass == frame->pass_count, "the passes did not end");
    if (all) {
        uint64_t last = 0;
        for (size_t i = 0; i < in->count; ++i) last += in->hits[i].evaluations;
        report_expect(progress.evaluations == statistics.evaluations + statistics.cone_evaluations,
                      "progress and statistics count differently");
        runner->cones = (double)statistics.cone_evaluations / (double)in->count;
        report_expect(statistics.evaluations == last, "coarse passes traced rays that nobody sees");
    }
    return seconds;
}

static void close_own(error_runner *runner) {
    error_own *const own = runner->own;
    if (own->tracer != NULL) frame_tracer_free(own->tracer);
    free(own->state);
    free(own);
}

static void open_frame(error_own *own, const error_scene *in, const error_way *way,
                       const char *rule, uint32_t budget) {
    static const frame_way whole = {SCENE_WHOLE, 1, 1};
    own->tracer = frame_tracer_of(in->picture, &whole, rule, 0);
    spt_frame *const frame = &own->tracer->frame;
    const spt_method *const method = frame->settings.method;
    frame->settings = in->settings;
    frame->settings.method = method;
    frame->settings.budget = budget;
    if (way->passes == 0) return;
    frame->passes = spt_passes(way->passes);
    frame->pass_count = way->passes;
    own->state_size = spt_frame_state_size(frame);
    own->state = report_allocate(own->state_size);
}

static error_runner open_own(const error_scene *in, const error_way *way, const char *rule,
                             uint32_t budget) {
    error_own *const own = report_allocate(sizeof *own);
    error_runner runner = {rule, spt_lanes(), budget, in->identity, 0, NULL, close_own, way, own};
    runner.run = !way->frame ? run_direct : way->passes == 0 ? run_frame : run_passes;
    own->field = scene_field(in->shown, spt_lanes());
    own->settings = in->settings;
    own->settings.method = bench_method(rule);
    own->settings.budget = budget;
    if (way->frame) {
        runner.place = in->picture->pixel;
        open_frame(own, in, way, rule, budget);
    }
    return runner;
}

int error_ours(error_runner *runners, const error_scene *in, const char *schedule,
               uint32_t budget) {
    int count = 0;
    size_t way = 0;
    while (strcmp(ways[way].schedule, schedule) != 0) ++way;
    for (int rule = 0; rule < report_rules; ++rule) {
        const int licensed = (in->shown->flags & SPT_FIELD_CONVEX) != 0;
        if (bench_method(report_rule[rule]) == spt_convex() && !licensed) continue;
        runners[count++] = open_own(in, &ways[way], report_rule[rule], budget);
    }
    return count;
}
