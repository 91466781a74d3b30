/* SPDX-License-Identifier: MIT
 *
 * The chunk kernels by instruction set. */
#include "../trace/chunk.h"
#include "isa.h"

#define X(name, lanes) \
    spti_prepare_fn spti_prepare_##name; \
    spti_compact_fn spti_compact_##name; \
    spti_list_fn spti_list_##name;
SPTI_ISAS(X)
#undef X

const spti_chunk_kernels spti_chunk_kernels_of[] = {
#define X(name, lanes) {spti_prepare_##name, spti_compact_##name, spti_list_##name},
    SPTI_ISAS(X)
#undef X
};
