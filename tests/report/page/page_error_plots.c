/* SPDX-License-Identifier: MIT
 *
 * Plots of the section on error, in pairs: by evaluations, which are exact, and by time. */
#include <stdio.h>
#include <string.h>

#include "page_error.h"

static const char *const costs[error_costs] = {"evaluations", "time"};

void error_pair_begin(error_pair *pair, const char *title) {
    memset(pair, 0, sizeof *pair);
    for (int cost = 0; cost < error_costs; ++cost) {
        plot *const drawn = &pair->drawn[cost];
        drawn->title = title;
        drawn->width = 500;
        drawn->height = 380;
        drawn->x.logarithmic = drawn->y.logarithmic = 1;
    }
    error_pair_titles(pair, "evaluations a ray", "processor time a ray, ns",
                      "RMS error of t, world units", "RMS error of t, world units");
}

void error_pair_titles(error_pair *pair, const char *x_evaluations, const char *x_time,
                       const char *y_evaluations, const char *y_time) {
    pair->drawn[ERROR_EVALUATIONS].x.title = x_evaluations;
    pair->drawn[ERROR_TIME].x.title = x_time;
    pair->drawn[ERROR_EVALUATIONS].y.title = y_evaluations;
    pair->drawn[ERROR_TIME].y.title = y_time;
}

void error_pair_add(error_pair *pair, const csv_table *table, const char *where, const char *name,
                    const char *const x[error_costs], const char *const y[error_costs],
                    plot_style style) {
    for (int cost = 0; cost < error_costs; ++cost) {
        plot *const drawn = &pair->drawn[cost];
        double *const at = pair->x[cost][drawn->series_count];
        double *const value = pair->y[cost][drawn->series_count];
        const int count = csv_points(table, where, x[cost], y[cost], at, value, error_most_points);
        if (count > 0) plot_add(drawn, name, style, count, at, value);
    }
}

void error_pair_figure(page *out, const error_pair *pair, const char *name) {
    char file[error_costs][96];
    const char *names[error_costs];
    for (int cost = 0; cost < error_costs; ++cost) {
        snprintf(file[cost], sizeof file[cost], "%s_%s", name, costs[cost]);
        names[cost] = file[cost];
    }
    page_figures(out, names, pair->drawn, error_costs);
}
