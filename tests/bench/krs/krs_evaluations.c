/* SPDX-License-Identifier: MIT
 *
 * What an evaluation takes against levels, at every width: by itself, in full batches of points
 * from all over the model's bound; and while a tree is traced, all of the trace included. There the
 * tree has no bound, so that every ray asks it, and what a ray takes besides is spread over some
 * evaluations at any number of levels. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "krs_bench.h"

enum {
    BATCHES = 16,
    BLOCKS = 16,
    RAYS = BLOCKS * SPT_BATCH,
    COUNT = KRS_LAST - KRS_FIRST + 1,
    ALIGNMENT = 64
};

/* What is evaluated. */
typedef enum evaluated { SEQUENCE, BOUND, PROBE, TRACED, EVALUATED } evaluated;
static const char *const names[EVALUATED] = {"krs_distance", "moekrs_distance", "moekrs_probe",
                                             "krs_traced"};

/* Columns of points, and what is said of them. */
typedef struct evaluation_batch {
    float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], radius[SPT_BATCH], answer[SPT_BATCH];
} evaluation_batch;

typedef struct evaluation_track {
    evaluation_batch *batches[TRACED];
    krs_models *models; /* COUNT of them */
    spt_ray rays[RAYS]; /* blocks from all over the picture */
    float pixel_radius;
    double nanoseconds[EVALUATED][COUNT][BENCH_MOST_ROUNDS];
} evaluation_track;

static float draw(uint32_t *state, float low, float high) {
    *state = *state * 1664525u + 1013904223u;
    return low + (high - low) * ((float)(*state >> 8) * 0x1p-24f);
}

/* In the bound of the model of most levels, so that the points are the same for all. */
static void draw_points(evaluation_track *track, evaluated kind) {
    const spt_field *const field =
        krs_models_field(&track->models[COUNT - 1], kind == SEQUENCE ? KRS_TREE : KRS_PALM);
    float low[3], high[3];
    uint32_t state = 1;
    spt_bound_extent(field->bound, low, high);
    for (int i = 0; i < BATCHES; ++i) {
        evaluation_batch *const batch = &track->batches[kind][i];
        for (int k = 0; k < SPT_BATCH; ++k) {
            batch->x[k] = draw(&state, low[0], high[0]);
            batch->y[k] = draw(&state, low[1], high[1]);
            batch->z[k] = draw(&state, low[2], high[2]);
            batch->radius[k] = draw(&state, 0.001f, 0.1f);
        }
    }
}

static void evaluate(const krs_models *models, evaluated kind, evaluation_batch *batch) {
    if (kind == PROBE) {
        const spt_probe *const probe = &models->probes[KRS_PALM];
        probe->batch(probe->user, SPT_BATCH, batch->x, batch->y, batch->z, batch->radius,
                     batch->answer);
        return;
    }
    const spt_field *const field = krs_models_field(models, kind == SEQUENCE ? KRS_TREE : KRS_PALM);
    field->batch(field->user, SPT_BATCH, batch->x, batch->y, batch->z, batch->answer);
}

static void draw_rays(evaluation_track *track, const bench_options *options) {
    frame_picture *const picture =
        frame_picture_of(krs_view(KRS_TREE), options->width, options->height);
    for (size_t i = 0; i < RAYS; ++i) {
        const size_t block = picture->count / SPT_BATCH / BLOCKS * (i / SPT_BATCH);
        track->rays[i] = picture->rays[block * SPT_BATCH + i % SPT_BATCH];
    }
    track->pixel_radius = picture->pixel_radius;
    frame_picture_free(picture);
}

/* Nanoseconds of an evaluation of a trace. */
static double measure_traced(const evaluation_track *track, int level, int lanes) {
    spt_field field = *krs_models_field(&track->models[level], KRS_TREE);
    spt_settings settings = krs_settings(krs_single_direct, track->pixel_radius);
    spt_statistics statistics = spt_statistics_default();
    static bench_hit hits[RAYS];
    const spt_rays rays = spt_rays_of(track->rays);
    const spt_hits sinks = bench_hits_of(hits);
    field.bound = NULL;
    settings.max_lanes = (uint32_t)lanes;
    const double before = bench_seconds();
    frame_expect(spt_trace(&field, &settings, RAYS, &rays, &sinks, &statistics), "spt_trace");
    return (bench_seconds() - before) * 1e9 / (double)statistics.evaluations;
}

/* Nanoseconds of an evaluation. */
static double measure(const evaluation_track *track, int level, evaluated kind, double seconds) {
    const double start = bench_seconds();
    double spent, points = 0;
    do {
        for (int i = 0; i < BATCHES; ++i) {
            evaluate(&track->models[level], kind, &track->batches[kind][i]);
        }
        points += BATCHES * SPT_BATCH;
        spent = bench_seconds() - start;
    } while (spent < seconds);
    return spent * 1e9 / points;
}

/* All numbers of levels take turns, so that a slow spell of the machine bends no line. */
static void measure_all(evaluation_track *track, const bench_options *options, int lanes) {
    for (int round = 0; round < options->rounds; ++round) {
        for (int turn = 0; turn < COUNT; ++turn) {
            const int level = (turn * 10 + round) % COUNT; /* 10 and COUNT have no common divisor */
            for (int kind = 0; kind < TRACED; ++kind) {
                track->nanoseconds[kind][level][round] =
                    measure(track, level, (evaluated)kind, options->slice_seconds / 4);
            }
            track->nanoseconds[TRACED][level][round] = measure_traced(track, level, lanes);
        }
    }
}

static void report(evaluation_track *track, evaluated kind, int lanes, int rounds, FILE *file) {
    double x[COUNT], y[COUNT];
    char what[96];
    for (int i = 0; i < COUNT; ++i) {
        const uint32_t levels = (uint32_t)(KRS_FIRST + i);
        x[i] = (double)levels;
        y[i] = bench_median(track->nanoseconds[kind][i], rounds);
        snprintf(what, sizeof what, "%s_%d_lanes", names[kind], lanes);
        krs_begin_row(file, what, levels, 1, spt_krs_instances(levels));
        fprintf(file, ",,,,,%.4f,,,,,,,\n", y[i]);
    }
    const krs_line line = krs_line_through(x, y, COUNT);
    snprintf(what, sizeof what, "straight, %s, %2d lanes: %.2f + %.3f levels ns", names[kind],
             lanes, line.offset, line.slope);
    krs_print_goal(what, line.straight, ">= 0.98", line.straight >= 0.98);
}

void krs_evaluations(const bench_options *options, FILE *file) {
    static evaluation_track track;
    char *memory = frame_allocate(TRACED * BATCHES * sizeof(evaluation_batch) + ALIGNMENT);
    const size_t beyond = (uintptr_t)memory % ALIGNMENT;
    track.models = frame_allocate(COUNT * sizeof *track.models);
    for (int kind = 0; kind < TRACED; ++kind) {
        track.batches[kind] =
            (evaluation_batch *)(void *)(memory + (ALIGNMENT - beyond) +
                                         (size_t)kind * BATCHES * sizeof(evaluation_batch));
    }
    draw_rays(&track, options);
    printf("An evaluation, from %d to %d levels:\n", KRS_FIRST, KRS_LAST);
    for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
        for (int i = 0; i < COUNT; ++i) {
            krs_models_build(&track.models[i], (uint32_t)(KRS_FIRST + i), bench_lanes[width]);
        }
        for (int kind = 0; kind < TRACED; ++kind) draw_points(&track, (evaluated)kind);
        measure_all(&track, options, bench_lanes[width]);
        for (int kind = 0; kind < EVALUATED; ++kind) {
            report(&track, (evaluated)kind, bench_lanes[width], options->rounds, file);
        }
        fflush(stdout);
    }
    free(track.models);
    free(memory);
}
