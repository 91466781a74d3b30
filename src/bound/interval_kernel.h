/* SPDX-License-Identifier: MIT
 *
 * Where rays are inside a sphere or a box at right angles to the axes. A template over SPT_LANES.
 * Defines interval_of_hull(), which narrows [t_min, t_max]; where empty, t_min > t_max. The other
 * volumes are in volume_kernel.h. */
#ifndef SPTI_INTERVAL_KERNEL_H
#define SPTI_INTERVAL_KERNEL_H

#include <spheretrace/bound.h>

#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../lanes/lanes.h"
#include "bound_check.h"

typedef struct interval_ray {
    spt_wide origin[3], direction[3];
    spt_wide length; /* of the direction */
    spt_wide reach;  /* largest magnitude in the origin */
} interval_ray;

/* t moved by the part of the rounding floor that grows with it; infinities stay. */
SPTI_INLINE spt_wide interval_earlier(spt_wide t) {
    const spt_wide less = spt_splat(1.0f - SPTI_FLOOR), more = spt_splat(1.0f + SPTI_FLOOR);
    return spt_mul(t, spt_select(spt_less(t, spt_splat(0.0f)), more, less));
}

SPTI_INLINE spt_wide interval_later(spt_wide t) {
    const spt_wide less = spt_splat(1.0f - SPTI_FLOOR), more = spt_splat(1.0f + SPTI_FLOOR);
    return spt_mul(t, spt_select(spt_less(t, spt_splat(0.0f)), less, more));
}

/* The power of two in whose units a direction is traced, from its largest component: then no length
 * over- or underflows. 2^127 has no normal inverse, so at most 2^126. */
SPTI_INLINE spt_wide interval_power(spt_wide largest) {
    return spti_power_of_two(spt_min(spt_max(largest, spt_splat(FLT_MIN)), spt_splat(0x1p126f)));
}

/* A magnitude with the sign of another number. */
SPTI_INLINE spt_wide interval_signed(spt_wide magnitude, spt_wide sign) {
    const spt_wide zero = spt_splat(0.0f);
    return spt_select(spt_less(sign, zero), spt_sub(zero, magnitude), magnitude);
}

/* Slabs, by division: the usual multiplication by 1 / direction makes 0 * infinity of a ray that
 * lies in a face, and loses half or all of such rays. */
SPTI_INLINE void interval_of_box(const spt_bound *bound, const interval_ray *ray, spt_wide size,
                                 spt_wide *t_in, spt_wide *t_out) {
    const spt_wide infinity = spt_splat(INFINITY);
    const spt_wide minus_infinity = spt_splat(-INFINITY);
    *t_in = minus_infinity;
    *t_out = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        /* Widened a face at a time, so that a ray that touches an edge is not lost to rounding. */
        const spt_wide margin = spt_mul(spt_splat(SPTI_FLOOR), spt_add(ray->reach, size));
        const spt_wide low = spt_sub(spt_splat(bound->low[axis]), margin);
        const spt_wide high = spt_add(spt_splat(bound->high[axis]), margin);
        const spt_wide origin = ray->origin[axis], direction = ray->direction[axis];
        const spt_wide magnitude = spt_max(spt_abs(direction), spt_splat(FLT_MIN));
        const spt_mask parallel = spt_less(spt_abs(direction), spt_splat(FLT_MIN));
        const spt_wide divisor = interval_signed(magnitude, direction);
        const spt_wide a = spt_div(spt_sub(low, origin), divisor);
        const spt_wide b = spt_div(spt_sub(high, origin), divisor);
        const spt_mask within =
            spt_mask_and(spt_less_equal(low, origin), spt_less_equal(origin, high));
        const spt_wide near = spt_select(within, minus_infinity, infinity);
        const spt_wide far = spt_select(within, infinity, minus_infinity);
        const spt_wide first = interval_earlier(spt_min(a, b)),
                       last = interval_later(spt_max(a, b));
        *t_in = spt_max(spt_select(parallel, near, first), *t_in);
        *t_out = spt_min(spt_select(parallel, far, last), *t_out);
    }
}

/* The discriminant from the ray's closest approach, which does not cancel for far or small spheres
 * as B^2 - AC does; and the second root from the product of both. */
SPTI_INLINE void interval_of_sphere(const spt_bound *bound, const interval_ray *ray, spt_wide size,
                                    spt_wide *t_in, spt_wide *t_out) {
    const spt_wide zero = spt_splat(0.0f), radius = spt_splat(bound->radius);
    spt_wide offset[3], a = zero, b = zero, c = zero, apart = zero;
    for (int axis = 0; axis < 3; ++axis) {
        offset[axis] = spt_sub(ray->origin[axis], spt_splat(bound->center[axis]));
        a = spt_add(a, spt_mul(ray->direction[axis], ray->direction[axis]));
        b = spt_add(b, spt_mul(ray->direction[axis], offset[axis]));
        c = spt_add(c, spt_mul(offset[axis], offset[axis]));
    }
    const spt_wide closest = spt_div(b, a);
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide side = spt_sub(offset[axis], spt_mul(closest, ray->direction[axis]));
        apart = spt_add(apart, spt_mul(side, side));
    }
    /* The radius grows by the rounding of this computation, so that no touching ray is lost. */
    const spt_wide grown =
        spt_add(radius, spt_mul(spt_splat(SPTI_FLOOR), spt_add(ray->reach, spt_sqrt(c))));
    const spt_wide square = spt_mul(grown, grown);
    const spt_wide room = spt_sub(square, apart);
    const spt_mask touched = spt_less_equal(zero, room);
    const spt_wide root = spt_sqrt(spt_mul(a, spt_select(touched, room, zero)));
    const spt_wide magnitude = spt_add(spt_abs(b), root);
    const spt_wide k = interval_signed(spt_max(magnitude, spt_splat(FLT_MIN)), spt_sub(zero, b));
    const spt_wide first = spt_div(k, a);
    const spt_wide product = spt_sub(c, square);
    const spt_wide second = spt_select(spt_less_equal(magnitude, zero), zero, spt_div(product, k));
    const spt_wide margin =
        spt_div(spt_mul(spt_splat(SPTI_FLOOR), spt_add(ray->reach, size)), ray->length);
    const spt_wide enters = spt_sub(interval_earlier(spt_min(first, second)), margin);
    const spt_wide leaves = spt_add(interval_later(spt_max(first, second)), margin);
    *t_in = spt_select(touched, enters, spt_splat(INFINITY));
    *t_out = spt_select(touched, leaves, spt_splat(-INFINITY));
}

/* Whether a volume lies within a sphere or box that is to be cut with; and whether it is less than
 * that, as far as the kernels know it. */
SPTI_INLINE int interval_has_hull(const spt_bound *bound) {
    return bound->kind == SPT_BOUND_SPHERE || bound->kind == SPT_BOUND_BOX ||
           bound->kind >= SPT_BOUND_SLAB;
}

SPTI_INLINE int interval_has_more(const spt_bound *bound) {
    return bound->kind > SPT_BOUND_BOX && bound->kind != SPT_BOUND_CALLBACK;
}

/* Of a sphere, or of the box that a copy of any other volume holds (bound_check.h). size is that of
 * the volume. */
SPTI_INLINE void interval_of_hull(const spt_bound *bound, float size, const interval_ray *ray,
                                  spt_wide *t_min, spt_wide *t_max) {
    spt_wide t_in, t_out;
    if (bound->kind == SPT_BOUND_SPHERE) {
        interval_of_sphere(bound, ray, spt_splat(size), &t_in, &t_out);
    } else {
        interval_of_box(bound, ray, spt_splat(size), &t_in, &t_out);
    }
    *t_min = spt_max(t_in, *t_min);
    *t_max = spt_min(t_out, *t_max);
}

#endif
