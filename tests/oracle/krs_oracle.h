/* SPDX-License-Identifier: MIT
 *
 * The oracle of kernel-reflection sequences: kernels in double, each copied to every place where the
 * model has it, and the least of their distances. Written from the definition of a model in krs.h;
 * nothing here folds a point. Left out: how models are drawn, see krs_draw.h. */
#ifndef TESTS_ORACLE_KRS_ORACLE_H
#define TESTS_ORACLE_KRS_ORACLE_H

#include "harness.h"

#include <spheretrace/krs.h>

/* ---- Kernels ------------------------------------------------------------------------------- */

/* A kernel where it stands. Of SPT_KERNEL_FIELD the field's user is taken to be a reference_field,
 * its truth in double. */
typedef struct krs_body {
    uint32_t kind;
    double a[3], b[3], control[3], radius, width;
    const reference_field *field;
    /* Capsule: the circle, from a on counter-clockwise about axis[2] to b at `angle`; straight with
     * angle 0. Leaf: axis[0] from tip to tip, axis[1] across in its plane, axis[2] out of it; each
     * edge is an arc of circle_radius. */
    double center[3], axis[3][3], circle_radius, angle, half;
} krs_body;

krs_body krs_body_of(const spt_kernel *kernel);

/* The signed distance; +infinity where there is nothing. */
double krs_body_distance(const krs_body *body, const double p[3]);

/* Its gradient by central differences. */
void krs_body_gradient(const krs_body *body, const double p[3], double gradient[3]);

/* A ball around the body; fields are taken to be within 1 of the origin. Returns 0 for bodies
 * without end, and for none. */
int krs_body_ball(const krs_body *body, double center[3], double *radius);

/* A random point on the surface of a body with a ball around it. */
void krs_body_sample(const krs_body *body, double p[3]);

/* How far along the arc of a capsule the place nearest to p is, 0 at a and 1 at b. */
double krs_arc_fraction(const krs_body *body, const double p[3]);

/* ---- Models -------------------------------------------------------------------------------- */

enum { krs_most_levels = 10, krs_most_instances = (2 << krs_most_levels) - 1 };

/* One copy of a kernel: bit i of mirrors is set where it went through mirror i. */
typedef struct krs_instance {
    krs_body body; /* in the world; of a field where it stood before all mirrors */
    uint32_t kernel;
    uint64_t mirrors;
} krs_instance;

/* A model as the set of all its kernel instances; those of empty kernels are left out. */
typedef struct krs_expansion {
    uint32_t levels;
    double normal[krs_most_levels][3], offset[krs_most_levels]; /* of unit normals */
    size_t count;
    krs_instance instances[krs_most_instances];
} krs_expansion;

/* A model of no levels, and one of a level more. */
void krs_expansion_begin(krs_expansion *expansion, const spt_kernel *kernel);
void krs_expansion_add(krs_expansion *expansion, const spt_mirror *mirror,
                       const spt_kernel *kernel);
void krs_expand(krs_expansion *expansion, uint32_t levels, const spt_kernel *kernels,
                const spt_mirror *mirrors);

/* p in mirror i, and p as an instance's kernel sees it. */
void krs_reflect(const krs_expansion *expansion, uint32_t mirror, double p[3]);
void krs_to_kernel(const krs_expansion *expansion, uint32_t kernel, uint64_t mirrors,
                   const double p[3], double seen[3]);

double krs_instance_distance(const krs_expansion *expansion, size_t index, const double p[3]);

/* The least distance of all. If wanted (not NULL): which instance has it, and by how much the
 * second is farther. */
double krs_expansion_distance(const krs_expansion *expansion, const double p[3], size_t *which,
                              double *margin);

/* The gradient of the nearest instance's distance, in the world. */
void krs_expansion_gradient(const krs_expansion *expansion, size_t which, const double p[3],
                            double gradient[3]);

/* What is left of an instance once each level is cut at its mirror: whether p, on its surface or
 * inside, is at most `slack` beyond any of the planes. */
int krs_instance_kept(const krs_expansion *expansion, size_t index, const double p[3],
                      double slack);

/* The promise of spt_krs_field(): 4u (n + 4) max(|p| + largest |offset|, 1), u = 2^-24. */
double krs_rounding(uint32_t levels, const spt_mirror *mirrors, const double p[3]);

/* ---- Asking the library ---------------------------------------------------------------------- */

/* The field's values at any number of points, by its batch callback, and by the other one. */
void krs_values(const spt_field *field, size_t count, const float (*points)[3], float *values);
void krs_point_values(const spt_field *field, size_t count, const float (*points)[3],
                      float *values);

/* float to double, three numbers. */
void krs_widen(const float from[3], double to[3]);
void krs_cross(const double a[3], const double b[3], double out[3]);

#endif
