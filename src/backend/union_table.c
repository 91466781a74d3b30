/* SPDX-License-Identifier: MIT
 *
 * The lazy union's kernels by instruction set. */
#include "../scene/union.h"

#define X(name, lanes) extern const spti_union_kernels spti_union_kernels_##name;
SPTI_ISAS(X)
#undef X

const spti_union_kernels *const spti_union_kernels_of[] = {
#define X(name, lanes) &spti_union_kernels_##name,
    SPTI_ISAS(X)
#undef X
};
