/* SPDX-License-Identifier: MIT
 *
 * Convex bodies for paths of light: balls, polytopes as the maximum of plane distances, and those
 * rounded by a power; in double as the truth, and as fields of the library with gradients. */
#ifndef TESTS_ORACLE_GLASS_BODY_H
#define TESTS_ORACLE_GLASS_BODY_H

#include <spheretrace/field.h>

enum { glass_planes = 20 };

typedef struct glass_body {
    const char *name;
    double center[3], radius; /* without planes: a ball */
    int plane_count;          /* normal . (p - center) <= offset */
    double normal[glass_planes][3], offset[glass_planes];
    int exponent; /* 8 or 32: the norm (sum max(0, normal . (p - center))^exponent)^(1/exponent) - 1
                   * instead, all offsets 1; 0: none */
    double curvature; /* of the surface at most; 0 for flat faces, edges apart */
    double slope;     /* of f near the surface at least, over lipschitz */
    double lipschitz; /* of f, at least 1 */
    spt_bound bound;  /* a ball around it */
    int single;       /* the callback computes in float; else in double, and rounds once */
    uint64_t asked;   /* points that its callback was asked for, padding included */
    uint64_t batches; /* calls of it */
} glass_body;

/* The bodies of the list, their size about 1, none at the origin:
 *   glass_ball, glass_plate (a flat box), glass_cube, glass_dodecahedron
 *   glass_random    a box cut by some planes, from check_uniform()
 *   glass_rounded   the dodecahedron with an exponent */
glass_body glass_ball(void);
glass_body glass_plate(void);
glass_body glass_cube(void);
glass_body glass_dodecahedron(void);
glass_body glass_random(void);
glass_body glass_rounded(int exponent);

/* The truth: f in double, which of the planes is nearest (0 without), the unit gradient. */
double glass_distance(const glass_body *body, const double p[3]);
int glass_face(const glass_body *body, const double p[3]);
void glass_normal(const glass_body *body, const double p[3], double normal[3]);
/* How far all planes but the nearest are from p, as distances inside; +infinity where there is no
 * other, or no edges. */
double glass_other_faces(const glass_body *body, const double p[3]);

/* Where the ray, of unit direction, enters the body (inside 0) or leaves it: *at, world length.
 * Returns 0 where it does not. */
int glass_cross(const glass_body *body, const double origin[3], const double direction[3],
                int inside, double *at);

/* The field with a batch callback, a gradient where wanted, and the bound; convex. */
spt_field glass_field(glass_body *body, int with_gradient);

/* Ball, plate, cube, dodecahedron, rounded by exponents 8 and 32, and from the seventh on random
 * polyhedra. */
glass_body glass_body_number(int number);

#endif
