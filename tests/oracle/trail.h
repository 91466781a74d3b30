/* SPDX-License-Identifier: MIT
 *
 * Small fields that remember where they were asked, so that a test can see the steps of the library
 * and of the listings alike. Rays run along z from the origin, where places are numbers. */
#ifndef TESTS_ORACLE_TRAIL_H
#define TESTS_ORACLE_TRAIL_H

#include "harness.h"
#include "listings.h"

enum { most_places = 256 };

typedef struct trail {
    spt_distance_fn *distance;
    float a, b; /* parameters of the field */
    int count;  /* places asked since the trail began, without repetitions of the last */
    float z[most_places];
} trail;

/* The fields; user is the trail. */
float trail_ball(void *user, float x, float y, float z);   /* of radius b around (0, 0, a) */
float trail_wall(void *user, float x, float y, float z);   /* z = a, met at an angle of cosine b */
float trail_slab(void *user, float x, float y, float z);   /* from z = a to z = b */
float trail_sheet(void *user, float x, float y, float z);  /* z = a, without an inside */
float trail_grazed(void *user, float x, float y, float z); /* a everywhere */
float trail_above(void *user, float x, float y, float z); /* z = -1 behind, and the ball if b > 0 */
float trail_passed(void *user, float x, float y, float z); /* a ball beside the ray, wall z = a */
float trail_steep(void *user, float x, float y, float z);  /* the slab, inside 5 times too deep */

/* A trail without places. */
trail trail_of(spt_distance_fn *distance, float a, float b);

/* A listing on that field, from the origin along z. */
listing trail_listing(trail *t);

spt_ray trail_ray(float t_min, float t_max);

/* The library on that field; the trail begins anew. */
spt_hit trail_trace(trail *t, const spt_settings *settings, const spt_ray *ray);

/* The callback behind both: asks t->distance and notes the place. */
float trail_listen(void *user, float x, float y, float z);

#endif
