/* SPDX-License-Identifier: MIT
 *
 * One instance of the lazy union's kernels. The Makefile compiles this file once for every
 * instruction set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../scene/union_kernel.h"

static void units(spti_chunk *chunk, size_t count) {
    union_units(chunk, count);
    spti_clear_upper();
}

static void entries(const spti_chunk *chunk, const spt_bound *bound, size_t count, float *starts) {
    union_entries(chunk, bound, count, starts);
    spti_clear_upper();
}

static void least(const spti_union *lazy, size_t group_count) {
    union_least(lazy, group_count);
    spti_clear_upper();
}

static int stop(spti_chunk *chunk, size_t count) {
    const int any = union_stop(chunk, count);
    spti_clear_upper();
    return any;
}

#define KERNELS SPTI_JOIN2(spti_union_kernels, SPTI_ISA)
extern const spti_union_kernels KERNELS;
const spti_union_kernels KERNELS = {units, entries, least, stop};
