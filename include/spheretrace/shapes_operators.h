/* SPDX-License-Identifier: MIT
 *
 * What combines distances (unions, blends, with and without materials) and what moves and deforms
 * the point before a distance is asked. The rules that hold for all are in shapes.h. Left out:
 * the bodies themselves. */
#ifndef SPHERETRACE_SHAPES_OPERATORS_H
#define SPHERETRACE_SHAPES_OPERATORS_H

#include "shapes_math.h"

/* ---- Operators on distances. L of the result is the larger of the two. ---- */

/* Both bodies. Exact outside if both are; inside a lower bound. */
SPT_SHAPE spt_real spt_union(spt_real a, spt_real b) {
    return spt_least(a, b);
}

/* What the two have in common. A lower bound outside, exact inside if both are. Convex if both
 * are. */
SPT_SHAPE spt_real spt_intersection(spt_real a, spt_real b) {
    return spt_greatest(a, b);
}

/* a without b. A lower bound on both sides. */
SPT_SHAPE spt_real spt_difference(spt_real a, spt_real b) {
    return spt_greatest(a, -b);
}

/* Both bodies, blended where |a - b| < k. k >= 0, a length: the blend adds at most k/4, where
 * a = b; 0 gives spt_union(). The quadratic polynomial minimum, min(a, b) - h^2/(4k) with
 * h = max(0, k - |a - b|). Never above min(a, b), so the body contains the union. Its derivatives
 * by a and b are both in [0, 1] and have the sum 1 (they are 1 - h/(2k) for the smaller and h/(2k)
 * for the larger), so that its gradient is a mean of the two gradients: L of the result is the
 * larger of the two, and it is a lower bound of the distance to the blended body. 8 flop, and a
 * division that depends on k only. */
SPT_SHAPE spt_real spt_smooth_union(spt_real a, spt_real b, spt_real k) {
    const spt_real quarter = (spt_real)0.25 / (k + SPT_REAL_MIN); /* finite if k = 0 */
    /* zero for inf - inf */
    const spt_real h = spt_greatest(k - spt_magnitude(a - b), spti_shape_zero(a));
    return spt_least(a, b) - h * (h * quarter);
}

/* What the two have in common, its edges rounded off: -spt_smooth_union(-a, -b, k), so never below
 * max(a, b), and the body lies in the intersection. The rest as there. Convex if both are. */
SPT_SHAPE spt_real spt_smooth_intersection(spt_real a, spt_real b, spt_real k) {
    return -spt_smooth_union(-a, -b, k);
}

/* a without b, the edges rounded off: the smooth intersection of a with the outside of b. */
SPT_SHAPE spt_real spt_smooth_difference(spt_real a, spt_real b, spt_real k) {
    return spt_smooth_intersection(a, -b, k);
}

/* ---- The same with a material, which goes to whose distance decides (Keinert et al. 2014, 4). */

typedef struct spt_surface {
    spt_real distance;
    int32_t material; /* any number the caller likes */
} spt_surface;

SPT_SHAPE spt_surface spt_surface_of(spt_real distance, int32_t material) {
    spt_surface surface;
    surface.distance = distance;
    surface.material = material;
    return surface;
}

/* spt_union() with the material of the smaller distance, b's where they are equal. */
SPT_SHAPE spt_surface spt_surface_union(spt_surface a, spt_surface b) {
    return spt_surface_of(spt_union(a.distance, b.distance),
                          a.distance < b.distance ? a.material : b.material);
}

/* spt_intersection() with the material of the larger distance, b's where they are equal. */
SPT_SHAPE spt_surface spt_surface_intersection(spt_surface a, spt_surface b) {
    return spt_surface_of(spt_intersection(a.distance, b.distance),
                          a.distance > b.distance ? a.material : b.material);
}

/* spt_difference(): the walls of the cut have b's material. */
SPT_SHAPE spt_surface spt_surface_difference(spt_surface a, spt_surface b) {
    return spt_surface_of(spt_difference(a.distance, b.distance),
                          a.distance > -b.distance ? a.material : b.material);
}

/* spt_smooth_union(), spt_smooth_intersection() and spt_smooth_difference() likewise; materials do
 * not blend, the border runs through the middle of the blend. */
SPT_SHAPE spt_surface spt_surface_smooth_union(spt_surface a, spt_surface b, spt_real k) {
    return spt_surface_of(spt_smooth_union(a.distance, b.distance, k),
                          a.distance < b.distance ? a.material : b.material);
}

SPT_SHAPE spt_surface spt_surface_smooth_intersection(spt_surface a, spt_surface b, spt_real k) {
    return spt_surface_of(spt_smooth_intersection(a.distance, b.distance, k),
                          a.distance > b.distance ? a.material : b.material);
}

SPT_SHAPE spt_surface spt_surface_smooth_difference(spt_surface a, spt_surface b, spt_real k) {
    return spt_surface_of(spt_smooth_difference(a.distance, b.distance, k),
                          a.distance > -b.distance ? a.material : b.material);
}

/* ---- Operators on points: what they do to the shape is done to the point backwards. ---- */

/* Moves the shape by offset. Exact, as all rigid motions. 3 flop. */
SPT_SHAPE spt_point spt_translate(spt_point p, spt_point offset) {
    return spt_point_of(p.x - offset.x, p.y - offset.y, p.z - offset.z);
}

/* A rotation, made by spt_rotation_of(): the images of the three axes. */
typedef struct spt_rotation {
    spt_point x, y, z;
} spt_rotation;

/* Rotation about an axis through the origin, right-handed, by an angle in radians, |angle| <= 1e5.
 * axis: of any length; one below 1e-18 gives no rotation. Computed in double and rounded, without
 * libm but for the square root. */
static inline spt_rotation spt_rotation_of(spt_point axis, spt_real angle) {
    const double square = (double)axis.x * (double)axis.x + (double)axis.y * (double)axis.y +
                          (double)axis.z * (double)axis.z;
    const int none = !(square > 1e-36);
    const double inverse = none ? 0 : 1 / sqrt(square);
    const double x = (double)axis.x * inverse, y = (double)axis.y * inverse,
                 z = (double)axis.z * inverse;
    const double s = none ? 0 : spti_shape_sin_double((double)angle);
    const double c = none ? 1 : spti_shape_cos_double((double)angle);
    const double t = 1 - c; /* Rodrigues */
    spt_rotation rotation;
    rotation.x = spt_point_of((spt_real)(c + t * x * x), (spt_real)(t * x * y + s * z),
                              (spt_real)(t * x * z - s * y));
    rotation.y = spt_point_of((spt_real)(t * x * y - s * z), (spt_real)(c + t * y * y),
                              (spt_real)(t * y * z + s * x));
    rotation.z = spt_point_of((spt_real)(t * x * z + s * y), (spt_real)(t * y * z - s * x),
                              (spt_real)(c + t * z * z));
    return rotation;
}

/* Rotates the shape: the point is turned back. Lengths change by at most 1.5e-7 of themselves, the
 * rounding of the rotation. 15 flop. */
SPT_SHAPE spt_point spt_rotate(spt_point p, const spt_rotation *rotation) {
    return spt_point_of(spt_dot(rotation->x, p), spt_dot(rotation->y, p), spt_dot(rotation->z, p));
}

/* Scales the shape by factor > 0. Multiply the distance by factor afterwards: it is then exact if
 * it was, and L is what it was. 3 divisions; with a power of two, exact. */
SPT_SHAPE spt_point spt_scale(spt_point p, spt_real factor) {
    return spt_point_of(p.x / factor, p.y / factor, p.z / factor);
}

/* Repeats the shape with the period (a length) along each axis; a period of 0 leaves that axis
 * alone. There are 2^22 copies on each side of the first, which stands at the origin. Only the copy
 * of the cell p is in is asked; so the shape must lie within the cell, |x| <= period.x / 2, and
 * must be its own mirror image along each repeated axis. The field is then continuous, exact
 * outside if it was, and L is what it was. Otherwise it may exceed the distance to a neighbour's
 * part, and rays pass through that. 15 flop. */
SPT_SHAPE spt_point spt_repeat(spt_point p, spt_point period) {
    /* finite if the period is 0, by which the number of the cell is then multiplied */
    const spt_real x = 1 / (period.x + SPT_REAL_MIN);
    const spt_real y = 1 / (period.y + SPT_REAL_MIN);
    const spt_real z = 1 / (period.z + SPT_REAL_MIN);
    return spt_point_of(p.x - period.x * (spt_real)spt_nearest(spt_limit(p.x * x, 4194304)),
                        p.y - period.y * (spt_real)spt_nearest(spt_limit(p.y * y, 4194304)),
                        p.z - period.z * (spt_real)spt_nearest(spt_limit(p.z * z, 4194304)));
}

/* Twists the shape about the y axis: its slice at height y is turned by the angle rate * y, z
 * towards x for positive angles (right-handed). rate in radians per length, |rate * y| <= 1e4. A
 * lower bound after division by L, for which see the next function. 45 flop. */
SPT_SHAPE spt_point spt_twist(spt_point p, spt_real rate) {
    const spt_real s = spt_sin(rate * p.y);
    const spt_real c = spt_cos(rate * p.y);
    return spt_point_of(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
}

/* L of a twisted field is L of the field times this, among points within radius of the y axis: the
 * tracer needs a bound of that radius. (a + sqrt(a^2 + 4))/2 with a = |rate| radius, the largest
 * singular value of the map, attained at that radius. */
SPT_SHAPE spt_real spt_twist_lipschitz(spt_real rate, spt_real radius) {
    const spt_real a = spt_magnitude(rate) * radius;
    return (a + spt_root(a * a + 4)) * (spt_real)0.5;
}

/* Bends the shape in the plane of x and y: what stands at x is turned about the z axis by the angle
 * rate * x, x towards y for positive angles. rate in radians per length, |rate * x| <= 1e4. A lower
 * bound after division by L, for which see the next function. 45 flop. */
SPT_SHAPE spt_point spt_bend(spt_point p, spt_real rate) {
    const spt_real s = spt_sin(rate * p.x);
    const spt_real c = spt_cos(rate * p.x);
    return spt_point_of(c * p.x + s * p.y, c * p.y - s * p.x, p.z);
}

/* L of a bent field is L of the field times this, among points within radius of the z axis. The
 * derivative is a rotation times I + rate (-y, x)^T (1, 0), whose norm is at most
 * 1 + |rate| |(x, y)|, attained on the y axis. */
SPT_SHAPE spt_real spt_bend_lipschitz(spt_real rate, spt_real radius) {
    return 1 + spt_magnitude(rate) * radius;
}

#endif
