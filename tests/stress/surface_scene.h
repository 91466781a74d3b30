/* SPDX-License-Identifier: MIT
 *
 * The scenes of the examples as work for every call of surface.h, one after the other as a renderer
 * makes them: hits, refined, their normals, secondary rays off both sides of the surface, and then
 * the queries on those. For the tests of equal bits and of pinned results. */
#ifndef TESTS_SURFACE_SCENE_H
#define TESTS_SURFACE_SCENE_H

#include "scenes/parts.h"
#include "surface_calls.h"

enum { surface_scene_most = 260 };

typedef uint32_t surface_scene_outputs[surface_outputs]
                                      [surface_scene_most * surface_most_crossings];

typedef struct surface_scene {
    const scene *shown;
    scene_parts parts;
    spt_field whole; /* what calls of one field are given */
    spt_settings settings;
    size_t count;
    uint32_t in[surface_inputs][surface_scene_most];
    surface_scene_outputs out;
    uint32_t hits[9][surface_scene_most];
} surface_scene;

/* Traces primary rays, some of them odd: of other lengths, with late starts, none at all. Not to be
 * copied: it points into itself. */
void surface_scene_make(surface_scene *self, const scene *shown, size_t count);

/* A call of a door on the columns of the scene, with the callbacks built for a width; 0: one point
 * and the widest that there is. */
void surface_scene_call(surface_call *call, surface_scene *self, surface_door door, int lanes);

/* Outputs as they are before the call of a door. */
void surface_scene_clear(const surface_scene *self, surface_door door, surface_scene_outputs out);

/* Takes what a door has answered in out over into what the next one is given. */
void surface_scene_go_on(surface_scene *self, surface_door door);

/* Whether this scene has work for a door. */
int surface_scene_has(const surface_scene *self, surface_door door);

#endif
