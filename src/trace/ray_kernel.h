/* SPDX-License-Identifier: MIT
 *
 * The laws of a ray in a chunk: its points, and what counts as reached. A template over
 * SPT_LANES. */
#ifndef SPTI_RAY_KERNEL_H
#define SPTI_RAY_KERNEL_H

#include <float.h>

#include "../base/arguments.h"
#include "../lanes/lanes.h"
#include "chunk.h"

/* The rounding floor at t, in t. */
SPTI_INLINE spt_wide ray_floor(spt_wide floor_at_0, spt_wide t) {
    return spt_add(spt_mul(spt_splat(SPTI_FLOOR), t), floor_at_0);
}

/* The tolerance at t, in t: the largest of epsilon, the pixel cone and the floor there. */
SPTI_INLINE spt_wide ray_tolerance(spt_wide epsilon, spt_wide pixel_radius, spt_wide path,
                                   spt_wide floor, spt_wide t) {
    const spt_wide cone = spt_mul(pixel_radius, spt_add(path, t));
    return spt_max(epsilon, spt_max(cone, floor));
}

/* A coordinate of the points at t of the rays from slot `at` on. */
SPTI_INLINE spt_wide ray_point(const spti_chunk *chunk, int axis, size_t at, spt_wide t) {
    const spt_wide along = spt_mul(t, spt_load(&chunk->array[SPTI_DIRECTION + axis][at]));
    return spt_add(spt_load(&chunk->array[SPTI_ORIGIN + axis][at]), along);
}

/* Where a ray passes closest to what may lie between a sample and the one before: the spheres
 * around both meet in a circle, and what is nearer to the ray than its radius is free. A circle
 * that is not between them says nothing that the samples do not. *back is its distance before the
 * sample. */
SPTI_INLINE spt_wide ray_closest(spt_wide before, spt_wide after, spt_wide step, spt_wide radius,
                                 spt_wide *back) {
    const spt_wide zero = spt_splat(0.0f);
    const spt_wide one = spt_splat(1.0f), slope = spt_div(spt_sub(after, before), step);
    /* The slope of a distance bound is at most 1: then nothing overflows. */
    const spt_wide held = spt_max(spt_min(slope, one), spt_sub(zero, one));
    const spt_wide bend = spt_mul(held, spt_add(after, before));
    const spt_wide y = spt_mul(spt_splat(0.5f), spt_add(step, bend));
    /* The first sample has none before it, and its step is FLT_MIN. */
    const spt_mask two = spt_less(spt_splat(FLT_MIN), step);
    const spt_mask between = spt_mask_and(two, spt_mask_and(spt_less(zero, y), spt_less(y, step)));
    *back = spt_select(between, y, zero);
    /* sqrt((radius - y) (radius + y)) so that nothing overflows, and that powers of two come out. */
    const spt_wide less = spt_select(between, spt_max(spt_sub(radius, y), zero), zero);
    const spt_wide more = spt_select(between, spt_add(radius, y), one);
    const spt_wide chord = spt_mul(spt_sqrt(spt_div(less, more)), more);
    return spt_select(between, chord, radius);
}

#endif
