/* SPDX-License-Identifier: MIT
 *
 * The opponent: what an expert writes who needs one scene and one step rule and has no vectors. One
 * ray at a time, the distance inlined, no audit; the same rule, stop and rounding as the library,
 * so that every result has the same bits. */
#ifndef TESTS_BENCH_SCALAR_LOOP_H
#define TESTS_BENCH_SCALAR_LOOP_H

#include <spheretrace/trace.h>

/* What both sides of the race write. */
typedef struct bench_hit {
    float t, residual;
    int32_t outcome;
    uint32_t evaluations;
} bench_hit;

/* Traces count rays as spt_trace() does with a finite t_max, a direction near length 1 and no
 * flags. field: its lipschitz and its bound only. */
typedef void scalar_trace_fn(const spt_field *field, const spt_settings *settings, size_t count,
                             const spt_ray *rays, bench_hit *hits);

/* The loop for a scene and a step rule by name, or NULL. */
scalar_trace_fn *scalar_loop_of(const char *scene, const char *method);

#endif
