/* SPDX-License-Identifier: MIT
 *
 * From hits to colours: normals, sunlight with soft shadows, light of the sky, ambient occlusion.
 * All of it asks the field through its batch callback, 256 points at a time. */
#ifndef EXAMPLES_SHADE_H
#define EXAMPLES_SHADE_H

#include "look.h"
#include "scenes/scenes.h"

/* Arrays as the batch callback wants them. */
typedef struct shade_batch {
    float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
} shade_batch;

typedef struct shading {
    const look *look;
    spt_field field;
    float epsilon, pixel_radius; /* as the rays were traced */
    float size;                  /* of the scene, world length */
    float haze;                  /* where the ground has melted into the sky, world length */
    float ground;                /* its height; -infinity: there is none */
    int ground_is_traced;        /* the field holds it, at least inside its bound */
    int ground_is_added;         /* it is drawn here where the field does not hold it */
    int sun_side;                /* the sun's disc is sampled by sun_side^2 rays */
    uint32_t max_lanes;
    spt_statistics *statistics; /* of the shadow rays */
    shade_batch *batch;         /* aligned, inside memory */
    void *memory;
} shading;

/* The field of a scene, its callback built for the width that the library will use. */
spt_field shade_field(const scene *shown, uint32_t max_lanes);

/* A shader for a scene and its camera; batch is NULL where memory ran out. */
shading shader_create(const scene *shown, float epsilon, float pixel_radius, int sun_side,
                      uint32_t max_lanes, spt_statistics *statistics);
void shader_free(shading *shader);

/* Ends rays at the added ground. To be called before they are traced. */
void shade_cut_rays(const shading *shader, size_t count, spt_ray *rays);

/* Unit normals (outward) at the points of the batch, by central differences; zero where the
 * gradient is zero or not finite. scale[i]: the pixel's half width there. The batch is scratch. */
void shade_normals(const shading *shader, size_t count, const float (*points)[3],
                   const float *scale, float (*normals)[3]);

/* The colours (linear, 0 to 1) of at most SPT_BATCH rays. part[i] says which part of the sun's disc
 * lights ray i, 0 to sun_side^2 - 1. */
void shade_rays(const shading *shader, size_t count, const spt_ray *rays, const spt_hit *hits,
                const int *part, float (*colours)[3]);

#endif
