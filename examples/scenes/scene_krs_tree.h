/* SPDX-License-Identifier: MIT
 *
 * A bare tree of 16 levels, and the same with 12 levels of twigs more: kernel-reflection sequences
 * of toroidal capsules (Szécsi et al. 2016, section 9.2). The callbacks are the library's own; the
 * loop here is its reference, and what a caller would write who needs this one tree. */
#ifndef EXAMPLES_SCENE_KRS_TREE_H
#define EXAMPLES_SCENE_KRS_TREE_H

#include "scene_source.h"

#include <math.h>

enum { KRS_TREE_MOST = 28 };

/* One route from the trunk to the end of a twig: branch j goes from fork j to fork j + 1, where
 * mirror j stands. */
typedef struct krs_tree_route {
    float fork[KRS_TREE_MOST + 2][3];
    float control[KRS_TREE_MOST + 1][3]; /* of branch j */
    float half_width[KRS_TREE_MOST + 1]; /* of branch j */
    float normal[KRS_TREE_MOST][3], offset[KRS_TREE_MOST];
} krs_tree_route;

/* splitmix32 */
static inline double krs_tree_draw(uint32_t *state, double low, double high) {
    uint32_t x = *state += 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return low + (high - low) * ((x ^ (x >> 16)) / 4294967296.0);
}

static inline void krs_tree_unit(double v[3]) {
    const double length = sqrt(spti_shape_dot(v, v));
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
}

/* A mirror in which a unit direction is not mirrored but turned into another: the direction that
 * the route takes, leaning to `side`; its image leans the other way and out of their plane. */
static inline void krs_tree_fork(uint32_t *state, double direction[3], double normal[3]) {
    double side[3], across[3], image[3];
    const double to_side = krs_tree_draw(state, 0.25, 0.8);
    const double away = krs_tree_draw(state, 0.9, 1.15) - to_side;
    const double turned = krs_tree_draw(state, -0.3, 0.3);
    /* at right angles to the last mirror's normal, or nearly so */
    spti_shape_cross(direction, normal, side);
    krs_tree_unit(side);
    spti_shape_cross(direction, side, across);
    for (int axis = 0; axis < 3; ++axis) {
        side[axis] += krs_tree_draw(state, -0.7, 0.7) * across[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        image[axis] = direction[axis] - away * side[axis] + turned * across[axis];
        direction[axis] += to_side * side[axis];
    }
    krs_tree_unit(image);
    krs_tree_unit(direction);
    for (int axis = 0; axis < 3; ++axis) normal[axis] = image[axis] - direction[axis];
    krs_tree_unit(normal);
}

/* The route of any number of levels begins like that of more. Computed by exact operations and
 * roots alone, so that it has the same bits everywhere. */
static inline void krs_tree_grow(krs_tree_route *route) {
    double at[3] = {0, 0, 0}, direction[3] = {0, 1, 0}, parent[3] = {0, 1, 0};
    double normal[3] = {1, 0, 0}, length = 2, half_width = 0.25;
    uint32_t state = 1;
    for (int axis = 0; axis < 3; ++axis) route->fork[0][axis] = 0;
    for (int j = 0; j <= KRS_TREE_MOST; ++j) {
        const double along = spti_shape_dot(parent, direction);
        route->half_width[j] = (float)half_width;
        for (int axis = 0; axis < 3; ++axis) {
            const double way = length * direction[axis];
            const double bulge = 0.15 * length * (parent[axis] - along * direction[axis]);
            route->control[j][axis] = (float)(at[axis] + 0.5 * way + bulge);
            at[axis] += way;
            route->fork[j + 1][axis] = (float)at[axis];
            parent[axis] = direction[axis];
        }
        if (j == KRS_TREE_MOST) break;
        krs_tree_fork(&state, direction, normal);
        for (int axis = 0; axis < 3; ++axis) route->normal[j][axis] = (float)normal[axis];
        route->offset[j] = (float)spti_shape_dot(normal, at);
        length *= krs_tree_draw(&state, 0.76, 0.94);
        half_width *= 0.88;
    }
}

/* As the loop needs it. */
typedef struct krs_tree_table {
    spt_arc arcs[KRS_TREE_MOST + 1];
    spt_point normals[KRS_TREE_MOST];
    spt_real offsets[KRS_TREE_MOST];
} krs_tree_table;

static inline spt_point krs_tree_point(const float v[3]) {
    return spt_point_of((spt_real)v[0], (spt_real)v[1], (spt_real)v[2]);
}

static inline krs_tree_table krs_tree_table_of(const krs_tree_route *route) {
    krs_tree_table table;
    for (int j = 0; j <= KRS_TREE_MOST; ++j) {
        table.arcs[j] =
            spt_arc_of(krs_tree_point(route->fork[j]), krs_tree_point(route->fork[j + 1]),
                       krs_tree_point(route->control[j]), (spt_real)route->half_width[j]);
    }
    for (int j = 0; j < KRS_TREE_MOST; ++j) {
        table.normals[j] = krs_tree_point(route->normal[j]);
        table.offsets[j] = (spt_real)route->offset[j];
    }
    return table;
}

/* What the two scenes share. Filled by whoever asks first, which must not be two threads at once. */
static krs_tree_table krs_tree_shared;

static inline void krs_tree_prepare(void) {
    static int ready;
    if (ready) return;
    krs_tree_route route;
    krs_tree_grow(&route);
    krs_tree_shared = krs_tree_table_of(&route);
    ready = 1;
}

/* Algorithm 1, without branches. */
SPT_SHAPE spt_real krs_tree_distance(const krs_tree_table *table, int levels, spt_point p) {
    spt_real d = spt_toroidal_capsule(p, &table->arcs[0]);
    for (int j = 0; j < levels; ++j) {
        const spt_point n = table->normals[j];
        const spt_real beyond = spt_greatest(spt_dot(p, n) - table->offsets[j], 0);
        const spt_real twice = beyond + beyond;
        p = spt_point_of(p.x - twice * n.x, p.y - twice * n.y, p.z - twice * n.z);
        d = spt_least(d, spt_toroidal_capsule(p, &table->arcs[j + 1]));
    }
    return d;
}

#define scene_krs_tree_16_prepare krs_tree_prepare
#define scene_krs_tree_28_prepare krs_tree_prepare

SPT_SHAPE spt_real scene_krs_tree_16_distance(spt_point p) {
    return krs_tree_distance(&krs_tree_shared, 16, p);
}

SPT_SHAPE spt_real scene_krs_tree_28_distance(spt_point p) {
    return krs_tree_distance(&krs_tree_shared, 28, p);
}

#endif

#ifdef SCENE
#define KRS_TREE_MEMBERS \
    .lipschitz = 1, .bound = BOX(-9.125f, -0.375f, -10.5f, 8, 13.75f, 9.625f), .eye = {12, 3, 19}, \
    .target = {-0.5, 6.6, -0.5}, .field_of_view = 55, .t_max = 60
SCENE_BUILT(krs_tree_16, .description = "a bare tree of 2^17 - 1 branches", KRS_TREE_MEMBERS)
SCENE_UNLISTED(krs_tree_28, .description = "a bare tree of 2^29 - 1 branches", KRS_TREE_MEMBERS)
#undef KRS_TREE_MEMBERS
#endif
