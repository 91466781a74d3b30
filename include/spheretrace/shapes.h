/* SPDX-License-Identifier: MIT
 *
 * Ready-made signed distance functions and operators to write callbacks with (field.h), all of them
 * static inline: numbers and points (shapes_math.h), bodies (shapes_primitives.h and
 * shapes_polytopes.h), operators (shapes_operators.h). Left out: the callbacks themselves.
 *
 * HOW TO USE THEM. One loop over the points, compiled as field.h says:
 *     static void lamp(void *user, size_t n, const float *restrict x, const float *restrict y,
 *                      const float *restrict z, float *restrict distance) {
 *         for (size_t i = 0; i < n; ++i) {
 *             const spt_point p = spt_point_of(x[i], y[i], z[i]);
 *             const float globe = spt_sphere(spt_translate(p, spt_point_of(0, 2, 0)), 0.5f);
 *             const float pole = spt_cylinder(p, 2, 0.1f);
 *             distance[i] = spt_smooth_union(globe, pole, 0.2f);
 *         }
 *     }
 * A shape is moved by moving the point the other way before asking, so the operator written last
 * acts on the shape first. What is built (spt_arc_of, spt_rotation_of) is built before the loop.
 * Every function here vectorises inside such a loop with gcc and clang, from SSE2 to AVX-512. Your
 * own code does if it makes no branches and calls no function of the C library other than sqrtf and
 * fabsf. Choose with spt_least() and spt_greatest() between two values, with spt_positive(),
 * spt_negative() and spt_clamp() where one is a constant, and with spt_choose() else.
 *
 * WHAT IS SAID OF EACH. Lengths are in the unit of the scene, angles in radians.
 *   exact        the Euclidean distance to the surface, negative inside
 *   lower bound  never more than that, in magnitude, with the right sign
 *   L            the Lipschitz constant: |f(p) - f(q)| <= L |p - q|, for spt_field.lipschitz
 *   convex       a convex function, licence for SPT_FIELD_CONVEX
 *   flop, root   additions, multiplications, comparisons and selections, and square roots, that one
 *                evaluation costs when what depends on constant arguments only is folded
 * Nothing is checked. An argument outside the range that is stated gives a wrong distance.
 *
 * NUMBERS. A file that defines SPT_SHAPES_DOUBLE before the include gets all of it in double, with
 * the same formulas: a reference to test against.
 *   range     lengths of bodies, blends and periods 0 or from 1e-15 to 1e18; coordinates of points
 *             below 1e19, where squares begin to overflow. Beyond, a body is infinitely far; no
 *             finite point gives NaN.
 *   rounding  the value is off by less than 1e-6 times the sum of the coordinates and the size of
 *             the body (times L); the general exponents by twice that.
 *   bits      one IEEE operation after the other, no function of the C library: with
 *             -ffp-contract=off the same bits at every width and optimisation, with gcc and clang.
 *             Not with -ffast-math.
 *
 * SOURCES. Hart 1996, Sphere Tracing (distances, unions, ellipsoid, twist); Akleman and Chen 1999,
 * Generalized Distance Functions; Szecsi et al. 2016, Kernel-Reflection Sequences (toroidal
 * capsules). Formulas that cancel in float are rearranged, which their comments say. */
#ifndef SPHERETRACE_SHAPES_H
#define SPHERETRACE_SHAPES_H

#include "shapes_math.h"
#include "shapes_operators.h"
#include "shapes_polytopes.h"
#include "shapes_primitives.h"

#endif
