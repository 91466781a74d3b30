/* SPDX-License-Identifier: MIT
 *
 * One instance of the kernel that closes gaps. The Makefile compiles this file for the instruction
 * sets of chunk_table.c, with SPTI_ISA (the set's name) and SPT_LANES defined. */
#include "../trace/compact_kernel.h"

#define COMPACT SPTI_JOIN2(spti_compact, SPTI_ISA)

spti_compact_fn COMPACT;
size_t COMPACT(spti_chunk *chunk, const unsigned char *arrays, size_t array_count, size_t count) {
    const size_t remain = compact_pass(chunk, arrays, array_count, count);
    spti_clear_upper();
    return remain;
}
