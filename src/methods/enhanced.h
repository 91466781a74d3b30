/* SPDX-License-Identifier: MIT
 *
 * Enhanced sphere tracing: planar extrapolation, a rejected probe is forgotten (Bálint & Valasek
 * 2018, Algorithm 3). */
#include "planar.h"

enum { rule_probes = 1, rule_pending = 0, rule_memory = 1, rule_blends = 0, rule_needs_convex = 0 };

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    (void)missed;
    return planar_step(parameters, at->radius, memory);
}
