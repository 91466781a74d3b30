/* SPDX-License-Identifier: MIT
 *
 * Images of balls, outsides and half spaces against solids carried step by step (mobius_region.h)
 * and against points of them; rows M1 and M2. Tolerances are of the error scales of those headers.
 * Coefficients are in test_mobius_coefficients.c. */
#include "../check.h"
#include "mobius_region.h"

#include <math.h>
#include <string.h>

static const extended unit = 0x1p-53L;
static const double origin[3] = {0, 0, 0};

static extended relative(extended value, extended truth) {
    return fabsl(value / truth - 1);
}

static spt_region inverted(const spt_mobius *map, const spt_region *region) {
    spt_region image = {0, {0, 0, 0}, 0};
    CHECK(spt_mobius_region(map, region, &image) == SPT_OK);
    return image;
}

/* ---- Regions --------------------------------------------------------------------------------- */

/* The boundary's image is a plane within 2^-40 of the pole's distance: there both are right as far
 * as points tell, which M1 asks. Where an error moves it by a thousandth of what is left, first
 * order says nothing. */
static int decided(const solid_error *error) {
    return error->nearness > 4 * 0x1p-40L && 16 * (chain_most + 1) * unit * error->radius < 1e-3L;
}

static int compare_region(const chain *steps, int back, const spt_mobius *map,
                          const spt_region *region, chain_tally *tally) {
    const solid from = solid_of(region), to = chain_solid(steps, back, from);
    const solid_error error = chain_solid_error(steps, back, &from);
    spt_region image = *region;
    extended off;
    if (!decided(&error)) return 0;
    CHECK(spt_mobius_region(map, region, &image) == SPT_OK);
    CHECK_SAY(image.kind == to.kind, "kind %u, not %d", image.kind, (int)to.kind);
    off = extended_distance(place_of(image.center).at, to.center);
    if (to.kind == SPT_REGION_HALF_SPACE) {
        /* Only half spaces under similar maps come here: the normal turns as a vector does, and the
         * plane moves with any point of it. */
        const place foot = {
            {to.center[0] * to.radius, to.center[1] * to.radius, to.center[2] * to.radius}, 0};
        const place before = chain_image(steps, !back, foot);
        const moduli n = chain_moduli(steps, back);
        const extended scale = chain_scale(steps, back, before);
        const extended moved = error_of_point(&n, before, foot, scale);
        CHECK_SAY(chain_close(steps, off, error.radius + 1), "normal off by %Lg", off / unit);
        off = fabsl((extended)image.radius - to.radius);
        CHECK_SAY(chain_close(steps, off,
                              moved + fabsl(to.radius) * error.radius + scale * fabsl(from.radius)),
                  "offset off by %Lg, %Lg units", off, off / unit / moved);
        return 1;
    }
    chain_count(tally, off, error.center);
    CHECK_SAY(chain_close(steps, off, error.center), "center off by %Lg, %Lg units", off,
              off / unit / error.center);
    off = relative((extended)image.radius, to.radius);
    chain_count(tally, off, error.radius);
    CHECK_SAY(chain_close(steps, off, error.radius), "radius off by %Lg, %Lg units", off,
              off / unit / error.radius);
    return 1;
}

static void regions(void) {
    int compared = 0;
    chain_tally tally = {0, 0};
    for (int n = 0; n < 1500; ++n) {
        const double extent = pow(10, check_uniform(-7, 7));
        double center[3];
        chain steps;
        spt_mobius map, inverse;
        for (int i = 0; i < 3; ++i) center[i] = extent * check_uniform(-1, 1);
        if (n % 4 == 0) {
            chain_draw_wild(&steps, 1 + n % 3);
        } else {
            chain_draw(&steps, 1 + n % chain_most, center, extent);
        }
        map = chain_build(&steps);
        inverse = spt_mobius_inverse(&map);
        check_context("chain %d of %d steps", n, steps.count);
        for (int i = 0; i < 4; ++i) {
            spt_region region = region_draw(center, extent);
            double there[3];
            place middle = place_of(center);
            const double scale = (double)chain_scale(&steps, 0, middle);
            compared += compare_region(&steps, 0, &map, &region, &tally);
            middle = chain_image(&steps, 0, middle);
            for (int k = 0; k < 3; ++k) there[k] = (double)middle.at[k];
            region = region_draw(there, extent * scale);
            compared += compare_region(&steps, 1, &inverse, &region, &tally);
        }
    }
    CHECK_SAY(chain_sharp(&tally), "%d of %d beyond 16u", tally.beyond, tally.compared);
    CHECK_SAY(compared > 10000, "%d of 12000 compared", compared);
}

/* Boundaries past the pole by 1e-1 to 1e-11 of its distance, on either side. */
static void regions_past_the_pole(void) {
    int compared = 0;
    chain_tally tally = {0, 0};
    for (int n = 0; n < 1500; ++n) {
        const double past = pow(10, check_uniform(-11, -1)) * (n % 2 == 0 ? 1 : -1);
        chain steps;
        spt_mobius map;
        spt_region region = region_draw(origin, 1);
        place pole;
        chain_draw(&steps, 1 + n % 8, origin, 1);
        map = chain_build(&steps);
        pole = chain_image(&steps, 1, place_infinite());
        if (pole.infinite) continue;
        if (region.kind == SPT_REGION_HALF_SPACE) {
            region.radius = (double)extended_dot(place_of(region.center).at, pole.at);
            region.radius += past * (1 + fabs(region.radius));
        } else {
            const place center = place_of(region.center);
            region.radius = (double)extended_distance(center.at, pole.at) * (1 + past);
        }
        check_context("chain %d, kind %u, past by %g", n, region.kind, past);
        compared += compare_region(&steps, 0, &map, &region, &tally);
    }
    CHECK_SAY(chain_sharp(&tally), "%d of %d beyond 16u", tally.beyond, tally.compared);
    CHECK_SAY(compared > 500, "%d compared", compared);
}

static void region_in_place(void) {
    for (int n = 0; n < 100; ++n) {
        chain steps;
        spt_mobius map;
        spt_region region = region_draw(origin, 1), image;
        chain_draw(&steps, 1 + n % 5, origin, 1);
        map = chain_build(&steps);
        image = inverted(&map, &region);
        CHECK(spt_mobius_region(&map, &region, &region) == SPT_OK);
        CHECK(region.kind == image.kind);
        CHECK(memcmp(region.center, image.center, sizeof image.center) == 0);
        CHECK(memcmp(&region.radius, &image.radius, sizeof image.radius) == 0);
    }
}

/* ---- M1: spheres through the pole ------------------------------------------------------------ */

/* Points at x = 2^-8 .. 2^8 on rays from the pole are in the image if and only if their inverses
 * are in the region, as far as these are from its boundary by more than rounding: 2^-40 of the
 * distance from the pole is what may pass for a plane. */
static void judge(const spt_region *region, const spt_region *image) {
    const chain steps = {1, {{CHAIN_INVERSION, {0, 0, 0}, 1}}};
    const solid before = solid_of(region), after = solid_of(image);
    for (int n = 0; n < 200; ++n) {
        const double reach = pow(2, check_uniform(-8, 8));
        double p[3];
        place y;
        extended inside;
        for (int i = 0; i < 3; ++i) p[i] = reach * check_uniform(-1, 1);
        y = chain_image(&steps, 0, place_of(p));
        inside = solid_distance(&before, y.at);
        if (fabsl(inside) < 4 * 0x1p-40L * (1 + extended_length(y.at))) continue;
        CHECK_SAY((inside < 0) == (solid_distance(&after, place_of(p).at) < 0), "%Lg: at %Lg",
                  inside, solid_distance(&after, place_of(p).at));
    }
}

static void M1_through_the_pole(void) {
    spt_mobius map = spt_mobius_identity();
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    for (int power = 1; power <= 15; ++power) {
        for (int way = -1; way <= 1; ++way) {
            const double e = way * pow(10, -power);
            spt_region ball = {SPT_REGION_BALL, {1 + e, 0, 0}, 1}, image, back;
            const double seen = ball.center[0] - 1; /* e as it is */
            for (int outside = 0; outside < 2; ++outside) {
                if (outside) ball.kind = SPT_REGION_OUTSIDE;
                image = inverted(&map, &ball);
                back = inverted(&map, &image);
                check_context("e = %g, outside %d", e, outside);
                judge(&ball, &image);
                judge(&back, &image);
                CHECK(image.radius - image.radius < 1 && image.center[0] - image.center[0] < 1);
                if (fabs(seen) < 0x1p-41) {
                    /* x >= 1 / 2 or, of the outside, x <= 1 / 2 */
                    CHECK(image.kind == SPT_REGION_HALF_SPACE);
                    CHECK(fabs(image.center[0] - (outside ? 1 : -1)) <= 0x1p-40);
                    CHECK(fabs(image.radius - (outside ? 0.5 : -0.5)) <= 0x1p-40);
                } else if (fabs(seen) > 0x1p-37) {
                    /* From 1 / (2 + e) to 1 / e: radius 1 / |e (2 + e)|. */
                    const int inside_out = (seen < 0) != (outside != 0);
                    CHECK(image.kind == (inside_out ? SPT_REGION_OUTSIDE : SPT_REGION_BALL));
                    CHECK_SAY(fabs(image.radius * fabs(seen) * (2 + seen) - 1) <=
                                  16 * 0x1p-53 * (1 + 4 / fabs(seen)),
                              "radius %.17g", image.radius);
                }
            }
        }
    }
}

/* Whole numbers: exactly a half space, and exactly back. */
static void M1_half_space_exactly(void) {
    const spt_region half = {SPT_REGION_HALF_SPACE, {0, 1, 0}, -0.5};
    const spt_region ball = {SPT_REGION_BALL, {0, -1, 0}, 1};
    const spt_region through = {SPT_REGION_HALF_SPACE, {0, 1, 0}, 0};
    spt_mobius map = spt_mobius_identity();
    spt_region image;
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    image = inverted(&map, &ball);
    CHECK(image.kind == SPT_REGION_HALF_SPACE);
    CHECK_SAY(!(fabs(image.radius + 0.5) > 0x1p-50), "offset %.17g", image.radius);
    for (int i = 0; i < 3; ++i) CHECK(fabs(image.center[i] - half.center[i]) <= 0x1p-50);
    image = inverted(&map, &half);
    CHECK(image.kind == SPT_REGION_BALL);
    CHECK_SAY(!(fabs(image.radius - 1) > 0x1p-50), "radius %.17g", image.radius);
    for (int i = 0; i < 3; ++i) CHECK(fabs(image.center[i] - ball.center[i]) <= 0x1p-50);
    image = inverted(&map, &through);
    CHECK(image.kind == SPT_REGION_HALF_SPACE);
    CHECK(fabs(image.radius) <= 0x1p-50);
    for (int i = 0; i < 3; ++i) CHECK(fabs(image.center[i] - through.center[i]) <= 0x1p-50);
}

/* ---- M2: two inversions hide what the first did ---------------------------------------------- */

static void M2_inside_out_at_the_first_level(void) {
    static const spt_region probes[] = {{SPT_REGION_BALL, {0.5, 0, 0}, 1},
                                        {SPT_REGION_BALL, {0.4, 0.1, 0}, 0.6}};
    const double second[3] = {-0.5, 0.5, 0};
    const chain steps = {2,
                         {{CHAIN_INVERSION, {0, 0, 0}, 1}, {CHAIN_INVERSION, {-0.5, 0.5, 0}, 1}}};
    chain_tally tally = {0, 0};
    spt_mobius map = spt_mobius_identity(), other = spt_mobius_identity(), both;
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    CHECK(spt_mobius_inversion(second, 1, &other) == SPT_OK);
    CHECK(spt_mobius_compose(&other, &map, &both) == SPT_OK);
    for (int i = 0; i < 2; ++i) {
        const spt_region first = inverted(&map, &probes[i]), last = inverted(&other, &first);
        const spt_sphere_coefficients sphere = spt_region_coefficients(&probes[i]);
        const spt_sphere_coefficients once = spt_mobius_pull_back(&map, &sphere);
        const spt_sphere_coefficients twice = spt_mobius_pull_back(&other, &once);
        check_context("probe %d", i);
        CHECK(first.kind == SPT_REGION_OUTSIDE);
        /* Printed: only the last alpha is tested, and is positive again. In between beta's x has
         * the sign that the center's has not. */
        CHECK(sphere.alpha > 0 && once.alpha < 0 && twice.alpha > 0);
        CHECK(once.beta[0] * first.center[0] < 0);
        CHECK(last.kind == SPT_REGION_BALL);
        compare_region(&steps, 0, &both, &probes[i], &tally);
    }
}

void suite_mobius_regions(void) {
    RUN(regions);
    RUN(regions_past_the_pole);
    RUN(region_in_place);
    RUN(M1_through_the_pole);
    RUN(M1_half_space_exactly);
    RUN(M2_inside_out_at_the_first_level);
}
