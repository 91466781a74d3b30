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

typedef struct passes_job {
    const error_points *points;
    FILE *rows;
} passes_job;

static void write_row(const passes_job *job, const char *baseline, const char *shown,
                      const char *schedule, const char *method, const char *error, int kinds,
                      const double *gains) {
    if (kinds == 0) return;
    fprintf(job->rows, "%s,%s,%s,%s,%s,%d", baseline, shown, schedule, method, error, kinds);
    for (int cost = 0; cost < error_costs; ++cost) error_write(job->rows, gains[cost]);
    fputc('\n', job->rows);
}

/* A rule in a schedule against the same rule in the baseline, at all errors. */
static void compare(const passes_job *job, const char *baseline, const char *schedule,
                    const char *method) {
    error_mean means[ERRORS][error_costs] = {{{0, 0}}};
    for (int i = 0; i < job->points->scenes; ++i) {
        const char *const shown = job->points->scene[i];
        const error_curve own = error_curve_of(job->points, shown, schedule, method);
        const error_curve other = error_curve_of(job->points, shown, baseline, method);
        for (int e = 0; e < ERRORS; ++e) {
            double gains[error_costs];
            for (int cost = 0; cost < error_costs; ++cost) {
                const double error = strtod(errors[e], NULL);
                gains[cost] = error_cost_at(&other, cost, error) / error_cost_at(&own, cost, error);
                if (error_is_kind(shown)) error_mean_add(&means[e][cost], gains[cost]);
            }
            write_row(job, baseline, shown, schedule, method, errors[e],
                      !isnan(gains[ERROR_COST_TIME]), gains);
        }
    }
    for (int e = 0; e < ERRORS; ++e) {
        double gains[error_costs];
        for (int cost = 0; cost < error_costs; ++cost) gains[cost] = error_mean_of(&means[e][cost]);
        write_row(job, baseline, "mean", schedule, method, errors[e],
                  means[e][ERROR_COST_TIME].count, gains);
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
