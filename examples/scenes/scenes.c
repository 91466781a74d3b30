/* SPDX-License-Identifier: MIT
 *
 * The table of scenes and their cameras. The callbacks are in scenes_lanes.c, which is built once
 * for each instruction set. */
#include "scene_source.h"
#include "scenes.h"
#include "scenes_widths.h"

#include <math.h>
#include <string.h>

/* Constants for the member bound. */
#define BALL(x, y, z, ball_radius) \
    &(const spt_bound) { \
        .struct_size = sizeof(spt_bound), .kind = SPT_BOUND_SPHERE, .center = {x, y, z}, \
        .radius = ball_radius \
    }
#define BOX(low_x, low_y, low_z, high_x, high_y, high_z) \
    &(const spt_bound) { \
        .struct_size = sizeof(spt_bound), .kind = SPT_BOUND_BOX, .low = {low_x, low_y, low_z}, \
        .high = { \
            high_x, \
            high_y, \
            high_z \
        } \
    }

#define SCENE(scene_name, ...) \
    DECLARE_BATCHES(scene_name) \
    spt_distance_fn scene_##scene_name##_point; \
    scene_reference_fn scene_##scene_name##_reference; \
    static const scene scene_name##_entry = {.name = #scene_name, \
                                             .batch = BATCHES(scene_name), \
                                             .glsl = GLSL_##scene_name, \
                                             .point = scene_##scene_name##_point, \
                                             .reference = scene_##scene_name##_reference, \
                                             __VA_ARGS__};
#define SCENE_BUILT(scene_name, ...) \
    scene_field_fn scene_##scene_name##_field; \
    scene_reference_fn scene_##scene_name##_reference; \
    static const scene scene_name##_entry = {.name = #scene_name, \
                                             .field = scene_##scene_name##_field, \
                                             .reference = scene_##scene_name##_reference, \
                                             __VA_ARGS__};
#include "scenes_list.h"

const scene *const scenes[] = {
#define SCENE(name, ...) &name##_entry,
#define SCENE_UNLISTED(name, ...)
#include "scenes_list.h"
};
const size_t scene_count = sizeof scenes / sizeof scenes[0];

static const scene *const unlisted[] = {
#define SCENE(name, ...)
#define SCENE_UNLISTED(name, ...) &name##_entry,
#include "scenes_list.h"
};

const scene *scene_named(const char *name) {
    for (size_t i = 0; i < scene_count; ++i) {
        if (strcmp(scenes[i]->name, name) == 0) return scenes[i];
    }
    for (size_t i = 0; i < sizeof unlisted / sizeof unlisted[0]; ++i) {
        if (strcmp(unlisted[i]->name, name) == 0) return unlisted[i];
    }
    return NULL;
}

spt_field scene_field(const scene *shown, int lanes) {
    spt_field field = spt_field_default();
    if (shown->field != NULL) {
        field = shown->field(lanes);
    } else {
        field.glsl = shown->glsl;
        field.glsl_prelude = shown->glsl_prelude;
        if (lanes == 0) {
            field.point = shown->point;
        } else {
            field.batch = shown->batch[batch_index(lanes)];
        }
    }
    field.lipschitz = shown->lipschitz;
    field.flags = shown->flags;
    field.bound = shown->bound;
    return field;
}
