/* SPDX-License-Identifier: MIT
 *
 * Elementary maps of points and regions by center and radius. */
#include "moekrs_maps.h"
#include "../check.h"

#include <math.h>
#include <string.h>

void moekrs_append(moekrs_chain *chain, moekrs_step_kind kind, const double vector[3],
                   double number) {
    moekrs_step *step = &chain->step[chain->count++];
    CHECK(chain->count <= moekrs_steps);
    step->kind = kind;
    step->number = (wide)number;
    for (int axis = 0; axis < 3; ++axis)
        step->vector[axis] = vector == NULL ? 0 : (wide)vector[axis];
}

moekrs_chain moekrs_undone(const moekrs_chain *chain) {
    moekrs_chain undone;
    undone.count = chain->count;
    for (int i = 0; i < chain->count; ++i) {
        moekrs_step *step = &undone.step[i];
        *step = chain->step[chain->count - 1 - i];
        if (step->kind == MOEKRS_DILATION) step->number = 1 / step->number;
        if (step->kind == MOEKRS_ROTATION) step->number = -step->number;
        if (step->kind != MOEKRS_TRANSLATION) continue; /* the others undo themselves */
        for (int axis = 0; axis < 3; ++axis) step->vector[axis] = -step->vector[axis];
    }
    return undone;
}

wide moekrs_dot(const wide a[3], const wide b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

wide moekrs_length(const wide a[3]) {
    return sqrtl(moekrs_dot(a, a));
}

/* Rodrigues' formula: p cos + (axis x p) sin + axis (axis . p)(1 - cos). */
static void rotate(const wide axis[3], wide angle, wide p[3]) {
    const wide length = moekrs_length(axis);
    const wide n[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
    const wide cross[3] = {n[1] * p[2] - n[2] * p[1], n[2] * p[0] - n[0] * p[2],
                           n[0] * p[1] - n[1] * p[0]};
    const wide along = moekrs_dot(n, p) * (1 - cosl(angle));
    for (int i = 0; i < 3; ++i) p[i] = p[i] * cosl(angle) + cross[i] * sinl(angle) + n[i] * along;
}

static void move_point(const moekrs_step *step, wide p[3]) {
    const wide *v = step->vector;
    const wide from[3] = {p[0] - v[0], p[1] - v[1], p[2] - v[2]};
    wide factor;
    switch (step->kind) {
    case MOEKRS_DILATION:
        for (int axis = 0; axis < 3; ++axis) p[axis] *= step->number;
        break;
    case MOEKRS_TRANSLATION:
        for (int axis = 0; axis < 3; ++axis) p[axis] += v[axis];
        break;
    case MOEKRS_ROTATION:
        rotate(v, step->number, p);
        break;
    case MOEKRS_REFLECTION:
        factor = 2 * (moekrs_dot(v, p) - step->number) / moekrs_dot(v, v);
        for (int axis = 0; axis < 3; ++axis) p[axis] -= factor * v[axis];
        break;
    case MOEKRS_INVERSION:
        factor = step->number * step->number / moekrs_dot(from, from);
        for (int axis = 0; axis < 3; ++axis) p[axis] = v[axis] + factor * from[axis];
        break;
    }
}

void moekrs_move(const moekrs_chain *chain, const wide p[3], wide image[3]) {
    wide moved[3] = {p[0], p[1], p[2]};
    for (int i = 0; i < chain->count; ++i) move_point(&chain->step[i], moved);
    memcpy(image, moved, sizeof moved);
}

moekrs_region moekrs_ball(const double center[3], double radius) {
    const moekrs_region ball = {
        SPT_REGION_BALL, {(wide)center[0], (wide)center[1], (wide)center[2]}, (wide)radius};
    return ball;
}

moekrs_region moekrs_half_space(const double normal[3], double offset) {
    moekrs_region half = moekrs_ball(normal, offset);
    const wide length = moekrs_length(half.center);
    half.kind = SPT_REGION_HALF_SPACE;
    for (int axis = 0; axis < 3; ++axis) half.center[axis] /= length;
    half.radius /= length;
    return half;
}

wide moekrs_region_distance(const moekrs_region *region, const wide p[3]) {
    const wide *c = region->center;
    const wide from[3] = {p[0] - c[0], p[1] - c[1], p[2] - c[2]};
    if (region->kind == SPT_REGION_HALF_SPACE) return moekrs_dot(c, p) - region->radius;
    return (moekrs_length(from) - region->radius) * (region->kind == SPT_REGION_BALL ? 1 : -1);
}

void moekrs_region_normal(const moekrs_region *region, const wide p[3], wide normal[3]) {
    const wide *c = region->center;
    const wide from[3] = {p[0] - c[0], p[1] - c[1], p[2] - c[2]};
    const wide length = moekrs_length(from) * (region->kind == SPT_REGION_BALL ? 1 : -1);
    const int plane = region->kind == SPT_REGION_HALF_SPACE;
    for (int axis = 0; axis < 3; ++axis) normal[axis] = plane ? c[axis] : from[axis] / length;
}

/* A plane normal . p = offset under a similarity: its foot moves as a point, its normal as the
 * difference of two. */
static void move_plane(const moekrs_step *step, moekrs_region *region) {
    wide foot[3], tip[3], length;
    for (int axis = 0; axis < 3; ++axis) {
        foot[axis] = region->radius * region->center[axis];
        tip[axis] = foot[axis] + region->center[axis];
    }
    move_point(step, foot);
    move_point(step, tip);
    for (int axis = 0; axis < 3; ++axis) tip[axis] -= foot[axis];
    length = moekrs_length(tip);
    for (int axis = 0; axis < 3; ++axis) region->center[axis] = tip[axis] / length;
    region->radius = moekrs_dot(region->center, foot);
}

/* A plane h > 0 or < 0 along its normal from the inversion's centre: a sphere through the centre,
 * of diameter R^2 / |h|. Infinity goes to the centre and the centre to infinity, so the image has
 * no end where the half space held the centre. */
static void invert_plane(const moekrs_step *step, moekrs_region *region) {
    const wide *v = step->vector;
    const wide h = region->radius - moekrs_dot(region->center, v);
    const wide square = step->number * step->number;
    if (fabsl(h) <= 1e-15L * (fabsl(region->radius) + moekrs_length(v))) return;
    for (int axis = 0; axis < 3; ++axis) {
        region->center[axis] = v[axis] + region->center[axis] * square / (2 * h);
    }
    region->radius = square / (2 * fabsl(h));
    region->kind = h > 0 ? SPT_REGION_OUTSIDE : SPT_REGION_BALL;
}

/* A sphere at w from the inversion's centre, D = |w|^2 - r^2: centre R^2 w / D, radius R^2 r / |D|.
 * Where D = 0 the plane w . p = R^2 / 2 about the inversion's centre. */
static void invert_sphere(const moekrs_step *step, moekrs_region *region) {
    const wide *v = step->vector;
    const wide square = step->number * step->number, r = region->radius;
    const wide w[3] = {region->center[0] - v[0], region->center[1] - v[1],
                       region->center[2] - v[2]};
    const wide length = moekrs_length(w), D = (length - r) * (length + r);
    const int ball = region->kind == SPT_REGION_BALL, holds = ball ? D < 0 : D > 0;
    if (fabsl(D) <= 1e-15L * r * r) {
        const int sign = ball ? -1 : 1; /* a ball's far side is what lies towards w */
        for (int axis = 0; axis < 3; ++axis) region->center[axis] = sign * w[axis] / length;
        region->radius = sign * square / (2 * length) + moekrs_dot(region->center, v);
        region->kind = SPT_REGION_HALF_SPACE;
        return;
    }
    for (int axis = 0; axis < 3; ++axis) region->center[axis] = v[axis] + square * w[axis] / D;
    region->radius = square * r / fabsl(D);
    region->kind = holds ? SPT_REGION_OUTSIDE : SPT_REGION_BALL;
}

moekrs_region moekrs_map_region(const moekrs_chain *chain, const moekrs_region *region) {
    moekrs_region moved = *region;
    for (int i = 0; i < chain->count; ++i) {
        const moekrs_step *step = &chain->step[i];
        const int plane = moved.kind == SPT_REGION_HALF_SPACE;
        if (step->kind == MOEKRS_INVERSION) {
            (plane ? invert_plane : invert_sphere)(step, &moved);
        } else if (plane) {
            move_plane(step, &moved);
        } else {
            move_point(step, moved.center);
            if (step->kind == MOEKRS_DILATION) moved.radius *= fabsl(step->number);
        }
    }
    return moved;
}

spt_mobius moekrs_library_map(const moekrs_chain *chain) {
    spt_mobius map = spt_mobius_identity();
    for (int i = 0; i < chain->count; ++i) {
        const moekrs_step *step = &chain->step[i];
        const double number = (double)step->number;
        const double v[3] = {(double)step->vector[0], (double)step->vector[1],
                             (double)step->vector[2]};
        spt_mobius next = spt_mobius_identity();
        CHECK((step->kind == MOEKRS_DILATION      ? spt_mobius_dilation(number, &next)
               : step->kind == MOEKRS_TRANSLATION ? spt_mobius_translation(v, &next)
               : step->kind == MOEKRS_ROTATION    ? spt_mobius_rotation(v, number, &next)
               : step->kind == MOEKRS_REFLECTION
                   ? spt_mobius_reflection(v, number, &next)
                   : spt_mobius_inversion(v, number, &next)) == SPT_OK);
        CHECK(spt_mobius_compose(&next, &map, &map) == SPT_OK);
    }
    return map;
}
