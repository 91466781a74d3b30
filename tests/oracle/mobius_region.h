/* SPDX-License-Identifier: MIT
 *
 * Balls, outsides of balls and half spaces under chains of elementary maps, step by step in long
 * double: an inversion by the power of its center with respect to the sphere. */
#ifndef TESTS_ORACLE_MOBIUS_REGION_H
#define TESTS_ORACLE_MOBIUS_REGION_H

#include "mobius_chain.h"

/* As spt_region. */
typedef struct solid {
    spt_region_kind kind;
    extended center[3], radius;
} solid;

solid solid_of(const spt_region *region);

/* How far a point is from the boundary, negative inside. */
extended solid_distance(const solid *one, const extended p[3]);

solid chain_solid(const chain *one, int back, solid from);

/* The mirror image of a point in the boundary. */
place solid_mirrored(const solid *one, place p);

/* Coefficients of its boundary, negative inside, the largest 1: alpha, beta, gamma. */
void solid_coefficients(const solid *one, extended coefficient[5]);

/* What an error of e N in the entries of the map does to the image of a solid, over e.
 *   center    the image's center is the image of Q*, the mirror image of the pole Q. It is off as
 *             the image of any point is, and by scale(Q*) times what Q* is off by, which is
 *             |Q* - k| / |Q - k| times what Q is
 *   radius    relative. It is rho scale(k) / |1 - m|, m = rho^2 / |Q - k|^2; of a half space
 *             1 / (2 |c|^2 h), h the distance of Q from the plane
 *   nearness  |1 - m|, or what takes its place: below 2^-40 the boundary passes the pole */
typedef struct solid_error {
    extended center, radius, nearness;
} solid_error;
solid_error chain_solid_error(const chain *one, int back, const solid *from);

/* A solid near a center, of any kind: the boundary within a few extents of it. */
spt_region region_draw(const double center[3], double extent);

#endif
