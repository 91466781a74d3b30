/* SPDX-License-Identifier: MIT
 *
 * Coefficients of regions and their pull-backs (Appendix A) against solids carried step by step,
 * and against the form's values at points. Tolerances are of the error scale of mobius_chain.h. */
#include "../check.h"
#include "mobius_region.h"

#include <math.h>

static const extended unit = 0x1p-53L;
static const double origin[3] = {0, 0, 0};

/* ---- Coefficients ---------------------------------------------------------------------------- */

static extended form(const spt_sphere_coefficients *s, const extended p[3]) {
    const place beta = place_of(s->beta);
    return (extended)s->alpha * extended_dot(p, p) - 2 * extended_dot(beta.at, p) +
           (extended)s->gamma;
}

static void to_array(const spt_sphere_coefficients *s, extended c[5]) {
    c[0] = (extended)s->alpha;
    for (int i = 0; i < 3; ++i) c[1 + i] = (extended)s->beta[i];
    c[4] = (extended)s->gamma;
}

/* Up to a positive factor: 8u of each, of gamma 8u of |k|^2 + rho^2, and as much of all where gamma
 * is the largest, which is brought to 1. */
static void coefficients_of_regions(void) {
    for (int n = 0; n < 500; ++n) {
        const double extent = pow(10, check_uniform(-7, 7));
        const spt_region region = region_draw(origin, extent);
        const spt_sphere_coefficients s = spt_region_coefficients(&region);
        const solid one = solid_of(&region);
        extended truth[5], seen[5], largest = 0, lost;
        solid_coefficients(&one, truth);
        to_array(&s, seen);
        lost = fabsl(truth[0]) * (extended_dot(one.center, one.center) + one.radius * one.radius);
        for (int i = 0; i < 5; ++i) largest = fmaxl(largest, fabsl(seen[i]));
        CHECK((s.alpha > 0) == (region.kind == SPT_REGION_BALL));
        CHECK((s.alpha < 0) == (region.kind == SPT_REGION_OUTSIDE));
        for (int i = 0; i < 5; ++i) {
            const extended off = fabsl(seen[i] / largest - truth[i]);
            CHECK_SAY(off <= 8 * unit * (fabsl(truth[i]) + lost * (i == 4 ? 1 : fabsl(truth[i]))),
                      "kind %u, coefficient %d: %Lg for %Lg", region.kind, i, seen[i] / largest,
                      truth[i]);
        }
    }
}

/* What an error of one unit of the moduli does to the pulled-back coefficients of
 *     alpha |a|^2 + 2 Re c* beta a + gamma |c|^2  and so on (Appendix A),
 * which are quadratic in the entries: twice the sums of the moduli. */
static void pull_back_error(const moduli *n, const spt_sphere_coefficients *s, extended e[3]) {
    const extended alpha = fabsl((extended)s->alpha), gamma = fabsl((extended)s->gamma);
    const extended beta = extended_length(place_of(s->beta).at);
    e[0] = 2 * (alpha * n->a * n->a + 2 * beta * n->a * n->c + gamma * n->c * n->c);
    e[1] = 2 * (alpha * n->a * n->b + beta * (n->a * n->d + n->b * n->c) + gamma * n->c * n->d);
    e[2] = 2 * (alpha * n->b * n->b + 2 * beta * n->b * n->d + gamma * n->d * n->d);
}

/* A chain with its map, and a region near where it takes the unit ball around the origin. */
static void draw_seen(chain *steps, int count, spt_mobius *map, spt_region *region) {
    place middle = place_of(origin);
    double there[3];
    chain_draw(steps, count, origin, 1);
    *map = chain_build(steps);
    middle = chain_image(steps, 0, middle);
    for (int k = 0; k < 3; ++k) there[k] = (double)middle.at[k];
    *region = region_draw(there, (double)chain_scale(steps, 0, place_of(origin)));
}

/* The s in form'(p) = s form(L(p)) |c p + d|^2, from where the right side is far from zero; off
 * receives what an error of one unit does to it. */
static extended factor_of(const chain *steps, const spt_sphere_coefficients *image,
                          const spt_sphere_coefficients *pulled, const extended e[3],
                          extended *off) {
    extended best = 0, factor = 0;
    for (int i = 0; i < 8; ++i) {
        double p[3];
        place from;
        extended value, length;
        for (int k = 0; k < 3; ++k) p[k] = check_uniform(-1, 1);
        from = place_of(p);
        length = extended_length(from.at);
        value = form(image, chain_image(steps, 0, from).at) / chain_scale(steps, 0, from);
        if (fabsl(value) <= best) continue;
        best = fabsl(value);
        factor = form(pulled, from.at) / value;
        *off = factor * (e[0] * length * length + 2 * e[1] * length + e[2]) / best;
    }
    return factor;
}

/* Against the preimage by steps; and at points, with one s for all and s^2 in the discriminant
 * |beta|^2 - alpha gamma. Coefficients are at most 1; to bring them there rounds by a unit. */
static void pull_backs(void) {
    for (int n = 0; n < 600; ++n) {
        chain steps;
        spt_region region;
        spt_sphere_coefficients s, t;
        solid preimage;
        extended e[3], seen[5], truth[5], largest = 0, factor, off, before, after;
        moduli m;
        spt_mobius map;
        draw_seen(&steps, 1 + n % 10, &map, &region);
        s = spt_region_coefficients(&region);
        t = spt_mobius_pull_back(&map, &s);
        preimage = chain_solid(&steps, 1, solid_of(&region));
        m = chain_moduli(&steps, 0);
        pull_back_error(&m, &s, e);
        check_context("chain %d, kind %u", n, region.kind);
        to_array(&t, seen);
        solid_coefficients(&preimage, truth);
        for (int i = 0; i < 5; ++i) largest = fmaxl(largest, fabsl(seen[i]));
        CHECK(fabsl(largest - 1) <= 4 * unit);
        factor = factor_of(&steps, &s, &t, e, &off);
        CHECK_SAY(factor > 0, "sign lost: %Lg", factor);
        for (int i = 0; i < 5; ++i) {
            const extended own = e[i == 0 ? 0 : i == 4 ? 2 : 1];
            const extended error = fabsl(seen[i] - truth[i]);
            const extended scale =
                factor * (own + fabsl(truth[i]) * fmaxl(e[0], fmaxl(e[1], e[2]))) + 1;
            CHECK_SAY(chain_close(&steps, error, scale), "coefficient %d off by %Lg, %Lg units", i,
                      error, error / unit / scale);
        }
        before = extended_dot(place_of(s.beta).at, place_of(s.beta).at) -
                 (extended)s.alpha * (extended)s.gamma;
        after = extended_dot(place_of(t.beta).at, place_of(t.beta).at) -
                (extended)t.alpha * (extended)t.gamma;
        off = 2 * factor * off * before + factor * (2 * e[1] + e[0] + e[2]) + 1;
        CHECK_SAY(chain_close(&steps, fabsl(after - factor * factor * before), off),
                  "discriminant %Lg for %Lg", after, factor * factor * before);
    }
}

/* By both maps at once or one after the other. */
static void pull_back_of_compositions(void) {
    for (int n = 0; n < 400; ++n) {
        chain both, part[2];
        spt_mobius map[2], result;
        spt_region region;
        spt_sphere_coefficients s, at_once, in_turn;
        extended one[5], other[5], e[3], worst, off;
        moduli m;
        draw_seen(&both, 2 + n % 6, &result, &region);
        part[0] = part[1] = both;
        part[0].count = 1 + n % (both.count - 1);
        part[1].count = both.count - part[0].count;
        for (int i = 0; i < part[1].count; ++i) part[1].steps[i] = both.steps[part[0].count + i];
        for (int i = 0; i < 2; ++i) map[i] = chain_build(&part[i]);
        CHECK(spt_mobius_compose(&map[1], &map[0], &result) == SPT_OK);
        s = spt_region_coefficients(&region);
        at_once = spt_mobius_pull_back(&result, &s);
        in_turn = spt_mobius_pull_back(&map[1], &s);
        in_turn = spt_mobius_pull_back(&map[0], &in_turn);
        to_array(&at_once, one);
        to_array(&in_turn, other);
        m = chain_moduli(&both, 0);
        pull_back_error(&m, &s, e);
        /* Each is off by its own, and by what the largest is. */
        worst = 4 * factor_of(&both, &s, &at_once, e, &off) * fmaxl(e[0], fmaxl(e[1], e[2])) + 1;
        for (int i = 0; i < 5; ++i) {
            off = fabsl(one[i] - other[i]);
            CHECK_SAY(chain_close(&both, off, worst), "coefficient %d off by %Lg, %Lg units", i,
                      off, off / unit / worst);
        }
    }
}

void suite_mobius_coefficients(void) {
    RUN(coefficients_of_regions);
    RUN(pull_backs);
    RUN(pull_back_of_compositions);
}
