/* SPDX-License-Identifier: MIT
 *
 * error_passes.csv: what cones and passes of rising resolution save at equal error, against single
 * rays and against one pass, by scene and in the mean of the ten kinds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error_points.h"

static const char *const baselines[] = {"direct", "passes_1"};
static const char *const errors[] = {"0.3",   "0.1",   "0.03",   "0.01",
                                     "0.003", "0.001", "0.0003", "0.0001"};
enum { BASELINES = 2, ERRORS = sizeof errors / sizeof errors[0] };

/* What passes are compared by. */
enum { TIME, EVALUATIONS, COSTS };

/* Error against cost, by budget. */
typedef struct curve {
    double cost[COSTS][error_most_budgets], rms[error_most_budgets];
    int count;
} curve;

typedef struct passes_job {
    const error_points *points;
    FILE *rows;
} passes_job;

static curve curve_of(const passes_job *job, const char *shown, const char *schedule,
                      const char *method) {
    curve of;
    of.count = 0;
    for (int i = 0; i < job->points->budgets; ++i) {
        const error_point *const point =
            error_point_at(job->points, shown, schedule, method, job->points->budget[i]);
        if (point == NULL || isnan(point->rms)) continue;
        of.cost[TIME][of.count] = point->nanoseconds;
        of.cost[EVALUATIONS][of.count] = point->evaluations;
        of.rms[of.count++] = point->rms;
    }
    return of;
}

/* What it costs to come to an error: between two budgets as a power of the error. NAN: the least
 * budget is better than that already, or the largest is not. */
static double cost_at(const curve *of, int cost, double error) {
    int i = 0;
    while (i < of->count && of->rms[i] > error) ++i;
    if (i == 0 || i == of->count) return (double)NAN;
    const double before = log(of->rms[i - 1]), after = log(of->rms[i]);
    const double share = (before - log(error)) / (before - after);
    return exp(log(of->cost[cost][i - 1]) +
               share * (log(of->cost[cost][i]) - log(of->cost[cost][i - 1])));
}

static void write_row(const passes_job *job, const char *baseline, const char *shown,
                      const char *schedule, const char *method, const char *error, int kinds,
                      const double *gains) {
    if (kinds == 0) return;
    fprintf(job->rows, "%s,%s,%s,%s,%s,%d", baseline, shown, schedule, method, error, kinds);
    for (int cost = 0; cost < COSTS; ++cost) error_write(job->rows, gains[cost]);
    fputc('\n', job->rows);
}

/* A rule in a schedule against the same rule in the baseline, at all errors. */
static void compare(const passes_job *job, const char *baseline, const char *schedule,
                    const char *method) {
    error_mean means[ERRORS][COSTS] = {{{0, 0}}};
    for (int i = 0; i < job->points->scenes; ++i) {
        const char *const shown = job->points->scene[i];
        const curve own = curve_of(job, shown, schedule, method);
        const curve other = curve_of(job, shown, baseline, method);
        for (int e = 0; e < ERRORS; ++e) {
            double gains[COSTS];
            for (int cost = 0; cost < COSTS; ++cost) {
                const double error = strtod(errors[e], NULL);
                gains[cost] = cost_at(&other, cost, error) / cost_at(&own, cost, error);
                if (error_is_kind(shown)) error_mean_add(&means[e][cost], gains[cost]);
            }
            write_row(job, baseline, shown, schedule, method, errors[e], !isnan(gains[TIME]),
                      gains);
        }
    }
    for (int e = 0; e < ERRORS; ++e) {
        double gains[COSTS];
        for (int cost = 0; cost < COSTS; ++cost) gains[cost] = error_mean_of(&means[e][cost]);
        write_row(job, baseline, "mean", schedule, method, errors[e], means[e][TIME].count, gains);
    }
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    const passes_job job = {points, rows};
    (void)cell;
    for (int baseline = 0; baseline < BASELINES; ++baseline) {
        for (int i = 0; i < points->schedules; ++i) {
            const char *const schedule = points->schedule[i];
            const int passes = strncmp(schedule, "passes", 6) == 0;
            if (error_is_control(schedule) || strcmp(schedule, baselines[baseline]) == 0) continue;
            if (strcmp(schedule, "direct") == 0 || (baseline == 1 && !passes)) continue;
            for (int rule = 0; rule < report_rules; ++rule) {
                compare(&job, baselines[baseline], schedule, report_rule[rule]);
            }
        }
    }
    error_points_free(points);
}

const report_part report_error_passes = {
    "error_passes",
    "baseline,scene,schedule,method,error,scenes,time_gain,evaluations_gain",
    error_one_cell,
    measure,
    0,
    {8, 0.5}};
