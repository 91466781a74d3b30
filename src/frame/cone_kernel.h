/* SPDX-License-Identifier: MIT
 *
 * Rays of cameras and steps of cones. A template over SPT_LANES. Defines what spti_cone_kernels
 * lists. */
#ifndef SPTI_CONE_KERNEL_H
#define SPTI_CONE_KERNEL_H

#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../bound/interval_kernel.h"
#include "bundle.h"

/* ---- Rays ----------------------------------------------------------------------------------- */

SPTI_INLINE void cone_rays(const spti_view *view, size_t count, const float *x, const float *y,
                           spti_ray_arrays *rays) {
    const int pinhole = view->kind == SPT_CAMERA_PINHOLE;
    for (size_t at = 0; at < count; at += SPT_LANES) {
        const spt_wide u =
            spt_add(spt_splat(view->u_0), spt_mul(spt_load(&x[at]), spt_splat(view->u_step)));
        const spt_wide v =
            spt_add(spt_splat(view->v_0), spt_mul(spt_load(&y[at]), spt_splat(view->v_step)));
        spt_wide plane[3], direction[3], square = spt_splat(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const spt_wide base = spt_splat(pinhole ? view->forward[axis] : view->eye[axis]);
            plane[axis] = spt_add(spt_add(base, spt_mul(u, spt_splat(view->right[axis]))),
                                  spt_mul(v, spt_splat(view->up[axis])));
            direction[axis] = pinhole ? plane[axis] : spt_splat(view->forward[axis]);
            square = spt_add(square, spt_mul(direction[axis], direction[axis]));
        }
        const spt_wide length = spt_sqrt(square);
        for (int axis = 0; axis < 3; ++axis) {
            const spt_wide eye = spt_splat(view->eye[axis]);
            spt_store(&rays->origin[axis][at], pinhole ? eye : plane[axis]);
            spt_store(&rays->direction[axis][at], spt_div(direction[axis], length));
        }
    }
}

/* ---- Cones ---------------------------------------------------------------------------------- */

SPTI_INLINE void cone_enter(const spti_bundles *bundles, const spt_bound *grown, spti_walk *walk) {
    const float size = spti_bound_size(grown);
    for (size_t at = 0; at < SPTI_BUNDLES; at += SPT_LANES) {
        interval_ray ray;
        ray.reach = spt_splat(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = spt_load(&bundles->origin[axis][at]);
            ray.direction[axis] = spt_load(&bundles->direction[axis][at]);
            ray.reach = spt_max(ray.reach, spt_abs(ray.origin[axis]));
        }
        ray.length = spt_splat(1.0f);
        spt_wide t_in = spt_load(&walk->t[at]), t_out = spt_load(&bundles->t_max[at]);
        interval_of_hull(grown, size, &ray, &t_in, &t_out);
        const spt_mask met = spt_less_equal(t_in, t_out);
        spt_store(&walk->t[at], spt_select(met, t_in, spt_splat(INFINITY)));
        spt_store(&walk->t_out[at], t_out);
    }
}

/* A field is asked only within its bound, a sphere or the box of any other: in the stead of a point
 * outside, the bound's nearest point is. */
SPTI_INLINE void cone_points(const spti_bundles *bundles, unsigned walking, spti_walk *walk) {
    const spt_bound *const bound = walk->bound;
    const spt_wide far = spt_splat(0x1p62f); /* less is safe, and its square does not overflow */
    for (size_t at = 0; at < SPTI_BUNDLES; at += SPT_LANES) {
        const spt_mask walks = spt_less(spt_splat(0.0f), spt_load(&walk->walks[at]));
        const spt_wide t = spt_select(walks, spt_load(&walk->t[at]), spt_splat(0.0f));
        spt_wide point[3], gap = spt_splat(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const spt_wide along = spt_mul(t, spt_load(&bundles->direction[axis][at]));
            point[axis] = spt_add(spt_load(&bundles->origin[axis][at]), along);
        }
        if (bound != NULL && bound->kind != SPT_BOUND_SPHERE) {
            for (int axis = 0; axis < 3; ++axis) {
                const spt_wide within = spt_min(spt_max(point[axis], spt_splat(bound->low[axis])),
                                                spt_splat(bound->high[axis]));
                const spt_wide apart = spt_min(spt_abs(spt_sub(point[axis], within)), far);
                gap = spt_add(gap, spt_mul(apart, apart));
                point[axis] = within;
            }
        } else if (bound != NULL) {
            spt_wide arm[3], square = spt_splat(0.0f);
            for (int axis = 0; axis < 3; ++axis) {
                arm[axis] = spt_sub(point[axis], spt_splat(bound->center[axis]));
                square = spt_add(square, spt_mul(arm[axis], arm[axis]));
            }
            const spt_wide radius = spt_splat(bound->radius);
            const spt_wide length = spt_max(spt_sqrt(square), radius);
            const spt_mask outside = spt_less(radius, length);
            const spt_wide share = spt_div(radius, length);
            const spt_wide apart = spt_min(spt_sub(length, radius), far);
            for (int axis = 0; axis < 3; ++axis) {
                const spt_wide pulled =
                    spt_add(spt_splat(bound->center[axis]), spt_mul(share, arm[axis]));
                point[axis] = spt_select(outside, pulled, point[axis]);
            }
            gap = spt_mul(apart, apart);
        }
        spt_store(&walk->x[at], point[0]);
        spt_store(&walk->y[at], point[1]);
        spt_store(&walk->z[at], point[2]);
        spt_store(&walk->gap[at], gap);
    }
    /* What repeats a point is never somewhere that the field is not to be asked. */
    const unsigned first = spti_lowest_bit(walking);
    const spt_wide x = spt_splat(walk->x[first]), y = spt_splat(walk->y[first]);
    const spt_wide z = spt_splat(walk->z[first]);
    for (size_t at = 0; at < SPTI_BUNDLES; at += SPT_LANES) {
        const spt_mask walks = spt_less(spt_splat(0.0f), spt_load(&walk->walks[at]));
        spt_store(&walk->x[at], spt_select(walks, spt_load(&walk->x[at]), x));
        spt_store(&walk->y[at], spt_select(walks, spt_load(&walk->y[at]), y));
        spt_store(&walk->z[at], spt_select(walks, spt_load(&walk->z[at]), z));
        spt_store(&walk->distance[at], spt_splat(NAN));
    }
}

/* The distance to the surface is at least the field's answer. Outside of the convex bound the
 * surface is at least as far as the hypotenuse over the way to the bound's nearest point and from
 * there to the surface, since the bound lies behind a plane at right angles to that way. */
SPTI_INLINE spt_wide cone_distance(const spti_walk *walk, size_t at) {
    const spt_wide zero = spt_splat(0.0f), gap = spt_load(&walk->gap[at]);
    const spt_wide asked =
        spt_mul(spt_load(&walk->distance[at]), spt_splat(walk->inverse_lipschitz));
    const spt_wide beyond = spt_min(spt_max(asked, zero), spt_splat(0x1p62f));
    const spt_wide slant = spt_sqrt(spt_add(gap, spt_mul(beyond, beyond)));
    /* In this order NaN stays, and stops the bundle. */
    return spt_min(spt_splat(FLT_MAX), spt_select(spt_less(zero, gap), slant, asked));
}

/* A step is (distance - beta - alpha t) / (1 + alpha): the slice of the cone at its end, wider by
 * alpha times the step, is still within the sphere. (Stepping by the distance and testing at the
 * samples, as printed, skips surfaces between them.) The cone is as much wider as rays reach a
 * surface before they touch it, so that it passes nothing that they would hit, and the rounding
 * floor is kept back. */
SPTI_INLINE unsigned cone_advance(const spti_bundles *bundles, spti_walk *walk) {
    const spt_wide one = spt_splat(1.0f), zero = spt_splat(0.0f), infinity = spt_splat(INFINITY);
    const spt_wide pixel_radius = spt_splat(walk->pixel_radius);
    const spt_wide reached_at_0 =
        spt_add(spt_splat(walk->epsilon), spt_mul(pixel_radius, spt_splat(bundles->longest_path)));
    unsigned still = 0;
    for (size_t at = 0; at < SPTI_BUNDLES; at += SPT_LANES) {
        const spt_mask walks = spt_less(zero, spt_load(&walk->walks[at]));
        const spt_wide held = spt_load(&walk->t[at]), t = spt_select(walks, held, zero);
        const spt_wide alpha = spt_add(spt_load(&bundles->alpha[at]), pixel_radius);
        const spt_wide beta = spt_add(spt_load(&bundles->beta[at]), reached_at_0);
        const spt_wide width = spt_add(beta, spt_mul(alpha, t));
        const spt_wide floor =
            spt_add(spt_add(spt_load(&bundles->floor_at_0[at]), spt_splat(walk->floor_of_size)),
                    spt_mul(spt_splat(SPTI_FLOOR), t));
        const spt_wide distance = cone_distance(walk, at);
        const spt_wide empty =
            spt_div(spt_sub(spt_sub(distance, width), floor), spt_add(one, alpha));
        const spt_wide tolerance = spt_max(spt_mul(spt_splat(0.1f), width), floor);
        const spt_mask goes = spti_less_in(walks, tolerance, empty);
        spt_wide step = empty;
        spt_mask never = spt_mask_splat(0);
        if (walk->convex) {
            /* Inside the bound the free length of a convex field is convex along the ray: it is
             * positive up to the root of its secant, and for ever once it does not fall. */
            const spt_wide t_old = spt_load(&walk->t_old[at]), old = spt_load(&walk->old[at]);
            const spt_mask inside = spt_less_equal(spt_load(&walk->gap[at]), zero);
            const spt_mask pair = spt_mask_and(inside, spt_less(old, infinity));
            const spt_wide drop = spt_add(spt_sub(old, empty), floor);
            const spt_mask falls = spt_mask_and(pair, spt_less(zero, drop));
            const spt_wide divisor = spt_select(falls, drop, one);
            const spt_wide secant =
                spt_div(spt_mul(spt_sub(empty, floor), spt_sub(t, t_old)), divisor);
            step = spt_select(falls, spt_max(empty, secant), empty);
            never = spt_mask_and_not(pair, falls);
            spt_store(&walk->t_old[at], t);
            spt_store(&walk->old[at], spt_select(inside, empty, infinity));
        }
        const spt_wide next = spt_add(t, step);
        const spt_wide t_out = spt_load(&walk->t_out[at]);
        const spt_mask past = spt_mask_or(never, spt_less(t_out, next));
        const spt_mask on = spt_mask_and_not(goes, past);
        spt_store(&walk->t[at], spt_select(goes, spt_select(past, infinity, next), held));
        spt_store(&walk->walks[at], spt_select(on, one, zero));
        still |= spt_mask_bits(on) << at;
    }
    return still;
}

#endif
