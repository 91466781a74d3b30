/* SPDX-License-Identifier: MIT
 *
 * The laws of a ray in a chunk: its points, and what counts as reached. A template over
 * SPT_LANES. */
#ifndef SPTI_RAY_KERNEL_H
#define SPTI_RAY_KERNEL_H

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

#endif
