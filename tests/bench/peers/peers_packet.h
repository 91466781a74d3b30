/* SPDX-License-Identifier: MIT
 *
 * The same as peers_march.h for SPT_LANES rays of a packet at once: masks instead of branches.
 * Lanes that are not alive compute on, and nobody reads what. */
#ifndef TESTS_BENCH_PEERS_PACKET_H
#define TESTS_BENCH_PEERS_PACKET_H

#include <spheretrace/simd.h>

#include "peers_march.h"

typedef struct peers_lanes {
    spt_wide origin[3], direction[3], t_in, t_out;
    spt_mask alive;
} peers_lanes;

SPT_INLINE spt_wide peers_house_lanes(const village_house *house, spt_wide x, spt_wide y,
                                      spt_wide z) {
    const spt_wide cosine = spt_splat(house->cosine), sine = spt_splat(house->sine);
    const spt_wide half_height = spt_splat(house->half_height);
    const spt_wide from_x = spt_sub(x, spt_splat(house->x)),
                   from_z = spt_sub(z, spt_splat(house->z));
    const spt_wide across = spt_abs(spt_add(spt_mul(cosine, from_x), spt_mul(sine, from_z)));
    const spt_wide along = spt_abs(spt_sub(spt_mul(cosine, from_z), spt_mul(sine, from_x)));
    const spt_wide over_wall = spt_sub(along, spt_splat(house->half_depth));
    const spt_wide over_top = spt_sub(spt_abs(spt_sub(y, half_height)), half_height);
    const spt_wide over_side = spt_sub(across, spt_splat(house->half_width));
    const spt_wide walls = spt_max(spt_max(over_side, over_wall), over_top);
    const spt_wide slope =
        spt_add(spt_mul(spt_splat((float)VILLAGE_ROOF_ACROSS), across),
                spt_mul(spt_splat((float)VILLAGE_ROOF_UP), spt_sub(y, spt_splat(house->ridge))));
    const spt_wide over_gable = spt_sub(over_wall, spt_splat((float)VILLAGE_EAVES));
    const spt_wide below = spt_sub(spt_splat(house->half_height + house->half_height), y);
    return spt_min(walls, spt_max(spt_max(slope, over_gable), below));
}

SPT_INLINE spt_wide peers_ground_lanes(spt_wide x, spt_wide y, spt_wide z) {
    const spt_wide half = spt_splat((float)VILLAGE_GROUND_HALF);
    const spt_wide depth = spt_splat((float)VILLAGE_GROUND_DEPTH);
    const spt_wide aside = spt_max(spt_sub(spt_abs(x), half), spt_sub(spt_abs(z), half));
    return spt_max(aside, spt_sub(spt_abs(spt_add(y, depth)), depth));
}

SPT_INLINE spt_wide peers_distance_lanes(const village_house *house, const peers_lanes *rays,
                                         spt_wide t) {
    spt_wide p[3];
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = spt_add(rays->origin[axis], spt_mul(t, rays->direction[axis]));
    }
    return house != NULL ? peers_house_lanes(house, p[0], p[1], p[2])
                         : peers_ground_lanes(p[0], p[1], p[2]);
}

SPT_INLINE spt_wide peers_tolerance_lanes(const peers_step *step, spt_wide t) {
    return spt_max(spt_splat(step->epsilon), spt_mul(spt_splat(step->pixel_radius), t));
}

SPT_INLINE void peers_clip_lanes(const peers_object *object, peers_lanes *rays) {
    for (int axis = 0; axis < 3; ++axis) {
        const spt_wide inverse = spt_div(spt_splat(1), rays->direction[axis]);
        const spt_wide low = spt_sub(spt_splat(object->low[axis]), rays->origin[axis]);
        const spt_wide high = spt_sub(spt_splat(object->high[axis]), rays->origin[axis]);
        const spt_wide a = spt_mul(low, inverse), b = spt_mul(high, inverse);
        rays->t_in = spt_max(spt_min(a, b), rays->t_in);
        rays->t_out = spt_min(spt_max(a, b), rays->t_out);
    }
    rays->alive = spt_mask_and(rays->alive, spt_less_equal(rays->t_in, rays->t_out));
}

SPT_INLINE spt_mask peers_overlap_lanes(const peers_step *step, spt_wide a, spt_wide b,
                                        spt_wide apart, spt_wide t) {
    const spt_wide sum = spt_add(spt_add(apart, t), spt_splat(step->reach));
    return spt_less(spt_add(apart, spt_mul(spt_splat(PEERS_MARGIN), sum)), spt_add(a, b));
}

SPT_INLINE spt_wide peers_ratio_lanes(spt_wide made, spt_wide before, spt_wide after) {
    const spt_wide least = spt_mul(spt_splat(-0.98f), made);
    const spt_wide drop = spt_min(spt_max(spt_sub(before, after), least), made);
    return spt_div(spt_sub(made, drop), spt_add(made, drop));
}

/* Where alive rays that are near enough stop: they leave, and found receives t. */
SPT_INLINE spt_wide peers_leave_lanes(const peers_step *step, spt_mask asked, spt_wide t,
                                      spt_wide r, spt_wide found, spt_mask *alive) {
    const spt_mask near = spt_mask_and(asked, spt_less(r, peers_tolerance_lanes(step, t)));
    *alive = spt_mask_and_not(*alive, near);
    return spt_select(near, t, found);
}

/* The hits, or negative numbers. */
SPT_INLINE spt_wide peers_march_basic_lanes(const village_house *house, const peers_step *step,
                                            const peers_lanes *rays) {
    spt_wide t = rays->t_in, found = spt_splat(-1);
    spt_mask alive = rays->alive;
    for (uint32_t evaluations = 0; evaluations < step->budget && spt_any(alive); ++evaluations) {
        const spt_wide r = peers_distance_lanes(house, rays, t);
        found = peers_leave_lanes(step, alive, t, r, found, &alive);
        t = spt_add(t, r);
        alive = spt_mask_and(alive, spt_less_equal(t, rays->t_out));
    }
    return found;
}

/* The step from t: extrapolated, but not beyond t_out, nor into the sphere of a pending probe, nor
 * after a rejected one. */
SPT_INLINE spt_wide peers_step_lanes(const peers_step *step, spt_wide t, spt_wide r, spt_wide ratio,
                                     spt_wide pending_t, spt_wide pending_r, spt_mask plain,
                                     spt_wide t_out) {
    const spt_wide further = spt_mul(spt_splat(step->extrapolation), spt_mul(r, ratio));
    spt_wide made = spt_min(spt_add(r, further), spt_mul(spt_splat(step->step_cap), r));
    made = spt_max(spt_min(made, spt_sub(t_out, t)), r);
    const spt_mask into = spt_mask_and(spt_less(t, pending_t),
                                       spt_less(spt_sub(pending_t, pending_r), spt_add(t, made)));
    return spt_select(spt_mask_or(plain, into), r, made);
}

SPT_INLINE spt_wide peers_march_adaptive_lanes(const village_house *house, const peers_step *step,
                                               const peers_lanes *rays) {
    const spt_wide zero = spt_splat(0);
    spt_wide t = rays->t_in, r = peers_distance_lanes(house, rays, t), found = spt_splat(-1);
    spt_wide ratio = found, pending_t = zero, pending_r = zero;
    spt_mask alive = rays->alive, plain = spt_mask_splat(0);
    found = peers_leave_lanes(step, alive, t, r, found, &alive);
    for (uint32_t evaluations = 1; evaluations < step->budget; ++evaluations) {
        alive = spt_mask_and(alive, spt_less_equal(spt_add(t, r), rays->t_out));
        if (!spt_any(alive)) break;
        const spt_wide wished =
            peers_step_lanes(step, t, r, ratio, pending_t, pending_r, plain, rays->t_out);
        const spt_wide next = spt_min(spt_add(t, wished), rays->t_out);
        const spt_wide value = peers_distance_lanes(house, rays, next), made = spt_sub(next, t);
        plain = spt_mask_and_not(spt_less(spt_add(t, r), next),
                                 peers_overlap_lanes(step, r, value, made, next));
        pending_t = spt_select(plain, spt_select(spt_less(zero, value), next, zero), pending_t);
        pending_r = spt_select(plain, value, pending_r);
        const spt_mask accepted = spt_mask_and_not(alive, plain);
        found = peers_leave_lanes(step, accepted, next, value, found, &alive);
        ratio = spt_select(accepted, peers_ratio_lanes(made, r, value), ratio);
        t = spt_select(accepted, next, t);
        r = spt_select(accepted, value, r);
        const spt_wide leap = spt_sub(pending_t, t);
        const spt_mask reached =
            spt_mask_and(spt_mask_and(spt_mask_and_not(alive, plain), spt_less(t, pending_t)),
                         peers_overlap_lanes(step, r, pending_r, leap, pending_t));
        if (!spt_any(reached)) continue;
        ratio = spt_select(reached, peers_ratio_lanes(leap, r, pending_r), ratio);
        t = spt_select(reached, pending_t, t);
        r = spt_select(reached, pending_r, r);
        found = peers_leave_lanes(step, reached, t, r, found, &alive);
    }
    return found;
}

#endif
