/* SPDX-License-Identifier: MIT
 *
 * A step rule as the object that the public functions return: its traits and its kernels. */
#ifndef SPTI_METHOD_H
#define SPTI_METHOD_H

#include "../backend/isa.h"
#include "chunk.h"

struct spt_method {
    const char *name;
    unsigned char pending, memory, needs_convex; /* its traits (methods/methods.h) */
    spti_march_fn *const *march[SPTI_ISA_COUNT]; /* by instruction set, then by what is wanted */
};

#endif
