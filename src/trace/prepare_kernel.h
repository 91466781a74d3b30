/* SPDX-License-Identifier: MIT
 *
 * Brings the rays of a chunk into their own units and sorts out those that need no tracing. A
 * template over SPT_LANES. Defines prepare_pass(), a spti_prepare_fn. */
#ifndef SPTI_PREPARE_KERNEL_H
#define SPTI_PREPARE_KERNEL_H

#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../bound/interval_kernel.h"
#include "chunk.h"

SPTI_INLINE spt_mask prepare_finite(spt_wide a) {
    return spt_less_equal(spt_abs(a), spt_splat(FLT_MAX));
}

SPTI_INLINE void prepare_vector(spti_chunk *chunk, const spti_march *march, size_t at,
                                unsigned shift, spti_fates *fates) {
    const spt_wide zero = spt_splat(0.0f), tiny = spt_splat(FLT_MIN), most = spt_splat(FLT_MAX);
    interval_ray ray;
    spt_wide reach = zero, largest = zero;
    spt_mask good = spt_mask_splat(1);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = spt_load(&chunk->array[SPTI_ORIGIN + axis][at]);
        ray.direction[axis] = spt_load(&chunk->array[SPTI_DIRECTION + axis][at]);
        good = spt_mask_and(good, prepare_finite(ray.origin[axis]));
        good = spt_mask_and(good, prepare_finite(ray.direction[axis]));
        reach = spt_max(reach, spt_abs(ray.origin[axis]));
        largest = spt_max(largest, spt_abs(ray.direction[axis]));
    }
    spt_wide t_min = spt_load(&chunk->array[SPTI_T][at]);
    spt_wide t_max = spt_load(&chunk->array[SPTI_T_MAX][at]);
    spt_wide path = spt_load(&chunk->array[SPTI_PATH][at]);
    good = spt_mask_and(good, spt_mask_and(prepare_finite(t_min), prepare_finite(path)));
    good =
        spt_mask_and(good, spt_mask_and(spt_less_equal(zero, t_min), spt_less_equal(zero, path)));
    good = spt_mask_and(good, spt_less_equal(t_max, spt_splat(INFINITY)));
    good = spt_mask_and(good, spt_less_equal(tiny, largest));

    /* The ray's own unit, a power of two. 2^127 has no normal inverse, so at most 2^126. Bad rays
     * get harmless numbers, so that they raise no exception. */
    spt_wide power = spti_power_of_two(spt_min(spt_max(largest, tiny), spt_splat(0x1p126f)));
    power = spt_select(good, power, spt_splat(1.0f));
    reach = spt_select(good, reach, zero);
    path = spt_select(good, path, zero);
    const spt_wide unit = spt_div(spt_splat(1.0f), power);
    spt_wide square[3];
    for (int axis = 0; axis < 3; ++axis) {
        ray.direction[axis] = spt_select(good, ray.direction[axis], spt_splat(1.0f));
        ray.origin[axis] = spt_select(good, ray.origin[axis], zero);
        ray.direction[axis] = spt_mul(ray.direction[axis], unit);
        square[axis] = spt_mul(ray.direction[axis], ray.direction[axis]);
    }
    const spt_wide length = spt_sqrt(spt_add(spt_add(square[0], square[1]), square[2]));
    t_min = spt_select(good, spt_mul(t_min, power), zero);
    t_max = spt_select(good, spt_mul(t_max, power), zero);
    const spt_wide floor_at_0 =
        spt_div(spt_add(spt_mul(spt_splat(SPTI_FLOOR), reach), spt_splat(SPTI_FLOOR * march->size)),
                length);

    /* So far that t and positions stay finite, and lengths well within the range. */
    spt_wide limit = spt_min(spt_splat(FLT_MAX / 4), spt_sub(most, reach));
    limit = spt_div(spt_mul(limit, spt_splat(1.0f - 0x1p-20f)), length);
    t_max = spt_min(t_max, spt_min(limit, spt_mul(most, spt_min(power, spt_splat(1.0f)))));
    if (march->bound != NULL) {
        ray.length = length;
        ray.reach = reach;
        interval_of_bound(march->bound, &ray, &t_min, &t_max);
    }
    const spt_mask missed = spt_mask_and_not(good, spt_less_equal(t_min, t_max));
    const spt_mask traced = spt_mask_and_not(good, missed);
    t_min = spt_select(traced, t_min, zero);

    const unsigned every = (1u << (SPT_LANES - 1)) * 2u - 1u;
    fates->bad = (uint16_t)(fates->bad | (~spt_mask_bits(good) & every) << shift);
    fates->missed = (uint16_t)(fates->missed | spt_mask_bits(missed) << shift);
    fates->finished = (uint16_t)(fates->finished | (~spt_mask_bits(traced) & every) << shift);
    const spt_wide scale = spt_div(spt_splat(march->inverse_lipschitz), length);
    spt_store(&chunk->unit[at], unit);
    spt_store(&chunk->array[SPTI_SCALE][at], scale);
    spt_store(&chunk->array[SPTI_T_MAX][at], t_max);
    spt_store(&chunk->array[SPTI_EPSILON][at], spt_div(spt_splat(march->epsilon), length));
    spt_store(&chunk->array[SPTI_PATH][at], spt_div(path, length));
    spt_store(&chunk->array[SPTI_FLOOR_AT_0][at], floor_at_0);
    spt_store(&chunk->array[SPTI_T][at], t_min);
    spt_store(&chunk->array[SPTI_PROBE][at], t_min);
    spt_store(&chunk->array[SPTI_VALUE][at], spt_splat(INFINITY)); /* where nothing is evaluated */
    for (int array = SPTI_MEMORY; array < SPTI_CANDIDATE_RATIO; ++array) {
        spt_store(&chunk->array[array][at], zero);
    }
    spt_store(&chunk->array[SPTI_CANDIDATE_RATIO][at], spt_splat(INFINITY));
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide along = spt_mul(t_min, ray.direction[axis]);
        spt_store(&chunk->array[SPTI_DIRECTION + axis][at], ray.direction[axis]);
        spt_store(&chunk->array[SPTI_X + axis][at], spt_add(ray.origin[axis], along));
    }
}

SPTI_INLINE int prepare_pass(spti_chunk *chunk, const spti_march *march, size_t count) {
    unsigned any = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        spti_fates fates = {0, 0, 0, 0, 0, 0};
        const size_t start = group * SPTI_GROUP, left = count - start;
        /* The whole group: its padding goes where the ray goes that it repeats. */
        for (unsigned shift = 0; shift < SPTI_GROUP; shift += SPT_LANES) {
            prepare_vector(chunk, march, start + shift, shift, &fates);
        }
        if (left < SPTI_GROUP) fates.finished &= (uint16_t)((1u << left) - 1u);
        chunk->fates[group] = fates;
        any |= fates.finished;
    }
    return any != 0;
}

#endif
