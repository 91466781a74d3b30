/* SPDX-License-Identifier: MIT
 *
 * Chains of elementary maps as maps of points, written from their geometry in long double: the
 * ground truth of the tests of mobius.h. No quaternion and no matrix of a map takes part; moduli of
 * matrices do, in what rounding may do to the library. Spheres and planes: mobius_region.h. */
#ifndef TESTS_ORACLE_MOBIUS_CHAIN_H
#define TESTS_ORACLE_MOBIUS_CHAIN_H

#include <spheretrace/mobius.h>

typedef long double extended;

typedef enum chain_kind {
    CHAIN_TRANSLATION, /* p + vector */
    CHAIN_DILATION,    /* number p */
    CHAIN_ROTATION,    /* by the angle `number` about vector */
    CHAIN_REFLECTION,  /* in vector . p = number, vector of any length */
    CHAIN_INVERSION,   /* in the sphere of center `vector` and radius `number` */
    CHAIN_KINDS
} chain_kind;

typedef struct chain_step {
    chain_kind kind;
    double vector[3], number;
} chain_step;

enum { chain_most = 28 };

/* steps[0] is applied first. */
typedef struct chain {
    int count;
    chain_step steps[chain_most];
} chain;

/* A point of space, or infinity. */
typedef struct place {
    extended at[3];
    int infinite;
} place;

place place_of(const double point[3]);
place place_infinite(void);
extended extended_dot(const extended a[3], const extended b[3]);
extended extended_length(const extended a[3]);
extended extended_distance(const extended a[3], const extended b[3]);

/* How far rounding of long double goes: 2^-64 on most machines, 2^-53 where it is a double. */
extended extended_unit(void);

/* ---- What a chain does; back != 0: what undoes it does -------------------------------------- */

place chain_image(const chain *one, int back, place from);
/* How many times lengths grow at a finite point that is not the pole. */
extended chain_scale(const chain *one, int back, place from);
/* Turns a vector at a point as the map does; its length stays. */
void chain_vector(const chain *one, int back, place from, extended vector[3]);
/* The distance of the images of two finite points `apart` from each other, without taking a
 * difference of coordinates. */
extended chain_apart(const chain *one, int back, place from, place other, extended apart);
/* 1 or -1: keeps or reverses the orientation. */
int chain_orientation(const chain *one);

/* ---- What rounding may do ------------------------------------------------------------------- */

/* Products of the moduli of the steps' matrices: what the entries of the chain's matrix are when no
 * term cancels another. */
typedef struct moduli {
    extended a, b, c, d;
} moduli;
moduli chain_moduli(const chain *one, int back);

/* THE ERROR SCALE. Let M be the chain's matrix with |lambda| = 1 and N its moduli. Each elementary
 * matrix is off by at most 3u of its modulus (square root, sine, unit normal, |center|^2 / radius),
 * a product of two quaternions by 8u of the product of their moduli (a component has four products
 * and three sums: 4u of a sum of products of components, whose norm is at most twice that of the
 * factors), a sum of two by one more. So each step adds 12u of N at the very worst. To evaluate
 * (a p + b)(c p + d)^-1 takes two products and sums and a quotient: 20u more. Both together are at
 * most 16 (count + 1) u N: an error of e N, e = (count + 1) u, times 16.
 * A map that is off by e N in its entries gives c p + d with an error of e (N_c |p| + N_d), and as
 *     dy = ((da p + db) - y (dc p + dd)) (c p + d)^-1     and     |c p + d| = scale^-1/2
 * the image y of p is off by e times error_of_point(). All other scales follow from these two. */
int chain_close(const chain *one, extended off, extended error); /* off <= 16 e error */

/* The signs of roundings differ, so that what the steps add grows with the root of their number,
 * and N is what entries are without cancellation: as a rule 16u of the scale, without the count,
 * holds for chains of any length. More than 16u may be one in a thousand. */
typedef struct chain_tally {
    int compared, beyond;
} chain_tally;
void chain_count(chain_tally *tally, extended off, extended error);
int chain_sharp(const chain_tally *tally);

extended error_of_denominator(const moduli *n, place from); /* N_c |p| + N_d */
extended error_of_point(const moduli *n, place from, place image, extended scale);
/* Of |c p + d|, relative. */
extended error_relative(const moduli *n, place from, extended scale);
/* Of the pole Q with the modulus `c` of the matrix's own entry: e (N_c |Q| + N_d) / |c|. */
extended error_of_pole(const moduli *n, place pole, extended c);

/* Of a map with a pole: |c|, from the scale at a point that is not the pole. */
extended chain_lower(const chain *one, int back, place pole);

/* ---- Drawing and building ------------------------------------------------------------------- */

/* Chains around a body of that center and extent, which each step moves to where the next one finds
 * it: translations and spheres of inversion are of its size and near it. */
void chain_draw(chain *one, int count, const double center[3], double extent);
/* Every step of its own size, from 1e-7 to 1e7, around the origin. */
void chain_draw_wild(chain *one, int count);
chain_step chain_draw_step(chain_kind kind, const extended center[3], double extent);

/* The library's map, step by step; every status is checked. */
spt_status chain_elementary(const chain_step *step, spt_mobius *map);
spt_mobius chain_build(const chain *one);

#endif
