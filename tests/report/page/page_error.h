/* SPDX-License-Identifier: MIT
 *
 * What the files of the section on error share: its plots, and its tables. */
#ifndef TESTS_REPORT_PAGE_ERROR_H
#define TESTS_REPORT_PAGE_ERROR_H

#include "../page.h"

/* What error is drawn against. */
typedef enum error_cost { ERROR_EVALUATIONS, ERROR_TIME, error_costs } error_cost;

enum { error_most_points = 16 };

/* Two plots side by side, by evaluations and by time, with room for their lines. */
typedef struct error_pair {
    plot drawn[error_costs];
    double x[error_costs][plot_most_series][error_most_points];
    double y[error_costs][plot_most_series][error_most_points];
} error_pair;

/* RMS error against cost, both logarithmic. title: of both, with what the cost is behind it. */
void error_pair_begin(error_pair *pair, const char *title);
void error_pair_titles(error_pair *pair, const char *x_evaluations, const char *x_time,
                       const char *y_evaluations, const char *y_time);

/* A line from the rows where `where` holds; columns by cost. name: in the legend, also its look. */
void error_pair_add(error_pair *pair, const csv_table *table, const char *where, const char *name,
                    const char *const x[error_costs], const char *const y[error_costs],
                    plot_style style);

/* Writes both as the beginning of a figure. name: of their files, with _evaluations and _time
 * behind it. */
void error_pair_figure(page *out, const error_pair *pair, const char *name);

/* The tables: the Pareto fronts; costs at equal error; who does what wrong; the least products of
 * error and cost. */
void error_fronts(page *out, const csv_table *front, const csv_table *summary);
void error_equals(page *out, const csv_table *equal);
void error_wrongs(page *out, const csv_table *error, const char *shown);
void error_products(page *out, const csv_table *best);

#endif
