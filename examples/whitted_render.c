/* SPDX-License-Identifier: MIT
 *
 * The picture: tiles of 64 x 64 pixels, shared out among threads, each traced generation by
 * generation until no rays are left. */
#include "whitted_queue.h"
#include "workers.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { tile = 64 };

typedef struct whitted_job {
    const glass_world *world;
    const whitted_settings *settings;
    spt_camera camera;
    spt_field field;
    float pixel_radius;
    uint32_t width, height;
    float *pixels;
    whitted_statistics *statistics;
    int failed;
} whitted_job;

whitted_settings whitted_settings_default(void) {
    const spt_settings usual = spt_settings_default();
    whitted_settings settings;
    memset(&settings, 0, sizeof settings);
    settings.method = usual.method;
    settings.convex = 1;
    settings.refinements = 3;
    settings.reflections = 2;
    settings.refractions = 8;
    settings.least_weight = 1.0f / 256.0f;
    settings.epsilon = usual.epsilon;
    settings.pixel_cone = 1;
    settings.budget = usual.budget;
    settings.threads = 1;
    return settings;
}

/* ---- Statistics ---------------------------------------------------------------------------- */

static whitted_statistics no_statistics(void) {
    whitted_statistics none;
    memset(&none, 0, sizeof none);
    for (int kind = 0; kind < whitted_kinds; ++kind) none.of[kind] = spt_statistics_default();
    return none;
}

static void add_statistics(whitted_statistics *sum, const whitted_statistics *one) {
    for (int kind = 0; kind < whitted_kinds; ++kind) {
        spt_statistics *const total = &sum->of[kind];
        const spt_statistics *const part = &one->of[kind];
        total->rays += part->rays;
        for (int i = 0; i < SPT_OUTCOMES; ++i) total->outcomes[i] += part->outcomes[i];
        total->evaluations += part->evaluations;
        total->slots += part->slots;
        total->passes += part->passes;
        total->fallbacks += part->fallbacks;
        total->largest_slope = spt_greatest(total->largest_slope, part->largest_slope);
        total->lanes = part->lanes != 0 ? part->lanes : total->lanes;
    }
    sum->calls += one->calls;
    sum->secondary += one->secondary;
    sum->near += one->near;
    sum->at_hit += one->at_hit;
    sum->self_hits += one->self_hits;
    sum->slivers += one->slivers;
    sum->undecided += one->undecided;
}

/* ---- Tiles --------------------------------------------------------------------------------- */

/* Every other bit of a number, from the lowest on. */
static uint32_t every_other_bit(uint32_t number) {
    uint32_t bits = 0;
    for (int i = 0; i < 16; ++i) bits |= (number >> 2 * i & 1u) << i;
    return bits;
}

static void start_ray(const whitted_job *job, const spt_ray *seen, uint32_t pixel,
                      whitted_work *work) {
    whitted_ray *const ray = whitted_push(&work->air);
    if (ray == NULL) {
        work->failed = 1;
        return;
    }
    ray->ray = *seen;
    ray->path = 0.0f;
    for (int c = 0; c < 3; ++c) ray->weight[c] = 1.0f;
    ray->pixel = pixel;
    ray->from = ray->inside = GLASS_NOTHING;
    ray->active = 1;
    ray->reflections = (int16_t)job->settings->reflections;
    ray->refractions = (int16_t)job->settings->refractions;
}

/* The rays of the camera through a tile, in Morton order, so that 256 in a row are close. */
static void start_tile(const whitted_job *job, uint32_t left, uint32_t top, whitted_work *work) {
    float x[SPT_BATCH], y[SPT_BATCH];
    spt_camera_ray seen[SPT_BATCH];
    for (uint32_t first = 0; first < tile * tile; first += SPT_BATCH) {
        for (uint32_t i = 0; i < SPT_BATCH; ++i) {
            x[i] = (float)(left + every_other_bit(first + i)) + 0.5f;
            y[i] = (float)(top + every_other_bit((first + i) >> 1)) + 0.5f;
        }
        if (spt_camera_rays(&job->camera, job->width, job->height, SPT_BATCH, x, y, seen)) {
            work->failed = 1;
        }
        for (uint32_t i = 0; i < SPT_BATCH && !work->failed; ++i) {
            if (x[i] < (float)job->width && y[i] < (float)job->height) {
                start_ray(job, &seen[i].ray, (uint32_t)y[i] * job->width + (uint32_t)x[i], work);
            }
        }
    }
}

static void swap(whitted_queue *now, whitted_queue *next) {
    const whitted_queue kept = *now;
    *now = *next;
    *next = kept;
    next->count = 0;
}

static void render_tile(const whitted_job *job, size_t index, whitted_work *work) {
    const uint32_t across = (job->width + tile - 1) / tile;
    whitted_kind kind = WHITTED_PRIMARY;
    start_tile(job, (uint32_t)index % across * tile, (uint32_t)index / across * tile, work);
    while (!work->failed && work->air.count + work->body.count > 0) {
        whitted_trace_air(work, kind);
        whitted_trace_body(work);
        swap(&work->air, &work->next_air);
        swap(&work->body, &work->next_body);
        kind = WHITTED_OUTSIDE;
    }
    whitted_trace_shadows(work);
}

static void render_tiles(void *user, workers *all) {
    whitted_job *const job = user;
    whitted_work work;
    size_t index;
    memset(&work, 0, sizeof work);
    work.world = job->world;
    work.settings = job->settings;
    work.field = job->field;
    work.pixel_radius = job->pixel_radius;
    work.pixels = job->pixels;
    work.tracing = spt_settings_default();
    work.tracing.method = job->settings->method;
    work.tracing.budget = job->settings->budget;
    work.tracing.epsilon = job->settings->epsilon;
    work.tracing.max_lanes = job->settings->max_lanes;
    work.tracing.pixel_radius = job->settings->pixel_cone ? job->pixel_radius : 0.0f;
    work.tracing.flags = SPT_SKIP_START;
    work.statistics = no_statistics();
    while (!work.failed && workers_take(all, &index)) {
        render_tile(job, index, &work);
        workers_finish(all);
    }
    if (work.failed) workers_stop(all);
    workers_lock(all);
    add_statistics(job->statistics, &work.statistics);
    job->failed |= work.failed;
    workers_unlock(all);
    whitted_free(&work);
}

int whitted_render(glass_world *world, const whitted_settings *settings, int width, int height,
                   float *pixels, whitted_statistics *statistics) {
    const clock_t begun = clock();
    const size_t count = (size_t)width * (size_t)height;
    const size_t tiles = (size_t)((width + tile - 1) / tile) * (size_t)((height + tile - 1) / tile);
    const int lanes = spt_lanes(), most = (int)settings->max_lanes;
    whitted_job job;
    job.world = world;
    job.settings = settings;
    job.width = (uint32_t)width;
    job.height = (uint32_t)height;
    job.camera = scene_camera(world->body, job.width, job.height);
    job.field = glass_world_field(world, most != 0 && most < lanes ? most : lanes);
    job.pixel_radius = (job.camera.x_high - job.camera.x_low) / (2.0f * (float)width);
    job.pixels = pixels;
    job.statistics = statistics;
    job.failed = 0;
    *statistics = no_statistics();
    memset(pixels, 0, count * 3 * sizeof *pixels);
    if (settings->inside_evaluations != NULL) {
        memset(settings->inside_evaluations, 0, count * sizeof *settings->inside_evaluations);
    }
    const size_t done = workers_run(settings->threads, 0, tiles, render_tiles, &job, world->name);
    statistics->cpu_seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    return done == tiles && !job.failed;
}

void whitted_develop(float *pixels, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const float x = 0.55f * pixels[i];
        const float shown = x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
        pixels[i] = spt_clamp(shown, 0.0f, 1.0f);
    }
}
