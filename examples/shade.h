/* SPDX-License-Identifier: MIT
 *
 * From hits to colours: normals, sunlight with soft shadows, light of the sky, ambient occlusion.
 * Shadow rays go through the union of the scene's parts; what only needs values near a point asks
 * the whole field through its batch callback, 256 points at a time. */
#ifndef EXAMPLES_SHADE_H
#define EXAMPLES_SHADE_H

#include "look.h"
#include "scenes/parts.h"

/* The same for all threads; none writes it. Holds pointers into itself: not to be copied. */
typedef struct shading {
    const look *look;
    spt_field field;             /* the whole scene */
    const scene_parts *traced;   /* what hits.component counts */
    scene_parts casters;         /* the same parts, prepared for shadow rays */
    float epsilon, pixel_radius; /* as the rays were traced */
    float size;                  /* of the scene, world length */
    float haze;                  /* where the ground has melted into the sky, world length */
    float ground;                /* its height; -infinity: there is none */
    int ground_is_traced;        /* the field holds it, at least inside its bound */
    int ground_is_added;         /* it is drawn here where the field does not hold it */
    int sun_side;                /* the sun's disc is sampled by sun_side^2 rays */
    int shadows;                 /* whether the sun casts any */
    uint32_t max_lanes;
} shading;

/* What a thread that shades needs for itself. */
typedef struct shade_scratch {
    float *x, *y, *z, *distance; /* of SPT_BATCH points, as the batch callback wants them */
    void *workspace;             /* of shadow rays */
    size_t workspace_size;
    void *memory;
} shade_scratch;

/* The width that the library will use. */
int shade_lanes(uint32_t max_lanes);

/* Prepares the shading of a scene that is traced as the union of that grain, with soft shadows.
 * Returns 0 where memory ran out. */
int shading_create(shading *shader, const scene *shown, scene_grain grain, float epsilon,
                   float pixel_radius, int sun_side, uint32_t max_lanes);

/* Returns 0 where memory ran out; nothing is to be freed then. */
int shade_scratch_create(shade_scratch *scratch, const shading *shader);
void shade_scratch_free(shade_scratch *scratch);

/* Where a ray meets the added ground, or infinity: rays need not be traced beyond. */
float shade_ground_at(const shading *shader, const spt_ray *ray);

/* Unit normals (outward) at count <= SPT_BATCH points, by central differences; zero where the
 * gradient is zero or not finite. half_pixel[i]: the pixel's half width there. */
void shade_normals(const shading *shader, shade_scratch *scratch, size_t count,
                   const float (*points)[3], const float *half_pixel, float (*normals)[3]);

/* The colours (linear, 0 to 1) of at most SPT_BATCH rays. part[i] says which part of the sun's disc
 * lights ray i, 0 to sun_side^2 - 1. */
void shade_rays(const shading *shader, shade_scratch *scratch, size_t count, const spt_ray *rays,
                const spt_hit *hits, const int *part, float (*colours)[3]);

#endif
