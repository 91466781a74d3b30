/* SPDX-License-Identifier: MIT
 *
 * Omega from the slope of the radius along the ray, as the auto-relaxed rule measures it (Ban &
 * Valasek 2023), but never more than relaxation. */
#include "../../../src/methods/methods.h"

enum { rule_probes = 1, rule_pending = 1, rule_memory = 1, rule_blends = 1, rule_needs_convex = 0 };

/* The memory is the running average of the slope; -1 makes plain steps. */
SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(-1.0f);
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    const spt_wide slope = spt_min(memory[0], spt_splat(0.98f));
    const spt_wide factor = spt_div(spt_splat(2.0f), spt_sub(spt_splat(1.0f), slope));
    (void)missed;
    return spt_mul(spt_min(factor, parameters->relaxation), at->radius);
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    const spt_wide newest = spt_div(spt_sub(pair->after, pair->before), pair->step);
    const spt_wide change = spt_mul(parameters->slope_blend, spt_sub(newest, memory[0]));
    memory[0] = spt_add(memory[0], change);
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    memory[0] = spt_splat(-1.0f);
}
