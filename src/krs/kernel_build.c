/* SPDX-License-Identifier: MIT
 *
 * Kernels as callers describe them, made ready to be evaluated, and balls around them. In double,
 * since flat arcs cancel. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "../trace/driver.h"
#include "sequence.h"
#define SPT_LANES 1
#include "shape_kernel.h"

static int numbers_are_good(const spt_kernel *kernel) {
    int good = 1;
    for (int axis = 0; axis < 3; ++axis) {
        good &= spti_within(kernel->a[axis], -SPTI_FARTHEST, SPTI_FARTHEST);
        good &= spti_within(kernel->b[axis], -SPTI_FARTHEST, SPTI_FARTHEST);
        good &= spti_within(kernel->control[axis], -SPTI_FARTHEST, SPTI_FARTHEST);
    }
    return good && spti_within(kernel->radius, -SPTI_FARTHEST, SPTI_FARTHEST) &&
           spti_within(kernel->width, -SPTI_FARTHEST, SPTI_FARTHEST);
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void put(spt_built_kernel *built, int place, const double v[3], double factor) {
    for (int axis = 0; axis < 3; ++axis) built->number[place + axis] = (float)(v[axis] * factor);
}

static int build_half_space(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    const double normal[3] = {(double)kernel->a[0], (double)kernel->a[1], (double)kernel->a[2]};
    const double size = length(normal);
    if (!(size >= (double)FLT_MIN)) return 0;
    put(built, SHAPE_CENTER, normal, 1.0 / size);
    built->number[SHAPE_RADIUS] = (float)((double)kernel->radius / size);
    ball->radius = (double)INFINITY;
    return fabsf(built->number[SHAPE_RADIUS]) <= SPTI_FARTHEST;
}

static void put_point(spt_built_kernel *built, int place, spt_point p) {
    built->number[place] = p.x;
    built->number[place + 1] = p.y;
    built->number[place + 2] = p.z;
}

static spt_point point_of(const float p[3]) {
    return spt_point_of(p[0], p[1], p[2]);
}

static int build_capsule(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    const spt_arc arc = spt_arc_of(point_of(kernel->a), point_of(kernel->b),
                                   point_of(kernel->control), kernel->radius);
    const double chord = (double)arc.half_chord, sagitta = (double)arc.sagitta;
    put_point(built, SHAPE_CENTER, arc.middle);
    put_point(built, SHAPE_OUTWARD, arc.outward);
    put_point(built, SHAPE_ALONG, arc.along);
    put_point(built, SHAPE_NORMAL, arc.normal);
    built->number[SHAPE_CURVATURE] = arc.curvature;
    built->number[SHAPE_HALF_CHORD] = arc.half_chord;
    built->number[SHAPE_COSINE] = arc.cosine;
    built->number[SHAPE_SAGITTA] = arc.sagitta;
    ball->center[0] = (double)arc.middle.x;
    ball->center[1] = (double)arc.middle.y;
    ball->center[2] = (double)arc.middle.z;
    /* Nothing of an arc is farther from its middle than its ends. */
    ball->radius = sqrt(chord * chord + sagitta * sagitta) + (double)kernel->radius;
    return kernel->radius >= 0.0f;
}

static int build_leaf(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    double chord[3], middle[3], normal[3], outward[3];
    const double width = (double)kernel->width;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double)kernel->a[axis], b = (double)kernel->b[axis];
        chord[axis] = b - a;
        middle[axis] = ball->center[axis] = 0.5 * (a + b);
    }
    const double whole = length(chord), half = 0.5 * whole;
    if (!(half >= 1e-15) || !(width > 0) || !(width <= half) || !(kernel->radius >= 0.0f)) return 0;
    double along = 0;
    for (int axis = 0; axis < 3; ++axis) {
        chord[axis] /= whole;
        along += chord[axis] * (double)kernel->control[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        normal[axis] = (double)kernel->control[axis] - along * chord[axis];
    }
    const double across = length(normal);
    const double control[3] = {(double)kernel->control[0], (double)kernel->control[1],
                               (double)kernel->control[2]};
    if (!(across > 1e-6 * length(control)) || !(across >= (double)FLT_MIN)) return 0;
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= across;
    spti_shape_cross(normal, chord, outward);
    const double curvature = 2 * width / (width * width + half * half);
    put(built, SHAPE_CENTER, middle, 1);
    put(built, SHAPE_OUTWARD, outward, 1);
    put(built, SHAPE_ALONG, chord, 1);
    put(built, SHAPE_NORMAL, normal, 1);
    built->number[SHAPE_CURVATURE] = (float)curvature;
    built->number[SHAPE_HALF_CHORD] = (float)half;
    built->number[SHAPE_COSINE] = (float)(1 - curvature * width);
    built->number[SHAPE_SAGITTA] = (float)width;
    ball->radius = half + (double)kernel->radius;
    return 1;
}

static int build_field(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    spt_field field;
    spt_bound bound;
    float low[3], high[3];
    double half[3];
    if (!spti_field_copy(&field, &bound, kernel->field)) return 0;
    built->batch = field.batch;
    built->point = field.point;
    built->gradient = field.gradient;
    built->user = field.user;
    built->lipschitz = field.lipschitz;
    built->glsl = field.glsl;
    built->glsl_prelude = field.glsl_prelude;
    ball->radius = (double)INFINITY;
    if (field.bound == NULL) return 1;
    if (bound.kind == SPT_BOUND_SPHERE) {
        for (int axis = 0; axis < 3; ++axis) ball->center[axis] = (double)bound.center[axis];
        ball->radius = (double)bound.radius;
        return 1;
    }
    spt_bound_extent(&bound, low, high);
    for (int axis = 0; axis < 3; ++axis) {
        ball->center[axis] = 0.5 * ((double)low[axis] + (double)high[axis]);
        half[axis] = 0.5 * ((double)high[axis] - (double)low[axis]);
        if (!spti_finite(low[axis]) || !spti_finite(high[axis])) return 1;
    }
    ball->radius = length(half);
    return 1;
}

static int build_shape(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    if (!numbers_are_good(kernel)) return 0;
    built->number[SHAPE_RADIUS] = kernel->radius;
    switch (kernel->kind) {
    case SPT_KERNEL_SPHERE:
        for (int axis = 0; axis < 3; ++axis) {
            built->number[SHAPE_CENTER + axis] = kernel->a[axis];
            ball->center[axis] = (double)kernel->a[axis];
        }
        ball->radius = (double)kernel->radius;
        return kernel->radius >= 0.0f;
    case SPT_KERNEL_HALF_SPACE:
        return build_half_space(kernel, built, ball);
    case SPT_KERNEL_CAPSULE:
        return build_capsule(kernel, built, ball);
    case SPT_KERNEL_LEAF:
        return build_leaf(kernel, built, ball);
    default:
        return 0;
    }
}

int spti_build_kernel(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball) {
    memset(built, 0, sizeof *built);
    memset(ball, 0, sizeof *ball);
    built->kind = kernel->kind;
    built->lipschitz = 1.0f;
    ball->radius = -1;
    if (kernel->kind == SPT_KERNEL_EMPTY) return 1;
    if (kernel->kind == SPT_KERNEL_FIELD) {
        if (!build_field(kernel, built, ball)) return 0;
        put(built, SHAPE_CENTER, ball->center, 1);
    } else if (!build_shape(kernel, built, ball)) {
        return 0;
    }
    built->number[SHAPE_EXTENT] = (float)ball->radius;
    return 1;
}

spti_ball spti_ball_around(const spti_ball *a, const spti_ball *b) {
    double between[3];
    for (int axis = 0; axis < 3; ++axis) between[axis] = b->center[axis] - a->center[axis];
    const double distance = length(between);
    if (a->radius < 0 || distance + a->radius <= b->radius) return *b;
    if (b->radius < 0 || distance + b->radius <= a->radius) return *a;
    spti_ball around = *a;
    around.radius = 0.5 * (distance + a->radius + b->radius);
    if (!(around.radius <= (double)FLT_MAX)) {
        around.radius = (double)INFINITY;
        return around;
    }
    for (int axis = 0; axis < 3; ++axis) {
        around.center[axis] += between[axis] * ((around.radius - a->radius) / distance);
    }
    return around;
}

/* The center moves onto the plane: what is left is then nearer than radius + distance, since
 * |x - m|^2 = |x - c|^2 + 2 distance (how far x is before c) + distance^2. */
spti_ball spti_mirror_ball(const spti_ball *ball, const spt_mirror *mirror, int *straddles) {
    spti_ball both = *ball;
    double before = (double)mirror->offset;
    for (int axis = 0; axis < 3; ++axis) {
        before -= (double)mirror->normal[axis] * ball->center[axis];
    }
    *straddles = ball->radius >= 0 && ball->radius > before;
    if (!(ball->radius >= 0) || !(ball->radius <= (double)FLT_MAX)) return both;
    if (before < 0 && !(ball->radius + before >= 0)) {
        both.radius = -1; /* all of it is cut */
        return both;
    }
    for (int axis = 0; axis < 3; ++axis) {
        both.center[axis] += before * (double)mirror->normal[axis];
    }
    both.radius =
        before < 0 ? sqrt(ball->radius * ball->radius - before * before) : ball->radius + before;
    return both;
}

spti_ball spti_map_ball(const spti_ball *ball, const spt_mobius *map) {
    spti_ball image = *ball;
    spt_region region = {SPT_REGION_BALL, {0, 0, 0}, 0};
    if (!(ball->radius >= 0) || !(ball->radius <= (double)FLT_MAX)) return image;
    memcpy(region.center, ball->center, sizeof region.center);
    region.radius = ball->radius > 1e-30 ? ball->radius : 1e-30;
    image.radius = (double)INFINITY;
    if (spt_mobius_region(map, &region, &region) != SPT_OK) return image;
    if (region.kind != SPT_REGION_BALL) return image;
    memcpy(image.center, region.center, sizeof image.center);
    image.radius = region.radius;
    return image;
}

void spti_map_whole(const spti_ball *ball, spt_built_map *map) {
    spt_bound bound;
    memset(map->whole, 0, sizeof map->whole);
    map->whole[3] = FLT_MAX;
    if (!spti_bound_of_ball(ball, &bound)) return;
    memcpy(map->whole, bound.center, sizeof bound.center);
    map->whole[3] = bound.radius;
}

int spti_bound_of_ball(const spti_ball *ball, spt_bound *bound) {
    spt_bound sphere;
    double largest = ball->radius;
    if (!(ball->radius >= 0)) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double magnitude = fabs(ball->center[axis]);
        if (!(magnitude <= largest)) largest = magnitude;
    }
    if (!(largest < 1e18)) return 0;
    /* What folds and positions in float32 may be off by. */
    const float radius = (float)(ball->radius * (1 + 0x1p-18) + largest * 0x1p-18);
    sphere = spt_bound_sphere((float)ball->center[0], (float)ball->center[1],
                              (float)ball->center[2], radius > FLT_MIN ? radius : FLT_MIN);
    return spti_bound_copy(bound, &sphere);
}

int spti_model_is_good(uint32_t levels, const spt_kernel *kernels, const void *between,
                       float smooth, uint32_t max_lanes) {
    if (levels > SPT_KRS_LEVELS || kernels == NULL) return 0;
    if (levels > 0 && between == NULL) return 0;
    if (!spti_within(smooth, 0.0f, FLT_MAX)) return 0;
    return max_lanes == 0 || max_lanes == 1 || max_lanes == 4 || max_lanes == 8 || max_lanes == 16;
}

uint32_t spti_count_fields(const spt_built_kernel *kernels, uint32_t levels) {
    uint32_t count = 0;
    for (uint32_t level = 0; level <= levels; ++level) {
        count += kernels[level].kind == SPT_KERNEL_FIELD;
    }
    return count;
}

int spti_have_gradients(const spt_built_kernel *kernels, uint32_t levels) {
    for (uint32_t level = 0; level <= levels; ++level) {
        if (kernels[level].kind == SPT_KERNEL_FIELD && kernels[level].gradient == NULL) return 0;
    }
    return 1;
}
