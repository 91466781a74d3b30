/* SPDX-License-Identifier: MIT
 *
 * The random worlds of harness.h as unions of components for frames, their first hits, and cameras
 * of the caller's rays of every kind: a thin lens, a panorama, rays without any order. */
#ifndef TESTS_ORACLE_FRAME_WORLDS_H
#define TESTS_ORACLE_FRAME_WORLDS_H

#include "frame_camera.h"
#include "frame_truth.h"
#include "harness.h"

enum { ball_parts = world_spheres + 1 };

typedef struct ball_part {
    const world *shape;
    int index; /* of the ball; the number of balls for the floor */
} ball_part;

/* A world and its scene, which points into it: do not copy it. */
typedef struct ball_scene {
    world shape;
    ball_part parts[ball_parts];
    spt_field fields[ball_parts];
    spt_bound bounds[ball_parts];
    spt_scene scene;
} ball_scene;

/* Balls with bounds where the bits of `bounded` say so (the floor never has one), convex where
 * those of `convex` do. Distances are computed in double and rounded. */
void ball_scene_of(ball_scene *balls, const world *shape, uint32_t bounded, uint32_t convex);
/* The same with random bits. */
void ball_scene_draw(ball_scene *balls, const world *shape);
truth_field ball_scene_truth(const ball_scene *balls);

/* Where a ray from o along d of length 1, from outside, first is inside by more than slack;
 * +infinity where it never is. */
double ball_scene_first(const world *shape, const double o[3], const double d[3], double slack);

/* ---- Cameras of the caller's rays ---------------------------------------------------------- */

enum {
    LENS_THIN,     /* origins on a disc, chosen by the point, through one focal plane */
    LENS_PANORAMA, /* all directions around */
    LENS_DISORDER, /* origins and directions without any order */
    LENS_MIXED,    /* as thin, but some rays inactive, some bad, some longer than 1, with limits
                    * and path lengths */
    lens_kinds
};

typedef struct lens {
    int kind;
    double width, height; /* of the image */
    double aperture;
} lens;
spt_camera lens_camera(lens *user, int kind, uint32_t width, uint32_t height);

/* A number in [0, 1) that depends on a and b alone. */
double lens_noise(double a, double b);

#endif
