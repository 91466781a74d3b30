/* SPDX-License-Identifier: MIT
 *
 * A village of 40 houses, each turned its own way and made of two bodies of planes, on a square of
 * ground: 41 objects, hard union. All distances are maxima of planes: lower bounds without a root.
 * The objects one by one are in parts.h. */
#ifndef EXAMPLES_SCENE_VILLAGE_H
#define EXAMPLES_SCENE_VILLAGE_H

#include "scene_source.h"

enum { VILLAGE_HOUSES = 40 };

/* Pitch of all roofs: the normal of a side is (3/5, 4/5), a slope of 3 in 4. How far the roof
 * reaches over the walls. Half the sides of the ground and half its thickness. */
#define VILLAGE_ROOF_ACROSS 0.6
#define VILLAGE_ROOF_UP 0.8
#define VILLAGE_EAVES 0.12
#define VILLAGE_GROUND_HALF 12.5
#define VILLAGE_GROUND_DEPTH 0.25

typedef struct village_house {
    spt_real x, z;         /* place of its middle on the ground, which is y = 0 */
    spt_real cosine, sine; /* of its turn about the y axis */
    spt_real half_width, half_depth, half_height; /* of the walls */
    spt_real ridge;                               /* height of the roof's ridge */
} village_house;

/* A row of the table: place, tangent of half its turn, half width and depth, height of the walls.
 * The rational form of sine and cosine keeps libm out of a constant. */
#define HOUSE(x, z, tangent, half_width, half_depth, height) \
    { \
        (spt_real)(float)(x), (spt_real)(float)(z), \
            (spt_real)(float)((1 - (tangent) * (tangent)) / (1 + (tangent) * (tangent))), \
            (spt_real)(float)(2 * (tangent) / (1 + (tangent) * (tangent))), \
            (spt_real)(float)(half_width), (spt_real)(float)(half_depth), \
            (spt_real)(float)((height) / 2.0), \
            (spt_real)(float)((height) + ((half_width) + VILLAGE_EAVES) * VILLAGE_ROOF_ACROSS / \
                                             VILLAGE_ROOF_UP) \
    }
/* clang-format off */
static const village_house village_houses[VILLAGE_HOUSES] = {
    HOUSE(3.83, 0.68, -0.04, 0.68, 0.93, 0.84), HOUSE(2.1, 3.15, -0.45, 0.57, 0.95, 1.38),
    HOUSE(-0.6, 3.91, -0.65, 0.69, 0.94, 1.48), HOUSE(-3.62, 2.71, 0.37, 0.58, 0.91, 1.37),
    HOUSE(-4.22, -0.67, 0.04, 0.69, 0.82, 0.84), HOUSE(-2.55, -3.54, -0.39, 0.7, 0.96, 1.01),
    HOUSE(1.01, -4.26, 0.14, 0.68, 1.11, 1.31), HOUSE(3.78, -2.67, 0.49, 0.74, 0.85, 1.14),
    HOUSE(7.34, -0.41, -0.01, 0.77, 0.91, 1.29), HOUSE(6.4, 3.45, -0.47, 0.79, 0.97, 1.26),
    HOUSE(4.51, 5.85, 0.69, 0.76, 0.9, 1.07), HOUSE(0.68, 6.74, -0.15, 0.58, 0.82, 1.34),
    HOUSE(-2.18, 6.62, 0.28, 0.57, 0.96, 1.18), HOUSE(-5.83, 4.7, -0.43, 0.65, 0.93, 1.42),
    HOUSE(-6.77, 1.28, 0.7, 0.61, 0.97, 1.21), HOUSE(-6.6, -1.43, -0.87, 0.69, 1.13, 1.28),
    HOUSE(-5.46, -4.85, 0.23, 0.77, 1.07, 1.41), HOUSE(-2.28, -6.73, -0.29, 0.71, 0.82, 0.85),
    HOUSE(0.59, -6.87, -0.09, 0.55, 0.85, 0.87), HOUSE(3.76, -5.64, -0.49, 0.59, 0.89, 1.04),
    HOUSE(6.02, -3.29, -0.1, 0.67, 0.97, 0.86), HOUSE(10.16, -0.15, -0.83, 0.59, 0.81, 1.47),
    HOUSE(9.32, 3.58, 0.04, 0.68, 1.14, 1.4), HOUSE(7.6, 6.63, -0.58, 0.74, 0.99, 1.35),
    HOUSE(5.39, 8.48, 0.76, 0.76, 1.08, 1.37), HOUSE(1.86, 9.88, 0.76, 0.56, 0.81, 1),
    HOUSE(-0.91, 10.43, -0.95, 0.78, 1.15, 1.47), HOUSE(-4.19, 9.13, 0.12, 0.6, 1.02, 1.43),
    HOUSE(-7.5, 7.03, -0.29, 0.57, 1.03, 1.44), HOUSE(-9.57, 4.38, 0.51, 0.75, 0.92, 1.36),
    HOUSE(-10.18, 0.77, -0.82, 0.73, 0.86, 0.89), HOUSE(-10.53, -1.66, -0.03, 0.76, 1.14, 1.26),
    HOUSE(-9.02, -5.06, -0.8, 0.79, 1.03, 1.17), HOUSE(-6.27, -8.1, 0.62, 0.6, 0.89, 1.01),
    HOUSE(-4.15, -9.51, -0.23, 0.58, 1.12, 1.05), HOUSE(-0.57, -10.36, 0.9, 0.78, 0.98, 1.17),
    HOUSE(2.76, -9.47, 0.05, 0.55, 1.08, 0.92), HOUSE(6, -8.62, -0.59, 0.68, 0.99, 1.35),
    HOUSE(8.08, -6.48, 0.4, 0.74, 0.98, 1.19), HOUSE(10.29, -2.81, 0.82, 0.68, 0.98, 1.28),
};
/* clang-format on */
#undef HOUSE

/* A point as a house sees it: how far from its middle across and along the ridge, and its height.
 * Both bodies are convex, being maxima of planes and of magnitudes of planes. */
SPT_SHAPE spt_point village_seen_from(const village_house *house, spt_point p) {
    const spt_real x = p.x - house->x, z = p.z - house->z;
    return spt_point_of(spt_magnitude(house->cosine * x + house->sine * z), p.y,
                        spt_magnitude(house->cosine * z - house->sine * x));
}

SPT_SHAPE spt_real village_walls_of(const village_house *house, spt_point q) {
    return spt_intersection(spt_intersection(q.x - house->half_width, q.z - house->half_depth),
                            spt_magnitude(q.y - house->half_height) - house->half_height);
}

SPT_SHAPE spt_real village_roof_of(const village_house *house, spt_point q) {
    const spt_real over_wall = q.z - house->half_depth;
    const spt_real slope =
        real(VILLAGE_ROOF_ACROSS) * q.x + real(VILLAGE_ROOF_UP) * (q.y - house->ridge);
    return spt_intersection(spt_intersection(slope, over_wall - real(VILLAGE_EAVES)),
                            (house->half_height + house->half_height) - q.y);
}

SPT_SHAPE spt_real village_house_distance(const village_house *house, spt_point p) {
    const spt_point q = village_seen_from(house, p);
    return spt_union(village_walls_of(house, q), village_roof_of(house, q));
}

SPT_SHAPE spt_real village_walls_distance(const village_house *house, spt_point p) {
    return village_walls_of(house, village_seen_from(house, p));
}

SPT_SHAPE spt_real village_roof_distance(const village_house *house, spt_point p) {
    return village_roof_of(house, village_seen_from(house, p));
}

SPT_SHAPE spt_real village_ground(spt_point p) {
    const spt_real x = spt_magnitude(p.x) - real(VILLAGE_GROUND_HALF);
    const spt_real y = spt_magnitude(p.y + real(VILLAGE_GROUND_DEPTH)) - real(VILLAGE_GROUND_DEPTH);
    const spt_real z = spt_magnitude(p.z) - real(VILLAGE_GROUND_HALF);
    return spt_intersection(spt_intersection(x, z), y);
}

SPT_SHAPE spt_real scene_village_distance(spt_point p) {
    spt_real least = village_ground(p);
    for (int i = 0; i < VILLAGE_HOUSES; ++i) {
        least = spt_union(least, village_house_distance(&village_houses[i], p));
    }
    return least;
}

/* The same for up to SCENE_BLOCK points, the loop over the points innermost. */
SPT_SHAPE void scene_village_block(int count, const spt_real *restrict x,
                                   const spt_real *restrict y, const spt_real *restrict z,
                                   spt_real *restrict distance) {
    spt_real least[SCENE_BLOCK];
    for (int k = 0; k < count; ++k) {
        least[k] = village_ground(spt_point_of(x[k], y[k], z[k]));
    }
    for (int i = 0; i < VILLAGE_HOUSES; ++i) {
        const village_house house = village_houses[i];
        for (int k = 0; k < count; ++k) {
            const spt_point p = spt_point_of(x[k], y[k], z[k]);
            least[k] = spt_union(least[k], village_house_distance(&house, p));
        }
    }
    for (int k = 0; k < count; ++k) distance[k] = least[k];
}

#endif

#ifdef SCENE
/* The highest ridge is at 2.2. */
SCENE_BLOCKS(village, .description = "40 houses and ground, 41 objects", .lipschitz = 1,
             .bound = BOX(-12.5f, -0.5f, -12.5f, 12.5f, 2.25f, 12.5f), .eye = {6.5, 10.5, 20},
             .target = {0.4, 0, 1}, .field_of_view = 55, .t_max = 60)
#endif

#ifdef PART
PART(village, ground, .flags = SPT_FIELD_CONVEX, .extent = BOX(-12.5, -0.5, -12.5, 12.5, 0, 12.5))
PART_TABLE(village, house, village_house_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_OBJECTS, .place = village_house_extent)
PART_TABLE(village, walls, village_walls_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_PRIMITIVES, .flags = SPT_FIELD_CONVEX, .place = village_walls_extent)
PART_TABLE(village, roof, village_roof_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_PRIMITIVES, .flags = SPT_FIELD_CONVEX, .place = village_roof_extent)
#endif
