/* SPDX-License-Identifier: MIT
 *
 * Solids with many crossings, as unions of bodies and of shells, and what is true of the crossings
 * that spt_crossings_of() reports of them. */
#ifndef TESTS_ORACLE_SURFACE_SOLIDS_H
#define TESTS_ORACLE_SURFACE_SOLIDS_H

#include "surface_oracle.h"

#include <spheretrace/surface.h>

enum { solid_bodies = 8, solid_room = 16 };

/* A union of bodies, or of pairs of an outer body and one that is taken out of it. */
typedef struct surface_solid {
    surface_body bodies[solid_bodies];
    size_t count;
    int shells; /* bodies 0 and 1 make the first, and so on */
    double factor;
} surface_solid;

typedef enum solid_kind {
    SOLID_CHAIN,  /* spheres in a row, some of which overlap */
    SOLID_SHELLS, /* nested shells */
    SOLID_CUT,    /* boxes and balls taken out of each other */
    SOLID_SLABS,  /* thick and thin plates */
    SOLID_TORUS,  /* one torus: up to four crossings */
    SOLID_ROOM,   /* all but some bodies is solid */
    solid_kinds
} solid_kind;

/* Without bodies yet, of factor 1; and one about the origin, within 4 of it. */
surface_solid solid_empty(void);
void solid_draw(solid_kind kind, surface_solid *out);

/* A ray through it, from up to 8 away, or from anywhere in it. */
spt_ray solid_ray(void);

/* f over factor is 1-Lipschitz, with the sign of the solid. */
reference_field solid_field(const surface_solid *solid);

/* What was reported for one ray, and a call for it. */
typedef struct solid_crossings {
    float t[solid_room];
    uint32_t number;
    int32_t inside, outcome;
    float thickness;
} solid_crossings;
spt_status solid_call(const spt_field *field, const spt_settings *settings, const spt_ray *ray,
                      uint32_t most, solid_crossings *found);

/* The truth about a ray with finite t_max.
 *   early  where |f| last comes within the tolerance before each crossing
 *   clear  between crossings, before the first and behind the last |f| exceeds three tolerances, so
 *          that nothing about their number can be disputed */
typedef struct solid_truth {
    double t[solid_room], early[solid_room];
    int count, inside, clear;
} solid_truth;
solid_truth solid_true_crossings(const reference_field *field, const spt_settings *settings,
                                 const spt_ray *ray);

/* Checks the crossings of a clear ray: each not behind the true one but by rounding, and not before
 * where |f| last came within the tolerance; the thickness by them, without the stretch behind the
 * last where there was no room to know its end. With SPT_LIMIT they are the first ones only. */
void solid_check(const reference_field *field, const spt_ray *ray, uint32_t most,
                 const solid_truth *truth, const solid_crossings *found);

#endif
