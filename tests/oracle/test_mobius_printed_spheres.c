/* SPDX-License-Identifier: MIT
 *
 * Misprints of Algorithm 3 of Szécsi et al. and what its coefficients lose, as negative controls:
 * center and radius (rows P20, S8, S9), the radius in float (P21), range and purity over many
 * levels (P27). The library has each right. */
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

static void expect(spt_quaternion q, double x, double y, double z) {
    CHECK_SAY(fabs(q.real) <= 0x1p-50 && fabs(q.x - x) <= 0x1p-50 && fabs(q.y - y) <= 0x1p-50 &&
                  fabs(q.z - z) <= 0x1p-50,
              "%g + (%.17g, %.17g, %.17g)", q.real, q.x, q.y, q.z);
}

/* ---- Algorithm 3, lines 9 and 10 ------------------------------------------------------------- */

/* Appendix A, right as printed: nothing is projected, nothing rescaled. */
typedef struct printed_sphere {
    double alpha, gamma;
    spt_quaternion beta;
} printed_sphere;

static printed_sphere printed_pull_back(const spt_mobius *m, const printed_sphere *s) {
    printed_sphere t;
    const spt_quaternion beta = s->beta, other = bar(s->beta);
    t.alpha = s->alpha * spt_quaternion_square(m->a) +
              2 * times(bar(m->c), times(beta, m->a)).real + s->gamma * spt_quaternion_square(m->c);
    t.beta = spt_quaternion_sum(
        spt_quaternion_sum(spt_quaternion_scaled(times(bar(m->b), m->a), s->alpha),
                           times(bar(m->d), times(beta, m->a))),
        spt_quaternion_sum(times(bar(m->b), times(other, m->c)),
                           spt_quaternion_scaled(times(bar(m->d), m->c), s->gamma)));
    t.gamma = s->alpha * spt_quaternion_square(m->b) +
              2 * times(bar(m->d), times(beta, m->b)).real + s->gamma * spt_quaternion_square(m->d);
    return t;
}

static printed_sphere printed_of(const spt_region *ball) {
    printed_sphere s;
    s.alpha = 1;
    s.beta = pure(ball->center);
    s.gamma = spt_quaternion_square(s.beta) - ball->radius * ball->radius;
    return s;
}

/* The ball of radius 1/2 around (2, 1, 0) through q -> 2 q, with the matrix of Table 1. */
static void S8_S9_center_and_radius(void) {
    const spt_region ball = {SPT_REGION_BALL, {2, 1, 0}, 0.5};
    const printed_sphere s = printed_of(&ball);
    spt_mobius map = spt_mobius_identity(), back;
    spt_region image = ball;
    printed_sphere t;
    map.a.real = 2; /* not brought to |lambda| = 1 */
    t = printed_pull_back(&map, &s);
    CHECK(!(fabs(t.alpha - 4) > 0) && !(fabs(t.gamma - 4.75) > 0));
    expect(t.beta, 4, 2, 0);
    /* kappa = beta / gamma, and |kappa|^2 - gamma even of the right kappa */
    CHECK(fabs(t.beta.x / t.gamma - 0.84) < 0.005 && fabs(t.beta.y / t.gamma - 0.42) < 0.005);
    CHECK(!(fabs(spt_quaternion_square(t.beta) / 16 - t.gamma + 3.5) > 0));
    CHECK(!(fabs(spt_quaternion_square(t.beta) / 16 - t.gamma / t.alpha - 0.0625) > 0));
    CHECK(spt_mobius_dilation(2, &map) == SPT_OK);
    back = spt_mobius_inverse(&map);
    CHECK(spt_mobius_region(&back, &ball, &image) == SPT_OK);
    CHECK(image.kind == SPT_REGION_BALL && fabs(image.radius - 0.25) <= 0x1p-50);
    expect(pure(image.center), 1, 0.5, 0);
}

static int as_solid(const solid *truth, spt_quaternion center, double radius, double tolerance) {
    const double v[3] = {center.x, center.y, center.z};
    const double size = (double)truth->radius + (double)extended_length(truth->center);
    return (double)extended_distance(place_of(v).at, truth->center) <= tolerance * size &&
           fabs(radius - (double)truth->radius) <= tolerance * size;
}

/* Kernel balls of radius 0.1 to 1 near the origin, seen through chains: right for 0 of 2000 maps,
 * mended for all. Coefficients lose some digits here: to 1e-6. */
static void P20_center_and_radius_of_2000_maps(void) {
    int printed = 0, mended = 0, of_library = 0;
    for (int n = 0; n < 2000; ++n) {
        chain steps;
        spt_mobius map, back;
        const spt_region ball = {SPT_REGION_BALL,
                                 {check_uniform(-1, 1), check_uniform(-1, 1), check_uniform(-1, 1)},
                                 check_uniform(0.1, 1)};
        spt_region kernel = ball;
        printed_sphere s = printed_of(&ball);
        solid truth;
        chain_draw(&steps, 1 + n % 4, origin, 1);
        steps.steps[0] = chain_draw_step(CHAIN_INVERSION, place_of(origin).at, 1.5);
        map = chain_build(&steps);
        back = spt_mobius_inverse(&map);
        truth = chain_solid(&steps, 1, solid_of(&ball));
        s = printed_pull_back(&map, &s);
        if (truth.kind == SPT_REGION_BALL || truth.kind == SPT_REGION_OUTSIDE) {
            const double square = spt_quaternion_square(s.beta);
            printed += as_solid(&truth, spt_quaternion_scaled(s.beta, 1 / s.gamma),
                                sqrt(square / (s.gamma * s.gamma) - s.gamma), 1e-6);
            mended += as_solid(&truth, spt_quaternion_scaled(s.beta, 1 / s.alpha),
                               sqrt(square / (s.alpha * s.alpha) - s.gamma / s.alpha), 1e-6);
        }
        CHECK(spt_mobius_region(&back, &ball, &kernel) == SPT_OK);
        of_library += kernel.kind == (uint32_t)truth.kind &&
                      as_solid(&truth, pure(kernel.center), kernel.radius, 1e-6);
    }
    CHECK_SAY(printed == 0, "printed right %d times", printed);
    CHECK_SAY(mended == 2000, "mended right %d times", mended);
    CHECK_SAY(of_library == 2000, "library right %d times", of_library);
}

/* The same radius in float: rho of .01 and .001, some units from the origin. What gamma loses. */
static float radius_in_float(const spt_mobius *map, const spt_region *ball) {
    float v[4][4], alpha, beta[4] = {0}, gamma, square = 0;
    const spt_quaternion *const entries[4] = {&map->a, &map->b, &map->c, &map->d};
    const float k[3] = {(float)ball->center[0], (float)ball->center[1], (float)ball->center[2]};
    const float rho = (float)ball->radius;
    const float own = k[0] * k[0] + k[1] * k[1] + k[2] * k[2] - rho * rho;
    float length[4];
    for (int i = 0; i < 4; ++i) {
        v[i][0] = (float)entries[i]->real;
        v[i][1] = (float)entries[i]->x;
        v[i][2] = (float)entries[i]->y;
        v[i][3] = (float)entries[i]->z;
        length[i] = v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2] + v[i][3] * v[i][3];
    }
    /* p* q, and p* k q, each product rounded to float. */
#define FLOAT_PRODUCT(p, q, r) \
    do { \
        r[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3]; \
        r[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2]; \
        r[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1]; \
        r[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]; \
    } while (0)
    {
        const float b[4] = {0, k[0], k[1], k[2]}, o[4] = {0, -k[0], -k[1], -k[2]};
        float bars[4][4], ba[4], bb[4], oc[4], one[4], two[4], three[4], four[4], ca[4], db[4];
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) bars[i][j] = j == 0 ? v[i][j] : -v[i][j];
        FLOAT_PRODUCT(b, v[0], ba);
        FLOAT_PRODUCT(b, v[1], bb);
        FLOAT_PRODUCT(o, v[2], oc);
        FLOAT_PRODUCT(bars[2], ba, ca);
        FLOAT_PRODUCT(bars[3], bb, db);
        FLOAT_PRODUCT(bars[1], v[0], one);
        FLOAT_PRODUCT(bars[3], ba, two);
        FLOAT_PRODUCT(bars[1], oc, three);
        FLOAT_PRODUCT(bars[3], v[2], four);
        alpha = length[0] + 2 * ca[0] + own * length[2];
        gamma = length[1] + 2 * db[0] + own * length[3];
        for (int i = 1; i < 4; ++i) {
            beta[i] = one[i] + two[i] + three[i] + own * four[i];
            square += beta[i] / alpha * (beta[i] / alpha);
        }
    }
#undef FLOAT_PRODUCT
    return sqrtf(square - gamma / alpha);
}

static void P21_radius_of_small_probes(void) {
    static const double radii[] = {0.01, 0.001};
    for (int i = 0; i < 2; ++i) {
        double worst = 0, of_library = 0;
        int none = 0;
        for (int n = 0; n < 4000; ++n) {
            chain steps;
            spt_mobius map, back;
            spt_region ball = {SPT_REGION_BALL, {0, 0, 0}, 0}, kernel = {0, {0, 0, 0}, 0};
            place there = place_of(origin);
            solid truth;
            float seen;
            chain_draw(&steps, 3, origin, 2);
            map = chain_build(&steps);
            back = spt_mobius_inverse(&map);
            there = chain_image(&steps, 0, there);
            for (int k = 0; k < 3; ++k)
                ball.center[k] = (double)(float)((double)there.at[k] + check_uniform(-1, 1));
            ball.radius = (double)(float)radii[i];
            truth = chain_solid(&steps, 1, solid_of(&ball));
            if (truth.kind != SPT_REGION_BALL) continue;
            seen = radius_in_float(&map, &ball);
            if (seen - seen > -1)
                worst = fmax(worst, fabs((double)seen / (double)truth.radius - 1));
            else
                ++none;
            CHECK(spt_mobius_region(&back, &ball, &kernel) == SPT_OK);
            of_library = fmax(of_library, fabs(kernel.radius / (double)truth.radius - 1));
        }
        check_context("radius %g", radii[i]);
        CHECK_SAY(worst > (i == 0 ? 1 : 10), "%g at most", worst);
        CHECK_SAY(none > (i == 0 ? 4 : 200), "%d NaN", none);
        CHECK_SAY(of_library < 1e-10, "%g at most", of_library);
    }
}

/* ---- Appendix A over many levels ------------------------------------------------------------- */

/* Re beta' stays below 1e-10 of beta' in double, but is not zero; the coefficients grow out of
 * float's range where each pull-back does not rescale them, which the library's does. */
static void P27_pure_and_in_range(void) {
    const double by[3] = {30, 40, -20};
    const spt_region ball = {SPT_REGION_BALL, {1, 2, -1}, 0.5};
    double impure = 0;
    int beyond = 0;
    for (int n = 0; n < 100; ++n) {
        printed_sphere literal = printed_of(&ball);
        spt_sphere_coefficients s = spt_region_coefficients(&ball);
        int levels = 0;
        for (int i = 0; i < chain_most; ++i) {
            spt_mobius map = spt_mobius_identity(), turn = spt_mobius_identity();
            double axis[3], largest;
            for (int k = 0; k < 3; ++k) axis[k] = check_uniform(-1, 1);
            CHECK(spt_mobius_inversion(by, 1, &map) == SPT_OK);
            CHECK(spt_mobius_rotation(axis, check_uniform(-3, 3), &turn) == SPT_OK);
            CHECK(spt_mobius_compose(&turn, &map, &map) == SPT_OK);
            literal = printed_pull_back(&map, &literal);
            s = spt_mobius_pull_back(&map, &s);
            impure =
                fmax(impure, fabs(literal.beta.real) / sqrt(spt_quaternion_square(literal.beta)));
            largest = fmax(fmax(fabs(s.alpha), fabs(s.gamma)),
                           fmax(fabs(s.beta[0]), fmax(fabs(s.beta[1]), fabs(s.beta[2]))));
            CHECK_SAY(fabs(largest - 1) <= 4 * DBL_EPSILON, "largest %.17g", largest);
            if (levels == 0 && fmax(fabs(literal.alpha), fabs(literal.gamma)) > (double)FLT_MAX)
                levels = i + 1;
        }
        beyond += levels != 0;
    }
    CHECK_SAY(impure > 0 && impure < 1e-10, "real part %g", impure);
    CHECK_SAY(beyond == 100, "%d of 100 leave float", beyond);
}

void suite_mobius_printed_spheres(void) {
    RUN(S8_S9_center_and_radius);
    RUN(P20_center_and_radius_of_2000_maps);
    RUN(P21_radius_of_small_probes);
    RUN(P27_pure_and_in_range);
}
