/* SPDX-License-Identifier: MIT
 *
 * Basic sphere tracing: steps of the certified radius (Hart 1996; Keinert et al. 2014, Listing 1;
 * Bálint & Valasek 2018, Algorithm 1). */
#include "methods.h"

enum { rule_probes = 0, rule_pending = 0, rule_memory = 0, rule_blends = 0, rule_needs_convex = 0 };

SPTI_INLINE void rule_start(spt_wide *memory) {
    (void)memory;
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    (void)parameters, (void)memory, (void)missed;
    return at->radius;
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    (void)parameters, (void)pair, (void)memory;
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    (void)memory;
}
