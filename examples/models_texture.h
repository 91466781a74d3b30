/* SPDX-License-Identifier: MIT
 *
 * What the models of nature are made of: a procedural texture for every material, by the kernel's
 * own u and v, in the kernel's space, or in the world's. */
#ifndef EXAMPLES_MODELS_TEXTURE_H
#define EXAMPLES_MODELS_TEXTURE_H

#include "scenes/models.h"

/* A point on a model, as spt_krs_locate() tells it. */
typedef struct texture_place {
    model_material material;
    float unit;                              /* measure of the textures, world length */
    float footprint;                         /* what a pixel sees there, world length */
    float world[3], normal[3];               /* where it is, and which way it faces */
    float kernel_point[3], kernel_normal[3]; /* the same in the space of its kernel */
    float u, v, scale;
    float u_wide, v_wide; /* what a pixel sees in u and v */
    uint32_t identity;    /* of the instance, */
    uint32_t branch;      /* and of the branch that it belongs to */
    float tint[3];
} texture_place;

/* What the light meets. */
typedef struct texture_look {
    float albedo[3];
    float relief[3]; /* slope of what rises over the surface: to be taken off its normal; */
    int in_kernel;   /* in the kernel's space instead of the world's */
    float gloss;     /* 0 matt to 1 wet */
    float through;   /* how much light comes through from behind, 0 to 1 */
} texture_look;

void models_texture(const texture_place *at, texture_look *look);

#endif
