/* SPDX-License-Identifier: MIT
 *
 * chunk.csv: what a ray costs by how many are traced at a time. The driver works on chunks of at
 * most SPT_BATCH rays, so that calls with fewer have smaller ones. */
#include <stdlib.h>

#include "../../../src/trace/chunk.h"
#include "choosing.h"
#include "choosing_times.h"

static const char *const shown[] = {"plane", "primitives", "mandelbulb", "village", "krs_tree_16"};
enum { shown_count = sizeof shown / sizeof shown[0] };

static const size_t sizes[] = {16, 32, 64, 128, 256, 512, 4096};
enum { size_count = sizeof sizes / sizeof sizes[0], reference = 4, traced = 4096 };

typedef struct chunk_race {
    spt_field field;
    spt_settings settings;
    bench_picture picture;
    bench_hit *hits;
    spt_statistics statistics;
} chunk_race;

/* The same rays, in calls of a size. */
static void run(void *user, int contender) {
    chunk_race *const race = user;
    const size_t size = sizes[contender];
    race->statistics = spt_statistics_default();
    for (size_t at = 0; at < traced; at += size) {
        const spt_rays rays = spt_rays_of(race->picture.rays + at);
        const spt_hits hits = bench_hits_of(race->hits + at);
        report_expect(spt_trace(&race->field, &race->settings, size, &rays, &hits,
                                &race->statistics) == SPT_OK,
                      "a trace was refused");
    }
}

static int cells(const report_options *options) {
    (void)options;
    return shown_count;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const scene *const at = scene_named(shown[cell]);
    chunk_race race;
    race.field = scene_field(at, spt_lanes());
    race.picture = bench_picture_of(at, 640, 352);
    race.settings = bench_settings("adaptive", race.picture.pixel_radius, 0);
    race.hits = report_allocate(traced * sizeof *race.hits);
    const choosing_times times =
        choosing_race(size_count, reference, options->quick ? 15 : 51, run, &race);
    for (int i = 0; i < size_count; ++i) {
        /* What the state of as many rays takes when they march together. */
        const size_t bytes = SPTI_ARRAYS * (sizes[i] + SPTI_GROUP) * sizeof(float);
        run(&race, i);
        fprintf(rows, "%s,%zu,%.9g,%.9g,%.9g,%.9g,%zu\n", at->name, sizes[i],
                1e9 * times.seconds[i] / traced, times.ratio[i], times.noise[i],
                spt_utilisation(&race.statistics), bytes);
    }
    free(race.hits);
    bench_picture_free(&race.picture);
}

const report_part report_chunk = {
    "chunk",   "scene,rays_a_call,nanoseconds,ratio,noise,utilisation,bytes", cells, measure, 1,
    {1.5, 0.5}};
