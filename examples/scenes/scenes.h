/* SPDX-License-Identifier: MIT
 *
 * The scenes that examples, tests and benches share: each a field with a camera, compiled once in
 * double as the reference and once for each instruction set as a batch callback, from one source.
 * Left out: materials and light, which the pictures choose. */
#ifndef EXAMPLES_SCENES_H
#define EXAMPLES_SCENES_H

#include <spheretrace/spheretrace.h>

/* The scene in double precision at n points, any n; the same source as the callbacks. */
typedef void scene_reference_fn(size_t n, const double *x, const double *y, const double *z,
                                double *distance);

/* A field for a width, or, for lanes 0, for one point. */
typedef spt_field scene_field_fn(int lanes);

typedef struct scene {
    const char *name;
    const char *description;
    float lipschitz;        /* as spt_field.lipschitz */
    uint32_t flags;         /* as spt_field.flags */
    const spt_bound *bound; /* as spt_field.bound */
    double eye[3], target[3];
    double field_of_view;            /* horizontal, degrees */
    double t_max;                    /* for unit directions */
    spt_distance_batch_fn *batch[4]; /* built for 1, 4, 8 and 16 lanes; the widest that was built
                                      * stands in for a wider one */
    spt_distance_fn *point;          /* one point */
    scene_field_fn *field;           /* builds what has no callbacks of its own, or NULL */
    scene_reference_fn *reference;
    const char *glsl, *glsl_prelude; /* as in spt_field; NULL where the library writes it */
} scene;

/* All scenes, and how many. */
extern const scene *const scenes[];
extern const size_t scene_count;

/* The scene of a name, or NULL. */
const scene *scene_named(const char *name);

/* Its field with the batch callback built for a width (1, 4, 8, 16: pass spt_lanes()), or, for
 * lanes 0, with the callback for one point; and with its text in GLSL. Where the scene has to be
 * built first, so by the first call, and that of `reference`: they must not come from two threads
 * at once. */
spt_field scene_field(const scene *scene, int lanes);

/* The rays of a pinhole camera, at the pixel centres, unit directions, row by row from the top;
 * t_min 0, t_max the scene's. Computed in double and rounded, so that they are the same for every
 * caller. rays holds width * height. pixel_radius receives half a pixel at distance 1. */
void scene_rays(const scene *scene, int width, int height, spt_ray *rays, float *pixel_radius);

/* The same rays tile by tile, 16x16, in Morton order within (the order a renderer should use: a
 * chunk of 256 is then a compact block of pixels); pixel receives each ray's place y * width + x,
 * or may be NULL. */
void scene_rays_tiled(const scene *scene, int width, int height, spt_ray *rays, size_t *pixel,
                      float *pixel_radius);

/* The same camera for a picture of width x height as a frame takes it (spt_camera_pinhole()): its
 * rays differ from those of scene_rays() by their rounding. */
spt_camera scene_camera(const scene *scene, uint32_t width, uint32_t height);

#endif
