/* SPDX-License-Identifier: MIT
 *
 * The public face of the bounding volumes, one ray at a time: the interval kernel with one lane. */
#define SPT_LANES 1
#include "interval_kernel.h"

int spti_bound_copy(spt_bound *to, const spt_bound *from) {
    *to = spt_bound_sphere(0, 0, 0, 1);
    if (!spti_copy_sized(to, from, sizeof *to)) return 0;
    if (to->kind == SPT_BOUND_SPHERE) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!spti_finite(to->center[axis])) return 0;
        }
        return to->radius > 0.0f && spti_finite(to->radius);
    }
    if (to->kind != SPT_BOUND_BOX) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(to->low[axis]) || !spti_finite(to->high[axis])) return 0;
        if (!(to->low[axis] <= to->high[axis])) return 0;
    }
    return 1;
}

spt_status spt_bound_extent(const spt_bound *bound, float low[3], float high[3]) {
    spt_bound copy;
    if (bound == NULL || low == NULL || high == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_bound_copy(&copy, bound)) return SPT_BAD_ARGUMENT;
    for (int axis = 0; axis < 3; ++axis) {
        const int sphere = copy.kind == SPT_BOUND_SPHERE;
        low[axis] = sphere ? copy.center[axis] - copy.radius : copy.low[axis];
        high[axis] = sphere ? copy.center[axis] + copy.radius : copy.high[axis];
        low[axis] = spt_max(low[axis], -FLT_MAX);
        high[axis] = spt_min(high[axis], FLT_MAX);
    }
    return SPT_OK;
}

float spti_bound_size(const spt_bound *bound) {
    float size = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float largest = bound->kind == SPT_BOUND_SPHERE
                                  ? fabsf(bound->center[axis]) + bound->radius
                                  : spt_max(fabsf(bound->low[axis]), fabsf(bound->high[axis]));
        size = spt_max(size, largest);
    }
    return spt_min(size, FLT_MAX);
}

spt_status spt_bound_interval(const spt_bound *bound, const float origin[3],
                              const float direction[3], float t_min, float t_max, float *t_in,
                              float *t_out) {
    spt_bound copy;
    interval_ray ray;
    float largest = 0.0f, square = 0.0f;
    if (bound == NULL || origin == NULL || direction == NULL) return SPT_BAD_ARGUMENT;
    if (t_in == NULL || t_out == NULL || !spti_bound_copy(&copy, bound)) return SPT_BAD_ARGUMENT;
    ray.reach = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(origin[axis]) || !spti_finite(direction[axis])) return SPT_BAD_ARGUMENT;
        ray.reach = spt_max(ray.reach, fabsf(origin[axis]));
        largest = spt_max(largest, fabsf(direction[axis]));
    }
    if (!(largest >= FLT_MIN) || !(t_min >= 0.0f) || !spti_finite(t_min) || !(t_max <= INFINITY)) {
        return SPT_BAD_ARGUMENT;
    }
    const float power = interval_power(largest), unit = 1.0f / power;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = origin[axis];
        ray.direction[axis] = direction[axis] * unit;
        square += ray.direction[axis] * ray.direction[axis];
    }
    ray.length = sqrtf(square);
    float from = t_min * power, to = t_max * power;
    interval_of_bound(&copy, &ray, &from, &to);
    *t_in = from <= to ? from * unit : INFINITY;
    *t_out = from <= to ? to * unit : -INFINITY;
    return SPT_OK;
}
