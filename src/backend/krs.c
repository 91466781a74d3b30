/* SPDX-License-Identifier: MIT
 *
 * One instance of the kernels for kernel-reflection sequences. The Makefile compiles this file once
 * for every instruction set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../krs/fold_kernel.h"
#include "../krs/pull_kernel.h"

static void fold(const spti_stretch *stretch, size_t n, const spti_way *way) {
    fold_stretch(stretch, n, way);
    spti_clear_upper();
}

static void pull(const spti_stretch *stretch, size_t n, const spti_way *way) {
    pull_stretch(stretch, n, way);
    spti_clear_upper();
}

static void probe(const spti_stretch *stretch, size_t n, const spti_way *way) {
    probe_stretch(stretch, n, way);
    spti_clear_upper();
}

#define KERNELS SPTI_JOIN2(spti_krs_kernels, SPTI_ISA)
extern const spti_krs_kernels KERNELS;
const spti_krs_kernels KERNELS = {fold, pull, probe};
