/* SPDX-License-Identifier: MIT
 *
 * The chunks of a tile traced: those that meet nothing or one component at once, the others in
 * pools, as a lazy union. */
#include <float.h>
#include <math.h>

#include "desk.h"

/* Puts the chunk's rays into the pool, with how far its blocks came along each component. */
static void pool_chunk(spti_desk *desk) {
    const size_t chunk = desk->pooled++, row = desk->most_pooled * SPTI_BUNDLES;
    for (size_t i = 0; i < desk->chunk_listed; ++i) {
        const uint32_t component = desk->chunk_list[i];
        float *const t = desk->pool_t + component * row;
        if (!desk->in_pool[component]) {
            for (size_t k = 0; k < row; ++k) t[k] = INFINITY;
            desk->in_pool[component] = 1;
        }
        memcpy(t + chunk * SPTI_BUNDLES, desk->block_t + (size_t)component * SPTI_BUNDLES,
               SPTI_BUNDLES * sizeof *t);
    }
    memcpy(desk->places + chunk * SPT_BATCH, desk->own_places, sizeof desk->own_places);
    spti_desk_fill_rays(desk);
    spti_union_add(&desk->lazy, &desk->columns, 0, SPT_BATCH);
}

/* Lists the pool's components, and where its rays start along each of them. */
static void list_pool(spti_desk *desk) {
    const size_t row = desk->most_pooled * SPTI_BUNDLES;
    size_t listed = 0;
    for (size_t i = 0; i < desk->tile_listed; ++i) {
        const uint32_t component = desk->tile_list[i];
        const float *const t = desk->pool_t + component * row;
        float *const starts = desk->starts + listed * desk->lazy.pool;
        if (!desk->in_pool[component]) continue;
        for (size_t block = 0; block < desk->pooled * SPTI_BUNDLES; ++block) {
            for (size_t k = 0; k < SPTI_GROUP; ++k) starts[block * SPTI_GROUP + k] = t[block];
        }
        desk->list[listed++] = component;
        desk->in_pool[component] = 0;
    }
    desk->lazy.listed = listed;
}

void spti_desk_open(spti_desk *desk, const float *starts) {
    desk->pooled = 0;
    spti_union_clear(&desk->lazy);
    pool_chunk(desk);
    list_pool(desk);
    for (size_t place = 0; starts != NULL && place < desk->lazy.listed; ++place) {
        float *const t = desk->starts + place * desk->lazy.pool;
        for (size_t i = 0; i < SPT_BATCH; ++i) t[i] = starts[i] > t[i] ? starts[i] : t[i];
    }
    desk->next = 0;
    desk->walks = 0;
}

void spti_desk_enter(spti_desk *desk) {
    spti_union_enter(&desk->lazy, desk->starts);
}

void spti_desk_flush(spti_desk *desk, const spt_hits *image) {
    if (desk->pooled == 0) return;
    list_pool(desk);
    spti_union_enter(&desk->lazy, desk->starts);
    spti_union_run(&desk->lazy);
    spti_desk_write(desk, image);
    desk->pooled = 0;
    spti_union_clear(&desk->lazy);
}

/* ---- Tracing -------------------------------------------------------------------------------- */

/* A chunk that can meet nothing. */
static void miss_all(spti_desk *desk, const spt_hits *image) {
    const int32_t *const active = desk->all ? NULL : desk->active;
    uint64_t rays = 0;
    spti_write_misses(SPT_BATCH, active, desk->own_places, image);
    for (size_t i = 0; i < SPT_BATCH; ++i) rays += active == NULL || active[i] != 0;
    if (desk->statistics != NULL) {
        desk->statistics->rays += rays;
        desk->statistics->outcomes[SPT_MISS] += rays;
    }
}

/* A chunk that can meet one component only needs no union: it is traced as spt_trace() does. */
static void trace_alone(spti_desk *desk, const spt_hits *image) {
    const uint32_t component = desk->chunk_list[0];
    const float *const t = desk->block_t + (size_t)component * SPTI_BUNDLES;
    spt_rays columns = desk->columns;
    spti_call call = *spti_desk_call(desk, component);
    const int owns = spti_desk_owns_rays(desk);
    spti_desk_fill_rays(desk);
    for (size_t block = 0; block < SPTI_BUNDLES; ++block) {
        const float start = t[block] < FLT_MAX ? t[block] : FLT_MAX;
        float *const t_min = desk->t_min + block * SPTI_GROUP;
        for (size_t i = 0; i < SPTI_GROUP; ++i) {
            const float own = owns ? t_min[i] : desk->job->view.t_min;
            t_min[i] = own >= 0.0f && start > own ? start : own; /* a bad ray stays one */
        }
    }
    spti_set_column(&columns.t_min, desk->t_min, 4);
    call.rays = &columns;
    call.hits = image;
    call.places = desk->own_places;
    call.component = (int32_t)component;
    call.leave = spti_write_hits;
    call.stop = NULL;
    call.allowance = NULL;
    spti_call_settle(&call);
    call.field.lipschitz = 1.0f; /* slopes are counted relative to it */
    spti_trace_chunk(&call, &desk->lazy.chunk, 0, SPT_BATCH);
}

void spti_desk_trace(spti_desk *desk, const spt_hits *image) {
    /* Zones are the union's business, and it knows where a ray began whose start is skipped. */
    const int needs_union =
        desk->lazy.zone_count > 0 || (desk->settings.flags & SPT_SKIP_START) != 0;
    const int may_be_bad = spti_desk_owns_rays(desk) || desk->job->frame.t_max.first != NULL;
    if (desk->chunk_listed == 0 && !may_be_bad) {
        miss_all(desk, image);
    } else if (desk->chunk_listed == 1 && !needs_union) {
        trace_alone(desk, image);
    } else {
        pool_chunk(desk);
        if (desk->pooled == desk->most_pooled) spti_desk_flush(desk, image);
    }
}

void spti_desk_write(const spti_desk *desk, const spt_hits *image) {
    if (image != NULL) spti_union_write(&desk->lazy, image, 0, desk->places);
    if (desk->statistics != NULL) spti_union_count(&desk->lazy, desk->statistics);
}
