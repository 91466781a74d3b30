/* SPDX-License-Identifier: MIT
 *
 * Rows K1 and K4: mirrors of any length and none, and points on a mirror. */
#include "krs_draw.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float lengths[] = {0.5f, 0.9f, 0.999f, 1, 1.001f, 1.1f, 2};
enum { length_count = sizeof lengths / sizeof lengths[0], unit_length = 3, most_points = 3000 };

static float points[most_points][3], values[most_points], plain[most_points];
static spt_krs krs;

static spt_status build(uint32_t levels, const spt_kernel *kernels, const spt_mirror *mirrors,
                        uint32_t lanes) {
    spt_krs_model model = spt_krs_model_default();
    model.levels = levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    model.max_lanes = lanes;
    return spt_krs_build(&model, &krs);
}

static void evaluate(float *out, size_t count) {
    const spt_field field = spt_krs_field(&krs);
    krs_values(&field, count, (const float(*)[3])points, out);
}

static void scatter(double reach, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) points[i][axis] = (float)check_uniform(-reach, reach);
    }
}

/* ---- K1 -------------------------------------------------------------------------------------- */

/* The catalogue's case. The control folds with normals as they come and shows at how many points
 * that exceeds the distance, in percent: of 3000 within four standard deviations, 0.9 each. */
static void K1_mirror_lengths(void) {
    static const int printed[length_count] = {50, 31, 25, 0, 25, 29, 44};
    const spt_kernel kernels[2] = {spt_kernel_sphere(-2, 0, 0, 0.5f), spt_kernel_empty()};
    scatter(4, most_points);
    const spt_mirror unit = {{1, 0, 0}, 0};
    CHECK(build(1, kernels, &unit, 0) == SPT_OK);
    evaluate(plain, most_points);
    for (int length = 0; length < length_count; ++length) {
        const spt_mirror mirror = {{lengths[length], 0, 0}, 0};
        int above = 0;
        check_context("length %g", (double)lengths[length]);
        CHECK(build(1, kernels, &mirror, 0) == SPT_OK);
        evaluate(values, most_points);
        for (int i = 0; i < most_points; ++i) {
            double p[3];
            krs_widen(points[i], p);
            const double from_axis = p[1] * p[1] + p[2] * p[2], x = 2 - fabs(p[0]);
            const double truth = sqrt(x * x + from_axis) - 0.5;
            CHECK_SAY(fabs((double)values[i] - truth) <= krs_rounding(1, &mirror, p), "%g for %g",
                      (double)values[i], truth);
            CHECK_SAY(check_same_bits(values[i], plain[i]), "%.9g for %.9g", (double)values[i],
                      (double)plain[i]);
            const double u = (double)lengths[length], folded = p[0] - 2 * fmax(0, u * p[0]) * u;
            above += sqrt((folded + 2) * (folded + 2) + from_axis) - 0.5 > truth + 1e-9;
        }
        CHECK_SAY(abs(above * 100 / most_points - printed[length]) <= 4, "%d of %d", above,
                  most_points);
    }
}

/* Any direction and offset; normal and offset are brought to unit length together, unless they are
 * near it already. */
static void K1_lengths_in_any_direction(void) {
    for (int draw = 0; draw < 5 * length_count; ++draw) {
        static krs_expansion truth;
        const double length = (double)lengths[draw % length_count];
        const spt_kernel kernels[2] = {spt_kernel_sphere(0.5f, 0.25f, -1, 0.5f),
                                       spt_kernel_sphere(0, 0, 0, 0.25f)};
        spt_mirror mirror = krs_draw_mirror(check_uniform(2, 4));
        for (int axis = 0; axis < 3; ++axis) mirror.normal[axis] *= lengths[draw % length_count];
        mirror.offset *= lengths[draw % length_count];
        check_context("length %g", length);
        CHECK(build(1, kernels, &mirror, 0) == SPT_OK);
        CHECK(draw % length_count != unit_length ||
              memcmp(&krs.mirrors[0], &mirror, sizeof mirror) == 0);
        krs_expand(&truth, 1, kernels, &mirror);
        scatter(6, 100);
        evaluate(values, 100);
        for (int i = 0; i < 100; ++i) {
            double p[3];
            krs_widen(points[i], p);
            const double exact = krs_expansion_distance(&truth, p, NULL, NULL);
            CHECK_SAY(fabs((double)values[i] - exact) <= krs_rounding(1, &mirror, p), "%g for %g",
                      (double)values[i], exact);
        }
    }
}

/* What is taken as it is: |normal|^2 within 2^-22 of 1, which is rounding. What the catalogue
 * accepts beyond, to 1e-5, would turn a distance of 1000 wrong by 0.01. */
static void K1_taken_as_they_are(void) {
    static const double off[] = {-2e-5, -1e-5, -1e-6, -1e-7, 1e-7, 1e-6, 1e-5, 2e-5};
    for (size_t i = 0; i < sizeof off / sizeof off[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const spt_kernel kernels[2] = {spt_kernel_sphere(0, 0, 0, 1), spt_kernel_empty()};
            const double size = sqrt(1 + off[i]);
            spt_mirror mirror = {{0, 0, 0}, 3};
            mirror.normal[axis] = (float)size;
            check_context("%g", off[i]);
            CHECK(build(1, kernels, &mirror, 0) == SPT_OK);
            if (fabs(off[i]) < 2e-7) {
                CHECK(memcmp(&krs.mirrors[0], &mirror, sizeof mirror) == 0);
            } else { /* to the nearest floats */
                CHECK(fabs((double)krs.mirrors[0].normal[axis] - 1) <= ldexp(1, -24));
                CHECK(fabs((double)krs.mirrors[0].offset - 3 / (double)mirror.normal[axis]) <=
                      ldexp(3, -24));
            }
        }
    }
}

/* Any finite length but zero. */
static void K1_lengths_at_the_ends_of_float(void) {
    for (int power = -140; power <= 120; power += 20) {
        const spt_kernel kernels[2] = {spt_kernel_sphere(0, 0, 0, 1), spt_kernel_empty()};
        const spt_mirror mirror = {{0, -ldexpf(1, power), ldexpf(1, power)}, ldexpf(3, power)};
        check_context("2^%d", power);
        CHECK(build(1, kernels, &mirror, 0) == SPT_OK);
        CHECK(!(fabsf(krs.mirrors[0].normal[0]) > 0));
        CHECK(fabs((double)krs.mirrors[0].normal[1] + sqrt(0.5)) <= ldexp(1, -24));
        CHECK(fabs((double)krs.mirrors[0].normal[2] - sqrt(0.5)) <= ldexp(1, -24));
        CHECK(fabs((double)krs.mirrors[0].offset - 3 * sqrt(0.5)) <= ldexp(3, -24));
    }
}

static void K1_refused_mirrors(void) {
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    const spt_kernel kernels[3] = {spt_kernel_sphere(0, 0, 0, 1), spt_kernel_empty(),
                                   spt_kernel_empty()};
    static spt_krs before;
    for (int level = 0; level < 2; ++level) {
        for (int number = -1; number < 4; ++number) {
            for (int value = 0; value < 3; ++value) {
                spt_mirror mirrors[2] = {{{0, 0, 1}, 2}, {{0, 0, 1}, 8}};
                if (number < 0) {
                    mirrors[level].normal[2] = value == 0 ? 0 : -0.0f;
                } else if (number < 3) {
                    mirrors[level].normal[number] = bad[value];
                } else {
                    mirrors[level].offset = bad[value];
                }
                memset(&krs, 0x5a, sizeof krs);
                memcpy(&before, &krs, sizeof krs);
                CHECK_SAY(build(2, kernels, mirrors, 0) == SPT_BAD_ARGUMENT,
                          "mirror %d, number %d: %g", level, number, (double)bad[value]);
                CHECK(memcmp(&before, &krs, sizeof krs) == 0);
            }
        }
    }
}

/* ---- K4 -------------------------------------------------------------------------------------- */

/* Coordinates of 1/64, and on the mirror +0 and -0 where it goes through the origin. */
static void draw_beside(int axis, float offset, float (*pair)[3]) {
    for (int other = 0; other < 3; ++other)
        pair[0][other] = pair[1][other] = (float)((int)(check_random() % 512) - 256) / 64;
    const float away = check_random() % 4 != 0 ? (float)(check_random() % 256) / 64 : 0;
    pair[0][axis] = offset + away;
    pair[1][axis] = offset - away;
    if (!(away > 0) && !(fabsf(offset) > 0)) {
        pair[0][axis] = 0;
        pair[1][axis] = -0.0f;
    }
}

/* Mirrors along an axis, towards both sides, at +0, -0 and elsewhere: a point and its image, both
 * exact in float, and both zeros of a point on the mirror have the same distance to the bit. */
static void K4_both_branches_the_same(void) {
    static const float offsets[] = {0, -0.0f, 0.5f, -1.25f};
    static krs_drawn sample;
    enum { count = 64 };
    for (int run = 0; run < width_count * 4 * 6; ++run) {
        const uint32_t lanes = widths[run % width_count];
        const float offset = offsets[run / width_count % 4];
        const int axis = run / width_count / 4 % 3, side = run / width_count / 12 != 0 ? 1 : -1;
        for (uint32_t levels = 1; levels <= 3; ++levels) {
            spt_kernel kernels[4];
            spt_mirror mirrors[3];
            for (uint32_t i = 0; i < levels; ++i) {
                kernels[i] = krs_draw_kernel(&sample, i, KRS_SOLID);
                mirrors[i] = krs_draw_mirror(check_uniform(0, 2));
            }
            kernels[levels] = spt_kernel_empty(); /* what is not mirrored there */
            memset(&mirrors[levels - 1], 0, sizeof mirrors[0]);
            mirrors[levels - 1].normal[axis] = (float)side;
            mirrors[levels - 1].offset = (float)side * offset;
            CHECK(build(levels, kernels, mirrors, lanes) == SPT_OK);
            for (int i = 0; i < count; i += 2) draw_beside(axis, offset, &points[i]);
            evaluate(values, count);
            for (int i = 0; i < count; i += 2) {
                CHECK_SAY(check_same_bits(values[i], values[i + 1]),
                          "axis %d, offset %g: %.9g and %.9g", axis, (double)mirrors[0].offset,
                          (double)values[i], (double)values[i + 1]);
            }
        }
    }
}

void suite_krs_mirrors(void) {
    RUN(K1_mirror_lengths);
    RUN(K1_lengths_in_any_direction);
    RUN(K1_taken_as_they_are);
    RUN(K1_lengths_at_the_ends_of_float);
    RUN(K1_refused_mirrors);
    RUN(K4_both_branches_the_same);
}
