/* SPDX-License-Identifier: MIT
 *
 * Rays that pass convex bodies, and how closely they do: the truth of closest approaches and of
 * penumbras, in double. */
#ifndef TESTS_ORACLE_SURFACE_PASSING_H
#define TESTS_ORACLE_SURFACE_PASSING_H

#include "surface_oracle.h"

typedef enum passing_kind {
    PASSING_POINT, /* a ball so small that it is a point to a float */
    PASSING_SPHERE,
    PASSING_BOX,
    PASSING_CAPSULE,
    passing_kinds
} passing_kind;

/* A body that a ray passes.
 *   closest   the least distance, world length, over all t >= t_min
 *   at        where that is, in t
 *   sine      the least of distance over t |direction|, the sine of the angle by which the ray
 *             misses the body as seen from its origin */
typedef struct passing {
    surface_body body;
    spt_ray ray;
    double closest, at, sine;
} passing;

/* The truth for a body and a ray. */
passing passing_of(const surface_body *body, const spt_ray *ray);

/* A body of the kind, turned, scaled and with any factor, in front of the origin of a ray with a
 * direction of any length; it passes the body by 0.1 to 2.5 of its distance from it, within 60
 * degrees, and goes on for long: the sample behind the last one that matters is taken. */
passing passing_draw(passing_kind kind);

/* The largest length that the samples before the body deal with, its square being what closest
 * approaches are computed from. */
double passing_reach(const passing *what);

/* By how much rounding may change a closest approach of about `closest` that is computed from two
 * samples (t, r1) and (t + step, r2): r1 <= step and r2 <= 2 step, for no step is shorter than the
 * radius. With X the reach, u = 2^-24: radii are off by (2 sqrt(3) + 1) u X, so that
 * y = (step^2 + r1^2 - r2^2) / (2 step) is off by 3 of these and 12 u X, in all at most 2^-19 X, and
 * a^2 = r1^2 - y^2 by at most 2^-17 X^2. */
double passing_rounding(const passing *what, double closest);

#endif
