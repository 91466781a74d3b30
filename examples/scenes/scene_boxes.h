/* SPDX-License-Identifier: MIT
 *
 * Many boxes with exact distances: a town of 81 towers on its ground, and 13 thin slabs, between
 * which a ray goes far by small steps. */
#ifndef EXAMPLES_SCENE_BOXES_H
#define EXAMPLES_SCENE_BOXES_H

#include "scene_boxes.glsl.h"
#include "scene_source.h"

typedef struct placed_box {
    spt_point center, half;
} placed_box;

/* Towers 1 apart, half their widths a multiple of 1/64 and half their heights of 1/32, so that they
 * are the same in float and double. The remainders make a pattern without a visible period. */
#define TOWER_WIDTH(i, k) ((spt_real)0.25f + (spt_real)(((i)*7 + (k)*5) % 9) / 64)
#define TOWER_HEIGHT(i, k) \
    ((spt_real)0.25f + (spt_real)(((i)*37 + (k)*61 + (i) * (k)*13) % 23) / 32)
#define TOWER(i, k) \
    { \
        {(i)-4, TOWER_HEIGHT(i, k), (k)-4}, { \
            TOWER_WIDTH(i, k), TOWER_HEIGHT(i, k), TOWER_WIDTH(k, i) \
        } \
    }
#define TOWER_ROW(k) \
    TOWER(0, k), TOWER(1, k), TOWER(2, k), TOWER(3, k), TOWER(4, k), TOWER(5, k), TOWER(6, k), \
        TOWER(7, k), TOWER(8, k)

enum { TOWN_BOXES = 82 };
static const placed_box town_boxes[TOWN_BOXES] = {
    {{0, (spt_real)-0.25f, 0}, {5, (spt_real)0.25f, 5}}, /* the ground */
    TOWER_ROW(0),
    TOWER_ROW(1),
    TOWER_ROW(2),
    TOWER_ROW(3),
    TOWER_ROW(4),
    TOWER_ROW(5),
    TOWER_ROW(6),
    TOWER_ROW(7),
    TOWER_ROW(8)};

#define SLAB(i) \
    { \
        {0, ((i)-6) * (spt_real)0.1875f, 0}, { \
            1, (spt_real)0.0078125f, (spt_real)0.75f \
        } \
    }

enum { SLABS = 13 };
static const placed_box slab_boxes[SLABS] = {SLAB(0),  SLAB(1),  SLAB(2), SLAB(3), SLAB(4),
                                             SLAB(5),  SLAB(6),  SLAB(7), SLAB(8), SLAB(9),
                                             SLAB(10), SLAB(11), SLAB(12)};

#undef TOWER_WIDTH
#undef TOWER_HEIGHT
#undef TOWER
#undef TOWER_ROW
#undef SLAB

/* Of several boxes: the square of the least distance from outside and the least depth inside (at
 * most 0). A root is monotone, so that one root at the end does for all boxes. */
typedef struct boxes_least {
    spt_real squared, depth;
} boxes_least;

SPT_SHAPE boxes_least boxes_add(boxes_least least, const placed_box *box, spt_point p) {
    const spt_real x = spt_magnitude(p.x - box->center.x) - box->half.x;
    const spt_real y = spt_magnitude(p.y - box->center.y) - box->half.y;
    const spt_real z = spt_magnitude(p.z - box->center.z) - box->half.z;
    const spt_real squared =
        x * spt_greatest(x, 0) + y * spt_greatest(y, 0) + z * spt_greatest(z, 0);
    least.squared = spt_least(least.squared, squared);
    least.depth = spt_least(least.depth, spt_greatest(x, spt_greatest(y, z)));
    return least;
}

SPT_SHAPE spt_real boxes_distance(const placed_box *boxes, int number, spt_point p) {
    boxes_least least = {SPT_REAL_MAX, 0};
    for (int i = 0; i < number; ++i) least = boxes_add(least, &boxes[i], p);
    return spt_root(least.squared) + least.depth;
}

SPT_SHAPE spt_real placed_box_distance(const placed_box *box, spt_point p) {
    return boxes_distance(box, 1, p);
}

/* The same for up to SCENE_BLOCK points, the loop over the points innermost. */
SPT_SHAPE void boxes_block(const placed_box *boxes, int number, int count,
                           const spt_real *restrict x, const spt_real *restrict y,
                           const spt_real *restrict z, spt_real *restrict distance) {
    spt_real squared[SCENE_BLOCK], depth[SCENE_BLOCK];
    for (int k = 0; k < count; ++k) {
        squared[k] = SPT_REAL_MAX;
        depth[k] = 0;
    }
    for (int i = 0; i < number; ++i) {
        const placed_box box = boxes[i];
        for (int k = 0; k < count; ++k) {
            const boxes_least before = {squared[k], depth[k]};
            const boxes_least after = boxes_add(before, &box, spt_point_of(x[k], y[k], z[k]));
            squared[k] = after.squared;
            depth[k] = after.depth;
        }
    }
    for (int k = 0; k < count; ++k) distance[k] = spt_root(squared[k]) + depth[k];
}

SPT_SHAPE spt_real scene_village_boxes_distance(spt_point p) {
    return boxes_distance(town_boxes, TOWN_BOXES, p);
}

SPT_SHAPE void scene_village_boxes_block(int count, const spt_real *restrict x,
                                         const spt_real *restrict y, const spt_real *restrict z,
                                         spt_real *restrict distance) {
    boxes_block(town_boxes, TOWN_BOXES, count, x, y, z, distance);
}

SPT_SHAPE spt_real scene_slabs_distance(spt_point p) {
    return boxes_distance(slab_boxes, SLABS, p);
}

SPT_SHAPE void scene_slabs_block(int count, const spt_real *restrict x, const spt_real *restrict y,
                                 const spt_real *restrict z, spt_real *restrict distance) {
    boxes_block(slab_boxes, SLABS, count, x, y, z, distance);
}

#endif

#ifdef SCENE
SCENE_BLOCKS(village_boxes, .description = "81 towers and ground, 82 boxes", .lipschitz = 1,
             .eye = {4.2, 5.2, 8.6}, .target = {0, 0.2, 0.4}, .field_of_view = 50, .t_max = 20,
             .glsl_prelude = TOWN_GLSL_PRELUDE)
SCENE_BLOCKS(slabs, .description = "13 thin slabs, seen into", .lipschitz = 1,
             .eye = {2.1, 0.6, 3.6}, .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20,
             .glsl_prelude = SLABS_GLSL_PRELUDE)
#endif

#ifdef PART
PART_TABLE(village_boxes, box, placed_box_distance, placed_box, town_boxes, TOWN_BOXES,
           .flags = SPT_FIELD_CONVEX, .place = placed_box_extent, .glsl_prelude = TOWN_GLSL_PRELUDE)
PART_TABLE(slabs, slab, placed_box_distance, placed_box, slab_boxes, SLABS,
           .flags = SPT_FIELD_CONVEX, .place = placed_box_extent,
           .glsl_prelude = SLABS_GLSL_PRELUDE)
#endif
