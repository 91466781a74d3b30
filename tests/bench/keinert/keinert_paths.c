/* SPDX-License-Identifier: MIT
 *
 * Path tracing, ten bounces and one sample a pixel: a still life in a room as a union of bodies,
 * and a scene in the open as one field. Processor time of the whole, and of the library's tracing
 * calls alone. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <path_room.h>
#include <path_wave.h>

#include "keinert_bench.h"

/* A way to trace paths; NULL: the default, adaptive, and convex where a field allows it. */
typedef struct path_way {
    const char *name;
    const spt_method *(*method)(void);
    float relaxation;
    int judged;
} path_way;

static const path_way ways[] = {
    {"basic", spt_basic, 1.2f, 0},
    {"relaxed 1.2", spt_relaxed, 1.2f, 0},
    {"relaxed 1.4 (the paper's)", spt_relaxed, 1.4f, 0},
    {"adaptive (default rule)", spt_adaptive, 1.2f, 1},
    {"default, with licences", NULL, 1.2f, 1},
};
enum { WAYS = sizeof ways / sizeof ways[0], REFERENCE = WAYS, REFERENCE_STEP = 4 };

typedef struct path_runner {
    const bench_options *options;
    path_job job;
    path_wave *wave;
    size_t tiles;
    size_t stride;  /* tiles follow one another this far apart, so that rounds are alike */
    float *pixels;  /* of all tiles, or NULL */
    double tracing; /* seconds in the library's calls, of this round */
    double traced[BENCH_MOST_ROUNDS];
} path_runner;

static size_t tiles_across(const path_runner *runner) {
    return ((size_t)runner->options->width + PATH_TILE - 1) / PATH_TILE;
}

static size_t common_divisor(size_t a, size_t b) {
    return b == 0 ? a : common_divisor(b, a % b);
}

/* The tile at a place of the order, left, top, right, bottom. */
static void area_of(const path_runner *runner, size_t place, uint32_t area[4]) {
    const size_t across = tiles_across(runner), tile = place * runner->stride % runner->tiles;
    const uint32_t width = (uint32_t)runner->options->width;
    const uint32_t height = (uint32_t)runner->options->height;
    area[0] = (uint32_t)(tile % across) * PATH_TILE;
    area[1] = (uint32_t)(tile / across) * PATH_TILE;
    area[2] = area[0] + PATH_TILE < width ? area[0] + PATH_TILE : width;
    area[3] = area[1] + PATH_TILE < height ? area[1] + PATH_TILE : height;
}

static double tracing_seconds(const path_wave *wave) {
    double sum = 0;
    for (int kind = 0; kind < path_rays; ++kind) sum += wave->statistics.seconds[kind];
    return sum;
}

static void trace_tile(path_runner *runner, size_t place) {
    path_wave *const wave = runner->wave;
    uint32_t area[4];
    area_of(runner, place, area);
    path_wave_begin(wave, area, 0);
    while (path_wave_step(wave)) {
    }
    keinert_expect(wave->status, "a wave of paths");
    memcpy(runner->pixels + place * PATH_WAVE * 3, wave->light, sizeof wave->light);
}

static double run(void *user, int round) {
    path_runner *const runner = user;
    const keinert_part part = keinert_part_of(runner->tiles, round, runner->options->rounds);
    const double before = bench_seconds(), tracing = tracing_seconds(runner->wave);
    for (size_t i = 0; i < part.count; ++i) trace_tile(runner, part.begin + i);
    runner->traced[round] = tracing_seconds(runner->wave) - tracing;
    return bench_seconds() - before;
}

static void enter(path_runner *runner, const bench_options *options, const path_stage *stage,
                  const path_way *way) {
    path_settings settings = path_settings_default();
    memset(runner, 0, sizeof *runner);
    runner->options = options;
    settings.method = way->method != NULL ? way->method() : NULL;
    if (!path_job_create(&runner->job, &stage->world, &settings, options->width, options->height)) {
        keinert_expect(SPT_BAD_ARGUMENT, "path_job_create");
    }
    runner->job.primary.relaxation = runner->job.scattered.relaxation = way->relaxation;
    runner->wave = path_wave_create(&runner->job);
    if (runner->wave == NULL) keinert_expect(SPT_BAD_ARGUMENT, "path_wave_create");
    runner->tiles = tiles_across(runner) * (((size_t)options->height + PATH_TILE - 1) / PATH_TILE);
    runner->stride = (size_t)(0.618033988749895 * (double)runner->tiles);
    while (common_divisor(runner->tiles, runner->stride) != 1) ++runner->stride;
    runner->pixels = keinert_allocate(runner->tiles * sizeof runner->wave->light);
}

static void leave(path_runner *runner) {
    path_wave_free(runner->wave);
    path_job_free(&runner->job);
    free(runner->pixels);
}

/* The same paths by basic steps without end, a tolerance near what float resolves, and no pixel
 * cone; some of the tiles. */
static void trace_reference(path_runner *runner) {
    spt_settings *const both[] = {&runner->job.primary, &runner->job.scattered};
    for (int i = 0; i < 2; ++i) {
        both[i]->epsilon = 1e-5f;
        both[i]->pixel_radius = 0.0f;
        both[i]->budget = 100000;
    }
    for (size_t place = 0; place < runner->tiles; place += REFERENCE_STEP) {
        trace_tile(runner, place);
    }
}

/* A path that meets an edge on one side of it and not on the other goes on elsewhere, so this is
 * seldom small for a pixel; its mean tells whether one rule does so more often than another. */
static double mean_difference(const path_runner *a, const path_runner *b) {
    double sum = 0, number = 0;
    for (size_t place = 0; place < a->tiles; place += REFERENCE_STEP) {
        const size_t first = place * PATH_WAVE * 3;
        uint32_t area[4];
        area_of(a, place, area);
        const size_t pixels = (size_t)(area[2] - area[0]) * (area[3] - area[1]);
        for (size_t i = first; i < first + 3 * pixels; ++i) {
            sum += fabs(fmin((double)a->pixels[i], 1) - fmin((double)b->pixels[i], 1));
        }
        number += 3 * (double)pixels;
    }
    return sum / number;
}

/* Tiles that a single lane makes other than all did. Spoils what the runner has counted. */
static size_t count_different(path_runner *runner) {
    enum { STEP = 16, SIZE = 3 * PATH_WAVE };
    static float before[SIZE];
    size_t different = 0;
    runner->job.primary.max_lanes = runner->job.scattered.max_lanes = 1;
    for (size_t place = 0; place < runner->tiles; place += STEP) {
        const float *const tile = runner->pixels + place * SIZE;
        memcpy(before, tile, sizeof before);
        trace_tile(runner, place);
        different += memcmp(before, tile, sizeof before) != 0;
    }
    return different;
}

static void fill_row(const bench_options *options, const path_runner *runners, int which,
                     const keinert_contender *contender, keinert_row *row) {
    const path_runner *const runner = &runners[which];
    double ratios[BENCH_MOST_ROUNDS];
    row->rays = row->evaluations = row->undecided = 0;
    for (int kind = 0; kind < path_rays; ++kind) {
        const spt_statistics *const traced = &runner->wave->statistics.traced[kind];
        row->rays += (double)traced->rays;
        row->evaluations += (double)traced->evaluations;
        row->undecided += (double)traced->outcomes[SPT_LIMIT];
    }
    for (int round = 0; round < options->rounds; ++round) {
        ratios[round] = runners[0].traced[round] / runner->traced[round];
    }
    row->of_the_library = bench_median(ratios, options->rounds);
    row->nanoseconds =
        1e9 * keinert_middle_seconds(contender, options->rounds) * options->rounds / row->rays;
    row->error = mean_difference(runner, &runners[REFERENCE]);
    row->error_of = "mean difference of pixels, cut at 1, to the same paths with tight tolerances";
}

static int race_paths(const bench_options *options, FILE *file, const char *name,
                      const path_stage *stage, double paper) {
    static keinert_contender contenders[WAYS];
    static path_runner runners[WAYS + 1];
    static keinert_row rows[WAYS];
    memset(contenders, 0, sizeof contenders);
    for (int i = 0; i < WAYS; ++i) {
        enter(&runners[i], options, stage, &ways[i]);
        contenders[i].name = ways[i].name;
        contenders[i].paper = ways[i].judged ? paper : 0;
        contenders[i].user = &runners[i];
        rows[i] = keinert_row_of("path tracing", name);
    }
    enter(&runners[REFERENCE], options, stage, &ways[0]);
    trace_reference(&runners[REFERENCE]);
    keinert_race(contenders, WAYS, options->rounds, run);
    for (int i = 0; i < WAYS; ++i) fill_row(options, runners, i, &contenders[i], &rows[i]);
    for (int i = 0; i < WAYS; ++i) rows[i].error_of_base = rows[0].error;
    keinert_report(file, contenders, rows, WAYS, options->rounds);
    size_t different = 0;
    for (int i = 0; i < WAYS; ++i) different += count_different(&runners[i]);
    if (different > 0)
        printf("%s: %zu tiles differ from those of a single lane\n", name, different);
    for (int i = 0; i <= REFERENCE; ++i) leave(&runners[i]);
    return different == 0;
}

int keinert_paths(const bench_options *options, FILE *file) {
    static path_stage stage;
    const double saved = 118.302 / 101.934;
    path_room(&stage, options->width, options->height);
    const int room = race_paths(options, file, "room", &stage, saved);
    path_open_air(&stage, scene_named("city"), SCENE_WHOLE, options->width, options->height);
    const int city = race_paths(options, file, "city", &stage, saved);
    return room && city;
}
