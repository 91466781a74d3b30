/* SPDX-License-Identifier: MIT
 *
 * The clock, medians and pictures of the driver's bench. */
#define _POSIX_C_SOURCE 199309L
#include "bench.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench_scenes.h"

enum { tile_rays = 256 };

const int bench_lanes[BENCH_WIDTHS] = {1, 4, 8, 16};

double bench_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, compare);
    return values[count / 2];
}

static size_t common_divisor(size_t a, size_t b) {
    return b == 0 ? a : common_divisor(b, a % b);
}

static void *allocate(size_t size) {
    void *memory = malloc(size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    return memory;
}

/* Tiles a golden section of the picture apart follow one another (an additive recurrence), so that
 * any run of them is an even sample. */
bench_picture bench_picture_of(const scene *shown, int width, int height) {
    bench_picture picture;
    picture.count = (size_t)width * (size_t)height;
    picture.rays = allocate(picture.count * sizeof *picture.rays);
    spt_ray *tiled = allocate(picture.count * sizeof *tiled);
    scene_rays_tiled(shown, width, height, tiled, NULL, &picture.pixel_radius);
    const size_t tiles = picture.count / tile_rays;
    size_t stride = (size_t)(0.618033988749895 * (double)tiles);
    while (common_divisor(tiles, stride) != 1) ++stride;
    for (size_t i = 0; i < tiles; ++i) {
        memcpy(&picture.rays[i * tile_rays], &tiled[i * stride % tiles * tile_rays],
               tile_rays * sizeof *tiled);
    }
    free(tiled);
    return picture;
}

void bench_picture_free(bench_picture *picture) {
    free(picture->rays);
}

size_t bench_slice_start(const bench_picture *picture, size_t slice, int round) {
    const size_t places = picture->count / slice;
    return (size_t)round % places * slice;
}

const spt_method *bench_method(const char *name) {
#define X(scene, method, convex) \
    if (strcmp(name, #method) == 0) return spt_##method();
    BENCH_METHODS(X, any)
#undef X
    return NULL;
}

spt_settings bench_settings(const char *method, float pixel_radius, int lanes) {
    spt_settings settings = spt_settings_default();
    settings.method = bench_method(method);
    settings.pixel_radius = pixel_radius;
    settings.max_lanes = (uint32_t)lanes;
    return settings;
}

spt_hits bench_hits_of(bench_hit *hits) {
    const ptrdiff_t stride = (ptrdiff_t)sizeof *hits;
    spt_hits view;
    memset(&view, 0, sizeof view);
    view.t.first = &hits->t;
    view.residual.first = &hits->residual;
    view.outcome.first = &hits->outcome;
    view.evaluations.first = &hits->evaluations;
    view.t.stride = view.residual.stride = view.outcome.stride = view.evaluations.stride = stride;
    return view;
}

FILE *bench_open(const bench_options *options, const char *name, const char *header) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", options->output, name);
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    fprintf(file, "%s\n", header);
    return file;
}
