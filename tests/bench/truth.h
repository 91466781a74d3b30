/* SPDX-License-Identifier: MIT
 *
 * Whether a tracer lost a surface: the judgement of a slow walk in double precision. */
#ifndef TESTS_BENCH_TRUTH_H
#define TESTS_BENCH_TRUTH_H

#include <scenes/scenes.h>

#include "scalar_loop.h"

/* The last t at which a hit may lie, by basic tracing in double with at most 10 000 steps: where
 * the field has first fallen deeper below zero than the tolerance of the settings and float
 * rounding explain, or where the ray leaves the body that it has entered. +infinity where nothing
 * that deep was found: no answer is then wrong. Of a field that is no distance bound it says what
 * the basic rule meets, and of other rules where they stop deeper than that. */
double truth_last_t(const scene *shown, const spt_settings *settings, const spt_ray *ray);

/* Whether a result overlooks that altogether. SPT_LIMIT is no answer, so not a wrong one. */
int truth_lost(double last_t, const bench_hit *hit);

/* Whether it is a hit, but behind that. */
int truth_late(double last_t, const bench_hit *hit);

#endif
