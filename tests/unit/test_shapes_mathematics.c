/* SPDX-License-Identifier: MIT
 *
 * Sine, cosine, exponential, logarithm and selections of shapes_math.h against libm. */
#include "test_shapes_parts.h"

#include <math.h>
#include <string.h>

#include <spheretrace/shapes.h>

#include "../check.h"
#include "test_shapes_table.h"

/* The bounds are those that shapes_math.h states. Every float that is a multiple of the steps. */
static void sine_and_cosine(void) {
    const int count = 400000;
    for (int i = -count; i <= count; ++i) {
        const double u = (double)i / count;
        const double ranges[3] = {1.6, 1e4, 1e5}, bounds[3] = {1.5e-7, 1.5e-7, 2.2e-6};
        const int range = i & 1 ? 0 : i & 2 ? 1 : 2;
        const double x = (double)(float)(ranges[range] * u);
        const double s = mathematics_float.sine(x), c = mathematics_float.cosine(x);
        CHECK_SAY(fabs(s - sin(x)) <= bounds[range], "sine of %.9g is %.9g", x, s);
        CHECK_SAY(fabs(c - cos(x)) <= bounds[range], "cosine of %.9g is %.9g", x, c);
        CHECK_SAY(range != 0 || fabs(s - sin(x)) <= 1.5e-7 * fabs(sin(x)), "%.9g: %.9g", x, s);
        CHECK_SAY(fabs(mathematics_double.sine(x) - sin(x)) <= 3e-16, "double, %.9g", x);
        CHECK_SAY(fabs(mathematics_double.cosine(x) - cos(x)) <= 3e-16, "double, %.9g", x);
    }
    /* beyond the range: no garbage, and no loss of the origin */
    CHECK(fabs(mathematics_float.sine(3e38)) <= 1.0000003);
    CHECK(mathematics_float.sine(3e38) == mathematics_float.sine(1e5));
    CHECK(mathematics_float.cosine(-3e38) == mathematics_float.cosine(-1e5));
    CHECK(check_same_bits((float)mathematics_float.sine(0), 0));
}

static void exponential_and_logarithm(void) {
    const int count = 400000;
    for (int i = 0; i <= count; ++i) {
        const double x = (double)(float)(-86.49 + (88.72 + 86.49) * i / count);
        const double e = mathematics_float.exponential(x);
        CHECK_SAY(fabs(e - exp(x)) <= 1.5e-7 * exp(x), "exp of %.9g is %.9g", x, e);
    }
    CHECK(mathematics_float.exponential(0) == 1);
    CHECK(mathematics_float.exponential(88.73) == HUGE_VAL);
    CHECK(mathematics_float.exponential(3e38) == HUGE_VAL);
    CHECK(mathematics_float.exponential(-HUGE_VAL) == 0);
    CHECK(mathematics_float.exponential(-86.6) == 0);
    /* every positive float with some bits left out, denormals too */
    for (uint32_t bits = 1; bits < 0x7f800000u; bits += 4999) {
        float x;
        memcpy(&x, &bits, sizeof x);
        const double right = log((double)x), l = mathematics_float.logarithm((double)x);
        int exponent;
        frexp(right, &exponent);
        CHECK_SAY(fabs(l - right) <= ldexp(1, exponent - 24), "log of %.9g is %.9g", (double)x, l);
    }
    CHECK(mathematics_float.logarithm(1) == 0);
    CHECK(mathematics_float.logarithm(0) == -HUGE_VAL);
    CHECK(mathematics_float.logarithm(-1) == -HUGE_VAL);
    CHECK(mathematics_float.logarithm(HUGE_VAL) == HUGE_VAL);
}

static void selections(void) {
    CHECK(check_same_bits(spt_choose(1, 2.0f, 3.0f), 2) && check_same_bits(spt_choose(0, 2, 3), 3));
    CHECK(check_same_bits(spt_choose(0, 2, -0.0f), -0.0f));
    CHECK(spt_positive(-1) == 0 && spt_positive(2) == 2 && spt_positive(-(float)HUGE_VAL) == 0);
    CHECK(spt_negative(-1) == -1 && spt_negative(2) == 0);
    /* no zero of the other sign, whatever the compiler gets for zero */
    CHECK(check_same_bits(spt_positive(-1), 0) && check_same_bits(spt_positive(-0.0f), 0));
    CHECK(check_same_bits(spt_negative(1), 0) && check_same_bits(spt_clamp(-1, 0, 1), 0));
    CHECK(spt_positive((float)NAN) == 0 && spt_negative((float)NAN) == 0);
    CHECK(spt_clamp(-3, -1, 2) == -1 && spt_clamp(3, -1, 2) == 2 && spt_clamp(1, -1, 2) == 1);
    CHECK(spt_clamp((float)NAN, -1, 2) == -1);
    CHECK(spt_limit(-3, 2) == -2 && spt_limit(3, 2) == 2 && spt_limit(-1, 2) == -1);
    for (int i = -1000; i <= 1000; ++i) {
        const float x = (float)i / 8; /* halves away from zero */
        CHECK_SAY(spt_nearest(x) == (int)roundf(x), "%g: %d", (double)x, spt_nearest(x));
    }
}

void shapes_mathematics(void) {
    RUN(sine_and_cosine);
    RUN(exponential_and_logarithm);
    RUN(selections);
}
