/* SPDX-License-Identifier: MIT
 *
 * Random models with the truth beside them: kernels of chosen kinds, mirrors just beyond all of
 * their level or through it. Left out: models that a test needs exactly as it says. */
#ifndef TESTS_ORACLE_KRS_DRAW_H
#define TESTS_ORACLE_KRS_DRAW_H

#include "krs_oracle.h"
#include "surface_oracle.h"

/* What kernels may be, as bits of their kinds; half spaces, which no mirror can stand beyond,
 * are drawn for the last kernel only. */
enum {
    KRS_SPHERES = 1u << SPT_KERNEL_SPHERE,
    KRS_HALF_SPACES = 1u << SPT_KERNEL_HALF_SPACE,
    KRS_CAPSULES = 1u << SPT_KERNEL_CAPSULE,
    KRS_LEAVES = 1u << SPT_KERNEL_LEAF,
    KRS_FIELDS = 1u << SPT_KERNEL_FIELD, /* turned tori with lipschitz 2 */
    KRS_EMPTY = 1u << SPT_KERNEL_EMPTY,
    KRS_SOLID = KRS_SPHERES | KRS_CAPSULES | KRS_LEAVES | KRS_FIELDS,
    KRS_ALL = KRS_SOLID | KRS_HALF_SPACES | KRS_EMPTY
};

/* Not to be copied: models and fields look at what is beside them. */
typedef struct krs_drawn {
    uint32_t levels;
    spt_kernel kernels[krs_most_levels + 1];
    spt_mirror mirrors[krs_most_levels];
    surface_body bodies[krs_most_levels + 1];
    reference_field references[krs_most_levels + 1];
    spt_field fields[krs_most_levels + 1];
    spt_bound bounds[krs_most_levels + 1];
    krs_expansion truth;
    double reach; /* all that has an end is within this of the origin */
} krs_drawn;

/* kinds: KRS_*. depth: how far the mirrors reach into their levels, in radii of those levels; 0:
 * they stand beyond. */
void krs_draw(krs_drawn *sample, uint32_t levels, uint32_t kinds, double depth);

/* A kernel of one of the kinds, all but half spaces within 1 of a point within 1 of the origin;
 * of fields within 1 of the origin. `number` is its place in the model. */
spt_kernel krs_draw_kernel(krs_drawn *sample, uint32_t number, uint32_t kinds);

/* A mirror of random direction and given offset. */
spt_mirror krs_draw_mirror(double offset);

/* Builds it. */
void krs_build(const krs_drawn *sample, uint32_t lanes, spt_krs *krs);
spt_krs_model krs_model_of(const krs_drawn *sample);

/* Fills points: a half anywhere within reach, a half near surfaces. */
void krs_draw_points(const krs_drawn *sample, size_t count, float (*points)[3]);

/* A point on the surface of an instance with an end, in the world; returns its index. */
size_t krs_draw_on_surface(const krs_drawn *sample, double p[3]);

/* The gradient of a field of the reference, by differences in double. */
spt_gradient_batch_fn krs_field_gradient;

#endif
