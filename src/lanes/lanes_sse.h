/* SPDX-License-Identifier: MIT
 *
 * Four lanes: SSE2, with the byte shuffle of SSSE3 where the file is compiled for it. */

SPTI_INLINE spt_wide spti_power_of_two(spt_wide a) {
    return _mm_and_ps(a, _mm_castsi128_ps(_mm_set1_epi32((int)0xff800000u)));
}

#ifdef __SSSE3__
#define SPTI_LANE(i) 4 * (i), 4 * (i) + 1, 4 * (i) + 2, 4 * (i) + 3
#define SPTI_ROW(a, b, c, d) \
    { SPTI_LANE(a), SPTI_LANE(b), SPTI_LANE(c), SPTI_LANE(d) }
SPTI_INLINE void spti_compress(float *to, spt_wide a, unsigned keep) {
    static const SPTI_ALIGNED(16) unsigned char kept_bytes[16][16] = {
        SPTI_ROW(0, 0, 0, 0), SPTI_ROW(0, 0, 0, 0), SPTI_ROW(1, 0, 0, 0), SPTI_ROW(0, 1, 0, 0),
        SPTI_ROW(2, 0, 0, 0), SPTI_ROW(0, 2, 0, 0), SPTI_ROW(1, 2, 0, 0), SPTI_ROW(0, 1, 2, 0),
        SPTI_ROW(3, 0, 0, 0), SPTI_ROW(0, 3, 0, 0), SPTI_ROW(1, 3, 0, 0), SPTI_ROW(0, 1, 3, 0),
        SPTI_ROW(2, 3, 0, 0), SPTI_ROW(0, 2, 3, 0), SPTI_ROW(1, 2, 3, 0), SPTI_ROW(0, 1, 2, 3)};
    const __m128i bytes = _mm_load_si128((const __m128i *)kept_bytes[keep]);
    _mm_storeu_ps(to, _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), bytes)));
}
#undef SPTI_ROW
#undef SPTI_LANE
#else
SPTI_INLINE void spti_compress(float *to, spt_wide a, unsigned keep) {
    SPTI_ALIGNED(16) float from[4];
    _mm_store_ps(from, a);
    for (unsigned lane = 0; lane < 4; ++lane) {
        *to = from[lane];
        to += (keep >> lane) & 1;
    }
}
#endif

SPTI_INLINE void spti_clear_upper(void) {
}
