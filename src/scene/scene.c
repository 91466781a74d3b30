/* SPDX-License-Identifier: MIT
 *
 * The public door of scenes: checks the arguments, makes a call of every component, and traces the
 * rays in pools whose tasks are sorted by component. */
#include "scene_call.h"

#include "../base/arguments.h"

enum { POOL = 4 * SPT_BATCH };

/* The fields stand as far apart as the caller's header says. */
static const spt_field *field_at(const spt_scene *scene, size_t component) {
    const char *const first = (const char *)scene->fields;
    return (const spt_field *)(const void *)(first + component * scene->fields->struct_size);
}

static int zone_is_good(const spt_zone *zone, size_t components) {
    return spti_finite(zone->center[0]) && spti_finite(zone->center[1]) &&
           spti_finite(zone->center[2]) && zone->radius > 0.0f && spti_finite(zone->radius) &&
           zone->component >= -1 && zone->component < (int32_t)components;
}

int spti_scene_copy(spt_scene *to, const spt_scene *from) {
    *to = spt_scene_default();
    if (from == NULL || !spti_copy_sized(to, from, sizeof *to)) return 0;
    if (to->fields == NULL || to->count == 0 || to->count > SPTI_MOST_COMPONENTS) return 0;
    if (to->zone_count > SPTI_MOST_ZONES || (to->zone_count > 0 && to->zones == NULL)) return 0;
    for (size_t i = 0; i < to->zone_count; ++i) {
        if (!zone_is_good(&to->zones[i], to->count)) return 0;
    }
    return 1;
}

/* A convex field takes secant steps; the others march by the rule that the caller chose. */
static const spt_method *method_of(const spt_field *field, const spt_settings *settings) {
    return (field->flags & SPT_FIELD_CONVEX) != 0 ? spt_convex() : settings->method;
}

int spti_scene_check(const spt_scene *scene, const spt_settings *settings) {
    const size_t size = scene->fields->struct_size;
    if (size < sizeof(spt_field)) return 0;
    for (size_t i = 0; i < scene->count; ++i) {
        spt_field field;
        spt_bound bound;
        if (field_at(scene, i)->struct_size != size) return 0;
        if (!spti_field_copy(&field, &bound, field_at(scene, i))) return 0;
        if (!spti_method_allowed(method_of(&field, settings), &field)) return 0;
    }
    return 1;
}

void spti_scene_call(spti_call *call, spti_union *lazy, const spt_scene *scene, size_t component,
                     const spt_settings *settings, const spt_hits *hits,
                     spt_statistics *statistics) {
    memset(call, 0, sizeof *call);
    spti_field_copy(&call->field, &call->bound, field_at(scene, component));
    call->settings = *settings;
    call->settings.method = method_of(&call->field, settings);
    call->hits = hits;
    call->statistics = statistics;
    call->one_origin = lazy->one_origin;
    call->leave = spti_union_leave;
    call->owner = lazy;
    call->allowance = &lazy->allowance;
    call->stop = spti_union_kernels_of[spti_isa_choose(settings->max_lanes)]->stop;
    spti_call_settle(call);
}

/* ---- The call ------------------------------------------------------------------------------- */

typedef struct scene_room {
    spti_call *calls;
    uint32_t *list;
    spti_union *lazy;
    void *arrays;
    size_t size; /* of all, alignment included */
} scene_room;

/* With memory NULL only counts. Returns 0 where the size exceeds size_t. */
static int lay_out(scene_room *room, void *memory, size_t components) {
    const size_t arrays = spti_union_size(components, POOL);
    const size_t start = ((uintptr_t)memory + 63) / 64 * 64 - (uintptr_t)memory;
    char *const base = memory != NULL ? (char *)memory + start : NULL;
    const size_t lazy = (sizeof *room->lazy + 63) / 64 * 64;
    const size_t calls = (components * sizeof *room->calls + 63) / 64 * 64;
    const size_t list = (components * sizeof *room->list + 63) / 64 * 64;
    if (arrays == 0) return 0;
    room->size = 63 + lazy + calls + list + arrays;
    if (base == NULL) return 1;
    room->lazy = (spti_union *)(void *)base;
    room->calls = (spti_call *)(void *)(base + lazy);
    room->list = (uint32_t *)(void *)(base + lazy + calls);
    room->arrays = base + lazy + calls + list;
    return 1;
}

static int take_in(spt_scene *scene, spt_settings *settings, const spt_scene *from,
                   const spt_settings *chosen) {
    return spti_scene_copy(scene, from) && spti_settings_copy(settings, chosen) &&
           spti_scene_check(scene, settings);
}

size_t spt_scene_workspace(const spt_scene *scene, const spt_settings *settings) {
    spt_scene copy;
    spt_settings chosen;
    scene_room room;
    if (!take_in(&copy, &chosen, scene, settings)) return 0;
    return lay_out(&room, NULL, copy.count) ? room.size : 0;
}

void spti_union_scene(spti_union *lazy, spti_call *calls, uint32_t *list, const spt_scene *scene,
                      const spt_settings *settings) {
    lazy->calls = calls;
    lazy->list = list;
    lazy->listed = scene->count;
    lazy->zones = scene->zones;
    lazy->zone_count = scene->zone_count;
    lazy->budget = settings->budget;
    lazy->isa = spti_isa_choose(settings->max_lanes);
    lazy->epsilon = settings->epsilon;
    lazy->allowance = INT64_MAX;
    lazy->one_origin = 0;
}

static void trace_pools(spti_union *lazy, size_t count, const spt_rays *rays, const spt_hits *hits,
                        spt_statistics *statistics) {
    for (size_t first = 0; first < count; first += POOL) {
        const size_t size = count - first < POOL ? count - first : POOL;
        spti_union_clear(lazy);
        for (size_t window = 0; window < size; window += SPT_BATCH) {
            const size_t left = size - window;
            spti_union_add(lazy, rays, first + window, left < SPT_BATCH ? left : SPT_BATCH);
        }
        spti_union_enter(lazy, NULL);
        spti_union_run(lazy);
        spti_union_write(lazy, hits, first, NULL);
        if (statistics != NULL) spti_union_count(lazy, statistics);
    }
}

spt_status spt_scene_trace(const spt_scene *scene, const spt_settings *settings, size_t count,
                           const spt_rays *rays, const spt_hits *hits, void *workspace,
                           size_t workspace_size, spt_statistics *statistics) {
    spt_scene copy;
    spt_settings chosen;
    scene_room room;
    if (!take_in(&copy, &chosen, scene, settings)) return SPT_BAD_ARGUMENT;
    if (statistics != NULL && statistics->struct_size < sizeof *statistics) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (rays == NULL || hits == NULL || workspace == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_views_fit(rays, hits, count)) return SPT_BAD_ARGUMENT;
    if (!lay_out(&room, workspace, copy.count)) return SPT_BUFFER_TOO_SMALL;
    if (workspace_size < room.size) return SPT_BUFFER_TOO_SMALL;
    spti_union_place(room.lazy, room.arrays, copy.count, POOL);
    spti_union_scene(room.lazy, room.calls, room.list, &copy, &chosen);
    for (size_t i = 0; i < copy.count; ++i) {
        spti_scene_call(&room.calls[i], room.lazy, &copy, i, &chosen, hits, statistics);
        room.list[i] = (uint32_t)i;
    }
    if (statistics != NULL) statistics->lanes = (uint32_t)spti_isa_lanes(room.lazy->isa);
    trace_pools(room.lazy, count, rays, hits, statistics);
    return SPT_OK;
}
