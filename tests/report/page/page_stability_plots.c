/* SPDX-License-Identifier: MIT
 *
 * Small plots of the section on stability: a family each, a line for each step rule or loop. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "page_stability.h"

enum { most_panels = 12, most_lines = 6, most_values = 12 };

/* Room for the lines of all panels, and for the names of their files. */
typedef struct panel_sheet {
    plot drawn[most_panels];
    double x[most_panels][most_lines][most_values], y[most_panels][most_lines][most_values];
    char file[most_panels][64];
    const char *names[most_panels];
} panel_sheet;

static panel_sheet *new_sheet(void) {
    panel_sheet *const sheet = calloc(1, sizeof *sheet);
    if (sheet == NULL) {
        fprintf(stderr, "page: out of memory\n");
        exit(1);
    }
    return sheet;
}

static double per_cent(const csv_table *table, int row, double count) {
    return 100 * count / csv_number(table, row, "rays");
}

double stability_failing(const csv_table *table, int row) {
    return per_cent(table, row,
                    csv_number(table, row, "wrong") + csv_number(table, row, "lost") +
                        csv_number(table, row, "ghosts"));
}

double stability_undecided(const csv_table *table, int row) {
    return per_cent(table, row, csv_number(table, row, "undecided"));
}

double stability_nonfinite(const csv_table *table, int row) {
    return per_cent(table, row, csv_number(table, row, "nonfinite"));
}

double stability_evaluations(const csv_table *table, int row) {
    return csv_number(table, row, "evaluations_99");
}

static void begin_panel(panel_sheet *sheet, int panel, const char *name, const char *title,
                        const char *x, stability_measure *measure) {
    plot *const drawn = &sheet->drawn[panel];
    snprintf(sheet->file[panel], sizeof sheet->file[panel], "%s_%d", name, panel + 1);
    sheet->names[panel] = sheet->file[panel];
    drawn->title = title;
    drawn->width = 330;
    drawn->height = 230;
    drawn->x.title = x;
    drawn->x.logarithmic = strcmp(x, "levels") != 0 && strcmp(x, "iterations") != 0;
    drawn->y.logarithmic = measure == stability_evaluations;
    drawn->y.title = measure == stability_evaluations ? "evaluations"
                     : measure == stability_undecided ? "undecided, %"
                     : measure == stability_nonfinite ? "ended by NaN, %"
                                                      : "wrong and lost, %";
    if (drawn->y.logarithmic) {
        drawn->y.low = 1;
        drawn->y.high = 1000;
    }
}

/* The rows where `where` holds, as a line. */
static void add_line(panel_sheet *sheet, int panel, const csv_table *table, const char *where,
                     const char *look, plot_style style, stability_measure *measure) {
    plot *const drawn = &sheet->drawn[panel];
    const int number = drawn->series_count;
    int count = 0;
    for (int row = -1; (row = csv_next(table, row, "%s", where)) >= 0 && count < most_values;) {
        sheet->x[panel][number][count] = csv_number(table, row, "value");
        sheet->y[panel][number][count++] = measure(table, row);
    }
    if (count == 0) return;
    plot_add(drawn, look, style, count, sheet->x[panel][number], sheet->y[panel][number]);
}

/* A share is drawn from zero, and up to something where all are zero. */
static void end_panel(panel_sheet *sheet, int panel) {
    plot *const drawn = &sheet->drawn[panel];
    double largest = 0;
    if (drawn->y.logarithmic) return;
    for (int line = 0; line < drawn->series_count; ++line) {
        for (int i = 0; i < drawn->series[line].count; ++i)
            largest = fmax(largest, drawn->series[line].y[i]);
    }
    drawn->y.high = largest > 0 ? fmin(1.1 * largest, 100) : 1;
}

/* One legend for all: below the last panel, which also names what is drawn in others only. */
static void share_legend(panel_sheet *sheet, int count) {
    plot *const last = &sheet->drawn[count - 1];
    for (int panel = 0; panel < count - 1; ++panel) {
        plot *const drawn = &sheet->drawn[panel];
        for (int line = 0; line < drawn->series_count; ++line) {
            plot_series *const series = &drawn->series[line];
            int named = 0;
            for (int i = 0; i < last->series_count; ++i)
                named |= strcmp(last->series[i].name, series->name) == 0;
            if (!named) plot_add(last, series->name, series->style, 0, series->x, series->y);
            series->name = NULL;
        }
    }
}

void stability_panels(page *out, const csv_table *table, const char *name,
                      const stability_panel *panels, int count) {
    panel_sheet *const sheet = new_sheet();
    const char *rules[most_lines];
    const int rule_count = csv_distinct(table, "method", rules, most_lines);
    for (int panel = 0; panel < count; ++panel) {
        const stability_panel *const shown = &panels[panel];
        const stability_name *const called = stability_name_of(shown->family, shown->bound);
        begin_panel(sheet, panel, name, called->title, called->axis, shown->measure);
        for (int rule = 0; rule < rule_count; ++rule) {
            char where[128];
            snprintf(where, sizeof where, "family=%s,bound=%s,method=%s", shown->family,
                     shown->bound, rules[rule]);
            add_line(sheet, panel, table, where, rules[rule], PLOT_LINE, shown->measure);
        }
        end_panel(sheet, panel);
    }
    share_legend(sheet, count);
    page_figures(out, sheet->names, sheet->drawn, count);
    free(sheet);
}

void stability_loop_panels(page *out, const csv_table *loops, const csv_table *table,
                           const char *const *families, int count) {
    panel_sheet *const sheet = new_sheet();
    const char *names[most_lines];
    const int loop_count = csv_distinct(loops, "loop", names, most_lines - 1);
    for (int panel = 0; panel < count; ++panel) {
        const stability_name *const called = stability_name_of(families[panel], "1");
        char where[128];
        begin_panel(sheet, panel, "stability_loops", called->title, called->axis,
                    stability_failing);
        for (int loop = 0; loop < loop_count; ++loop) {
            snprintf(where, sizeof where, "family=%s,loop=%s", families[panel], names[loop]);
            /* Ends every ray as NaN on its first step: the text says so. */
            if (strcmp(names[loop], "balint_algorithm_3") == 0) continue;
            add_line(sheet, panel, loops, where, names[loop], PLOT_DASHED, stability_failing);
        }
        snprintf(where, sizeof where, "family=%s,bound=1,method=adaptive", families[panel]);
        add_line(sheet, panel, table, where, "adaptive", PLOT_LINE, stability_failing);
        end_panel(sheet, panel);
    }
    share_legend(sheet, count);
    page_figures(out, sheet->names, sheet->drawn, count);
    free(sheet);
}
