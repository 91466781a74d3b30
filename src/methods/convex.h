/* SPDX-License-Identifier: MIT
 *
 * The secant step for convex functions. Along a ray f lies above its secant outside the two
 * samples, so the secant's root is certified, and a rising f never comes down again. Half the
 * rounding floor covers the rounding of f: without it one of 504 grazing rays was lost.
 * For a start inside, -f is concave and the argument fails: plain steps. */
#include <float.h>

#include "methods.h"

enum { rule_probes = 0, rule_pending = 0, rule_memory = 2, rule_blends = 0, rule_needs_convex = 1 };

/* The memory is the last step and the radius before it; a first step is recognised by its zero. */
SPTI_INLINE void rule_start(spt_wide *memory) {
    memory[0] = spt_splat(0.0f);
    memory[1] = spt_splat(0.0f);
}

SPTI_INLINE spt_wide rule_step(const spti_parameters *parameters, const spti_standing *at,
                               const spt_wide *memory, spt_mask *missed) {
    const spt_wide zero = spt_splat(0.0f);
    const spt_wide margin = spt_mul(spt_splat(0.5f), at->floor);
    const spt_wide drop = spt_add(spt_sub(memory[1], at->radius), spt_add(margin, margin));
    const spt_mask secant = spt_mask_and(at->outside, spt_less(zero, memory[0]));
    const spt_mask falling = spt_mask_and(secant, spt_less(zero, drop));
    const spt_wide least = spt_splat(FLT_MIN);
    /* A ratio first: the product of two lengths underflows in scenes of 1e-16. The first step's zero
     * must not meet an infinite one. */
    const spt_wide ratio = spt_div(spt_sub(at->radius, margin), spt_max(drop, least));
    const spt_wide step = spt_mul(ratio, spt_max(memory[0], least));
    (void)parameters;
    *missed = spt_mask_and_not(secant, falling);
    return spt_select(falling, step, at->radius);
}

SPTI_INLINE void rule_accepted(const spti_parameters *parameters, const spti_pair *pair,
                               spt_wide *memory) {
    (void)parameters;
    memory[0] = pair->step;
    memory[1] = pair->before;
}

SPTI_INLINE void rule_rejected(spt_wide *memory) {
    (void)memory;
}
