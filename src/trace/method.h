/* SPDX-License-Identifier: MIT
 *
 * A step rule as the object that the public functions return: its traits and its kernels. */
#ifndef SPTI_METHOD_H
#define SPTI_METHOD_H

#include "../backend/isa.h"
#include "../base/glsl_piece.h"
#include "chunk.h"

struct spt_method {
    const char *name;
    unsigned char probes, pending, memory, blends, needs_convex; /* its traits (methods.h) */
    const spti_rule_glsl *glsl;
    spti_march_fn *const *march[SPTI_ISA_COUNT]; /* by instruction set, then by what is wanted */
};

#endif
