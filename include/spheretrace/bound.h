/* SPDX-License-Identifier: MIT
 *
 * Convex bounding volumes: a region that is known to contain a surface, so that a ray need be
 * traced only inside it, and not at all where it misses it (Keinert et al. 2014, section 3.5).
 * Here: the sphere and the axis-aligned box. */
#ifndef SPHERETRACE_BOUND_H
#define SPHERETRACE_BOUND_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum spt_bound_kind {
    SPT_BOUND_SPHERE = 1, /* all points within radius of center */
    SPT_BOUND_BOX = 2     /* low[i] <= p[i] <= high[i] */
} spt_bound_kind;

/* A closed convex volume; a point that touches it is inside. All lengths in world units, finite.
 * Make one with the functions below, which set struct_size. Refused with SPT_BAD_ARGUMENT where it
 * is used: a non-finite number, radius <= 0, low[i] > high[i] (equal is a flat box and legal). */
typedef struct spt_bound {
    size_t struct_size;
    uint32_t kind;   /* spt_bound_kind */
    float center[3]; /* sphere */
    float radius;    /* sphere, > 0 */
    float low[3];    /* box */
    float high[3];   /* box */
} spt_bound;

/* A sphere of the given center and radius (> 0). */
static inline spt_bound spt_bound_sphere(float center_x, float center_y, float center_z,
                                         float radius) {
    spt_bound bound = {0, 0, {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
    bound.struct_size = sizeof bound;
    bound.kind = SPT_BOUND_SPHERE;
    bound.center[0] = center_x;
    bound.center[1] = center_y;
    bound.center[2] = center_z;
    bound.radius = radius;
    return bound;
}

/* An axis-aligned box between two opposite corners; low[i] <= high[i]. */
static inline spt_bound spt_bound_box(float low_x, float low_y, float low_z, float high_x,
                                      float high_y, float high_z) {
    spt_bound bound = {0, 0, {0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
    bound.struct_size = sizeof bound;
    bound.kind = SPT_BOUND_BOX;
    bound.low[0] = low_x;
    bound.low[1] = low_y;
    bound.low[2] = low_z;
    bound.high[0] = high_x;
    bound.high[1] = high_y;
    bound.high[2] = high_z;
    return bound;
}

/* Where the ray origin + t direction is inside the volume, cut with [t_min, t_max].
 *   origin, direction  three finite numbers each; the direction of any length but zero
 *   t_min, t_max       t_min >= 0 and finite, t_max may be +infinity; in units of the direction
 *   t_in, t_out        receive the interval; for a ray that stays outside t_in = +infinity and
 *                      t_out = -infinity. Neither may be NULL
 * The interval is closed (a ray that touches is inside) and never narrower than the true one. The
 * faces of a box move out by 2^-22 (|origin|_inf + largest coordinate of the volume), a sphere's
 * radius grows by 2^-22 (|origin|_inf + |origin - center|), and then both ends by the rounding
 * floor: 2^-22 t, and for a sphere 2^-22 (|origin|_inf + largest coordinate) of world length.
 * Coordinates below 1e19, radii above 1e-18. A face that contains the ray is no special case:
 * nothing multiplies 0 by infinity.
 * Returns SPT_BAD_ARGUMENT for a bad volume, a NULL pointer or a ray outside these ranges.
 * Cost: one division per axis, or one square root and three divisions.
 * Algorithms: the slab method by division, and the centre form of the ray-sphere discriminant
 * (Haines et al. 2019, Ray Tracing Gems, chapter 7). */
SPT_API spt_status spt_bound_interval(const spt_bound *bound, const float origin[3],
                                      const float direction[3], float t_min, float t_max,
                                      float *t_in, float *t_out);

/* The smallest axis-aligned box around the volume, for hosts that ask for one. low and high
 * receive three numbers each. Returns SPT_BAD_ARGUMENT for a bad volume or a NULL pointer. */
SPT_API spt_status spt_bound_extent(const spt_bound *bound, float low[3], float high[3]);

#ifdef __cplusplus
}
#endif
#endif
