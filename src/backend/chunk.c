/* SPDX-License-Identifier: MIT
 *
 * One instance of the chunk kernels. The Makefile compiles this file once for every instruction
 * set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../trace/compact_kernel.h"
#include "../trace/prepare_kernel.h"

#define PREPARE SPTI_JOIN2(spti_prepare, SPTI_ISA)
#define COMPACT SPTI_JOIN2(spti_compact, SPTI_ISA)
#define LIST SPTI_JOIN2(spti_list, SPTI_ISA)

spti_prepare_fn PREPARE;
int PREPARE(spti_chunk *chunk, const spti_march *march, size_t count) {
    const int any = prepare_pass(chunk, march, count);
    spti_clear_upper();
    return any;
}

spti_compact_fn COMPACT;
size_t COMPACT(spti_chunk *chunk, const unsigned char *arrays, size_t array_count, size_t count) {
    const size_t remain = compact_pass(chunk, arrays, array_count, count);
    spti_clear_upper();
    return remain;
}

spti_list_fn LIST;
size_t LIST(const spti_chunk *chunk, size_t count, uint16_t slots[SPT_BATCH]) {
    const size_t listed = list_pass(chunk, count, slots);
    spti_clear_upper();
    return listed;
}
