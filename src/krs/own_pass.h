/* SPDX-License-Identifier: MIT
 *
 * The driver with a pass of this room's in the place of a step rule's. */
#ifndef SPTI_OWN_PASS_H
#define SPTI_OWN_PASS_H

#include "../trace/driver.h"

/* What a callback that is asked for a chunk's points sees of it besides: first in what user points
 * to. */
typedef struct spti_own_field {
    const spti_chunk *chunk;
} spti_own_field;

/* The four numbers of the pass, where the driver keeps those of a step rule. */
typedef struct spti_own_numbers {
    float number[4];
} spti_own_numbers;

static inline spti_own_numbers spti_own_numbers_of(const spti_march *march) {
    const spti_own_numbers numbers = {
        {march->relaxation, march->extrapolation, march->slope_blend, march->step_cap}};
    return numbers;
}

/* Traces rays through a field whose user begins with a spti_own_field; two floats a ray, SPTI_MEMORY
 * and the next, are the pass's. The field and its bound are in call, the rest of it is zero. Checks
 * what spt_trace() checks of the rest. */
spt_status spti_trace_by(spti_call *call, spti_own_field *own, spti_march_fn *pass,
                         const spti_own_numbers *numbers, const spt_settings *settings,
                         size_t count, const spt_rays *rays, const spt_hits *hits,
                         spt_statistics *statistics);

#endif
