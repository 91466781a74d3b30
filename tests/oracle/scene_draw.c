/* SPDX-License-Identifier: MIT
 *
 * Random scenes, their callbacks and rays. */
#include "scene_draw.h"
#include "../check.h"

#include <math.h>

static int chance(unsigned of) {
    return check_random() % of == 0;
}

static float uniform(double low, double high) {
    return (float)check_uniform(low, high);
}

/* ---- Fields -------------------------------------------------------------------------------- */

static double box_distance(const drawn_body *self, const double p[3]) {
    double outside = 0, inside = -HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = fabs(p[axis]) - (double)self->half[axis];
        if (beyond > 0) outside += beyond * beyond;
        inside = fmax(inside, beyond);
    }
    return inside > 0 ? sqrt(outside) : inside;
}

static double body_distance(const drawn_body *self, double x, double y, double z) {
    const double p[3] = {x - (double)self->center[0], y - (double)self->center[1],
                         z - (double)self->center[2]};
    const double around = sqrt(p[0] * p[0] + p[2] * p[2]) - (double)self->radius;
    switch (self->kind) {
    case BODY_SPHERE:
        return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - (double)self->radius;
    case BODY_TORUS:
        return sqrt(around * around + p[1] * p[1]) - (double)self->tube;
    case BODY_PLANE:
        return p[1];
    case BODY_SHEET: /* the largest coordinate of its box's outside is never negative */
        return fmax(box_distance(self, p), 0);
    default:
        return box_distance(self, p);
    }
}

static double component_distance(const drawn_component *self, int all, double x, double y,
                                 double z) {
    double least = HUGE_VAL;
    if (x > (double)self->wall) {
        if (self->fault == FAULT_NAN) return (double)NAN;
        if (self->fault == FAULT_MINUS_INFINITE) return -HUGE_VAL;
        if (self->fault == FAULT_INFINITE) return HUGE_VAL;
    }
    for (int i = 0; i < self->count; ++i) {
        if (all || !self->hidden[i]) least = fmin(least, body_distance(&self->bodies[i], x, y, z));
    }
    return least * (double)self->factor * (self->fault == FAULT_STEEP ? 1.7 : 1);
}

void scene_component_value(const drawn_component *self, size_t n, const double *x, const double *y,
                           const double *z, double *distance) {
    for (size_t i = 0; i < n; ++i) distance[i] = component_distance(self, 1, x[i], y[i], z[i]);
}

void scene_component_visible(const drawn_component *self, size_t n, const double *x,
                             const double *y, const double *z, double *distance) {
    for (size_t i = 0; i < n; ++i) distance[i] = component_distance(self, 0, x[i], y[i], z[i]);
}

static float point_value(void *user, float x, float y, float z) {
    return (float)component_distance(user, 1, (double)x, (double)y, (double)z);
}

static void batch_values(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    for (size_t i = 0; i < n; ++i) distance[i] = point_value(user, x[i], y[i], z[i]);
}

/* ---- Scenes -------------------------------------------------------------------------------- */

void scene_body_ball(const drawn_body *self, double center[3], double *radius) {
    const double x = (double)self->half[0], y = (double)self->half[1], z = (double)self->half[2];
    for (int axis = 0; axis < 3; ++axis) center[axis] = (double)self->center[axis];
    switch (self->kind) {
    case BODY_SPHERE:
        *radius = (double)self->radius;
        return;
    case BODY_TORUS:
        *radius = (double)self->radius + (double)self->tube;
        return;
    case BODY_PLANE:
        *radius = HUGE_VAL;
        return;
    default:
        *radius = sqrt(x * x + y * y + z * z);
    }
}

static drawn_body draw_body(uint32_t selection, int planes) {
    drawn_body self = {BODY_SPHERE, {0, 0, 0}, {0, 0, 0}, 0, 0};
    const int kinds = (selection & DRAW_BALLS) != 0   ? 1
                      : (selection & DRAW_SOLID) != 0 ? BODY_SHEET
                                                      : drawn_kinds;
    self.kind = (drawn_kind)(check_random() % (uint32_t)kinds);
    if (self.kind == BODY_PLANE && !planes) self.kind = BODY_BOX;
    for (int axis = 0; axis < 3; ++axis) {
        self.center[axis] = uniform(-4, 4) + (axis == 2 ? 8.0f : 0);
        self.half[axis] = uniform(0.1, 1);
    }
    self.radius = uniform(0.1, 1.1);
    self.tube = self.radius * uniform(0.1, 0.6);
    if (self.kind == BODY_PLANE) self.center[1] = uniform(-6, -4);
    if (self.kind == BODY_SHEET) self.half[2] = 0;
    return self;
}

/* Half the sides of a body. */
static float body_half(const drawn_body *self, int axis) {
    switch (self->kind) {
    case BODY_SPHERE:
        return self->radius;
    case BODY_TORUS:
        return axis == 1 ? self->tube : self->radius + self->tube;
    default:
        return self->half[axis];
    }
}

/* A box or a sphere around all bodies, tight or not; of a single sheet the box is flat, of a single
 * sphere the sphere is just as large. */
static spt_bound draw_bound(const drawn_component *self) {
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double center[3], diagonal = 0;
    const float slack = chance(2) ? 0 : uniform(0, 0.3);
    for (int i = 0; i < self->count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = self->bodies[i].center[axis];
            const float half = body_half(&self->bodies[i], axis) + slack;
            if (middle - half < low[axis]) low[axis] = middle - half;
            if (middle + half > high[axis]) high[axis] = middle + half;
        }
    }
    if (chance(2)) return spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]);
    if (self->count == 1) {
        double radius;
        scene_body_ball(&self->bodies[0], center, &radius);
        return spt_bound_sphere((float)center[0], (float)center[1], (float)center[2],
                                (float)radius * 1.000001f + slack);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double side = (double)high[axis] - (double)low[axis];
        center[axis] = (double)low[axis] + side / 2;
        diagonal += side * side;
    }
    return spt_bound_sphere((float)center[0], (float)center[1], (float)center[2],
                            (float)(0.50001 * sqrt(diagonal)));
}

/* The exact distance to a convex body is a convex function; that to a torus or a union is not. */
static int is_convex(const drawn_component *self) {
    return self->count == 1 && self->bodies[0].kind != BODY_TORUS;
}

static spt_field field_of(drawn_component *self, int point) {
    spt_field field = spt_field_default();
    if (point) {
        field.point = point_value;
    } else {
        field.batch = batch_values;
    }
    field.user = self;
    field.lipschitz = self->factor;
    return field;
}

static drawn_component draw_component(uint32_t selection, int planes) {
    drawn_component self = {0};
    self.count = (selection & DRAW_UNITED) != 0 ? 1 + (int)(check_random() % drawn_bodies) : 1;
    for (int i = 0; i < self.count; ++i) {
        self.bodies[i] = draw_body(selection, planes && self.count == 1);
    }
    self.factor = chance(2) ? 1 : (float)pow(10, check_uniform(-3, 3));
    self.wall = INFINITY;
    if ((selection & DRAW_FAULTS) != 0 && chance(3)) {
        self.fault = (drawn_fault)(check_random() % drawn_faults);
        self.wall = uniform(-3, 3);
    }
    if ((selection & DRAW_STEEP) != 0 && chance(2)) self.fault = FAULT_STEEP;
    return self;
}

void scene_draw(drawn_scene *out, size_t count, uint32_t selection) {
    int planes = 2; /* more would leave nothing outside */
    out->scene = spt_scene_default();
    out->scene.fields = out->fields;
    out->scene.count = count;
    out->scene.zones = out->zones;
    out->scene.zone_count = 0;
    for (size_t i = 0; i < count; ++i) {
        drawn_component *self = &out->components[i];
        *self = draw_component(selection, planes > 0);
        out->fields[i] = field_of(self, chance(3));
        if (is_convex(self) && chance(2)) out->fields[i].flags = SPT_FIELD_CONVEX;
        if (self->bodies[0].kind == BODY_PLANE) {
            --planes;
        } else if (!chance(3)) {
            out->bounds[i] = draw_bound(self);
            out->fields[i].bound = &out->bounds[i];
        }
    }
}

void scene_draw_zones(drawn_scene *out) {
    out->scene.zone_count = 1 + check_random() % drawn_zones;
    for (size_t i = 0; i < out->scene.zone_count; ++i) {
        spt_zone *zone = &out->zones[i];
        for (int axis = 0; axis < 3; ++axis) {
            zone->center[axis] = uniform(-4, 4) + (axis == 2 ? 8.0f : 0);
        }
        zone->radius = uniform(0.1, 2);
        zone->component = chance(2) ? -1 : (int32_t)(check_random() % (uint32_t)out->scene.count);
    }
}

static float scaled(float a, int power) {
    return ldexpf(a, power);
}

void scene_scaled(const drawn_scene *from, int power, drawn_scene *out) {
    *out = *from;
    out->scene.fields = out->fields;
    out->scene.zones = out->zones;
    for (size_t i = 0; i < from->scene.count; ++i) {
        drawn_component *self = &out->components[i];
        spt_bound *bound = &out->bounds[i];
        out->fields[i].user = self;
        if (out->fields[i].bound != NULL) out->fields[i].bound = bound;
        self->wall = scaled(self->wall, power);
        bound->radius = scaled(bound->radius, power);
        for (int one = 0; one < self->count; ++one) {
            self->bodies[one].radius = scaled(self->bodies[one].radius, power);
            self->bodies[one].tube = scaled(self->bodies[one].tube, power);
        }
        for (int axis = 0; axis < 3; ++axis) {
            bound->center[axis] = scaled(bound->center[axis], power);
            bound->low[axis] = scaled(bound->low[axis], power);
            bound->high[axis] = scaled(bound->high[axis], power);
            for (int one = 0; one < self->count; ++one) {
                float *center = self->bodies[one].center, *half = self->bodies[one].half;
                center[axis] = scaled(center[axis], power);
                half[axis] = scaled(half[axis], power);
            }
        }
    }
    for (size_t i = 0; i < from->scene.zone_count; ++i) {
        out->zones[i].radius = scaled(out->zones[i].radius, power);
        for (int axis = 0; axis < 3; ++axis) {
            out->zones[i].center[axis] = scaled(out->zones[i].center[axis], power);
        }
    }
}

/* ---- Rays and settings --------------------------------------------------------------------- */

scene_ray scene_draw_plain_ray(void) {
    scene_ray self = {{{0, 0, 0}, 0, {0, 0, 0}, 60}, 0, 1};
    const int before = chance(2);
    double d[3], length = 0;
    for (int axis = 0; axis < 3; ++axis) {
        self.ray.origin[axis] = uniform(-4, 4) + (axis == 2 && !before ? 8.0f : 0);
        d[axis] = before && axis == 2 ? 1 : check_uniform(-1, 1) * (before ? 0.6 : 1);
        length += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        self.ray.direction[axis] = (float)(d[axis] / sqrt(length));
    }
    return self;
}

scene_ray scene_draw_ray(void) {
    scene_ray self = scene_draw_plain_ray();
    const double factor = chance(2) ? 1 : pow(10, check_uniform(-2, 2));
    for (int axis = 0; axis < 3; ++axis) {
        self.ray.direction[axis] = (float)((double)self.ray.direction[axis] * factor);
    }
    if (chance(2)) self.ray.t_min = (float)(check_uniform(0, 6) / factor);
    self.ray.t_max = (float)(check_uniform(0, 40) / factor);
    if (chance(6)) {
        self.ray.direction[check_random() % 3] = 0;
    } else if (chance(6)) { /* not beside a plane for ever */
        self.ray.t_max = INFINITY;
    }
    if (chance(3)) self.path = uniform(0, 30);
    return self;
}

spt_settings scene_draw_settings(void) {
    spt_settings settings = spt_settings_default();
    settings.budget = 3000;
    if (chance(2)) settings.pixel_radius = uniform(0, 5e-3);
    if (chance(4)) settings.size = uniform(0, 1000);
    if (chance(2)) {
        settings.relaxation = uniform(1, 1.9999);
        settings.extrapolation = uniform(0, 1);
        settings.slope_blend = uniform(0.001, 1);
        settings.step_cap = (float)pow(10, check_uniform(0, 2));
    }
    return settings;
}
