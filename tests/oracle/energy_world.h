/* SPDX-License-Identifier: MIT
 *
 * Worlds of balls, boxes and half spaces whose light is known: as fields for the path tracer of the
 * examples, and with exact intersections in double for a second one, written to be read. */
#ifndef TESTS_ORACLE_ENERGY_WORLD_H
#define TESTS_ORACLE_ENERGY_WORLD_H

#include <path_tracer.h>

typedef enum energy_kind {
    ENERGY_BALL,
    ENERGY_HOLLOW, /* all but a ball */
    ENERGY_BOX,
    ENERGY_WALL, /* normal . p < offset is solid; the normal is an axis */
    ENERGY_RING  /* a torus around y; the exact intersections do not know it */
} energy_kind;

typedef struct energy_body {
    energy_kind kind;
    float center[3], radius, tube; /* ball, hollow, ring; center of a box, too */
    float half[3];                 /* box */
    float normal[3], offset;       /* wall */
    path_material material;
} energy_body;

enum { energy_bodies = 12 };

/* Not to be copied: the world points into it. */
typedef struct energy_world {
    int count;
    energy_body bodies[energy_bodies];
    path_panel panel;
    path_sun sun;
    path_world world; /* of the bodies as a union, or as one field */
    spt_scene scene;
    spt_field fields[energy_bodies];
    int32_t numbers[energy_bodies];
    path_material materials[energy_bodies];
} energy_world;

/* The signed distance to a body, in double. */
double energy_distance(const energy_body *body, const double p[3]);

/* Fills world.scene and what belongs to it. whole: all bodies as one field, of the first one's
 * material. */
void energy_build(energy_world *self, int whole);

/* Gives the fields of a union their exact gradients: without, normals are blended in a band of some
 * thousandths along edges, where the exact intersections have none. */
void energy_add_gradients(energy_world *self);

/* A camera whose picture is width x height. */
void energy_look(energy_world *self, const float eye[3], const float target[3], int width,
                 int height);

/* The light of each pixel of an area (left, top, right, bottom; at most a tile) of a picture, by the
 * path tracer of the examples: sums over samples first .. first + count - 1. statistics may be
 * NULL. */
void energy_render(const energy_world *self, const path_settings *settings, int width, int height,
                   const uint32_t area[4], uint32_t first, uint32_t count, double (*light)[3],
                   path_statistics *statistics);

/* The light of a pixel by the second path tracer, sum of samples first .. first + count - 1. It
 * draws the same random numbers as the first. next_event 0: paths do not look for panel and sun;
 * they take up the panel's light where they meet it, and sun must be absent. No roulette. */
void energy_reference(const energy_world *self, const path_settings *settings, int next_event,
                      uint32_t x, uint32_t y, uint32_t width, uint32_t height, uint32_t first,
                      uint32_t count, double light[3]);

#endif
