/* SPDX-License-Identifier: MIT
 *
 * Quartiles, rounds and cells of the tables about the papers' claims. */
#include "claims.h"

#include <math.h>
#include <string.h>

const claims_spread claims_unknown = {(double)NAN, (double)NAN, (double)NAN};

claims_spread claims_spread_of(double *values, int count) {
    const size_t number = (size_t)count;
    claims_spread spread;
    spread.low = report_quantile(values, number, 0.25);
    spread.middle = report_quantile(values, number, 0.5);
    spread.high = report_quantile(values, number, 0.75);
    return spread;
}

double claims_noise(claims_spread spread) {
    return 0.5 * (spread.high - spread.low) / spread.middle;
}

claims_spread claims_seconds(const double *seconds, int rounds) {
    double values[BENCH_MOST_ROUNDS];
    memcpy(values, seconds, (size_t)rounds * sizeof *values);
    return claims_spread_of(values, rounds);
}

claims_spread claims_faster(const double *seconds, const double *other, int rounds) {
    double ratios[BENCH_MOST_ROUNDS];
    for (int round = 0; round < rounds; ++round) ratios[round] = other[round] / seconds[round];
    return claims_spread_of(ratios, rounds);
}

void claims_write(FILE *rows, double number) {
    fputc(',', rows);
    if (!isnan(number)) fprintf(rows, "%.9g", number);
}

void claims_write_spread(FILE *rows, claims_spread spread) {
    claims_write(rows, spread.middle);
    claims_write(rows, spread.low);
    claims_write(rows, spread.high);
}

static double process_seconds(void *user) {
    (void)user;
    return bench_seconds();
}

double claims_field_cost(const spt_field *field) {
    double costs[3];
    for (int i = 0; i < 3; ++i) {
        spt_field_cost cost = {0, 0};
        keinert_expect(spt_field_measure(field, process_seconds, NULL, &cost), "spt_field_measure");
        costs[i] = cost.nanoseconds_256;
    }
    return claims_spread_of(costs, 3).middle;
}

/* ---- Fields that cost more ------------------------------------------------------------------ */

static void ask(const claims_repeated *repeated, void *user, size_t n, const float *x,
                const float *y, const float *z, float *distance) {
    for (int i = 0; i < repeated->times; ++i) repeated->batch(user, n, x, y, z, distance);
}

static void ask_field(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    const claims_repeated *const repeated = user;
    ask(repeated, repeated->user, n, x, y, z, distance);
}

/* The renderers hand scenes on to the library by their callbacks alone. */
static claims_repeated of_scene;

static void ask_scene(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    ask(&of_scene, user, n, x, y, z, distance);
}

void claims_repeat_scene(scene *shown, claims_callback callback) {
    int widest = 0;
    while (!callback.scalar && widest + 1 < BENCH_WIDTHS && bench_lanes[widest] < spt_lanes()) {
        ++widest;
    }
    of_scene.batch = shown->batch[widest];
    of_scene.times = callback.times;
    for (int width = 0; width < BENCH_WIDTHS; ++width) {
        shown->batch[width] = callback.times > 1 ? ask_scene : of_scene.batch;
    }
}

void claims_repeat_field(spt_field *field, int times, claims_repeated *memory) {
    memory->batch = field->batch;
    memory->user = field->user;
    memory->times = times;
    field->batch = ask_field;
    field->user = memory;
}

/* ---- Rounds --------------------------------------------------------------------------------- */

void claims_race(const claims_case *measured, void *const *users, keinert_run_fn *run, int rounds,
                 claims_result *results) {
    keinert_contender contenders[claims_most_ways];
    memset(contenders, 0, sizeof contenders);
    for (int i = 0; i < measured->number; ++i) {
        contenders[i].name = measured->ways[i].name;
        contenders[i].user = users[i];
    }
    keinert_race(contenders, measured->number, rounds, run);
    for (int i = 0; i < measured->number; ++i) {
        memcpy(results[i].seconds, contenders[i].seconds,
               (size_t)rounds * sizeof results[i].seconds[0]);
    }
}
