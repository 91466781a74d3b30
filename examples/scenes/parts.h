/* SPDX-License-Identifier: MIT
 *
 * A scene of scenes.h as a union of components, each with its bound: what spt_scene_trace() and
 * frames are tried with. Scenes that are one body are a union of one. Left out: materials. */
#ifndef EXAMPLES_PARTS_H
#define EXAMPLES_PARTS_H

#include "scenes.h"

enum { SCENE_PARTS_MOST = 128 };

typedef struct scene_parts {
    spt_scene scene; /* of the fields below */
    spt_field fields[SCENE_PARTS_MOST];
    spt_bound bounds[SCENE_PARTS_MOST];
} scene_parts;

/* How far a scene is taken apart. */
typedef enum scene_grain {
    SCENE_WHOLE,      /* one component: scene_field() itself */
    SCENE_OBJECTS,    /* primitives 22, village 41 (the ground first), village_boxes 82, slabs 13,
                       * arches 29, repeated 5, bent 3, twisted 2, others 1 */
    SCENE_PRIMITIVES, /* village: 81 convex bodies (the ground, 40 walls, 40 roofs); others as
                       * SCENE_OBJECTS */
    scene_grains
} scene_grain;

/* Fills parts, which then holds pointers into itself: do not copy it.
 *   lanes  1, 4, 8, 16 (pass spt_lanes()) for the batch callbacks that were built for that width;
 *          0 for the callbacks of one point
 * The least of the components' distances is the scene's distance with the same bits, in float and
 * in double. What has an end has a bound that fits closely, so a ray that passes a body within the
 * tolerance but outside its bound misses the component, which it hits as part of the whole. */
void scene_parts_of(const scene *shown, scene_grain grain, int lanes, scene_parts *parts);

/* Component index of the same in double precision, at n points; the same source. */
void scene_part_reference(const scene *shown, scene_grain grain, size_t index, size_t n,
                          const double *x, const double *y, const double *z, double *distance);

#endif
