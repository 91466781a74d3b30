/* SPDX-License-Identifier: MIT
 *
 * The truth about a union of fields: every component asked in double at every small step, up to
 * 10 000 of them a ray. No bounds, no order, nothing lazy. */
#ifndef TESTS_ORACLE_SCENE_UNION_H
#define TESTS_ORACLE_SCENE_UNION_H

#include "scene_run.h"

/* The values of component index at n points. */
typedef void union_values_fn(const void *user, size_t index, size_t n, const double *x,
                             const double *y, const double *z, double *distance);

typedef struct union_field {
    union_values_fn *values;
    const void *user;
    const spt_field *fields; /* for their Lipschitz constants */
    size_t count;
} union_field;

/* What is true of a ray. Distances are f / lipschitz, with the sign that they have where the ray
 * starts: a ray that begins in a component looks for the way out of it.
 *   t          the first zero of any component, +infinity where there is none
 *   near       between here and
 *   deep       there a tracer with the tolerance of the settings may say it hit: before near all
 *              are farther than the tolerance, at deep one is deeper than the tolerance and twice
 *              the rounding of a float
 *   component  the one that is nearest at t; its distance there is below every other's by
 *   lead       this much
 *   inside     whether the ray begins in any component
 *   clear      no component comes nearer than gap except to be hit, and then near and deep are at
 *              most 0.05 apart; it neither starts nor ends (at t_max) within gap of a surface. For
 *              such rays hit or miss is decided */
typedef struct union_truth {
    double t, near, deep, lead;
    int32_t component;
    int inside, clear;
} union_truth;

static const double union_gap = 0.02;

void union_find_truth(const union_field *field, const spt_settings *settings, size_t count,
                      const scene_ray *rays, union_truth *truth);

/* Checks hits against it where it is clear: outcome, t between near and deep and by row Q1, and
 * the component that was hit. Returns how many rays were clear, and of these how many were hits
 * through hit_count. */
size_t union_check(const union_field *field, const spt_settings *settings, size_t count,
                   const scene_ray *rays, const union_truth *truth, const spt_hit *hits,
                   size_t *hit_count);

#endif
