/* SPDX-License-Identifier: MIT
 *
 * The kernels for kernel-reflection sequences by instruction set. */
#include "../krs/sequence.h"

#define X(name, lanes) extern const spti_krs_kernels spti_krs_kernels_##name;
SPTI_ISAS(X)
#undef X

const spti_krs_kernels *const spti_krs_kernels_of[] = {
#define X(name, lanes) &spti_krs_kernels_##name,
    SPTI_ISAS(X)
#undef X
};
