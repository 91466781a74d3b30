/* SPDX-License-Identifier: MIT
 *
 * Distances to kernels. A template over SPT_LANES. The formulas are those of shapes.h, operation for
 * operation, so that they have the same bits. */
#ifndef SPTI_SHAPE_KERNEL_H
#define SPTI_SHAPE_KERNEL_H

#include <float.h>

#include "../lanes/lanes.h"
#include "sequence.h"

/* Where a built kernel keeps its numbers. */
enum {
    SHAPE_CENTER = 0,  /* three; of a half space its normal, of an arc its middle */
    SHAPE_OUTWARD = 3, /* three; of a leaf from edge to edge */
    SHAPE_ALONG = 6,   /* three */
    SHAPE_NORMAL = 9,  /* three */
    SHAPE_CURVATURE = 12,
    SHAPE_HALF_CHORD = 13,
    SHAPE_COSINE = 14,
    SHAPE_SAGITTA = 15,
    SHAPE_RADIUS = 16,
    SHAPE_EXTENT = 17 /* of a ball around the center that contains it, or +infinity */
};

typedef struct shape_points {
    spt_wide x, y, z;
} shape_points;

/* Points of rays without end stand for the nearest one of what kernels may reach, so that no square
 * overflows. */
SPTI_INLINE spt_wide shape_in_range(spt_wide coordinate) {
    return spt_max(spt_min(coordinate, spt_splat(SPTI_FARTHEST)), spt_splat(-SPTI_FARTHEST));
}

SPTI_INLINE shape_points shape_load(const spti_way *way, size_t at) {
    const shape_points points = {shape_in_range(spt_load(&way->x[at])),
                                 shape_in_range(spt_load(&way->y[at])),
                                 shape_in_range(spt_load(&way->z[at]))};
    return points;
}

SPTI_INLINE spt_wide shape_number(const spt_built_kernel *kernel, int place) {
    return spt_splat(kernel->number[place]);
}

SPTI_INLINE spt_wide shape_dot(const spt_built_kernel *kernel, int place, shape_points p) {
    const spt_wide x = spt_mul(p.x, shape_number(kernel, place));
    const spt_wide y = spt_mul(p.y, shape_number(kernel, place + 1));
    const spt_wide z = spt_mul(p.z, shape_number(kernel, place + 2));
    return spt_add(spt_add(x, y), z);
}

SPTI_INLINE shape_points shape_from_center(const spt_built_kernel *kernel, shape_points p) {
    const shape_points q = {spt_sub(p.x, shape_number(kernel, SHAPE_CENTER)),
                            spt_sub(p.y, shape_number(kernel, SHAPE_CENTER + 1)),
                            spt_sub(p.z, shape_number(kernel, SHAPE_CENTER + 2))};
    return q;
}

SPTI_INLINE spt_wide shape_length_2(spt_wide x, spt_wide y) {
    return spt_sqrt(spt_add(spt_mul(x, x), spt_mul(y, y)));
}

SPTI_INLINE spt_wide shape_sphere(const spt_built_kernel *kernel, shape_points p) {
    const shape_points q = shape_from_center(kernel, p);
    const spt_wide square =
        spt_add(spt_add(spt_mul(q.x, q.x), spt_mul(q.y, q.y)), spt_mul(q.z, q.z));
    return spt_sub(spt_sqrt(square), shape_number(kernel, SHAPE_RADIUS));
}

SPTI_INLINE spt_wide shape_half_space(const spt_built_kernel *kernel, shape_points p) {
    return spt_sub(shape_dot(kernel, SHAPE_CENTER, p), shape_number(kernel, SHAPE_RADIUS));
}

/* A point in the plane of an arc, seen from its middle: x outward, y from the chord's middle. */
typedef struct shape_arc {
    spt_wide over;     /* distance from the whole circle, positive outside */
    spt_mask over_arc; /* the point stands over the arc, seen from the circle's center */
    spt_wide end_x, end_y;
} shape_arc;

SPTI_INLINE shape_arc shape_of_arc(const spt_built_kernel *kernel, spt_wide x, spt_wide y) {
    const spt_wide one = spt_splat(1.0f), k = shape_number(kernel, SHAPE_CURVATURE);
    const spt_wide half_chord = shape_number(kernel, SHAPE_HALF_CHORD);
    const spt_wide from_center = spt_add(one, spt_mul(k, x)), turned = spt_mul(k, y);
    /* sqrt(X^2 + y^2) - R with X = R + x, multiplied out so that R cancels before it is computed */
    const spt_wide above =
        spt_add(spt_mul(x, spt_add(spt_mul(k, x), spt_splat(2.0f))), spt_mul(y, spt_mul(k, y)));
    const spt_wide below = spt_add(shape_length_2(from_center, turned), one);
    const spt_wide over = spt_div(above, below);
    const spt_wide cosine = shape_number(kernel, SHAPE_COSINE);
    /* not where the circle is infinitely far in units of its radius: the ends are as near then */
    const spt_mask finite = spt_less_equal(below, spt_splat(FLT_MAX));
    const spt_mask within = spt_less_equal(spt_mul(cosine, y), spt_mul(half_chord, from_center));
    const shape_arc arc = {over, spt_mask_and(within, finite),
                           spt_add(x, shape_number(kernel, SHAPE_SAGITTA)), spt_sub(y, half_chord)};
    return arc;
}

SPTI_INLINE spt_wide shape_from_plane(spt_wide square, spt_wide z, spt_wide radius) {
    return spt_sub(spt_sqrt(spt_add(square, spt_mul(z, z))), radius);
}

SPTI_INLINE spt_wide shape_from_end(const shape_arc *arc) {
    return spt_add(spt_mul(arc->end_x, arc->end_x), spt_mul(arc->end_y, arc->end_y));
}

SPTI_INLINE spt_wide shape_capsule(const spt_built_kernel *kernel, shape_points p) {
    const shape_points q = shape_from_center(kernel, p);
    const spt_wide x = shape_dot(kernel, SHAPE_OUTWARD, q);
    const spt_wide y = spt_abs(shape_dot(kernel, SHAPE_ALONG, q));
    const shape_arc arc = shape_of_arc(kernel, x, y);
    const spt_wide square =
        spt_select(arc.over_arc, spt_mul(arc.over, arc.over), shape_from_end(&arc));
    return shape_from_plane(square, shape_dot(kernel, SHAPE_NORMAL, q),
                            shape_number(kernel, SHAPE_RADIUS));
}

/* Between two arcs over one chord: the nearer one is that on the point's side. Within both, the
 * distance in the plane is 0. */
SPTI_INLINE spt_wide shape_leaf(const spt_built_kernel *kernel, shape_points p) {
    const shape_points q = shape_from_center(kernel, p);
    const spt_wide across = spt_abs(shape_dot(kernel, SHAPE_OUTWARD, q));
    const spt_wide y = spt_abs(shape_dot(kernel, SHAPE_ALONG, q));
    const spt_wide x = spt_sub(across, shape_number(kernel, SHAPE_SAGITTA));
    const shape_arc arc = shape_of_arc(kernel, x, y);
    const spt_wide outside = spt_max(arc.over, spt_splat(0.0f));
    const spt_wide square =
        spt_select(arc.over_arc, spt_mul(outside, outside), shape_from_end(&arc));
    return shape_from_plane(square, shape_dot(kernel, SHAPE_NORMAL, q),
                            shape_number(kernel, SHAPE_RADIUS));
}

/* The distances of `vectors` vectors of points to a kernel. Returns 0, and writes none, for empty
 * kernels and callers' fields. The choice is one a level, not one a point. */
SPTI_INLINE int shape_distances(const spt_built_kernel *kernel, int vectors,
                                const shape_points *points, spt_wide *distances) {
    switch (kernel->kind) {
    case SPT_KERNEL_SPHERE:
        for (int v = 0; v < vectors; ++v) distances[v] = shape_sphere(kernel, points[v]);
        return 1;
    case SPT_KERNEL_HALF_SPACE:
        for (int v = 0; v < vectors; ++v) distances[v] = shape_half_space(kernel, points[v]);
        return 1;
    case SPT_KERNEL_CAPSULE:
        for (int v = 0; v < vectors; ++v) distances[v] = shape_capsule(kernel, points[v]);
        return 1;
    case SPT_KERNEL_LEAF:
        for (int v = 0; v < vectors; ++v) distances[v] = shape_leaf(kernel, points[v]);
        return 1;
    default:
        return 0;
    }
}

#endif
