/* SPDX-License-Identifier: MIT
 *
 * What the lazy union does for every ray: units, entries into bounds, the nearest component, and
 * the way into and out of a chunk. A template over SPT_LANES. Defines what spti_union_kernels
 * lists. */
#ifndef SPTI_UNION_KERNEL_H
#define SPTI_UNION_KERNEL_H

#include "../bound/volume_kernel.h"
#include "../trace/compact_kernel.h"
#include "../trace/prepare_kernel.h"
#include "union.h"

SPTI_INLINE void union_begin(spti_union *lazy, size_t window, size_t count) {
    spti_chunk *const chunk = &lazy->chunk;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        unsigned bad = 0;
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            const size_t at = group * SPTI_GROUP + shift, to = window + at;
            prepare_rays rays;
            prepare_load(chunk, at, &rays);
            const spt_wide unit = prepare_units(&rays);
            const spt_wide length = rays.ray.length;
            for (int axis = 0; axis < 3; ++axis) {
                spt_store(&spti_union_row(lazy, SPTI_ROW_ORIGIN + axis)[to], rays.ray.origin[axis]);
                spt_store(&spti_union_row(lazy, SPTI_ROW_DIRECTION + axis)[to],
                          rays.ray.direction[axis]);
            }
            spt_store(&spti_union_row(lazy, SPTI_ROW_LENGTH)[to], length);
            spt_store(&spti_union_row(lazy, SPTI_ROW_REACH)[to], rays.ray.reach);
            spt_store(&spti_union_row(lazy, SPTI_ROW_UNIT)[to], unit);
            spt_store(&spti_union_row(lazy, SPTI_ROW_POWER)[to], rays.power);
            spt_store(&spti_union_row(lazy, SPTI_ROW_T_MIN)[to], rays.t_min);
            spt_store(&spti_union_row(lazy, SPTI_ROW_T_MAX)[to], rays.t_max);
            spt_store(&spti_union_row(lazy, SPTI_ROW_EPSILON)[to],
                      prepare_epsilon(lazy->epsilon, length));
            if (!lazy->one_origin) {
                spt_store(&spti_union_row(lazy, SPTI_ROW_PATH)[to], spt_div(rays.path, length));
            }
            for (int row = SPTI_ROW_NEAREST; row <= SPTI_ROW_CANDIDATE_RATIO; ++row) {
                const int infinite = row == SPTI_ROW_NEAREST || row == SPTI_ROW_VALUE ||
                                     row == SPTI_ROW_CANDIDATE_RATIO;
                spt_store(&spti_union_row(lazy, row)[to], spt_splat(infinite ? INFINITY : 0.0f));
            }
            bad |= (~spt_mask_bits(rays.good) & SPTI_EVERY_LANE) << shift;
        }
        chunk->fates[group].bad = (uint16_t)bad;
    }
}

SPTI_INLINE void union_enter(spti_union *lazy, size_t place, const float *starts) {
    const spt_bound *const bound = lazy->calls[lazy->list[place]].march.bound;
    const float size = bound != NULL ? spti_bound_size(bound) : 0.0f;
    for (size_t at = 0; at < spti_union_groups(lazy) * SPTI_GROUP; at += SPT_LANES) {
        spt_wide t_min = spt_load(&spti_union_row(lazy, SPTI_ROW_T_MIN)[at]);
        spt_wide t_max = spt_load(&spti_union_row(lazy, SPTI_ROW_T_MAX)[at]);
        if (starts != NULL) {
            const spt_mask nowhere = spt_less_equal(spt_splat(INFINITY), spt_load(&starts[at]));
            if (spt_mask_bits(nowhere) == SPTI_EVERY_LANE) { /* nothing else of it is looked at */
                spt_store(&spti_union_state(lazy, place, SPTI_STATE_KEY)[at], spt_splat(INFINITY));
                continue;
            }
            const spt_wide power = spt_load(&spti_union_row(lazy, SPTI_ROW_POWER)[at]);
            t_min = spt_max(spt_mul(spt_load(&starts[at]), power), t_min);
        }
        if (bound != NULL) {
            interval_ray ray;
            for (int axis = 0; axis < 3; ++axis) {
                ray.origin[axis] = spt_load(&spti_union_row(lazy, SPTI_ROW_ORIGIN + axis)[at]);
                ray.direction[axis] =
                    spt_load(&spti_union_row(lazy, SPTI_ROW_DIRECTION + axis)[at]);
            }
            ray.length = spt_load(&spti_union_row(lazy, SPTI_ROW_LENGTH)[at]);
            ray.reach = spt_load(&spti_union_row(lazy, SPTI_ROW_REACH)[at]);
            interval_of_bound(bound, size, &ray, &t_min, &t_max);
        }
        const spt_mask met = spt_less_equal(t_min, t_max);
        spt_store(&spti_union_state(lazy, place, SPTI_STATE_KEY)[at],
                  spt_select(met, t_min, spt_splat(INFINITY)));
        spt_store(&spti_union_state(lazy, place, SPTI_STATE_EXIT)[at], t_max);
        if (lazy->zone_count > 0) { /* taken whole: no lane may hold anything but a number */
            spt_store(&spti_union_state(lazy, place, SPTI_STATE_CLEAR)[at], spt_splat(0.0f));
        }
    }
}

/* The least and the second of the keys of a vector of rays. Returns which rays are undecided. */
SPTI_INLINE unsigned union_least(const spti_union *lazy, size_t at, spt_wide *which) {
    const spt_wide infinity = spt_splat(INFINITY);
    const spt_wide nearest = spt_load(&spti_union_row(lazy, SPTI_ROW_NEAREST)[at]);
    spt_wide least = infinity, second = infinity;
    *which = spt_splat(0.0f);
    for (size_t place = 0; place < lazy->listed; ++place) {
        const spt_wide key = spt_load(&spti_union_state(lazy, place, SPTI_STATE_KEY)[at]);
        const spt_mask nearer = spt_less(key, least);
        second = spt_select(nearer, least, spt_min(key, second));
        least = spt_select(nearer, key, least);
        *which = spt_select(nearer, spt_splat((float)place), *which);
    }
    spt_store(&spti_union_row(lazy, SPTI_ROW_SECOND)[at], second);
    spt_store(&spti_union_row(lazy, SPTI_ROW_WHICH)[at], *which);
    /* At equal t the component might be met there, too, and be the lower one. */
    const spt_mask undecided =
        spt_mask_and(spt_less_equal(least, nearest), spt_less(least, infinity));
    return spt_mask_bits(undecided);
}

SPTI_INLINE int union_plan(spti_union *lazy) {
    unsigned any = 0;
    for (size_t place = 0; place < lazy->listed; ++place) lazy->busy[place] = 0;
    for (size_t group = 0; group < spti_union_groups(lazy); ++group) {
        const size_t start = group * SPTI_GROUP;
        unsigned alive = lazy->alive[group];
        spt_wide which[SPTI_GROUP / SPT_LANES];
        if (alive == 0) {
            for (size_t place = 0; place < lazy->listed; ++place) {
                spti_union_masks(lazy, lazy->tasks, place)[group] = 0;
            }
            continue;
        }
        unsigned undecided = 0;
        for (unsigned i = 0; i < SPTI_GROUP / SPT_LANES; ++i) {
            undecided |= union_least(lazy, start + i * SPT_LANES, &which[i]) << i * SPT_LANES;
        }
        alive &= undecided;
        lazy->alive[group] = (uint16_t)alive;
        any |= alive;
        if (alive == 0) { /* as most are in the last sweep */
            for (size_t place = 0; place < lazy->listed; ++place) {
                spti_union_masks(lazy, lazy->tasks, place)[group] = 0;
            }
            continue;
        }
        for (size_t place = 0; place < lazy->listed; ++place) {
            const spt_wide number = spt_splat((float)place);
            unsigned mine = 0;
            for (unsigned i = 0; i < SPTI_GROUP / SPT_LANES; ++i) {
                const spt_mask same = spt_mask_and(spt_less_equal(number, which[i]),
                                                   spt_less_equal(which[i], number));
                mine |= spt_mask_bits(same) << i * SPT_LANES;
            }
            mine &= alive;
            spti_union_masks(lazy, lazy->tasks, place)[group] = (uint16_t)mine;
            lazy->busy[place] |= mine != 0;
        }
    }
    return any != 0;
}

/* ---- Into the chunk ------------------------------------------------------------------------- */

/* A vector of rays on their way into the chunk. */
typedef struct union_vector {
    spti_chunk *chunk;
    size_t to;
    unsigned keep;
} union_vector;

SPTI_INLINE void union_put(const union_vector *into, int array, spt_wide a) {
    spti_compress(&into->chunk->array[array][into->to], a, into->keep);
}

/* Whether fresh rays enter something, as prepare_vector() marks them. */
SPTI_INLINE spt_wide union_enters(const spti_union *lazy, const spti_call *call, size_t at,
                                  spt_wide t, spt_wide floor_at_0) {
    const spt_wide own = spt_load(&spti_union_row(lazy, SPTI_ROW_T_MIN)[at]);
    const spt_wide path =
        lazy->one_origin ? spt_splat(0.0f) : spt_load(&spti_union_row(lazy, SPTI_ROW_PATH)[at]);
    const spt_wide tolerance =
        ray_tolerance(spt_load(&spti_union_row(lazy, SPTI_ROW_EPSILON)[at]),
                      spt_splat(call->march.pixel_radius), path, ray_floor(floor_at_0, t), t);
    return prepare_enters(own, t, tolerance);
}

/* What a component's march along fresh rays, or those it knows, begins with. */
SPTI_INLINE void union_take_march(const spti_union *lazy, const spti_call *call, size_t at,
                                  int begun, const union_vector *into) {
    const size_t place = lazy->running;
    const spt_wide zero = spt_splat(0.0f);
    const spt_wide length = spt_load(&spti_union_row(lazy, SPTI_ROW_LENGTH)[at]);
    const spt_wide key = spt_load(&spti_union_state(lazy, place, SPTI_STATE_KEY)[at]);
    spt_wide t = spt_select(spt_less(key, spt_splat(INFINITY)), key, zero);
    spt_wide probe = t, value = spt_splat(INFINITY), memory = zero, pending_t = zero;
    spt_wide pending_value = zero, scale = prepare_scale(&call->march, length);
    spt_wide t_max = spt_load(&spti_union_state(lazy, place, SPTI_STATE_EXIT)[at]);
    if (lazy->zone_count > 0) {
        t_max = spt_min(spt_load(&spti_union_state(lazy, place, SPTI_STATE_CLEAR)[at]), t_max);
    }
    if (begun) {
        t = spt_load(&spti_union_state(lazy, place, SPTI_STATE_T)[at]);
        value = spt_load(&spti_union_state(lazy, place, SPTI_STATE_VALUE)[at]);
        probe = spt_load(&spti_union_state(lazy, place, SPTI_STATE_PROBE)[at]);
        memory = spt_load(&spti_union_state(lazy, place, SPTI_STATE_MEMORY)[at]);
        pending_t = spt_load(&spti_union_state(lazy, place, SPTI_STATE_PENDING_T)[at]);
        pending_value = spt_load(&spti_union_state(lazy, place, SPTI_STATE_PENDING_VALUE)[at]);
        scale = spt_load(&spti_union_state(lazy, place, SPTI_STATE_SCALE)[at]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide origin = spt_load(&spti_union_row(lazy, SPTI_ROW_ORIGIN + axis)[at]);
        const spt_wide direction = spt_load(&spti_union_row(lazy, SPTI_ROW_DIRECTION + axis)[at]);
        if (!call->one_origin) union_put(into, SPTI_ORIGIN + axis, origin);
        union_put(into, SPTI_DIRECTION + axis, direction);
        union_put(into, SPTI_X + axis, spt_add(origin, spt_mul(probe, direction)));
    }
    const spt_wide reach = spt_load(&spti_union_row(lazy, SPTI_ROW_REACH)[at]);
    const spt_wide floor_at_0 = prepare_floor(&call->march, reach, length);
    if (!begun) pending_value = union_enters(lazy, call, at, t, floor_at_0);
    union_put(into, SPTI_FLOOR_AT_0, floor_at_0);
    union_put(into, SPTI_SCALE, scale);
    union_put(into, SPTI_T_MAX, t_max);
    union_put(into, SPTI_T, t);
    union_put(into, SPTI_PROBE, probe);
    union_put(into, SPTI_VALUE, value);
    union_put(into, SPTI_MEMORY, memory);
    union_put(into, SPTI_PENDING_T, pending_t);
    union_put(into, SPTI_PENDING_VALUE, pending_value);
}

/* What a ray brings along from whatever came before. */
SPTI_INLINE void union_take_ray(const spti_union *lazy, const spti_call *call, size_t at,
                                const union_vector *into) {
    const spt_wide second = spt_load(&spti_union_row(lazy, SPTI_ROW_SECOND)[at]);
    const spt_wide nearest = spt_load(&spti_union_row(lazy, SPTI_ROW_NEAREST)[at]);
    union_put(into, SPTI_INDEX, compact_numbers(at));
    union_put(into, SPTI_STOP, spt_min(second, nearest));
    union_put(into, SPTI_EPSILON, spt_load(&spti_union_row(lazy, SPTI_ROW_EPSILON)[at]));
    if (!call->one_origin) {
        union_put(into, SPTI_PATH, spt_load(&spti_union_row(lazy, SPTI_ROW_PATH)[at]));
    }
    union_put(into, SPTI_SPENT, spt_load(&spti_union_row(lazy, SPTI_ROW_SPENT)[at]));
    if (call->wants & SPTI_WANT_SLOPE) {
        union_put(into, SPTI_STEEPEST, spt_load(&spti_union_row(lazy, SPTI_ROW_STEEPEST)[at]));
    }
    if (call->wants & SPTI_WANT_FALLBACKS) {
        union_put(into, SPTI_FALLBACKS, spt_load(&spti_union_row(lazy, SPTI_ROW_FALLBACKS)[at]));
    }
    if (call->wants & SPTI_WANT_CANDIDATE) {
        union_put(into, SPTI_CANDIDATE_T,
                  spt_load(&spti_union_row(lazy, SPTI_ROW_CANDIDATE_T)[at]));
        union_put(into, SPTI_CANDIDATE_RATIO,
                  spt_load(&spti_union_row(lazy, SPTI_ROW_CANDIDATE_RATIO)[at]));
    }
}

/* The tasks of a kind in a group. */
SPTI_INLINE unsigned union_tasks(const spti_union *lazy, int kind, size_t group) {
    const size_t place = lazy->running;
    const unsigned tasks = spti_union_masks(lazy, lazy->tasks, place)[group];
    const unsigned begun = spti_union_masks(lazy, lazy->begun, place)[group];
    const unsigned cut = spti_union_masks(lazy, lazy->cut, place)[group];
    if (kind == SPTI_TASKS_BEGUN) return tasks & begun;
    return tasks & ~begun & (kind == SPTI_TASKS_CUT ? cut : ~cut);
}

SPTI_INLINE size_t union_take(spti_union *lazy, int kind, size_t *group) {
    const size_t place = lazy->running, groups = spti_union_groups(lazy);
    const spti_call *const call = &lazy->calls[lazy->list[place]];
    spti_chunk *const chunk = &lazy->chunk;
    size_t count = 0;
    for (; *group < groups && count + SPTI_GROUP <= SPT_BATCH; ++*group) {
        const unsigned all = union_tasks(lazy, kind, *group);
        for (unsigned shift = 0; all != 0 && shift < SPTI_GROUP; shift += SPT_LANES) {
            const union_vector into = {chunk, count, all >> shift & SPTI_EVERY_LANE};
            const size_t at = *group * SPTI_GROUP + shift;
            if (into.keep == 0) continue;
            union_take_march(lazy, call, at, kind == SPTI_TASKS_BEGUN, &into);
            union_take_ray(lazy, call, at, &into);
            count += compact_bits(into.keep);
        }
    }
    /* Lanes behind the last ray repeat the first, so that they hold ordinary numbers. */
    for (size_t i = 0; count % SPTI_GROUP != 0 && i < call->array_count; ++i) {
        float *const array = chunk->array[call->arrays[i]];
        for (size_t pad = 0; pad < SPTI_GROUP; pad += SPT_LANES) {
            spt_store(&array[count + pad], spt_splat(array[0]));
        }
    }
    return count;
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
            const spt_wide free_to = spt_add(spt_load(&chunk->array[SPTI_T][at]), radius);
            const spt_mask stops = spt_less_equal(spt_load(&chunk->array[SPTI_STOP][at]), free_to);
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
