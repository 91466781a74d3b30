/* SPDX-License-Identifier: MIT
 *
 * Sequences that are described level by level and then put somewhere: see model_nature.h. */
#include "model_nature.h"

#include <math.h>

void sketch_begin(model_sketch *sketch, const spt_kernel *leaf) {
    sketch->kernels[0] = *leaf;
    sketch->levels = 0;
}

void sketch_double(model_sketch *sketch, const double point[3], const double normal[3],
                   const spt_kernel *kernel) {
    double unit[3] = {normal[0], normal[1], normal[2]};
    model_unit(unit);
    spt_mirror *const mirror = &sketch->mirrors[sketch->levels];
    for (int axis = 0; axis < 3; ++axis) mirror->normal[axis] = (float)unit[axis];
    mirror->offset = (float)model_dot(point, unit);
    sketch->kernels[++sketch->levels] = kernel != NULL ? *kernel : spt_kernel_empty();
}

void sketch_fold(const model_sketch *sketch, int is_direction, double point[3]) {
    for (uint32_t i = sketch->levels; i-- > 0;) {
        const spt_mirror *const mirror = &sketch->mirrors[i];
        double beyond = is_direction ? 0 : -(double)mirror->offset;
        for (int k = 0; k < 3; ++k) beyond += (double)mirror->normal[k] * point[k];
        if (!(beyond > 0)) continue;
        for (int k = 0; k < 3; ++k) point[k] -= 2 * beyond * (double)mirror->normal[k];
    }
}

/* x, y, z to the turned vector. */
static void turned(float vector[3], double cosine, double sine) {
    const double x = (double)vector[0], z = (double)vector[2];
    vector[0] = (float)(cosine * x + sine * z);
    vector[2] = (float)(cosine * z - sine * x);
}

static void place_point(float point[3], double scale, double cosine, double sine,
                        const double position[3]) {
    turned(point, cosine, sine);
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = (float)(scale * (double)point[axis] + position[axis]);
    }
}

static double dot_mixed(const float a[3], const double b[3]) {
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

void sketch_place(model_sketch *sketch, double scale, double turn, const double position[3]) {
    const double cosine = cos(turn), sine = sin(turn);
    for (uint32_t i = 0; i <= sketch->levels; ++i) {
        spt_kernel *const kernel = &sketch->kernels[i];
        kernel->radius = (float)(scale * (double)kernel->radius);
        kernel->width = (float)(scale * (double)kernel->width);
        if (kernel->kind == SPT_KERNEL_HALF_SPACE) {
            turned(kernel->a, cosine, sine);
            kernel->radius = (float)((double)kernel->radius + dot_mixed(kernel->a, position));
            continue;
        }
        place_point(kernel->a, scale, cosine, sine, position);
        place_point(kernel->b, scale, cosine, sine, position);
        if (kernel->kind == SPT_KERNEL_LEAF) {
            turned(kernel->control, cosine, sine);
        } else {
            place_point(kernel->control, scale, cosine, sine, position);
        }
    }
    for (uint32_t i = 0; i < sketch->levels; ++i) {
        spt_mirror *const mirror = &sketch->mirrors[i];
        turned(mirror->normal, cosine, sine);
        mirror->offset =
            (float)(scale * (double)mirror->offset + dot_mixed(mirror->normal, position));
    }
}

model_component *sketch_add(model_world *world, const model_sketch *sketch, double smooth,
                            const spt_bound *bound, model_material material) {
    spt_krs_model described = spt_krs_model_default();
    described.levels = sketch->levels;
    described.kernels = sketch->kernels;
    described.mirrors = sketch->mirrors;
    described.bound = bound;
    described.smooth = (float)smooth;
    return model_add_krs(world, &described, material);
}

spt_kernel sketch_capsule(const double from[3], const double to[3], const double by[3],
                          double radius) {
    float a[3], b[3], control[3];
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = (float)from[axis];
        b[axis] = (float)to[axis];
        control[axis] = (float)(0.5 * (from[axis] + to[axis]) + by[axis]);
    }
    return spt_kernel_capsule(a, b, control, (float)radius);
}

void sketch_direction(uint32_t *state, double direction[3]) {
    const double up = model_random(state, -1, 1), turn = model_random(state, 0, 6.283185307179586);
    const double across = sqrt(1 - up * up);
    direction[0] = across * cos(turn);
    direction[1] = up;
    direction[2] = across * sin(turn);
}

void sketch_lean(const double axis[3], double tilt, double turn, double leaned[3]) {
    /* two vectors across the axis, from the coordinate axis that is least along it */
    const double x = fabs(axis[0]), y = fabs(axis[1]), z = fabs(axis[2]);
    const double least[3] = {x <= y && x <= z ? 1.0 : 0.0, y < x && y <= z ? 1.0 : 0.0,
                             z < x && z < y ? 1.0 : 0.0};
    double across[3], other[3];
    model_cross(axis, least, across);
    model_unit(across);
    model_cross(axis, across, other);
    for (int i = 0; i < 3; ++i) {
        leaned[i] =
            cos(tilt) * axis[i] + sin(tilt) * (cos(turn) * across[i] + sin(turn) * other[i]);
    }
}
