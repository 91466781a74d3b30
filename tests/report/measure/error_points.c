/* SPDX-License-Identifier: MIT
 *
 * Reading error.csv for the tables that are made from it. */
#include "error_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

error_points *error_points_of(const report_options *options) {
    error_points *const points = report_allocate(sizeof *points);
    csv_table *const table = csv_open(options->output, "error");
    points->table = table;
    points->count = csv_rows(table);
    points->point = report_allocate((size_t)points->count * sizeof *points->point);
    for (int row = 0; row < points->count; ++row) {
        error_point *const point = &points->point[row];
        point->scene = csv_text(table, row, "scene");
        point->schedule = csv_text(table, row, "schedule");
        point->method = csv_text(table, row, "method");
        point->budget = csv_text(table, row, "budget");
        point->nanoseconds = csv_number(table, row, "nanoseconds");
        point->noise = csv_number(table, row, "noise");
        point->evaluations = csv_number(table, row, "evaluations");
        point->rms = csv_number(table, row, "rms");
    }
    points->scenes = csv_distinct(table, "scene", points->scene, error_most_names);
    points->schedules = csv_distinct(table, "schedule", points->schedule, error_most_names);
    points->methods = csv_distinct(table, "method", points->method, error_most_names);
    points->budgets = csv_distinct(table, "budget", points->budget, error_most_budgets);
    return points;
}

void error_points_free(error_points *points) {
    csv_close(points->table);
    free(points->point);
    free(points);
}

const error_point *error_point_at(const error_points *points, const char *shown,
                                  const char *schedule, const char *method, const char *budget) {
    for (int i = 0; i < points->count; ++i) {
        const error_point *const point = &points->point[i];
        if (strcmp(point->budget, budget) == 0 && strcmp(point->method, method) == 0 &&
            strcmp(point->schedule, schedule) == 0 && strcmp(point->scene, shown) == 0) {
            return point;
        }
    }
    return NULL;
}

error_curve error_curve_of(const error_points *points, const char *shown, const char *schedule,
                           const char *method) {
    error_curve of;
    of.count = 0;
    for (int i = 0; i < points->budgets; ++i) {
        const error_point *const point =
            error_point_at(points, shown, schedule, method, points->budget[i]);
        if (point == NULL || isnan(point->rms)) continue;
        of.cost[ERROR_COST_TIME][of.count] = point->nanoseconds;
        of.cost[ERROR_COST_EVALUATIONS][of.count] = point->evaluations;
        of.rms[of.count++] = point->rms;
    }
    return of;
}

double error_cost_at(const error_curve *of, int cost, double error) {
    int i = 0;
    while (i < of->count && of->rms[i] > error) ++i;
    if (i == 0 || i == of->count) return (double)NAN;
    const double before = log(of->rms[i - 1]), after = log(of->rms[i]);
    const double share = (before - log(error)) / (before - after);
    return exp(log(of->cost[cost][i - 1]) +
               share * (log(of->cost[cost][i]) - log(of->cost[cost][i - 1])));
}

int error_twins(const error_point *a, const error_point *b) {
    return !(a->evaluations < b->evaluations) && !(b->evaluations < a->evaluations) &&
           !(a->rms < b->rms) && !(b->rms < a->rms) && strcmp(a->method, b->method) == 0 &&
           strcmp(a->schedule, b->schedule) == 0 && strcmp(a->scene, b->scene) == 0;
}

int error_faster(const error_point *a, const error_point *b) {
    return a->nanoseconds * (1 + a->noise) < b->nanoseconds * (1 - b->noise);
}

int error_is_control(const char *schedule) {
    return strcmp(schedule, "control") == 0;
}

int error_is_kind(const char *shown) {
    for (int i = 0; i < report_kinds; ++i) {
        if (strcmp(report_scenes[i], shown) == 0) return 1;
    }
    return 0;
}

double error_time_of(const error_point *point) {
    return point->rms * point->nanoseconds;
}

double error_evaluations_of(const error_point *point) {
    return point->rms * point->evaluations;
}

void error_write(FILE *rows, double number) {
    if (isfinite(number)) {
        fprintf(rows, ",%.9g", number);
    } else {
        fputc(',', rows);
    }
}

int error_one_cell(const report_options *options) {
    (void)options;
    return 1;
}

void error_mean_add(error_mean *mean, double value) {
    if (!(value > 0 && value < HUGE_VAL)) return;
    mean->logarithms += log(value);
    ++mean->count;
}

double error_mean_of(const error_mean *mean) {
    return mean->count > 0 ? exp(mean->logarithms / mean->count) : (double)NAN;
}
