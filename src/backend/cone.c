/* SPDX-License-Identifier: MIT
 *
 * One instance of the kernels for cameras and cones. The Makefile compiles this file once for every
 * instruction set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../frame/cone_kernel.h"

static void rays(const spti_view *view, size_t count, const float *x, const float *y,
                 spti_ray_arrays *to) {
    cone_rays(view, count, x, y, to);
    spti_clear_upper();
}

static void enter(const spti_bundles *bundles, const spt_bound *grown, spti_walk *walk) {
    cone_enter(bundles, grown, walk);
    spti_clear_upper();
}

static void points(const spti_bundles *bundles, unsigned walking, spti_walk *walk) {
    cone_points(bundles, walking, walk);
    spti_clear_upper();
}

static unsigned advance(const spti_bundles *bundles, spti_walk *walk) {
    const unsigned still = cone_advance(bundles, walk);
    spti_clear_upper();
    return still;
}

#define KERNELS SPTI_JOIN2(spti_cone_kernels, SPTI_ISA)
extern const spti_cone_kernels KERNELS;
const spti_cone_kernels KERNELS = {rays, enter, points, advance};
