/* SPDX-License-Identifier: MIT
 *
 * Frames of the Whitted renderer with two reflections, eight refractions and three refinements: the
 * jewel by several step rules, and the paper's Figure 11 with and without the optimisation for
 * convex bodies. Processor time of whole frames: the paper leaves shading out of its times, here it
 * is in; keinert_glass.c is without. Evaluations are those of tracing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <whitted.h>

#include "keinert_bench.h"

/* A way to render. */
typedef struct frame_way {
    const char *name;
    const spt_method *(*method)(void);
    int convex;  /* rays inside by spt_trace_convex() */
    int licence; /* the field has its SPT_FIELD_CONVEX */
    int scalar;  /* its callback is the one that was built without vectors: evaluations cost more */
    int against; /* its place in the list */
    double paper; /* as in keinert_contender */
} frame_way;

static const double jewel_saved = 22.470 / 21.11, convex_saved = 3.03 / 2.73;

typedef struct frame_runner {
    const frame_way *way;
    const bench_options *options;
    glass_world world;
    scene body; /* the world's, but without its licence */
    float *pixels;
    whitted_statistics statistics;
    int failed;
} frame_runner;

static void enter(frame_runner *runner, const bench_options *options, const char *name,
                  const frame_way *way) {
    memset(runner, 0, sizeof *runner);
    runner->way = way;
    runner->options = options;
    runner->pixels = keinert_allocate((size_t)options->width * (size_t)options->height * 3 *
                                      sizeof *runner->pixels);
    if (!glass_world_named(name, &runner->world)) runner->failed = 1;
    runner->body = *runner->world.body;
    if (!way->licence) runner->body.flags &= ~(uint32_t)SPT_FIELD_CONVEX;
    for (int width = 1; width < BENCH_WIDTHS && way->scalar; ++width) {
        runner->body.batch[width] = runner->body.batch[0];
    }
    runner->world.body = &runner->body;
}

static double run(void *user, int round) {
    frame_runner *const runner = user;
    whitted_settings settings = whitted_settings_default();
    (void)round;
    settings.method = runner->way->method();
    settings.convex = runner->way->convex;
    const double before = bench_seconds();
    const int good = whitted_render(&runner->world, &settings, runner->options->width,
                                    runner->options->height, runner->pixels, &runner->statistics);
    if (!good) runner->failed = 1;
    return bench_seconds() - before;
}

/* The picture to compare with: basic steps without end, a tolerance near what float resolves, and
 * no pixel cone. */
static int render_reference(frame_runner *runner, float *pixels) {
    whitted_settings settings = whitted_settings_default();
    whitted_statistics statistics;
    settings.method = spt_basic();
    settings.convex = 0;
    settings.refinements = 0;
    settings.pixel_cone = 0;
    settings.epsilon = 4e-6f;
    settings.budget = 100000;
    return whitted_render(&runner->world, &settings, runner->options->width,
                          runner->options->height, pixels, &statistics);
}

/* Of pictures as they are shown, 0 to 1. */
static double mean_difference(const float *a, const float *b, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += fabs((double)a[i] - (double)b[i]);
    return sum / (double)count;
}

static void fill_row(const frame_runner *runner, const float *reference, keinert_row *row) {
    const size_t numbers = (size_t)runner->options->width * (size_t)runner->options->height * 3;
    const spt_statistics *const inside = &runner->statistics.of[WHITTED_INSIDE];
    row->rays = row->evaluations = 0;
    for (int kind = 0; kind < whitted_kinds; ++kind) {
        row->rays += (double)runner->statistics.of[kind].rays;
        row->evaluations += (double)runner->statistics.of[kind].evaluations;
    }
    row->inside_a_ray = (double)inside->evaluations / (double)inside->rays;
    row->undecided = (double)runner->statistics.undecided;
    row->lost = (double)runner->statistics.self_hits;
    whitted_develop(runner->pixels, numbers);
    row->error = mean_difference(runner->pixels, reference, numbers);
    row->error_of = "mean difference of shown pixels to tight tolerances; lost: self-hits";
}

/* Renders a frame once more; the bits must be the same. */
static int repeats(frame_runner *runner, float *again) {
    const size_t size = (size_t)runner->options->width * (size_t)runner->options->height * 3;
    float *const pixels = runner->pixels;
    runner->pixels = again;
    run(runner, 0);
    runner->pixels = pixels;
    return memcmp(pixels, again, size * sizeof *again) == 0;
}

static int race_frames(const bench_options *options, FILE *file, const char *name,
                       const frame_way *ways, int number) {
    enum { MOST = 8 };
    static keinert_contender contenders[MOST];
    static frame_runner runners[MOST];
    static keinert_row rows[MOST];
    const int rounds = options->rounds > 5 ? 7 : 3;
    const size_t numbers = (size_t)options->width * (size_t)options->height * 3;
    float *const reference = keinert_allocate(numbers * sizeof *reference);
    int good = 1;
    for (int i = 0; i < number; ++i) {
        enter(&runners[i], options, name, &ways[i]);
        contenders[i].name = ways[i].name;
        contenders[i].against = ways[i].against;
        contenders[i].paper = ways[i].paper;
        contenders[i].user = &runners[i];
        rows[i] = keinert_row_of("whole frame", name);
    }
    keinert_race(contenders, number, rounds, run);
    good = repeats(&runners[0], reference);
    if (!good) printf("%s: a frame rendered twice is not the same\n", name);
    good &= render_reference(&runners[0], reference);
    whitted_develop(reference, numbers);
    for (int i = 0; i < number; ++i) {
        fill_row(&runners[i], reference, &rows[i]);
        rows[i].nanoseconds = 1e9 * keinert_middle_seconds(&contenders[i], rounds) / rows[i].rays;
        rows[i].error_of_base = rows[ways[i].against].error;
        good &= !runners[i].failed;
        free(runners[i].pixels);
    }
    keinert_report(file, contenders, rows, number, rounds);
    free(reference);
    return good;
}

int keinert_frames(const bench_options *options, FILE *file) {
    const frame_way jewel[] = {
        {"basic", spt_basic, 0, 1, 0, 0, 0},
        {"relaxed 1.2", spt_relaxed, 0, 1, 0, 0, 0},
        {"adaptive (default rule)", spt_adaptive, 0, 1, 0, 0, jewel_saved},
        {"adaptive, convex (default)", spt_adaptive, 1, 1, 0, 0, jewel_saved},
        {"convex rule, convex", spt_convex, 1, 1, 0, 0, jewel_saved},
        {"scalar callback, basic", spt_basic, 0, 1, 1, 5, 0},
        {"scalar callback, adaptive", spt_adaptive, 0, 1, 1, 5, jewel_saved},
    };
    const frame_way glass[] = {
        {"through, basic", spt_basic, 0, 1, 0, 0, 0},
        {"through, relaxed 1.2", spt_relaxed, 0, 1, 0, 0, 0},
        {"through, adaptive", spt_adaptive, 0, 1, 0, 0, 0},
        {"backwards, adaptive", spt_adaptive, 1, 0, 0, 2, convex_saved},
        {"convex, basic", spt_basic, 1, 1, 0, 0, convex_saved},
        {"convex (default)", spt_adaptive, 1, 1, 0, 2, convex_saved},
        {"scalar callback, through", spt_adaptive, 0, 1, 1, 6, 0},
        {"scalar callback, convex", spt_adaptive, 1, 1, 1, 6, convex_saved},
    };
    const int first =
        race_frames(options, file, "jewel", jewel, (int)(sizeof jewel / sizeof jewel[0]));
    const int second =
        race_frames(options, file, "glass", glass, (int)(sizeof glass / sizeof glass[0]));
    return first && second;
}
