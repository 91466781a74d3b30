/* SPDX-License-Identifier: MIT
 *
 * The loop of a renderer: all paths advance by one event in each round, in columns. */
#include "glass_run.h"
#include "check.h"

#include <math.h>
#include <string.h>

/* The columns of a round. */
typedef struct desk {
    spt_ray rays[glass_rays];
    spt_hit hits[glass_rays];
    float path[glass_rays], new_path[glass_rays];
    int32_t active[glass_rays], inside[glass_rays], cross[glass_rays], start[glass_rays];
    float normals[glass_rays][3], origins[glass_rays][3];
    double bent[glass_rays][3];
} desk;

static spt_rays rays_of(const desk *d) {
    spt_rays rays = spt_rays_of(d->rays);
    rays.path.first = d->path;
    rays.path.stride = sizeof *d->path;
    rays.active.first = d->active;
    rays.active.stride = sizeof *d->active;
    return rays;
}

/* The rays of the round, those in the body and the others each in their own way. */
static void trace_round(const glass_run *run, const spt_field *field, desk *d, int count,
                        int secondary) {
    spt_settings settings = run->settings;
    spt_rays rays = rays_of(d);
    const spt_hits hits = spt_hits_of(d->hits);
    const size_t n = (size_t)count;
    if (!secondary) settings.flags &= ~(uint32_t)SPT_SKIP_START;
    if (run->march) {
        CHECK(spt_trace(field, &settings, n, &rays, &hits, NULL) == SPT_OK);
    } else {
        CHECK(spt_trace_convex(field, &settings, n, &rays, &hits, NULL) == SPT_OK);
    }
}

/* The paper's origins: along the normal, by twice the larger of epsilon_min and |f|. */
static void start_printed(const glass_run *run, desk *d, int i, const double hit[3]) {
    const double size = fabs((double)d->hits[i].residual);
    const double move = 2 * fmax((double)run->epsilon_min, size);
    const double side = (d->inside[i] != 0) == (d->cross[i] != 0) ? 1 : -1;
    for (int axis = 0; axis < 3; ++axis) {
        d->origins[i][axis] = (float)(hit[axis] + side * move * (double)d->normals[i][axis]);
    }
    d->new_path[i] = d->path[i] + d->hits[i].t;
    d->start[i] = SPT_START_CLEAR;
}

static void offset_round(const glass_run *run, const spt_field *field, desk *d, int count) {
    const spt_rays rays = rays_of(d);
    const spt_hits hits = spt_hits_of(d->hits);
    const spt_vectors normals = spt_vectors_of(d->normals[0]);
    const spt_column cross = {d->cross, sizeof *d->cross};
    spt_starts starts;
    starts.origin = spt_vector_sinks_of(d->origins[0]);
    starts.path.first = d->new_path;
    starts.path.stride = sizeof *d->new_path;
    starts.start.first = d->start;
    starts.start.stride = sizeof *d->start;
    CHECK(spt_offset(field, 1, &run->settings, (size_t)count, &rays, &hits, &normals, &cross,
                     run->checks, &starts) == SPT_OK);
}

/* What the hit of a path is, and where its ray goes on. */
static void event_of(const glass_run *run, desk *d, int i, glass_record *record, double hit[3]) {
    const spt_ray *ray = &d->rays[i];
    double normal[3], direction[3], size = 0, against = 0;
    const int place = record->count, inside = d->inside[i];
    int refracts;
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] = (double)ray->direction[axis];
        hit[axis] = (double)ray->origin[axis] + (double)d->hits[i].t * direction[axis];
        normal[axis] = (double)d->normals[i][axis];
        size += normal[axis] * normal[axis];
        against += normal[axis] * direction[axis];
    }
    /* As renderers do: the normal is turned against the ray. */
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= copysign(sqrt(size), -against);
    refracts = glass_bend(direction, normal, inside ? run->index : 1 / run->index, d->bent[i]);
    d->cross[i] = refracts;
    record->doubtful |= (against > 0) != (inside != 0);
    record->kind[place] =
        refracts ? (inside ? GLASS_EXIT : GLASS_ENTRY) : (inside ? GLASS_TOTAL : GLASS_MIRROR);
    record->face[place] = glass_face(run->body, hit);
    record->length[place] = (double)d->hits[i].t;
    memcpy(record->point[place], hit, sizeof record->point[place]);
    memcpy(record->direction[place], d->bent[i], sizeof record->direction[place]);
    ++record->count;
}

/* Looks at the hits of the round; stops the paths that have ended. */
static void take_hits(const glass_run *run, desk *d, int count, glass_record *records,
                      double (*points)[3]) {
    for (int i = 0; i < count; ++i) {
        glass_record *record = &records[i];
        const uint32_t wanted = d->inside[i] ? SPT_FLAG_INSIDE : 0;
        const int ended = record->count > 0 && !d->inside[i];
        if (!d->active[i]) continue;
        if (ended) {
            record->returned = d->hits[i].outcome != SPT_MISS;
            d->active[i] = 0;
        } else if (d->hits[i].outcome != SPT_HIT || d->hits[i].flags != wanted) {
            record->lost = 1;
            d->active[i] = 0;
        } else {
            event_of(run, d, i, record, points[i]);
        }
    }
}

static void next_rays(desk *d, int count, glass_record *records) {
    for (int i = 0; i < count; ++i) {
        glass_record *record = &records[i];
        if (!d->active[i]) continue;
        record->start[record->count - 1] = d->start[i];
        record->doubtful |= d->start[i] != SPT_START_CLEAR;
        if (d->cross[i]) d->inside[i] = !d->inside[i];
        if (record->count == glass_events && d->inside[i]) d->active[i] = 0;
        for (int axis = 0; axis < 3; ++axis) {
            d->rays[i].origin[axis] = d->origins[i][axis];
            d->rays[i].direction[axis] = (float)d->bent[i][axis];
        }
        d->path[i] = d->new_path[i];
        record->secondary += d->active[i];
    }
}

void glass_trace(const glass_run *run, int count, const spt_ray *rays, glass_record *records) {
    static desk d;
    static double points[glass_rays][3];
    const size_t n = (size_t)count;
    spt_field field = glass_field(run->body, run->gradient);
    if (!run->declared) field.flags = 0;
    memset(&d, 0, sizeof d);
    memset(records, 0, n * sizeof *records);
    memcpy(d.rays, rays, n * sizeof *rays);
    for (int i = 0; i < count; ++i) d.active[i] = 1;
    for (int round = 0; round <= glass_events; ++round) {
        const spt_rays now = rays_of(&d);
        const spt_hits hits = spt_hits_of(d.hits);
        const spt_vector_sinks normals = spt_vector_sinks_of(d.normals[0]);
        trace_round(run, &field, &d, count, round > 0);
        CHECK(spt_normals(&field, 1, &run->settings, SPT_NORMAL_CENTRAL, 0, n, &now, &hits,
                          &normals) == SPT_OK);
        take_hits(run, &d, count, records, points);
        if (run->start == GLASS_PRINTED) {
            for (int i = 0; i < count; ++i) {
                if (d.active[i]) start_printed(run, &d, i, points[i]);
            }
        } else {
            offset_round(run, &field, &d, count);
        }
        next_rays(&d, count, records);
    }
}

/* ---- For the tests -------------------------------------------------------------------------- */

glass_tracer glass_tracer_of(const glass_run *run) {
    glass_tracer tracer;
    const glass_body *body = run->body;
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) largest = fmax(largest, fabs(body->center[axis]));
    tracer.epsilon = (double)run->settings.epsilon;
    tracer.pixel_radius = (double)run->settings.pixel_radius;
    tracer.size = largest + (double)body->bound.radius;
    /* Gradients are rounded, and normalised in float: 2^-24 each, in three places. Differences:
     * surface.h, the worst of six values at coordinates of 100 details, and here they are of 5;
     * they reach no farther than (2^-24 (C + R) R^2)^(1/3) for R <= 1 and C <= 2, or a quarter of
     * half a pixel, by the root of 3 if at the corners of a cube. */
    tracer.normal_error = run->gradient ? 0x1p-22 : 9e-5;
    tracer.normal_reach = run->gradient ? 0 : 0.01;
    return tracer;
}

spt_ray glass_ray_towards(const glass_body *body) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 100};
    double from[3], to[3], from_size, to_size, length = 0;
    do {
        from_size = to_size = 0;
        for (int axis = 0; axis < 3; ++axis) {
            from[axis] = check_uniform(-1, 1);
            to[axis] = check_uniform(-1, 1);
            from_size += from[axis] * from[axis];
            to_size += to[axis] * to[axis];
        }
    } while (!(from_size > 0.1 && from_size < 1 && to_size < 1));
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)(body->center[axis] + 3 * from[axis] / sqrt(from_size));
        to[axis] = body->center[axis] + to[axis] - (double)ray.origin[axis];
        length += to[axis] * to[axis];
    }
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = (float)(to[axis] / sqrt(length));
    return ray;
}

double glass_apart(const double a[3], const double b[3]) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return sqrt(square);
}

int glass_follow_ray(const glass_run *run, const spt_ray *ray, glass_path *path) {
    const glass_tracer tracer = glass_tracer_of(run);
    double origin[3], direction[3], length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = (double)ray->origin[axis];
        direction[axis] = (double)ray->direction[axis];
        length += direction[axis] * direction[axis];
    }
    for (int axis = 0; axis < 3; ++axis) direction[axis] /= sqrt(length);
    return glass_follow(run->body, run->index, &tracer, origin, direction, path);
}
