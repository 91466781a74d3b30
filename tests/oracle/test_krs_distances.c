/* SPDX-License-Identifier: MIT
 *
 * Distances of kernel-reflection sequences against all 2^(n+1) - 1 kernel instances: property Q16
 * and row K2. Left out: models that are cut by their mirrors, see test_krs_cuts.c. */
#include "krs_draw.h"
#include "krs_fold.h"
#include "../check.h"
#include "../rules.h"

#include <spheretrace/shapes.h>

#include <math.h>

static const uint32_t kind_sets[] = {
    KRS_SPHERES, KRS_CAPSULES, KRS_LEAVES, KRS_FIELDS, KRS_SPHERES | KRS_HALF_SPACES, KRS_ALL};
enum { kind_set_count = sizeof kind_sets / sizeof kind_sets[0], most_points = 600 };

static float points[most_points][3], values[most_points], others[most_points];
static krs_drawn sample;
static spt_krs krs;

/* The values of the model at all widths and by the other callback: the same bits. */
static void evaluate(size_t count) {
    for (int width = 0; width < width_count; ++width) {
        krs_build(&sample, widths[width], &krs);
        const spt_field field = spt_krs_field(&krs);
        krs_values(&field, count, (const float(*)[3])points, width == 0 ? values : others);
        for (size_t i = 0; i < count && width != 0; ++i)
            CHECK_SAY(check_same_bits(values[i], others[i]), "%u lanes: %.9g, 1: %.9g",
                      widths[width], (double)others[i], (double)values[i]);
    }
    const spt_field field = spt_krs_field(&krs);
    krs_point_values(&field, count, (const float(*)[3])points, others);
    for (size_t i = 0; i < count; ++i)
        CHECK_SAY(check_same_bits(values[i], others[i]), "one point: %.9g, batch: %.9g",
                  (double)others[i], (double)values[i]);
}

/* As many points for small models, and so many instances in all for large ones. */
static size_t points_for(const krs_expansion *truth) {
    const size_t count = 25000 / (truth->count + 1);
    return count < 24 ? 24 : count < 160 ? count : 160;
}

static void check_against_instances(size_t count) {
    evaluate(count);
    for (size_t i = 0; i < count; ++i) {
        double p[3];
        krs_widen(points[i], p);
        const double truth = krs_expansion_distance(&sample.truth, p, NULL, NULL),
                     rounding = krs_rounding(sample.levels, sample.mirrors, p);
        if (truth < HUGE_VAL) {
            CHECK_SAY(fabs((double)values[i] - truth) <= rounding,
                      "at (%.9g, %.9g, %.9g): %.9g, truth %.9g, allowed %g", p[0], p[1], p[2],
                      (double)values[i], truth, rounding);
        } else {
            CHECK(values[i] > 0 && isinf(values[i]));
        }
    }
}

static void Q16_krs_equals_all_instances(void) {
    for (uint32_t levels = 0; levels <= krs_most_levels; ++levels) {
        for (int set = 0; set < kind_set_count; ++set) {
            check_context("%u levels, kernels %#x", levels, kind_sets[set]);
            krs_draw(&sample, levels, kind_sets[set], 0);
            const size_t count = points_for(&sample.truth);
            krs_draw_points(&sample, count, points);
            check_against_instances(count);
        }
    }
}

/* A half space before its last mirror, which must stand along it; nothing between them is cut. */
static void Q16_krs_mirrored_half_spaces(void) {
    for (int draw = 0; draw < 12; ++draw) {
        const double length = pow(2, check_uniform(-3, 3));
        double normal[3];
        sample.levels = 1;
        sample.reach = 3;
        sample.mirrors[0] = krs_draw_mirror(check_uniform(-1, 1));
        krs_widen(sample.mirrors[0].normal, normal);
        sample.kernels[0] = spt_kernel_half_space(
            (float)(length * normal[0]), (float)(length * normal[1]), (float)(length * normal[2]),
            (float)(length * ((double)sample.mirrors[0].offset - 0.5)));
        sample.kernels[1] = krs_draw_kernel(&sample, 1, KRS_SPHERES | KRS_EMPTY);
        krs_expand(&sample.truth, 1, sample.kernels, sample.mirrors);
        krs_draw_points(&sample, 100, points);
        check_against_instances(100);
    }
}

/* Arcs of every flatness and beyond a half circle, straight ones, and wherever control is. */
static void krs_kinds_of_arcs(void) {
    for (int draw = 0; draw < 60; ++draw) {
        const float a[3] = {-0.5f, 0, 0}, b[3] = {0.5f, 0, 0};
        const double sagitta = pow(10, -draw / 10.0), turned = check_uniform(0, 6.28);
        /* control: on the arc's middle; beside it; on the line between, and outside, of the ends */
        float control[3] = {draw % 2 != 0 ? 0.3f : 0, (float)(sagitta * cos(turned)),
                            (float)(sagitta * sin(turned))};
        if (draw % 10 == 9) control[1] = control[2] = 0;
        if (draw % 20 == 19) control[0] = 2;
        sample.levels = 0;
        sample.reach = 1.5;
        sample.kernels[0] = spt_kernel_capsule(a, b, control, 0.03125f);
        krs_expand(&sample.truth, 0, sample.kernels, sample.mirrors);
        krs_draw_points(&sample, 100, points);
        check_context("sagitta %g", sagitta);
        check_against_instances(100);
    }
}

/* Leaves from needles to discs, with and without thickness, `control` of any length. */
static void krs_kinds_of_leaves(void) {
    for (int draw = 0; draw < 40; ++draw) {
        const float tip[3] = {-0.5f, 0.25f, 0}, other[3] = {0.5f, 0.25f, 0};
        const double turned = check_uniform(0, 6.28), length = pow(2, check_uniform(-10, 10));
        const float across[3] = {0, (float)(length * cos(turned)), (float)(length * sin(turned))};
        const float width = draw % 4 == 0 ? 0.5f : (float)(0.5 * pow(10, check_uniform(-3, 0)));
        sample.levels = 0;
        sample.reach = 1;
        sample.kernels[0] =
            spt_kernel_leaf(tip, other, across, width, draw % 3 == 0 ? 0 : 0.015625f);
        krs_expand(&sample.truth, 0, sample.kernels, sample.mirrors);
        krs_draw_points(&sample, 100, points);
        check_context("width %g, length %g", (double)width, length);
        check_against_instances(100);
    }
}

/* |f(p) - f(q)| <= (1 + 1e-5) |p - q| and what both values may be off. A quarter of
 * the pairs lie on both sides of the last mirror, a quarter are anywhere. */
static void check_lipschitz(double depth) {
    enum { pairs = most_points / 2 };
    for (uint32_t levels = 0; levels <= krs_most_levels; ++levels) {
        check_context("%u levels", levels);
        krs_draw(&sample, levels, KRS_ALL & ~(uint32_t)KRS_EMPTY, depth);
        krs_build(&sample, 0, &krs);
        const spt_field field = spt_krs_field(&krs);
        krs_draw_points(&sample, 2 * pairs, points);
        for (int i = 0; i < pairs; ++i) {
            float *const p = points[2 * i], *const q = points[2 * i + 1];
            double way[3], at[3];
            surface_random_unit(way);
            const double length = pow(10, check_uniform(-4, 0));
            if (i % 2 == 0 && levels != 0) { /* onto the last mirror */
                krs_widen(p, at);
                const double beyond = surface_dot(sample.truth.normal[levels - 1], at) -
                                      sample.truth.offset[levels - 1];
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = (float)(at[axis] - beyond * sample.truth.normal[levels - 1][axis] -
                                      length / 2 * way[axis]);
            }
            for (int axis = 0; axis < 3 && i % 4 != 3; ++axis)
                q[axis] = p[axis] + (float)(length * way[axis]);
        }
        krs_values(&field, 2 * pairs, (const float(*)[3])points, values);
        for (int i = 0; i < pairs; ++i) {
            double p[3], q[3];
            krs_widen(points[2 * i], p);
            krs_widen(points[2 * i + 1], q);
            const double change = fabs((double)values[2 * i] - (double)values[2 * i + 1]);
            const double rounding =
                krs_rounding(levels, sample.mirrors, p) + krs_rounding(levels, sample.mirrors, q);
            const double way[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
            CHECK_SAY(change <= (1 + 1e-5) * surface_length(way) + rounding, "%g over %g", change,
                      surface_length(way));
        }
    }
}

static void Q16_krs_lipschitz(void) {
    check_lipschitz(0);
}

static void K3_lipschitz_across_mirrors(void) {
    check_lipschitz(0.8);
}

/* ---- K2: numbers of levels ------------------------------------------------------------------- */

static spt_kernel many_kernels[SPT_KRS_LEVELS + 2];
static spt_mirror many_mirrors[SPT_KRS_LEVELS + 1];

static spt_status build_levels(uint32_t levels, uint32_t lanes) {
    spt_krs_model model = spt_krs_model_default();
    model.levels = levels;
    model.kernels = many_kernels;
    model.mirrors = levels != 0 ? many_mirrors : NULL;
    model.max_lanes = lanes;
    return spt_krs_build(&model, &krs);
}

/* One kernel is what shapes.h makes of it, to the bit. */
static void K2_no_levels_is_the_kernel(void) {
    const float a[3] = {-0.5f, 0.3f, 0.1f}, b[3] = {0.7f, -0.2f, 0.4f};
    const float controls[2][3] = {{0.2f, 0.6f, -0.3f}, {-0.1f, 0.6f, -0.3f}};
    for (int width = 0; width < width_count; ++width) {
        for (int shape = 0; shape < 4; ++shape) {
            const float *const control = shape < 3 ? controls[shape % 2] : a; /* a: straight */
            const spt_arc arc =
                spt_arc_of(spt_point_of(a[0], a[1], a[2]), spt_point_of(b[0], b[1], b[2]),
                           spt_point_of(control[0], control[1], control[2]), 0.1f);
            many_kernels[0] = shape == 0 ? spt_kernel_sphere(a[0], a[1], a[2], 0.75f)
                                         : spt_kernel_capsule(a, b, control, 0.1f);
            CHECK(build_levels(0, widths[width]) == SPT_OK);
            const spt_field field = spt_krs_field(&krs);
            for (int i = 0; i < most_points; ++i) {
                for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-3, 3);
            }
            krs_values(&field, most_points, (const float(*)[3])points, values);
            krs_point_values(&field, most_points, (const float(*)[3])points, others);
            for (int i = 0; i < most_points; ++i) {
                const spt_point p = spt_point_of(points[i][0], points[i][1], points[i][2]);
                const float truth =
                    shape == 0 ? spt_sphere(spt_translate(p, spt_point_of(a[0], a[1], a[2])), 0.75f)
                               : spt_toroidal_capsule(p, &arc);
                CHECK_SAY(check_same_bits(values[i], truth) && check_same_bits(others[i], truth),
                          "shape %d, %u lanes: %.9g, %.9g, alone %.9g", shape, widths[width],
                          (double)values[i], (double)others[i], (double)truth);
            }
        }
    }
}

/* Offsets from 0 on: a fold then takes no point farther from the origin, so that all coordinates
 * stay within the row's 10. */
static void K2_random_unit_mirrors(void) {
    static const uint32_t levels[] = {1, 8, 28, 64};
    static krs_folded folded;
    for (int draw = 0; draw < 12; ++draw) {
        const uint32_t n = levels[draw % 4];
        for (uint32_t i = 0; i <= n; ++i) {
            many_kernels[i] = i == 0 ? spt_kernel_sphere(0.5f, -0.25f, 1, 0.5f)
                                     : krs_draw_kernel(&sample, 0, KRS_EMPTY | KRS_SPHERES);
            if (i != 0 && draw < 4) many_kernels[i] = spt_kernel_empty(); /* what folds alone do */
        }
        for (uint32_t i = 0; i < n; ++i) many_mirrors[i] = krs_draw_mirror(check_uniform(0, 3));
        CHECK(build_levels(n, 0) == SPT_OK);
        const spt_field field = spt_krs_field(&krs);
        for (int i = 0; i < most_points / 4; ++i) {
            for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-10, 10);
        }
        krs_values(&field, most_points / 4, (const float(*)[3])points, values);
        for (int i = 0; i < most_points / 4; ++i) {
            double p[3];
            krs_widen(points[i], p);
            krs_fold(n, many_kernels, many_mirrors, p, &folded);
            CHECK_SAY(fabs((double)values[i] - folded.distance) <= 5e-5, "%u levels: off by %g", n,
                      (double)values[i] - folded.distance);
        }
    }
}

static void K2_counts_of_levels(void) {
    for (int i = 0; i < SPT_KRS_LEVELS + 2; ++i) many_kernels[i] = spt_kernel_sphere(0, 0, 0, 1);
    for (int i = 0; i < SPT_KRS_LEVELS + 1; ++i) many_mirrors[i] = krs_draw_mirror(2);
    for (uint32_t levels = 0; levels <= SPT_KRS_LEVELS; ++levels) {
        const double count = levels < 64 ? ldexp(1, (int)levels + 1) - 1 : ldexp(1, 65);
        CHECK(build_levels(levels, 0) == SPT_OK && krs.levels == levels);
        CHECK_SAY(!(spt_krs_instances(levels) < count) && !(spt_krs_instances(levels) > count),
                  "%u levels: %g", levels, spt_krs_instances(levels));
    }
    CHECK(build_levels(SPT_KRS_LEVELS + 1, 0) == SPT_BAD_ARGUMENT);
    CHECK(build_levels(UINT32_MAX, 0) == SPT_BAD_ARGUMENT);
}

void suite_krs_distances(void) {
    RUN(Q16_krs_equals_all_instances);
    RUN(Q16_krs_mirrored_half_spaces);
    RUN(krs_kinds_of_arcs);
    RUN(krs_kinds_of_leaves);
    RUN(Q16_krs_lipschitz);
    RUN(K3_lipschitz_across_mirrors);
    RUN(K2_no_levels_is_the_kernel);
    RUN(K2_random_unit_mirrors);
    RUN(K2_counts_of_levels);
}
