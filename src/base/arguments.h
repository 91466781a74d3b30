/* SPDX-License-Identifier: MIT
 *
 * What the public doors share: copies of sized structures and tests of numbers. */
#ifndef SPTI_ARGUMENTS_H
#define SPTI_ARGUMENTS_H

#include <spheretrace/base.h>

#include <float.h>
#include <string.h>

#include "compiler.h"

/* The factor 4u of the rounding floor, u = 2^-24: a float32 hit is off by at most 2.5u of the
 * magnitudes that go into it (algorithms: section 0). */
#define SPTI_FLOOR 0x1p-22f

/* False for NaN as well as for the infinities. */
static inline int spti_finite(float a) {
    return a >= -FLT_MAX && a <= FLT_MAX;
}

static inline int spti_within(float a, float low, float high) {
    return a >= low && a <= high;
}

/* Copies a sized structure over a default one: as many bytes as both the caller's header and ours
 * know. Returns 0 where the caller's is older than the first version there was. Both structures
 * begin with their struct_size; ours keeps its own. */
static inline int spti_copy_sized(void *to, const void *from, size_t first_version) {
    size_t known, given;
    memcpy(&known, to, sizeof known);
    memcpy(&given, from, sizeof given);
    if (given < first_version) return 0;
    memcpy((char *)to + sizeof known, (const char *)from + sizeof known,
           (given < known ? given : known) - sizeof known);
    return 1;
}

#endif
