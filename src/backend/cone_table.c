/* SPDX-License-Identifier: MIT
 *
 * The kernels for cameras and cones by instruction set. */
#include "../frame/bundle.h"

#define X(name, lanes) extern const spti_cone_kernels spti_cone_kernels_##name;
SPTI_ISAS(X)
#undef X

const spti_cone_kernels *const spti_cone_kernels_of[] = {
#define X(name, lanes) &spti_cone_kernels_##name,
    SPTI_ISAS(X)
#undef X
};
