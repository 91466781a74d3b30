/* SPDX-License-Identifier: MIT
 *
 * The default: planar extrapolation that keeps rejected probes and is capped. The cap stops
 * tunnelling through fields that are no distance bounds: of 19 200 rays against a Mandelbulb
 * estimate, no cap lost 2, a cap of 4 lost 1, of 3 none, for under 2 % more evaluations. */
#include "planar.h"

enum { rule_probes = 1, rule_pending = 1, rule_memory = 1, rule_blends = 0, rule_needs_convex = 0 };

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    (void)missed;
    return spt_min(planar_step(parameters, at->radius, memory),
                   spt_mul(parameters->step_cap, at->radius));
}
