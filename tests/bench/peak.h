/* SPDX-License-Identifier: MIT
 *
 * What the machine can do at most: the yardstick for the share of the limit. */
#ifndef TESTS_BENCH_PEAK_H
#define TESTS_BENCH_PEAK_H

/* Operations a nanosecond of one core. */
typedef struct peak {
    double flop;    /* multiplications and additions, one beside the other, not fused */
    double divider; /* square roots */
} peak;

/* The peak at a width: 1, 4, 8 or 16 lanes, of those that the build has and the machine runs. */
peak peak_of(int lanes);

#endif
