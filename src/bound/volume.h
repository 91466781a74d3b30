/* SPDX-License-Identifier: MIT
 *
 * The volumes that are neither spheres nor boxes, for kernels of any width that meet them rarely:
 * one instance of the volume kernel instead of one for each width. */
#ifndef SPTI_VOLUME_H
#define SPTI_VOLUME_H

#include <spheretrace/bound.h>

#include "../base/compiler.h"
#include "bound_check.h"

/* Rays of a kernel, in their own units, and their intervals. */
typedef struct spti_volume_rays {
    SPTI_ALIGNED(64) float origin[3][SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float direction[3][SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float t_min[SPTI_BOUND_GROUP];
    SPTI_ALIGNED(64) float t_max[SPTI_BOUND_GROUP];
} spti_volume_rays;

/* Cuts the intervals of `count` rays, 16 or as many as a vector has, with a copy of a volume that
 * has more than a hull (interval_kernel.h). */
void spti_volume_cut(const spt_bound *bound, size_t count, spti_volume_rays *rays);

#endif
