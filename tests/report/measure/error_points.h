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
