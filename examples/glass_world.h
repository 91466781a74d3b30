/* SPDX-License-Identifier: MIT
 *
 * Worlds of glass, for renderers: a body that is a distance field (scenes.h), and around it what is
 * met analytically: balls and a chequered ground under sun and sky. Left out: the rays, which are
 * the renderers'. */
#ifndef EXAMPLES_GLASS_WORLD_H
#define EXAMPLES_GLASS_WORLD_H

#include "scenes/scenes.h"

typedef enum glass_surface {
    GLASS_MATT,   /* colour is the albedo */
    GLASS_MIRROR, /* colour is what it reflects */
    GLASS_CLEAR   /* refracts by the index, takes away exp(-absorption * length) */
} glass_surface;

typedef struct glass_material {
    glass_surface surface;
    float colour[3];
    float index;
    float absorption[3];
} glass_material;

typedef struct glass_ball {
    float center[3], radius;
    glass_material material;
} glass_ball;

/* A light so far away that only its direction matters. Nothing lies in its shadow; seen, mirrored
 * and refracted it is a spot of light * exp(sharpness (cos - 1)). */
typedef struct glass_lamp {
    float direction[3]; /* unit length, towards it */
    float light[3], sharpness;
} glass_lamp;

/* What a ray met, begins on, or is in: a ball by its number, or one of these. */
enum { GLASS_NOTHING = -1, GLASS_GROUND = -2, GLASS_BODY = -3 };

enum { GLASS_FACETS_MOST = 80 };

typedef struct glass_world {
    const char *name;             /* also of the scene */
    const scene *body;            /* the distance field, and the camera */
    glass_material body_material; /* GLASS_CLEAR */
    const glass_ball *balls;
    int ball_count;
    int has_ground;
    float ground; /* its height; all below is solid */
    float square; /* side of its squares */
    float haze;   /* where it has melted into the sky, world length */
    float sky;    /* how bright: 1 by day */
    const glass_lamp *lamps;
    int lamp_count;
    spt_bound_plane facets[GLASS_FACETS_MOST]; /* all of the body's planes; none: it is round */
    size_t facet_count;
    int furnace; /* light of 1 comes from everywhere, nothing takes any away: every pixel is 1 */
} glass_world;

/* Fills in the world of a name ("glass", "jewel"); 0 if there is none. */
int glass_world_named(const char *name, glass_world *world);

/* The field of the body, for a width as scene_field() takes it. The normals of a body with facets
 * are theirs; differences would round its edges, which shows where they turn up in refractions. The
 * field points into the world. */
spt_field glass_world_field(glass_world *world, int lanes);

/* The same world without ground, matt surfaces and absorption, in light of 1 from everywhere. balls is
 * room for all. */
glass_world glass_furnace(const glass_world *world, glass_ball *balls);

/* Where a ray (unit direction) meets a ball or the ground, in world length, or infinity.
 *   from    what it begins on: a ball is not met again from outside, nor the ground
 *   inside  the ball that it is in, of which the way out is found; else GLASS_NOTHING
 *   object  receives what is met. A ray that begins below the ground meets it at 0 */
float glass_meet(const glass_world *world, const float origin[3], const float direction[3],
                 int from, int inside, int *object);

/* The outward normal of a ball or the ground. */
void glass_world_normal(const glass_world *world, int object, const float point[3],
                        float normal[3]);

/* The light that a ray of this unit direction sees if it meets nothing more: of the sky with the
 * sun's glow, or of the ground on average. */
void glass_environment(const glass_world *world, const float direction[3], float light[3]);

/* A matt point: what part of sunlight it returns, per channel, and its light without the sun's.
 *   footprint  width of a pixel there, world length
 *   way        world length from the eye, for the haze */
typedef struct glass_point {
    int object;
    float position[3], normal[3], footprint, way;
    float view[3]; /* unit direction of the ray that came */
} glass_point;

void glass_shade(const glass_world *world, const glass_point *at, float by_sun[3], float rest[3]);

#endif
