/* SPDX-License-Identifier: MIT
 *
 * The readable reference of the tracer: one ray, one textbook loop, in double precision, with every
 * step rule and the outcomes of trace.h. Slow on purpose.
 * Left out: bounds, batches, strided views, argument checks. */
#ifndef TESTS_ORACLE_REFERENCE_H
#define TESTS_ORACLE_REFERENCE_H

#include <spheretrace/trace.h>

/* Build with -DREFERENCE_REAL=float to see what the same loop does in the library's precision. */
#ifndef REFERENCE_REAL
#define REFERENCE_REAL double
#endif
typedef REFERENCE_REAL real;

typedef real reference_distance_fn(const void *user, const real position[3]);

typedef struct reference_field {
    reference_distance_fn *distance;
    const void *user;
    real lipschitz;
} reference_field;

typedef enum reference_rule {
    REFERENCE_BASIC,
    REFERENCE_RELAXED,
    REFERENCE_ENHANCED,
    REFERENCE_AUTO_RELAXED,
    REFERENCE_ADAPTIVE,
    REFERENCE_CONVEX,
    REFERENCE_RULES
} reference_rule;

/* The fields of spt_settings of the same names. */
typedef struct reference_settings {
    reference_rule rule;
    uint32_t budget, flags;
    real epsilon, pixel_radius, size, relaxation, extrapolation, slope_blend, step_cap;
} reference_settings;

typedef struct reference_ray {
    real origin[3], direction[3], t_min, t_max, path;
} reference_ray;

/* The fields of spt_hit of the same names. largest_slope: of f between verified samples, beyond
 * what rounding explains; 0 where there was no pair. */
typedef struct reference_hit {
    spt_outcome outcome;
    uint32_t evaluations, flags, fallbacks;
    real t, residual, candidate_t, candidate_ratio, largest_slope;
} reference_hit;

reference_settings reference_settings_of(const spt_settings *settings, reference_rule rule);
reference_ray reference_ray_of(const spt_ray *ray);

reference_hit reference_trace(const reference_field *field, const reference_settings *settings,
                              const reference_ray *ray);

#endif
