/* SPDX-License-Identifier: MIT
 *
 * The default: planar extrapolation that keeps rejected probes and is capped. What the cap saves is
 * probes that fail: from 3 to 6 evaluations fall by 1.9 %, and from there to none by 0.3 %. It
 * protects no field that breaks its promise: over 921 600 rays of a Mandelbulb estimate caps of 2 to
 * 10 lost 17 to 22, without order. */
#include "planar.h"

enum { rule_probes = 1, rule_pending = 1, rule_memory = 1, rule_blends = 0, rule_needs_convex = 0 };

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    (void)missed;
    return spt_min(planar_step(parameters, at->radius, memory),
                   spt_mul(parameters->step_cap, at->radius));
}
