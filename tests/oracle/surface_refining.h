/* SPDX-License-Identifier: MIT
 *
 * One hit to be refined: the call, what holds of every result, and the same iteration in double. */
#ifndef TESTS_ORACLE_SURFACE_REFINING_H
#define TESTS_ORACLE_SURFACE_REFINING_H

#include "surface_oracle.h"

/* What is asked of the iteration. */
typedef struct refining_task {
    const reference_field *field;
    const spt_settings *settings;
    spt_ray ray;
    double path, side; /* side: -1 where the ray began inside */
} refining_task;

/* What the pixel cone allows f / lipschitz to be at t, and how far f is from it. */
double refining_allowance(const refining_task *what, double t);
double refining_off(const refining_task *what, double t, double f);

/* A finished hit, as if a trace had ended there. */
spt_hit refining_hit(const refining_task *what, float t);

/* spt_refine() for this one hit, its evaluations counted where single points are heard. */
spt_hit refining_run(const surface_run *run, const refining_task *what, uint32_t rounds,
                     const spt_hit *before);

/* Row Q21: |f - err| not larger than before, in [t_min, t_max], the move not longer than allowed, the
 * residual that of the new t, nothing else touched. */
void refining_check(const refining_task *what, uint32_t rounds, const spt_hit *before,
                    const spt_hit *after);

/* Equation 3 read as p + d (f - err), with the guards of the header: the t that it comes to. */
double refining_iterate(const refining_task *what, double t, double f, uint32_t rounds);

#endif
