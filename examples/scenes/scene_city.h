/* SPDX-License-Identifier: MIT
 *
 * A city without end: a tower in every cell of a grid, its size drawn from a hash of the cell, on
 * flat ground. Only the tower of the point's own cell is asked, so that the cost does not grow with
 * the number of towers; that makes a bound of the distance, not the distance. */
#ifndef EXAMPLES_SCENE_CITY_H
#define EXAMPLES_SCENE_CITY_H

#include "scene_city.glsl.h"
#include "scene_source.h"

/* The side of a cell, a power of two so that seeing a point from its cell's middle is exact; how
 * far a tower stays off the border of its cell, at least; and the height that none exceeds. */
#define CITY_CELL 4
#define CITY_KERB 0.625
#define CITY_SKYLINE 8

/* All lengths are small multiples of powers of two: the same in float and double. */
typedef struct city_tower {
    spt_real half_width, half_depth; /* of its foot */
    spt_real shoulder, height;       /* where it narrows, where it ends */
} city_tower;

SPT_SHAPE uint32_t city_hash(int32_t column, int32_t row) {
    uint32_t hash = (uint32_t)column * 0x9e3779b1u + (uint32_t)row * 0x85ebca77u;
    hash ^= hash >> 15;
    hash *= 0x2c1b3c6du;
    hash ^= hash >> 13;
    hash *= 0x297a2d39u;
    return hash ^ hash >> 16;
}

/* count bits of a hash as a number in [0, 1). */
SPT_SHAPE spt_real city_share(uint32_t hash, int first, int count) {
    const uint32_t bits = hash >> first & ((1u << count) - 1);
    return (spt_real)(int32_t)bits / (spt_real)(1 << count);
}

/* Many low ones, few high ones: 0.625 + 2 r + 7 r^4, r at most 15/16, so 7.91. */
SPT_SHAPE city_tower city_tower_of(uint32_t hash) {
    const spt_real widest = CITY_CELL / 2 - real(CITY_KERB);
    const spt_real r = city_share(hash, 0, 4), squared = r * r;
    city_tower tower;
    tower.height = real(0.625) + 2 * r + 7 * (squared * squared);
    tower.shoulder = tower.height * (real(0.5) + real(0.5) * city_share(hash, 4, 3));
    tower.half_width = widest - real(0.5) * city_share(hash, 8, 4);
    tower.half_depth = widest - real(0.5) * city_share(hash, 12, 4);
    return tower;
}

/* A tower on its shoulders, seen from the middle of its foot, across and along by magnitude. The
 * square of the least distance from outside and the least depth, as in scene_boxes.h; the ground
 * closes the two boxes from below. */
SPT_SHAPE spt_real city_tower_distance(const city_tower *tower, spt_point q) {
    const spt_real recess = real(0.25);
    const spt_real x = q.x - tower->half_width, z = q.z - tower->half_depth;
    const spt_real y = q.y - tower->shoulder, top = q.y - tower->height;
    const spt_real foot = spt_greatest(x, z), shaft = foot + recess;
    const spt_real zero = spti_shape_zero(q.y);
    const spt_real foot_x = spt_greatest(x, zero), shaft_x = spt_greatest(x + recess, zero);
    const spt_real foot_z = spt_greatest(z, zero), shaft_z = spt_greatest(z + recess, zero);
    const spt_real foot_y = spt_greatest(y, zero), shaft_y = spt_greatest(top, zero);
    const spt_real foot_squared = foot_x * foot_x + foot_y * foot_y + foot_z * foot_z;
    const spt_real shaft_squared = shaft_x * shaft_x + shaft_y * shaft_y + shaft_z * shaft_z;
    const spt_real depth = spt_least(spt_greatest(foot, y), spt_greatest(shaft, top));
    return spt_root(spt_least(foot_squared, shaft_squared)) + spt_least(depth, zero);
}

/* A LOWER BOUND WITH LIPSCHITZ CONSTANT 1. A ray to another tower must cross the border of the cell
 * and the other cell's kerb, so `street` is a bound of the distance to all others, and the least of
 * it and the own tower's distance is one of all towers. Within a cell both change by at most the
 * way that the point goes. From cell to cell there is no jump: on the border the street is the
 * kerb, and no tower, whichever it is, is nearer than that. No tower is nearer than the skyline
 * either, so the greater of both bounds is one. (Beyond the last of the 2^22 cells to each side
 * there is no border to cross, and |border| is less than the way back to any tower but one.) */
SPT_SHAPE spt_real scene_city_distance(spt_point p) {
    const spt_real cell = CITY_CELL, half = CITY_CELL / 2;
    const int32_t column = spt_nearest(spt_limit(p.x / cell, 4194304));
    const int32_t row = spt_nearest(spt_limit(p.z / cell, 4194304));
    const spt_real x = spt_magnitude(p.x - cell * (spt_real)column);
    const spt_real z = spt_magnitude(p.z - cell * (spt_real)row);
    const city_tower tower = city_tower_of(city_hash(column, row));
    const spt_real border = spt_least(spt_magnitude(half - x), spt_magnitude(half - z));
    const spt_real street = border + real(CITY_KERB);
    const spt_real own = city_tower_distance(&tower, spt_point_of(x, p.y, z));
    const spt_real towers = spt_greatest(spt_union(own, street), p.y - CITY_SKYLINE);
    return spt_union(towers, p.y);
}

#endif

#ifdef SCENE
SCENE(city, .description = "a city without end, a tower in every cell", .lipschitz = 1,
      .eye = {2.2, 6.4, 22}, .target = {1.4, 3.6, 4}, .field_of_view = 60, .t_max = 300,
      .glsl_prelude = CITY_GLSL_PRELUDE)
#endif
