/* SPDX-License-Identifier: MIT
 *
 * claim_error.csv: the comparisons of Bálint & Valasek 2018, section 5, on their three scenes, from
 * claim_resolution.csv: error times time by budget, and time at equal error with and without
 * resolutions that rise. */
#include "claims.h"
#include "error_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A fractal; tori, spheres, boxes and cylinders; a village of many planes. */
static const char *const papers[] = {"mandelbulb", "primitives", "village"};
enum { PAPERS = sizeof papers / sizeof papers[0], MOST_POINTS = 16 };

/* Error against time of a rule in a schedule, by budget. */
typedef struct curve {
    double nanoseconds[MOST_POINTS], rms[MOST_POINTS], noise[MOST_POINTS], open[MOST_POINTS];
    const char *budget[MOST_POINTS];
    int count;
} curve;

static curve curve_of(const csv_table *table, const char *shown, const char *schedule,
                      const char *method) {
    curve of;
    of.count = 0;
    for (int row = -1; (row = csv_next(table, row, "scene=%s,schedule=%s,method=%s", shown,
                                       schedule, method)) >= 0;) {
        report_expect(of.count < MOST_POINTS, "too many budgets");
        of.nanoseconds[of.count] = csv_number(table, row, "nanoseconds");
        of.rms[of.count] = csv_number(table, row, "rms");
        of.noise[of.count] = csv_number(table, row, "noise");
        of.open[of.count] = csv_number(table, row, "undecided") / csv_number(table, row, "rays");
        of.budget[of.count++] = csv_text(table, row, "budget");
    }
    report_expect(of.count > 0, "no errors of a rule in a schedule");
    return of;
}

/* What a comparison comes to over the scenes. */
typedef struct gains {
    error_mean gain, low, high, root;
    double least, most, open;
    int scenes;
} gains;

/* noise: of the ratio of two times, as far as their quartiles lie apart at most. */
static void add(gains *to, double gain, double root, double noise) {
    if (!(gain > 0)) return;
    error_mean_add(&to->gain, gain);
    error_mean_add(&to->low, gain / (1 + noise));
    error_mean_add(&to->high, gain * (1 + noise));
    error_mean_add(&to->root, root);
    to->least = to->scenes == 0 ? gain : fmin(to->least, gain);
    to->most = to->scenes == 0 ? gain : fmax(to->most, gain);
    ++to->scenes;
}

static void write_row(const gains *over, const char *question, const char *method,
                      const char *against, const char *schedule, const char *budget, FILE *rows) {
    if (over->scenes == 0) return;
    fprintf(rows, "%s,%s,%s,%s,%s,%d", question, method, against, schedule, budget, over->scenes);
    error_write(rows, error_mean_of(&over->gain));
    error_write(rows, error_mean_of(&over->low));
    error_write(rows, error_mean_of(&over->high));
    error_write(rows, over->least);
    error_write(rows, over->most);
    error_write(rows, error_mean_of(&over->root));
    error_write(rows, over->open / over->scenes);
    fputc('\n', rows);
}

/* ---- Error times time ----------------------------------------------------------------------- */

/* The paper takes the square of the error; root: without. */
static void compare_products(const csv_table *table, const char *method, const char *against,
                             FILE *rows) {
    curve own[PAPERS], other[PAPERS];
    for (int which = 0; which < PAPERS; ++which) {
        own[which] = curve_of(table, papers[which], "direct", method);
        other[which] = curve_of(table, papers[which], "direct", against);
    }
    for (int i = 0; i < own[0].count; ++i) {
        gains over;
        memset(&over, 0, sizeof over);
        for (int which = 0; which < PAPERS; ++which) {
            const curve *const a = &own[which], *const b = &other[which];
            const double error = b->rms[i] / a->rms[i];
            const double root = error * b->nanoseconds[i] / a->nanoseconds[i];
            over.open += b->open[i];
            add(&over, root * error, root, a->noise[i] + b->noise[i]);
        }
        write_row(&over, "product", method, against, "direct", own[0].budget[i], rows);
    }
}

/* ---- Time at equal error -------------------------------------------------------------------- */

/* The time that it takes to come to an error: between two budgets as a power of the error. Where
 * the least budget is better already, its time, which is too long; NAN where no budget is good
 * enough. *noise: of the budget that is. */
static double time_at(const curve *of, double error, double *noise) {
    int i = 0;
    while (i < of->count && of->rms[i] > error) ++i;
    if (i == of->count) return (double)NAN;
    *noise = of->noise[i];
    if (i == 0) return of->nanoseconds[0];
    const double share = log(of->rms[i - 1] / error) / log(of->rms[i - 1] / of->rms[i]);
    return of->nanoseconds[i - 1] * pow(of->nanoseconds[i] / of->nanoseconds[i - 1], share);
}

/* Two errors that are nearly equal count as equal: where no ray runs out of budget, errors are what
 * half a pixel leaves, which is no power of the time any more and a little different by where rays
 * begin. */
static const double nearly = 1.05;

/* A rule in a schedule against itself on single rays, at the errors that those have with each
 * budget. passes_1 is no baseline: it goes by cones, too. */
static void compare_times(const csv_table *table, const char *schedule, const char *method,
                          FILE *rows) {
    curve direct[PAPERS], own[PAPERS];
    for (int which = 0; which < PAPERS; ++which) {
        direct[which] = curve_of(table, papers[which], "direct", method);
        own[which] = curve_of(table, papers[which], schedule, method);
    }
    for (int i = 0; i < direct[0].count; ++i) {
        gains over;
        memset(&over, 0, sizeof over);
        for (int which = 0; which < PAPERS; ++which) {
            const double error = nearly * direct[which].rms[i];
            double noise = 0, of_direct = 0;
            const double alone = time_at(&direct[which], error, &of_direct);
            const double time = time_at(&own[which], error, &noise);
            add(&over, alone / time, (double)NAN, noise + of_direct);
        }
        write_row(&over, "time", method, "direct", schedule, direct[0].budget[i], rows);
    }
}

/* ---- The table ------------------------------------------------------------------------------ */

static int one_cell(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    static const char *const methods[] = {"relaxed", "enhanced", "auto_relaxed", "adaptive"};
    static const char *const schedules[] = {"frame", "passes_2", "passes_4", "passes_6"};
    enum { METHODS = 4, SCHEDULES = 4 };
    csv_table *const table = csv_open(options->output, "claim_resolution");
    (void)cell;
    for (int i = 0; i < METHODS; ++i) {
        compare_products(table, methods[i], "basic", rows);
        if (i > 0) compare_products(table, methods[i], "relaxed", rows);
    }
    for (int i = 0; i < SCHEDULES; ++i) {
        compare_times(table, schedules[i], "basic", rows);
        for (int k = 0; k < METHODS; ++k) compare_times(table, schedules[i], methods[k], rows);
    }
    csv_close(table);
}

/* product: how many times less error^2 x time than the rule `against` has; root: error x time;
 * open: the share of that one's rays that are out of budget. time: how many times less time than
 * single rays take to the error that those have with the budget. gain: in the geometric mean of
 * the scenes, from least to most; gain_low, gain_high: as far as the clock's noise goes. */
const report_part report_claim_error = {
    "claim_error",
    "question,method,against,schedule,budget,scenes,gain,gain_low,gain_high,least,most,"
    "gain_root,open",
    one_cell,
    measure,
    0,
    {1, 0.2}};
