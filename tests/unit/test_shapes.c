/* SPDX-License-Identifier: MIT
 *
 * The fields of test_shapes_list.h against what they promise: distances found by search, slopes,
 * convexity, the double build, extreme points. Mathematics, operators and builders by themselves
 * are in the files that test_shapes_parts.h names. */
#include <math.h>

#include "../check.h"
#include "test_shapes_parts.h"
#include "test_shapes_table.h"

/* What rounding does to a float field of slope L at p. None has more than 16 roundings between p
 * and its value, each half a unit, 2^-24, of something no larger than the coordinates and the body
 * (4). The general power goes through a logarithm, an exponential and back: its largest term, 1, is
 * exact, the others are added to it with the relative error of exponent * log, and the root divides
 * by the exponent, so that 16 more cover it. */
static double rounding(const shape_entry *shape, double slope, const double p[3]) {
    const int roundings = shape->flags & SHAPE_POWERS ? 32 : 16;
    return roundings * 0x1p-24 * slope * (fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + 4);
}

/* The double fields, likewise; sines and constants that are floats are none of their errors. */
static double rounding_double(const shape_entry *shape, double slope, const double p[3]) {
    return rounding(shape, slope, p) * 0x1p-29;
}

/* A point whose coordinates are floats. */
static void random_point(double reach, double p[3]) {
    for (int k = 0; k < 3; ++k) p[k] = (double)(float)check_uniform(-reach, reach);
}

static double value_at(const shape_entry *shape, const double p[3]) {
    return shape->value(p[0], p[1], p[2]);
}

/* Exact where promised, else never farther than the surface; the sign that of the body. */
static void distances_by_search(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        const shape_entry *shape = &shapes_double[i];
        if (shape->body == NULL) continue;
        check_context("%s", shape->name);
        const double slope = shape->lipschitz();
        /* directions made of floats are unit vectors to 2^-24; nothing here is longer than 4 */
        const double constants = 4 * 0x1p-24;
        for (int k = 0; k < 32; ++k) {
            double p[3];
            random_point(k % 2 ? 4 : 1, p);
            const double searched = shape_search(shape->body, p), value = value_at(shape, p);
            const int exact = searched > 0 ? SHAPE_EXACT_OUTSIDE : SHAPE_EXACT_INSIDE;
            CHECK_SAY(value * searched >= 0, "%g where %g was found", value, searched);
            CHECK_SAY(fabs(value) <= slope * fabs(searched) + constants,
                      "%.9g, found %.9g at %g %g %g", value, searched, p[0], p[1], p[2]);
            CHECK_SAY(!(shape->flags & exact) || fabs(value) >= fabs(searched) - SHAPE_SEARCHED,
                      "%.9g, found %.9g at %g %g %g", value, searched, p[0], p[1], p[2]);
        }
    }
}

/* The ellipsoid's bound is no worse than its radii, 0.5, 1 and 2, and exact on the axes. */
static void ellipsoid_quality(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        const shape_entry *shape = &shapes_double[i];
        if (shape->body != &body_ellipsoid) continue;
        for (int k = 0; k < 100; ++k) {
            double p[3];
            random_point(k % 2 ? 4 : 1, p);
            const double searched = shape_search(shape->body, p), value = value_at(shape, p);
            CHECK_SAY(fabs(value) >= 0.25 * (fabs(searched) - SHAPE_SEARCHED), "%g for %g", value,
                      searched);
        }
        CHECK(shape->value(1.5, 0, 0) == 1);
        CHECK(shape->value(0, -3, 0) == 2);
        CHECK(shape->value(0, 0, 2.5) == 0.5);
    }
}

/* Near and far; the bound grows with the coordinates. */
static void float_against_double(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        check_context("%s", shapes_float[i].name);
        const double slope = shapes_double[i].lipschitz();
        for (int k = 0; k < 3000; ++k) {
            double p[3];
            random_point(k % 4 == 3 ? 200 : k % 2 ? SHAPE_REACH * 0.7 : 1.5, p);
            const double single = value_at(&shapes_float[i], p);
            const double twice = value_at(&shapes_double[i], p);
            const double limit = rounding(&shapes_double[i], slope, p);
            CHECK_SAY(fabs(single - twice) <= limit, "%.9g, in double %.9g at %g %g %g, limit %g",
                      single, twice, p[0], p[1], p[2], limit);
        }
    }
}

/* The Lipschitz constant, over pairs from far to very near. */
static void slopes(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        const shape_entry *shape = &shapes_double[i], *single = &shapes_float[i];
        check_context("%s", shape->name);
        const double slope = shape->lipschitz();
        for (int k = 0; k < 3000; ++k) {
            double p[3], q[3];
            const double step = exp(check_uniform(-12, 1));
            random_point(SHAPE_REACH * 0.4, p);
            for (int c = 0; c < 3; ++c) {
                q[c] = (double)(float)(p[c] + step * check_uniform(-1, 1));
            }
            const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
            const double apart = sqrt(x * x + y * y + z * z);
            const double change = fabs(value_at(shape, p) - value_at(shape, q));
            const double change_single = fabs(value_at(single, p) - value_at(single, q));
            CHECK_SAY(change <= slope * apart + rounding_double(shape, slope, p) * 2,
                      "changes by %g within %g", change, apart);
            CHECK_SAY(change_single <=
                          slope * apart + rounding(shape, slope, p) + rounding(shape, slope, q),
                      "in float, changes by %g within %g", change_single, apart);
        }
    }
}

/* On a segment, a convex function lies below its chord. */
static void convexity(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        const shape_entry *shape = &shapes_double[i];
        if (!(shape->flags & SHAPE_CONVEX)) continue;
        check_context("%s", shape->name);
        const double slope = shape->lipschitz();
        for (int k = 0; k < 3000; ++k) {
            double p[3], q[3], m[3];
            const double t = check_uniform(0, 1);
            random_point(3, p);
            random_point(3, q);
            for (int c = 0; c < 3; ++c) m[c] = p[c] + t * (q[c] - p[c]);
            const double chord = value_at(shape, p) + t * (value_at(shape, q) - value_at(shape, p));
            CHECK_SAY(value_at(shape, m) <= chord + rounding_double(shape, slope, p) * 2,
                      "%.12g above the chord, %.12g", value_at(shape, m), chord);
        }
    }
}

static const double extremes[] = {0,       -0.0,  1e-38, -1e-38, 1e-45,
                                  -1e-42,  1,     -1,    1e18,   -1e18,
                                  1.85e19, -1e30, 3e38,  -3e38,  3.4028234663852886e38};

/* No finite point gives NaN, whatever over- or underflows, nor a body -infinity. */
static void extreme_points(void) {
    enum { count = sizeof extremes / sizeof *extremes };
    for (size_t i = 0; i < shape_count; ++i) {
        check_context("%s", shapes_float[i].name);
        for (int k = 0; k < count * count * count; ++k) {
            const double x = (double)(float)extremes[k % count];
            const double y = (double)(float)extremes[k / count % count];
            const double z = (double)(float)extremes[k / count / count];
            const double single = shapes_float[i].value(x, y, z);
            const double twice = shapes_double[i].value(x, y, z);
            CHECK_SAY(!isnan(single) && !isnan(twice), "%g %g at %g %g %g", single, twice, x, y, z);
            CHECK_SAY(shapes_float[i].body == NULL || single > -HUGE_VAL, "at %g %g %g", x, y, z);
        }
    }
}

/* Below 1e18, nothing overflows: bodies that stand in reach are far and outside. */
static void far_points(void) {
    for (size_t i = 0; i < shape_count; ++i) {
        const shape_entry *shape = &shapes_float[i];
        if (shape->body == NULL) continue;
        check_context("%s", shape->name);
        const double slope = shape->lipschitz();
        for (int k = 0; k < 300; ++k) {
            double p[3];
            const double far = exp(check_uniform(5, 41)); /* to 6e17 */
            random_point(far, p);
            const double from_centre = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            const double value = value_at(shape, p);
            CHECK_SAY(value <= slope * (from_centre + 5) + rounding(shape, slope, p), "%g at %g",
                      value, from_centre);
            CHECK_SAY(!(shape->flags & SHAPE_EXACT_OUTSIDE) ||
                          value >= from_centre - 5 - rounding(shape, slope, p),
                      "%g at %g", value, from_centre);
        }
    }
}

/* One point at a time and many in a loop that the compiler vectorised: the same bits. */
static void loops_and_points(void) {
    enum { edge = sizeof extremes / sizeof *extremes };
    for (size_t i = 0; i < shape_count; ++i) {
        check_context("%s", shapes_float[i].name);
        for (int round = 0; round < 20; ++round) {
            double x[SHAPE_BATCH], y[SHAPE_BATCH], z[SHAPE_BATCH], values[SHAPE_BATCH];
            for (int k = 0; k < SHAPE_BATCH; ++k) {
                double p[3];
                random_point(round % 2 ? 2 : 50, p);
                if (round == 0) p[k % 3] = (double)(float)extremes[k % edge];
                x[k] = p[0];
                y[k] = p[1];
                z[k] = p[2];
            }
            const size_t count = (size_t)(SHAPE_BATCH - round);
            shapes_float[i].values(count, x, y, z, values);
            for (size_t k = 0; k < count; ++k) {
                const float one = (float)shapes_float[i].value(x[k], y[k], z[k]);
                CHECK_SAY(check_same_bits(one, (float)values[k]), "%.9g alone, %.9g in a loop",
                          (double)one, values[k]);
            }
        }
    }
}

void suite_shapes(void) {
    RUN(distances_by_search);
    RUN(ellipsoid_quality);
    RUN(float_against_double);
    RUN(slopes);
    RUN(convexity);
    RUN(extreme_points);
    RUN(far_points);
    RUN(loops_and_points);
    shapes_mathematics();
    shapes_operators();
    shapes_builders();
}
