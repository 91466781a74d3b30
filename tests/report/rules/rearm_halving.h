/* SPDX-License-Identifier: MIT
 *
 * Over-relaxation by what goes well: at each rejected probe the part of omega above 1 is halved,
 * with each certified sample an eighth of its most comes back (as senders on a network find their
 * rate: Chiu & Jain 1989). */
#include "../../../src/methods/methods.h"

enum { rule_probes = 1, rule_pending = 1, rule_memory = 1, rule_blends = 0, rule_needs_convex = 0 };

/* The memory is the share of relaxation - 1 that is used. */
SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(1.0f);
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    const spt_wide most = spt_sub(parameters->relaxation, spt_splat(1.0f));
    (void)missed;
    return spt_add(at->radius, spt_mul(spt_mul(most, memory[0]), at->radius));
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    (void)parameters, (void)pair;
    memory[0] = spt_min(spt_add(memory[0], spt_splat(0.125f)), spt_splat(1.0f));
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    memory[0] = spt_mul(spt_splat(0.5f), memory[0]);
}
