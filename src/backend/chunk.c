/* SPDX-License-Identifier: MIT
 *
 * One instance of the chunk kernels. The Makefile compiles this file once for every instruction
 * set, with SPTI_PREPARE, SPTI_COMPACT (the names) and SPT_LANES defined. */
#include "../trace/compact_kernel.h"
#include "../trace/prepare_kernel.h"

spti_prepare_fn SPTI_PREPARE;
int SPTI_PREPARE(spti_chunk *chunk, const spti_march *march, size_t count) {
    const int any = prepare_pass(chunk, march, count);
    spti_clear_upper();
    return any;
}

spti_compact_fn SPTI_COMPACT;
size_t SPTI_COMPACT(spti_chunk *chunk, const unsigned char *arrays, size_t array_count,
                    size_t count) {
    const size_t remain = compact_pass(chunk, arrays, array_count, count);
    spti_clear_upper();
    return remain;
}
