/* SPDX-License-Identifier: MIT
 *
 * What a trace costs besides the callback: the time of an evaluation in a trace, less that of the
 * callback alone in full batches of points that the same trace asked for. The plane costs next to
 * nothing, so that it shows the driver by itself. */
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench_scenes.h"

static const char *const overhead_scenes[] = {
#define X(scene, ...) #scene,
    BENCH_SCENES(X) "plane"
#undef X
};

static const char *const overhead_methods[] = {
#define X(scene, method, convex) #method,
    BENCH_METHODS(X, any)
#undef X
};

/* Targets for everything but the callback, ns an evaluation, by width; 0: none. */
static const double overhead_targets[BENCH_WIDTHS] = {0, 0, 1.6, 1.1};

enum { BATCHES = 64 }; /* 256 KiB of points and distances, in the second cache */

typedef struct recorded_batch {
    float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
} recorded_batch;

/* Keeps every keep-th batch that a trace asks for, its points one after the other. */
typedef struct recorder {
    const spt_field *field;
    recorded_batch *batches;
    size_t points, calls, keep;
} recorder;

static void record(void *user, size_t n, const float *x, const float *y, const float *z,
                   float *distance) {
    recorder *const to = user;
    const size_t room = (size_t)BATCHES * SPT_BATCH;
    if (to->calls++ % to->keep == 0) {
        for (size_t i = 0; i < n && to->points < room; ++i, ++to->points) {
            recorded_batch *batch = &to->batches[to->points / SPT_BATCH];
            batch->x[to->points % SPT_BATCH] = x[i];
            batch->y[to->points % SPT_BATCH] = y[i];
            batch->z[to->points % SPT_BATCH] = z[i];
        }
    }
    to->field->batch(to->field->user, n, x, y, z, distance);
}

typedef struct overhead {
    const scene *shown;
    spt_field field;
    spt_settings settings;
    bench_picture picture;
    bench_hit *hits;
    recorded_batch *batches;
} overhead;

static void trace(const overhead *of, const spt_field *field, size_t start, size_t slice) {
    const spt_rays columns = spt_rays_of(of->picture.rays + start);
    const spt_hits sinks = bench_hits_of(of->hits);
    if (spt_trace(field, &of->settings, slice, &columns, &sinks, NULL) != SPT_OK) {
        fprintf(stderr, "%s: the trace was refused\n", of->shown->name);
        exit(1);
    }
}

/* Fills the batches with points from all over the picture; returns how many are full. */
static size_t record_batches(const overhead *of) {
    spt_field field = of->field;
    recorder recording = {&of->field, of->batches, 0, 0, (size_t)-1};
    const size_t slice = of->picture.count / 8 / SPT_BATCH * SPT_BATCH;
    field.batch = record;
    field.user = &recording;
    trace(of, &field, 0, slice);
    recording.keep = recording.calls / (2 * (size_t)BATCHES) + 1;
    recording.points = recording.calls = 0;
    trace(of, &field, 0, slice);
    return recording.points / SPT_BATCH;
}

/* Nanoseconds of an evaluation by the callback alone. */
static double callback_alone(const overhead *of, size_t batches, double seconds) {
    const double start = bench_seconds();
    double spent, calls = 0;
    do {
        for (size_t i = 0; i < batches; ++i) {
            recorded_batch *batch = &of->batches[i];
            of->field.batch(of->field.user, SPT_BATCH, batch->x, batch->y, batch->z,
                            batch->distance);
        }
        calls += (double)batches;
        spent = bench_seconds() - start;
    } while (spent < seconds);
    return spent * 1e9 / (calls * SPT_BATCH);
}

/* And in a trace of a run of rays. */
static double in_trace(const overhead *of, size_t start, size_t slice) {
    double evaluations = 0;
    const double before = bench_seconds();
    trace(of, &of->field, start, slice);
    const double spent = bench_seconds() - before;
    for (size_t i = 0; i < slice; ++i) evaluations += of->hits[i].evaluations;
    return spent * 1e9 / evaluations;
}

static void measure(const bench_options *options, FILE *file, overhead *of, const char *method,
                    int width) {
    double alone[BENCH_MOST_ROUNDS], traced[BENCH_MOST_ROUNDS], rest[BENCH_MOST_ROUNDS];
    const int lanes = bench_lanes[width];
    of->field = scene_field(of->shown, lanes);
    of->settings = bench_settings(method, of->picture.pixel_radius, lanes);
    const size_t batches = record_batches(of);
    const size_t trial = of->picture.count / 32 / SPT_BATCH * SPT_BATCH;
    const double start = bench_seconds();
    trace(of, &of->field, 0, trial);
    const double each = (bench_seconds() - start) / (double)trial;
    size_t slice = (size_t)(options->slice_seconds / 3 / each) / SPT_BATCH * SPT_BATCH;
    slice = slice < trial ? trial : slice < of->picture.count ? slice : of->picture.count;
    for (int round = 0; round < options->rounds; ++round) {
        alone[round] = callback_alone(of, batches, options->slice_seconds / 6);
        traced[round] = in_trace(of, bench_slice_start(&of->picture, slice, round), slice);
        rest[round] = traced[round] - alone[round];
    }
    const double callback = bench_median(alone, options->rounds);
    const double driver = bench_median(traced, options->rounds);
    const double more = bench_median(rest, options->rounds);
    fprintf(file, "%s,%s,%d,%.3f,%.3f,%.3f\n", of->shown->name, method, lanes, callback, driver,
            more);
    printf("%-17s%-13s%5d%11.3f%11.3f%11.3f%9.0f %%", of->shown->name, method, lanes, callback,
           driver, more, 100 * more / callback);
    if (overhead_targets[width] > 0 && strcmp(method, "adaptive") == 0) {
        printf("   target %.1f ns %s", overhead_targets[width],
               more <= overhead_targets[width] ? "reached" : "NOT REACHED");
    }
    printf("\n");
    fflush(stdout);
}

static void measure_scene(const bench_options *options, FILE *file, overhead *of) {
    const size_t methods = sizeof overhead_methods / sizeof overhead_methods[0];
    for (size_t i = 0; i < methods; ++i) {
        const int convex = strcmp(overhead_methods[i], "convex") == 0;
        if (convex && !(of->shown->flags & SPT_FIELD_CONVEX)) continue;
        for (int width = 1; width < BENCH_WIDTHS; ++width) {
            if (bench_lanes[width] > spt_lanes()) continue;
            measure(options, file, of, overhead_methods[i], width);
        }
    }
}

void bench_overhead(const bench_options *options) {
    FILE *file =
        bench_open(options, "overhead.csv", "scene,method,lanes,callback_ns,driver_ns,overhead_ns");
    overhead of;
    of.batches = malloc(BATCHES * sizeof *of.batches);
    of.hits = malloc((size_t)options->width * (size_t)options->height * sizeof *of.hits);
    if (of.batches == NULL || of.hits == NULL) exit(1);
    printf("\nAn evaluation by the callback alone, in a trace, and the difference, ns:\n"
           "%-17s%-13s%5s%11s%11s%11s%11s\n",
           "scene", "method", "lanes", "callback", "trace", "rest", "rest/cb");
    for (size_t i = 0; i < sizeof overhead_scenes / sizeof overhead_scenes[0]; ++i) {
        of.shown = scene_named(overhead_scenes[i]);
        of.picture = bench_picture_of(of.shown, options->width, options->height);
        measure_scene(options, file, &of);
        bench_picture_free(&of.picture);
    }
    free(of.batches);
    free(of.hits);
    fclose(file);
}
