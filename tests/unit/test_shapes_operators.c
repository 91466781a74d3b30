/* SPDX-License-Identifier: MIT
 *
 * Operators of shapes.h on distances and on points, against what they mean, and the stretching of
 * space by the deforming ones against their derivatives. */
#include "test_shapes_parts.h"

#include <math.h>

#include <spheretrace/shapes.h>

#include "../check.h"

static void smooth_operators(void) {
    for (int i = 0; i < 20000; ++i) {
        const float a = (float)check_uniform(-2, 2), b = (float)check_uniform(-2, 2);
        const float k = i % 8 ? (float)check_uniform(0.01, 1.5) : 0;
        const float least = a < b ? a : b, largest = a < b ? b : a;
        const float u = spt_smooth_union(a, b, k), both = spt_smooth_intersection(a, b, k);
        check_context("a %g b %g k %g", (double)a, (double)b, (double)k);
        /* h^2/(4k) is 0 or more in float, too; at most k/4, with three roundings, one more for the
         * difference, of numbers below 3 */
        const double rounding = 4 * 0x1p-24 * 3;
        CHECK(u <= least);
        CHECK((double)u >= (double)least - (double)k / 4 - rounding);
        CHECK(both >= largest);
        CHECK((double)both <= (double)largest + (double)k / 4 + rounding);
        if (largest - least >= k) CHECK(u == least && both == largest);
        CHECK(check_same_bits(u, spt_smooth_union(b, a, k)));
        CHECK(check_same_bits(spt_smooth_difference(a, b, k), spt_smooth_intersection(a, -b, k)));
        CHECK(spt_smooth_difference(a, b, k) >= spt_difference(a, b));
        /* a change of both by at most e changes the blend by at most e */
        const float e = (float)check_uniform(0, 0.1);
        const float c = a + e * (float)check_uniform(-1, 1);
        const float d = b + e * (float)check_uniform(-1, 1);
        CHECK((double)fabsf(spt_smooth_union(c, d, k) - u) <= (double)e + 2 * rounding);
    }
    check_context("middle");
    CHECK(spt_smooth_union(1, 1, 2) == 0.5f && spt_smooth_intersection(1, 1, 2) == 1.5f);
}

/* Nothing here, or nothing beyond, may come in from a field as +infinity. */
static void operators_on_infinity(void) {
    const float values[] = {0, -0.0f, 1, -1, 3e38f, -3e38f, 1e-45f, (float)HUGE_VAL};
    enum { count = sizeof values / sizeof *values };
    for (int i = 0; i < count * count * count; ++i) {
        const float a = values[i % count], b = values[i / count % count];
        const float k = fabsf(values[i / count / count]);
        if (k > 3.3e38f) continue; /* k is finite */
        check_context("a %g b %g k %g", (double)a, (double)b, (double)k);
        CHECK(!isnan(spt_union(a, b)) && !isnan(spt_intersection(a, b)));
        CHECK(!isnan(spt_smooth_union(a, b, k)) && !isnan(spt_smooth_intersection(a, b, k)));
        CHECK(!isnan(spt_smooth_difference(a, b, k)) && !isnan(spt_difference(a, b)));
        if (a > 3.3e38f && b < 1e38f) CHECK(spt_smooth_union(a, b, k) == b);
    }
}

static void materials(void) {
    for (int i = 0; i < 2000; ++i) {
        const spt_surface a = spt_surface_of((float)check_uniform(-1, 1), 7);
        const spt_surface b = spt_surface_of((float)check_uniform(-1, 1), -9);
        const float k = 0.5f, x = a.distance, y = b.distance;
        const spt_surface joined = spt_surface_union(a, b), both = spt_surface_intersection(a, b);
        const spt_surface cut = spt_surface_difference(a, b);
        CHECK(joined.distance == spt_union(x, y) && joined.material == (x < y ? 7 : -9));
        CHECK(both.distance == spt_intersection(x, y) && both.material == (x > y ? 7 : -9));
        CHECK(cut.distance == spt_difference(x, y) && cut.material == (x > -y ? 7 : -9));
        const spt_surface blended = spt_surface_smooth_union(a, b, k);
        const spt_surface rounded = spt_surface_smooth_intersection(a, b, k);
        const spt_surface carved = spt_surface_smooth_difference(a, b, k);
        CHECK(blended.distance == spt_smooth_union(x, y, k));
        CHECK(rounded.distance == spt_smooth_intersection(x, y, k));
        CHECK(carved.distance == spt_smooth_difference(x, y, k));
        CHECK(blended.material == joined.material && rounded.material == both.material);
        CHECK(carved.material == cut.material);
    }
}

static void rotations(void) {
    const spt_rotation turn = spt_rotation_of(spt_point_of(0, 0, 3), 1.57079632679f);
    /* what stood on the x axis stands on the y axis: asked there, the shape sees its x axis */
    const spt_point p = spt_rotate(spt_point_of(0, 1, 0), &turn);
    CHECK(fabsf(p.x - 1) < 1e-6f && fabsf(p.y) < 1e-6f && fabsf(p.z) < 1e-6f);
    const spt_rotation none = spt_rotation_of(spt_point_of(0, 0, 0), 1);
    CHECK(none.x.x == 1 && none.y.y == 1 && none.z.z == 1 && none.x.y == 0 && none.z.x == 0);
    for (int i = 0; i < 500; ++i) {
        const spt_point axis = spt_point_of(
            (float)check_uniform(-1, 1), (float)check_uniform(-1, 1), (float)check_uniform(-1, 1));
        const float angle = (float)check_uniform(-100, 100);
        const spt_rotation r = spt_rotation_of(axis, angle);
        const spt_point on_axis = spt_rotate(axis, &r);
        /* three products of rounded entries and two sums: 8 half units of at most 1.5 */
        const float limit = 12 * 0x1p-24f;
        CHECK(fabsf(on_axis.x - axis.x) < limit && fabsf(on_axis.y - axis.y) < limit &&
              fabsf(on_axis.z - axis.z) < limit);
        CHECK(fabsf(spt_dot(r.x, r.y)) < limit && fabsf(spt_dot(r.y, r.z)) < limit &&
              fabsf(spt_dot(r.z, r.x)) < limit);
        CHECK(fabsf(spt_dot(r.x, r.x) - 1) < limit && fabsf(spt_dot(r.y, r.y) - 1) < limit &&
              fabsf(spt_dot(r.z, r.z) - 1) < limit);
        /* the trace is 1 + 2 cos(angle); the antisymmetric part, along the axis, turns right */
        const double trace = (double)r.x.x + (double)r.y.y + (double)r.z.z;
        CHECK(fabs(trace - 1 - 2 * cos((double)angle)) < (double)limit);
        const double handed = (double)axis.x * ((double)r.y.z - (double)r.z.y) +
                              (double)axis.y * ((double)r.z.x - (double)r.x.z) +
                              (double)axis.z * ((double)r.x.y - (double)r.y.x);
        const double length = sqrt((double)spt_dot(axis, axis));
        CHECK(fabs(handed / length - 2 * sin((double)angle)) < 1e-6);
    }
}

static double positive(double x) {
    return x > 0 ? x : 0;
}

/* Repeated: the least distance over all copies of a shape that is symmetric in its cell. */
static void repetition(void) {
    const spt_point period = spt_point_of(2, 1.5f, 0);
    for (int i = 0; i < 3000; ++i) {
        const spt_point p = spt_point_of((float)check_uniform(-9, 9), (float)check_uniform(-9, 9),
                                         (float)check_uniform(-3, 3));
        const float repeated = spt_box(spt_repeat(p, period), spt_point_of(0.5f, 0.25f, 0.75f));
        double least = HUGE_VAL;
        for (int x = -6; x <= 6; ++x) {
            for (int y = -7; y <= 7; ++y) {
                const double a = fabs((double)p.x - 2 * x) - 0.5;
                const double b = fabs((double)p.y - 1.5 * y) - 0.25;
                const double c = fabs((double)p.z) - 0.75;
                const double u = positive(a), v = positive(b), w = positive(c);
                const double inner = fmax(a, fmax(b, c));
                const double d = inner < 0 ? inner : sqrt(u * u + v * v + w * w);
                least = d < least ? d : least;
            }
        }
        /* a cell too far by one half unit of the coordinate, 9, and eight roundings below 4 */
        CHECK_SAY(fabs((double)repeated - least) <= (9 + 8 * 4) * 0x1p-24, "%g for %g",
                  (double)repeated, least);
    }
    /* beyond 2^22 periods the last copy stands */
    const spt_point far = spt_repeat(spt_point_of(3e7f, 0, 1e30f), period);
    CHECK(far.x == 3e7f - 8388608.0f && far.z == 1e30f);
}

/* The largest factor by which a map stretches at a point: the largest singular value of its
 * derivative, by central differences and the power method. */
static double stretch(spt_point (*map)(spt_point p, float rate), float rate, const double p[3]) {
    const float step = 1.0f / 64;
    double jacobian[3][3], v[3] = {0.6, 0.5, 0.7}, length = 0;
    for (int k = 0; k < 3; ++k) {
        const spt_point offset =
            spt_point_of(k == 0 ? step : 0, k == 1 ? step : 0, k == 2 ? step : 0);
        const spt_point a = map(
            spt_point_of((float)p[0] - offset.x, (float)p[1] - offset.y, (float)p[2] - offset.z),
            rate);
        const spt_point b = map(
            spt_point_of((float)p[0] + offset.x, (float)p[1] + offset.y, (float)p[2] + offset.z),
            rate);
        jacobian[0][k] = ((double)b.x - (double)a.x) / (2 * (double)step);
        jacobian[1][k] = ((double)b.y - (double)a.y) / (2 * (double)step);
        jacobian[2][k] = ((double)b.z - (double)a.z) / (2 * (double)step);
    }
    for (int i = 0; i < 200; ++i) {
        double w[3] = {0, 0, 0}, u[3] = {0, 0, 0};
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) w[r] += jacobian[r][c] * v[c];
        }
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) u[c] += jacobian[r][c] * w[r];
        }
        length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        for (int c = 0; c < 3; ++c) v[c] = u[c] / length;
    }
    return sqrt(length);
}

static spt_point twist(spt_point p, float rate) {
    return spt_twist(p, rate);
}

static spt_point bend(spt_point p, float rate) {
    return spt_bend(p, rate);
}

/* The constants are enough and no more than needed: attained at their radius. */
static void stretching(void) {
    double most_twist = 0, most_bend = 0;
    const float rate = 0.75f, radius = 2;
    const double twist_bound = (double)spt_twist_lipschitz(rate, radius);
    const double bend_bound = (double)spt_bend_lipschitz(-rate, radius);
    for (int i = 0; i < 2000; ++i) {
        const double angle = check_uniform(0, 6.2832), other = check_uniform(-2, 2);
        const double u = (double)radius * cos(angle), v = (double)radius * sin(angle);
        const double about_y[3] = {u, other, v}, about_z[3] = {u, v, other};
        const double a = stretch(twist, rate, about_y), b = stretch(bend, -rate, about_z);
        most_twist = a > most_twist ? a : most_twist;
        most_bend = b > most_bend ? b : most_bend;
    }
    /* Differences are off by step^2/6 times the third derivatives, at most
     * rate^3 * radius + 3 rate^2 = 2.6: 1e-4; by rounding, 8 * 2^-24 / step = 3e-5; and the samples
     * come within 2e-5. */
    CHECK_SAY(fabs(most_twist - twist_bound) < 2e-4, "%.6f, stated %.6f", most_twist, twist_bound);
    CHECK_SAY(fabs(most_bend - bend_bound) < 2e-4, "%.6f, stated %.6f", most_bend, bend_bound);
    /* the sense of the twist: at height y the slice is turned by rate * y, z towards x */
    const spt_point p = spt_twist(spt_point_of(sinf(0.5f), 1, cosf(0.5f)), 0.5f);
    CHECK(fabsf(p.x) < 1e-6f && fabsf(p.z - 1) < 1e-6f && p.y == 1);
    /* and of the bend: at x it is turned by rate * x, x towards y */
    const spt_point q = spt_bend(spt_point_of(1, 0, 3), 0.5f);
    CHECK(fabsf(q.x - cosf(0.5f)) < 1e-6f && fabsf(q.y + sinf(0.5f)) < 1e-6f && q.z == 3);
}

void shapes_operators(void) {
    RUN(smooth_operators);
    RUN(operators_on_infinity);
    RUN(materials);
    RUN(rotations);
    RUN(repetition);
    RUN(stretching);
}
