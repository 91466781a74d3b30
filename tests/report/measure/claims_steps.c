/* SPDX-License-Identifier: MIT
 *
 * What over-relaxation and its successors save, and what the optimisation for convex bodies
 * saves, where Keinert et al. 2014, section 4, measured it: with the callbacks of our scenes,
 * with the same built without vectors, and with fields that cost as much as the paper's. Those
 * take nearly all of the paper's time: its 20.4 ms for 1280x720 rays of at most 80 evaluations
 * are at least 0.28 ns each on a card that does 4500 operations in a nanosecond, against about 25
 * of a step. */
#include "claims.h"

#include <math.h>
#include <string.h>

static const claims_way of_rays[] = {
    {"basic", "basic", 1.2f, 0, 1, 0},
    {"relaxed", "relaxed", 1.2f, 0, 1, 0},
    {"adaptive", "adaptive", 1.2f, 0, 1, 0},
};

/* The relaxation is the paper's. */
static const claims_way of_paths[] = {
    {"basic", "basic", 1.4f, 0, 1, 0},
    {"relaxed", "relaxed", 1.4f, 0, 1, 0},
    {"adaptive", "adaptive", 1.4f, 0, 1, 0},
};

/* Through the body, as without the optimisation; backwards by the same rule, as in the paper; and
 * what the library does by default, backwards by the rule for convex fields. */
static const claims_way of_glass[] = {
    {"basic", "basic", 1.2f, 0, 1, 0},       {"relaxed", "relaxed", 1.2f, 0, 1, 0},
    {"adaptive", "adaptive", 1.2f, 0, 1, 0}, {"backwards", "adaptive", 1.2f, 1, 0, 2},
    {"convex", "adaptive", 1.2f, 1, 1, 2},
};

static const claims_case cases[] = {
    {1, "city", "city", 20.409 / 16.829, of_rays, 3, claims_cast},
    {1, "jewel", "jewel", 3.472 / 2.978, of_rays, 3, claims_cast},
    {1, "jewel_frame", "jewel", 22.470 / 21.11, of_rays, 3, claims_frames},
    {1, "paths", "primitives", 118.302 / 101.934, of_paths, 3, claims_paths},
    {2, "glass", "glass", 3.03 / 2.73, of_glass, 5, claims_glass},
    {2, "glass_frame", "glass", (double)NAN, of_glass, 5, claims_frames},
};
enum { CASES = sizeof cases / sizeof cases[0] };

static const char *const callbacks[] = {"vectors", "scalar", "costly"};
enum { SCALAR = 1, COSTLY = 2, CALLBACKS = 3 };

/* Of the time of basic tracing, at least, with a costly field. */
static const double costly_share = 0.95;

/* How often a costly field asks its own callback, from two rounds that differ by nothing else.
 * *once receives the seconds of a round that asks it once. */
static int repeats(const report_options *options, const claims_case *measured, double *once) {
    enum { MORE = 65 };
    claims_case basic = *measured;
    const claims_callback alone = {0, 1}, often = {0, MORE};
    claims_result first, second;
    basic.number = 1;
    memset(&first, 0, sizeof first);
    memset(&second, 0, sizeof second);
    measured->measure(options, &basic, alone, 3, &first);
    measured->measure(options, &basic, often, 1, &second);
    *once = claims_seconds(first.seconds, 3).middle;
    const double each = (second.seconds[0] - *once) / (MORE - 1);
    report_expect(each > 0, "a field that is asked more often takes no time");
    const double rest = fmax(*once - each, 0);
    return (int)ceil(fmax(costly_share / (1 - costly_share) * rest / each, 2));
}

/* Nanoseconds of an evaluation by itself; NAN: of more than one field. */
static double own_cost(const claims_case *measured, int scalar) {
    if (measured->measure == claims_paths) return (double)NAN;
    const spt_field field = scene_field(scene_named(measured->scene), scalar ? 1 : spt_lanes());
    return claims_field_cost(&field);
}

static int cells(const report_options *options) {
    (void)options;
    return CALLBACKS * CASES - 1; /* whole frames of glass, which are not judged, cost enough */
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const claims_case *const measured = &cases[cell / CALLBACKS];
    const int kind = cell % CALLBACKS;
    claims_callback callback = {kind == SCALAR, 1};
    claims_result results[claims_most_ways];
    double once = 0, cost;
    int rounds = options->quick ? 5 : claims_most_rounds;
    memset(results, 0, sizeof results);
    if (kind == COSTLY) {
        callback.times = repeats(options, measured, &once);
        rounds = options->quick ? 3 : 5; /* of much work, which repeats well */
    }
    measured->measure(options, measured, callback, rounds, results);
    if (kind == COSTLY) {
        const double often = claims_seconds(results[0].seconds, rounds).middle;
        cost =
            (often - once) / (callback.times - 1) * callback.times / results[0].evaluations * 1e9;
    } else {
        cost = own_cost(measured, callback.scalar);
    }
    for (int i = 0; i < measured->number; ++i) {
        const claims_way *const way = &measured->ways[i];
        const claims_result *const result = &results[i], *const base = &results[way->against];
        const double nanoseconds =
            1e9 * claims_seconds(result->seconds, rounds).middle / result->rays;
        const double count = result->evaluations / result->rays;

        fprintf(rows, "%d,%s,%s,%s,%s,%d,%.9g,%.9g", measured->claim, measured->name,
                callbacks[kind], way->name, measured->ways[way->against].name, callback.times,
                result->rays, count);
        claims_write(rows, base->evaluations / result->evaluations);
        claims_write_spread(rows, claims_faster(result->seconds, base->seconds, rounds));
        claims_write(rows, nanoseconds);
        claims_write(rows, cost);
        claims_write(rows, cost * count / nanoseconds);
        claims_write(rows, measured->printed);
        fputc('\n', rows);
    }
}

/* times: that the callback is asked for an evaluation. fewer: times fewer evaluations a round;
 * faster: times as fast, the middle of the rounds and their quartiles; field_share: of the time,
 * evaluations at field_nanoseconds each. */
const report_part report_claim_steps = {
    "claim_steps",
    "claim,case,callback,way,against,times,rays,evaluations,fewer,faster,faster_low,faster_high,"
    "nanoseconds,field_nanoseconds,field_share,printed",
    cells,
    measure,
    1,
    {85, 14}};
