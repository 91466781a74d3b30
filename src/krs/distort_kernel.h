/* SPDX-License-Identifier: MIT
 *
 * Inverse deformations of points, and their derivatives. Plain loops, which vectorise in a file
 * compiled for wide vectors. Defines what spti_distort_kernels lists, by kind. */
#ifndef SPTI_DISTORT_KERNEL_H
#define SPTI_DISTORT_KERNEL_H

#include <spheretrace/shapes.h>

#include "../lanes/lanes.h"
#include "distort.h"

SPTI_INLINE spti_region distort_region(const spt_distorted *distorted) {
    const spt_bound *const bound = &distorted->bound;
    spti_region at;
    memcpy(at.origin, distorted->distortion.origin, sizeof at.origin);
    memcpy(at.frame, distorted->frame, sizeof at.frame);
    memcpy(at.box_low, bound->low, sizeof at.box_low);
    memcpy(at.box_high, bound->high, sizeof at.box_high);
    at.radius_low = bound->low[0];
    at.radius_high = bound->high[0];
    at.low = bound->low[1];
    at.high = bound->high[1];
    at.narrowest = spt_least(at.radius_low, at.radius_high);
    at.widest = spt_greatest(at.radius_low, at.radius_high);
    at.rise = at.high - at.low;
    at.widening = at.radius_high - at.radius_low;
    at.inverse_square = 1.0f / (at.rise * at.rise + at.widening * at.widening + FLT_MIN);
    at.rate = distorted->distortion.rate;
    at.wave = distorted->distortion.wave;
    at.phase = distorted->distortion.phase;
    return at;
}

/* Along side, axis and their cross product, from the origin. Limited so that squares do not
 * overflow: that is a projection onto a cube around the region, which brings points closer. */
SPTI_INLINE spt_point distort_local(const spti_region *at, float x, float y, float z) {
    const spt_point d =
        spt_point_of(spt_limit(x - at->origin[0], 0x1p61f), spt_limit(y - at->origin[1], 0x1p61f),
                     spt_limit(z - at->origin[2], 0x1p61f));
    spt_point p;
    p.x = at->frame[0][0] * d.x + at->frame[0][1] * d.y + at->frame[0][2] * d.z;
    p.y = at->frame[1][0] * d.x + at->frame[1][1] * d.y + at->frame[1][2] * d.z;
    p.z = at->frame[2][0] * d.x + at->frame[2][1] * d.y + at->frame[2][2] * d.z;
    return p;
}

/* A coordinate of the vector with these components along the frame. */
SPTI_INLINE float distort_world(const spti_region *at, spt_point p, int axis) {
    return at->frame[0][axis] * p.x + at->frame[1][axis] * p.y + at->frame[2][axis] * p.z;
}

/* ---- The region's nearest point ------------------------------------------------------------- */

/* Height and two coordinates across; apart: the square of the distance. */
SPTI_INLINE void distort_into_cylinder(const spti_region *at, float *height, float *a, float *b,
                                       float *apart) {
    const float within = spt_least(spt_greatest(*height, at->low), at->high);
    const float reach = spt_greatest(spt_length_2(*a, *b), at->radius_low);
    const float share = at->radius_low / reach; /* 1 within the radius */
    const float above = *height - within, beyond = reach - at->radius_low;
    *apart = above * above + beyond * beyond;
    *height = within;
    *a *= share;
    *b *= share;
}

/* The nearest point of the slant side, where a point is beyond it at its own height or, above and
 * below, at that of the end: every such point has its nearest one there, ends included. */
SPTI_INLINE void distort_into_cone(const spti_region *at, float *height, float *a, float *b,
                                   float *apart) {
    const float r = spt_length_2(*a, *b) + FLT_MIN;
    const float within = spt_least(spt_greatest(*height, at->low), at->high);
    const float own = at->radius_low + (*height - at->low) * (at->widening / at->rise);
    const float edge = spt_least(spt_greatest(own, at->narrowest), at->widest);
    const float along =
        ((r - at->radius_low) * at->widening + (*height - at->low) * at->rise) * at->inverse_square;
    const float share = spt_clamp(along, 0, 1);
    const int beyond = r > edge;
    const float radius = spt_choose(beyond, at->radius_low + share * at->widening, r);
    const float level = spt_choose(beyond, at->low + share * at->rise, within);
    const float above = *height - level, outward = r - radius, scale = radius / r;
    *apart = above * above + outward * outward;
    *height = level;
    *a *= scale;
    *b *= scale;
}

SPTI_INLINE spt_point distort_into_region(uint32_t kind, const spti_region *at, spt_point p,
                                          float *apart) {
    if (kind == SPT_DISTORTION_TWIST) distort_into_cylinder(at, &p.y, &p.x, &p.z, apart);
    if (kind == SPT_DISTORTION_BEND) distort_into_cylinder(at, &p.x, &p.y, &p.z, apart);
    if (kind == SPT_DISTORTION_TAPER) distort_into_cone(at, &p.y, &p.x, &p.z, apart);
    if (kind == SPT_DISTORTION_SWAY) {
        const spt_point q =
            spt_point_of(spt_least(spt_greatest(p.x, at->box_low[0]), at->box_high[0]),
                         spt_least(spt_greatest(p.y, at->box_low[1]), at->box_high[1]),
                         spt_least(spt_greatest(p.z, at->box_low[2]), at->box_high[2]));
        const spt_point out = spt_point_of(p.x - q.x, p.y - q.y, p.z - q.z);
        *apart = spt_dot(out, out);
        p = q;
    }
    return p;
}

/* ---- The maps, for points of the region ----------------------------------------------------- */

SPTI_INLINE spt_point distort_unmap(uint32_t kind, const spti_region *at, spt_point p) {
    if (kind == SPT_DISTORTION_TWIST) return spt_twist(p, at->rate);
    if (kind == SPT_DISTORTION_BEND) {
        const spt_point bent = spt_bend(spt_point_of(p.y, p.z, p.x), at->rate);
        return spt_point_of(bent.z, bent.x, bent.y);
    }
    if (kind == SPT_DISTORTION_TAPER) {
        const float inverse = 1.0f / (1.0f + at->rate * p.y);
        return spt_point_of(p.x * inverse, p.y, p.z * inverse);
    }
    const float height = spt_positive(p.y);
    const float offset = at->rate * height * height * spt_sin(at->phase + at->wave * height);
    return spt_point_of(p.x - offset, p.y, p.z);
}

/* The transposed derivative of the map at p, times g; q is p mapped. */
SPTI_INLINE spt_point distort_transpose(uint32_t kind, const spti_region *at, spt_point p,
                                        spt_point q, spt_point g) {
    if (kind == SPT_DISTORTION_TWIST) {
        const float sine = spt_sin(at->rate * p.y), cosine = spt_cos(at->rate * p.y);
        const float turn = at->rate * (q.x * g.z - q.z * g.x);
        return spt_point_of(cosine * g.x + sine * g.z, g.y + turn, cosine * g.z - sine * g.x);
    }
    if (kind == SPT_DISTORTION_BEND) {
        const float sine = spt_sin(at->rate * p.y), cosine = spt_cos(at->rate * p.y);
        const float turn = at->rate * (q.z * g.y - q.y * g.z);
        return spt_point_of(g.x, cosine * g.y - sine * g.z + turn, sine * g.y + cosine * g.z);
    }
    if (kind == SPT_DISTORTION_TAPER) {
        const float inverse = 1.0f / (1.0f + at->rate * p.y);
        const float narrowing = at->rate * inverse * (q.x * g.x + q.z * g.z);
        return spt_point_of(g.x * inverse, g.y - narrowing, g.z * inverse);
    }
    const float height = spt_positive(p.y), angle = at->phase + at->wave * height;
    const float shear =
        at->rate * height * (2 * spt_sin(angle) + at->wave * height * spt_cos(angle));
    return spt_point_of(g.x, g.y - shear * g.x, g.z);
}

/* ---- Batches -------------------------------------------------------------------------------- */

/* n is whole groups: said so that compilers know, and make no code for what is left over. */
SPTI_INLINE size_t distort_groups(size_t n) {
    return n & ~(size_t)15;
}

SPTI_INLINE void distort_move(uint32_t kind, const spti_region *region, size_t n,
                              const float *restrict x, const float *restrict y,
                              const float *restrict z, float *restrict to_x, float *restrict to_y,
                              float *restrict to_z, float *restrict apart) {
    const spti_region at = *region;
    const size_t whole = distort_groups(n);
    for (size_t i = 0; i < whole; ++i) {
        spt_point p = distort_local(&at, x[i], y[i], z[i]);
        p = distort_into_region(kind, &at, p, &apart[i]);
        p = distort_unmap(kind, &at, p);
        to_x[i] = at.origin[0] + distort_world(&at, p, 0);
        to_y[i] = at.origin[1] + distort_world(&at, p, 1);
        to_z[i] = at.origin[2] + distort_world(&at, p, 2);
    }
}

/* Capped so that nothing overflows: less is safe. What is not a number stays. */
SPTI_INLINE void distort_settle(float lipschitz, size_t n, const float *restrict apart,
                                float *restrict distance) {
    const float inverse = 1.0f / lipschitz;
    const size_t whole = distort_groups(n);
    for (size_t i = 0; i < whole; ++i) {
        const float asked = distance[i], beyond = spt_limit(asked * inverse, 0x1p62f);
        const float slant = lipschitz * spt_root(apart[i] + beyond * beyond);
        const int outside = (apart[i] > 0) & (asked > 0);
        distance[i] = spt_choose(outside, spt_limit(slant, FLT_MAX), asked);
    }
}

SPTI_INLINE void distort_pull(uint32_t kind, const spti_region *region, size_t n,
                              const float *restrict x, const float *restrict y,
                              const float *restrict z, float *restrict gradient_x,
                              float *restrict gradient_y, float *restrict gradient_z) {
    const spti_region at = *region;
    const size_t whole = distort_groups(n);
    for (size_t i = 0; i < whole; ++i) {
        float apart;
        const spt_point given = spt_point_of(gradient_x[i], gradient_y[i], gradient_z[i]);
        spt_point p = distort_local(&at, x[i], y[i], z[i]), g;
        g.x = at.frame[0][0] * given.x + at.frame[0][1] * given.y + at.frame[0][2] * given.z;
        g.y = at.frame[1][0] * given.x + at.frame[1][1] * given.y + at.frame[1][2] * given.z;
        g.z = at.frame[2][0] * given.x + at.frame[2][1] * given.y + at.frame[2][2] * given.z;
        p = distort_into_region(kind, &at, p, &apart);
        g = distort_transpose(kind, &at, p, distort_unmap(kind, &at, p), g);
        gradient_x[i] = distort_world(&at, g, 0);
        gradient_y[i] = distort_world(&at, g, 1);
        gradient_z[i] = distort_world(&at, g, 2);
    }
}

#endif
