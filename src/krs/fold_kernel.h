/* SPDX-License-Identifier: MIT
 *
 * Points through the mirrors of a kernel-reflection sequence (Szécsi et al. 2016, Algorithm 1,
 * without its branch). A template over SPT_LANES. */
#ifndef SPTI_FOLD_KERNEL_H
#define SPTI_FOLD_KERNEL_H

#include "shape_kernel.h"

/* How far beyond the mirror a point is. */
SPTI_INLINE spt_wide fold_beyond(const spt_mirror *mirror, shape_points p) {
    const spt_wide x = spt_mul(p.x, spt_splat(mirror->normal[0]));
    const spt_wide y = spt_mul(p.y, spt_splat(mirror->normal[1]));
    const spt_wide z = spt_mul(p.z, spt_splat(mirror->normal[2]));
    return spt_sub(spt_add(spt_add(x, y), z), spt_splat(mirror->offset));
}

/* Reflects what is beyond; a point on the mirror stays, with the same bits from both sides. */
SPTI_INLINE shape_points fold_point(const spt_mirror *mirror, shape_points p) {
    const spt_wide beyond = spt_max(fold_beyond(mirror, p), spt_splat(0.0f));
    const spt_wide twice = spt_add(beyond, beyond);
    const shape_points folded = {spt_sub(p.x, spt_mul(twice, spt_splat(mirror->normal[0]))),
                                 spt_sub(p.y, spt_mul(twice, spt_splat(mirror->normal[1]))),
                                 spt_sub(p.z, spt_mul(twice, spt_splat(mirror->normal[2])))};
    return folded;
}

/* `vectors` vectors from place `at` on: two of them keep both chains of dependent operations, that
 * of the fold and that of the roots, in flight. */
SPTI_INLINE void fold_vectors(const spti_stretch *stretch, int vectors, size_t at,
                              const spti_way *way) {
    shape_points points[2];
    spt_wide least[2], distances[2];
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        points[v] = shape_load(way, place);
        least[v] = stretch->begins ? spt_splat(INFINITY) : spt_load(&way->distance[place]);
    }
    for (uint32_t level = stretch->first + 1; level-- > stretch->last;) {
        if (level < stretch->levels) {
            const spt_mirror *const mirror = &stretch->mirrors[level];
            for (int v = 0; v < vectors; ++v) points[v] = fold_point(mirror, points[v]);
        }
        if (!shape_distances(&stretch->kernels[level], vectors, points, distances)) continue;
        /* In this order NaN, which a caller's field may have answered, stays. */
        for (int v = 0; v < vectors; ++v) least[v] = spt_min(distances[v], least[v]);
    }
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        spt_store(&way->distance[place], least[v]);
        if (!stretch->goes_on) continue;
        spt_store(&way->x[place], points[v].x);
        spt_store(&way->y[place], points[v].y);
        spt_store(&way->z[place], points[v].z);
    }
}

SPTI_INLINE void fold_stretch(const spti_stretch *stretch, size_t n, const spti_way *way) {
    size_t at = 0;
    for (; at + 2 * SPT_LANES <= n; at += 2 * SPT_LANES) fold_vectors(stretch, 2, at, way);
    if (at < n) fold_vectors(stretch, 1, at, way);
}

#endif
