/* SPDX-License-Identifier: MIT
 *
 * The race: the driver at every width against the scalar loop, on the rays of a picture, with the
 * same step rule and stop on both sides. A race counts only if both give the same bits. */
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench_scenes.h"
#include "peak.h"

typedef struct race_scene {
    const char *name;
    double flop, divider;
    double target[BENCH_WIDTHS]; /* by width; 0: none */
} race_scene;

static const race_scene race_scenes[] = {
#define X(scene, flop, divider, at_4, at_8, at_16) {#scene, flop, divider, {0, at_4, at_8, at_16}},
    BENCH_SCENES(X)
#undef X
};

typedef struct race_method {
    const char *name;
    int needs_convex;
} race_method;

static const race_method race_methods[] = {
#define X(scene, method, convex) {#method, convex},
    BENCH_METHODS(X, any)
#undef X
};

enum {
    METHODS = sizeof race_methods / sizeof race_methods[0],
    SCENES = sizeof race_scenes / sizeof race_scenes[0]
};

/* Runner 0 is the scalar loop, the others the library at bench_lanes[runner - 1]. */
enum { RUNNERS = BENCH_WIDTHS + 1 };

typedef struct race_result {
    double ratio[BENCH_WIDTHS];       /* times the scalar loop */
    double nanoseconds[BENCH_WIDTHS]; /* an evaluation */
    double evaluations;               /* a ray */
    double utilisation;
    size_t different; /* rays whose results are not the scalar loop's */
} race_result;

typedef struct race_track {
    const scene *shown;
    const char *method;
    bench_picture picture;
    scalar_trace_fn *scalar;
    bench_hit *expected, *hits;
} race_track;

/* Seconds of a runner over a run of rays. */
static double run(const race_track *track, int runner, size_t start, size_t slice) {
    const int lanes = runner > 0 ? bench_lanes[runner - 1] : 1;
    const spt_field field = scene_field(track->shown, lanes);
    const spt_settings settings = bench_settings(track->method, track->picture.pixel_radius, lanes);
    const spt_ray *rays = track->picture.rays + start;
    const spt_rays columns = spt_rays_of(rays);
    const spt_hits sinks = bench_hits_of(track->hits);
    const double before = bench_seconds();
    if (runner == 0) {
        track->scalar(&field, &settings, slice, rays, track->expected);
    } else if (spt_trace(&field, &settings, slice, &columns, &sinks, NULL) != SPT_OK) {
        fprintf(stderr, "%s: the trace was refused\n", track->shown->name);
        exit(1);
    }
    return bench_seconds() - before;
}

/* A run of rays that takes the slower runners about as long as was asked for, in whole tiles. */
static size_t slice_of(const race_track *track, double seconds) {
    const size_t count = track->picture.count, tile = SPT_BATCH;
    const size_t trial = count < 16 * tile ? count : 16 * tile;
    run(track, 0, 0, trial);
    const double each = run(track, 0, 0, trial) / (double)trial;
    const size_t slice = (size_t)(seconds / each) / tile * tile;
    return slice < tile ? tile : slice < count ? slice : count;
}

static size_t count_different(const race_track *track, size_t slice) {
    size_t different = 0;
    for (size_t i = 0; i < slice; ++i) {
        different += memcmp(&track->expected[i], &track->hits[i], sizeof(bench_hit)) != 0;
    }
    return different;
}

static double evaluations_of(const bench_hit *hits, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += hits[i].evaluations;
    return sum;
}

/* What a timed call leaves out. */
static void count_evaluations(const race_track *track, race_result *result) {
    const spt_field field = scene_field(track->shown, spt_lanes());
    const spt_settings settings = bench_settings(track->method, track->picture.pixel_radius, 0);
    const spt_rays columns = spt_rays_of(track->picture.rays);
    spt_statistics statistics = spt_statistics_default();
    spt_hits nothing;
    memset(&nothing, 0, sizeof nothing);
    spt_trace(&field, &settings, track->picture.count, &columns, &nothing, &statistics);
    result->evaluations = (double)statistics.evaluations / (double)statistics.rays;
    result->utilisation = spt_utilisation(&statistics);
}

static race_result hold_race(const bench_options *options, const race_track *track) {
    double ratio[BENCH_WIDTHS][BENCH_MOST_ROUNDS], nanoseconds[BENCH_WIDTHS][BENCH_MOST_ROUNDS];
    race_result result = {{0}, {0}, 0, 0, 0};
    const size_t slice = slice_of(track, options->slice_seconds);
    count_evaluations(track, &result);
    for (int round = 0; round < options->rounds; ++round) {
        const size_t start = bench_slice_start(&track->picture, slice, round);
        const double scalar = run(track, 0, start, slice);
        const double evaluations = evaluations_of(track->expected, slice);
        for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
            memset(track->hits, 0, slice * sizeof *track->hits);
            const double seconds = run(track, width + 1, start, slice);
            ratio[width][round] = scalar / seconds;
            nanoseconds[width][round] = seconds * 1e9 / evaluations;
            result.different += count_different(track, slice);
        }
    }
    for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
        result.ratio[width] = bench_median(ratio[width], options->rounds);
        result.nanoseconds[width] = bench_median(nanoseconds[width], options->rounds);
    }
    return result;
}

/* The least time an evaluation can take at a peak: its two kinds of work go on side by side. */
static double least_nanoseconds(const race_scene *raced, const peak *limit) {
    const double flop = raced->flop / limit->flop, divider = raced->divider / limit->divider;
    return flop > divider ? flop : divider;
}

static void write_result(FILE *file, const race_scene *raced, const char *method,
                         const race_result *result, const peak *limits) {
    for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
        const double share = least_nanoseconds(raced, &limits[width]) / result->nanoseconds[width];
        fprintf(file, "%s,%s,%d,%.3f,%.3f,%.4f,%.4f,%.4f\n", raced->name, method,
                bench_lanes[width], result->ratio[width], result->nanoseconds[width],
                result->evaluations, result->utilisation, share);
        printf("%-17s%-13s%5d%9.2f%10.3f%10.2f%8.1f%8.1f", raced->name, method, bench_lanes[width],
               result->ratio[width], result->nanoseconds[width], result->evaluations,
               100 * result->utilisation, 100 * share);
        printf("\n");
    }
    fflush(stdout);
}

/* The default rule is judged, on both sides; the basic one stands beside it. */
static void print_targets(const race_scene *raced, const double *basic, const double *adaptive) {
    for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
        const double target = raced->target[width];
        if (!(target > 0)) continue;
        printf("%-17s%5d lanes   target %5.1f   adaptive %6.2f %-12s (basic %6.2f)\n", raced->name,
               bench_lanes[width], target, adaptive[width],
               adaptive[width] >= target ? "reached" : "NOT REACHED", basic[width]);
    }
}

typedef double race_ratios[METHODS][BENCH_WIDTHS];

static size_t race_picture(const bench_options *options, FILE *file, const race_scene *raced,
                           const peak *limits, race_ratios ratios) {
    size_t different = 0;
    race_track track;
    track.shown = scene_named(raced->name);
    track.picture = bench_picture_of(track.shown, options->width, options->height);
    track.expected = malloc(track.picture.count * sizeof *track.expected);
    track.hits = malloc(track.picture.count * sizeof *track.hits);
    if (track.expected == NULL || track.hits == NULL) exit(1);
    for (size_t i = 0; i < METHODS; ++i) {
        const race_method *method = &race_methods[i];
        if (method->needs_convex && !(track.shown->flags & SPT_FIELD_CONVEX)) continue;
        track.method = method->name;
        track.scalar = scalar_loop_of(raced->name, method->name);
        const race_result result = hold_race(options, &track);
        write_result(file, raced, method->name, &result, limits);
        memcpy(ratios[i], result.ratio, sizeof result.ratio);
        if (result.different > 0) {
            printf("%s, %s: %zu results differ from the scalar loop's\n", raced->name, method->name,
                   result.different);
        }
        different += result.different;
    }
    free(track.expected);
    free(track.hits);
    bench_picture_free(&track.picture);
    return different;
}

static size_t method_named(const char *name) {
    size_t method = 0;
    while (strcmp(race_methods[method].name, name) != 0) ++method;
    return method;
}

int bench_race(const bench_options *options) {
    size_t different = 0;
    peak limits[BENCH_WIDTHS];
    static race_ratios ratios[SCENES];
    FILE *file = bench_open(options, "driver.csv",
                            "scene,method,lanes,ratio_to_scalar,ns_per_evaluation,"
                            "evaluations_per_ray,utilisation,share_of_limit");
    printf("Peak of one core, not fused:\n");
    for (int width = 0; width < BENCH_WIDTHS && bench_lanes[width] <= spt_lanes(); ++width) {
        limits[width] = peak_of(bench_lanes[width]);
        printf("  %2d lanes %7.1f GFLOP/s %6.2f Groot/s\n", bench_lanes[width], limits[width].flop,
               limits[width].divider);
    }
    printf("\nThe driver against a scalar loop with the distance inlined, same rule:\n"
           "%-17s%-13s%5s%9s%10s%10s%8s%8s\n",
           "scene", "method", "lanes", "ratio", "ns/eval", "evals/ray", "used %", "limit %");
    for (size_t i = 0; i < SCENES; ++i) {
        different += race_picture(options, file, &race_scenes[i], limits, ratios[i]);
    }
    fclose(file);
    printf("\n");
    for (size_t i = 0; i < SCENES; ++i) {
        print_targets(&race_scenes[i], ratios[i][method_named("basic")],
                      ratios[i][method_named("adaptive")]);
    }
    return different == 0;
}
