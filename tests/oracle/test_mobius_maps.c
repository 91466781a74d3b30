/* SPDX-License-Identifier: MIT
 *
 * Maps of mobius.h at points, poles and vectors against chains of elementary maps, both ways;
 * inverses and compositions. Every tolerance is of the error scale of mobius_chain.h.
 * Refusals are in test_mobius_refused.c. */
#include "../check.h"
#include "mobius_chain.h"

#include <float.h>
#include <math.h>

static const extended unit = 0x1p-53L;

/* What a test draws: a chain, the body that it is drawn around, the map. */
typedef struct drawn_map {
    chain steps;
    spt_mobius map, inverse;
    double center[3], extent;
} drawn_map;

static void draw(drawn_map *one, int n) {
    one->extent = pow(10, check_uniform(-7, 7));
    for (int i = 0; i < 3; ++i) one->center[i] = one->extent * check_uniform(-1, 1);
    if (n % 3 == 0) {
        chain_draw_wild(&one->steps, 1 + n % 4);
    } else {
        chain_draw(&one->steps, 1 + n % chain_most, one->center, one->extent);
    }
    one->map = chain_build(&one->steps);
    one->inverse = spt_mobius_inverse(&one->map);
    check_context("chain %d of %d steps", n, one->steps.count);
}

/* A point near the body; of some the images are asked for far out, of some close to the pole. In
 * doubles, which both sides then take as exact. */
static void draw_point(const drawn_map *one, int back, int n, double point[3]) {
    const place pole = chain_image(&one->steps, !back, place_infinite());
    place p = place_of(one->center);
    double reach = one->extent * (n % 5 == 1 ? pow(10, check_uniform(0, 7)) : 2);
    if (back) {
        reach *= (double)chain_scale(&one->steps, 0, p);
        p = chain_image(&one->steps, 0, p);
    }
    if (n % 5 == 2 && !pole.infinite) {
        reach = (double)extended_distance(p.at, pole.at) * pow(10, check_uniform(-6, 0));
        p = pole;
    }
    for (int i = 0; i < 3; ++i) point[i] = (double)p.at[i] + reach * check_uniform(-1, 1);
}

/* Where the error of c p + d exceeds a thousandth of it, first order says nothing. */
static int decided(const moduli *n, place from, extended scale) {
    return 16 * unit * error_relative(n, from, scale) < 1e-3L;
}

static int is_infinite(const double point[3]) {
    return point[0] > DBL_MAX && point[1] > DBL_MAX && point[2] > DBL_MAX;
}

/* ---- Points ---------------------------------------------------------------------------------- */

static void compare_point(const drawn_map *one, int back, const moduli *n, const double point[3],
                          chain_tally *tally) {
    const spt_mobius *map = back ? &one->inverse : &one->map;
    const place from = place_of(point), to = chain_image(&one->steps, back, from);
    const extended scale = chain_scale(&one->steps, back, from);
    double image[3] = {0, 0, 0};
    extended off;
    if (to.infinite || !decided(n, from, scale)) return;
    CHECK(spt_mobius_point(map, point, image) == 1);
    off = extended_distance(place_of(image).at, to.at);
    chain_count(tally, off, error_of_point(n, from, to, scale));
    CHECK_SAY(chain_close(&one->steps, off, error_of_point(n, from, to, scale)),
              "back %d: off by %Lg, %Lg units", back, off,
              off / unit / error_of_point(n, from, to, scale));
    off = fabsl((extended)spt_mobius_scale(map, point) / scale - 1);
    chain_count(tally, off, 2 * error_relative(n, from, scale));
    CHECK_SAY(chain_close(&one->steps, off, 2 * error_relative(n, from, scale)),
              "scale off by %Lg, %Lg units", off, off / unit / 2 / error_relative(n, from, scale));
}

static void points(void) {
    chain_tally tally = {0, 0};
    for (int n = 0; n < 1500; ++n) {
        drawn_map one;
        draw(&one, n);
        CHECK(one.map.orientation == chain_orientation(&one.steps));
        CHECK(one.inverse.orientation == one.map.orientation);
        for (int back = 0; back < 2; ++back) {
            const moduli moduli_of = chain_moduli(&one.steps, back);
            for (int i = 0; i < 5; ++i) {
                double p[3];
                draw_point(&one, back, i, p);
                compare_point(&one, back, &moduli_of, p, &tally);
            }
        }
    }
    CHECK_SAY(chain_sharp(&tally), "%d of %d beyond 16u", tally.beyond, tally.compared);
}

/* Infinity goes to the pole of the inverse, and what is not finite counts as infinity. */
static void infinity_and_poles(void) {
    static const double not_finite[3] = {HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (int n = 0; n < 300; ++n) {
        drawn_map one;
        draw(&one, n);
        for (int back = 0; back < 2; ++back) {
            const spt_mobius *map = back ? &one.inverse : &one.map;
            const moduli moduli_of = chain_moduli(&one.steps, back);
            const place to = chain_image(&one.steps, back, place_infinite());
            double p[3] = {1, 2, 3}, image[3] = {0, 0, 0};
            p[n % 3] = not_finite[n / 3 % 3];
            if (to.infinite) {
                CHECK(spt_mobius_point(map, p, image) == 0);
                CHECK(is_infinite(image));
            } else {
                /* (a infinity + b)(c infinity + d)^-1 = a c^-1 */
                const extended c =
                    chain_lower(&one.steps, back, chain_image(&one.steps, !back, place_infinite()));
                const extended error = (moduli_of.a + extended_length(to.at) * moduli_of.c) / c;
                const extended off =
                    (spt_mobius_point(map, p, image), extended_distance(place_of(image).at, to.at));
                if (16 * unit * moduli_of.c / c > 1e-3L) continue;
                CHECK_SAY(chain_close(&one.steps, off, error), "off by %Lg, %Lg units", off,
                          off / unit / error);
            }
        }
    }
}

/* The center of an inversion, exactly. */
static void M4_at_the_pole(void) {
    const double center[3] = {1, -2, 0.5}, vector[3] = {0, 1, 0};
    double image[3] = {0, 0, 0};
    spt_mobius map = spt_mobius_identity();
    CHECK(spt_mobius_inversion(center, 2, &map) == SPT_OK);
    CHECK(spt_mobius_point(&map, center, image) == 0);
    CHECK(is_infinite(image));
    CHECK(spt_mobius_scale(&map, center) > DBL_MAX);
    spt_mobius_vector(&map, center, vector, image);
    for (int i = 0; i < 3; ++i) CHECK_SAY(!(fabs(image[i]) > 0), "%g", image[i]);
}

/* ---- Vectors --------------------------------------------------------------------------------- */

/* The turn is v g v^-1 with v = c p + d, unit for unit: what v is off by, twice. */
static void vectors(void) {
    chain_tally tally = {0, 0};
    for (int n = 0; n < 1500; ++n) {
        drawn_map one;
        draw(&one, n);
        for (int back = 0; back < 2; ++back) {
            const moduli moduli_of = chain_moduli(&one.steps, back);
            double p[3], given[3], image[3];
            extended turned[3], length, off, error;
            place from;
            draw_point(&one, back, n, p);
            from = place_of(p);
            error = chain_scale(&one.steps, back, from);
            if (!decided(&moduli_of, from, error)) continue;
            error = 2 * error_relative(&moduli_of, from, error);
            for (int i = 0; i < 3; ++i) given[i] = check_uniform(-2, 2);
            for (int i = 0; i < 3; ++i) turned[i] = (extended)given[i];
            length = extended_length(turned);
            chain_vector(&one.steps, back, from, turned);
            spt_mobius_vector(back ? &one.inverse : &one.map, p, given, image);
            off = extended_distance(place_of(image).at, turned) / length;
            chain_count(&tally, off, error);
            CHECK_SAY(chain_close(&one.steps, off, error), "back %d: off by %Lg, %Lg units", back,
                      off, off / unit / error);
        }
    }
    CHECK_SAY(chain_sharp(&tally), "%d of %d beyond 16u", tally.beyond, tally.compared);
}

/* ---- Inverses and compositions --------------------------------------------------------------- */

static const spt_quaternion *entry(const spt_mobius *map, int i) {
    return i == 0 ? &map->a : i == 1 ? &map->b : i == 2 ? &map->c : &map->d;
}

static extended entry_distance(const spt_mobius *one, const spt_mobius *other, int i,
                               extended sign) {
    const spt_quaternion *p = entry(one, i), *q = entry(other, i);
    const extended imaginary[3] = {(extended)p->x - sign * (extended)q->x,
                                   (extended)p->y - sign * (extended)q->y,
                                   (extended)p->z - sign * (extended)q->z};
    return hypotl((extended)p->real - sign * (extended)q->real, extended_length(imaginary));
}

/* A matrix and its negative are the same map. Both factors are off by e N. */
static void inverses(void) {
    const spt_mobius identity = spt_mobius_identity();
    for (int n = 0; n < 600; ++n) {
        drawn_map one;
        spt_mobius twice, nothing;
        moduli m;
        extended product[4];
        draw(&one, n);
        m = chain_moduli(&one.steps, 0);
        twice = spt_mobius_inverse(&one.inverse);
        for (int i = 0; i < 4; ++i) {
            CHECK(!(entry_distance(&twice, &one.map, i, 1) > 0) ||
                  !(entry_distance(&twice, &one.map, i, -1) > 0));
        }
        product[0] = product[3] = m.a * m.d + m.b * m.c;
        for (int order = 0; order < 2; ++order) {
            extended sign;
            CHECK(spt_mobius_compose(order ? &one.map : &one.inverse,
                                     order ? &one.inverse : &one.map, &nothing) == SPT_OK);
            CHECK(nothing.orientation == 1);
            sign = nothing.a.real < 0 ? -1 : 1;
            if (order) { /* [a b; c d] [d* b*; c* a*] */
                product[1] = 2 * m.a * m.b;
                product[2] = 2 * m.c * m.d;
            } else {
                product[1] = 2 * m.d * m.b;
                product[2] = 2 * m.a * m.c;
            }
            for (int i = 0; i < 4; ++i) {
                const extended off = entry_distance(&nothing, &identity, i, sign);
                CHECK_SAY(chain_close(&one.steps, off, 2 * product[i]),
                          "entry %d off by %Lg, %Lg units", i, off, off / unit / product[i]);
            }
        }
    }
}

/* outer(inner(p)), into either argument; orientations multiply. */
static void compositions(void) {
    for (int n = 0; n < 400; ++n) {
        const double center[3] = {0, 0, 0};
        chain both, part[2];
        spt_mobius map[2], result, into_outer, into_inner;
        moduli m;
        chain_draw(&both, 2 + n % 12, center, 1);
        part[0] = part[1] = both;
        part[0].count = 1 + n % (both.count - 1);
        part[1].count = both.count - part[0].count;
        for (int i = 0; i < part[1].count; ++i) part[1].steps[i] = both.steps[part[0].count + i];
        for (int i = 0; i < 2; ++i) map[i] = chain_build(&part[i]);
        into_inner = map[0];
        into_outer = map[1];
        CHECK(spt_mobius_compose(&map[1], &map[0], &result) == SPT_OK);
        CHECK(spt_mobius_compose(&into_outer, &map[0], &into_outer) == SPT_OK);
        CHECK(spt_mobius_compose(&map[1], &into_inner, &into_inner) == SPT_OK);
        CHECK(result.orientation == map[0].orientation * map[1].orientation);
        for (int i = 0; i < 4; ++i) {
            CHECK(!(entry_distance(&result, &into_outer, i, 1) > 0));
            CHECK(!(entry_distance(&result, &into_inner, i, 1) > 0));
        }
        m = chain_moduli(&both, 0);
        for (int i = 0; i < 4; ++i) {
            double p[3], image[3];
            place from, to;
            extended off, error;
            for (int k = 0; k < 3; ++k) p[k] = check_uniform(-1, 1);
            from = place_of(p);
            to = chain_image(&both, 0, from);
            error = error_of_point(&m, from, to, chain_scale(&both, 0, from));
            CHECK(spt_mobius_point(&result, p, image) == 1);
            off = extended_distance(place_of(image).at, to.at);
            CHECK_SAY(chain_close(&both, off, error), "off by %Lg, %Lg units", off,
                      off / unit / error);
        }
    }
}

/* ---- Known answers --------------------------------------------------------------------------- */

static void expect_image(const spt_mobius *map, double x, double y, double z, double tolerance) {
    const double p[3] = {1, 2, 3};
    double image[3] = {0, 0, 0};
    CHECK(spt_mobius_point(map, p, image) == 1);
    CHECK_SAY(fabs(image[0] - x) <= tolerance && fabs(image[1] - y) <= tolerance &&
                  fabs(image[2] - z) <= tolerance,
              "(%.17g, %.17g, %.17g)", image[0], image[1], image[2]);
}

/* Of (1, 2, 3); a few units of 14, the square of its length. */
static void known_images(void) {
    const double few = 14 * 16 * 0x1p-53;
    const double by[3] = {10, 20, 30}, x[3] = {5, 0, 0}, z[3] = {0, 0, 0.25}, none[3] = {0, 0, 0};
    const double quarter = 1.57079632679489661923;
    spt_mobius map = spt_mobius_identity();
    expect_image(&map, 1, 2, 3, 0);
    CHECK(spt_mobius_translation(by, &map) == SPT_OK);
    expect_image(&map, 11, 22, 33, 0);
    CHECK(spt_mobius_dilation(-2, &map) == SPT_OK);
    CHECK(map.orientation == -1);
    expect_image(&map, -2, -4, -6, few);
    CHECK(spt_mobius_rotation(z, quarter, &map) == SPT_OK); /* right-handed: x to y */
    expect_image(&map, -2, 1, 3, few);
    CHECK(spt_mobius_reflection(x, 20, &map) == SPT_OK); /* in x = 4 */
    CHECK(map.orientation == -1);
    expect_image(&map, 7, 2, 3, few);
    CHECK(spt_mobius_inversion(none, 2, &map) == SPT_OK);
    CHECK(map.orientation == -1);
    expect_image(&map, 4.0 / 14, 8.0 / 14, 12.0 / 14, few);
    CHECK(spt_mobius_inversion(by, 5, &map) == SPT_OK);
    expect_image(&map, 10 - 25 * 9.0 / 1134, 20 - 25 * 18.0 / 1134, 30 - 25 * 27.0 / 1134,
                 few * 100);
}

void suite_mobius_maps(void) {
    RUN(points);
    RUN(infinity_and_poles);
    RUN(M4_at_the_pole);
    RUN(vectors);
    RUN(inverses);
    RUN(compositions);
    RUN(known_images);
}
