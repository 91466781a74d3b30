/* SPDX-License-Identifier: MIT
 *
 * One instance of the lazy union's kernels. The Makefile compiles this file once for every
 * instruction set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../scene/union_kernel.h"

static void begin(spti_union *lazy, size_t window, size_t count) {
    union_begin(lazy, window, count);
    spti_clear_upper();
}

static void enter(spti_union *lazy, size_t place, const float *starts) {
    union_enter(lazy, place, starts);
    spti_clear_upper();
}

static int plan(spti_union *lazy) {
    const int any = union_plan(lazy);
    spti_clear_upper();
    return any;
}

static size_t take(spti_union *lazy, int kind, size_t *group) {
    const size_t count = union_take(lazy, kind, group);
    spti_clear_upper();
    return count;
}

static int stop(spti_chunk *chunk, size_t count) {
    const int any = union_stop(chunk, count);
    spti_clear_upper();
    return any;
}

#define KERNELS SPTI_JOIN2(spti_union_kernels, SPTI_ISA)
extern const spti_union_kernels KERNELS;
const spti_union_kernels KERNELS = {begin, enter, plan, take, stop};
