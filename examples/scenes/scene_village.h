/* SPDX-License-Identifier: MIT
 *
 * A village of 40 houses, each turned its own way and made of two bodies of planes, on a square of
 * ground: 41 objects, hard union. All distances are maxima of planes: lower bounds without a root.
 * The objects one by one are in parts.h. */
#ifndef EXAMPLES_SCENE_VILLAGE_H
#define EXAMPLES_SCENE_VILLAGE_H

#include "scene_source.h"
#include "scene_village.glsl.h"
#include "village_houses.h"

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

/* A row of the list is rounded to float first, as all constants. */
#define HOUSE(x, z, cosine, sine, half_width, half_depth, half_height, ridge) \
    {(spt_real)(float)(x),           (spt_real)(float)(z),          (spt_real)(float)(cosine), \
     (spt_real)(float)(sine),        (spt_real)(float)(half_width), (spt_real)(float)(half_depth), \
     (spt_real)(float)(half_height), (spt_real)(float)(ridge)},
static const village_house village_houses[VILLAGE_HOUSES] = {VILLAGE_HOUSE_LIST(HOUSE)};
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
             .target = {0.4, 0, 1}, .field_of_view = 55, .t_max = 60,
             .glsl_prelude = VILLAGE_GLSL_PRELUDE)
#endif

#ifdef PART
PART(village, ground, .flags = SPT_FIELD_CONVEX, .extent = BOX(-12.5, -0.5, -12.5, 12.5, 0, 12.5))
PART_TABLE(village, house, village_house_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_OBJECTS, .place = village_house_extent,
           .glsl_prelude = VILLAGE_GLSL_PRELUDE)
PART_TABLE(village, walls, village_walls_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_PRIMITIVES, .flags = SPT_FIELD_CONVEX, .place = village_walls_extent,
           .glsl_prelude = VILLAGE_BODIES_GLSL)
PART_TABLE(village, roof, village_roof_distance, village_house, village_houses, VILLAGE_HOUSES,
           .only = SCENE_PRIMITIVES, .flags = SPT_FIELD_CONVEX, .place = village_roof_extent,
           .glsl_prelude = VILLAGE_BODIES_GLSL)
#endif
