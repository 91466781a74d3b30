/* SPDX-License-Identifier: MIT
 *
 * What the models of sea and stone share: a sequence that is described level by level and then put
 * somewhere, and the bodies that the reef puts together. Left out: trees, see model_build.h. */
#ifndef EXAMPLES_MODEL_NATURE_H
#define EXAMPLES_MODEL_NATURE_H

#include "model_build.h"

/* A sequence from the leaf to the trunk. */
typedef struct model_sketch {
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    uint32_t levels;
} model_sketch;

/* Begins with K_0. */
void sketch_begin(model_sketch *sketch, const spt_kernel *leaf);

/* One more level: what there is so far, its image in the mirror through a point, and a kernel
 * (NULL: none). What is on the side that the normal points to is cut off. */
void sketch_double(model_sketch *sketch, const double point[3], const double normal[3],
                   const spt_kernel *kernel);

/* Where a point comes to in all mirrors so far, and with their offsets left out where a direction
 * does: what the kernels below them see of it. */
void sketch_fold(const model_sketch *sketch, int is_direction, double point[3]);

/* Scales what there is about the origin, turns it about the y axis (radians), and moves it. Kernels
 * that are fields stay as they are: for sketches without any. */
void sketch_place(model_sketch *sketch, double scale, double turn, const double position[3]);

/* Adds it to a world. smooth: as in spt_krs_model. bound: of the whole, or NULL. Returns NULL where
 * the library refused it. */
model_component *sketch_add(model_world *world, const model_sketch *sketch, double smooth,
                            const spt_bound *bound, model_material material);

/* A kernel between two points, bulging towards `by` in the middle. */
spt_kernel sketch_capsule(const double from[3], const double to[3], const double by[3],
                          double radius);

/* A random unit vector. */
void sketch_direction(uint32_t *state, double direction[3]);

/* A unit vector at the angle (radians) `tilt` from a unit axis, turned about it by `turn`. */
void sketch_lean(const double axis[3], double tilt, double turn, double leaned[3]);

/* ---- Bodies -------------------------------------------------------------------------------- */

/* Where a body stands and how large it is. */
typedef struct model_place {
    double position[3];
    double scale;
    double turn; /* about the y axis, radians */
} model_place;

/* Each adds one component, tinted, and returns it, or NULL where the library refused it. */

/* A branching coral about 2 high, its foot at the origin. seed: any. */
model_component *model_add_coral(model_world *world, const model_place *place, uint32_t seed);

/* Low dunes of sand around y = 0. */
model_component *model_add_seabed(model_world *world, const model_place *place);

/* A boulder of about radius 1 around the origin, its normals blended over `smooth`. */
model_component *model_add_rock(model_world *world, const model_place *place, uint32_t seed,
                                double smooth);

/* A sponge with holes, of about radius 1 around the origin; its turn is not read. which: 0 to 3,
 * each for one place only, as its kernel needs memory that lives for ever. */
model_component *model_add_sponge(model_world *world, const model_place *place, int which);

/* Schools of fish that swim along x, at fixed places: each has its own numbers for its own kernels,
 * which live for ever. */
typedef enum model_school {
    MODEL_SCHOOL_ALONE,   /* some 900 around the origin */
    MODEL_SCHOOL_ALIGNED, /* the same in mirrors along the axes */
    MODEL_SCHOOL_SMALL,   /* of the reef */
    MODEL_SCHOOL_LARGE
} model_school;
model_component *model_add_fish(model_world *world, model_school school);

#endif
