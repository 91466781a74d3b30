/* SPDX-License-Identifier: MIT
 *
 * Algorithm 1 in double, and the normals of section 8.1. */
#include "krs_fold.h"
#include "surface_oracle.h"

#include <math.h>

void krs_fold(uint32_t levels, const spt_kernel *kernels, const spt_mirror *mirrors,
              const double p[3], krs_folded *folded) {
    double at[3] = {p[0], p[1], p[2]};
    uint64_t all = 0;
    folded->distance = HUGE_VAL;
    folded->kernel = levels;
    for (uint32_t i = levels + 1; i-- > 0;) { /* the kernel i, then the mirror below it */
        const krs_body body = krs_body_of(&kernels[i]);
        const double distance = krs_body_distance(&body, at);
        for (int axis = 0; axis < 3; ++axis) folded->at[i][axis] = at[axis];
        if (distance < folded->distance) {
            folded->distance = distance;
            folded->kernel = i;
            folded->mirrors = all;
        }
        if (i == 0) break;
        double *const normal = folded->normal[i - 1];
        krs_widen(mirrors[i - 1].normal, normal);
        const double length = surface_length(normal);
        surface_unit(normal);
        const double beyond = surface_dot(normal, at) - (double)mirrors[i - 1].offset / length;
        folded->beyond[i - 1] = beyond;
        if (!(beyond > 0)) continue;
        all |= UINT64_C(1) << (i - 1);
        for (int axis = 0; axis < 3; ++axis) at[axis] -= 2 * beyond * normal[axis];
    }
    if (folded->kernel == levels) folded->mirrors = 0;
    folded->nearest_mirror = HUGE_VAL;
    for (uint32_t i = folded->kernel; i < levels; ++i)
        folded->nearest_mirror = fmin(folded->nearest_mirror, fabs(folded->beyond[i]));
}

static double smoothstep(double low, double high, double x) {
    const double part = fmin(fmax((x - low) / (high - low), 0), 1);
    return part * part * (3 - 2 * part);
}

double krs_fold_normal(const krs_folded *folded, uint32_t levels, const spt_kernel *kernels,
                       double width, double normal[3]) {
    const krs_body body = krs_body_of(&kernels[folded->kernel]);
    krs_body_gradient(&body, folded->at[folded->kernel], normal);
    surface_unit(normal);
    for (uint32_t j = folded->kernel; j < levels; ++j) {
        const double beyond = folded->beyond[j],
                     share = width > 0 ? smoothstep(-width, width, beyond) : beyond > 0;
        const double turned = surface_dot(folded->normal[j], normal);
        for (int axis = 0; axis < 3; ++axis)
            normal[axis] -= 2 * share * turned * folded->normal[j][axis];
    }
    const double length = surface_length(normal);
    surface_unit(normal);
    return length;
}
