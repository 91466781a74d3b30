/* SPDX-License-Identifier: MIT
 *
 * The models of nature that kernel-reflection sequences are for (Szécsi et al. 2016, section 9):
 * each built into memory of the caller's, with a camera. Left out: light and textures, which the
 * pictures choose by the materials named here. */
#ifndef EXAMPLES_MODELS_H
#define EXAMPLES_MODELS_H

#include <spheretrace/spheretrace.h>

/* What a component is made of; pictures have a texture for each. */
typedef enum model_material {
    MODEL_BARK,
    MODEL_LEAF,
    MODEL_GRASS,
    MODEL_SAND,
    MODEL_ROCK,
    MODEL_CORAL,
    MODEL_SPONGE,
    MODEL_FISH,
    model_materials
} model_material;

enum { MODEL_COMPONENTS = 12 };

/* What a component of the union is, for those who shade it. */
typedef struct model_component {
    const spt_krs *krs;             /* one of the two, */
    const spt_moekrs *moekrs;       /* */
    const spt_distorted *distorted; /* and what it is bent by, or NULL */
    model_material material;
    model_material leaf_material; /* of the kernels */
    int leaf_kernels;             /* below this number; 0: none */
    float tint[3];                /* multiplies the material's colour */
} model_component;

/* A model as it was built. Holds pointers into itself: not to be moved. About 350 KiB. */
typedef struct model_world {
    spt_scene scene; /* of the fields below */
    spt_field fields[MODEL_COMPONENTS];
    model_component components[MODEL_COMPONENTS];
    spt_krs krs[MODEL_COMPONENTS];
    spt_moekrs moekrs[2];
    spt_distorted distorted[MODEL_COMPONENTS];
    spt_bound bounds[MODEL_COMPONENTS];
    size_t count;
} model_world;

typedef struct model {
    const char *name;
    const char *description;
    double eye[3], target[3]; /* y is up */
    double field_of_view;     /* horizontal, degrees */
    double t_max;             /* for unit directions */
    double haze;              /* distance at which all has melted into the sky or the water */
    int under_water;          /* 1: the light of the sea, 0: a clear day */
    /* Fills a world. variant: 0 for the model as described; what others mean is said at the model
     * (rock: 1 flat-shaded, fish: 1 aligned mirrors, twisted tree: 1 straight, and so on). Returns
     * 0 where the library refused. */
    int (*build)(model_world *world, int variant);
} model;

/* All models, and how many. */
extern const model *const models[];
extern const size_t model_count;

/* The model of a name, or NULL. */
const model *model_named(const char *name);

#endif
