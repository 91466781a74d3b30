/* SPDX-License-Identifier: MIT
 *
 * The rows of error.csv, for the tables that are made from them. */
#ifndef TESTS_REPORT_ERROR_POINTS_H
#define TESTS_REPORT_ERROR_POINTS_H

#include "../csv.h"
#include "../report.h"

/* A row; texts are those of the table. */
typedef struct error_point {
    const char *scene, *schedule, *method, *budget;
    double nanoseconds, noise, evaluations, rms;
} error_point;

enum { error_most_names = 32, error_most_budgets = 16 };

/* All of them, and the names that occur, in order of first appearance. */
typedef struct error_points {
    csv_table *table;
    int count, scenes, schedules, methods, budgets;
    error_point *point;
    const char *scene[error_most_names], *schedule[error_most_names], *method[error_most_names];
    const char *budget[error_most_budgets];
} error_points;

error_points *error_points_of(const report_options *options);
void error_points_free(error_points *points);

/* The one of these names, or NULL. */
const error_point *error_point_at(const error_points *points, const char *shown,
                                  const char *schedule, const char *method, const char *budget);

/* Error against cost, by budget. */
enum { ERROR_COST_TIME, ERROR_COST_EVALUATIONS, error_costs };
typedef struct error_curve {
    double cost[error_costs][error_most_budgets], rms[error_most_budgets];
    int count;
} error_curve;
error_curve error_curve_of(const error_points *points, const char *shown, const char *schedule,
                           const char *method);

/* What it costs to come to an error: between two budgets as a power of the error. NAN: the least
 * budget is better than that already, or the largest is not. */
double error_cost_at(const error_curve *of, int cost, double error);

/* Whether two are the same work, to the last evaluation: a rule with two budgets that both let all
 * rays end. */
int error_twins(const error_point *a, const error_point *b);
/* Less time, by more than the noise of both. */
int error_faster(const error_point *a, const error_point *b);

int error_is_control(const char *schedule);
/* One of the ten kinds. */
int error_is_kind(const char *shown);

/* The paper's measure, error times time, and error times evaluations. */
double error_time_of(const error_point *point);
double error_evaluations_of(const error_point *point);

/* A comma and a number, empty where it is none; and a part of one cell. */
void error_write(FILE *rows, double number);
int error_one_cell(const report_options *options);

/* A geometric mean at work; what is not a positive number is left out. */
typedef struct error_mean {
    double logarithms;
    int count;
} error_mean;
void error_mean_add(error_mean *mean, double value);
double error_mean_of(const error_mean *mean);

#endif
