/* SPDX-License-Identifier: MIT
 *
 * Unit gradients of a field at any points. */
#ifndef SPTI_DIFFERENCES_H
#define SPTI_DIFFERENCES_H

#include <spheretrace/surface.h>

#include "../base/compiler.h"

/* A batch of points and what comes of them, by slot. */
typedef struct spti_differences {
    size_t count;
    float point[3][SPT_BATCH]; /* finite */
    float least[SPT_BATCH];    /* the least step, world length; 0: none */
    float gradient[3][SPT_BATCH];
} spti_differences;

/* Fills in gradient: of unit length, or (0, 0, 0) where there is none. detail > 0 as of
 * spt_normals(). x, y, z and distance are room for SPT_BATCH floats, aligned to 64 bytes. */
void spti_differ(const spt_field *field, spt_normal_rule rule, float detail,
                 spti_differences *differences, float *x, float *y, float *z, float *distance);

#endif
