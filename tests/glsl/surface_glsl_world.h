/* SPDX-License-Identifier: MIT
 *
 * Fields for the tests of the surface room's GLSL, each as a callback and as a text of the same
 * operations; rays at them; and what the library makes of these rays. */
#ifndef TESTS_SURFACE_GLSL_WORLD_H
#define TESTS_SURFACE_GLSL_WORLD_H

#include <spheretrace/spheretrace.h>

enum {
    SURFACE_WORLDS = 8,  /* for all tests, */
    SURFACE_SPECIAL = 2, /* and for some */
    SURFACE_VARIANTS = 4,
    SURFACE_RAYS = 2048,
    SURFACE_RESULTS = 8 /* floats a ray */
};

/* Lipschitz constants are powers of two: the C code divides by them, the GLSL multiplies by the
 * inverse. */
typedef struct surface_world {
    const char *name;
    const spt_field *fields;
    size_t count; /* more than 1: a scene */
} surface_world;

const surface_world *surface_world_of(int index);

const surface_world *surface_world_named(const char *name);

/* Rays and hits, and the features that the structures of a shader have. */
typedef struct surface_case {
    const surface_world *world;
    spt_settings settings;
    uint32_t features; /* SPT_GLSL_PATH, SPT_GLSL_FLAGS ... */
    spt_ray rays[SURFACE_RAYS];
    float path[SURFACE_RAYS];
    spt_hit hits[SURFACE_RAYS];
    float normals[SURFACE_RAYS][3];
    int32_t cross[SURFACE_RAYS];
} surface_case;

/* Settings and features of a round: with and without pixel cone, path and flags, and with an epsilon
 * below the rounding floor. Says so with failing checks. */
void surface_set_variant(surface_case *all, const surface_world *world, int variant);

/* Random rays at the world, a share of them from inside; path is 0 without SPT_GLSL_PATH. */
void surface_draw(surface_case *all, double inside);

/* Views of them; hits.flags is absent without SPT_GLSL_FLAGS. */
spt_rays surface_rays(const surface_case *all);
spt_hits surface_hits(surface_case *all);

/* Fills in hits and normals by the library. */
void surface_trace(surface_case *all);

/* Runs statements for every ray, with the functions that these features bring: `ray`, `hit` and
 * `normal` are there, q[4].w is cross, and r[0], r[1] are for results. Returns whether that went
 * well; else a check has failed. */
int surface_ask(const surface_case *all, uint32_t features, const char *statements,
                float results[SURFACE_RAYS][SURFACE_RESULTS]);

/* The same bits; an infinity of C is 3.0e38, and any NaN is one. */
int surface_agrees(float glsl, float c);

#endif
