/* SPDX-License-Identifier: MIT
 *
 * The room around the still life, its colours and its lamp; and daylight. */
#include "path_room.h"

#include "look.h"

#include <spheretrace/shapes.h>

#include <math.h>
#include <string.h>

/* ---- The room ------------------------------------------------------------------------------ */

static const float room_side = 5.7f, room_height = 6.2f, room_back = -3.8f, room_front = 11.2f;
static const float lamp_half[2] = {1.9f, 1.3f}, lamp_z = -0.6f, lamp_depth = 0.05f;

/* Half spaces, and what is left of the room: ceiling, back and front. The floor is the still
 * life's. */
static void left_wall(void *user, size_t n, const float *restrict x, const float *restrict y,
                      const float *restrict z, float *restrict distance) {
    (void)user;
    (void)y;
    (void)z;
    for (size_t i = 0; i < n; ++i) distance[i] = room_side + x[i];
}

static void right_wall(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    (void)user;
    (void)y;
    (void)z;
    for (size_t i = 0; i < n; ++i) distance[i] = room_side - x[i];
}

static void white_walls(void *user, size_t n, const float *restrict x, const float *restrict y,
                        const float *restrict z, float *restrict distance) {
    (void)user;
    (void)x;
    for (size_t i = 0; i < n; ++i) {
        const float ends = spt_least(z[i] - room_back, room_front - z[i]);
        distance[i] = spt_least(room_height - y[i], ends);
    }
}

static void lamp(void *user, size_t n, const float *restrict x, const float *restrict y,
                 const float *restrict z, float *restrict distance) {
    (void)user;
    for (size_t i = 0; i < n; ++i) {
        const spt_point p = spt_point_of(x[i], y[i] - room_height, z[i] - lamp_z);
        distance[i] = spt_box(p, spt_point_of(lamp_half[0], lamp_depth, lamp_half[1]));
    }
}

/* Adds a component of one colour. Returns its number. */
static int32_t add(path_stage *stage, const spt_field *field, const float albedo[3]) {
    const size_t i = stage->scene.count++;
    stage->fields[i] = *field;
    stage->numbers[i] = (int32_t)i;
    memset(&stage->materials[i], 0, sizeof stage->materials[i]);
    memcpy(stage->materials[i].albedo, albedo, sizeof stage->materials[i].albedo);
    return (int32_t)i;
}

static void begin(path_stage *stage, const scene *shown, scene_grain grain) {
    memset(stage, 0, sizeof *stage);
    scene_parts_of(shown, grain, spt_lanes(), &stage->parts);
    stage->scene = spt_scene_default();
    stage->scene.fields = stage->fields;
    stage->scene.materials = stage->numbers;
    stage->world.scene = &stage->scene;
    stage->world.materials = stage->materials;
}

static void add_walls(path_stage *stage) {
    static const float red[3] = {0.62f, 0.06f, 0.05f}, green[3] = {0.12f, 0.44f, 0.10f};
    static const float white[3] = {0.76f, 0.74f, 0.70f};
    spt_field wall = spt_field_default();
    wall.batch = white_walls;
    add(stage, &wall, white);
    wall.flags = SPT_FIELD_CONVEX;
    wall.batch = left_wall;
    add(stage, &wall, red);
    wall.batch = right_wall;
    add(stage, &wall, green);
    stage->panel_bound =
        spt_bound_box(-lamp_half[0], room_height - lamp_depth, lamp_z - lamp_half[1], lamp_half[0],
                      room_height + lamp_depth, lamp_z + lamp_half[1]);
    wall.batch = lamp;
    wall.bound = &stage->panel_bound;
    stage->panel.component = add(stage, &wall, white);
}

static void light_panel(path_panel *panel) {
    const float corner[3] = {-lamp_half[0], room_height - lamp_depth, lamp_z - lamp_half[1]};
    const float along[3] = {2.0f * lamp_half[0], 0.0f, 0.0f};
    const float across[3] = {0.0f, 0.0f, 2.0f * lamp_half[1]};
    const float radiance[3] = {11.0f, 9.6f, 7.6f};
    memcpy(panel->corner, corner, sizeof corner);
    memcpy(panel->along, along, sizeof along);
    memcpy(panel->across, across, sizeof across);
    memcpy(panel->radiance, radiance, sizeof radiance);
}

void path_room(path_stage *stage, int width, int height) {
    static const float colours[][3] =
        {
            {0.72f, 0.70f, 0.66f},                        /* plinth, */
            {0.66f, 0.62f, 0.54f},                        /* its step, */
            {0.76f, 0.50f, 0.14f},                        /* the collar */
            {0.80f, 0.78f, 0.74f},                        /* and the globe */
            {0.70f, 0.66f, 0.60f},                        /* the columns */
            {0.70f, 0.66f, 0.60f}, {0.48f, 0.30f, 0.18f}, /* and the beam */
            {0.20f, 0.34f, 0.66f}, {0.78f, 0.56f, 0.16f}, {0.74f, 0.72f, 0.70f},
            {0.62f, 0.18f, 0.14f}, {0.20f, 0.46f, 0.52f}, {0.50f, 0.32f, 0.18f},
            {0.74f, 0.70f, 0.62f}, /* what lies before it, the die last */
        };
    static const float others[3] = {0.68f, 0.66f, 0.62f};
    static const float eye[3] = {0.35f, 3.1f, 10.9f}, target[3] = {0.05f, 2.45f, 0.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    begin(stage, scene_named("primitives"), SCENE_OBJECTS);
    for (size_t i = 0; i < stage->parts.scene.count; ++i) {
        const size_t known = sizeof colours / sizeof colours[0];
        add(stage, &stage->parts.fields[i], i < known ? colours[i] : others);
    }
    add_walls(stage);
    light_panel(&stage->panel);
    stage->world.panel = &stage->panel;
    (void)spt_camera_pinhole(&stage->world.camera, eye, target, up, 0.58f, (uint32_t)width,
                             (uint32_t)height);
    stage->world.camera.t_max = 40.0f;
}

/* ---- In the open --------------------------------------------------------------------------- */

static void day(void *user, const float direction[3], float radiance[3]) {
    (void)user;
    look_sky(direction, radiance);
}

/* Somewhere in the component, for its colour. */
static void middle_of(const spt_field *field, float middle[3]) {
    float low[3], high[3];
    memset(middle, 0, 3 * sizeof *middle);
    if (field->bound == NULL || spt_bound_extent(field->bound, low, high) != SPT_OK) return;
    for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5f * (low[axis] + high[axis]);
}

void path_open_air(path_stage *stage, const scene *shown, scene_grain grain, int width,
                   int height) {
    static const float towards_the_sun[3] = {-0.7011f, 0.6210f, 0.3506f};
    static const float irradiance[3] = {3.6f, 3.2f, 2.6f};
    begin(stage, shown, grain);
    for (size_t i = 0; i < stage->parts.scene.count; ++i) {
        float middle[3], albedo[3];
        middle_of(&stage->parts.fields[i], middle);
        look_albedo(look_of(shown->name), middle, albedo);
        add(stage, &stage->parts.fields[i], albedo);
    }
    memcpy(stage->sun.direction, towards_the_sun, sizeof towards_the_sun);
    memcpy(stage->sun.irradiance, irradiance, sizeof irradiance);
    stage->sun.sine = 0.02f;
    stage->world.sun = &stage->sun;
    stage->world.sky = day;
    stage->world.camera = scene_camera(shown, (uint32_t)width, (uint32_t)height);
}
