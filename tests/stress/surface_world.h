/* SPDX-License-Identifier: MIT
 *
 * A world in which every call of surface.h has work to do: two balls whose callbacks are audited,
 * rays, hits, points and bodies by index, and calls on plain arrays of them. */
#ifndef TESTS_SURFACE_WORLD_H
#define TESTS_SURFACE_WORLD_H

#include "surface_calls.h"

enum { surface_most = 257 };

/* A ball, and what its callbacks saw. f is scale times the distance. */
typedef struct surface_body {
    float center[3], radius, scale;
    size_t calls, points; /* of the distance; points with padding */
    size_t gradient_calls;
    size_t faults;    /* broken promises of field.h */
    size_t strangers; /* points farther off than anything in this world: of an inactive ray */
    void (*visit)(void *visitor); /* at the beginning of each callback, unless it is NULL */
    void *visitor;
} surface_body;

float surface_body_distance(const surface_body *body, float x, float y, float z);

/* How the callbacks of a call are made. */
enum {
    SURFACE_POINT = 1u << 0,   /* for one point, not a batch */
    SURFACE_GRADIENT = 1u << 1 /* with a gradient */
};

/* The second ball is behind and beside the first and has lipschitz 2. Calls that take one field are
 * given the first, which has a bound and is convex. Not to be copied: it points into itself. */
typedef struct surface_world {
    surface_body bodies[surface_most_fields];
    spt_bound bound;
    spt_field fields[surface_most_fields];
    spt_settings settings;
    spt_statistics statistics;
    uint32_t in[surface_inputs][surface_most];
    uint32_t out[surface_outputs][surface_most * surface_most_crossings];
    uint32_t hits[9][surface_most]; /* what out[OUT_T] and so on begin with */
} surface_world;

enum { surface_fill = 0xa5 };
#define SURFACE_FILL_WORD 0xa5a5a5a5u

/* Rays hit either ball or none, and some begin inside the first; the hits are those of
 * spt_trace(). */
void surface_world_make(surface_world *self);

/* A call of a door on plain arrays of the world, all columns there, with its fields, settings and
 * statistics, made anew. Outputs are filled but for hits that it reads; nothing is counted yet. */
void surface_call_make(surface_call *call, surface_world *world, surface_door door, uint32_t lanes,
                       uint32_t form);

/* Lets all callbacks begin with a visit; NULL: no longer. */
void surface_visit(surface_world *world, void (*visit)(void *visitor), void *visitor);

/* Of all bodies; calls with those for gradients. */
size_t surface_calls_seen(const surface_world *world);
size_t surface_faults_seen(const surface_world *world);

#endif
