/* SPDX-License-Identifier: MIT
 *
 * The caller's signed distance field: the callbacks, and what is known of them (Lipschitz constant,
 * convexity, a bounding volume). Ready-made shapes to build callbacks from are in shapes.h.
 *
 * WHAT A FIELD MUST BE. f(p) is negative inside and positive outside, and |f(p)| is at most
 * lipschitz times the distance from p to the surface, on both sides. An exact signed distance has
 * lipschitz = 1. A field that changes faster than that anywhere is no distance bound: a tracer may
 * step through its surface. The library cannot prove the promise, but it audits it for free and
 * sets SPT_FLAG_STEEP on rays that saw it broken (trace.h).
 *
 * WHAT DECIDES THE SPEED is how the file that holds the callback is compiled. Write the batch
 * callback as one loop over the points without branches, mark its arrays restrict, and compile with
 *     -O3 -fno-math-errno -ffp-contract=off  and a wide -m flag (-mavx2, or -mavx512f with
 *     -mprefer-vector-width=512)
 * Without -fno-math-errno nothing that contains sqrtf vectorises (measured: 48 ns an evaluation
 * instead of 5), and gcc -O2 vectorises few such loops. To ship one program for all machines,
 * compile the file once for each width and choose by spt_lanes(), the width the library will use.
 * Choose by `a < b ? a : b` between two computed values only: where one side is a constant, or
 * either holds work of its own, gcc makes a branch and the loop stays scalar, without a warning.
 * shapes.h has selections that vectorise. (In C++ write __restrict.) spt_field_measure() shows
 * whether it worked: compare the same function as point and as batch. */
#ifndef SPHERETRACE_FIELD_H
#define SPHERETRACE_FIELD_H

#include "base.h"
#include "bound.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most points that one call of a batch callback brings. */
#define SPT_BATCH 256

/* Signed distance, or a lower bound of it, at n points: distance[i] = f(x[i], y[i], z[i]).
 *   n         a multiple of 16, 16 <= n <= SPT_BATCH. No mask and no tail: points that stand only
 *             for padding repeat a real one, and their distances are not read
 *   x, y, z   64-byte aligned, finite, not overlapping; may be used as scratch space
 *   distance  64-byte aligned. +infinity is legal and means that no surface is anywhere (as does
 *             a value that divided by lipschitz exceeds FLT_MAX). NaN and -infinity end the ray
 *             with SPT_NONFINITE, and so does a value that is not written
 * May be called from every thread that traces, may itself trace, and may leave by longjmp or by a
 * C++ exception: the library holds nothing that would be lost. It must not depend on the place of a
 * point in the arrays; a callback compiled with -ffast-math does, and gives up the library's
 * promise of equal bits at every width. */
typedef void spt_distance_batch_fn(void *user, size_t n, const float *x, const float *y,
                                   const float *z, float *distance);

/* The same for one point: simple to write, several times slower to trace. */
typedef float spt_distance_fn(void *user, float x, float y, float z);

/* The gradient of f at n points, as far as its direction goes: its length does not matter. A point
 * without one gives zero or anything not finite. n, x, y, z as above; the three arrays of the
 * gradient are 64-byte aligned. */
typedef void spt_gradient_batch_fn(void *user, size_t n, const float *x, const float *y,
                                   const float *z, float *gradient_x, float *gradient_y,
                                   float *gradient_z);

enum {
    /* f is a convex FUNCTION (not only a convex body): the exact distance to a convex body, a
     * maximum of planes, a norm. Licenses spt_convex(): the secant step and early misses. */
    SPT_FIELD_CONVEX = 1u << 0
};

typedef struct spt_field {
    size_t struct_size;           /* set by spt_field_default() */
    spt_distance_batch_fn *batch; /* preferred */
    spt_distance_fn *point;       /* used where batch is NULL; one of the two must be there */
    void *user;                   /* handed to the callbacks, never read here */
    float lipschitz;              /* |f(p) - f(q)| <= lipschitz |p - q|. Default 1; from 2^-100 to
                                   * 2^100. The library divides by it */
    uint32_t flags;               /* SPT_FIELD_CONVEX or 0 */
    const spt_bound *bound;       /* a convex volume that contains the whole surface, or NULL. Rays
                                   * are traced only inside it; coordinates below 1e19 */
    const char *glsl;             /* body of float NAME(vec3 p), the same field for a shader, or
                                   * NULL. The library's own fields set it to a mark: who replaces
                                   * their callbacks replaces this, too. Not read when tracing, see
                                   * glsl.h */
    const char *glsl_prelude;     /* functions which that body needs, or NULL */
    spt_gradient_batch_fn *gradient; /* for normals (surface.h), or NULL: differences of f. Not read
                                      * when tracing */
} spt_field;

/* A field without callbacks: lipschitz 1, no flags, no bound. */
static inline spt_field spt_field_default(void) {
    spt_field field = {0, NULL, NULL, NULL, 1.0f, 0, NULL, NULL, NULL, NULL};
    field.struct_size = sizeof field;
    return field;
}

/* The caller's clock: seconds from any fixed moment, as a process CPU time where there is one. */
typedef double spt_clock_fn(void *user);

typedef struct spt_field_cost {
    double nanoseconds_16;  /* per evaluation, called with n = 16 */
    double nanoseconds_256; /* per evaluation, called with n = SPT_BATCH */
} spt_field_cost;

/* What one evaluation of a field costs, by the caller's clock, at points spread over its bound
 * (over [-1, 1]^3 without one). A callback that vectorised costs a fraction of its scalar loop; a
 * large ratio of the two figures means a heavy fixed cost a call (normal for a few operations).
 * Takes about 20 ms with a clock of microseconds, and as many times 16 ticks of a coarser one; it
 * gives up after 2^26 evaluations a round. Returns SPT_BAD_ARGUMENT for a bad field or a NULL
 * pointer, SPT_UNSUPPORTED for a clock that stands still or is too coarse; cost is written only
 * with SPT_OK. */
SPT_API spt_status spt_field_measure(const spt_field *field, spt_clock_fn *clock, void *clock_user,
                                     spt_field_cost *cost);

/* What a sampled check of a field's promises found. Each count is of samples that broke one, by
 * more than rounding explains; `worst` is where the worst of its kind was seen. */
typedef struct spt_field_faults {
    uint32_t outside_bound;   /* f < 0 on the boundary of the bound: the body sticks out */
    uint32_t not_convex;      /* f at the middle of two points above the mean of both, with
                              * SPT_FIELD_CONVEX */
    uint32_t body_not_convex; /* f > 0 at the middle of two points inside: the body itself is not
                               * convex, as spt_trace_convex() needs it (surface.h) */
    uint32_t steep;           /* f changed by more than lipschitz times the distance, by 0.1 % */
    uint32_t nonfinite;       /* NaN or -infinity; such a sample is in no other count */
    float worst[5][3];        /* in the order above; zero where there was none */
} spt_field_faults;

/* Looks for broken promises at random points in and on the field's bound, for debug builds and
 * tests of callers: it reports instead of crashing, and finds a fault only where a sample shows it.
 * Pairs of points lie on random chords of the bound, each through a point of the last one (hit-and-
 * run; Smith 1984) or of the body.
 *   samples  pairs of points, 1 to 2^20; each costs about five evaluations
 *   seed     of the points: equal seeds, equal points
 * Returns SPT_BAD_ARGUMENT for a bad field, a NULL pointer or samples out of range, SPT_UNSUPPORTED
 * for a field without bound, with one of infinite extent, or with one in which no point is found.
 * faults is written only with SPT_OK. */
SPT_API spt_status spt_field_check(const spt_field *field, uint32_t samples, uint32_t seed,
                                   spt_field_faults *faults);

#ifdef __cplusplus
}
#endif
#endif
