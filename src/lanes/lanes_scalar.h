/* SPDX-License-Identifier: MIT
 *
 * One lane: plain C, for machines without vectors and as the yardstick of equal bits. */

SPTI_INLINE spt_wide spti_power_of_two(spt_wide a) {
    unsigned bits;
    memcpy(&bits, &a, sizeof bits);
    bits &= 0xff800000u;
    memcpy(&a, &bits, sizeof a);
    return a;
}

SPTI_INLINE void spti_compress(float *to, spt_wide a, unsigned keep) {
    (void)keep; /* a lane that is not kept is overwritten by the next one */
    *to = a;
}

SPTI_INLINE void spti_clear_upper(void) {
}
