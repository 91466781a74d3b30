/* SPDX-License-Identifier: MIT
 *
 * What the enhanced and the adaptive rule share: the planar extrapolation of Bálint & Valasek 2018,
 * section 3. The memory is the ratio of the next sphere's radius to this one's on the plane that
 * the last two samples see. */
#include "methods.h"

SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(0.0f); /* extrapolates to nothing: the first step is plain */
}

SPTI_INLINE spt_wide planar_step(const spti_parameters *parameters, spt_wide radius,
                                 const spt_wide *memory) {
    const spt_wide next = spt_mul(radius, memory[0]);
    return spt_add(radius, spt_mul(parameters->extrapolation, next));
}

/* Equation 1 with the drop of the radius clamped to [-0.98, 1] of the step, so that its divisor,
 * which is zero when a ray leaves a plane head-on, cannot be: at most 99. */
SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    const spt_wide steepest_rise = spt_mul(spt_splat(-0.98f), pair->step);
    spt_wide drop = spt_sub(pair->before, pair->after);
    (void)parameters;
    drop = spt_min(spt_max(drop, steepest_rise), pair->step);
    memory[0] = spt_div(spt_sub(pair->step, drop), spt_add(pair->step, drop));
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    (void)memory; /* the plain step that follows brings a new ratio */
}
