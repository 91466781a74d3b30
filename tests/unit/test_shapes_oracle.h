/* SPDX-License-Identifier: MIT
 *
 * Distances found by search, from nothing but what a body is: which points belong to it, or which
 * curve it is a tube around. In double; shares no code and no formula with shapes.h. */
#ifndef TESTS_TEST_SHAPES_ORACLE_H
#define TESTS_TEST_SHAPES_ORACLE_H

/* A body that is seen whole from its centre, given by membership; or the points within radius of a
 * curve, t from 0 to 1. The other is NULL. */
typedef struct shape_body {
    int (*inside)(const double p[3]);
    double centre[3];
    double reach; /* no point of it is farther from its centre */
    void (*curve)(double t, double point[3]);
    double radius;
} shape_body;

/* The distance of p from the surface, negative inside. Too large by at most SHAPE_SEARCHED: the
 * search ends with steps of SHAPE_SEARCH_STEP in two directions, which the reach, at most 4,
 * magnifies, the more the flatter the surface is seen from the centre (by 2 at most). */
double shape_search(const shape_body *body, const double p[3]);

#define SHAPE_SEARCH_STEP 1e-6
#define SHAPE_SEARCHED (2 * 4 * 1.4143 * SHAPE_SEARCH_STEP)

/* An arc by its two ends and a third point, t from 0 to 1; any flatness. */
void shape_arc_point(const double a[3], const double b[3], const double control[3], double t,
                     double point[3]);

/* Distance of p from a curve on [0, 1], by samples and golden sections. */
double shape_curve_distance(void (*curve)(double t, double point[3]), const double p[3]);

extern const shape_body body_sphere, body_box, body_rounded_box, body_torus, body_capped_torus,
    body_capped_torus_wide, body_capsule, body_capsule_point, body_cylinder, body_cone,
    body_ellipsoid, body_arc, body_arc_long, body_arc_straight, body_tetrahedron, body_dodecahedron,
    body_tetrahedron_2_5, body_dodecahedron_7, body_tetrahedron_4, body_dodecahedron_32;

#endif
