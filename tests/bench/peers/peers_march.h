/* SPDX-License-Identifier: MIT
 *
 * Sphere tracing inside Embree's intersection callback, one ray at a time: what its user would
 * write who knows the rule. No audit, no brackets, no counts: the village is exact. */
#ifndef TESTS_BENCH_PEERS_MARCH_H
#define TESTS_BENCH_PEERS_MARCH_H

#include "peers_user.h"

#define PEERS_MARGIN 0x1p-22f /* slope of the rounding floor, spheretrace/trace.h */

typedef struct peers_ray {
    float origin[3], direction[3], t_in, t_out;
} peers_ray;

SPT_SHAPE float peers_distance(const village_house *house, const peers_ray *ray, float t) {
    const spt_point p =
        spt_point_of(ray->origin[0] + t * ray->direction[0], ray->origin[1] + t * ray->direction[1],
                     ray->origin[2] + t * ray->direction[2]);
    return house != NULL ? village_house_distance(house, p) : village_ground(p);
}

SPT_SHAPE float peers_tolerance(const peers_step *step, float t) {
    return spt_greatest(step->epsilon, step->pixel_radius * t);
}

/* Cuts the ray to the box; whether anything is left. A zero in the direction gives infinities of
 * the right signs, and NaN only in a face of the box: that axis then does not count. */
SPT_SHAPE int peers_clip(const peers_object *object, peers_ray *ray) {
    for (int axis = 0; axis < 3; ++axis) {
        const float inverse = 1 / ray->direction[axis];
        const float a = (object->low[axis] - ray->origin[axis]) * inverse;
        const float b = (object->high[axis] - ray->origin[axis]) * inverse;
        ray->t_in = spt_greatest(spt_least(a, b), ray->t_in);
        ray->t_out = spt_least(spt_greatest(a, b), ray->t_out);
    }
    return ray->t_in <= ray->t_out;
}

/* Whether spheres of radius a and b, `apart`, overlap by more than rounding can feign. */
SPT_SHAPE int peers_overlap(const peers_step *step, float a, float b, float apart, float t) {
    return apart + PEERS_MARGIN * (apart + t + step->reach) < a + b;
}

/* The next radius over this one, if the surface is a plane as the last two samples see it. */
SPT_SHAPE float peers_ratio(float made, float before, float after) {
    const float drop = spt_least(spt_greatest(before - after, -0.98f * made), made);
    return (made - drop) / (made + drop);
}

/* The hit, or a negative number. house: a constant NULL or not. */
SPT_SHAPE float peers_march_basic(const village_house *house, const peers_step *step,
                                  const peers_ray *ray) {
    float t = ray->t_in;
    for (uint32_t evaluations = 0; evaluations < step->budget; ++evaluations) {
        const float r = peers_distance(house, ray, t);
        if (r < peers_tolerance(step, t)) return t;
        t += r;
        if (t > ray->t_out) break;
    }
    return -1;
}

SPT_SHAPE float peers_march_adaptive(const village_house *house, const peers_step *step,
                                     const peers_ray *ray) {
    float t = ray->t_in, r = peers_distance(house, ray, t);
    float ratio = -1, pending_t = 0, pending_r = 0;
    int plain = 0;
    if (r < peers_tolerance(step, t)) return t;
    for (uint32_t evaluations = 1; evaluations < step->budget && t + r <= ray->t_out;
         ++evaluations) {
        float made = r;
        if (!plain) {
            made = spt_least(r + step->extrapolation * (r * ratio), step->step_cap * r);
            made = spt_greatest(spt_least(made, ray->t_out - t), r);
            if (t < pending_t && pending_t - pending_r < t + made) made = r;
        }
        const float next = spt_least(t + made, ray->t_out);
        const float value = peers_distance(house, ray, next);
        made = next - t;
        plain = next > t + r && !peers_overlap(step, r, value, made, next);
        if (plain) {
            pending_t = value > 0 ? next : 0;
            pending_r = value;
            continue;
        }
        if (value < peers_tolerance(step, next)) return next;
        ratio = peers_ratio(made, r, value);
        t = next;
        r = value;
        if (!(t < pending_t)) continue;
        if (!peers_overlap(step, r, pending_r, pending_t - t, pending_t)) continue;
        ratio = peers_ratio(pending_t - t, r, pending_r);
        t = pending_t;
        r = pending_r;
        if (r < peers_tolerance(step, t)) return t;
    }
    return -1;
}

#endif
