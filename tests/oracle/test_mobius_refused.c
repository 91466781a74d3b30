/* SPDX-License-Identifier: MIT
 *
 * What mobius.h refuses, with nothing written: matrices that break the group condition (row M3, S3,
 * S4), numbers out of range, NULL pointers. What it must not refuse stands beside it. */
#include "../check.h"
#include "mobius_region.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double nothing_finite[3] = {HUGE_VAL, -HUGE_VAL, (double)NAN};

/* A map of which each byte can be told from one that is written. */
static spt_mobius marked(void) {
    spt_mobius map;
    memset(&map, 0x5a, sizeof map);
    return map;
}

/* What is no padding. */
enum { map_size = 4 * sizeof(spt_quaternion) + sizeof(int32_t) };

static int untouched(const spt_mobius *map) {
    const spt_mobius before = marked();
    return memcmp(map, &before, map_size) == 0;
}

static spt_quaternion real(double value) {
    return spt_quaternion_of(value, 0, 0, 0);
}

static void refused(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d) {
    spt_mobius map = marked();
    CHECK(spt_mobius_matrix(a, b, c, d, &map) == SPT_BAD_ARGUMENT);
    CHECK(untouched(&map));
}

static spt_mobius accepted(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d,
                           int orientation) {
    spt_mobius map = marked();
    CHECK(spt_mobius_matrix(a, b, c, d, &map) == SPT_OK);
    CHECK(map.orientation == orientation);
    return map;
}

static void expect_image(const spt_mobius *map, const double p[3], double x, double y, double z,
                         double tolerance) {
    double image[3] = {0, 0, 0};
    CHECK(spt_mobius_point(map, p, image) == 1);
    CHECK_SAY(fabs(image[0] - x) <= tolerance && fabs(image[1] - y) <= tolerance &&
                  fabs(image[2] - z) <= tolerance,
              "(%.17g, %.17g, %.17g)", image[0], image[1], image[2]);
}

/* ---- M3: matrices ---------------------------------------------------------------------------- */

static void M3_singular(void) {
    refused(real(1), real(2), real(1), real(2));
    refused(real(0), real(0), real(0), real(0));
    refused(real(1), real(0), real(0), real(0));
    refused(real(0), real(0), real(1), real(1));
    /* |lambda| is 1e-7 of |a| |d| + |b| |c|: pure b and c, so that only lambda is at fault. */
    refused(real(1), spt_quaternion_of(0, 1, 0, 0), spt_quaternion_of(0, 1 - 2e-7, 0, 0), real(-1));
    accepted(real(1), spt_quaternion_of(0, 1, 0, 0), spt_quaternion_of(0, 1 - 2e-5, 0, 0), real(-1),
             -1);
}

/* (1, 2, 3) + 0.5 is no point of space. */
static void M3_translation_by_a_real(void) {
    refused(real(1), real(0.5), real(0), real(1));
    refused(real(1), spt_quaternion_of(0.5, 1, 2, 3), real(0), real(1));
    accepted(real(1), spt_quaternion_of(0, 1, 2, 3), real(0), real(1), 1);
}

/* [r 0; 0 r] with |r| = 2 is in the group: lambda = r* r = 4, real and not 0, and its map,
 * r p r^-1, is the rotation of r / 2; so it is taken, and |lambda| brought to 1. What |r| = 2
 * breaks is r p r*, four times as long: as a matrix [r 0; 0 r*^-1], lambda = r* r*^-1 = 1, a
 * rotation and dilation, and in the group, too. Outside is [r 0; 0 1]: lambda = r* is not real. */
static void M3_rotation_of_length_two(void) {
    const double turn[3] = {0, 0, 2}, p[3] = {1, 2, 3};
    const spt_quaternion r = spt_quaternion_of(sqrt(2.0), 0, 0, sqrt(2.0)); /* a quarter about z */
    const spt_quaternion over = spt_quaternion_scaled(r, 0.25);             /* r*^-1 */
    spt_mobius map = accepted(r, real(0), real(0), r, 1), rotation = spt_mobius_identity();
    CHECK(fabs(spt_quaternion_square(map.a) - 1) <= 16 * DBL_EPSILON);
    expect_image(&map, p, -2, 1, 3, 64 * DBL_EPSILON);
    CHECK(spt_mobius_rotation(turn, 1.57079632679489661923, &rotation) == SPT_OK);
    expect_image(&rotation, p, -2, 1, 3, 64 * DBL_EPSILON);
    map = accepted(r, real(0), real(0), over, 1);
    expect_image(&map, p, -8, 4, 12, 256 * DBL_EPSILON);
    refused(r, real(0), real(0), real(1));
    refused(real(1), real(0), real(0), r);
}

/* By the group condition, relative; 0 inside. */
static double violation(spt_quaternion a, spt_quaternion b, spt_quaternion c, spt_quaternion d) {
    const spt_quaternion at_infinity = spt_quaternion_product(spt_quaternion_conjugate(a), c);
    const spt_quaternion at_zero = spt_quaternion_product(spt_quaternion_conjugate(b), d);
    const spt_quaternion lambda =
        spt_quaternion_sum(spt_quaternion_product(spt_quaternion_conjugate(a), d),
                           spt_quaternion_product(spt_quaternion_conjugate(c), b));
    const double size = sqrt(spt_quaternion_square(a) * spt_quaternion_square(d)) +
                        sqrt(spt_quaternion_square(b) * spt_quaternion_square(c));
    const double imaginary = sqrt(lambda.x * lambda.x + lambda.y * lambda.y + lambda.z * lambda.z);
    return fmax(imaginary, fmax(fabs(at_infinity.real), fabs(at_zero.real))) / size;
}

static spt_quaternion draw_quaternion(void) {
    const double real_part = check_uniform(-1, 1), x = check_uniform(-1, 1);
    const double y = check_uniform(-1, 1), z = check_uniform(-1, 1);
    return spt_quaternion_of(real_part, x, y, z);
}

/* "Any a, b, c, d in H", as printed (S4): the literal quotient takes points out of space, by up to
 * the whole of their size. */
static void M3_S4_random_entries(void) {
    double worst = 0;
    int astray = 0;
    for (int n = 0; n < 4000; ++n) {
        const spt_quaternion a = draw_quaternion(), b = draw_quaternion(), c = draw_quaternion(),
                             d = draw_quaternion(), p = spt_quaternion_of(0, 1, 2, 3);
        const spt_quaternion up = spt_quaternion_sum(spt_quaternion_product(a, p), b);
        const spt_quaternion down = spt_quaternion_sum(spt_quaternion_product(c, p), d);
        const spt_quaternion image = spt_quaternion_product(up, spt_quaternion_conjugate(down));
        const double part = fabs(image.real) / sqrt(spt_quaternion_square(image));
        worst = fmax(worst, part);
        astray += part > 1e-3;
        if (violation(a, b, c, d) > 1e-2) refused(a, b, c, d);
    }
    CHECK_SAY(worst > 0.99, "real part at most %g of the image", worst);
    CHECK_SAY(astray > 3900, "%d of 4000 astray", astray);
}

/* Good matrices: any real multiple of them is as good; with an entry a hundredth off they are none,
 * unless it went along the group. */
static void matrices_of_chains(void) {
    for (int n = 0; n < 600; ++n) {
        static const double origin[3] = {0, 0, 0};
        const double p[3] = {0.25, -0.5, 0.125};
        const double factors[] = {1, -1, 1e-3, 1e3, 1e-200, 1e200};
        const double factor = factors[n % 6];
        chain one;
        spt_mobius map, copy;
        spt_quaternion entries[4];
        double image[3], again[3];
        extended off, error;
        moduli m;
        place to;
        chain_draw(&one, 1 + n % 4, origin, 1);
        map = chain_build(&one);
        entries[0] = spt_quaternion_scaled(map.a, factor);
        entries[1] = spt_quaternion_scaled(map.b, factor);
        entries[2] = spt_quaternion_scaled(map.c, factor);
        entries[3] = spt_quaternion_scaled(map.d, factor);
        check_context("chain %d, factor %g", n, factor);
        copy = marked();
        CHECK(spt_mobius_matrix(entries[0], entries[1], entries[2], entries[3], &copy) == SPT_OK);
        if (untouched(&copy)) continue;
        CHECK(copy.orientation == map.orientation);
        CHECK(spt_mobius_point(&map, p, image) == 1 && spt_mobius_point(&copy, p, again) == 1);
        m = chain_moduli(&one, 0);
        to = chain_image(&one, 0, place_of(p));
        error = error_of_point(&m, place_of(p), to, chain_scale(&one, 0, place_of(p)));
        off = extended_distance(place_of(again).at, to.at);
        CHECK_SAY(chain_close(&one, off, error), "off by %Lg units", off / 0x1p-53L / error);
        entries[n % 4] = spt_quaternion_sum(
            entries[n % 4],
            spt_quaternion_scaled(draw_quaternion(),
                                  0.1 * sqrt(spt_quaternion_square(entries[n % 4]))));
        if (fabs(factor) < 1e100 && fabs(factor) > 1e-100 &&
            violation(entries[0], entries[1], entries[2], entries[3]) > 1e-2)
            refused(entries[0], entries[1], entries[2], entries[3]);
    }
}

static void M3_nonfinite_entries(void) {
    for (int i = 0; i < 16; ++i) {
        for (int k = 0; k < 3; ++k) {
            spt_quaternion entries[4] = {{1, 0, 0, 0}, {0, 1, 2, 3}, {0, 0, 0, 0}, {1, 0, 0, 0}};
            spt_quaternion *entry = &entries[i / 4];
            double *const part[4] = {&entry->real, &entry->x, &entry->y, &entry->z};
            *part[i % 4] = nothing_finite[k];
            refused(entries[0], entries[1], entries[2], entries[3]);
        }
    }
    CHECK(spt_mobius_matrix(real(1), real(0), real(0), real(1), NULL) == SPT_BAD_ARGUMENT);
}

/* ---- Elementary maps ------------------------------------------------------------------------- */

static void refuse_step(chain_kind kind, double x, double y, double z, double number) {
    chain_step step = {kind, {0, 0, 0}, 0};
    spt_mobius map = marked();
    step.vector[0] = x;
    step.vector[1] = y;
    step.vector[2] = z;
    step.number = number;
    CHECK(chain_elementary(&step, &map) == SPT_BAD_ARGUMENT);
    CHECK(untouched(&map));
}

static void take_step(chain_kind kind, double x, double y, double z, double number) {
    chain_step step = {kind, {0, 0, 0}, 0};
    spt_mobius map = marked();
    step.vector[0] = x;
    step.vector[1] = y;
    step.vector[2] = z;
    step.number = number;
    CHECK(chain_elementary(&step, &map) == SPT_OK);
    CHECK(!untouched(&map));
}

static void S3_elementary_numbers(void) {
    for (int k = 0; k < 3; ++k) {
        const double bad = nothing_finite[k];
        check_context("%g", bad);
        refuse_step(CHAIN_DILATION, 0, 0, 0, bad);
        refuse_step(CHAIN_ROTATION, 1, 0, 0, bad);
        refuse_step(CHAIN_REFLECTION, 1, 0, 0, bad);
        refuse_step(CHAIN_INVERSION, 1, 0, 0, bad);
        for (int kind = 0; kind < CHAIN_KINDS; ++kind) {
            if (kind == CHAIN_DILATION) continue;
            refuse_step((chain_kind)kind, bad, 1, 1, 1);
            refuse_step((chain_kind)kind, 1, bad, 1, 1);
            refuse_step((chain_kind)kind, 1, 1, bad, 1);
        }
    }
    check_context("out of range");
    refuse_step(CHAIN_DILATION, 0, 0, 0, 0); /* s in R, as printed (S3): singular */
    refuse_step(CHAIN_DILATION, 0, 0, 0, -0.0);
    refuse_step(CHAIN_DILATION, 0, 0, 0, 0.99e-30);
    refuse_step(CHAIN_DILATION, 0, 0, 0, -1.01e30);
    refuse_step(CHAIN_ROTATION, 0, 0, 0, 1);
    refuse_step(CHAIN_ROTATION, 1, 0, 0, 100001);
    refuse_step(CHAIN_ROTATION, 1, 0, 0, -100001);
    refuse_step(CHAIN_REFLECTION, 0, 0, 0, 1);
    refuse_step(CHAIN_INVERSION, 1, 1, 1, 0);
    refuse_step(CHAIN_INVERSION, 1, 1, 1, -1);
    check_context("in range");
    take_step(CHAIN_DILATION, 0, 0, 0, 1e-30);
    take_step(CHAIN_DILATION, 0, 0, 0, -1e30);
    take_step(CHAIN_ROTATION, 1e-200, 0, 0, 1e5); /* of any length but zero */
    take_step(CHAIN_ROTATION, 1e200, 1e200, 0, -1e5);
    take_step(CHAIN_ROTATION, 0, DBL_MIN / 4, 0, 1);
    take_step(CHAIN_REFLECTION, 0, 1e-200, 0, 1e-200);
    take_step(CHAIN_REFLECTION, 1e200, -1e200, 1e200, 1e200);
    take_step(CHAIN_TRANSLATION, 1e200, 0, 0, 0);
    take_step(CHAIN_INVERSION, 1, 1, 1, 1e-30);
    take_step(CHAIN_INVERSION, 1, 1, 1, 1e30);
}

static void elementary_pointers(void) {
    static const double v[3] = {1, 2, 3};
    spt_mobius map = marked();
    CHECK(spt_mobius_dilation(1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_translation(v, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_translation(NULL, &map) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_rotation(v, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_rotation(NULL, 1, &map) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_reflection(v, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_reflection(NULL, 1, &map) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_inversion(v, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_inversion(NULL, 1, &map) == SPT_BAD_ARGUMENT);
    CHECK(untouched(&map));
}

/* Twice as far each time, until the product leaves the doubles. */
static void compositions_refused(void) {
    const spt_mobius identity = spt_mobius_identity();
    spt_mobius map = marked(), far = spt_mobius_identity();
    spt_status status = SPT_OK;
    const double by[3] = {1e300, 0, 0};
    int grown = 0;
    CHECK(spt_mobius_compose(NULL, &identity, &map) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_compose(&identity, NULL, &map) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_compose(&identity, &identity, NULL) == SPT_BAD_ARGUMENT);
    CHECK(untouched(&map));
    CHECK(spt_mobius_translation(by, &far) == SPT_OK);
    for (; grown < 64 && status == SPT_OK; ++grown) {
        const spt_mobius before = far;
        status = spt_mobius_compose(&far, &far, &far);
        if (status != SPT_OK) CHECK(memcmp(&before, &far, map_size) == 0);
        CHECK(fabs(far.b.x) <= DBL_MAX);
    }
    CHECK(status == SPT_BAD_ARGUMENT);
    CHECK_SAY(grown == 28, "%d times", grown); /* 2^28 1e300 > DBL_MAX > 2^27 1e300 */
}

/* ---- Regions --------------------------------------------------------------------------------- */

static void refuse_region(const spt_region *region) {
    const double p[3] = {3, 0, 0};
    spt_mobius map = spt_mobius_identity();
    spt_region image, before;
    memset(&image, 0x5a, sizeof image);
    before = image;
    CHECK(spt_mobius_inversion(p, 1, &map) == SPT_OK);
    CHECK(spt_mobius_region(&map, region, &image) == SPT_BAD_ARGUMENT);
    CHECK(memcmp(&image, &before, sizeof image) == 0);
}

static void regions_refused(void) {
    const spt_region ball = {SPT_REGION_BALL, {0, 0, 0}, 1};
    const spt_region half = {SPT_REGION_HALF_SPACE, {0, 1, 0}, -2};
    const spt_mobius map = spt_mobius_identity();
    spt_region one = ball, image;
    CHECK(spt_mobius_region(NULL, &ball, &image) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_region(&map, NULL, &image) == SPT_BAD_ARGUMENT);
    CHECK(spt_mobius_region(&map, &ball, NULL) == SPT_BAD_ARGUMENT);
    for (uint32_t kind = 0; kind < 6; ++kind) {
        if (kind >= SPT_REGION_BALL && kind <= SPT_REGION_HALF_SPACE) continue;
        one.kind = kind;
        refuse_region(&one);
    }
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) {
            spt_region bad = k % 2 == 0 ? ball : half;
            if (i < 3) bad.center[i] = nothing_finite[k];
            if (i == 3) bad.radius = nothing_finite[k];
            refuse_region(&bad);
        }
    }
    for (uint32_t kind = SPT_REGION_BALL; kind <= SPT_REGION_OUTSIDE; ++kind) {
        one = ball;
        one.kind = kind;
        one.radius = 0;
        refuse_region(&one);
        one.radius = -1;
        refuse_region(&one);
    }
    one = half;
    one.center[1] = 1 + 2e-6;
    refuse_region(&one);
    one.center[1] = 1 - 2e-6;
    refuse_region(&one);
    one.center[1] = 0;
    refuse_region(&one);
    one.center[1] = 1 + 4e-7;
    CHECK(spt_mobius_region(&map, &one, &image) == SPT_OK);
}

void suite_mobius_refused(void) {
    RUN(M3_singular);
    RUN(M3_translation_by_a_real);
    RUN(M3_rotation_of_length_two);
    RUN(M3_S4_random_entries);
    RUN(matrices_of_chains);
    RUN(M3_nonfinite_entries);
    RUN(S3_elementary_numbers);
    RUN(elementary_pointers);
    RUN(compositions_refused);
    RUN(regions_refused);
}
