/* SPDX-License-Identifier: MIT
 *
 * The contract of the lanes: what kernels may do with SPT_LANES floats at once. The arithmetic is
 * the public simd.h; here are the operations that only the library needs. Each file of this
 * folder gives them for one instruction set, and no other file of src names an intrinsic. */
#ifndef SPTI_LANES_H
#define SPTI_LANES_H

#include <spheretrace/simd.h>

#include "../base/compiler.h"

/* The bits of a mask whose lanes are all true. */
#define SPTI_EVERY_LANE ((1u << (SPT_LANES - 1)) * 2u - 1u)

/* Every lane with its mantissa cleared: the power of two at or below a positive normal number. */
SPTI_INLINE spt_wide spti_power_of_two(spt_wide a);

/* Writes the lanes whose bit is set in keep (bit i for lane i), in order, from `to` on. Writes a
 * whole vector; what stands behind the kept lanes is undefined. */
SPTI_INLINE void spti_compress(float *to, spt_wide a, unsigned keep);

/* Called last in a kernel: leaves the upper halves of the registers clean, as callers compiled for
 * narrower vectors want them. Compilers do that by themselves only when they optimise. */
SPTI_INLINE void spti_clear_upper(void);

/* mask and a < b; mask and not a < b, so true for NaN. One instruction where masks are registers of
 * their own. */
SPTI_INLINE spt_mask spti_less_in(spt_mask mask, spt_wide a, spt_wide b);
SPTI_INLINE spt_mask spti_not_less_in(spt_mask mask, spt_wide a, spt_wide b);
SPTI_INLINE spt_mask spti_mask_not(spt_mask a);

#if SPT_LANES == 16
#include "lanes_avx512.h"
#elif SPT_LANES == 8
#include "lanes_avx2.h"
#elif SPT_LANES == 4
#include "lanes_sse.h"
#else
#include "lanes_scalar.h"
#endif

#if SPT_LANES < 16
SPTI_INLINE spt_mask spti_less_in(spt_mask mask, spt_wide a, spt_wide b) {
    return spt_mask_and(mask, spt_less(a, b));
}

SPTI_INLINE spt_mask spti_not_less_in(spt_mask mask, spt_wide a, spt_wide b) {
    return spt_mask_and_not(mask, spt_less(a, b));
}

SPTI_INLINE spt_mask spti_mask_not(spt_mask a) {
    return spt_mask_and_not(spt_mask_splat(1), a);
}
#endif

#endif
