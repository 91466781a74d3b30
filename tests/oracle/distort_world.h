/* SPDX-License-Identifier: MIT
 *
 * Deformations in double, as krs.h says what they do to bodies, without the frames and kernels of
 * the library; and bodies to deform. */
#ifndef TESTS_ORACLE_DISTORT_WORLD_H
#define TESTS_ORACLE_DISTORT_WORLD_H

#include "analytic.h"

#include <spheretrace/krs.h>

/* All kinds but the caller's map. */
enum { distort_kinds = 4 };
static const uint32_t distort_kind_of[distort_kinds] = {SPT_DISTORTION_TWIST, SPT_DISTORTION_BEND,
                                                        SPT_DISTORTION_TAPER, SPT_DISTORTION_SWAY};

/* What a deformation does to a point of the body, and back. A bend turns by its rate times the
 * height that the point has afterwards, which distort_forward() finds by iteration: the distance to
 * the axis of turning times |rate| must be below 0.9. */
void distort_forward(const spt_distortion *distortion, const double q[3], double p[3]);
void distort_back(const spt_distortion *distortion, const double p[3], double q[3]);

/* The transposed derivative of distort_back() at p times a vector, by differences. */
void distort_back_transposed(const spt_distortion *distortion, const double p[3],
                             const double vector[3], double to[3]);

/* The largest singular value of that derivative. */
double distort_stretch(const spt_distortion *distortion, const double p[3]);

/* Random directions, of random length, and numbers for a body of about this size around the origin;
 * what turns, turns by up to `turn` within it. */
spt_distortion distort_draw(uint32_t kind, double size, double turn);

/* A body around the origin with what its callbacks saw. Values are computed in double at the float
 * position and rounded. */
typedef struct distort_body {
    analytic_shape shape;
    spt_bound bound;
    unsigned calls, faults; /* of the rules of field.h */
} distort_body;
distort_body distort_body_of(analytic_kind kind, double size);

/* Its field: with batch, or point callback, or a batch callback that writes over its points; with
 * its gradient. */
typedef enum distort_form { DISTORT_BATCH, DISTORT_POINT, DISTORT_SCRIBBLE } distort_form;
spt_field distort_field_of(distort_body *body, distort_form form);

/* f(W(p)) in double. */
double distort_distance(const distort_body *body, const spt_distortion *distortion,
                        const double p[3]);

/* Asks a field for one point. */
float distort_ask(const spt_field *field, const double p[3]);
void distort_ask_gradient(const spt_field *field, const double p[3], double gradient[3]);

/* The first place in an array of floats, with 16 to spare, that is aligned for callbacks. */
float *distort_aligned(float *room);

/* A body, deformed by as much as the library and the oracle's ways allow, and the field. Not to be
 * copied. */
typedef struct distort_case {
    double size;
    distort_body body;
    spt_distortion distortion;
    spt_distorted memory;
    spt_field field;
} distort_case;

/* Turns that distort_draw() may take: bends need less for the oracle's way forward, and tapers keep
 * a scale of an eighth. */
double distort_most_turn(uint32_t kind);

/* A box, capsule, torus or cylinder of any size from 0.01 to 100; names it in the context. */
void distort_draw_case(distort_case *out, uint32_t kind, double turn);

/* A random point of the body, before it is deformed. */
void distort_body_point(const distort_case *at, double p[3]);

double distort_length(const double vector[3]);
void distort_unit(double vector[3]);

#endif
