/* SPDX-License-Identifier: MIT
 *
 * Over-relaxation that is given up at a rejected probe, and taken up again as soon as the radius
 * grows: when the surface that was in the way is passed. */
#include "../../../src/methods/methods.h"

enum { rule_probes = 1, rule_pending = 1, rule_memory = 1, rule_blends = 0, rule_needs_convex = 0 };

/* The memory is 1 while steps are plain. */
SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(0.0f);
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    const spt_mask plain = spt_less(spt_splat(0.0f), memory[0]);
    (void)missed;
    return spt_select(plain, at->radius, spt_mul(parameters->relaxation, at->radius));
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    const spt_mask grows = spt_less(pair->before, pair->after);
    (void)parameters;
    memory[0] = spt_select(grows, spt_splat(0.0f), memory[0]);
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    memory[0] = spt_splat(1.0f);
}
