/* SPDX-License-Identifier: MIT
 *
 * What surface.h says of every result of its calls, whatever the fields, rays and hits. What is
 * right for a given surface is not here. Knows nothing of check.h: the fuzzing harness uses it,
 * too. */
#ifndef TESTS_SURFACE_RESULTS_H
#define TESTS_SURFACE_RESULTS_H

#include "surface_calls.h"

/* What is known of a call beside its arguments. */
typedef struct surface_truth {
    /* f of a field at a point, the same as its callbacks gave; NULL where they cannot be asked
     * again. */
    float (*value)(const void *user, size_t field, float x, float y, float z);
    const void *user;
    /* No coordinate of a bound is larger in magnitude. */
    double size;
    /* What each output that the call reads or writes held before, by index; a crossing column
     * surface_most_crossings words a ray. */
    const uint32_t *before[surface_outputs];
} surface_truth;

/* The first broken promise in the results of a ray, hit, point or body, as text; NULL where there
 * is none. */
const char *surface_wrong(const surface_call *call, const surface_truth *truth, size_t index);

/* Whether the outputs of an index have the words of before, those that are only read included. */
int surface_untouched(const surface_call *call, const surface_truth *truth, size_t index);

/* Whether trace.h calls this a bad ray. */
int surface_ray_is_bad(const surface_call *call, size_t index);

/* The column active says that its results are left as they are. */
int surface_is_idle(const surface_call *call, size_t index);

/* The most evaluations that a call may spend on one index. */
uint64_t surface_most_evaluations(const surface_call *call);

#endif
