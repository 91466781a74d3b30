/* SPDX-License-Identifier: MIT
 *
 * What the enhanced and the adaptive rule share: the planar extrapolation of Bálint & Valasek 2018,
 * section 3. The memory is m, the descent of the radius per unit of t between the last two samples;
 * on a plane it is the cosine to the normal. */
#include "methods.h"

SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(1.0f); /* extrapolates to nothing: the first step is plain */
}

/* Equation 1 divides by step + before - after, which is zero when a ray leaves a plane head-on.
 * Written with m = (before - after) / step clamped, the same radius cannot: at most 99 r. */
SPTI_INLINE spt_wide planar_step(const spti_parameters *parameters, spt_wide radius, spt_wide m) {
    const spt_wide one = spt_splat(1.0f);
    const spt_wide next = spt_mul(radius, spt_div(spt_sub(one, m), spt_add(one, m)));
    return spt_add(radius, spt_mul(parameters->extrapolation, next));
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    const spt_wide m = spt_div(spt_sub(pair->before, pair->after), pair->step);
    (void)parameters;
    memory[0] = spt_min(spt_max(m, spt_splat(-0.98f)), spt_splat(1.0f));
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    (void)memory; /* the plain step that follows brings a new m */
}
