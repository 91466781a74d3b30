/* SPDX-License-Identifier: MIT
 *
 * error_best.csv and error_means.csv: the paper's measure, the product of error and cost, as small
 * as each rule can make it, and by budget in the mean of the ten kinds. */
#include <math.h>
#include <string.h>

#include "error_points.h"

/* The least of a measure over all budgets. */
typedef struct least {
    double value;
    const char *budget;
} least;

static least least_of(const error_points *points, const char *shown, const char *schedule,
                      const char *method, double (*measure)(const error_point *point)) {
    least found = {(double)NAN, ""};
    for (int i = 0; i < points->budgets; ++i) {
        const error_point *const point =
            error_point_at(points, shown, schedule, method, points->budget[i]);
        if (point == NULL || isnan(measure(point))) continue;
        if (isnan(found.value) || measure(point) < found.value) {
            found.value = measure(point);
            found.budget = point->budget;
        }
    }
    return found;
}

static void write_best(const error_points *points, const char *shown, const char *schedule,
                       const char *method, FILE *rows) {
    const least time = least_of(points, shown, schedule, method, error_time_of);
    const least evaluations = least_of(points, shown, schedule, method, error_evaluations_of);
    /* Of controls: basic tracing by the library, of rays. */
    const char *const against = error_is_control(schedule) ? "direct" : schedule;
    const least basic_time = least_of(points, shown, against, "basic", error_time_of);
    const least basic = least_of(points, shown, against, "basic", error_evaluations_of);
    if (isnan(evaluations.value)) return;
    fprintf(rows, "%s,%s,%s", shown, schedule, method);
    error_write(rows, time.value);
    fprintf(rows, ",%s", time.budget);
    error_write(rows, basic_time.value / time.value);
    error_write(rows, evaluations.value);
    fprintf(rows, ",%s", evaluations.budget);
    error_write(rows, basic.value / evaluations.value);
    fputc('\n', rows);
}

static void measure_best(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    (void)cell;
    for (int i = 0; i < points->scenes; ++i) {
        for (int schedule = 0; schedule < points->schedules; ++schedule) {
            for (int method = 0; method < points->methods; ++method) {
                write_best(points, points->scene[i], points->schedule[schedule],
                           points->method[method], rows);
            }
        }
    }
    error_points_free(points);
}

const report_part report_error_best = {
    "error_best",
    "scene,schedule,method,error_time,time_budget,error_time_over_basic,error_evaluations,"
    "evaluations_budget,error_evaluations_over_basic",
    error_one_cell,
    measure_best,
    0,
    {3, 0.3}};

/* ---- Means ---------------------------------------------------------------------------------- */

/* How many times as good a rule is, in the mean: as another rule in the same schedule, or as itself
 * on single rays. */
typedef struct error_gains {
    error_mean rms, evaluations, time;
} error_gains;

static void add_gains(error_gains *gains, const error_point *own, const error_point *other) {
    if (other == NULL) return;
    error_mean_add(&gains->rms, other->rms / own->rms);
    error_mean_add(&gains->evaluations, error_evaluations_of(other) / error_evaluations_of(own));
    error_mean_add(&gains->time, error_time_of(other) / error_time_of(own));
}

static void write_gains(const error_gains *gains, FILE *rows) {
    error_write(rows, error_mean_of(&gains->rms));
    error_write(rows, error_mean_of(&gains->evaluations));
    error_write(rows, error_mean_of(&gains->time));
}

static void write_means(const error_points *points, const char *schedule, const char *method,
                        const char *budget, FILE *rows) {
    static const error_gains none = {{0, 0}, {0, 0}, {0, 0}};
    error_gains basic = none, relaxed = none, direct = none;
    int kinds = 0, ahead = 0;
    for (int i = 0; i < points->scenes; ++i) {
        const char *const shown = points->scene[i];
        const error_point *const own = error_point_at(points, shown, schedule, method, budget);
        if (own == NULL || !error_is_kind(shown)) continue;
        const error_point *const other = error_point_at(points, shown, schedule, "relaxed", budget);
        add_gains(&basic, own, error_point_at(points, shown, schedule, "basic", budget));
        add_gains(&relaxed, own, other);
        add_gains(&direct, own, error_point_at(points, shown, "direct", method, budget));
        ahead += other != NULL && error_evaluations_of(own) < error_evaluations_of(other);
        ++kinds;
    }
    if (kinds == 0) return;
    fprintf(rows, "%s,%s,%s,%d", schedule, method, budget, kinds);
    write_gains(&basic, rows);
    write_gains(&relaxed, rows);
    write_gains(&direct, rows);
    error_write(rows, ahead);
    fputc('\n', rows);
}

static void measure_means(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    (void)cell;
    for (int schedule = 0; schedule < points->schedules; ++schedule) {
        if (error_is_control(points->schedule[schedule])) continue;
        for (int method = 0; method < points->methods; ++method) {
            for (int budget = 0; budget < points->budgets; ++budget) {
                write_means(points, points->schedule[schedule], points->method[method],
                            points->budget[budget], rows);
            }
        }
    }
    error_points_free(points);
}

const report_part report_error_means = {
    "error_means",
    "schedule,method,budget,scenes,error_over_basic,error_evaluations_over_basic,"
    "error_time_over_basic,error_over_relaxed,error_evaluations_over_relaxed,"
    "error_time_over_relaxed,error_over_direct,error_evaluations_over_direct,"
    "error_time_over_direct,scenes_ahead_of_relaxed",
    error_one_cell,
    measure_means,
    0,
    {3, 0.3}};
