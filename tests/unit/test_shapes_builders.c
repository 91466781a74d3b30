/* SPDX-License-Identifier: MIT
 *
 * Toroidal capsules of every flatness, and generalised distances by their definition. */
#include "test_shapes_parts.h"

#include <math.h>

#include <spheretrace/shapes.h>

#include "../check.h"
#include "test_shapes_oracle.h"

static double arc_ends[3][3];

static void arc_of_ends(double t, double point[3]) {
    shape_arc_point(arc_ends[0], arc_ends[1], arc_ends[2], t, point);
}

/* Ends near (-1, 0) and (1, 0) of a random plane, control at (place, 2 flat). */
static spt_arc random_arc(double flat) {
    const double a = check_uniform(0, 6), b = check_uniform(0, 3);
    const double along[3] = {cos(a), sin(a) * cos(b), sin(a) * sin(b)};
    const double across[3] = {-sin(a), cos(a) * cos(b), cos(a) * sin(b)};
    const double place = check_uniform(-0.5, 0.5);
    spt_point ends[3];
    for (int k = 0; k < 3; ++k) {
        arc_ends[0][k] = (double)(float)-along[k];
        arc_ends[1][k] = (double)(float)along[k];
        arc_ends[2][k] = (double)(float)(place * along[k] + 2 * flat * across[k]);
    }
    for (int k = 0; k < 3; ++k) {
        ends[k] = spt_point_of((float)arc_ends[k][0], (float)arc_ends[k][1], (float)arc_ends[k][2]);
    }
    return spt_arc_of(ends[0], ends[1], ends[2], 0.125f);
}

/* From almost a circle down to a straight line, the error stays the same. */
static void flatness(void) {
    for (int i = 0; i < 300; ++i) {
        /* height of control over the chord's length from 4 down to 1e-9, and 0 */
        const double flat = i % 20 == 19 ? 0 : 4 * pow(10, -9.6 * (i % 20) / 18.0);
        const spt_arc arc = random_arc(flat);
        check_context("height %g of the chord", flat);
        for (int k = 0; k < 10; ++k) {
            double p[3];
            for (int c = 0; c < 3; ++c) p[c] = (double)(float)check_uniform(-1.5, 1.5);
            const spt_point q = spt_point_of((float)p[0], (float)p[1], (float)p[2]);
            const double value = (double)spt_toroidal_capsule(q, &arc);
            const double searched = shape_curve_distance(arc_of_ends, p) - 0.125;
            /* 24 half units of the arc's size, 1 for a flat one: 1.5e-6 */
            const double limit = 24 * 0x1p-24 * (flat > 0.5 ? 4 * flat : 1);
            CHECK_SAY(fabs(value - searched) <= limit, "%.9g, found %.9g", value, searched);
        }
    }
}

/* The tetrahedron of test_shapes_table.h; equal_offsets makes its field the norm minus 0.5. */
static void tetrahedron_of(spt_half_space planes[4], int equal_offsets) {
    static const float of[4][4] = {
        {-1, 0, 0, 0.5f}, {0, -1, 0, 0.625f}, {0, 0, -1, 0.75f}, {0.48f, 0.6f, 0.64f, 0.875f}};
    for (int i = 0; i < 4; ++i) {
        planes[i].normal = spt_point_of(of[i][0], of[i][1], of[i][2]);
        planes[i].offset = equal_offsets ? 0.5f : of[i][3];
    }
}

/* The definition, with libm in double, for planes whose least offset is 0.5. */
static double by_definition(const spt_half_space *planes, double exponent, int slabs, spt_point p) {
    double terms[4], largest = 0, sum = 0;
    for (int i = 0; i < 4; ++i) {
        const spt_point n = planes[i].normal;
        const double height =
            (double)n.x * (double)p.x + (double)n.y * (double)p.y + (double)n.z * (double)p.z;
        terms[i] = (slabs ? fabs(height) : height) - ((double)planes[i].offset - 0.5);
        if (terms[i] < 0) terms[i] = 0;
        largest = terms[i] > largest ? terms[i] : largest;
    }
    if (!(largest > 0)) return -0.5;
    for (int i = 0; i < 4; ++i) sum += pow(terms[i] / largest, exponent);
    return largest * pow(sum, 1 / exponent) - 0.5;
}

static void generalised_distances(void) {
    static const float exponents[] = {2, 2.5f, 3, 7, 31.25f, 100, 512};
    spt_half_space planes[4];
    tetrahedron_of(planes, 0);
    for (int i = 0; i < 4000; ++i) {
        const double reach = i % 3 == 0 ? 1e4 : i % 3 == 1 ? 3 : 0.1;
        const float x = (float)check_uniform(-reach, reach),
                    y = (float)check_uniform(-reach, reach);
        const float z = (float)check_uniform(-reach, reach);
        const spt_point p = spt_point_of(x, y, z);
        /* 16 roundings of the coordinates, and 16 more with logarithms: see test_shapes.c */
        const double size = fabs((double)x) + fabs((double)y) + fabs((double)z) + 1;
        const double limit = 16 * 0x1p-24 * size;
        const float e = exponents[i % 7];
        const int squarings = 1 + i % 6;
        const double power = ldexp(1, squarings);
        check_context("exponents %g and %g at %g %g %g", (double)e, power, (double)x, (double)y,
                      (double)z);
        const double sided = (double)spt_generalised_distance(p, 4, planes, e);
        const double slabs = (double)spt_generalised_slabs(p, 4, planes, e);
        CHECK(fabs(sided - by_definition(planes, (double)e, 0, p)) <= 2 * limit);
        CHECK(fabs(slabs - by_definition(planes, (double)e, 1, p)) <= 2 * limit);
        const float squared = spt_generalised_distance_by_squaring(p, 4, planes, squarings);
        const float squared_slabs = spt_generalised_slabs_by_squaring(p, 4, planes, squarings);
        CHECK(fabs((double)squared - by_definition(planes, power, 0, p)) <= limit);
        CHECK(fabs((double)squared_slabs - by_definition(planes, power, 1, p)) <= limit);
    }
}

/* The bound on the slope is one, and not far off: by 12 % from exponent 4 on; below, for
 * half-spaces, by up to a root of 2, since it reckons with all of them at once. */
static void generalised_slopes(void) {
    static const float exponents[] = {2, 3, 4, 8, 32, 512};
    spt_half_space planes[4];
    tetrahedron_of(planes, 1);
    for (int i = 0; i < 12; ++i) {
        const float e = exponents[i / 2];
        const int slabs = i % 2;
        const double bound = (double)spt_generalised_lipschitz(4, planes, e, slabs);
        double largest = 0;
        check_context("exponent %g, slabs %d", (double)e, slabs);
        for (int k = 0; k < 4000; ++k) {
            const double z = check_uniform(-1, 1), a = check_uniform(0, 6.2832);
            const double r = sqrt(1 - z * z);
            const spt_point u = spt_point_of((float)(r * cos(a)), (float)(r * sin(a)), (float)z);
            const double norm = 0.5 + by_definition(planes, (double)e, slabs, u);
            largest = norm > largest ? norm : largest;
        }
        CHECK_SAY(largest <= bound * (1 + 2 * 0x1p-24), "%g beyond %g", largest, bound);
        CHECK_SAY(bound < largest * (e < 4 && !slabs ? 1.42 : 1.12), "%g, seen %g", bound, largest);
    }
}

void shapes_builders(void) {
    RUN(flatness);
    RUN(generalised_distances);
    RUN(generalised_slopes);
}
