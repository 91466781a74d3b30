/* SPDX-License-Identifier: MIT
 *
 * The chains of mobius_chain.h and the solids of mobius_region.h against one another and against
 * differences: nothing of the library takes part. */
#include "../check.h"
#include "mobius_region.h"

#include <math.h>

enum { chains = 300 };

static const double origin[3] = {0, 0, 0};

static place draw_near(const double center[3], double extent) {
    double p[3];
    for (int i = 0; i < 3; ++i) p[i] = center[i] + extent * check_uniform(-1, 1);
    return place_of(p);
}

static place moved(place from, const extended by[3], extended factor) {
    for (int i = 0; i < 3; ++i) from.at[i] += factor * by[i];
    return from;
}

/* There and back, within what rounding of each step does. */
static void chain_undone(void) {
    const extended unit = extended_unit();
    for (int n = 0; n < chains; ++n) {
        chain one;
        chain_draw(&one, 1 + n % chain_most, origin, 1);
        for (int i = 0; i < 4; ++i) {
            const place p = draw_near(origin, 1), y = chain_image(&one, 0, p);
            const place q = chain_image(&one, 1, y);
            const moduli forth = chain_moduli(&one, 0), back = chain_moduli(&one, 1);
            const extended scale = chain_scale(&one, 0, p), returning = chain_scale(&one, 1, y);
            extended error = returning * error_of_point(&forth, p, y, scale) +
                             error_of_point(&back, y, p, returning);
            const extended off = extended_distance(p.at, q.at);
            CHECK_SAY(off <= 16 * one.count * unit * error, "off by %Lg of %Lg", off, unit * error);
            error = 2 * (error_relative(&forth, p, scale) + error_relative(&back, y, returning));
            CHECK_SAY(fabsl(scale * returning - 1) <= 16 * one.count * unit * error, "scales %Lg",
                      scale * returning);
        }
    }
}

/* The middle of differences over steps of h and h / 2 of the way to the pole, h = 2^-9: what is
 * left of the fourth order is below h^4. */
static void chain_turns_vectors(void) {
    for (int n = 0; n < chains; ++n) {
        chain one;
        const place p = draw_near(origin, 1);
        extended v[3], turned[3], difference[2][3], dot, h = 0x1p-9L;
        place pole;
        chain_draw(&one, 1 + n % 6, origin, 1);
        pole = chain_image(&one, 1, place_infinite());
        if (!pole.infinite) h *= fminl(1, extended_distance(pole.at, p.at));
        for (int i = 0; i < 3; ++i) turned[i] = v[i] = (extended)check_uniform(-1, 1);
        chain_vector(&one, 0, p, turned);
        for (int half = 0; half < 2; ++half) {
            const extended step = half ? h / 2 : h;
            const place ahead = chain_image(&one, 0, moved(p, v, step));
            const place behind = chain_image(&one, 0, moved(p, v, -step));
            for (int i = 0; i < 3; ++i)
                difference[half][i] = (ahead.at[i] - behind.at[i]) / (2 * step);
        }
        for (int i = 0; i < 3; ++i)
            difference[1][i] = (4 * difference[1][i] - difference[0][i]) / 3;
        dot = extended_length(difference[1]) / extended_length(v);
        CHECK_SAY(fabsl(dot / chain_scale(&one, 0, p) - 1) < 1e-8L, "scale %Lg", dot);
        for (int i = 0; i < 3; ++i) difference[1][i] /= dot;
        dot = extended_distance(difference[1], turned) / extended_length(v);
        CHECK_SAY(dot < 1e-8L, "off by %Lg", dot);
    }
}

static void chain_keeps_apart(void) {
    for (int n = 0; n < chains; ++n) {
        chain one;
        const place p = draw_near(origin, 1), q = draw_near(origin, 1);
        place y, z;
        extended apart, seen;
        chain_draw(&one, 1 + n % 6, origin, 1);
        y = chain_image(&one, 0, p);
        z = chain_image(&one, 0, q);
        apart = chain_apart(&one, 0, p, q, extended_distance(p.at, q.at));
        seen = extended_distance(y.at, z.at);
        CHECK_SAY(fabsl(apart - seen) <=
                      1e-12L * (extended_length(y.at) + extended_length(z.at) + seen),
                  "%Lg for %Lg", apart, seen);
    }
}

/* Points on the boundary go to points on the boundary, points inside to points inside; the mirror
 * image of the pole to the center. */
static void chain_maps_solids(void) {
    for (int n = 0; n < chains; ++n) {
        chain one;
        const spt_region region = region_draw(origin, 1);
        const solid from = solid_of(&region);
        solid to;
        chain_draw(&one, 1 + n % 8, origin, 1);
        to = chain_solid(&one, 0, from);
        for (int i = 0; i < 8; ++i) {
            place p = draw_near(origin, 3);
            const extended before = solid_distance(&from, p.at);
            const place y = chain_image(&one, 0, p);
            const extended after = solid_distance(&to, y.at);
            const extended rounding =
                1e-12L * (extended_length(y.at) + extended_length(to.center) + fabsl(to.radius));
            CHECK_SAY((before < 0) == (after < 0) || fabsl(after) < rounding ||
                          fabsl(before) < 1e-12L,
                      "%Lg before, %Lg after", before, after);
            if (from.kind == SPT_REGION_HALF_SPACE) {
                p = moved(p, from.center, -before);
            } else {
                const extended length = extended_distance(p.at, from.center);
                for (int k = 0; k < 3; ++k)
                    p.at[k] = from.center[k] + (p.at[k] - from.center[k]) * (from.radius / length);
            }
            p = chain_image(&one, 0, p);
            CHECK_SAY(fabsl(solid_distance(&to, p.at)) <=
                          1e-12L * (extended_length(p.at) + extended_length(to.center) +
                                    fabsl(to.radius)),
                      "%Lg from the boundary", solid_distance(&to, p.at));
        }
    }
}

void suite_mobius_oracle(void) {
    RUN(chain_undone);
    RUN(chain_turns_vectors);
    RUN(chain_keeps_apart);
    RUN(chain_maps_solids);
}
