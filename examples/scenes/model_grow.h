/* SPDX-License-Identifier: MIT
 *
 * Trees from the forks of one route from the trunk to the end of a twig (Szécsi et al. 2016,
 * section 9.2): kinds of trees, where they stand, and the woods and meadows that they stand in.
 * Left out: the scenes they make, see model_tree.c and model_forest.c. */
#ifndef EXAMPLES_MODEL_GROW_H
#define EXAMPLES_MODEL_GROW_H

#include "model_nature.h"

/* A branch of the route and the fork at its end. Angles in degrees. The route goes on through every
 * fork in one direction, its image in the mirror there in the other. */
typedef struct model_fork {
    double length;  /* of the branch, a straight line from fork to fork */
    double azimuth; /* by how much the fork is turned about the branch; at 0 at right angles to the
                     * fork before */
    double on, off; /* from the branch's direction to that in which the route goes on, and the
                     * other way to that of its image */
    double skew;    /* by how much the image is turned further about the branch */
} model_fork;

/* A kind of tree. Of its kernels the first two are leaves, the others branches. */
typedef struct model_kind {
    const model_fork *forks;        /* from the trunk to the twig */
    uint32_t count;                 /* how many */
    double half_width;              /* of the trunk, */
    double taper;                   /* and of each higher branch as a share of the one below */
    double leaf_length, leaf_width; /* tip to tip; from the middle to an edge */
} model_kind;

enum { MODEL_LEAF_KERNELS = 2 };

/* Broad-leaved trees about 8.5 high, with the foot at the origin. */
extern const model_kind model_oak, model_maple, model_elm, model_linden;

/* Grows a tree and puts it in its place. */
void model_grow(model_sketch *sketch, const model_kind *kind, const model_place *place);

/* The roots of a tree of that half width, where they come out of the ground. */
void model_grow_roots(model_sketch *sketch, double half_width, const model_place *place);

/* Adds a tree that was grown as a component, with leaves of that tint. Returns NULL where the
 * library refused it. */
model_component *model_add_tree(model_world *world, const model_sketch *tree, const float tint[3]);

/* The upright box around a sketch of capsules with their control points over the middle, leaves and
 * spheres, none of which is thought cut. */
spt_bound model_box(const model_sketch *sketch);

/* ---- Woods --------------------------------------------------------------------------------- */

/* Where a tree stands in a wood, and the radius around it that no mirror may cut. */
typedef struct model_plot {
    double x, z, radius;
} model_plot;

/* Steep mirrors by which a few plots become a wood. Their normals are unaligned, so that no two
 * rows of trees look alike. */
typedef struct model_wood {
    spt_mirror mirrors[SPT_KRS_LEVELS];
    uint32_t doublings;
} model_wood;

enum { MODEL_PLOTS = 8, MODEL_DOUBLINGS = 9 };

/* Finds mirrors that have all of what there is by then, to its edge, on one side. */
void model_plant(model_wood *wood, const model_plot *plots, int count, int doublings,
                 uint32_t seed);

/* Multiplies what a sketch holds by the mirrors of a wood, with empty kernels. */
void model_multiply(model_sketch *sketch, const model_wood *wood);

#endif
