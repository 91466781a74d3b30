/* SPDX-License-Identifier: MIT
 *
 * Where rays are inside a bounding volume. A template over SPT_LANES.
 * Defines interval_of_bound(), which narrows [t_min, t_max]; an empty interval has t_min > t_max. */
#ifndef SPTI_INTERVAL_KERNEL_H
#define SPTI_INTERVAL_KERNEL_H

#include <spheretrace/bound.h>

#include <math.h>

#include "../base/arguments.h"
#include "../lanes/lanes.h"
#include "bound_check.h"

typedef struct interval_ray {
    spt_wide origin[3], direction[3];
    spt_wide length; /* of the direction */
    spt_wide reach;  /* largest magnitude in the origin */
} interval_ray;

/* The rounding floor at t, in t. */
SPTI_INLINE spt_wide interval_slack(const interval_ray *ray, spt_wide size, spt_wide t) {
    const spt_wide at_0 = spt_div(spt_add(ray->reach, size), ray->length);
    return spt_mul(spt_splat(SPTI_FLOOR), spt_add(at_0, spt_abs(t)));
}

/* A magnitude with the sign of another number. */
SPTI_INLINE spt_wide interval_signed(spt_wide magnitude, spt_wide sign) {
    const spt_wide zero = spt_splat(0.0f);
    return spt_select(spt_less(sign, zero), spt_sub(zero, magnitude), magnitude);
}

/* Slabs, by division: the usual multiplication by 1 / direction makes 0 * infinity of a ray that
 * lies in a face, and loses half or all of such rays. */
SPTI_INLINE void interval_of_box(const spt_bound *bound, const interval_ray *ray, spt_wide *entry,
                                 spt_wide *exit) {
    const spt_wide infinity = spt_splat(INFINITY);
    const spt_wide minus_infinity = spt_splat(-INFINITY);
    *entry = minus_infinity;
    *exit = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide low = spt_splat(bound->low[axis]), high = spt_splat(bound->high[axis]);
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
        *entry = spt_max(spt_select(parallel, near, spt_min(a, b)), *entry);
        *exit = spt_min(spt_select(parallel, far, spt_max(a, b)), *exit);
    }
}

/* The discriminant from the ray's closest approach, which does not cancel for far or small spheres
 * as B^2 - AC does; and the second root from the product of both. */
SPTI_INLINE void interval_of_sphere(const spt_bound *bound, const interval_ray *ray,
                                    spt_wide *entry, spt_wide *exit) {
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
    *entry = spt_select(touched, spt_min(first, second), spt_splat(INFINITY));
    *exit = spt_select(touched, spt_max(first, second), spt_splat(-INFINITY));
}

SPTI_INLINE void interval_of_bound(const spt_bound *bound, const interval_ray *ray, spt_wide *t_min,
                                   spt_wide *t_max) {
    const spt_wide size = spt_splat(spti_bound_size(bound));
    spt_wide entry, exit;
    if (bound->kind == SPT_BOUND_SPHERE) {
        interval_of_sphere(bound, ray, &entry, &exit);
    } else {
        interval_of_box(bound, ray, &entry, &exit);
    }
    const spt_mask empty = spt_less(exit, entry);
    entry = spt_select(empty, spt_splat(0.0f), entry); /* no infinity - infinity */
    exit = spt_select(empty, spt_splat(0.0f), exit);
    entry = spt_sub(entry, interval_slack(ray, size, entry));
    exit = spt_add(exit, interval_slack(ray, size, exit));
    *t_min = spt_max(spt_select(empty, spt_splat(INFINITY), entry), *t_min);
    *t_max = spt_min(spt_select(empty, spt_splat(-INFINITY), exit), *t_max);
}

#endif
