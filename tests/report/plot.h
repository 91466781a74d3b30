/* SPDX-License-Identifier: MIT
 *
 * Plots as SVG: axes with ticks and titles, grid, legend, lines with markers, bars; no scripts, no
 * fonts of their own, readable on a telephone and by people who do not see all colours (markers and
 * dashes differ, too). What they mean stands in the caption, which belongs to the page. In texts
 * 10^-4 stands high. */
#ifndef TESTS_REPORT_PLOT_H
#define TESTS_REPORT_PLOT_H

#include <stdio.h>

enum { plot_most_series = 24, plot_most_marks = 8 };

typedef struct plot_axis {
    const char *title; /* with its unit */
    int logarithmic;
    double low, high; /* both 0: from the data and the marks */
    /* Names of the places 0, 1, 2 .. instead of numbers (bars, categories), or NULL. */
    const char *const *names;
    int name_count;
} plot_axis;

typedef enum plot_style { PLOT_LINE, PLOT_DASHED, PLOT_POINTS, PLOT_BARS } plot_style;

/* A line, points, or bars (x: the place on an axis with names; several series stand beside each
 * other). Values that are not finite, or not positive on a logarithmic axis, break the line; bars
 * without a value are left out. low, high: ends of a vertical error bar for each point, or NULL. */
typedef struct plot_series {
    const char *name; /* in the legend; NULL: not in it */
    plot_style style;
    int look; /* colour and marker, plot_look_of() */
    int count;
    const double *x, *y, *low, *high;
} plot_series;

/* A straight line across the plot at a value, with words: a limit, a default, a paper's figure. */
typedef struct plot_mark {
    int vertical; /* at x, else at y */
    double at;
    const char *words;
} plot_mark;

typedef struct plot {
    const char *title;
    plot_axis x, y;
    int width, height; /* 0: 560 x 380; the legend comes below that. Width below 450: small */
    int series_count, mark_count;
    plot_series series[plot_most_series];
    plot_mark marks[plot_most_marks];
} plot;

/* Writes one <svg> element with a viewBox. Two plots of one page may have the same content. */
void plot_svg(FILE *file, const plot *drawn);

/* The look that a name has on the whole page: step rules (basic .. convex), controls and other
 * names each have their own, stable from run to run; unknown names take turns. */
int plot_look_of(const char *name);

/* Adds a series; returns it for what else is to be set. */
plot_series *plot_add(plot *drawn, const char *name, plot_style style, int count, const double *x,
                      const double *y);
void plot_add_mark(plot *drawn, int vertical, double at, const char *words);

#endif
