/* SPDX-License-Identifier: MIT
 *
 * Algorithm 3 of Szécsi et al. 2016 in double, as printed and with its faults mended one by one:
 * the negative controls of the tests of probes. */
#ifndef TESTS_ORACLE_MOEKRS_PRINTED_H
#define TESTS_ORACLE_MOEKRS_PRINTED_H

#include "moekrs_model.h"

/* What is mended; 0: as printed, with Appendix A, which is right. */
enum {
    PRINTED_SPHERE = 1u << 0,  /* lines 9, 10: center beta / alpha, radius from gamma / alpha */
    PRINTED_ORDER = 1u << 1,   /* line 11: K_(i+1) before mirror i, K_0 last; printed: K_i after */
    PRINTED_INSIDE = 1u << 2,  /* line 11: not unbounding unless alpha > 0, at every level and
                                * before the mirror; printed: if alpha < 0 when all is done */
    PRINTED_ORDERED = 1u << 3, /* line 11: not unbounding unless k >= rho; printed: if k < rho */
    PRINTED_COMMENT = 1u << 4, /* no mending: the mirror test by line 7's comment, x < 0, instead of
                                * its formula, which fires for x > 0 */
    PRINTED_MENDED = PRINTED_SPHERE | PRINTED_ORDER | PRINTED_INSIDE | PRINTED_ORDERED
};

/* nan_kernel: the number of a kernel whose distance is NaN, or -1. */
int printed_unbounding(const moekrs_model *model, unsigned mended, int nan_kernel,
                       const double center[3], double rho);

#endif
