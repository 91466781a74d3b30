/* SPDX-License-Identifier: MIT
 *
 * Over-relaxation that is given up at a rejected probe, and taken up again after as many plain
 * steps as step_cap says; 100: never again (Keinert et al. 2014, section 3.1). REARM_PENDING:
 * whether rejected probes are kept. */
#include "../../../src/methods/methods.h"

enum {
    rule_probes = 1,
    rule_pending = REARM_PENDING,
    rule_memory = 1,
    rule_blends = 0,
    rule_needs_convex = 0
};

/* The memory counts plain steps since the last rejected probe, to 99; without one it is 100. */
SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(100.0f);
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    const spt_mask armed = spt_less_equal(parameters->step_cap, memory[0]);
    (void)missed;
    return spt_select(armed, spt_mul(parameters->relaxation, at->radius), at->radius);
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    const spt_mask never = spt_less_equal(spt_splat(100.0f), memory[0]);
    const spt_wide more = spt_min(spt_add(memory[0], spt_splat(1.0f)), spt_splat(99.0f));
    (void)parameters, (void)pair;
    memory[0] = spt_select(never, memory[0], more);
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    memory[0] = spt_splat(0.0f);
}
