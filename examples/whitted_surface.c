/* SPDX-License-Identifier: MIT
 *
 * A generation of rays: where they land, and the rays that go on from there. */
#include "whitted_queue.h"

#include <math.h>

/* ---- Landing ------------------------------------------------------------------------------- */

static void check(whitted_work *work, spt_status status) {
    work->statistics.calls += 1;
    if (status != SPT_OK) work->failed = 1;
}

/* What is wanted of hits. */
static spt_hits hit_sinks(const whitted_work *work) {
    spt_hits hits = spt_hits_of(work->hits);
    hits.component.first = hits.candidate_t.first = hits.candidate_ratio.first = NULL;
    hits.fallbacks.first = NULL;
    return hits;
}

void whitted_land(whitted_work *work, const whitted_queue *queue, whitted_kind kind) {
    const size_t count = queue->count;
    const whitted_settings *const wish = work->settings;
    const spt_rays rays = whitted_columns(queue);
    const spt_hits hits = hit_sinks(work);
    const spt_vector_sinks normals = spt_vector_sinks_of(work->normals);
    const int inside = kind == WHITTED_INSIDE || kind == WHITTED_SHADOW_INSIDE;
    spt_statistics *const statistics = &work->statistics.of[kind];
    spt_settings settings = work->tracing;
    if (kind == WHITTED_PRIMARY) settings.flags = 0;
    for (size_t i = 0; i < count; ++i) { /* of those that are not active */
        work->hits[i].outcome = SPT_MISS;
        work->hits[i].evaluations = 0;
    }
    check(work, inside && wish->convex
                    ? spt_trace_convex(&work->field, &settings, count, &rays, &hits, statistics)
                    : spt_trace(&work->field, &settings, count, &rays, &hits, statistics));
    if (kind == WHITTED_INSIDE && wish->inside_evaluations != NULL) {
        for (size_t i = 0; i < count; ++i) {
            wish->inside_evaluations[queue->rays[i].pixel] += (float)work->hits[i].evaluations;
        }
    }
    if (kind < WHITTED_SHADOW && wish->refinements > 0) {
        check(work, spt_refine(&work->field, 1, &settings, wish->refinements, count, &rays, &hits));
    }
    check(work, spt_normals(&work->field, 1, &settings, SPT_NORMAL_CENTRAL, 0.0f, count, &rays,
                            &hits, &normals));
}

/* ---- Going on ------------------------------------------------------------------------------ */

/* What costs a path one of its reflections, and one of its refractions. */
typedef enum turn { TURN_REFLECTED, TURN_REFRACTED } turn;

/* Whether the part of a ray's light that goes in a direction is worth a ray. If not, what it would
 * see there if there were nothing is added at once: no light is lost, and nothing turns black. */
static int is_followed(const whitted_work *work, const whitted_ray *ray, turn way, float share,
                       const float colour[3], const float direction[3]) {
    const int left = way == TURN_REFLECTED ? ray->reflections : ray->refractions;
    float weight[3], light[3];
    for (int c = 0; c < 3; ++c) weight[c] = ray->weight[c] * share * colour[c];
    const float greatest = spt_greatest(weight[0], spt_greatest(weight[1], weight[2]));
    if (!(greatest > 0.0f)) return 0;
    if (left > 0 && greatest >= work->settings->least_weight) return 1;
    glass_environment(work->world, direction, light);
    whitted_add(work, ray, weight, light);
    return 0;
}

/* The next ray of a path. */
typedef struct next_ray {
    turn way;
    float share;
    const float *colour, *direction, *origin;
    float path;
    int from, inside;
} next_ray;

static void follow(whitted_work *work, const whitted_ray *ray, const next_ray *next) {
    whitted_ray *const child =
        whitted_push(next->inside == GLASS_BODY ? &work->next_body : &work->next_air);
    if (child == NULL) {
        work->failed = 1;
        return;
    }
    for (int c = 0; c < 3; ++c) {
        child->ray.origin[c] = next->origin[c];
        child->ray.direction[c] = next->direction[c];
        child->weight[c] = ray->weight[c] * next->share * next->colour[c];
    }
    child->ray.t_min = 0.0f;
    child->ray.t_max = INFINITY;
    child->path = next->path;
    child->pixel = ray->pixel;
    child->from = next->from;
    child->inside = next->inside;
    child->active = 1;
    child->reflections = (int16_t)(ray->reflections - (next->way == TURN_REFLECTED));
    child->refractions = (int16_t)(ray->refractions - (next->way == TURN_REFRACTED));
}

static const float white[3] = {1.0f, 1.0f, 1.0f};

/* What becomes of the light that is reflected (crosses == 0) or refracted where a ray met glass.
 * Total reflection turns refracted light back. */
static next_ray next_of(const whitted_ray *ray, const whitted_split *split, int crosses) {
    next_ray next;
    next.way = crosses || split->reflectance >= 1.0f ? TURN_REFRACTED : TURN_REFLECTED;
    next.share = crosses ? 1.0f - split->reflectance : split->reflectance;
    next.colour = white;
    next.direction = crosses ? split->refracted : split->reflected;
    next.origin = NULL;
    next.path = 0.0f;
    next.from = next.inside = crosses ? GLASS_NOTHING : ray->inside;
    return next;
}

/* The rays that go on from where a queue met the body: work->splits where work->objects says so. */
static void leave_body(whitted_work *work, const whitted_queue *queue, int is_inside) {
    const int32_t yes = 1;
    const spt_hits hits = hit_sinks(work);
    const spt_vectors normals = spt_vectors_of(work->normals);
    const spt_starts starts = {spt_vector_sinks_of(work->origins),
                               {work->paths, (ptrdiff_t)sizeof *work->paths},
                               {work->starts, (ptrdiff_t)sizeof *work->starts}};
    for (int crosses = 0; crosses < 2; ++crosses) {
        const spt_column cross = {crosses ? &yes : NULL, 0};
        spt_rays rays = whitted_columns(queue);
        size_t wanted = 0;
        for (size_t i = 0; i < queue->count; ++i) {
            work->wanted[i] = 0;
            if (work->objects[i] != GLASS_BODY) continue;
            const next_ray next = next_of(&queue->rays[i], &work->splits[i], crosses);
            work->wanted[i] =
                is_followed(work, &queue->rays[i], next.way, next.share, white, next.direction);
            wanted += (size_t)work->wanted[i];
        }
        if (wanted == 0) continue;
        rays.active.first = work->wanted;
        rays.active.stride = (ptrdiff_t)sizeof *work->wanted;
        check(work, spt_offset(&work->field, 1, &work->tracing, queue->count, &rays, &hits,
                               &normals, &cross, 4, &starts));
        work->statistics.secondary += wanted;
        for (size_t i = 0; i < queue->count; ++i) {
            if (!work->wanted[i]) continue;
            next_ray next = next_of(&queue->rays[i], &work->splits[i], crosses);
            next.origin = &work->origins[3 * i];
            next.path = work->paths[i];
            next.from = GLASS_BODY;
            next.inside = is_inside != crosses ? GLASS_BODY : GLASS_NOTHING;
            work->statistics.near += work->starts[i] == SPT_START_NEAR;
            work->statistics.at_hit += work->starts[i] == SPT_START_AT_HIT;
            follow(work, &queue->rays[i], &next);
        }
    }
}

static void absorb(whitted_ray *ray, const glass_material *material, float length) {
    for (int c = 0; c < 3; ++c) ray->weight[c] *= expf(-material->absorption[c] * length);
}

/* A ray that met a ball, from outside or inside. */
static void leave_ball(whitted_work *work, whitted_ray *ray, int object, const float point[3]) {
    const glass_material *const material = &work->world->balls[object].material;
    const int is_inside = ray->inside == object;
    float normal[3];
    glass_world_normal(work->world, object, point, normal);
    if (is_inside) absorb(ray, material, ray->ray.t_max);
    whitted_split split = whitted_split_at(ray->ray.direction, normal, material->index, is_inside);
    if (material->surface == GLASS_MIRROR) split.reflectance = 1.0f;
    for (int crosses = 0; crosses < 2; ++crosses) {
        next_ray next = next_of(ray, &split, crosses);
        if (material->surface == GLASS_MIRROR) {
            next.way = TURN_REFLECTED;
            next.colour = material->colour;
        }
        if (!is_followed(work, ray, next.way, next.share, next.colour, next.direction)) continue;
        next.origin = point;
        next.path = ray->path + ray->ray.t_max;
        next.from = object;
        next.inside = is_inside != crosses ? object : GLASS_NOTHING;
        follow(work, ray, &next);
    }
}

/* ---- The generations ----------------------------------------------------------------------- */

/* A ray in the air that did not meet the body. */
static void end_in_air(whitted_work *work, whitted_ray *ray, int object) {
    float point[3], light[3];
    if (object == GLASS_NOTHING) {
        glass_environment(work->world, ray->ray.direction, light);
        whitted_add(work, ray, ray->weight, light);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = ray->ray.origin[axis] + ray->ray.t_max * ray->ray.direction[axis];
    }
    if (object == GLASS_GROUND || work->world->balls[object].material.surface == GLASS_MATT) {
        whitted_shade(work, ray, object, point);
    } else {
        leave_ball(work, ray, object, point);
    }
}

void whitted_trace_air(whitted_work *work, whitted_kind kind) {
    whitted_queue *const queue = &work->air;
    if (queue->count == 0 || !whitted_reserve(work, queue->count)) return;
    for (size_t i = 0; i < queue->count; ++i) {
        whitted_ray *const ray = &queue->rays[i];
        int object;
        ray->ray.t_max = glass_meet(work->world, ray->ray.origin, ray->ray.direction, ray->from,
                                    ray->inside, &object);
        ray->active = ray->inside == GLASS_NOTHING;
        work->objects[i] = object;
    }
    whitted_land(work, queue, kind);
    for (size_t i = 0; i < queue->count; ++i) {
        whitted_ray *const ray = &queue->rays[i];
        const spt_hit *const hit = &work->hits[i];
        if (hit->outcome == SPT_HIT) {
            work->objects[i] = GLASS_BODY;
            work->splits[i] = whitted_split_at(ray->ray.direction, &work->normals[3 * i],
                                               work->world->body_material.index, 0);
            work->statistics.self_hits += ray->from == GLASS_BODY;
            continue;
        }
        work->statistics.undecided += hit->outcome != SPT_MISS;
        end_in_air(work, ray, work->objects[i]);
    }
    leave_body(work, queue, 0);
}

/* A ray that finds no way out of the body, since it is thinner there than the tolerance. */
static void go_straight_on(whitted_work *work, const whitted_ray *ray) {
    const next_ray next = {TURN_REFRACTED,  1.0f,      white,      ray->ray.direction,
                           ray->ray.origin, ray->path, GLASS_BODY, GLASS_NOTHING};
    work->statistics.slivers += 1;
    if (is_followed(work, ray, next.way, next.share, white, next.direction)) {
        follow(work, ray, &next);
    }
}

void whitted_trace_body(whitted_work *work) {
    whitted_queue *const queue = &work->body;
    if (queue->count == 0 || !whitted_reserve(work, queue->count)) return;
    whitted_land(work, queue, WHITTED_INSIDE);
    for (size_t i = 0; i < queue->count; ++i) {
        whitted_ray *const ray = &queue->rays[i];
        const spt_hit *const hit = &work->hits[i];
        work->objects[i] = GLASS_NOTHING;
        if (hit->outcome == SPT_HIT) {
            work->objects[i] = GLASS_BODY;
            absorb(ray, &work->world->body_material, hit->t);
            work->splits[i] = whitted_split_at(ray->ray.direction, &work->normals[3 * i],
                                               work->world->body_material.index, 1);
            continue;
        }
        work->statistics.undecided += hit->outcome != SPT_MISS;
        go_straight_on(work, ray);
    }
    leave_body(work, queue, 1);
}
