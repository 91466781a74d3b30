/* SPDX-License-Identifier: MIT
 *
 * One instance of the kernel that prepares rays. The Makefile compiles this file for the
 * instruction sets of chunk_table.c, with SPTI_ISA (the set's name) and SPT_LANES defined. */
#include "../trace/prepare_kernel.h"

#define PREPARE SPTI_JOIN2(spti_prepare, SPTI_ISA)

spti_prepare_fn PREPARE;
int PREPARE(spti_chunk *chunk, const spti_march *march, size_t count) {
    const int any = prepare_pass(chunk, march, count);
    spti_clear_upper();
    return any;
}
