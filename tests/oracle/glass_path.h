/* SPDX-License-Identifier: MIT
 *
 * Paths of light through a convex body of glass by exact crossings and Snell's law in double, with
 * a bound, event by event, of how far the path of a tracer may be off that stops and starts within
 * given tolerances. Left out: splitting; a path refracts where it can, else it is reflected. */
#ifndef TESTS_ORACLE_GLASS_PATH_H
#define TESTS_ORACLE_GLASS_PATH_H

#include "glass_body.h"

enum { glass_events = 9 }; /* an entry and eight more */

typedef enum glass_event_kind {
    GLASS_ENTRY = 'E',
    GLASS_TOTAL = 'T', /* total internal reflection */
    GLASS_EXIT = 'X',
    GLASS_MIRROR = 'M' /* the same from outside, of a body that is thinner than its surroundings */
} glass_event_kind;

typedef struct glass_event {
    glass_event_kind kind;
    int face;
    double point[3], direction[3]; /* where, and the unit direction of what goes on */
    double length;                 /* of the segment before it */
    double off, turned;            /* the tracer's hit is no farther from point than this, and the
                                    * angle between its direction and this one no larger */
    int certain;                   /* kind and face are the same for both, by these bounds; never
                                    * again after an event that is not */
} glass_event;

/* Ends behind an exit, a mirror, or glass_events. */
typedef struct glass_path {
    int count;
    glass_event event[glass_events];
} glass_path;

/* What the tracer does.
 *   epsilon, pixel_radius, size  as in spt_settings
 *   normal_error  the greatest angle that its normals are off on a smooth surface
 *   normal_reach  how far from a hit its normals look */
typedef struct glass_tracer {
    double epsilon, pixel_radius, size, normal_error, normal_reach;
} glass_tracer;

/* tol_w of trace.h at a distance along a ray from origin that has path behind it. */
double glass_tolerance(const glass_tracer *tracer, const double origin[3], double path,
                       double length);

/* Snell's law: bends the unit direction at a surface whose unit normal points to the side it comes
 * from; ratio: the index of refraction there over that behind. Returns 1, or 0 for a total
 * reflection. */
int glass_bend(const double direction[3], const double normal[3], double ratio, double bent[3]);

/* The path of a ray from outside the body; index: of the body over that of its surroundings.
 * Returns 0 where the ray does not meet it. */
int glass_follow(const glass_body *body, double index, const glass_tracer *tracer,
                 const double origin[3], const double direction[3], glass_path *path);

#endif
