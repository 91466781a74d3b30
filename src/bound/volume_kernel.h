/* SPDX-License-Identifier: MIT
 *
 * Where rays are inside a bounding volume of any kind. A template over SPT_LANES.
 * Defines interval_of_bound(), which narrows [t_min, t_max], t_min >= 0; where empty, t_min >
 * t_max. Of a caller's own volume the kernels know the box (spti_bound_ask() the rest).
 *
 * Every volume here is cut from two shapes: the points behind a plane, and those within a radius of
 * the origin in axes of the volume. Neither axes nor normals need be of unit length or at right
 * angles for that: the volume is the set that its inequalities in bound.h define.
 * In the comments u = 2^-24, and SPTI_FLOOR = 4u; terms of the order of u^2 are left out. */
#ifndef SPTI_VOLUME_KERNEL_H
#define SPTI_VOLUME_KERNEL_H

#include "interval_kernel.h"

typedef struct volume_interval {
    spt_wide in, out;
} volume_interval;

SPTI_INLINE volume_interval volume_everywhere(void) {
    const volume_interval all = {spt_splat(-INFINITY), spt_splat(INFINITY)};
    return all;
}

SPTI_INLINE spt_wide volume_dot(const spt_wide a[3], const spt_wide b[3]) {
    return spt_add(spt_add(spt_mul(a[0], b[0]), spt_mul(a[1], b[1])), spt_mul(a[2], b[2]));
}

SPTI_INLINE void volume_cross(const spt_wide a[3], const spt_wide b[3], spt_wide to[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        to[axis] = spt_sub(spt_mul(a[j], b[k]), spt_mul(a[k], b[j]));
    }
}

SPTI_INLINE void volume_splat(const float vector[3], spt_wide to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = spt_splat(vector[axis]);
}

/* Of the origin from a point of the volume. */
SPTI_INLINE void volume_offset(const interval_ray *ray, const float from[3], spt_wide to[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        to[axis] = spt_sub(ray->origin[axis], spt_splat(from[axis]));
    }
}

/* ---- Planes --------------------------------------------------------------------------------- */

/* Cuts with t rate <= room, t >= 0. By division: where the rate is 0 nothing is divided, since room
 * times an infinite inverse would be NaN for a ray that lies in the face. */
SPTI_INLINE void volume_cut(spt_wide room, spt_wide rate, volume_interval *inside) {
    const spt_wide zero = spt_splat(0.0f);
    const spt_mask leaves = spt_less(zero, rate), enters = spt_less(rate, zero);
    const spt_mask crosses = spt_mask_or(leaves, enters);
    const spt_mask outside = spt_mask_and_not(spt_less(room, zero), crosses);
    const spt_wide t = spt_div(room, spt_select(crosses, rate, spt_splat(1.0f)));
    const spt_wide in = spt_max(interval_earlier(t), inside->in);
    const spt_wide out = spt_min(interval_later(t), inside->out);
    inside->in = spt_select(outside, spt_splat(INFINITY), spt_select(enters, in, inside->in));
    inside->out = spt_select(outside, spt_splat(-INFINITY), spt_select(leaves, out, inside->out));
}

/* How rays run towards the planes normal . p = offset. */
typedef struct volume_facing {
    spt_wide place, rate; /* normal . origin, normal . direction, */
    spt_wide blur, tilt;  /* and the sums of the magnitudes of their terms */
} volume_facing;

SPTI_INLINE volume_facing volume_face(const spt_wide normal[3], const spt_wide origin[3],
                                      const spt_wide direction[3]) {
    volume_facing facing;
    facing.place = facing.rate = facing.blur = facing.tilt = spt_splat(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide place = spt_mul(normal[axis], origin[axis]);
        const spt_wide rate = spt_mul(normal[axis], direction[axis]);
        facing.place = spt_add(facing.place, place);
        facing.rate = spt_add(facing.rate, rate);
        facing.blur = spt_add(facing.blur, spt_abs(place));
        facing.tilt = spt_add(facing.tilt, spt_abs(rate));
    }
    return facing;
}

/* Behind one of them. A sum of three products is off by 3u of their magnitudes, by 4u if one factor
 * is a difference, and by 5u if the other was rounded, too: so the face moves out by 8u of them,
 * and turns out by as much. What rounding does to room and rate after that is relative to t, and
 * the ends are moved by more. */
static SPTI_NOINLINE void volume_behind(const volume_facing *facing, spt_wide offset,
                                        volume_interval *inside) {
    const spt_wide twice = spt_splat(2 * SPTI_FLOOR);
    const spt_wide margin = spt_mul(twice, spt_add(facing->blur, spt_abs(offset)));
    const spt_wide room = spt_add(spt_sub(offset, facing->place), margin);
    volume_cut(room, spt_sub(facing->rate, spt_mul(twice, facing->tilt)), inside);
}

/* Between two of them, from <= normal . p <= to. */
static SPTI_NOINLINE void volume_between(const spt_wide normal[3], const spt_wide origin[3],
                                         const spt_wide direction[3], spt_wide from, spt_wide to,
                                         volume_interval *inside) {
    const spt_wide zero = spt_splat(0.0f);
    volume_facing facing = volume_face(normal, origin, direction);
    volume_behind(&facing, to, inside);
    facing.place = spt_sub(zero, facing.place);
    facing.rate = spt_sub(zero, facing.rate);
    volume_behind(&facing, spt_sub(zero, from), inside);
}

/* A caller's normal by a power of two, so that none over- or underflows. Returns that power. */
SPTI_INLINE spt_wide volume_normal(const float normal[3], spt_wide to[3]) {
    const float x = fabsf(normal[0]), y = fabsf(normal[1]), z = fabsf(normal[2]);
    const float more = x > y ? x : y, most = more > z ? more : z;
    const spt_wide unit = spt_div(spt_splat(1.0f), interval_power(spt_splat(most)));
    for (int axis = 0; axis < 3; ++axis) to[axis] = spt_mul(spt_splat(normal[axis]), unit);
    return unit;
}

/* Behind a caller's plane; towards: 1, or -1 for the points before it. */
static SPTI_NOINLINE void volume_plane(const float normal[3], float offset, float towards,
                                       const interval_ray *ray, volume_interval *inside) {
    spt_wide scaled[3];
    const spt_wide unit = spt_mul(volume_normal(normal, scaled), spt_splat(towards));
    for (int axis = 0; axis < 3; ++axis) scaled[axis] = spt_mul(scaled[axis], spt_splat(towards));
    const volume_facing facing = volume_face(scaled, ray->origin, ray->direction);
    volume_behind(&facing, spt_mul(spt_splat(offset), unit), inside);
}

SPTI_INLINE void volume_slab(const spt_bound *bound, const interval_ray *ray,
                             volume_interval *inside) {
    volume_plane(bound->axis[0], bound->range[1], 1.0f, ray, inside);
    volume_plane(bound->axis[0], bound->range[0], -1.0f, ray, inside);
}

SPTI_INLINE void volume_polytope(const spt_bound *bound, const interval_ray *ray,
                                 volume_interval *inside) {
    for (size_t i = 0; i < bound->plane_count; ++i) {
        volume_plane(bound->planes[i].normal, bound->planes[i].offset, 1.0f, ray, inside);
    }
}

SPTI_INLINE void volume_oriented_box(const spt_bound *bound, const interval_ray *ray,
                                     volume_interval *inside) {
    spt_wide offset[3];
    volume_offset(ray, bound->center, offset);
    for (int i = 0; i < 3; ++i) {
        spt_wide normal[3];
        volume_splat(bound->axis[i], normal);
        volume_between(normal, offset, ray->direction, spt_splat(-bound->half[i]),
                       spt_splat(bound->half[i]), inside);
    }
}

/* ---- Round volumes -------------------------------------------------------------------------- */

/* Where |x + t d| <= radius; all t where d is 0. Right for the x and d that it gets:
 *   closest is off by 7u |x| / |d|: 3u |x| |d| of the product, 3u of its divisor and 1u of the
 *       quotient. The ends are moved by 8u |x| / |d| for that;
 *   side is taken at a t that is off as much, so (8u |x|)^2 is added to the square of the radius;
 *       it is rounded by u |x| + u |side| itself, and squares, root and quotient by 8u radius: the
 *       radius that is passed must have grown by u |x| + 9u radius.
 * Where squares overflow everything is NaN, which is no constraint. */
static SPTI_NOINLINE void volume_within(const spt_wide x[3], const spt_wide d[3], spt_wide radius,
                                        volume_interval *inside) {
    const spt_wide zero = spt_splat(0.0f), twice = spt_splat(2 * SPTI_FLOOR);
    const spt_wide a = volume_dot(d, d), c = volume_dot(x, x);
    /* Along the axis of a cylinder: in 1e-19 of the length x does not change. */
    const spt_mask parallel = spt_less(a, spt_splat(FLT_MIN));
    const spt_wide divisor = spt_select(parallel, spt_splat(1.0f), a);
    const spt_wide moving = spt_div(volume_dot(x, d), divisor);
    const spt_wide closest = spt_select(parallel, zero, moving);
    spt_wide side[3];
    for (int axis = 0; axis < 3; ++axis) {
        side[axis] = spt_sub(x[axis], spt_mul(closest, d[axis]));
    }
    const spt_wide square = spt_add(spt_mul(radius, radius), spt_mul(spt_mul(twice, twice), c));
    const spt_wide room = spt_sub(square, volume_dot(side, side));
    const spt_mask missed = spt_less(room, zero);
    const spt_wide moved = spt_mul(twice, spt_sqrt(spt_div(c, divisor)));
    const spt_wide half = spt_add(spt_sqrt(spt_div(spt_max(zero, room), divisor)), moved);
    const spt_wide reach = spt_select(parallel, spt_splat(INFINITY), half);
    const spt_wide in = interval_earlier(spt_sub(spt_sub(zero, closest), reach));
    const spt_wide out = interval_later(spt_sub(reach, closest));
    inside->in = spt_select(missed, spt_splat(INFINITY), in);
    inside->out = spt_select(missed, spt_splat(-INFINITY), out);
}

/* The hull of two intervals, of which the second is infinite where empty. */
SPTI_INLINE volume_interval volume_hull(volume_interval a, volume_interval b) {
    const spt_mask none = spt_less(a.out, a.in);
    a.in = spt_select(none, b.in, spt_min(a.in, b.in));
    a.out = spt_select(none, b.out, spt_max(a.out, b.out));
    return a;
}

/* How much the radius of a tube must grow. x is off by 1u of the distance from the rounding of the
 * difference and by 2.4u from that of the cross product; t d by the same 2.4u of a way that is at
 * most the distance and the size of the volume; the axis by 1u of the size, in direction and length
 * each. With what volume_within() asks for that is 7u of the distance and 14u of the size. */
SPTI_INLINE spt_wide volume_tube_blur(const spt_wide offset[3], float size) {
    const spt_wide distance = spt_sqrt(volume_dot(offset, offset));
    return spt_add(spt_mul(spt_splat(2 * SPTI_FLOOR), distance), spt_splat(4 * SPTI_FLOOR * size));
}

static SPTI_NOINLINE volume_interval volume_ball(const spt_bound *bound, const float center[3],
                                                 const interval_ray *ray) {
    spt_wide offset[3];
    volume_interval inside;
    volume_offset(ray, center, offset);
    const spt_wide blur = volume_tube_blur(offset, bound->radius);
    volume_within(offset, ray->direction, spt_add(spt_splat(bound->radius), blur), &inside);
    return inside;
}

/* Within the radius of the line, and between the planes through its ends. */
SPTI_INLINE volume_interval volume_cylinder(const spt_bound *bound, const interval_ray *ray) {
    spt_wide axis[3], offset[3], across[3], moving[3];
    const float length = bound->half[0];
    volume_splat(bound->axis[0], axis);
    volume_offset(ray, bound->center, offset);
    volume_cross(offset, axis, across);
    volume_cross(ray->direction, axis, moving);
    const spt_wide blur = volume_tube_blur(offset, length + bound->radius);
    volume_interval inside;
    volume_within(across, moving, spt_add(spt_splat(bound->radius), blur), &inside);
    volume_between(axis, offset, ray->direction, spt_splat(0.0f), spt_splat(length), &inside);
    return inside;
}

/* In the axes of the ellipsoid, scaled so that it becomes a ball of its longest half axis. There
 * the distance is at most range[0] times as long, and off by 6u of that (difference, dot product,
 * share and quotient), and the direction by 5u: with what volume_within() asks for 12u of the
 * distance and 11u of the radius, times range[0]. */
SPTI_INLINE void volume_ellipsoid(const spt_bound *bound, const interval_ray *ray,
                                  volume_interval *inside) {
    spt_wide offset[3], x[3], d[3];
    const spt_wide radius = spt_splat(bound->radius);
    volume_offset(ray, bound->center, offset);
    for (int i = 0; i < 3; ++i) {
        spt_wide axis[3];
        const spt_wide share = spt_splat(bound->end[i]);
        volume_splat(bound->axis[i], axis);
        x[i] = spt_div(volume_dot(axis, offset), share);
        d[i] = spt_div(volume_dot(axis, ray->direction), share);
    }
    const spt_wide size = spt_add(spt_sqrt(volume_dot(offset, offset)), radius);
    const spt_wide blur =
        spt_mul(spt_mul(spt_splat(4 * SPTI_FLOOR), size), spt_splat(bound->range[0]));
    volume_within(x, d, spt_add(radius, blur), inside);
}

/* ---- Any volume ----------------------------------------------------------------------------- */

/* Of what has more than a hull, that. */
static SPTI_NOINLINE void interval_of_volume(const spt_bound *bound, const interval_ray *ray,
                                             volume_interval *inside) {
    *inside = volume_everywhere();
    if (bound->kind == SPT_BOUND_ORIENTED_BOX) {
        volume_oriented_box(bound, ray, inside);
    } else if (bound->kind == SPT_BOUND_CYLINDER || bound->kind == SPT_BOUND_CAPSULE) {
        *inside = volume_cylinder(bound, ray);
        if (bound->kind == SPT_BOUND_CAPSULE) {
            *inside = volume_hull(*inside, volume_hull(volume_ball(bound, bound->center, ray),
                                                       volume_ball(bound, bound->end, ray)));
        }
    } else if (bound->kind == SPT_BOUND_ELLIPSOID) {
        volume_ellipsoid(bound, ray, inside);
    } else if (bound->kind == SPT_BOUND_SLAB) {
        volume_slab(bound, ray, inside);
    } else {
        volume_polytope(bound, ray, inside);
    }
}

/* bound is a copy (bound_check.h), size its spti_bound_size(). */
SPTI_INLINE void interval_of_bound(const spt_bound *bound, float size, const interval_ray *ray,
                                   spt_wide *t_min, spt_wide *t_max) {
    if (interval_has_hull(bound)) interval_of_hull(bound, size, ray, t_min, t_max);
    if (interval_has_more(bound)) {     /* off the way of spheres and boxes */
        const interval_ray copy = *ray; /* only this one need be in memory */
        volume_interval inside;
        interval_of_volume(bound, &copy, &inside);
        *t_min = spt_max(inside.in, *t_min);
        *t_max = spt_min(inside.out, *t_max);
    }
}

#endif
