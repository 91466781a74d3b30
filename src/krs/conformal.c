/* SPDX-License-Identifier: MIT
 *
 * A field under one Möbius map: as a field of its own, by the largest ball around a point that is
 * free, and by the exits of unbounding balls that are not centered at the point (Szécsi et al. 2016,
 * section 6). */
#define SPT_LANES 1
#include <float.h>
#include <math.h>

#include "../base/marks.h"
#include "../bound/bound_check.h"
#include "../trace/slot.h"
#include "locate.h"
#include "mobius_build.h"
#include "own_pass.h"

static spti_stretch stretch_of(const spt_conformal *conformal) {
    const spti_stretch model = {1, 1, 0, 1, 0, conformal->kernels, NULL, &conformal->map, 1};
    return model;
}

/* Points on their way to the field, and the field's answer there. */
typedef struct conformal_points {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH];
    SPTI_ALIGNED(64) float shrink[SPT_BATCH], reach[SPT_BATCH], clear[SPT_BATCH];
} conformal_points;

static spti_way way_of(conformal_points *points, float *distance) {
    const spti_way way = {.x = points->x,
                          .y = points->y,
                          .z = points->z,
                          .distance = distance,
                          .shrink = points->shrink,
                          .reach = points->reach,
                          .clear = points->clear};
    return way;
}

static void take_points(conformal_points *points, size_t n, const float *x, const float *y,
                        const float *z) {
    memcpy(points->x, x, n * sizeof *x);
    memcpy(points->y, y, n * sizeof *y);
    memcpy(points->z, z, n * sizeof *z);
}

static void conformal_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *distance) {
    const spt_conformal *const conformal = user;
    const spti_stretch model = stretch_of(conformal);
    conformal_points points;
    const spti_way way = way_of(&points, distance);
    take_points(&points, n, x, y, z);
    spti_walk(&model, SPTI_WALK_PULL, conformal->max_lanes, n, &way);
    spti_settle_far(n, x, y, z, distance);
}

static void conformal_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *gradient_x, float *gradient_y, float *gradient_z) {
    const spti_stretch model = stretch_of(user);
    spti_place_gradients(&model, 0.0f, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

spt_status spt_conformal_field(const spt_field *field, const spt_mobius *map, spt_conformal *memory,
                               spt_field *result) {
    spt_conformal made;
    spti_ball ball;
    if (field == NULL || map == NULL || memory == NULL || result == NULL) return SPT_BAD_ARGUMENT;
    memset(&made, 0, sizeof made);
    const spt_kernel inner = spt_kernel_field(field), nothing = spt_kernel_empty();
    if (!spti_build_kernel(&nothing, &made.kernels[1], &ball)) return SPT_BAD_ARGUMENT;
    if (!spti_build_kernel(&inner, &made.kernels[0], &ball)) return SPT_BAD_ARGUMENT;
    if (!spti_build_map(map, &made.map)) return SPT_BAD_ARGUMENT;
    ball = spti_map_ball(&ball, map);
    spti_map_whole(&ball, &made.map);
    const int bounded = spti_bound_of_ball(&ball, &made.bound);
    *memory = made;
    *result = spt_field_default();
    result->batch = conformal_distance;
    result->user = memory;
    result->glsl = spti_mark_conformal;
    result->bound = bounded ? &memory->bound : NULL;
    if (made.kernels[0].gradient != NULL) result->gradient = conformal_gradient;
    return SPT_OK;
}

/* ---- By exits --------------------------------------------------------------------------------- */

/* What the driver evaluates. */
typedef struct conformal_exits {
    spti_own_field own;
    const spt_conformal *conformal;
} conformal_exits;

/* The way to the exit, world length, in the direction of the ray in a slot: shrink is 1 / U, reach
 * |c| / |u|, so that h = rho U and k = h |c| / |u|. */
static float exit_of(const spti_chunk *chunk, size_t slot, const spt_built_map *map, float rho,
                     float shrink, float reach) {
    const float h = rho / shrink, k = h * reach;
    float square = 0.0f, along = 0.0f;
    if (!(map->c_length > 0.0f)) return h;
    for (int axis = 0; axis < 3; ++axis) {
        const float direction = chunk->array[SPTI_DIRECTION + axis][slot];
        const float from_pole = chunk->array[SPTI_X + axis][slot] - map->pole[axis];
        along += from_pole * direction;
        square += from_pole * from_pole;
    }
    /* SCALE is one over the direction's length. */
    float cosine = along * fabsf(chunk->array[SPTI_SCALE][slot]) / sqrtf(square);
    cosine = cosine < 1.0f ? cosine > -1.0f ? cosine : -1.0f : 1.0f;
    const float rest = 1.0f - k * k * (1.0f - cosine) * (1.0f + cosine);
    if (rest < 0.0f) return INFINITY;
    const float root = sqrtf(rest);
    if (cosine <= 0.0f) return h / (root - k * cosine);
    return k < 1.0f ? h * (root + k * cosine) / ((1.0f - k) * (1.0f + k)) : INFINITY;
}

static void ask_exits(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    const conformal_exits *const exits = user;
    const spt_conformal *const conformal = exits->conformal;
    const spti_chunk *const chunk = exits->own.chunk;
    const spti_isa isa = spti_isa_choose(conformal->max_lanes);
    spti_stretch stretch = stretch_of(conformal);
    conformal_points points;
    const spti_way way = way_of(&points, distance);
    SPTI_ALIGNED(64) float rho[SPT_BATCH];
    take_points(&points, n, x, y, z);
    stretch.goes_on = 1;
    spti_krs_kernels_of[isa]->pull(&stretch, n, &way);
    spti_ask_kernel(&conformal->kernels[0], n, &way, rho);
    for (size_t slot = 0; slot < n; ++slot) {
        const float shrink = points.shrink[slot], reach = points.reach[slot];
        distance[slot] = spti_free_radius(rho[slot], shrink, reach);
        if (points.clear[slot] > 0.0f && distance[slot] < points.clear[slot]) {
            distance[slot] = points.clear[slot];
        }
        /* The exit of a ball that nearly reaches infinity makes much of little: the kernel's
         * distance is held to what rounding of the point where it was asked leaves certain. */
        const float magnitude =
            fabsf(points.x[slot]) + fabsf(points.y[slot]) + fabsf(points.z[slot]);
        const float noise = 0x1p-20f * (magnitude + fabsf(rho[slot]));
        const float certain = rho[slot] < 0x1p64f ? rho[slot] - noise : 0x1p64f;
        chunk->array[SPTI_MEMORY][slot] =
            certain > 0.0f ? exit_of(chunk, slot, &conformal->map, certain, shrink, reach) : 0.0f;
    }
    spti_settle_far(n, x, y, z, distance);
}

/* One step of a ray, by the exit of the ball that its sample told. */
static void step(spti_chunk *chunk, const spti_march *march, size_t slot, uint16_t bit,
                 spti_fates *fates) {
    const float value = chunk->distance[slot], t = chunk->array[SPTI_PROBE][slot];
    const float scale = fabsf(chunk->array[SPTI_SCALE][slot]);
    const float floor = ray_floor(chunk->array[SPTI_FLOOR_AT_0][slot], t);
    const float tolerance = ray_tolerance(chunk->array[SPTI_EPSILON][slot], march->pixel_radius,
                                          chunk->array[SPTI_PATH][slot], floor, t);
    const float t_max = chunk->array[SPTI_T_MAX][slot];
    float radius = chunk->array[SPTI_MEMORY][slot] * scale;
    chunk->array[SPTI_T][slot] = t;
    chunk->array[SPTI_VALUE][slot] = value;
    fates->finished |= bit;
    if (!(value >= -FLT_MAX)) {
        fates->nonfinite |= bit;
    } else if (value * scale < tolerance) {
        fates->hit |= bit;
    } else {
        if (!(radius > value * scale)) radius = value * scale;
        if (!(t + radius <= t_max)) {
            fates->missed |= bit;
        } else if (t + radius > t) {
            fates->finished ^= bit;
            chunk->array[SPTI_PROBE][slot] = t + radius;
            spti_slot_point(chunk, slot, slot, t + radius);
        }
    }
}

static int exit_pass(spti_chunk *chunk, const spti_march *march, size_t count, int first) {
    unsigned any = 0;
    (void)first;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = {0, 0, 0, 0, 0, 0, 0};
        for (size_t i = 0; i < SPTI_GROUP && group * SPTI_GROUP + i < count; ++i) {
            step(chunk, march, group * SPTI_GROUP + i, (uint16_t)(1u << i), &fates);
        }
        chunk->fates[group] = fates;
        any |= fates.finished;
    }
    return any != 0;
}

spt_status spt_conformal_trace(const spt_conformal *conformal, const spt_settings *settings,
                               size_t count, const spt_rays *rays, const spt_hits *hits,
                               spt_statistics *statistics) {
    const spti_own_numbers none = {{0, 0, 0, 0}};
    conformal_exits exits;
    spti_call call;
    if (conformal == NULL) return SPT_BAD_ARGUMENT;
    memset(&call, 0, sizeof call);
    exits.conformal = conformal;
    call.field = spt_field_default();
    call.field.batch = ask_exits;
    call.field.user = &exits;
    if (conformal->bound.struct_size != 0) {
        if (!spti_bound_copy(&call.bound, &conformal->bound)) return SPT_BAD_ARGUMENT;
        call.field.bound = &call.bound;
    }
    return spti_trace_by(&call, &exits.own, exit_pass, &none, settings, count, rays, hits,
                         statistics);
}
