/* SPDX-License-Identifier: MIT
 *
 * Worlds for path tracers: a still life in a room, and any scene in the open. */
#ifndef EXAMPLES_PATH_ROOM_H
#define EXAMPLES_PATH_ROOM_H

#include "path_tracer.h"
#include "scenes/parts.h"

/* A world and all that it points at. Not to be copied. */
typedef struct path_stage {
    path_world world;
    scene_parts parts;
    spt_scene scene;
    spt_field fields[SCENE_PARTS_MOST + 4];
    int32_t numbers[SCENE_PARTS_MOST + 4];
    path_material materials[SCENE_PARTS_MOST + 4];
    spt_bound panel_bound;
    path_panel panel;
    path_sun sun;
} path_stage;

/* The scene "primitives" in a closed room with one red and one green wall, lit by a panel under the
 * ceiling. */
void path_room(path_stage *stage, int width, int height);

/* A scene of scenes.h under sun and sky, each component of a colour of its own. */
void path_open_air(path_stage *stage, const scene *shown, scene_grain grain, int width, int height);

#endif
