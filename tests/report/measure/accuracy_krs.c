/* SPDX-License-Identifier: MIT
 *
 * Distances of kernel-reflection sequences by levels, against the same fold in double. Left out:
 * whether the fold is that of all instances, which does not depend on the precision. */
#include "accuracy.h"

#include "../../oracle/krs_fold.h"
#include "../../oracle/surface_oracle.h"

#include <math.h>
#include <stdlib.h>

typedef struct model {
    uint32_t levels;
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    double reach, offset; /* largest coordinate of the kernels, and offset of the mirrors */
} model;

static void draw_point(report_random *random, double reach, float p[3]) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = (float)report_uniform(random, -reach, reach);
}

/* Balls, arcs that bend by up to a quarter of their chord, and leaves. */
static spt_kernel draw_kernel(report_random *random) {
    const float radius = (float)report_uniform(random, 0.02, 0.2);
    float a[3], b[3], control[3];
    double way[3], across[3], side[3];
    draw_point(random, 0.6, a);
    accuracy_unit(random, way);
    do accuracy_unit(random, across);
    while (fabs(surface_dot(way, across)) > 0.9);
    krs_cross(way, across, side);
    surface_unit(side);
    for (int axis = 0; axis < 3; ++axis) {
        b[axis] = a[axis] + (float)(0.4 * way[axis]);
        control[axis] = a[axis] + (float)(0.2 * way[axis] + 0.1 * side[axis]);
        across[axis] = side[axis];
    }
    switch (report_bits(random) % 3) {
    case 0:
        return spt_kernel_sphere(a[0], a[1], a[2], radius);
    case 1:
        return spt_kernel_capsule(a, b, control, radius / 4);
    default: {
        const float leaf_side[3] = {(float)side[0], (float)side[1], (float)side[2]};
        return spt_kernel_leaf(a, b, leaf_side, radius / 2, radius / 8);
    }
    }
}

/* Mirrors anywhere: what they cut off, both folds cut off. */
static void draw(report_random *random, uint32_t levels, model *one) {
    one->levels = levels;
    one->reach = one->offset = 0;
    for (uint32_t i = 0; i <= levels; ++i) {
        const spt_kernel *const kernel = &one->kernels[i];
        one->kernels[i] = draw_kernel(random);
        for (int axis = 0; axis < 3; ++axis) {
            const float b = kernel->kind == SPT_KERNEL_SPHERE ? kernel->a[axis] : kernel->b[axis];
            one->reach = fmax(one->reach, (double)fmaxf(fabsf(kernel->a[axis]), fabsf(b)) +
                                              (double)kernel->radius);
        }
    }
    for (uint32_t i = 0; i < levels; ++i) {
        double normal[3];
        accuracy_unit(random, normal);
        for (int axis = 0; axis < 3; ++axis) one->mirrors[i].normal[axis] = (float)normal[axis];
        one->mirrors[i].offset = (float)report_uniform(random, -1, 1);
        one->offset = fmax(one->offset, fabs((double)one->mirrors[i].offset));
    }
}

static void compare(report_random *random, const model *one, accuracy_errors *errors) {
    enum { points = 128 };
    spt_krs_model description = spt_krs_model_default();
    spt_krs *const krs = report_allocate(sizeof *krs);
    krs_folded *const folded = report_allocate(sizeof *folded);
    float at[points][3], values[points];
    description.levels = one->levels;
    description.kernels = one->kernels;
    description.mirrors = one->mirrors;
    report_expect(spt_krs_build(&description, krs) == SPT_OK, "a model is refused");
    const spt_field field = spt_krs_field(krs);
    for (int i = 0; i < points; ++i) draw_point(random, accuracy_spread(random, 0.1, 100), at[i]);
    krs_values(&field, points, (const float(*)[3])at, values);
    for (int i = 0; i < points; ++i) {
        double p[3];
        krs_widen(at[i], p);
        krs_fold(one->levels, one->kernels, one->mirrors, p, folded);
        const double scale = fmax(fmax(surface_length(p) + one->offset, one->reach), 1);
        accuracy_add(errors, fabs((double)values[i] - folded->distance) / (0x1p-24 * scale));
    }
    free(krs);
    free(folded);
}

void accuracy_krs(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "krs", "levels", "2^-24 of max(|p| + largest |offset|; reach of kernels; 1)",
        "krs.h: |d - exact| <= 2^-22 (n + 4) max(|p| + largest |offset|; reach of kernels; 1)"};
    model *const one = report_allocate(sizeof *one);
    for (int i = 0; i < accuracy_level_count(SPT_KRS_LEVELS); ++i) {
        report_random random = {(uint64_t)i};
        accuracy_errors errors = {NULL, 0, 0};
        const uint32_t levels = (uint32_t)accuracy_levels[i];
        for (size_t models = accuracy_samples(options, 240); models > 0; --models) {
            draw(&random, levels, one);
            compare(&random, one, &errors);
        }
        accuracy_write(rows, &subject, levels, 4 * (levels + 4.0), &errors);
    }
    free(one);
}
