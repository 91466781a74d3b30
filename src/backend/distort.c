/* SPDX-License-Identifier: MIT
 *
 * One instance of the kernels for distorted fields. The Makefile compiles this file once for every
 * instruction set, with SPTI_ISA (its name) and SPT_LANES defined. */
#include "../krs/distort_kernel.h"

static void move(const spt_distorted *distorted, size_t n, const float *x, const float *y,
                 const float *z, float *to_x, float *to_y, float *to_z, float *apart) {
    const spti_region at = distort_region(distorted);
    switch (distorted->distortion.kind) {
    case SPT_DISTORTION_TWIST:
        distort_move(SPT_DISTORTION_TWIST, &at, n, x, y, z, to_x, to_y, to_z, apart);
        break;
    case SPT_DISTORTION_BEND:
        distort_move(SPT_DISTORTION_BEND, &at, n, x, y, z, to_x, to_y, to_z, apart);
        break;
    case SPT_DISTORTION_TAPER:
        distort_move(SPT_DISTORTION_TAPER, &at, n, x, y, z, to_x, to_y, to_z, apart);
        break;
    default:
        distort_move(SPT_DISTORTION_SWAY, &at, n, x, y, z, to_x, to_y, to_z, apart);
    }
    spti_clear_upper();
}

static void settle(float lipschitz, size_t n, const float *apart, float *distance) {
    distort_settle(lipschitz, n, apart, distance);
    spti_clear_upper();
}

static void pull(const spt_distorted *distorted, size_t n, const float *x, const float *y,
                 const float *z, float *gradient_x, float *gradient_y, float *gradient_z) {
    const spti_region at = distort_region(distorted);
    switch (distorted->distortion.kind) {
    case SPT_DISTORTION_TWIST:
        distort_pull(SPT_DISTORTION_TWIST, &at, n, x, y, z, gradient_x, gradient_y, gradient_z);
        break;
    case SPT_DISTORTION_BEND:
        distort_pull(SPT_DISTORTION_BEND, &at, n, x, y, z, gradient_x, gradient_y, gradient_z);
        break;
    case SPT_DISTORTION_TAPER:
        distort_pull(SPT_DISTORTION_TAPER, &at, n, x, y, z, gradient_x, gradient_y, gradient_z);
        break;
    default:
        distort_pull(SPT_DISTORTION_SWAY, &at, n, x, y, z, gradient_x, gradient_y, gradient_z);
    }
    spti_clear_upper();
}

#define KERNELS SPTI_JOIN2(spti_distort_kernels, SPTI_ISA)
extern const spti_distort_kernels KERNELS;
const spti_distort_kernels KERNELS = {move, settle, pull};
