/* SPDX-License-Identifier: MIT
 *
 * summary.csv: what the first section of the page says in numbers, from the tables of this run. low
 * and high: the scenes with the least and the most. */
#include "../csv.h"
#include "../report.h"

#include <math.h>
#include <string.h>

/* Enough for nearly all rays to end, so that what is compared are the costs of the same results. */
#define AMPLE "budget=512"

static int rows_with(const csv_table *table, const char *where) {
    int count = 0;
    for (int row = csv_next(table, -1, "%s", where); row >= 0;
         row = csv_next(table, row, "%s", where)) {
        ++count;
    }
    return count;
}

static void count_row(FILE *rows, const char *what, int count) {
    fprintf(rows, "%s,%d,,\n", what, count);
}

static double cost_of(const csv_table *error, const char *name, const char *run, const char *cost) {
    const int row = csv_next(error, -1, "scene=%s," AMPLE ",%s", name, run);
    return row >= 0 ? csv_number(error, row, cost) : (double)NAN;
}

/* How many times more of a cost one run takes than another: the geometric mean over the ten kinds
 * of scene. */
static void ratio_row(FILE *rows, const csv_table *error, const char *what, const char *cost,
                      const char *more, const char *less) {
    double sum = 0, low = HUGE_VAL, high = 0;
    int count = 0;
    for (int i = 0; i < report_kinds; ++i) {
        const double ratio = cost_of(error, report_scenes[i], more, cost) /
                             cost_of(error, report_scenes[i], less, cost);
        if (!isfinite(ratio) || !(ratio > 0)) continue;
        sum += log(ratio);
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        ++count;
    }
    report_expect(count > 0, "a ratio that the summary shows has no scene");
    fprintf(rows, "%s,%.9g,%.9g,%.9g\n", what, exp(sum / count), low, high);
}

static int one(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    (void)cell;
    csv_table *const promises = csv_open(options->output, "promises");
    count_row(rows, "promises", csv_rows(promises));
    count_row(rows, "promises_kept", rows_with(promises, "kept=1"));
    csv_close(promises);

    csv_table *const claims = csv_open(options->output, "claims");
    count_row(rows, "claims", csv_rows(claims));
    count_row(rows, "claims_exceeded", rows_with(claims, "verdict=exceeded"));
    count_row(rows, "claims_reached", rows_with(claims, "verdict=reached"));
    csv_close(claims);

    csv_table *const error = csv_open(options->output, "error");
    const char *const basic = "schedule=direct,method=basic";
    const char *const adaptive = "schedule=direct,method=adaptive";
    const char *const frame = "schedule=frame,method=adaptive";
    ratio_row(rows, error, "basic_evaluations", "evaluations", basic, adaptive);
    ratio_row(rows, error, "basic_nanoseconds", "nanoseconds", basic, adaptive);
    ratio_row(rows, error, "basic_frame_evaluations", "evaluations", basic, frame);
    ratio_row(rows, error, "basic_frame_nanoseconds", "nanoseconds", basic, frame);
    /* The same rule on both sides, so that what is compared is how it is run. */
    ratio_row(rows, error, "plain_nanoseconds", "nanoseconds",
              "schedule=control,method=plain_scalar", basic);
    csv_close(error);
}

const report_part report_summary = {"summary", "what,value,low,high", one, measure,
                                    0,         {0.01, 0.01}};
