/* SPDX-License-Identifier: MIT
 *
 * The bodies as fields. */
#include "energy_world.h"
#include "../check.h"

#include <path_wave.h>

#include <math.h>
#include <string.h>

static double length_of(double x, double y, double z) {
    return sqrt(x * x + y * y + z * z);
}

static double box_distance(const double q[3]) {
    const double outside = length_of(fmax(q[0], 0), fmax(q[1], 0), fmax(q[2], 0));
    return outside + fmin(fmax(q[0], fmax(q[1], q[2])), 0);
}

double energy_distance(const energy_body *body, const double p[3]) {
    double v[3], q[3], along = -(double)body->offset;
    for (int axis = 0; axis < 3; ++axis) {
        v[axis] = p[axis] - (double)body->center[axis];
        q[axis] = fabs(v[axis]) - (double)body->half[axis];
        along += (double)body->normal[axis] * p[axis];
    }
    switch (body->kind) {
    case ENERGY_BALL:
        return length_of(v[0], v[1], v[2]) - (double)body->radius;
    case ENERGY_HOLLOW:
        return (double)body->radius - length_of(v[0], v[1], v[2]);
    case ENERGY_BOX:
        return box_distance(q);
    case ENERGY_WALL:
        return along;
    case ENERGY_RING:
        break;
    }
    return length_of(length_of(v[0], v[2], 0) - (double)body->radius, v[1], 0) - (double)body->tube;
}

/* Away from the nearest point of a box, or inside of it through the nearest face. */
static void box_gradient(const energy_body *body, const double v[3], double gradient[3]) {
    int nearest = 0, outside = 0;
    double past[3];
    for (int axis = 0; axis < 3; ++axis) {
        past[axis] = fabs(v[axis]) - (double)body->half[axis];
        outside = outside || past[axis] > 0;
        if (past[axis] > past[nearest]) nearest = axis;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double share = outside ? fmax(past[axis], 0) : axis == nearest;
        gradient[axis] = copysign(share, v[axis]);
    }
}

static void gradient_of(const energy_body *body, const double p[3], double gradient[3]) {
    const double sign = body->kind == ENERGY_HOLLOW ? -1 : 1;
    double v[3];
    for (int axis = 0; axis < 3; ++axis) v[axis] = p[axis] - (double)body->center[axis];
    if (body->kind == ENERGY_BOX) {
        box_gradient(body, v, gradient);
        return;
    }
    const double inward = 1 - (double)body->radius / length_of(v[0], v[2], 0);
    for (int axis = 0; axis < 3; ++axis) {
        gradient[axis] = sign * v[axis];
        if (body->kind == ENERGY_WALL) gradient[axis] = (double)body->normal[axis];
        if (body->kind == ENERGY_RING && axis != 1) gradient[axis] = inward * v[axis];
    }
}

static void body_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *gradient_x, float *gradient_y, float *gradient_z) {
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        double gradient[3];
        gradient_of(user, p, gradient);
        gradient_x[i] = (float)gradient[0];
        gradient_y[i] = (float)gradient[1];
        gradient_z[i] = (float)gradient[2];
    }
}

void energy_add_gradients(energy_world *self) {
    for (size_t k = 0; k < self->scene.count; ++k) self->fields[k].gradient = body_gradient;
}

/* Computed in double and rounded, so that the field's own error is half an ulp. */
static void one_body(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *distance) {
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)energy_distance(user, p);
    }
}

static void all_bodies(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    const energy_world *self = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        double least = HUGE_VAL;
        for (int k = 0; k < self->count; ++k) {
            least = fmin(least, energy_distance(&self->bodies[k], p));
        }
        distance[i] = (float)least;
    }
}

void energy_build(energy_world *self, int whole) {
    self->scene = spt_scene_default();
    self->scene.fields = self->fields;
    self->scene.materials = self->numbers;
    self->scene.count = whole ? 1 : (size_t)self->count;
    for (int k = 0; k < self->count; ++k) {
        const energy_kind kind = self->bodies[k].kind;
        const int convex = kind == ENERGY_BALL || kind == ENERGY_BOX || kind == ENERGY_WALL;
        self->fields[k] = spt_field_default();
        self->fields[k].batch = one_body;
        self->fields[k].user = &self->bodies[k];
        self->fields[k].flags = convex ? SPT_FIELD_CONVEX : 0;
        self->numbers[k] = k;
        self->materials[k] = self->bodies[k].material;
    }
    if (whole) {
        self->fields[0].batch = all_bodies;
        self->fields[0].user = self;
        self->fields[0].flags = 0;
    }
    self->world.scene = &self->scene;
    self->world.materials = self->materials;
}

void energy_look(energy_world *self, const float eye[3], const float target[3], int width,
                 int height) {
    static const float up[3] = {0, 1, 0};
    (void)spt_camera_pinhole(&self->world.camera, eye, target, up, 0.7f, (uint32_t)width,
                             (uint32_t)height);
    self->world.camera.t_max = 100;
}

void energy_render(const energy_world *self, const path_settings *settings, int width, int height,
                   const uint32_t area[4], uint32_t first, uint32_t count, double (*light)[3],
                   path_statistics *statistics) {
    const size_t pixels = (size_t)(area[2] - area[0]) * (area[3] - area[1]);
    path_job job;
    CHECK(path_job_create(&job, &self->world, settings, width, height));
    path_wave *wave = path_wave_create(&job);
    CHECK(wave != NULL);
    memset(light, 0, pixels * sizeof *light);
    for (uint32_t sample = first; wave != NULL && sample < first + count; ++sample) {
        path_wave_begin(wave, area, sample);
        while (path_wave_step(wave)) {
        }
        for (size_t i = 0; i < pixels; ++i) {
            for (int c = 0; c < 3; ++c) light[i][c] += (double)wave->light[i][c];
        }
    }
    CHECK(wave != NULL && wave->status == SPT_OK);
    if (wave != NULL && statistics != NULL) *statistics = wave->statistics;
    path_wave_free(wave);
    path_job_free(&job);
}
