/* SPDX-License-Identifier: MIT
 *
 * error_equal.csv: what a rule costs to come to an error, as a share of what basic costs in the
 * same schedule, by scene and in the mean of those of the ten kinds in which every rule that needs
 * no licence comes to it: by evaluations and by time. spt_convex() has no mean: it traces others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error_points.h"

static const char *const errors[] = {"0.01", "0.001", "0.0001"};
enum { ERRORS = sizeof errors / sizeof errors[0] };

/* The costs of all rules in a scene and a schedule, as shares of basic's; NAN: not measured. */
typedef struct equal_costs {
    double share[report_rules][error_costs];
    int complete; /* all have one, but for spt_convex(), the last, which needs a licence */
} equal_costs;

static equal_costs costs_of(const error_points *points, const char *shown, const char *schedule,
                            double error) {
    equal_costs of;
    const error_curve basic = error_curve_of(points, shown, schedule, "basic");
    of.complete = 1;
    for (int rule = 0; rule < report_rules; ++rule) {
        const error_curve own = error_curve_of(points, shown, schedule, report_rule[rule]);
        for (int cost = 0; cost < error_costs; ++cost) {
            of.share[rule][cost] =
                error_cost_at(&own, cost, error) / error_cost_at(&basic, cost, error);
        }
        if (rule < report_rules - 1 && isnan(of.share[rule][ERROR_COST_TIME])) of.complete = 0;
    }
    return of;
}

static void write_equal(FILE *rows, const char *shown, const char *schedule, int rule,
                        const char *error, int kinds, const double *share) {
    if (isnan(share[ERROR_COST_TIME])) return;
    fprintf(rows, "%s,%s,%s,%s,%d", shown, schedule, report_rule[rule], error, kinds);
    error_write(rows, share[ERROR_COST_EVALUATIONS]);
    error_write(rows, share[ERROR_COST_TIME]);
    fputc('\n', rows);
}

static void compare(const error_points *points, const char *schedule, const char *error,
                    FILE *rows) {
    error_mean means[report_rules][error_costs] = {{{0, 0}}};
    for (int i = 0; i < points->scenes; ++i) {
        const char *const shown = points->scene[i];
        const equal_costs of = costs_of(points, shown, schedule, strtod(error, NULL));
        for (int rule = 0; rule < report_rules; ++rule) {
            write_equal(rows, shown, schedule, rule, error, 1, of.share[rule]);
            if (!of.complete || !error_is_kind(shown)) continue;
            for (int cost = 0; cost < error_costs; ++cost) {
                error_mean_add(&means[rule][cost], of.share[rule][cost]);
            }
        }
    }
    for (int rule = 0; rule < report_rules - 1; ++rule) {
        double share[error_costs];
        for (int cost = 0; cost < error_costs; ++cost) {
            share[cost] = error_mean_of(&means[rule][cost]);
        }
        write_equal(rows, "mean", schedule, rule, error, means[rule][0].count, share);
    }
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    (void)cell;
    for (int schedule = 0; schedule < points->schedules; ++schedule) {
        if (error_is_control(points->schedule[schedule])) continue;
        for (int e = 0; e < ERRORS; ++e) {
            compare(points, points->schedule[schedule], errors[e], rows);
        }
    }
    error_points_free(points);
}

const report_part report_error_equal = {
    "error_equal",
    "scene,schedule,method,error,scenes,evaluations_share,time_share",
    error_one_cell,
    measure,
    0,
    {3, 0.3}};
