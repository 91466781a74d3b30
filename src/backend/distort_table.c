/* SPDX-License-Identifier: MIT
 *
 * The kernels for distorted fields by instruction set. */
#include "../krs/distort.h"

#define X(name, lanes) extern const spti_distort_kernels spti_distort_kernels_##name;
SPTI_ISAS(X)
#undef X

const spti_distort_kernels *const spti_distort_kernels_of[] = {
#define X(name, lanes) &spti_distort_kernels_##name,
    SPTI_ISAS(X)
#undef X
};
