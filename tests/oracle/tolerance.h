/* SPDX-License-Identifier: MIT
 *
 * The tolerance law of trace.h in double, for rays without a path behind them. */
#ifndef TESTS_ORACLE_TOLERANCE_H
#define TESTS_ORACLE_TOLERANCE_H

#include <spheretrace/trace.h>

/* The length of a ray's direction. */
double oracle_length(const spt_ray *ray);

/* 2^-22 (|o|_inf + t |d| + size), world length. */
double oracle_floor(const spt_settings *settings, const spt_ray *ray, double t);

/* The greatest of epsilon, pixel cone and floor, world length. */
double oracle_tolerance(const spt_settings *settings, const spt_ray *ray, double t);

#endif
