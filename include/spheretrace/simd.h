/* SPDX-License-Identifier: MIT
 *
 * A lane type for callers who write SIMD callbacks by hand: SPT_LANES floats in one value, and the
 * operations on them. For what a compiler does not vectorise by itself, loops with an early exit
 * above all; a plain loop over the points needs nothing of this.
 * Left out: integers, shuffles, anything that mixes lanes.
 *
 * The width follows the flags of the file: 16 with AVX-512F, 8 with AVX2, 4 with SSE2, else 1; a
 * file may define SPT_LANES to a narrower one first. One file has one width.
 *
 * Each operation is one IEEE operation per lane, so that a callback gives the same bits at every
 * width as long as the file is compiled with -ffp-contract=off (compilers fuse a * b + c out of
 * intrinsics, too). */
#ifndef SPHERETRACE_SIMD_H
#define SPHERETRACE_SIMD_H

#include <math.h>
#include <string.h>

#ifndef SPT_LANES
#if defined(__AVX512F__)
#define SPT_LANES 16
#elif defined(__AVX2__)
#define SPT_LANES 8
#elif defined(__SSE2__)
#define SPT_LANES 4
#else
#define SPT_LANES 1
#endif
#endif

#if SPT_LANES > 1
#include <immintrin.h>
#endif

#if defined(__GNUC__)
#define SPT_INLINE static inline __attribute__((always_inline, unused))
#else
#define SPT_INLINE static inline
#endif

/* spt_wide holds SPT_LANES floats, spt_mask one truth value a lane. Neither is an array in memory:
 * keep floats there, and load and store. */
#if SPT_LANES == 16
typedef __m512 spt_wide;
typedef __mmask16 spt_mask;
#elif SPT_LANES == 8
typedef __m256 spt_wide;
typedef __m256 spt_mask;
#elif SPT_LANES == 4
typedef __m128 spt_wide;
typedef __m128 spt_mask;
#elif SPT_LANES == 1
typedef float spt_wide;
typedef int spt_mask;
#else
#error "SPT_LANES must be 1, 4, 8 or 16"
#endif

/* SPT_LANES floats from memory of any alignment. */
SPT_INLINE spt_wide spt_load(const float *from) {
#if SPT_LANES == 16
    return _mm512_loadu_ps(from);
#elif SPT_LANES == 8
    return _mm256_loadu_ps(from);
#elif SPT_LANES == 4
    return _mm_loadu_ps(from);
#else
    return *from;
#endif
}

/* SPT_LANES floats to memory of any alignment. */
SPT_INLINE void spt_store(float *to, spt_wide a) {
#if SPT_LANES == 16
    _mm512_storeu_ps(to, a);
#elif SPT_LANES == 8
    _mm256_storeu_ps(to, a);
#elif SPT_LANES == 4
    _mm_storeu_ps(to, a);
#else
    *to = a;
#endif
}

/* The same value in every lane. */
SPT_INLINE spt_wide spt_splat(float a) {
#if SPT_LANES == 16
    return _mm512_set1_ps(a);
#elif SPT_LANES == 8
    return _mm256_set1_ps(a);
#elif SPT_LANES == 4
    return _mm_set1_ps(a);
#else
    return a;
#endif
}

/* a + b */
SPT_INLINE spt_wide spt_add(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_add_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_add_ps(a, b);
#elif SPT_LANES == 4
    return _mm_add_ps(a, b);
#else
    return a + b;
#endif
}

/* a - b */
SPT_INLINE spt_wide spt_sub(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_sub_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_sub_ps(a, b);
#elif SPT_LANES == 4
    return _mm_sub_ps(a, b);
#else
    return a - b;
#endif
}

/* a * b */
SPT_INLINE spt_wide spt_mul(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_mul_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_mul_ps(a, b);
#elif SPT_LANES == 4
    return _mm_mul_ps(a, b);
#else
    return a * b;
#endif
}

/* a / b, correctly rounded */
SPT_INLINE spt_wide spt_div(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_div_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_div_ps(a, b);
#elif SPT_LANES == 4
    return _mm_div_ps(a, b);
#else
    return a / b;
#endif
}

/* The square root, correctly rounded; NaN below zero. */
SPT_INLINE spt_wide spt_sqrt(spt_wide a) {
#if SPT_LANES == 16
    return _mm512_sqrt_ps(a);
#elif SPT_LANES == 8
    return _mm256_sqrt_ps(a);
#elif SPT_LANES == 4
    return _mm_sqrt_ps(a);
#else
    return sqrtf(a);
#endif
}

/* a < b ? a : b, so b where either is NaN or both are zeros. */
SPT_INLINE spt_wide spt_min(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_min_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_min_ps(a, b);
#elif SPT_LANES == 4
    return _mm_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}

/* a > b ? a : b, so b where either is NaN or both are zeros. */
SPT_INLINE spt_wide spt_max(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_max_ps(a, b);
#elif SPT_LANES == 8
    return _mm256_max_ps(a, b);
#elif SPT_LANES == 4
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}

/* The magnitude; clears the sign bit, of NaN too. */
SPT_INLINE spt_wide spt_abs(spt_wide a) {
#if SPT_LANES == 16
    return _mm512_abs_ps(a);
#elif SPT_LANES == 8
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
#elif SPT_LANES == 4
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
#else
    return fabsf(a);
#endif
}

/* a < b; false for NaN. */
SPT_INLINE spt_mask spt_less(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
#elif SPT_LANES == 8
    return _mm256_cmp_ps(a, b, _CMP_LT_OQ);
#elif SPT_LANES == 4
    return _mm_cmplt_ps(a, b);
#else
    return a < b;
#endif
}

/* a <= b; false for NaN. */
SPT_INLINE spt_mask spt_less_equal(spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
#elif SPT_LANES == 8
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
#elif SPT_LANES == 4
    return _mm_cmple_ps(a, b);
#else
    return a <= b;
#endif
}

/* Both. */
SPT_INLINE spt_mask spt_mask_and(spt_mask a, spt_mask b) {
#if SPT_LANES == 16
    return _mm512_kand(a, b);
#elif SPT_LANES == 8
    return _mm256_and_ps(a, b);
#elif SPT_LANES == 4
    return _mm_and_ps(a, b);
#else
    return a & b;
#endif
}

/* Either. */
SPT_INLINE spt_mask spt_mask_or(spt_mask a, spt_mask b) {
#if SPT_LANES == 16
    return _mm512_kor(a, b);
#elif SPT_LANES == 8
    return _mm256_or_ps(a, b);
#elif SPT_LANES == 4
    return _mm_or_ps(a, b);
#else
    return a | b;
#endif
}

/* a but not b. */
SPT_INLINE spt_mask spt_mask_and_not(spt_mask a, spt_mask b) {
#if SPT_LANES == 16
    return _mm512_kandn(b, a);
#elif SPT_LANES == 8
    return _mm256_andnot_ps(b, a);
#elif SPT_LANES == 4
    return _mm_andnot_ps(b, a);
#else
    return a & !b;
#endif
}

/* Every lane the same truth value: 0 or 1. */
SPT_INLINE spt_mask spt_mask_splat(int truth) {
#if SPT_LANES == 16
    return (__mmask16)(-truth);
#elif SPT_LANES == 8
    return _mm256_castsi256_ps(_mm256_set1_epi32(-truth));
#elif SPT_LANES == 4
    return _mm_castsi128_ps(_mm_set1_epi32(-truth));
#else
    return truth;
#endif
}

/* Lane by lane: a where the mask is true, else b. Copies bits. */
SPT_INLINE spt_wide spt_select(spt_mask mask, spt_wide a, spt_wide b) {
#if SPT_LANES == 16
    return _mm512_mask_blend_ps(mask, b, a);
#elif SPT_LANES == 8
    return _mm256_blendv_ps(b, a, mask);
#elif SPT_LANES == 4
    return _mm_or_ps(_mm_and_ps(mask, a), _mm_andnot_ps(mask, b));
#else
    return mask ? a : b;
#endif
}

/* The mask as an integer: bit i for lane i. */
SPT_INLINE unsigned spt_mask_bits(spt_mask a) {
#if SPT_LANES == 16
    return (unsigned)a;
#elif SPT_LANES == 8
    return (unsigned)_mm256_movemask_ps(a);
#elif SPT_LANES == 4
    return (unsigned)_mm_movemask_ps(a);
#else
    return (unsigned)a;
#endif
}

/* Whether any lane is true. */
SPT_INLINE int spt_any(spt_mask a) {
    return spt_mask_bits(a) != 0;
}

#endif
