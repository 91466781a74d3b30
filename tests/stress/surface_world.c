/* SPDX-License-Identifier: MIT
 *
 * Two balls, their audited callbacks, and the arrays for calls. */
#include "surface_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Callbacks ------------------------------------------------------------------------------- */

enum { no_point_is_beyond = 1000 };

float surface_body_distance(const surface_body *body, float x, float y, float z) {
    const float dx = x - body->center[0], dy = y - body->center[1], dz = z - body->center[2];
    return (sqrtf(dx * dx + dy * dy + dz * dz) - body->radius) * body->scale;
}

static void audit_point(surface_body *body, float x, float y, float z) {
    const float far = fmaxf(fabsf(x), fmaxf(fabsf(y), fabsf(z)));
    body->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    body->strangers += !(far < (float)no_point_is_beyond);
}

/* No two arrays overlap, all are aligned, and the size is a legal one. */
static void audit_arrays(surface_body *body, size_t n, const float *const *arrays, int count) {
    body->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH;
    for (int i = 0; i < count; ++i) {
        const uintptr_t first = (uintptr_t)arrays[i];
        body->faults += (first & 63u) != 0;
        for (int j = 0; j < i; ++j) {
            const uintptr_t other = (uintptr_t)arrays[j];
            body->faults += (first > other ? first - other : other - first) < n * sizeof(float);
        }
    }
}

static void audited_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    surface_body *const body = user;
    const float *const arrays[] = {x, y, z, distance};
    if (body->visit != NULL) body->visit(body->visitor);
    ++body->calls;
    body->points += n;
    audit_arrays(body, n, arrays, 4);
    for (size_t i = 0; i < n; ++i) {
        audit_point(body, x[i], y[i], z[i]);
        distance[i] = surface_body_distance(body, x[i], y[i], z[i]);
    }
}

static float audited_point(void *user, float x, float y, float z) {
    surface_body *const body = user;
    if (body->visit != NULL) body->visit(body->visitor);
    ++body->calls;
    ++body->points;
    audit_point(body, x, y, z);
    return surface_body_distance(body, x, y, z);
}

static void audited_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                             float *gradient_x, float *gradient_y, float *gradient_z) {
    surface_body *const body = user;
    const float *const arrays[] = {x, y, z, gradient_x, gradient_y, gradient_z};
    if (body->visit != NULL) body->visit(body->visitor);
    ++body->gradient_calls;
    audit_arrays(body, n, arrays, 6);
    for (size_t i = 0; i < n; ++i) {
        audit_point(body, x[i], y[i], z[i]);
        gradient_x[i] = x[i] - body->center[0];
        gradient_y[i] = y[i] - body->center[1];
        gradient_z[i] = z[i] - body->center[2];
    }
}

/* ---- Rays and hits --------------------------------------------------------------------------- */

/* A ray by its index; 17 by 16 directions meet both balls and pass both. */
static void write_ray(surface_world *self, size_t i) {
    const float scale = (float)(1u << i % 3);
    const int inside = i % 7 == 3;
    const float across = (float)((5 * i + 8) % 17) - 8.0f; /* the middle first */
    const float upward = (float)((5 * (i / 17) + 7) % 16) - 7.0f;
    const float ray[] = {
        0.05f * (float)(i % 5),      inside ? 0.1f : 0.0f,    inside ? 9.8f : 0.0f,
        across * 0.02f * scale,      upward * 0.015f * scale, scale,
        i % 4 == 1 ? 0.0625f : 0.0f, 30.0f / scale,           0.5f + 0.01f * (float)(i % 5)};
    for (int column = 0; column <= IN_PATH; ++column) {
        self->in[column][i] = surface_bits(ray[column]);
    }
    self->in[IN_ACTIVE][i] = 0xffffffffu;
    self->in[IN_CROSS][i] = i % 3 == 1;
    self->in[IN_TANGENT][i] = surface_bits(0.01f + 0.02f * (float)(i % 9));
}

/* The nearer of the hits with each ball. */
static void trace_hits(surface_world *self) {
    surface_call call;
    for (int field = 0; field < surface_most_fields; ++field) {
        uint32_t found[9][surface_most];
        surface_call_make(&call, self, DOOR_CONVEX, 1, 0);
        for (int column = 0; column < 9; ++column) call.out[column].first = found[column];
        const spt_rays rays = surface_rays(&call);
        const spt_hits hits = surface_hits(&call);
        spt_trace(&self->fields[field], &self->settings, surface_most, &rays, &hits, NULL);
        for (size_t i = 0; i < surface_most; ++i) {
            const float now = surface_float(self->hits[OUT_T][i]);
            if (field > 0 && !(surface_float(found[OUT_T][i]) < now)) continue;
            for (int column = 0; column < 9; ++column) self->hits[column][i] = found[column][i];
            if (found[OUT_OUTCOME][i] == SPT_HIT) self->hits[OUT_COMPONENT][i] = (uint32_t)field;
        }
    }
}

/* The outward normal at a hit, and what lies around it. */
static void write_around(surface_world *self, size_t i) {
    const int32_t component = (int32_t)self->hits[OUT_COMPONENT][i];
    const surface_body *const body = &self->bodies[component > 0 ? component : 0];
    const float t = surface_float(self->hits[OUT_T][i]), depth = 0.1f * (float)(i % 5) - 0.1f;
    float normal[3] = {0.0f, 0.0f, -1.0f}, point[3] = {0.1f * (float)(i % 10), 0.3f, 8.0f};
    for (int axis = 0; axis < 3 && component >= 0; ++axis) {
        const float along = t * surface_float(self->in[IN_DIRECTION + axis][i]);
        point[axis] = surface_float(self->in[IN_ORIGIN + axis][i]) + along;
        normal[axis] = (point[axis] - body->center[axis]) / body->radius;
    }
    const float to[3] = {0.5f, -0.25f * (float)(i % 3), 0.3f * (float)(i % 4)};
    for (int axis = 0; axis < 3; ++axis) {
        const float offset = depth * normal[axis], from = point[axis] + offset;
        self->in[IN_NORMAL + axis][i] = surface_bits(i % 29 == 5 ? 0.0f : normal[axis]);
        self->in[IN_POINT + axis][i] = surface_bits(from);
        self->in[IN_TO + axis][i] = surface_bits(i % 11 == 4 ? from : from + to[axis]);
    }
    self->in[IN_RADIUS][i] = surface_bits(0.05f * (float)(i % 4));
}

void surface_world_make(surface_world *self) {
    const surface_body bodies[surface_most_fields] = {
        {{0.0f, 0.0f, 10.0f}, 1.0f, 1.0f, 0, 0, 0, 0, 0, NULL, NULL},
        {{1.3f, 0.2f, 11.5f}, 0.8f, 2.0f, 0, 0, 0, 0, 0, NULL, NULL}};
    memset(self, 0, sizeof *self);
    memcpy(self->bodies, bodies, sizeof bodies);
    for (size_t i = 0; i < surface_most; ++i) write_ray(self, i);
    trace_hits(self);
    for (size_t i = 0; i < surface_most; ++i) write_around(self, i);
}

/* ---- Calls ----------------------------------------------------------------------------------- */

static void prepare_fields(surface_world *world, uint32_t form) {
    for (int i = 0; i < surface_most_fields; ++i) {
        surface_body *const body = &world->bodies[i];
        spt_field *const field = &world->fields[i];
        body->calls = body->points = body->gradient_calls = body->faults = body->strangers = 0;
        *field = spt_field_default();
        field->batch = (form & SURFACE_POINT) != 0 ? NULL : audited_batch;
        field->point = (form & SURFACE_POINT) != 0 ? audited_point : NULL;
        field->gradient = (form & SURFACE_GRADIENT) != 0 ? audited_gradient : NULL;
        field->user = body;
        field->lipschitz = body->scale;
        field->flags = SPT_FIELD_CONVEX;
    }
    world->bound = spt_bound_sphere(0.1f, 0.0f, 10.0f, 1.25f);
    world->fields[0].bound = &world->bound;
}

static spt_settings settings_of(uint32_t lanes) {
    spt_settings settings = spt_settings_default();
    settings.budget = 200;
    settings.pixel_radius = 1e-3f;
    settings.max_lanes = lanes;
    return settings;
}

static void prepare_outputs(surface_world *world, const surface_facts *facts) {
    const uint32_t read = facts->outputs_kept | facts->outputs_changed;
    memset(world->out, surface_fill, sizeof world->out);
    for (int column = 0; column < 9; ++column) {
        if (!SURFACE_HAS(read, column)) continue;
        memcpy(world->out[column], world->hits[column], sizeof world->hits[column]);
    }
}

void surface_call_make(surface_call *call, surface_world *world, surface_door door, uint32_t lanes,
                       uint32_t form) {
    prepare_fields(world, form);
    prepare_outputs(world, &surface_table[door]);
    memset(call, 0, sizeof *call);
    world->settings = settings_of(lanes);
    world->statistics = spt_statistics_default();
    call->door = door;
    call->fields = world->fields;
    call->field_count = (surface_table[door].takes & TAKES_FIELDS) != 0 ? surface_most_fields : 1;
    call->settings = &world->settings;
    call->statistics = &world->statistics;
    call->count = surface_most;
    for (int column = 0; column < surface_inputs; ++column) {
        call->in[column].first = world->in[column];
        call->in[column].stride = 4;
    }
    for (int column = 0; column < surface_outputs; ++column) {
        call->out[column].first = world->out[column];
        call->out[column].stride = (ptrdiff_t)surface_width(column);
    }
    call->crossing_step = 4;
    call->most_crossings = surface_most_crossings;
    call->iterations = 3;
    call->checks = 4;
    call->samples = 5;
    call->distance = 0.2f;
    call->rule = SPT_NORMAL_CENTRAL;
}

size_t surface_calls_seen(const surface_world *world) {
    size_t calls = 0;
    for (int i = 0; i < surface_most_fields; ++i) {
        calls += world->bodies[i].calls + world->bodies[i].gradient_calls;
    }
    return calls;
}

void surface_visit(surface_world *world, void (*visit)(void *visitor), void *visitor) {
    for (int i = 0; i < surface_most_fields; ++i) {
        world->bodies[i].visit = visit;
        world->bodies[i].visitor = visitor;
    }
}

size_t surface_faults_seen(const surface_world *world) {
    size_t faults = 0;
    for (int i = 0; i < surface_most_fields; ++i) {
        faults += world->bodies[i].faults + world->bodies[i].strangers;
    }
    return faults;
}
