/* SPDX-License-Identifier: MIT
 *
 * Algorithm 1 of Szécsi et al. 2016 in double, one point at a time, for models of more levels than
 * can be expanded and for what is blended on the way. Its distances are themselves tested against
 * expansions. */
#ifndef TESTS_ORACLE_KRS_FOLD_H
#define TESTS_ORACLE_KRS_FOLD_H

#include "krs_oracle.h"

typedef struct krs_folded {
    double distance;
    uint32_t kernel;       /* that has it: of equals the higher */
    uint64_t mirrors;      /* bit i: folded at mirror i, for i from the kernel's number on */
    double nearest_mirror; /* the least |e_i| of those mirrors */
    double at[SPT_KRS_LEVELS + 1][3]; /* the point that kernel i sees */
    double beyond[SPT_KRS_LEVELS];    /* e_i, before folding there */
    double normal[SPT_KRS_LEVELS][3]; /* unit */
} krs_folded;

void krs_fold(uint32_t levels, const spt_kernel *kernels, const spt_mirror *mirrors,
              const double p[3], krs_folded *folded);

/* The world normal, blended over `width` at the mirrors (section 8.1; algorithms.md 7.5): each
 * mirror turns the gradient by the share smoothstep(-width, width, e) of its reflection. 0: not
 * blended. What is left of the gradient's length before it is made one again is returned. */
double krs_fold_normal(const krs_folded *folded, uint32_t levels, const spt_kernel *kernels,
                       double width, double normal[3]);

#endif
