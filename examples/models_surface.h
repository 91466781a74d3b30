/* SPDX-License-Identifier: MIT
 *
 * What rays have met on a model: points with normals, and where they lie in the kernels, by the
 * library's calls for hits; and the light of the sun and the sky there. */
#ifndef EXAMPLES_MODELS_SURFACE_H
#define EXAMPLES_MODELS_SURFACE_H

#include "models_air.h"

/* The same for all threads; none writes it. Holds pointers into itself: not to be copied. */
typedef struct models_stage {
    const model_world *world;
    models_air air;
    spt_settings settings; /* as rays from the eye are traced */
    float sun;             /* tangent of its angular radius; 0: its shadows are hard */
    int occlusion;         /* whether what is near keeps off the light of the sky */
    spt_scene casters;     /* the components as shadow rays see them */
    spt_field fields[MODEL_COMPONENTS];
    spt_bound bounds[MODEL_COMPONENTS];
} models_stage;

/* Points to be shaded: the hits among at most SPT_BATCH rays, entry k of ray place[k]. */
typedef struct models_points {
    size_t count;
    size_t place[SPT_BATCH];
    spt_ray rays[SPT_BATCH];
    spt_hit hits[SPT_BATCH];
    float normal[SPT_BATCH][3], point[SPT_BATCH][3];
    int32_t kernel[SPT_BATCH];
    uint64_t mirrors[SPT_BATCH];
    float kernel_point[SPT_BATCH][3], kernel_normal[SPT_BATCH][3];
    float u[SPT_BATCH], v[SPT_BATCH], scale[SPT_BATCH];
    float wide[SPT_BATCH];                      /* what a pixel sees there, world length, */
    float u_wide[SPT_BATCH], v_wide[SPT_BATCH]; /* and in u and v */
    float sun[SPT_BATCH];                       /* how much of the sun is seen, 0 to 1, */
    float openness[SPT_BATCH];                  /* and of the sky */
    int behind[SPT_BATCH];                      /* 1: the sun shines on the other side of a leaf */
} models_points;

void models_stage_set(models_stage *stage, const model *shown, const model_world *world,
                      const spt_settings *settings, float sun);

/* The material of a point. */
model_material models_material_of(const models_stage *stage, const models_points *points, size_t k);

/* The hits among rays: where they are in the kernels, and their normals. Returns what the library
 * did. In models_locate.c. */
spt_status models_find_points(const models_stage *stage, size_t count, const spt_ray *rays,
                              const spt_hit *hits, models_points *points);

/* Fills sun, openness and behind. workspace: of models_workspace() bytes. */
spt_status models_find_light(const models_stage *stage, void *workspace, size_t workspace_size,
                             models_points *points);

size_t models_workspace(const models_stage *stage);

#endif
