/* SPDX-License-Identifier: MIT
 *
 * What the files of the chapter on defaults share: plots of several lines, and its second half. */
#ifndef TESTS_REPORT_PAGE_CHOOSING_H
#define TESTS_REPORT_PAGE_CHOOSING_H

#include "../page.h"

enum { choosing_most_lines = 12, choosing_most_points = 32 };

/* A plot, and room for its lines: its series point there, so that it must not be moved. */
typedef struct choosing_plot {
    plot drawn;
    int lines;
    double x[choosing_most_lines][choosing_most_points];
    double y[choosing_most_lines][choosing_most_points];
    double low[choosing_most_lines][choosing_most_points];
    double high[choosing_most_lines][choosing_most_points];
} choosing_plot;

void choosing_plot_begin(choosing_plot *one, const char *title, const char *x, const char *y);

/* Adds two columns of the rows where `where` holds; name: in the legend, and its look. Returns the
 * line's number, or -1 where there are no such rows. */
int choosing_line(choosing_plot *to, const csv_table *table, const char *where, const char *x,
                  const char *y, const char *name);

/* The row of sweep_mean.csv of a step rule with the header's numbers. */
int choosing_method_row(const csv_table *means, const char *method);

/* The questions that two of the papers leave open. */
void choosing_rearming(page *out);
void choosing_binary(page *out);

#endif
