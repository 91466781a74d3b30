/* SPDX-License-Identifier: MIT
 *
 * Single rays of a chunk, by slot, for what is done one by one in plain C; the same operations as
 * in the kernels. For files that define SPT_LANES as 1. */
#ifndef SPTI_SLOT_H
#define SPTI_SLOT_H

#include "driver.h"
#include "ray_kernel.h"

/* The tolerance at t, in t. */
static inline float spti_slot_tolerance(const spti_call *call, const spti_chunk *chunk, size_t slot,
                                        float t) {
    const float floor = ray_floor(chunk->array[SPTI_FLOOR_AT_0][slot], t);
    return ray_tolerance(chunk->array[SPTI_EPSILON][slot], call->march.pixel_radius,
                         chunk->array[SPTI_PATH][slot], floor, t);
}

/* Puts the point at t of the ray in slot `from` into place `to` of those to evaluate. */
static inline void spti_slot_point(spti_chunk *chunk, size_t from, size_t to, float t) {
    for (int axis = 0; axis < 3; ++axis) {
        chunk->array[SPTI_X + axis][to] = ray_point(chunk, axis, from, t);
    }
}

/* Fills the last group of points with copies of the first. */
static inline void spti_pad_points(spti_chunk *chunk, size_t count) {
    for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) {
        for (int axis = 0; axis < 3; ++axis) {
            chunk->array[SPTI_X + axis][slot] = chunk->array[SPTI_X + axis][0];
        }
    }
}

/* Fills the last group of rays with copies of the first. */
static inline void spti_pad_rays(const spti_call *call, spti_chunk *chunk, size_t count) {
    for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) {
        for (size_t i = 0; i < call->array_count; ++i) {
            chunk->array[call->arrays[i]][slot] = chunk->array[call->arrays[i]][0];
        }
    }
}

#endif
