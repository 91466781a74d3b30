/* SPDX-License-Identifier: MIT
 *
 * What the lazy union does for every ray: units, entries into bounds, the nearest component, and
 * whether a march may go on. A template over SPT_LANES. Defines union_units(), union_entries(),
 * union_least() and union_stop(), as in spti_union_kernels. */
#ifndef SPTI_UNION_KERNEL_H
#define SPTI_UNION_KERNEL_H

#include "../trace/prepare_kernel.h"
#include "union.h"

/* Where a chunk whose rays are in their own units, but of no component yet, holds what it takes to
 * cut them with bounds. */
enum { UNION_LENGTH = SPTI_SCALE, UNION_REACH = SPTI_FLOOR_AT_0, UNION_POWER = SPTI_EPSILON };

SPTI_INLINE void union_units(spti_chunk *chunk, size_t count) {
    const spt_wide one = spt_splat(1.0f);
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        unsigned bad = 0;
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            const size_t at = group * SPTI_GROUP + shift;
            prepare_rays rays;
            prepare_load(chunk, at, &rays);
            const spt_wide unit = prepare_units(&rays);
            for (int axis = 0; axis < 3; ++axis) {
                spt_store(&chunk->array[SPTI_ORIGIN + axis][at], rays.ray.origin[axis]);
                spt_store(&chunk->array[SPTI_DIRECTION + axis][at], rays.ray.direction[axis]);
            }
            spt_store(&chunk->array[UNION_LENGTH][at], rays.ray.length);
            spt_store(&chunk->array[UNION_REACH][at], rays.ray.reach);
            spt_store(&chunk->array[UNION_POWER][at], spt_div(one, unit));
            spt_store(&chunk->array[SPTI_T][at], rays.t_min);
            spt_store(&chunk->array[SPTI_T_MAX][at], rays.t_max);
            spt_store(&chunk->unit[at], unit);
            bad |= (~spt_mask_bits(rays.good) & SPTI_EVERY_LANE) << shift;
        }
        chunk->fates[group].bad = (uint16_t)bad;
    }
}

SPTI_INLINE void union_entries(const spti_chunk *chunk, const spt_bound *bound, size_t count,
                               float *starts) {
    for (size_t at = 0; at < count; at += SPT_LANES) {
        interval_ray ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = spt_load(&chunk->array[SPTI_ORIGIN + axis][at]);
            ray.direction[axis] = spt_load(&chunk->array[SPTI_DIRECTION + axis][at]);
        }
        ray.length = spt_load(&chunk->array[UNION_LENGTH][at]);
        ray.reach = spt_load(&chunk->array[UNION_REACH][at]);
        const spt_wide power = spt_load(&chunk->array[UNION_POWER][at]);
        spt_wide t_max = spt_load(&chunk->array[SPTI_T_MAX][at]);
        spt_wide t_min =
            spt_max(spt_mul(spt_load(&starts[at]), power), spt_load(&chunk->array[SPTI_T][at]));
        if (bound != NULL) interval_of_bound(bound, &ray, &t_min, &t_max);
        const spt_mask met = spt_less_equal(t_min, t_max);
        const spt_wide entry = spt_mul(t_min, spt_load(&chunk->unit[at]));
        spt_store(&starts[at], spt_select(met, entry, spt_splat(INFINITY)));
    }
}

SPTI_INLINE void union_least(const spti_union *lazy, size_t group_count) {
    for (size_t i = 0; i < group_count; ++i) {
        for (size_t shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            const size_t at = (size_t)lazy->groups[i] * SPTI_GROUP + shift;
            spt_wide least = spt_splat(INFINITY), second = least, which = spt_splat(0.0f);
            for (size_t place = 0; place < lazy->listed; ++place) {
                const spt_wide key = spt_load(&spti_union_keys(lazy, place)[at]);
                const spt_mask nearer = spt_less(key, least);
                second = spt_select(nearer, least, spt_min(key, second));
                least = spt_select(nearer, key, least);
                which = spt_select(nearer, spt_splat((float)place), which);
            }
            spt_store(&lazy->least[at], least);
            spt_store(&lazy->second[at], second);
            spt_store(&lazy->which[at], which);
        }
    }
}

SPTI_INLINE int union_stop(spti_chunk *chunk, size_t count) {
    unsigned any = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        const size_t left = count - group * SPTI_GROUP;
        unsigned stopped = 0;
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            const size_t at = group * SPTI_GROUP + shift;
            const spt_wide value = spt_load(&chunk->array[SPTI_VALUE][at]);
            const spt_wide radius = spt_mul(value, spt_load(&chunk->array[SPTI_SCALE][at]));
            const spt_wide free = spt_add(spt_load(&chunk->array[SPTI_T][at]), radius);
            const spt_mask stops = spt_less_equal(spt_load(&chunk->array[SPTI_STOP][at]), free);
            stopped |= spt_mask_bits(stops) << shift;
        }
        if (left < SPTI_GROUP) stopped &= (1u << left) - 1u;
        stopped &= ~(unsigned)chunk->fates[group].finished;
        chunk->fates[group].stopped = (uint16_t)stopped;
        chunk->fates[group].finished = (uint16_t)(chunk->fates[group].finished | stopped);
        any |= chunk->fates[group].finished;
    }
    return any != 0;
}

#endif
