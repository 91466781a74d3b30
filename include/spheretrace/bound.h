/* SPDX-License-Identifier: MIT
 *
 * Convex bounding volumes: a region that is known to contain a surface, so that a ray need be
 * traced only inside it, and not at all where it misses it (Keinert et al. 2014, section 3.5).
 * Tracing itself is in trace.h, convex bodies inside such volumes in surface.h. */
#ifndef SPHERETRACE_BOUND_H
#define SPHERETRACE_BOUND_H

#include "base.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The points p with normal . p <= offset. The normal has any finite length but zero. */
typedef struct spt_bound_plane {
    float normal[3], offset;
} spt_bound_plane;

/* A caller's own convex volume: where n rays are inside it.
 *   n                  a multiple of 16, 16 <= n <= 256; rays that only fill up repeat a real one
 *   origin, direction  three arrays each; the direction is the ray's own times a power of two, so
 *                      that its largest component is from 1 to 2 (to 4 from 2^127 on), and t
 *                      counts in it
 *   t_in, t_out        receive the interval; t_in > t_out where the ray stays outside. An end that
 *                      is NaN, or is not written, is no constraint
 * All arrays are 64-byte aligned. The answer must never be narrower than the true interval: what
 * rounding may cut off is the callback's to add. */
typedef void spt_interval_batch_fn(void *user, size_t n, const float *const origin[3],
                                   const float *const direction[3], float *t_in, float *t_out);

/* The same for one ray. */
typedef void spt_interval_fn(void *user, const float origin[3], const float direction[3],
                             float *t_in, float *t_out);

typedef enum spt_bound_kind {
    SPT_BOUND_SPHERE = 1,       /* all points within radius of center */
    SPT_BOUND_BOX = 2,          /* low[i] <= p[i] <= high[i] */
    SPT_BOUND_ORIENTED_BOX = 3, /* |axis[i] . (p - center)| <= half[i] */
    SPT_BOUND_CAPSULE = 4,      /* all points within radius of the segment from center to end */
    SPT_BOUND_CYLINDER = 5,     /* within radius of the line through both, and between the planes
                                 * at right angles to it through its ends */
    SPT_BOUND_ELLIPSOID = 6,    /* sum of (axis[i] . (p - center) / half[i])^2 <= 1 */
    SPT_BOUND_SLAB = 7,         /* range[0] <= axis[0] . p <= range[1] */
    SPT_BOUND_POLYTOPE = 8,     /* behind all planes */
    SPT_BOUND_CALLBACK = 9      /* what the caller's function says */
} spt_bound_kind;

/* The most planes of a polytope. */
#define SPT_BOUND_PLANES 256

/* A closed convex volume; a point that touches it is inside. All lengths in world units, finite.
 * Make one with the functions below, which set struct_size and what a kind does not use. Refused
 * with SPT_BAD_ARGUMENT where it is used: a non-finite number (but see low and high); radius <= 0;
 * low[i] > high[i] (equal is a flat box and legal), half[i] < 0 of a box or <= 0 of an ellipsoid;
 * axes that are not of unit length or not at right angles by more than 1e-3; a cylinder without
 * length; range[0] > range[1]; a normal of no length; no planes, or more than SPT_BOUND_PLANES; no
 * callback.
 * A ray asks a field only inside its volume. The cones that a frame sends ahead of its rays know
 * spheres and boxes: with any other volume they may ask the field anywhere in the box of
 * spt_bound_extent(). */
typedef struct spt_bound {
    size_t struct_size;
    uint32_t kind; /* spt_bound_kind */
    float
        center[3]; /* sphere, oriented box, ellipsoid; one end of a capsule's or cylinder's axis */
    float radius;  /* sphere, capsule, cylinder; > 0 */
    float low[3];  /* box. Slab, polytope, callback: the volume is cut with this box, too, ... */
    float high[3]; /* ... -infinity to +infinity unless the caller sets it: tiles of a frame cull
                      * by it and begin their cones at it */
    float axis[3][3]; /* oriented box, ellipsoid: three unit vectors at right angles. As far as they
                       * are not, the volume is still just what the inequality above says. Slab:
                       * axis[0] is its normal, of any length but zero */
    float half[3];    /* oriented box, ellipsoid: along the axes */
    float end[3];     /* the other end of a capsule's or cylinder's axis */
    float range[2];   /* slab */
    const spt_bound_plane *planes; /* polytope: the caller's, read whenever the volume is used */
    size_t plane_count;
    spt_interval_batch_fn *batch; /* callback: preferred */
    spt_interval_fn *point;       /* used where batch is NULL */
    void *user;                   /* handed to it */
} spt_bound;

/* All zero, but for a box without end. What the functions below begin with. */
static inline spt_bound spt_bound_of_kind(spt_bound_kind kind) {
    spt_bound bound = {0,
                       0,
                       {0, 0, 0},
                       0,
                       {0, 0, 0},
                       {0, 0, 0},
                       {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                       {0, 0, 0},
                       {0, 0, 0},
                       {0, 0},
                       NULL,
                       0,
                       NULL,
                       NULL,
                       NULL};
    int axis;
    bound.struct_size = sizeof bound;
    bound.kind = (uint32_t)kind;
    for (axis = 0; axis < 3; ++axis) {
        bound.low[axis] = -INFINITY;
        bound.high[axis] = INFINITY;
    }
    return bound;
}

/* A sphere of the given center and radius (> 0). */
static inline spt_bound spt_bound_sphere(float center_x, float center_y, float center_z,
                                         float radius) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_SPHERE);
    bound.center[0] = center_x;
    bound.center[1] = center_y;
    bound.center[2] = center_z;
    bound.radius = radius;
    return bound;
}

/* An axis-aligned box between two opposite corners; low[i] <= high[i]. */
static inline spt_bound spt_bound_box(float low_x, float low_y, float low_z, float high_x,
                                      float high_y, float high_z) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_BOX);
    bound.low[0] = low_x;
    bound.low[1] = low_y;
    bound.low[2] = low_z;
    bound.high[0] = high_x;
    bound.high[1] = high_y;
    bound.high[2] = high_z;
    return bound;
}

/* A box of half sides half[i] along three axes (rows, unit length, at right angles). */
static inline spt_bound spt_bound_oriented_box(const float center[3], float axis[3][3],
                                               const float half[3]) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_ORIENTED_BOX);
    int i, j;
    for (i = 0; i < 3; ++i) {
        bound.center[i] = center[i];
        bound.half[i] = half[i];
        for (j = 0; j < 3; ++j) bound.axis[i][j] = axis[i][j];
    }
    return bound;
}

/* An ellipsoid of semi-axes half[i] (> 0) along three axes, as above. */
static inline spt_bound spt_bound_ellipsoid(const float center[3], float axis[3][3],
                                            const float half[3]) {
    spt_bound bound = spt_bound_oriented_box(center, axis, half);
    bound.kind = SPT_BOUND_ELLIPSOID;
    return bound;
}

/* All points within radius (> 0) of the segment between two points, which may be one. */
static inline spt_bound spt_bound_capsule(const float from[3], const float to[3], float radius) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_CAPSULE);
    int axis;
    for (axis = 0; axis < 3; ++axis) {
        bound.center[axis] = from[axis];
        bound.end[axis] = to[axis];
    }
    bound.radius = radius;
    return bound;
}

/* A cylinder with flat ends around the segment between two different points. */
static inline spt_bound spt_bound_cylinder(const float from[3], const float to[3], float radius) {
    spt_bound bound = spt_bound_capsule(from, to, radius);
    bound.kind = SPT_BOUND_CYLINDER;
    return bound;
}

/* The layer from <= normal . p <= to. */
static inline spt_bound spt_bound_slab(const float normal[3], float from, float to) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_SLAB);
    int axis;
    for (axis = 0; axis < 3; ++axis) bound.axis[0][axis] = normal[axis];
    bound.range[0] = from;
    bound.range[1] = to;
    return bound;
}

/* The points behind all of 1 to SPT_BOUND_PLANES planes. Set low and high to a box around it. */
static inline spt_bound spt_bound_polytope(const spt_bound_plane *planes, size_t count) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_POLYTOPE);
    bound.planes = planes;
    bound.plane_count = count;
    return bound;
}

/* A caller's own volume; one of the two callbacks may be NULL. Set low and high to a box around
 * it. */
static inline spt_bound spt_bound_callback(spt_interval_batch_fn *batch, spt_interval_fn *point,
                                           void *user) {
    spt_bound bound = spt_bound_of_kind(SPT_BOUND_CALLBACK);
    bound.batch = batch;
    bound.point = point;
    bound.user = user;
    return bound;
}

/* Where the ray origin + t direction is inside the volume, cut with [t_min, t_max].
 *   origin, direction  three finite numbers each; the direction of any length but zero
 *   t_min, t_max       t_min >= 0 and finite, t_max may be +infinity; in units of the direction
 *   t_in, t_out        receive the interval; for a ray that stays outside t_in = +infinity and
 *                      t_out = -infinity. Neither may be NULL
 * The interval is closed (a ray that touches is inside) and never narrower than the true one. It is
 * that of a larger volume, up to the rounding of the ends themselves; with e = 2^-22 and
 * v the distance of the origin from center (slab, polytope: from (0, 0, 0)):
 *   box                  faces move out by e (|origin|_inf + largest coordinate)
 *   sphere               the radius grows by e (|origin|_inf + v)
 *   slab, polytope,      a face moves out by at most 4 e (v + t |direction| + what it is away from
 *   oriented box           there itself)
 *   capsule, cylinder    the radius grows by at most 10 e (v + length + radius); ends are faces
 *   ellipsoid            half axes grow in proportion, the longest by at most 13 e (v + longest) s,
 *                          s the root of the sum of (longest / half[i])^2
 * and then both ends move by the rounding floor: e t, and for a sphere e (|origin|_inf + largest
 * coordinate) of world length. A caller's own interval is taken as it is.
 * Coordinates below 1e19, radii and half axes above 1e-18. A face that contains the ray is no
 * special case: nothing multiplies 0 by infinity.
 * Returns SPT_BAD_ARGUMENT for a bad volume, a NULL pointer or a ray outside these ranges.
 * Cost: one division per axis or plane; two or three square roots and divisions for round ones.
 * Algorithms: the slab method by division, and the centre form of the ray-sphere discriminant
 * (Haines et al. 2019, Ray Tracing Gems, chapter 7). */
SPT_API spt_status spt_bound_interval(const spt_bound *bound, const float origin[3],
                                      const float direction[3], float t_min, float t_max,
                                      float *t_in, float *t_out);

/* The smallest axis-aligned box around the volume, up to rounding, for hosts that ask for one;
 * for slab, polytope and callback their own low and high, which may be infinite. low and high
 * receive three numbers each. Returns SPT_BAD_ARGUMENT for a bad volume or a NULL pointer. */
SPT_API spt_status spt_bound_extent(const spt_bound *bound, float low[3], float high[3]);

/* Whether the volume may meet the cone of all points whose direction from origin differs from
 * `direction` by a chord of at most `chord` (of the unit sphere; 0 <= chord < 1), up to t_max (in
 * units of the direction, or +infinity; negative: there is no such point). The direction may have
 * any length but zero. *meets becomes 0 only where it certainly does not; exact for a sphere up to
 * rounding, for the others that of the sphere around their box, 1 where that has no end.
 * Returns SPT_BAD_ARGUMENT for a bad volume, ray, chord, NaN, or a NULL pointer. */
SPT_API spt_status spt_bound_meets_cone(const spt_bound *bound, const float origin[3],
                                        const float direction[3], float chord, float t_max,
                                        int *meets);

#ifdef __cplusplus
}
#endif
#endif
