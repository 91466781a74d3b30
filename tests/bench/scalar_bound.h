/* SPDX-License-Identifier: MIT
 *
 * Where a ray is inside a bounding volume, in plain scalar C, operation by operation as the library
 * does it, since a start that differs in one bit is another ray. */
#ifndef TESTS_BENCH_SCALAR_BOUND_H
#define TESTS_BENCH_SCALAR_BOUND_H

#include <math.h>
#include <spheretrace/bound.h>
#include <spheretrace/trace.h>

#define SCALAR_FLOOR 0x1p-22f /* slope of the rounding floor, trace.h */

static inline float scalar_min(float a, float b) {
    return a < b ? a : b;
}

static inline float scalar_max(float a, float b) {
    return a > b ? a : b;
}

/* t moved by the part of the rounding floor that grows with it. */
static inline float scalar_earlier(float t) {
    return t * (t < 0.0f ? 1.0f + SCALAR_FLOOR : 1.0f - SCALAR_FLOOR);
}

static inline float scalar_later(float t) {
    return t * (t < 0.0f ? 1.0f - SCALAR_FLOOR : 1.0f + SCALAR_FLOOR);
}

/* The largest magnitude among the coordinates of the volume. */
static inline float scalar_bound_size(const spt_bound *bound) {
    float size = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        size =
            scalar_max(size, bound->kind == SPT_BOUND_SPHERE
                                 ? fabsf(bound->center[axis]) + bound->radius
                                 : scalar_max(fabsf(bound->low[axis]), fabsf(bound->high[axis])));
    }
    return size;
}

static inline void scalar_box_interval(const spt_bound *bound, const spt_ray *ray, float margin,
                                       float *entry, float *exit) {
    *entry = -INFINITY;
    *exit = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const float origin = ray->origin[axis], direction = ray->direction[axis];
        const float low = bound->low[axis] - margin, high = bound->high[axis] + margin;
        if (fabsf(direction) <= 0.0f) {
            const int within = low <= origin && origin <= high;
            *entry = within ? *entry : INFINITY;
            *exit = within ? *exit : -INFINITY;
            continue;
        }
        const float a = (low - origin) / direction, b = (high - origin) / direction;
        *entry = scalar_max(scalar_earlier(scalar_min(a, b)), *entry);
        *exit = scalar_min(scalar_later(scalar_max(a, b)), *exit);
    }
}

static inline void scalar_sphere_interval(const spt_bound *bound, const spt_ray *ray, float reach,
                                          float margin, float *entry, float *exit) {
    float offset[3], a = 0.0f, b = 0.0f, c = 0.0f, apart = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        offset[axis] = ray->origin[axis] - bound->center[axis];
        a += ray->direction[axis] * ray->direction[axis];
        b += ray->direction[axis] * offset[axis];
        c += offset[axis] * offset[axis];
    }
    const float closest = b / a;
    for (int axis = 0; axis < 3; ++axis) {
        const float side = offset[axis] - closest * ray->direction[axis];
        apart += side * side;
    }
    const float grown = bound->radius + SCALAR_FLOOR * (reach + sqrtf(c));
    const float square = grown * grown, room = square - apart;
    *entry = INFINITY;
    *exit = -INFINITY;
    if (room < 0.0f) return;
    const float magnitude = fabsf(b) + sqrtf(a * room);
    const float k = b < 0.0f ? magnitude : -magnitude;
    const float first = k / a, second = magnitude <= 0.0f ? 0.0f : (c - square) / k;
    *entry = scalar_earlier(scalar_min(first, second)) - margin;
    *exit = scalar_later(scalar_max(first, second)) + margin;
}

/* Narrows [t_min, t_max]. length: of the direction; reach: the largest magnitude in the origin. */
static inline void scalar_narrow(const spt_bound *bound, const spt_ray *ray, float length,
                                 float reach, float *t_min, float *t_max) {
    const float margin = SCALAR_FLOOR * (reach + scalar_bound_size(bound));
    float entry, exit;
    if (bound->kind == SPT_BOUND_SPHERE) {
        scalar_sphere_interval(bound, ray, reach, margin / length, &entry, &exit);
    } else {
        scalar_box_interval(bound, ray, margin, &entry, &exit);
    }
    *t_min = scalar_max(entry, *t_min);
    *t_max = scalar_min(exit, *t_max);
}

#endif
