/* SPDX-License-Identifier: MIT
 *
 * Matt points, and the sun's light on them: what is opaque keeps it off, and glass lets it through
 * unbent, less what its surfaces reflect and its inside absorbs. */
#include "whitted_queue.h"
#include "shade_light.h"

#include <math.h>
#include <string.h>

void whitted_shade(whitted_work *work, const whitted_ray *ray, int object, const float point[3]) {
    const float way = ray->path + ray->ray.t_max;
    glass_point at;
    float by_sun[3], rest[3], greatest = 0.0f;
    at.object = object;
    at.way = way;
    memcpy(at.position, point, sizeof at.position);
    memcpy(at.view, ray->ray.direction, sizeof at.view);
    if (object == GLASS_GROUND) at.position[1] = work->world->ground;
    glass_world_normal(work->world, object, at.position, at.normal);
    const float slope = spt_greatest(fabsf(light_dot(at.view, at.normal)), 1e-3f);
    at.footprint = 2.0f * work->pixel_radius * way / slope;
    glass_shade(work->world, &at, by_sun, rest);
    whitted_add(work, ray, ray->weight, rest);
    for (int c = 0; c < 3; ++c) {
        by_sun[c] *= ray->weight[c];
        greatest = spt_greatest(greatest, by_sun[c]);
    }
    if (!(greatest > 0.0f)) return;
    whitted_ray *const shadow = whitted_push(&work->shadows);
    if (shadow == NULL) {
        work->failed = 1;
        return;
    }
    memcpy(shadow->ray.origin, at.position, sizeof at.position);
    memcpy(shadow->ray.direction, light_sun_direction, sizeof shadow->ray.direction);
    memcpy(shadow->weight, by_sun, sizeof by_sun);
    shadow->ray.t_min = 0.0f;
    shadow->ray.t_max = INFINITY;
    shadow->path = way;
    shadow->pixel = ray->pixel;
    shadow->from = object;
    shadow->active = 1;
    shadow->inside = GLASS_NOTHING;
    shadow->reflections = shadow->refractions = 0;
}

/* Takes from a light what a surface of glass reflects that it goes through. */
static void pass_surface(whitted_ray *shadow, const float normal[3], float index) {
    float towards[3]; /* as from outside, on the way out too: unbent light is not caught inside */
    const float side = light_dot(normal, shadow->ray.direction) > 0.0f ? -1.0f : 1.0f;
    for (int axis = 0; axis < 3; ++axis) towards[axis] = side * normal[axis];
    const whitted_split split = whitted_split_at(shadow->ray.direction, towards, index, 0);
    for (int c = 0; c < 3; ++c) shadow->weight[c] *= 1.0f - split.reflectance;
}

static void pass_inside(whitted_ray *shadow, const glass_material *material, float length) {
    for (int c = 0; c < 3; ++c) shadow->weight[c] *= expf(-material->absorption[c] * length);
}

/* Past the balls; returns whether any light is left. */
static int pass_balls(const glass_world *world, whitted_ray *shadow) {
    float point[3], normal[3];
    int object, beyond = shadow->from, left = 2 * world->ball_count; /* surfaces, at most */
    memcpy(point, shadow->ray.origin, sizeof point);
    for (int inside = GLASS_NOTHING; left > 0; --left) {
        const float t = glass_meet(world, point, shadow->ray.direction, beyond, inside, &object);
        if (object < 0) return 1;
        if (world->balls[object].material.surface != GLASS_CLEAR) return 0;
        for (int axis = 0; axis < 3; ++axis) point[axis] += t * shadow->ray.direction[axis];
        glass_world_normal(world, object, point, normal);
        pass_surface(shadow, normal, world->balls[object].material.index);
        if (inside == object) pass_inside(shadow, &world->balls[object].material, t);
        inside = inside == object ? GLASS_NOTHING : object;
        beyond = object;
    }
    return 1;
}

/* What the body makes of each ray: it lets it pass, or is met; entered is how many go on inside. */
static void end_outside(whitted_work *work, size_t *entered) {
    const glass_material *const glass = &work->world->body_material;
    for (size_t i = 0; i < work->shadows.count; ++i) {
        whitted_ray *const shadow = &work->shadows.rays[i];
        const spt_hit *const hit = &work->hits[i];
        if (!shadow->active) continue;
        shadow->active = 0;
        if (hit->outcome == SPT_HIT) {
            pass_surface(shadow, &work->normals[3 * i], glass->index);
            if ((hit->flags & SPT_FLAG_INSIDE) == 0) {
                shadow->ray.t_min = hit->t;
                shadow->active = 1;
                ++*entered;
                continue;
            }
            pass_inside(shadow, glass, hit->t); /* it began under the body, where that lies on */
        }
        work->statistics.undecided += hit->outcome != SPT_HIT && hit->outcome != SPT_MISS;
        whitted_add(work, shadow, shadow->weight, (const float[3]){1.0f, 1.0f, 1.0f});
    }
}

static void end_inside(whitted_work *work) {
    const glass_material *const glass = &work->world->body_material;
    for (size_t i = 0; i < work->shadows.count; ++i) {
        whitted_ray *const shadow = &work->shadows.rays[i];
        const spt_hit *const hit = &work->hits[i];
        if (!shadow->active) continue;
        if (hit->outcome == SPT_HIT) {
            pass_inside(shadow, glass, hit->t - shadow->ray.t_min);
            pass_surface(shadow, &work->normals[3 * i], glass->index);
        }
        work->statistics.undecided += hit->outcome != SPT_HIT && hit->outcome != SPT_MISS;
        whitted_add(work, shadow, shadow->weight, (const float[3]){1.0f, 1.0f, 1.0f});
    }
}

void whitted_trace_shadows(whitted_work *work) {
    whitted_queue *const queue = &work->shadows;
    size_t entered = 0;
    if (queue->count == 0 || !whitted_reserve(work, queue->count)) return;
    for (size_t i = 0; i < queue->count; ++i) {
        queue->rays[i].active = pass_balls(work->world, &queue->rays[i]);
    }
    whitted_land(work, queue, WHITTED_SHADOW);
    end_outside(work, &entered);
    if (entered > 0) {
        whitted_land(work, queue, WHITTED_SHADOW_INSIDE);
        end_inside(work);
    }
    queue->count = 0;
}
