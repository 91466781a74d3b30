/* SPDX-License-Identifier: MIT
 *
 * Conformal maps as chains of elementary ones, which move points and regions by their textbook
 * formulas in long double: no quaternion, no matrix. The oracle of the tests of MöKRS. Left out:
 * models, see moekrs_model.h. */
#ifndef TESTS_ORACLE_MOEKRS_MAPS_H
#define TESTS_ORACLE_MOEKRS_MAPS_H

#include <spheretrace/mobius.h>

typedef long double wide;

typedef enum moekrs_step_kind {
    MOEKRS_DILATION,    /* number p */
    MOEKRS_TRANSLATION, /* p + vector */
    MOEKRS_ROTATION,    /* about the axis vector through the origin by the angle number */
    MOEKRS_REFLECTION,  /* in the plane vector . p = number, vector of unit length */
    MOEKRS_INVERSION    /* in the sphere around vector of radius number */
} moekrs_step_kind;

typedef struct moekrs_step {
    moekrs_step_kind kind;
    wide vector[3], number; /* doubles all */
} moekrs_step;

/* Applied first to last. */
enum { moekrs_steps = 6 };
typedef struct moekrs_chain {
    int count;
    moekrs_step step[moekrs_steps];
} moekrs_chain;

void moekrs_append(moekrs_chain *chain, moekrs_step_kind kind, const double vector[3],
                   double number);

/* The chain that undoes one. */
moekrs_chain moekrs_undone(const moekrs_chain *chain);

/* The image of a point; not for the centre of an inversion. image may be p. */
void moekrs_move(const moekrs_chain *chain, const wide p[3], wide image[3]);

/* Like spt_region. */
typedef struct moekrs_region {
    spt_region_kind kind;
    wide center[3], radius;
} moekrs_region;

moekrs_region moekrs_ball(const double center[3], double radius);
moekrs_region moekrs_half_space(const double normal[3], double offset);

/* The image of a region; one whose boundary passes an inversion's centre within 1e-15 of its size
 * becomes a half space. */
moekrs_region moekrs_map_region(const moekrs_chain *chain, const moekrs_region *region);

/* Below 0 inside; and the unit vector outward. */
wide moekrs_region_distance(const moekrs_region *region, const wide p[3]);
void moekrs_region_normal(const moekrs_region *region, const wide p[3], wide normal[3]);

/* The same map of the library's, made of its elementary ones; each step is checked for SPT_OK. */
spt_mobius moekrs_library_map(const moekrs_chain *chain);

wide moekrs_dot(const wide a[3], const wide b[3]);
wide moekrs_length(const wide a[3]);

#endif
