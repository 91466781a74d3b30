/* SPDX-License-Identifier: MIT
 *
 * The renderer's generations, one after another, each written down once it was traced. */
#include "keinert_record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "keinert_bench.h"

enum { TILE = 64 };

/* Every other bit of a number, from the lowest on. */
static uint32_t every_other_bit(uint32_t number) {
    uint32_t bits = 0;
    for (int i = 0; i < 16; ++i) bits |= (number >> 2 * i & 1u) << i;
    return bits;
}

static void start_ray(whitted_work *work, const spt_ray *seen) {
    whitted_ray *const ray = whitted_push(&work->air);
    if (ray == NULL) keinert_expect(SPT_BAD_ARGUMENT, "out of memory");
    memset(ray, 0, sizeof *ray);
    ray->ray = *seen;
    for (int c = 0; c < 3; ++c) ray->weight[c] = 1.0f;
    ray->from = ray->inside = GLASS_NOTHING;
    ray->active = 1;
    ray->reflections = (int16_t)work->settings->reflections;
    ray->refractions = (int16_t)work->settings->refractions;
}

/* The rays of the eye through a tile, in the renderer's order. */
static void start_tile(whitted_work *work, const spt_camera *camera, uint32_t width,
                       uint32_t height, uint32_t left, uint32_t top) {
    for (uint32_t i = 0; i < TILE * TILE; ++i) {
        const float x = (float)(left + every_other_bit(i)) + 0.5f;
        const float y = (float)(top + every_other_bit(i >> 1)) + 0.5f;
        spt_camera_ray seen;
        if (x > (float)width || y > (float)height) continue;
        keinert_expect(spt_camera_rays(camera, width, height, 1, &x, &y, &seen), "spt_camera_rays");
        start_ray(work, &seen.ray);
    }
}

/* Keeps those that were traced: balls keep others, which are not active. */
static void keep(whitted_queue *kept, const whitted_queue *traced) {
    for (size_t i = 0; i < traced->count; ++i) {
        if (!traced->rays[i].active) continue;
        whitted_ray *const ray = whitted_push(kept);
        if (ray == NULL) keinert_expect(SPT_BAD_ARGUMENT, "out of memory");
        *ray = traced->rays[i];
    }
}

static void swap(whitted_queue *now, whitted_queue *next) {
    const whitted_queue kept = *now;
    *now = *next;
    *next = kept;
    next->count = 0;
}

static void record_tile(whitted_work *work, keinert_record *record) {
    whitted_kind kind = WHITTED_PRIMARY;
    while (!work->failed && work->air.count + work->body.count > 0) {
        whitted_trace_air(work, kind);
        whitted_trace_body(work);
        keep(&record->of[kind], &work->air);
        keep(&record->of[WHITTED_INSIDE], &work->body);
        swap(&work->air, &work->next_air);
        swap(&work->body, &work->next_body);
        kind = WHITTED_OUTSIDE;
    }
    work->shadows.count = 0;
    if (work->failed) keinert_expect(SPT_BAD_ARGUMENT, "the renderer failed");
}

spt_settings keinert_record_settings(const keinert_record *record, whitted_kind kind,
                                     const spt_method *method) {
    spt_settings settings = spt_settings_default();
    settings.method = method;
    settings.pixel_radius = record->pixel_radius;
    settings.flags = kind == WHITTED_PRIMARY ? 0 : SPT_SKIP_START;
    return settings;
}

void keinert_record_rays(const glass_world *world, const spt_field *field, int width, int height,
                         size_t step, keinert_record *record) {
    const whitted_settings settings = whitted_settings_default();
    const uint32_t across = ((uint32_t)width + TILE - 1) / TILE;
    const uint32_t down = ((uint32_t)height + TILE - 1) / TILE;
    const spt_camera camera = scene_camera(world->body, (uint32_t)width, (uint32_t)height);
    whitted_work work;
    memset(record, 0, sizeof *record);
    memset(&work, 0, sizeof work);
    record->pixel_radius = (camera.x_high - camera.x_low) / (2.0f * (float)width);
    work.world = world;
    work.settings = &settings;
    work.field = *field;
    work.pixel_radius = record->pixel_radius;
    work.tracing = keinert_record_settings(record, WHITTED_OUTSIDE, settings.method);
    for (int kind = 0; kind < whitted_kinds; ++kind) {
        work.statistics.of[kind] = spt_statistics_default();
    }
    work.pixels = keinert_allocate(3 * sizeof *work.pixels); /* all rays are of pixel 0 */
    for (size_t tile = 0; tile < (size_t)across * down; tile += step) {
        start_tile(&work, &camera, (uint32_t)width, (uint32_t)height,
                   (uint32_t)tile % across * TILE, (uint32_t)tile / across * TILE);
        record_tile(&work, record);
    }
    free(work.pixels);
    whitted_free(&work);
}

void keinert_record_free(keinert_record *record) {
    for (int kind = 0; kind < KEINERT_KINDS; ++kind) free(record->of[kind].rays);
}
