/* SPDX-License-Identifier: MIT
 *
 * Brings the rays of a chunk into their own units and sorts out those that need no tracing. A
 * template over SPT_LANES. Defines prepare_pass(), a spti_prepare_fn. */
#ifndef SPTI_PREPARE_KERNEL_H
#define SPTI_PREPARE_KERNEL_H

#include <float.h>
#include <math.h>

#include "../bound/interval_kernel.h"
#include "../bound/volume.h"
#include "ray_kernel.h"

SPTI_INLINE spt_mask prepare_finite(spt_wide a) {
    return spt_less_equal(spt_abs(a), spt_splat(FLT_MAX));
}

/* Rays as the caller gave them, then in their own units. */
typedef struct prepare_rays {
    interval_ray ray;
    spt_wide t_min, t_max, path;
    spt_wide power;   /* t in the ray's own unit = power * t of the caller */
    spt_wide largest; /* component of the direction */
    spt_mask good;
} prepare_rays;

SPTI_INLINE void prepare_load(const spti_chunk *chunk, size_t at, prepare_rays *rays) {
    const spt_wide zero = spt_splat(0.0f);
    interval_ray *const ray = &rays->ray;
    spt_mask good = spt_mask_splat(1);
    ray->reach = rays->largest = zero;
    for (int axis = 0; axis < 3; ++axis) {
        ray->origin[axis] = spt_load(&chunk->array[SPTI_ORIGIN + axis][at]);
        ray->direction[axis] = spt_load(&chunk->array[SPTI_DIRECTION + axis][at]);
        good = spt_mask_and(good, prepare_finite(ray->origin[axis]));
        good = spt_mask_and(good, prepare_finite(ray->direction[axis]));
        ray->reach = spt_max(ray->reach, spt_abs(ray->origin[axis]));
        rays->largest = spt_max(rays->largest, spt_abs(ray->direction[axis]));
    }
    rays->t_min = spt_load(&chunk->array[SPTI_T][at]);
    rays->t_max = spt_load(&chunk->array[SPTI_T_MAX][at]);
    rays->path = spt_load(&chunk->array[SPTI_PATH][at]);
    good =
        spt_mask_and(good, spt_mask_and(prepare_finite(rays->t_min), prepare_finite(rays->path)));
    good = spt_mask_and(good, spt_less_equal(zero, rays->t_min));
    good = spt_mask_and(good, spt_less_equal(zero, rays->path));
    good = spt_mask_and(good, spt_less_equal(rays->t_max, spt_splat(INFINITY)));
    rays->good = spt_mask_and(good, spt_less_equal(spt_splat(FLT_MIN), rays->largest));
}

/* Scales by a power of two, so far that t and positions stay finite. Bad rays get harmless numbers,
 * so that they raise no exception. Returns what a unit of t is to the caller. */
SPTI_INLINE spt_wide prepare_units(prepare_rays *rays) {
    const spt_wide zero = spt_splat(0.0f), one = spt_splat(1.0f), most = spt_splat(FLT_MAX);
    const spt_wide tiny = spt_splat(FLT_MIN);
    interval_ray *const ray = &rays->ray;
    const spt_wide power = spt_select(rays->good, interval_power(rays->largest), one);
    const spt_wide unit = spt_div(one, power);
    spt_wide square[3];
    rays->power = power;
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide direction = spt_select(rays->good, ray->direction[axis], one);
        ray->origin[axis] = spt_select(rays->good, ray->origin[axis], zero);
        ray->direction[axis] = spt_mul(direction, unit);
        square[axis] = spt_mul(ray->direction[axis], ray->direction[axis]);
    }
    ray->length = spt_sqrt(spt_add(spt_add(square[0], square[1]), square[2]));
    ray->reach = spt_select(rays->good, ray->reach, zero);
    /* path + t must not overflow. */
    rays->path = spt_min(spt_select(rays->good, rays->path, zero), spt_splat(FLT_MAX / 4));

    /* Scaling loses bits below FLT_MIN only: there t_min is raised and t_max lowered. */
    spt_wide t_min = spt_select(rays->good, spt_mul(rays->t_min, power), zero);
    spt_wide t_max = spt_select(rays->good, spt_mul(rays->t_max, power), zero);
    t_min = spt_select(spt_less(zero, rays->t_min), spt_max(t_min, tiny), t_min);
    t_max = spt_select(spt_less(t_max, tiny), spt_min(t_max, zero), t_max);
    t_max = spt_select(spt_less(rays->t_max, zero), spt_splat(-1.0f), t_max);
    spt_wide limit = spt_min(spt_splat(FLT_MAX / 4), spt_sub(most, ray->reach));
    limit = spt_div(spt_mul(limit, spt_splat(1.0f - 0x1p-20f)), ray->length);
    limit = spt_min(limit, spt_mul(most, spt_min(power, one)));
    rays->t_min = t_min;
    rays->t_max = spt_min(t_max, limit);
    return unit;
}

/* The least tolerance, in t. */
SPTI_INLINE spt_wide prepare_epsilon(float epsilon, spt_wide length) {
    const spt_wide least = spt_splat(0x1p-149f); /* f = 0 is within any epsilon */
    return spt_max(spt_div(spt_splat(epsilon), length), least);
}

/* What f is multiplied with to give the radius in t. */
SPTI_INLINE spt_wide prepare_scale(const spti_march *march, spt_wide length) {
    return spt_div(spt_splat(march->inverse_lipschitz), length);
}

/* The rounding floor at t = 0, in t. */
SPTI_INLINE spt_wide prepare_floor(const spti_march *march, spt_wide reach, spt_wide length) {
    const spt_wide of_origin = spt_mul(spt_splat(SPTI_FLOOR), reach);
    return spt_div(spt_add(of_origin, spt_splat(SPTI_FLOOR * march->size)), length);
}

SPTI_INLINE void prepare_store(float (*array)[SPTI_ROOM], const spti_march *march, size_t at,
                               const prepare_rays *rays) {
    const interval_ray *const ray = &rays->ray;
    spt_store(&array[SPTI_SCALE][at], prepare_scale(march, ray->length));
    spt_store(&array[SPTI_T_MAX][at], rays->t_max);
    spt_store(&array[SPTI_EPSILON][at], prepare_epsilon(march->epsilon, ray->length));
    spt_store(&array[SPTI_PATH][at], spt_div(rays->path, ray->length));
    spt_store(&array[SPTI_FLOOR_AT_0][at], prepare_floor(march, ray->reach, ray->length));
    spt_store(&array[SPTI_T][at], rays->t_min);
    spt_store(&array[SPTI_PROBE][at], rays->t_min);
    spt_store(&array[SPTI_VALUE][at], spt_splat(INFINITY)); /* where nothing is evaluated */
    for (int zero = SPTI_MEMORY; zero < SPTI_CANDIDATE_RATIO; ++zero) {
        spt_store(&array[zero][at], spt_splat(0.0f));
    }
    spt_store(&array[SPTI_CANDIDATE_RATIO][at], spt_splat(INFINITY));
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide along = spt_mul(rays->t_min, ray->direction[axis]);
        const spt_wide origin = spt_load(&array[SPTI_ORIGIN + axis][at]);
        spt_store(&array[SPTI_DIRECTION + axis][at], ray->direction[axis]);
        spt_store(&array[SPTI_X + axis][at], spt_add(origin, along));
    }
}

/* 1 for rays that begin where they enter something, by more than a tolerance behind their own
 * t_min: SPT_SKIP_START does not concern them. */
SPTI_INLINE spt_wide prepare_enters(spt_wide own, spt_wide t, spt_wide tolerance) {
    const spt_mask enters = spt_less(spt_add(own, tolerance), t);
    return spt_select(enters, spt_splat(1.0f), spt_splat(0.0f));
}

/* Cuts the intervals with a bound. Volumes that are neither spheres nor boxes go by memory to where
 * all widths find them. */
SPTI_INLINE void prepare_bound(const spt_bound *bound, float size, prepare_rays *rays) {
    const interval_ray *const ray = &rays->ray;
    if (interval_has_hull(bound)) interval_of_hull(bound, size, ray, &rays->t_min, &rays->t_max);
    if (interval_has_more(bound)) {
        spti_volume_rays stored;
        for (int axis = 0; axis < 3; ++axis) {
            spt_store(stored.origin[axis], ray->origin[axis]);
            spt_store(stored.direction[axis], ray->direction[axis]);
        }
        spt_store(stored.t_min, rays->t_min);
        spt_store(stored.t_max, rays->t_max);
        spti_volume_cut(bound, SPT_LANES, &stored);
        rays->t_min = spt_load(stored.t_min);
        rays->t_max = spt_load(stored.t_max);
    }
}

SPTI_INLINE void prepare_vector(spti_chunk *chunk, const spti_march *march, float size, size_t at,
                                unsigned shift, spti_fates *fates) {
    /* In a register: the compiler must think that any store of a vector changes the chunk's. */
    float(*const array)[SPTI_ROOM] = chunk->array;
    prepare_rays rays;
    prepare_load(chunk, at, &rays);
    const spt_wide unit = prepare_units(&rays);
    const spt_wide own = rays.t_min;
    if (march->bound != NULL) prepare_bound(march->bound, size, &rays);
    const spt_mask missed = spt_mask_and_not(rays.good, spt_less_equal(rays.t_min, rays.t_max));
    const spt_mask traced = spt_mask_and_not(rays.good, missed);
    rays.t_min = spt_select(traced, rays.t_min, spt_splat(0.0f));
    const unsigned bad = ~spt_mask_bits(rays.good) & SPTI_EVERY_LANE;
    const unsigned finished = ~spt_mask_bits(traced) & SPTI_EVERY_LANE;
    fates->bad = (uint16_t)(fates->bad | bad << shift);
    fates->missed = (uint16_t)(fates->missed | spt_mask_bits(missed) << shift);
    fates->finished = (uint16_t)(fates->finished | finished << shift);
    spt_store(&chunk->unit[at], unit);
    prepare_store(array, march, at, &rays);
    if (march->bound != NULL) {
        const spt_wide floor = ray_floor(spt_load(&array[SPTI_FLOOR_AT_0][at]), rays.t_min);
        const spt_wide tolerance =
            ray_tolerance(spt_load(&array[SPTI_EPSILON][at]), spt_splat(march->pixel_radius),
                          spt_load(&array[SPTI_PATH][at]), floor, rays.t_min);
        /* Until a probe is kept nobody else looks there. */
        spt_store(&array[SPTI_PENDING_VALUE][at], prepare_enters(own, rays.t_min, tolerance));
        if (spti_bound_asks(march->bound)) spt_store(&array[SPTI_PROBE][at], own);
    }
}

SPTI_INLINE int prepare_pass(spti_chunk *chunk, const spti_march *march, size_t count) {
    const float size = march->bound != NULL ? spti_bound_size(march->bound) : 0.0f;
    unsigned any = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = {0, 0, 0, 0, 0, 0, 0};
        const size_t start = group * SPTI_GROUP, left = count - start;
        /* The whole group: its padding goes where the ray goes that it repeats. */
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            prepare_vector(chunk, march, size, start + shift, shift, &fates);
        }
        if (left < SPTI_GROUP) fates.finished &= (uint16_t)((1u << left) - 1u);
        chunk->fates[group] = fates;
        any |= fates.finished;
    }
    return any != 0;
}

#endif
