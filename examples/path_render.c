/* SPDX-License-Identifier: MIT
 *
 * Films of paths: tiles shared out to threads, samples added tile by tile. */
#include "path_wave.h"
#include "workers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

path_settings path_settings_default(void) {
    const path_settings settings = {NULL, 10, 4, 1e-4f, 1, 4096, 0, 0, 1};
    return settings;
}

path_statistics path_statistics_default(void) {
    path_statistics statistics;
    memset(&statistics, 0, sizeof statistics);
    for (int kind = 0; kind < path_rays; ++kind) {
        statistics.traced[kind] = spt_statistics_default();
    }
    return statistics;
}

static void add_traced(spt_statistics *sum, const spt_statistics *more) {
    sum->rays += more->rays;
    for (int i = 0; i < SPT_OUTCOMES; ++i) sum->outcomes[i] += more->outcomes[i];
    sum->evaluations += more->evaluations;
    sum->slots += more->slots;
    sum->passes += more->passes;
    sum->fallbacks += more->fallbacks;
    if (more->largest_slope > sum->largest_slope) sum->largest_slope = more->largest_slope;
    if (more->lanes != 0) sum->lanes = more->lanes;
}

static void add_statistics(path_statistics *sum, const path_statistics *more) {
    for (int kind = 0; kind < path_rays; ++kind) {
        add_traced(&sum->traced[kind], &more->traced[kind]);
        sum->seconds[kind] += more->seconds[kind];
    }
    for (int i = 0; i < 3; ++i) sum->starts[i] += more->starts[i];
}

void path_statistics_print(const path_statistics *all) {
    static const char *const names[path_rays] = {"primary", "secondary", "shadow"};
    for (int kind = 0; kind < path_rays; ++kind) {
        const spt_statistics *one = &all->traced[kind];
        if (one->rays == 0) continue;
        printf("%-9s %10llu rays, %6.2f evaluations and %4.0f ns each, %llu undecided\n",
               names[kind], (unsigned long long)one->rays,
               (double)one->evaluations / (double)one->rays,
               1e9 * all->seconds[kind] / (double)one->rays,
               (unsigned long long)one->outcomes[SPT_LIMIT]);
    }
    printf("%.1f s of processor time\n", all->all_seconds);
}

/* ---- Films --------------------------------------------------------------------------------- */

static size_t tiles_across(int width) {
    return ((size_t)width + PATH_TILE - 1) / PATH_TILE;
}

static size_t tiles_of(const path_film *film) {
    return tiles_across(film->width) * tiles_across(film->height);
}

/* left, top, right, bottom */
static void tile_area(const path_film *film, size_t tile, uint32_t area[4]) {
    const uint32_t across = (uint32_t)tiles_across(film->width);
    area[0] = (uint32_t)tile % across * PATH_TILE;
    area[1] = (uint32_t)tile / across * PATH_TILE;
    area[2] =
        area[0] + PATH_TILE < (uint32_t)film->width ? area[0] + PATH_TILE : (uint32_t)film->width;
    area[3] =
        area[1] + PATH_TILE < (uint32_t)film->height ? area[1] + PATH_TILE : (uint32_t)film->height;
}

path_film path_film_create(int width, int height) {
    path_film film = {width, height, NULL, NULL};
    film.sums = calloc((size_t)width * (size_t)height, 3 * sizeof *film.sums);
    film.samples = calloc(tiles_of(&film), sizeof *film.samples);
    if (film.sums == NULL || film.samples == NULL) path_film_free(&film);
    return film;
}

void path_film_free(path_film *film) {
    free(film->sums);
    free(film->samples);
    film->sums = NULL;
    film->samples = NULL;
}

void path_film_print(const path_film *film, float *pixels) {
    for (size_t tile = 0; tile < tiles_of(film); ++tile) {
        const double share = film->samples[tile] != 0 ? 1.0 / film->samples[tile] : 0.0;
        uint32_t area[4];
        tile_area(film, tile, area);
        for (uint32_t y = area[1]; y < area[3]; ++y) {
            const size_t first = 3 * ((size_t)y * (size_t)film->width + area[0]);
            const size_t end = first + 3 * (size_t)(area[2] - area[0]);
            for (size_t i = first; i < end; ++i) pixels[i] = (float)(film->sums[i] * share);
        }
    }
}

/* ---- Threads ------------------------------------------------------------------------------- */

typedef struct exposure {
    path_film *film;
    path_job job;
    uint32_t samples;
    path_statistics *statistics;
    int failed;
} exposure;

static void fail(exposure *all, workers *crew, const char *message) {
    workers_lock(crew);
    if (!all->failed) fprintf(stderr, "%s\n", message);
    all->failed = 1;
    workers_unlock(crew);
    workers_stop(crew);
}

/* Adds the samples of one tile. No other thread has it. */
static void expose_tile(const exposure *all, size_t tile, path_wave *wave) {
    path_film *film = all->film;
    uint32_t area[4];
    tile_area(film, tile, area);
    for (uint32_t k = 0; k < all->samples && wave->status == SPT_OK; ++k) {
        const float *light = wave->light[0];
        path_wave_begin(wave, area, film->samples[tile]);
        while (path_wave_step(wave)) {
        }
        for (uint32_t y = area[1]; y < area[3]; ++y) {
            double *sums = film->sums + 3 * ((size_t)y * (size_t)film->width + area[0]);
            for (uint32_t i = 0; i < 3 * (area[2] - area[0]); ++i) sums[i] += (double)*light++;
        }
        ++film->samples[tile];
    }
}

static void run_thread(void *user, workers *crew) {
    exposure *all = user;
    path_wave *wave = path_wave_create(&all->job);
    size_t tile;
    if (wave == NULL) {
        fail(all, crew, "out of memory");
        return;
    }
    while (workers_take(crew, &tile)) {
        expose_tile(all, tile, wave);
        if (wave->status != SPT_OK) {
            fail(all, crew, spt_status_name(wave->status));
            break;
        }
        workers_finish(crew);
    }
    workers_lock(crew);
    if (all->statistics != NULL) add_statistics(all->statistics, &wave->statistics);
    workers_unlock(crew);
    path_wave_free(wave);
}

/* ---- The calls ----------------------------------------------------------------------------- */

int path_job_create(path_job *job, const path_world *world, const path_settings *settings,
                    int width, int height) {
    const double pixel = (double)(world->camera.x_high - world->camera.x_low) / (2.0 * width);
    job->world = *world;
    job->settings = *settings;
    job->width = (uint32_t)width;
    job->height = (uint32_t)height;
    job->scene = *world->scene;
    job->fields = malloc(job->scene.count * sizeof *job->fields);
    if (job->fields == NULL) return 0;
    memcpy(job->fields, job->scene.fields, job->scene.count * sizeof *job->fields);
    for (size_t i = 0; i < job->scene.count; ++i) {
        const int other_rule = settings->method != NULL && settings->method != spt_convex();
        if (other_rule) job->fields[i].flags &= ~(uint32_t)SPT_FIELD_CONVEX;
    }
    job->scene.fields = job->fields;
    job->primary = spt_settings_default();
    if (settings->method != NULL) job->primary.method = settings->method;
    job->primary.budget = settings->budget;
    job->primary.epsilon = settings->epsilon;
    job->primary.pixel_radius = settings->pixel_cone ? (float)pixel : 0.0f;
    job->primary.max_lanes = settings->max_lanes;
    job->scattered = job->primary;
    /* Off the surface on which a ray begins, and against what it begins in: next to an edge of the
     * room, within the tolerance of both walls, a ray into the second one must not leave by it. */
    job->scattered.flags = SPT_SKIP_START | SPT_STOP_INSIDE;
    return 1;
}

void path_job_free(path_job *job) {
    free(job->fields);
}

long path_expose(path_film *film, const path_world *world, const path_settings *settings,
                 uint32_t samples, const char *label, path_statistics *statistics) {
    const size_t tiles = tiles_of(film);
    const clock_t before = clock();
    exposure all;
    if (!path_job_create(&all.job, world, settings, film->width, film->height)) {
        fprintf(stderr, "out of memory\n");
        return -1;
    }
    all.film = film;
    all.samples = samples;
    all.statistics = statistics;
    all.failed = 0;
    const size_t done = workers_run(settings->threads, 0, tiles, run_thread, &all, label);
    path_job_free(&all.job);
    if (statistics != NULL) {
        statistics->all_seconds += (double)(clock() - before) / CLOCKS_PER_SEC;
    }
    return all.failed ? -1 : (long)(tiles - done);
}

long path_render(const path_world *world, const path_settings *settings, int width, int height,
                 uint32_t samples, float *pixels, path_statistics *statistics) {
    path_film film = path_film_create(width, height);
    long missing = -1;
    if (film.sums == NULL) {
        fprintf(stderr, "out of memory\n");
        return -1;
    }
    missing = path_expose(&film, world, settings, samples, "paths", statistics);
    path_film_print(&film, pixels);
    path_film_free(&film);
    return missing;
}
