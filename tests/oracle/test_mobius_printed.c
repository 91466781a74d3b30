/* SPDX-License-Identifier: MIT
 *
 * Misprints of Szécsi et al. as negative controls: the literal formula fails where the catalogue
 * says (rows P25, P26, S1, S2, S14 to S16), the library gives the right answer. Spheres' centers
 * and radii are in test_mobius_printed_spheres.c, S3 and S4 in test_mobius_refused.c. */
#include "../check.h"
#include "mobius_region.h"

#include <float.h>
#include <math.h>

static const double origin[3] = {0, 0, 0};

static spt_quaternion pure(const double v[3]) {
    return spt_quaternion_of(0, v[0], v[1], v[2]);
}

static spt_quaternion times(spt_quaternion p, spt_quaternion q) {
    return spt_quaternion_product(p, q);
}

static spt_quaternion bar(spt_quaternion q) {
    return spt_quaternion_conjugate(q);
}

static spt_quaternion reciprocal(spt_quaternion q) {
    return spt_quaternion_scaled(bar(q), 1 / spt_quaternion_square(q));
}

static void expect(spt_quaternion q, double x, double y, double z) {
    CHECK_SAY(fabs(q.real) <= 0x1p-50 && fabs(q.x - x) <= 0x1p-50 && fabs(q.y - y) <= 0x1p-50 &&
                  fabs(q.z - z) <= 0x1p-50,
              "%g + (%.17g, %.17g, %.17g)", q.real, q.x, q.y, q.z);
}

static spt_quaternion image_of(const spt_mobius *map, const double p[3]) {
    double image[3] = {0, 0, 0};
    CHECK(spt_mobius_point(map, p, image) == 1);
    return pure(image);
}

/* ---- Table 1 --------------------------------------------------------------------------------- */

static void P25_S1_S2_elementary_maps(void) {
    const double p[3] = {1, 2, 3}, x[3] = {1, 0, 0};
    const spt_quaternion i = spt_quaternion_of(0, 1, 0, 0), q = pure(p);
    const spt_quaternion zero = spt_quaternion_of(0, 0, 0, 0), one = spt_quaternion_of(1, 0, 0, 0);
    spt_mobius map = spt_mobius_identity();
    /* Reflection, printed -i q i: a half turn. */
    expect(spt_quaternion_scaled(times(i, times(q, i)), -1), 1, -2, -3);
    expect(times(i, times(q, i)), -1, 2, 3);
    CHECK(spt_mobius_reflection(x, 0, &map) == SPT_OK);
    expect(image_of(&map, p), -1, 2, 3);
    CHECK(spt_mobius_matrix(bar(i), zero, zero, i, &map) == SPT_OK); /* its matrix is right */
    CHECK(map.orientation == -1);
    expect(image_of(&map, p), -1, 2, 3);
    /* "Inversion" q^-1: its point reflection. */
    expect(reciprocal(q), -1.0 / 14, -2.0 / 14, -3.0 / 14);
    CHECK(spt_mobius_matrix(zero, one, one, zero, &map) == SPT_OK);
    CHECK(map.orientation == 1);
    expect(image_of(&map, p), -1.0 / 14, -2.0 / 14, -3.0 / 14);
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    expect(image_of(&map, p), 1.0 / 14, 2.0 / 14, 3.0 / 14);
}

/* ---- Appendix B ------------------------------------------------------------------------------ */

/* Without the bars Re(tau omega) is -tau . omega, and tau tau is -|tau|^2. */
static int printed_line(const spt_sphere_coefficients *s, const double tau[3],
                        const double omega[3], double t[2]) {
    const spt_quaternion o = pure(tau), w = pure(omega), beta = pure(s->beta);
    const double a = s->alpha, b = s->alpha * times(o, w).real + times(beta, w).real;
    const double c = s->alpha * times(o, o).real + 2 * times(beta, o).real + s->gamma;
    const double root = sqrt(b * b - a * c);
    t[0] = (-b - root) / a;
    t[1] = (-b + root) / a;
    return b * b - a * c >= 0 ? 2 : 0;
}

static void P26_S15_lines(void) {
    const spt_region unit_ball = {SPT_REGION_BALL, {0, 0, 0}, 1};
    spt_sphere_coefficients s = spt_region_coefficients(&unit_ball);
    const double from[3] = {-4, 0, 0}, along[3] = {1, 0, 0}, a[3] = {1, 2, 3}, b[3] = {-2, 5, 1};
    double t[2] = {0, 0}, worst = 0;
    int right = 0, met = 0;
    CHECK(!(fabs(times(pure(a), pure(b)).real + 11) > 0));      /* -a . b */
    CHECK(!(fabs(times(pure(a), bar(pure(b))).real - 11) > 0)); /* a . b */
    CHECK(printed_line(&s, from, along, t) == 2);
    CHECK(fabs(t[0] + 4 + sqrt(33)) < 1e-12 && fabs(t[1] + 4 - sqrt(33)) < 1e-12);
    CHECK(spt_sphere_meets_line(&s, from, along, t) == 2);
    CHECK(fabs(t[0] - 3) <= 0x1p-50 && fabs(t[1] - 5) <= 0x1p-50);
    for (int n = 0; n < 1000; ++n) {
        spt_region ball = {SPT_REGION_BALL, {0, 0, 0}, 0};
        double o[3], w[3], mended[2] = {0, 0}, length = 0;
        for (int i = 0; i < 3; ++i) {
            ball.center[i] = check_uniform(-500, 500);
            o[i] = check_uniform(-500, 500);
            w[i] = ball.center[i] - o[i] + check_uniform(-20, 20);
            length += w[i] * w[i];
        }
        for (int i = 0; i < 3; ++i) w[i] /= sqrt(length);
        ball.radius = check_uniform(50, 100);
        s = spt_region_coefficients(&ball);
        if (spt_sphere_meets_line(&s, o, w, mended) != 2) continue;
        ++met;
        for (int k = 0; k < 2; ++k) {
            double off = 0;
            for (int i = 0; i < 3; ++i) {
                const double d = o[i] + mended[k] * w[i] - ball.center[i];
                off += d * d;
            }
            CHECK_SAY(fabs(sqrt(off) - ball.radius) < 1e-9, "%g off", sqrt(off) - ball.radius);
        }
        if (printed_line(&s, o, w, t) == 2) {
            right += fabs(t[0] - mended[0]) < 1;
            worst = fmax(worst, fabs(t[0] - mended[0]));
        }
    }
    CHECK_SAY(met > 900 && right < met / 50 && worst > 500, "%d of %d right, worst %g", right, met,
              worst);
}

/* ---- Section 6: "advance to the sphere" ------------------------------------------------------ */

/* From (2, 0, 0), whose preimage in the unit sphere is (1/2, 0, 0). */
static void S14_advance_to_the_sphere(void) {
    const double from[3] = {2, 0, 0}, along[3] = {1, 0, 0};
    spt_region ball = {SPT_REGION_BALL, {0.5, 0, 0}, 1}, image;
    spt_mobius map = spt_mobius_identity();
    spt_sphere_coefficients s;
    double t[2] = {0, 0};
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    CHECK(spt_mobius_region(&map, &ball, &image) == SPT_OK);
    s = spt_region_coefficients(&image);
    /* An outside: the sphere lies behind, t = -4/3 at the far end. */
    CHECK(spt_sphere_meets_line(&s, from, along, t) == 2);
    CHECK(t[1] < 0 && fabs(t[1] + 4.0 / 3) <= 0x1p-49);
    CHECK(spt_mobius_exit(&map, from, along, 1) > DBL_MAX);
    /* A half space: no center to go by. */
    ball.radius = 0.5;
    CHECK(spt_mobius_region(&map, &ball, &image) == SPT_OK);
    s = spt_region_coefficients(&image);
    CHECK(image.kind == SPT_REGION_HALF_SPACE && !(fabs(s.alpha) > 0));
    CHECK(printed_line(&s, from, along, t) == 0 || !(fabs(t[0]) <= DBL_MAX) ||
          !(fabs(t[1]) <= DBL_MAX));
    CHECK(spt_mobius_exit(&map, from, along, 0.5) > DBL_MAX);
}

/* ---- Equation 3 ------------------------------------------------------------------------------ */

/* g_w = a g v^-1 - (a q + b) v^-1 c g v^-1, v = c q + d: as long as |DL| says, where the gradient
 * of the carried field, by differences of its values through point maps, is 1 / |DL| long. */
static void S16_gradient(void) {
    for (int n = 0; n < 300; ++n) {
        chain steps;
        spt_mobius map;
        double p[3], g[3], turned[3], literal_length, true_length, scale;
        spt_quaternion q, w, v, literal;
        extended h, along[3], ahead, behind;
        place from, to, side;
        chain_draw(&steps, 1 + n % 5, origin, 1);
        map = chain_build(&steps);
        for (int i = 0; i < 3; ++i) p[i] = check_uniform(-1, 1);
        for (int i = 0; i < 3; ++i) g[i] = check_uniform(-1, 1);
        from = place_of(p);
        to = chain_image(&steps, 0, from);
        scale = (double)chain_scale(&steps, 0, from);
        q = pure(p);
        w = pure(g);
        v = reciprocal(spt_quaternion_sum(times(map.c, q), map.d));
        literal = times(spt_quaternion_sum(times(map.a, q), map.b), v);
        literal = times(literal, times(map.c, times(w, v)));
        literal = spt_quaternion_sum(times(map.a, times(w, v)), spt_quaternion_scaled(literal, -1));
        literal_length = sqrt(spt_quaternion_square(literal) / spt_quaternion_square(w));
        /* The field g . q in the direction of its gradient's image. */
        for (int i = 0; i < 3; ++i)
            along[i] = (extended)g[i] / (extended)sqrt(spt_quaternion_square(w));
        chain_vector(&steps, 0, from, along);
        h = 1e-5L * (extended)scale;
        side = to;
        for (int i = 0; i < 3; ++i) side.at[i] = to.at[i] + h * along[i];
        ahead = extended_dot(place_of(g).at, chain_image(&steps, 1, side).at);
        for (int i = 0; i < 3; ++i) side.at[i] = to.at[i] - h * along[i];
        behind = extended_dot(place_of(g).at, chain_image(&steps, 1, side).at);
        true_length = (double)((ahead - behind) / (2 * h)) / sqrt(spt_quaternion_square(w));
        CHECK_SAY(fabs(literal_length / scale - 1) < 1e-6, "%g for %g", literal_length, scale);
        CHECK_SAY(fabs(true_length * scale - 1) < 1e-6, "%g for 1 / %g", true_length, scale);
        CHECK(fabs(literal_length / true_length / (scale * scale) - 1) < 1e-5);
        /* Right in its direction; the library's is as long as what it is given. */
        spt_mobius_vector(&map, p, g, turned);
        CHECK(fabs(spt_quaternion_square(pure(turned)) / spt_quaternion_square(w) - 1) < 1e-8);
        for (int i = 0; i < 3; ++i)
            CHECK(fabs((i == 0   ? literal.x
                        : i == 1 ? literal.y
                                 : literal.z) -
                       turned[i] * scale) < 1e-6 * scale);
    }
}

void suite_mobius_printed(void) {
    RUN(P25_S1_S2_elementary_maps);
    RUN(P26_S15_lines);
    RUN(S14_advance_to_the_sphere);
    RUN(S16_gradient);
}
