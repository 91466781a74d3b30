/* SPDX-License-Identifier: MIT
 *
 * The 73 planes of a round brilliant cut, for the scene `jewel` (scene_jewel.h) and for programs
 * that want the stone as a polytope. Left out: what it is made of. */
#ifndef EXAMPLES_JEWEL_PLANES_H
#define EXAMPLES_JEWEL_PLANES_H

#include <spheretrace/bound.h>

#include <math.h>

/* The stone in its own axes: axis upright, table on top, the girdle a polygon of 16 sides with its
 * corners at radius 1, the heights -0.02 and 0.02. Facets come in rings of 8 or 16, equal but for
 * their turn about the axis, so a plane's normal is (across cos turn, up, across sin turn).
 * Proportions of a fine cut: table 56 %, crown 34.5 degrees, pavilion 40.75 degrees, stars half way
 * from table to girdle, lower halves 78 % of the way to the point. From these follow the numbers:
 * stars, bezels and mains hold a corner or an edge of the table, girdle or point each; halves hold
 * a side of the girdle and the tip of a star, or where two mains and two halves meet. */
#define JEWEL_TABLE 0.322403622 /* its height */
#define JEWEL_STAR_ACROSS 0.372505190
#define JEWEL_STAR_UP 0.928030109
#define JEWEL_STAR_OFFSET 0.491924224
#define JEWEL_BEZEL_ACROSS 0.566406237
#define JEWEL_BEZEL_UP 0.824126189
#define JEWEL_BEZEL_OFFSET 0.582888761
#define JEWEL_UPPER_ACROSS 0.655698703
#define JEWEL_UPPER_UP 0.755022656
#define JEWEL_UPPER_OFFSET 0.658200089
#define JEWEL_GIRDLE 0.980785280 /* its sides' distance from the axis */
#define JEWEL_LOWER_ACROSS 0.667894121
#define JEWEL_LOWER_UP -0.744256302
#define JEWEL_LOWER_OFFSET 0.669945849
#define JEWEL_MAIN_ACROSS 0.652759752
#define JEWEL_MAIN_UP -0.757564984
#define JEWEL_MAIN_OFFSET 0.667911052

/* In the scene it lies on one of its mains, so that the table leans towards z: its own axes are
 *     first = MAIN_UP' z - MAIN_ACROSS y,  up = MAIN_ACROSS z + MAIN_UP' y,  second = x
 * with MAIN_UP' = -MAIN_UP. What it lies on is the plane y = -MAIN_OFFSET. */
#define JEWEL_LEAN_SINE JEWEL_MAIN_ACROSS
#define JEWEL_LEAN_COSINE 0.757564984
#define JEWEL_LOWEST (-JEWEL_MAIN_OFFSET)

/* All of it is within this of the origin: its girdle's corners are at sqrt(1 + 0.02^2). */
#define JEWEL_RADIUS 1.001f

enum { JEWEL_PLANES = 73 };

typedef struct jewel_ring {
    int facets;
    double turn; /* of the first, in parts of a whole turn */
    double across, up, offset;
} jewel_ring;

/* Fills an array of JEWEL_PLANES planes, as the stone lies in the scene. */
static inline void jewel_planes(spt_bound_plane *planes) {
    static const jewel_ring rings[] = {
        {1, 0, 0, 1, JEWEL_TABLE},
        {8, 1 / 16.0, JEWEL_STAR_ACROSS, JEWEL_STAR_UP, JEWEL_STAR_OFFSET},
        {8, 0, JEWEL_BEZEL_ACROSS, JEWEL_BEZEL_UP, JEWEL_BEZEL_OFFSET},
        {16, 1 / 32.0, JEWEL_UPPER_ACROSS, JEWEL_UPPER_UP, JEWEL_UPPER_OFFSET},
        {16, 1 / 32.0, 1, 0, JEWEL_GIRDLE},
        {16, 1 / 32.0, JEWEL_LOWER_ACROSS, JEWEL_LOWER_UP, JEWEL_LOWER_OFFSET},
        {8, 0, JEWEL_MAIN_ACROSS, JEWEL_MAIN_UP, JEWEL_MAIN_OFFSET}};
    for (const jewel_ring *ring = rings; ring < rings + sizeof rings / sizeof rings[0]; ++ring) {
        for (int facet = 0; facet < ring->facets; ++facet, ++planes) {
            const double turn = ring->turn + (double)facet / ring->facets;
            const double angle = 6.283185307179586 * turn;
            const double first = ring->across * cos(angle), second = ring->across * sin(angle);
            const double up = ring->up;
            planes->normal[0] = (float)second;
            planes->normal[1] = (float)(JEWEL_LEAN_COSINE * up - JEWEL_LEAN_SINE * first);
            planes->normal[2] = (float)(JEWEL_LEAN_SINE * up + JEWEL_LEAN_COSINE * first);
            planes->offset = (float)ring->offset;
        }
    }
}

#endif
