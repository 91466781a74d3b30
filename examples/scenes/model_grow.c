/* SPDX-License-Identifier: MIT
 *
 * Trees from the forks of one route: see model_grow.h. */
#include "model_grow.h"

#include <math.h>

#define DEGREES 0.017453292519943295 /* in radians */
#define BULGE 0.13                   /* of a branch towards where its parent went, of its length */

/* Where a route has come to. */
typedef struct growing {
    double at[3], direction[3];
    double parent[3]; /* direction of the branch before */
    double normal[3]; /* of the mirror at its foot */
    double half_width;
} growing;

static void to_float(const double from[3], float to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = (float)from[axis];
}

/* Turns a vector that is at right angles to a unit axis. */
static void turn_about(const double axis[3], double degrees, const double v[3], double turned[3]) {
    double across[3];
    model_cross(axis, v, across);
    const double cosine = cos(degrees * DEGREES), sine = sin(degrees * DEGREES);
    for (int i = 0; i < 3; ++i) turned[i] = cosine * v[i] + sine * across[i];
}

/* The unit direction at an angle from a unit direction, towards a unit vector across it. */
static void lean_to(const double direction[3], const double side[3], double degrees,
                    double leaned[3]) {
    const double cosine = cos(degrees * DEGREES), sine = sin(degrees * DEGREES);
    for (int i = 0; i < 3; ++i) leaned[i] = cosine * direction[i] + sine * side[i];
}

/* Both ends of a fork lean away from the branch in opposite directions, and the mirror takes one to
 * the other; its normal is their difference. The branch itself need not lie in it. */
static void fork_at_end(growing *now, const model_fork *fork) {
    double side[3], other[3], next[3], image[3];
    model_cross(now->normal, now->direction, side);
    model_unit(side);
    turn_about(now->direction, fork->azimuth, side, side);
    turn_about(now->direction, fork->skew, side, other);
    lean_to(now->direction, side, fork->on, next);
    lean_to(now->direction, other, -fork->off, image);
    for (int i = 0; i < 3; ++i) {
        now->normal[i] = image[i] - next[i];
        now->parent[i] = now->direction[i];
        now->direction[i] = next[i];
    }
    model_unit(now->normal);
}

static spt_kernel leaf_at(const growing *now, const model_kind *kind) {
    static const double up[3] = {0.1, 1, 0.2}; /* or nearly so */
    float foot[3], tip[3], across[3];
    for (int axis = 0; axis < 3; ++axis) {
        foot[axis] = (float)now->at[axis];
        tip[axis] = (float)(now->at[axis] + kind->leaf_length * now->direction[axis]);
        across[axis] = (float)(up[axis] - model_dot(up, now->direction) * now->direction[axis]);
    }
    return spt_kernel_leaf(foot, tip, across, (float)kind->leaf_width,
                           (float)(0.004 * kind->leaf_length));
}

static spt_kernel branch_to(const growing *now, const double end[3], double length) {
    const double along = model_dot(now->parent, now->direction);
    double bulge[3];
    for (int axis = 0; axis < 3; ++axis) {
        bulge[axis] = BULGE * length * (now->parent[axis] - along * now->direction[axis]);
    }
    return sketch_capsule(now->at, end, bulge, now->half_width);
}

/* The sketch goes from the leaf to the trunk, the route from the trunk to the leaf. */
void model_grow(model_sketch *sketch, const model_kind *kind, const model_place *place) {
    growing now = {{0, 0, 0}, {0.0524, 1, 0}, {0, 1, 0}, {1, 0, 0}, kind->half_width};
    model_unit(now.direction);
    sketch->levels = kind->count;
    for (uint32_t level = kind->count; level > 0; --level) {
        const model_fork *const fork = &kind->forks[kind->count - level];
        double end[3];
        for (int i = 0; i < 3; ++i) end[i] = now.at[i] + fork->length * now.direction[i];
        sketch->kernels[level] =
            level < MODEL_LEAF_KERNELS ? leaf_at(&now, kind) : branch_to(&now, end, fork->length);
        for (int i = 0; i < 3; ++i) now.at[i] = end[i];
        fork_at_end(&now, fork);
        to_float(now.normal, sketch->mirrors[level - 1].normal);
        sketch->mirrors[level - 1].offset = (float)model_dot(now.normal, now.at);
        now.half_width *= kind->taper;
    }
    sketch->kernels[0] = leaf_at(&now, kind);
    sketch_place(sketch, place->scale, place->turn, place->position);
}

/* Ten roots run out from the trunk, by mirrors that hold its axis. */
void model_grow_roots(model_sketch *sketch, double half_width, const model_place *place) {
    static const double turns[3] = {20, 67, 157}; /* of the mirrors, degrees */
    static const double foot[3] = {0, 0, 0};
    const double w = half_width;
    const double top[3] = {0.35 * w, 3.2 * w, 0}, end[3] = {4.4 * w, -0.5 * w, 0.6 * w};
    const double other_top[3] = {0.3 * w, 2.6 * w, 0.25 * w};
    const double other_end[3] = {2.0 * w, -0.5 * w, 2.9 * w};
    const double sag[3] = {-0.75 * w, -0.75 * w, 0}, other_sag[3] = {-0.4 * w, -0.6 * w, -0.5 * w};
    const spt_kernel root = sketch_capsule(top, end, sag, 0.5 * w);
    const spt_kernel other = sketch_capsule(other_top, other_end, other_sag, 0.45 * w);
    sketch_begin(sketch, &root);
    for (int i = 0; i < 3; ++i) {
        const double normal[3] = {-sin(turns[i] * DEGREES), 0, cos(turns[i] * DEGREES)};
        sketch_double(sketch, foot, normal, i == 0 ? &other : NULL);
    }
    sketch_place(sketch, place->scale, place->turn, place->position);
}

model_component *model_add_tree(model_world *world, const model_sketch *tree, const float tint[3]) {
    const spt_bound box = model_box(tree);
    model_component *const added = sketch_add(world, tree, 0, &box, MODEL_BARK);
    if (added == NULL) return NULL;
    added->leaf_material = MODEL_LEAF;
    added->leaf_kernels = MODEL_LEAF_KERNELS;
    for (int i = 0; i < 3; ++i) added->tint[i] = tint[i];
    return added;
}
