/* SPDX-License-Identifier: MIT
 *
 * The truth for single rays against a convex body in its bound: where the line enters and leaves,
 * what a ray must find in [t_min, t_max], and how well that is decided. */
#ifndef TESTS_ORACLE_GLASS_CHORD_H
#define TESTS_ORACLE_GLASS_CHORD_H

#include "glass_body.h"

#include <spheretrace/trace.h>

/* A ray and its truth, world lengths from the origin. */
typedef struct glass_chord {
    double origin[3], direction[3], length; /* unit direction, and what it was divided by */
    double from, to;                        /* t_min, t_max */
    int meets;                              /* the line has a chord in the body */
    double entry, middle, leave;            /* and middle the deepest point of the whole line */
    int inside;                             /* the ray begins in the body */
    spt_outcome outcome;                    /* SPT_HIT or SPT_MISS */
    double hit;                             /* entry, or leave from inside */
    double
        decided; /* by so much do the signs of f that decide this differ from zero: at the ends of
                     * the ray, and at its least */
} glass_chord;

glass_chord glass_chord_of(const glass_body *body, const spt_ray *ray);

/* f at a distance along it. */
double glass_chord_distance(const glass_body *body, const glass_chord *chord, double at);

/* tol_w of trace.h at t, and in it the floor alone. */
double glass_chord_tolerance(const spt_settings *settings, const glass_body *body,
                             const glass_chord *chord, double t);
double glass_chord_floor(const glass_body *body, const glass_chord *chord, double t);

/* A ray from in the body (place 0), from in its bound or near (1), or from outside (2), towards the
 * body or past it; direction of any length within 2^+-7, limits or none. */
spt_ray glass_chord_ray(const glass_body *body, int place);

#endif
