/* SPDX-License-Identifier: MIT
 *
 * spt_mobius_exit() and spt_sphere_meets_line(). A way is in the unbounding ball as long as the
 * preimages of its points are within rho of that of its start, which chains of elementary maps tell
 * (chain_apart): ratio(t) = that distance / rho. Nothing here forms the ball. */
#include "../check.h"
#include "mobius_region.h"

#include <float.h>
#include <math.h>

static const extended unit = 0x1p-53L;
static const double origin[3] = {0, 0, 0};

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void draw_direction(double w[3]) {
    double length;
    for (int i = 0; i < 3; ++i) w[i] = check_uniform(-1, 1);
    length = length_of(w);
    for (int i = 0; i < 3; ++i) w[i] /= length;
}

/* ---- Exits ----------------------------------------------------------------------------------- */

typedef struct way {
    chain steps;
    spt_mobius map;
    double from[3], direction[3], rho;
    place pole;     /* L(infinity) */
    extended slack; /* what the ratio may be off by where it is 1 */
    extended k;
} way;

static extended ratio_at(const way *one, extended t) {
    const place from = place_of(one->from);
    place to = from;
    for (int i = 0; i < 3; ++i) to.at[i] += t * (extended)one->direction[i];
    return chain_apart(&one->steps, 1, from, to, t * extended_length(place_of(one->direction).at)) /
           (extended)one->rho;
}

/* With d = |x - P|, g the cosine of the way with x - P, and k = rho |c|^2 d the ratio is
 *     t / (k |x + t w - P|),
 * and 1 where F(t) = (1 - k^2) t^2 - 2 k^2 d g t - k^2 d^2 = 0. Let k and d be off by a relative
 * error r and g by r: then F is off by at most 4 r k^2 (t + d)^2, and the ratio's square by that
 * over k^2 |x + t w - P|^2. There |x + t w - P| = t / k, and d <= t + t / k; so the ratio is off by
 * at most 2 r (1 + 2 k)^2. (What rounding does to 1 - k^2 (1 - g^2) before its root is taken moves
 * the ratio by half of itself, below (1 + k^2) units.)
 * k = rho |c| |u|, u = a - x c; g is off as the direction of u is, and as P is, over d. */
static void way_slack(way *one) {
    const moduli n = chain_moduli(&one->steps, 1);
    const place from = place_of(one->from);
    const extended scale = chain_scale(&one->steps, 1, from);
    extended r = 2 * error_relative(&n, from, scale);
    one->k = 0;
    if (!one->pole.infinite) {
        const extended c = chain_lower(&one->steps, 1, one->pole);
        const extended d = extended_distance(from.at, one->pole.at);
        one->k = (extended)one->rho * c * c * d;
        r += 2 * n.c / c + error_of_pole(&n, one->pole, c) / d;
    }
    one->slack = 16 * (one->steps.count + 1) * (unit + extended_unit()) *
                 (2 * r * (1 + 2 * one->k) * (1 + 2 * one->k) + 1);
}

/* Some ways lead through the pole or away from it. */
static void draw_way(way *one, int n) {
    const double extent = pow(10, check_uniform(-7, 7));
    double center[3], q[3];
    place from;
    for (int i = 0; i < 3; ++i) center[i] = extent * check_uniform(-1, 1);
    if (n % 5 == 0) {
        chain_draw_wild(&one->steps, 1 + n % 3);
    } else {
        chain_draw(&one->steps, 1 + n % chain_most, center, extent);
    }
    one->map = chain_build(&one->steps);
    for (int i = 0; i < 3; ++i) q[i] = center[i] + extent * check_uniform(-1, 1);
    from = chain_image(&one->steps, 0, place_of(q));
    for (int i = 0; i < 3; ++i) one->from[i] = (double)from.at[i];
    one->rho = extent * pow(10, check_uniform(n % 2 ? -7 : -1, 1.5));
    one->pole = chain_image(&one->steps, 0, place_infinite());
    draw_direction(one->direction);
    if (n % 7 < 2 && !one->pole.infinite) {
        double length;
        for (int i = 0; i < 3; ++i)
            one->direction[i] = (n % 7 == 0 ? 1 : -1) * ((double)one->pole.at[i] - one->from[i]);
        length = length_of(one->direction);
        for (int i = 0; i < 3; ++i) one->direction[i] /= length;
    }
    way_slack(one);
    if (n % 6 == 5 && one->k > 0) {
        /* The ball is a half space, or all but one: k = 1 + 1e-1 .. 1e-15. */
        const double e = pow(10, check_uniform(-15, -1)) * (check_random() % 2 == 0 ? 1 : -1);
        one->rho = (double)((extended)one->rho / one->k) * (1 + e);
        way_slack(one);
    }
    check_context("way %d, %d steps, k %Lg", n, one->steps.count, one->k);
}

static void exits(void) {
    int finite = 0, clear = 0, infinite = 0, far_out = 0;
    for (int n = 0; n < 2400; ++n) {
        way one;
        double t;
        extended ratio;
        draw_way(&one, n);
        if (!(one.slack < 1e-4L)) continue;
        t = spt_mobius_exit(&one.map, one.from, one.direction, one.rho);
        CHECK_SAY(t > 0, "exit %g", t);
        if (t <= DBL_MAX) {
            ++finite;
            ratio = ratio_at(&one, (extended)t);
            CHECK_SAY(fabsl(ratio - 1) <= one.slack, "off by %Lg, slack %Lg", ratio - 1, one.slack);
            for (int i = 0; i < 16; ++i) {
                ratio = ratio_at(&one, (extended)t * (extended)check_uniform(0, 1));
                CHECK_SAY(ratio <= 1 + one.slack, "%Lg on the way", ratio - 1);
            }
            ratio = ratio_at(&one, (extended)t * 1.0009765625L);
            CHECK_SAY(ratio > 1 - one.slack, "%Lg beyond", ratio - 1);
            clear += ratio > 1 + one.slack;
        } else {
            const extended d = extended_distance(place_of(one.from).at, one.pole.at);
            ++infinite;
            /* Beyond any distance the ratio comes to 1 / k. */
            CHECK_SAY(one.k > 1 - one.slack, "infinite with k %Lg", one.k);
            for (int i = 0; i < 40; ++i, ++far_out) {
                const double power = check_uniform(-3, 12);
                ratio = ratio_at(&one, d * (extended)pow(10, power));
                CHECK_SAY(ratio <= 1 + one.slack, "%Lg at 10^%g d", ratio - 1, power);
            }
        }
    }
    CHECK_SAY(finite > 1500 && clear >= finite * 95 / 100, "%d of %d finite ones end there", clear,
              finite);
    CHECK_SAY(far_out > 10000, "%d samples on %d ways without end", far_out, infinite);
}

/* Of an inversion the image of the ball around q is known. Half space: |q| = rho exactly. */
static void S14_exits_without_end(void) {
    static const struct {
        double rho, forth, back, across;
    } cases[] = {
        /* From (2, 0, 0), q = (1/2, 0, 0). Ball from 4/3 to 4: */
        {0.25, 2, 2.0 / 3, 0},
        /* half space x > 1: */
        {0.5, HUGE_VAL, 1, HUGE_VAL},
        /* outside of the sphere from -2 to 2/3: */
        {1, HUGE_VAL, 4.0 / 3, HUGE_VAL},
    };
    const double from[3] = {2, 0, 0}, forth[3] = {1, 0, 0}, back[3] = {-1, 0, 0},
                 across[3] = {0, 1, 0};
    spt_mobius map = spt_mobius_identity();
    CHECK(spt_mobius_inversion(origin, 1, &map) == SPT_OK);
    for (int i = 0; i < 3; ++i) {
        const double ahead = spt_mobius_exit(&map, from, forth, cases[i].rho);
        const double behind = spt_mobius_exit(&map, from, back, cases[i].rho);
        const double aside = spt_mobius_exit(&map, from, across, cases[i].rho);
        check_context("rho %g", cases[i].rho);
        if (i == 0) {
            /* Center 8/3, radius 4/3: across, (2/3)^2 + t^2 = (4/3)^2. */
            CHECK(fabs(ahead - cases[i].forth) <= 0x1p-49);
            CHECK(fabs(aside - sqrt(12.0) / 3) <= 0x1p-49);
        } else {
            CHECK(ahead > DBL_MAX && aside > DBL_MAX);
        }
        CHECK_SAY(fabs(behind - cases[i].back) <= 0x1p-49, "%.17g", behind);
    }
    CHECK(!(spt_mobius_exit(&map, from, forth, 0) > 0));
    CHECK(!(spt_mobius_exit(&map, from, forth, 0) < 0));
}

/* On the pole the ball around infinity is asked for; any number will do, but NaN. */
static void M4_exit_at_the_pole(void) {
    const double w[3] = {0, 0, 1};
    spt_mobius map = spt_mobius_identity();
    double t;
    CHECK(spt_mobius_inversion(origin, 2, &map) == SPT_OK);
    t = spt_mobius_exit(&map, origin, w, 1);
    CHECK_SAY(t >= 0, "%g", t);
    t = spt_mobius_exit(&map, origin, w, 0);
    CHECK_SAY(t >= 0, "%g", t);
}

/* ---- Lines ----------------------------------------------------------------------------------- */

/* a t^2 + 2 b t + c with what each is made of, for its rounding. */
typedef struct quadratic {
    extended a, b, c, size;
} quadratic;

static quadratic quadratic_of(const spt_sphere_coefficients *s, const double from[3],
                              const double direction[3], extended t) {
    const place o = place_of(from), w = place_of(direction), beta = place_of(s->beta);
    const extended reach = extended_length(o.at) + fabsl(t) * extended_length(w.at);
    const extended alpha = (extended)s->alpha, gamma = (extended)s->gamma;
    quadratic q;
    q.a = alpha * extended_dot(w.at, w.at);
    q.b = alpha * extended_dot(o.at, w.at) - extended_dot(beta.at, w.at);
    q.c = alpha * extended_dot(o.at, o.at) - 2 * extended_dot(beta.at, o.at) + gamma;
    q.size = fabsl(alpha) * reach * reach + 2 * extended_length(beta.at) * reach + fabsl(gamma);
    return q;
}

/* Roots by the stable form, as many as there are. */
static int own_roots(const quadratic *q, extended t[2]) {
    const extended discriminant = q->b * q->b - q->a * q->c;
    extended sum, swap;
    if (!(fabsl(q->a) > 0)) {
        t[0] = -q->c / (2 * q->b);
        return fabsl(q->b) > 0;
    }
    if (discriminant < 0) return 0;
    sum = -(q->b + (q->b < 0 ? -1 : 1) * sqrtl(discriminant));
    t[0] = sum / q->a;
    t[1] = fabsl(sum) > 0 ? q->c / sum : t[0];
    if (t[1] < t[0]) {
        swap = t[0];
        t[0] = t[1];
        t[1] = swap;
    }
    return 2;
}

/* The form's value at t is off by at most 16u of its size, so t by that over the slope there; near
 * a tangent the count is open. */
static void lines(void) {
    int met = 0, missed = 0;
    for (int n = 0; n < 4000; ++n) {
        const double extent = pow(10, check_uniform(-7, 7));
        const spt_region region = region_draw(origin, extent);
        const spt_sphere_coefficients s = spt_region_coefficients(&region);
        double from[3], direction[3], t[2] = {0, 0};
        const double any = pow(10, check_uniform(-3, 3));
        extended truth[2] = {0, 0};
        quadratic q;
        int count;
        draw_direction(direction);
        for (int i = 0; i < 3; ++i) {
            from[i] = extent * check_uniform(-3, 3);
            direction[i] *= any;
            if (n % 3 == 0 && region.kind != SPT_REGION_HALF_SPACE)
                direction[i] =
                    any * (region.center[i] - from[i] + region.radius * check_uniform(-1, 1));
        }
        q = quadratic_of(&s, from, direction, 0);
        count = own_roots(&q, truth);
        check_context("line %d, kind %u", n, region.kind);
        if (fabsl(q.b * q.b - q.a * q.c) <
            32 * unit * (q.b * q.b + fabsl(q.a) * quadratic_of(&s, from, direction, 0).size))
            continue;
        CHECK_SAY(spt_sphere_meets_line(&s, from, direction, t) == count, "not %d", count);
        CHECK(count < 2 || t[0] <= t[1]);
        for (int i = 0; i < count; ++i) {
            const quadratic there = quadratic_of(&s, from, direction, truth[i]);
            const extended slope = 2 * fabsl(there.a * truth[i] + there.b);
            const extended error = 16 * (unit + extended_unit()) * there.size / slope;
            const extended off = fabsl((extended)t[i] - truth[i]);
            if (error > 1e-3L * fabsl(truth[i])) continue;
            CHECK_SAY(off <= error, "t %.17g off by %Lg of %Lg", t[i], off, error);
        }
        met += count > 0;
        missed += count == 0;
    }
    CHECK_SAY(met > 1500 && missed > 500, "%d met, %d missed", met, missed);
}

/* Whole numbers, where nothing rounds. */
static void lines_known(void) {
    const spt_region ball = {SPT_REGION_BALL, {0, 0, 0}, 1}, outside = {SPT_REGION_OUTSIDE, {0}, 1};
    const spt_region plane = {SPT_REGION_HALF_SPACE, {0, 1, 0}, 2};
    const double from[3] = {-4, 1, 0}, level[3] = {-4, 0, 0}, above[3] = {-4, 2, 0};
    const double along[3] = {2, 0, 0}, up[3] = {0, 0.5, 0}, down[3] = {0, -4, 0};
    double t[2] = {9, 9};
    spt_sphere_coefficients s = spt_region_coefficients(&ball);
    CHECK(spt_sphere_meets_line(&s, level, along, t) == 2);
    CHECK(!(fabs(t[0] - 1.5) > 0) && !(fabs(t[1] - 2.5) > 0));
    CHECK(spt_sphere_meets_line(&s, from, along, t) == 2); /* a tangent counts twice */
    CHECK(!(fabs(t[0] - 2) > 0) && !(fabs(t[1] - 2) > 0));
    CHECK(spt_sphere_meets_line(&s, above, along, t) == 0);
    s = spt_region_coefficients(&outside);
    CHECK(spt_sphere_meets_line(&s, level, along, t) == 2);
    CHECK(!(fabs(t[0] - 1.5) > 0) && !(fabs(t[1] - 2.5) > 0));
    s = spt_region_coefficients(&plane);
    CHECK(spt_sphere_meets_line(&s, from, up, t) == 1);
    CHECK(!(fabs(t[0] - 2) > 0));
    CHECK(spt_sphere_meets_line(&s, from, down, t) == 1);
    CHECK(!(fabs(t[0] + 0.25) > 0));
    CHECK(spt_sphere_meets_line(&s, from, along, t) == 0);  /* beside it */
    CHECK(spt_sphere_meets_line(&s, above, along, t) == 0); /* in it */
}

void suite_mobius_exit(void) {
    RUN(exits);
    RUN(S14_exits_without_end);
    RUN(M4_exit_at_the_pole);
    RUN(lines);
    RUN(lines_known);
}
