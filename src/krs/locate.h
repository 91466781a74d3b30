/* SPDX-License-Identifier: MIT
 *
 * A place on a model: which kernel, by which mirrors, and the way back for its normal. */
#ifndef SPTI_LOCATE_H
#define SPTI_LOCATE_H

#include "sequence.h"

typedef struct spti_place {
    int32_t kernel; /* -1: all are empty */
    uint64_t mirrors;
    float point[3];         /* as the kernel sees it */
    float normal[3];        /* unit, world; or zero */
    float kernel_normal[3]; /* unit, in the kernel's space; or zero */
    float u, v, scale;
} spti_place;

/* Where a point lies. smooth: the width of the blend at mirrors in their own space; footprint: that
 * in the world. */
void spti_find_place(const spti_stretch *model, const float point[3], float smooth, float footprint,
                     spti_place *place);

/* The normals of n points, for gradient callbacks. */
void spti_place_gradients(const spti_stretch *model, float smooth, size_t n, const float *x,
                          const float *y, const float *z, float *gradient_x, float *gradient_y,
                          float *gradient_z);

/* The gradient of a kernel at a point in its space, of unit length, or zero. */
void spti_kernel_gradient(const spt_built_kernel *kernel, const float point[3], double gradient[3]);

/* Its own parameters there. */
void spti_kernel_parameters(const spt_built_kernel *kernel, const float point[3], float *u,
                            float *v);

/* The distance of a kernel of any kind but empty at a point; the bits that the kernels give. */
float spti_kernel_distance(const spt_built_kernel *kernel, const float point[3]);

/* What spt_krs_locate() and spt_moekrs_locate() do. */
spt_status spti_locate(const spti_stretch *model, float smooth, int32_t component,
                       const spt_settings *settings, size_t count, const spt_rays *rays,
                       const spt_hits *hits, const spt_krs_places *places);

#endif
