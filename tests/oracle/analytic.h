/* SPDX-License-Identifier: MIT
 *
 * Where rays meet simple shapes, by closed forms in double: the ground truth of the oracle tests.
 * Left out: position and orientation; shapes sit at the origin and rays are placed around them. */
#ifndef TESTS_ORACLE_ANALYTIC_H
#define TESTS_ORACLE_ANALYTIC_H

#include "reference.h"

typedef enum analytic_kind {
    ANALYTIC_SPHERE,
    ANALYTIC_PLANE, /* y = 0, inside below */
    ANALYTIC_BOX,
    ANALYTIC_CAPSULE,  /* along y */
    ANALYTIC_CYLINDER, /* along y, closed */
    ANALYTIC_TORUS,    /* around y */
    ANALYTIC_KINDS
} analytic_kind;

typedef struct analytic_shape {
    analytic_kind kind;
    double radius;  /* sphere, capsule, cylinder; torus: of the tube */
    double extent;  /* capsule, cylinder: half height; torus: of the ring */
    double half[3]; /* box */
} analytic_shape;

/* The first crossing of the surface in [t_min, t_max].
 *   t       its parameter, +infinity where there is none
 *   deep    the first t after it at which the ray is `depth` (an argument, world length) beyond the
 *           surface; +infinity where it crosses back before it gets so deep. A ray that never gets
 *           deep only grazes
 *   cosine  between the direction and the normal at the crossing */
typedef struct analytic_hit {
    double t, deep, cosine;
} analytic_hit;

/* The exact signed distance. */
double analytic_distance(const analytic_shape *shape, const double p[3]);

/* The radius of the ball around the origin that holds the shape; for the plane 1. */
double analytic_size(const analytic_shape *shape);

/* Shapes with a size of about `scale`, each with its own proportions. */
analytic_shape analytic_sample(analytic_kind kind, double scale);

/* The truth for a ray with finite t_max. */
analytic_hit analytic_trace(const analytic_shape *shape, const reference_ray *ray, double depth);

/* The shape as a field of the reference; the shape must outlive it. */
reference_field analytic_field(const analytic_shape *shape);

#endif
