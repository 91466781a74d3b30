/* SPDX-License-Identifier: MIT
 *
 * schedules.csv: whole pictures with and without cones, and in passes of rising resolution (Balint
 * & Valasek 2018, section 4). Scenes are traced in one piece: no culling helps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../bench/frame/frame_picture.h"
#include "../csv.h"
#include "choosing.h"
#include "choosing_times.h"

static const char *const shown[] = {"primitives",  "mandelbulb", "village", "dodecahedron",
                                    "krs_tree_16", "city",       "slabs",   "smooth_union"};
enum { shown_count = sizeof shown / sizeof shown[0] };

/* passes 0: tile by tile. The first is what the others are compared with; the second is the
 * default. */
static const struct {
    const char *name;
    int cones;
    size_t passes;
} schedules[] = {{"rays", 0, 0},     {"cones", 1, 0},    {"passes_1", 1, 1},
                 {"passes_2", 1, 2}, {"passes_4", 1, 4}, {"passes_6", 1, 6}};
enum { schedule_count = sizeof schedules / sizeof schedules[0] };

typedef struct schedule_race {
    frame_picture *picture;
    frame_tracer *tracer[schedule_count];
    void *state[schedule_count];
    size_t state_size[schedule_count];
    bench_hit *image;
} schedule_race;

static void run(void *user, int contender) {
    schedule_race *const race = user;
    const spt_frame *const frame = &race->tracer[contender]->frame;
    const spt_hits sinks = bench_hits_of(race->image);
    if (schedules[contender].passes == 0) {
        frame_expect(spt_frame_trace(frame, 0, race->picture->tiles, &sinks, NULL), "a frame");
        return;
    }
    spt_frame_progress progress = {0, 0, 0, 0, 0};
    void *const state = race->state[contender];
    const size_t size = race->state_size[contender];
    frame_expect(spt_frame_restart(frame, state, size), "a restart");
    while (progress.pass < frame->pass_count) {
        frame_expect(spt_frame_advance(frame, state, size, UINT64_MAX, &sinks, &progress),
                     "a pass");
    }
}

static spt_statistics count(schedule_race *race, int contender) {
    spt_statistics statistics = spt_statistics_default();
    race->tracer[contender]->frame.statistics = &statistics;
    run(race, contender);
    race->tracer[contender]->frame.statistics = NULL;
    return statistics;
}

static void prepare(schedule_race *race, int contender) {
    const frame_way way = {SCENE_WHOLE, schedules[contender].cones, 1};
    race->tracer[contender] = frame_tracer_of(race->picture, &way, "adaptive", 0);
    spt_frame *const frame = &race->tracer[contender]->frame;
    if (schedules[contender].passes == 0) return;
    frame->passes = spt_passes(schedules[contender].passes);
    frame->pass_count = schedules[contender].passes;
    race->state_size[contender] = spt_frame_state_size(frame);
    race->state[contender] = report_allocate(race->state_size[contender]);
}

static uint64_t undecided(const schedule_race *race) {
    uint64_t limits = 0;
    for (size_t i = 0; i < race->picture->count; ++i) {
        limits += race->image[i].outcome == SPT_LIMIT;
    }
    return limits;
}

static int cells(const report_options *options) {
    (void)options;
    return shown_count;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const scene *const at = scene_named(shown[cell]);
    schedule_race race;
    memset(&race, 0, sizeof race);
    race.picture = options->quick ? frame_picture_of(at, 192, 128) : frame_picture_of(at, 512, 320);
    race.image = frame_image_of(race.picture->count);
    for (int i = 0; i < schedule_count; ++i) prepare(&race, i);
    const choosing_times times =
        choosing_race(schedule_count, 0, options->quick ? 5 : 11, run, &race);
    const double pixels = (double)race.picture->count;
    for (int i = 0; i < schedule_count; ++i) {
        const spt_statistics seen = count(&race, i);
        fprintf(rows, "%s,%s,%.9g,%.9g,%.9g,%.9g,%llu\n", schedules[i].name, at->name,
                frame_evaluations(&seen, race.picture), 1e9 * times.seconds[i] / pixels,
                times.ratio[i], times.noise[i], (unsigned long long)undecided(&race));
        frame_tracer_free(race.tracer[i]);
        free(race.state[i]);
    }
    free(race.image);
    frame_picture_free(race.picture);
}

const report_part report_schedules = {
    "schedules", "schedule,scene,evaluations,nanoseconds,ratio,noise,undecided", cells, measure, 1,
    {17, 1.5}};

/* ---- Means ----------------------------------------------------------------------------------- */

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void mean_measure(const report_options *options, int cell, FILE *rows) {
    csv_table *const from = csv_open(options->output, "schedules");
    (void)cell;
    report_expect(csv_rows(from) == shown_count * schedule_count, "schedules.csv is not whole");
    for (int i = 0; i < schedule_count; ++i) {
        double evaluations = 0, nanoseconds = 0, ratio = 0;
        for (int row = i; row < csv_rows(from); row += schedule_count) {
            evaluations += log(csv_number(from, row, "evaluations"));
            nanoseconds += log(csv_number(from, row, "nanoseconds"));
            ratio += log(csv_number(from, row, "ratio"));
        }
        fprintf(rows, "%s,%.9g,%.9g,%.9g\n", schedules[i].name, exp(evaluations / shown_count),
                exp(nanoseconds / shown_count), exp(ratio / shown_count));
    }
    csv_close(from);
}

const report_part report_schedules_mean = {
    "schedules_mean", "schedule,evaluations,nanoseconds,ratio", one_cell, mean_measure, 0,
    {0.1, 0.1}};
