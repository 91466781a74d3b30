/* SPDX-License-Identifier: MIT
 *
 * The public face of the bounding volumes, one ray at a time: the interval kernel with one lane. */
#define SPT_LANES 1
#include "volume_kernel.h"

spt_status spt_bound_extent(const spt_bound *bound, float low[3], float high[3]) {
    spt_bound copy;
    if (bound == NULL || low == NULL || high == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_bound_copy(&copy, bound)) return SPT_BAD_ARGUMENT;
    memcpy(low, copy.low, sizeof copy.low);
    memcpy(high, copy.high, sizeof copy.high);
    return SPT_OK;
}

/* What a caller's own volume says of a ray in its own units. */
static void narrow(const spt_bound *copy, const interval_ray *ray, float *from, float *to) {
    SPTI_ALIGNED(64) float origin[3][SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float direction[3][SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float t_in[SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float t_out[SPTI_BOUND_GROUP];
    const float *const origins[3] = {origin[0], origin[1], origin[2]};
    const float *const directions[3] = {direction[0], direction[1], direction[2]};
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < SPTI_BOUND_GROUP; ++i) {
            origin[axis][i] = ray->origin[axis];
            direction[axis][i] = ray->direction[axis];
        }
    }
    spti_bound_ask(copy, 1, origins, directions, t_in, t_out);
    spti_bound_cut(t_in[0], t_out[0], from, to);
}

void spti_bound_interval(const spt_bound *copy, const float origin[3], const float direction[3],
                         float t_min, float t_max, float *t_in, float *t_out) {
    interval_ray ray;
    float largest = 0.0f, square = 0.0f;
    ray.reach = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        ray.reach = spt_max(ray.reach, fabsf(origin[axis]));
        largest = spt_max(largest, fabsf(direction[axis]));
    }
    const float power = interval_power(largest), unit = 1.0f / power;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = origin[axis];
        ray.direction[axis] = direction[axis] * unit;
        square += ray.direction[axis] * ray.direction[axis];
    }
    ray.length = sqrtf(square);
    float from = t_min * power, to = t_max * power;
    interval_of_bound(copy, spti_bound_size(copy), &ray, &from, &to);
    if (spti_bound_asks(copy) && from <= to) narrow(copy, &ray, &from, &to);
    /* Scaling loses bits of denormal numbers, and range at its ends. */
    const float first = spt_max(from * unit, t_min), last = spt_min(to * unit, t_max);
    const int inside = from <= to && first <= last && first < INFINITY; /* not at infinity */
    *t_in = inside ? first : INFINITY;
    *t_out = inside ? last : -INFINITY;
}

spt_status spt_bound_interval(const spt_bound *bound, const float origin[3],
                              const float direction[3], float t_min, float t_max, float *t_in,
                              float *t_out) {
    spt_bound copy;
    float largest = 0.0f;
    if (bound == NULL || origin == NULL || direction == NULL) return SPT_BAD_ARGUMENT;
    if (t_in == NULL || t_out == NULL || !spti_bound_copy(&copy, bound)) return SPT_BAD_ARGUMENT;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(origin[axis]) || !spti_finite(direction[axis])) return SPT_BAD_ARGUMENT;
        largest = spt_max(largest, fabsf(direction[axis]));
    }
    if (!(largest >= FLT_MIN) || !(t_min >= 0.0f) || !spti_finite(t_min) || !(t_max <= INFINITY)) {
        return SPT_BAD_ARGUMENT;
    }
    spti_bound_interval(&copy, origin, direction, t_min, t_max, t_in, t_out);
    return SPT_OK;
}

/* ---- Cones ---------------------------------------------------------------------------------- */

/* The sphere around a copy of a volume. Returns 0 where it has no end. */
static int sphere_around(const spt_bound *copy, double center[3], double *radius) {
    double square = 0;
    *radius = (double)copy->radius;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = (double)copy->low[axis], high = (double)copy->high[axis];
        const int ball = copy->kind == SPT_BOUND_SPHERE;
        if (!spti_finite(copy->low[axis]) || !spti_finite(copy->high[axis])) return 0;
        center[axis] = ball ? (double)copy->center[axis] : low + 0.5 * (high - low);
        square += 0.25 * (high - low) * (high - low);
    }
    if (copy->kind != SPT_BOUND_SPHERE) *radius = sqrt(square);
    return 1;
}

/* The distance from a point that is `along` the axis of the cone and `beside` it to its points
 * within t_max of the apex. */
static double cone_apart(double along, double beside, double chord, double t_max) {
    /* Of the half angle, whose chord on the unit circle it is. */
    const double cosine = 1.0 - 0.5 * chord * chord;
    const double sine = chord * sqrt(1.0 - 0.25 * chord * chord);
    const double off = beside * cosine - along * sine; /* from the cone's side */
    if (off <= 0.0 && along >= 0.0) {
        const double distance = sqrt(along * along + beside * beside);
        return distance > t_max ? distance - t_max : 0.0;
    }
    const double place = along * cosine + beside * sine;
    const double beyond = place < 0.0 ? place : place > t_max ? place - t_max : 0.0;
    return sqrt(off * off + beyond * beyond);
}

spt_status spt_bound_meets_cone(const spt_bound *bound, const float origin[3],
                                const float direction[3], float chord, float t_max, int *meets) {
    spt_bound copy;
    float largest = 0.0f;
    double center[3], radius, along = 0, length = 0, offset = 0;
    if (bound == NULL || origin == NULL || direction == NULL || meets == NULL) {
        return SPT_BAD_ARGUMENT;
    }
    if (!spti_bound_copy(&copy, bound)) return SPT_BAD_ARGUMENT;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(origin[axis]) || !spti_finite(direction[axis])) return SPT_BAD_ARGUMENT;
        largest = spt_max(largest, fabsf(direction[axis]));
        length += (double)direction[axis] * (double)direction[axis];
    }
    if (!(largest >= FLT_MIN) || !(chord >= 0.0f) || !(chord < 1.0f) || !(t_max <= INFINITY)) {
        return SPT_BAD_ARGUMENT;
    }
    if (!sphere_around(&copy, center, &radius)) {
        *meets = 1;
        return SPT_OK;
    }
    length = sqrt(length);
    for (int axis = 0; axis < 3; ++axis) {
        center[axis] -= (double)origin[axis];
        along += center[axis] * ((double)direction[axis] / length);
        offset += center[axis] * center[axis];
    }
    double beside = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = center[axis] - along * ((double)direction[axis] / length);
        beside += side * side;
    }
    const double reach = (double)t_max * length;
    const double rounding = (sqrt(offset) + radius) * 0x1p-44;
    *meets =
        reach >= 0.0 && cone_apart(along, sqrt(beside), (double)chord, reach) <= radius + rounding;
    return SPT_OK;
}
