/* SPDX-License-Identifier: MIT
 *
 * THE LIST of step rules and what a rule consists of. A rule NAME is a file NAME.h in this folder,
 * a line in this list and a declaration in trace.h; the Makefile reads the list and builds an
 * object per rule and instruction set.
 *
 * NAME.h is a template parameter: it includes this header and defines, over the lanes,
 *     rule_probes        1: its steps may exceed the certified radius and must be tested
 *     rule_pending       1: a rejected probe is kept, and reached when a later sphere meets its own
 *     rule_memory        floats it keeps a ray: 0 to 2, at most 1 with rule_pending
 *     rule_blends        1: its memory adds to the one before, so that it must see every certified
 *                        sample; 0: only the last pair of samples matters to it
 *     rule_needs_convex  1: legal only for fields with SPT_FIELD_CONVEX
 *     rule_start(...)    the memory of a ray with one sample
 *     rule_step(...)     the step it would like to make
 *     rule_accepted(...) the memory after a certified sample
 *     rule_rejected(...) the memory after a probe that was turned down
 * The first five are constants, so that what a rule does not ask for leaves no code. Any step is
 * legal: the driver never goes less than the certified radius, tests each probe beyond it, and
 * keeps within t_max. */
#ifndef SPTI_METHODS_H
#define SPTI_METHODS_H

#include "../lanes/lanes.h"

#define SPTI_METHODS(X) \
    X(basic) \
    X(relaxed) \
    X(enhanced) \
    X(auto_relaxed) \
    X(adaptive) \
    X(convex)

/* The settings of the rules, in all lanes. */
typedef struct spti_parameters {
    spt_wide relaxation, extrapolation, slope_blend, step_cap;
} spti_parameters;

/* Where a ray stands when it is to make a step. */
typedef struct spti_standing {
    spt_wide radius;  /* of the certified sphere, in t */
    spt_wide floor;   /* what t resolves here */
    spt_mask outside; /* the ray looks for the way in */
} spti_standing;

/* The sample before and the sample now. The step is at least FLT_MIN, so that dividing by it raises
 * no exception. */
typedef struct spti_pair {
    spt_wide step, before, after;
} spti_pair;

#endif
