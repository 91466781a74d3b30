/* SPDX-License-Identifier: MIT
 *
 * Sixteen lanes: AVX-512F. */

SPTI_INLINE spt_wide spti_power_of_two(spt_wide a) {
    return _mm512_castsi512_ps(
        _mm512_and_epi32(_mm512_castps_si512(a), _mm512_set1_epi32((int)0xff800000u)));
}

SPTI_INLINE void spti_compress(float *to, spt_wide a, unsigned keep) {
    /* In a register and stored whole: compressing to memory costs 25 times as much on Zen 4. */
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps((__mmask16)keep, a));
}

SPTI_INLINE void spti_clear_upper(void) {
    _mm256_zeroupper();
}

SPTI_INLINE spt_mask spti_less_in(spt_mask mask, spt_wide a, spt_wide b) {
    return _mm512_mask_cmp_ps_mask(mask, a, b, _CMP_LT_OQ);
}

SPTI_INLINE spt_mask spti_not_less_in(spt_mask mask, spt_wide a, spt_wide b) {
    return _mm512_mask_cmp_ps_mask(mask, a, b, _CMP_NLT_UQ);
}

SPTI_INLINE spt_mask spti_mask_not(spt_mask a) {
    return _mm512_knot(a);
}
