/* SPDX-License-Identifier: MIT
 *
 * Tables of the section on error. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page_error.h"

enum { most_names = 32, most_columns = 2048 };

/* Names as the head of a table. */
static void head_of(char *columns, const char *first, const char *const *names, int count) {
    snprintf(columns, most_columns, "%s", first);
    for (int i = 0; i < count; ++i) {
        const size_t length = strlen(columns);
        snprintf(columns + length, most_columns - length, "|%s", names[i]);
    }
}

/* ---- Fronts --------------------------------------------------------------------------------- */

static void front_cell(page *out, const csv_table *front, int row, const char *column) {
    if (row < 0) {
        page_cell(out, "quiet", "no licence");
    } else {
        const int some = csv_number(front, row, column) > 0;
        page_cell_number(out, some ? "good" : "quiet", front, row, column, "");
    }
}

/* How many points of each rule are on the front of each scene; at last, of how many of the ten
 * kinds it is on the front. Rules that take no part have no column. */
static void front_table(page *out, const csv_table *front, const csv_table *summary,
                        const char *caption, const char *schedule, const char *cost,
                        const char *column) {
    const char *scenes[most_names], *methods[most_names];
    char columns[most_columns];
    int sums[most_names], method_number = 0;
    const int scene_number = csv_distinct(front, "scene", scenes, most_names);
    for (int row = -1;
         (row = csv_next(summary, row, "schedule=%s,cost=%s", schedule, cost)) >= 0;) {
        if (isnan(csv_number(summary, row, column)) || method_number == most_names) continue;
        sums[method_number] = row;
        methods[method_number++] = csv_text(summary, row, "method");
    }
    head_of(columns, "scene", methods, method_number);
    page_table(out, caption, columns);
    for (int i = 0; i < scene_number; ++i) {
        page_row(out);
        page_cell(out, NULL, "`%s`", scenes[i]);
        for (int k = 0; k < method_number; ++k) {
            const int row = csv_next(front, -1, "scene=%s,schedule=%s,cost=%s,method=%s", scenes[i],
                                     schedule, cost, methods[k]);
            front_cell(out, front, row, column);
        }
    }
    page_row(out);
    page_cell(out, NULL, "*of the ten kinds*");
    for (int k = 0; k < method_number; ++k) {
        page_cell_number(out, NULL, summary, sums[k], column, "");
    }
    page_table_end(out);
}

static void both_costs(page *out, const csv_table *front, const csv_table *summary,
                       const char *schedule, const char *column) {
    front_table(out, front, summary,
                "By evaluations: budgets with which a rule is on the front of the scene.", schedule,
                "evaluations", column);
    front_table(out, front, summary,
                "By time: the same, where times within each other's noise count as equal.",
                schedule, "nanoseconds", column);
}

static void front_words(page *out, const csv_table *summary, const char *method, const char *cost) {
    const int row = csv_next(summary, -1, "schedule=direct,cost=%s,method=%s", cost, method);
    if (row < 0) return;
    page_number(out, summary, row, "on_front", "");
    page_words(out, " of ");
    page_number(out, summary, row, "scenes", "");
}

void error_fronts(page *out, const csv_table *front, const csv_table *summary) {
    page_heading(out, "Who is on the Pareto front");
    page_begin(out);
    page_words(out,
               "A point, a rule with a budget, is on the front of its scene where no other has a "
               "smaller error at no more cost, or less cost at no larger error. By evaluations the "
               "default, `adaptive`, has such a point in ");
    front_words(out, summary, "adaptive", "evaluations");
    page_words(out, " kinds of scene, `enhanced` in ");
    front_words(out, summary, "enhanced", "evaluations");
    page_words(out, "; by time `adaptive` in ");
    front_words(out, summary, "adaptive", "nanoseconds");
    page_words(out, " and `enhanced` in ");
    front_words(out, summary, "enhanced", "nanoseconds");
    page_words(out,
               ". The two differ where a field is cheap: a step of `adaptive`, which remembers "
               "probes that failed, costs more than one of `enhanced`, and what it saves is "
               "evaluations.");
    page_end(out);
    both_costs(out, front, summary, "direct", "on_front");
    page_source(out, "front");
    page_source(out, "front_summary");
    page_fold(out, "With `convex` in the comparison, which needs a licence");
    page_begin(out);
    page_words(out, "Where a field is a convex function the secant step is in front of all others, "
                    "and leaves them no place but at the least cost.");
    page_end(out);
    both_costs(out, front, summary, "direct", "on_front_with_convex");
    page_fold_end(out);
    page_fold(out, "The fronts of whole frames, with cones");
    both_costs(out, front, summary, "frame", "on_front");
    page_fold_end(out);
}

/* ---- What goes wrong ------------------------------------------------------------------------ */

static void wrong_cell(page *out, const csv_table *error, int row, const char *column,
                       const char *kind) {
    page_cell_number(out, csv_number(error, row, column) > 0 ? kind : "quiet", error, row, column,
                     "");
}

static void wrong_row(page *out, const csv_table *error, int row) {
    page_row(out);
    page_cell(out, NULL, "`%s`", csv_text(error, row, "method"));
    page_cell(out, NULL, "`%s`", csv_text(error, row, "schedule"));
    page_cell_number(out, NULL, error, row, "nanoseconds", "%.0f");
    page_cell_number(out, NULL, error, row, "evaluations", "%.3g");
    page_cell_number(out, NULL, error, row, "rms", "%.2g");
    page_cell_number(out, NULL, error, row, "rms_both", "%.2g");
    page_cell_number(out, NULL, error, row, "iou", "%.4f");
    wrong_cell(out, error, row, "lost", "bad");
    wrong_cell(out, error, row, "late", "bad");
    wrong_cell(out, error, row, "ghosts", "bad");
    wrong_cell(out, error, row, "undecided", "warn");
}

void error_wrongs(page *out, const csv_table *error, const char *shown) {
    static const char *const schedules[] = {"direct", "frame", "control"};
    char caption[256];
    snprintf(caption, sizeof caption, "`%s` with `budget 64`.", shown);
    page_table(
        out, caption,
        "method|schedule|ns a ray|evaluations|RMS error|where both hit|IoU of hits|lost|late|"
        "ghosts|undecided");
    for (int i = 0; i < 3; ++i) {
        for (int row = csv_next(error, -1, "scene=%s,schedule=%s,budget=64", shown, schedules[i]);
             row >= 0;
             row = csv_next(error, row, "scene=%s,schedule=%s,budget=64", shown, schedules[i])) {
            wrong_row(out, error, row);
        }
    }
    page_table_end(out);
}

/* ---- Products ------------------------------------------------------------------------------- */

static void product_table(page *out, const csv_table *best, const char *caption,
                          const char *column) {
    const char *scenes[most_names], *methods[most_names], *rules[most_names];
    char columns[most_columns];
    int rule_number = 0;
    const int scene_number = csv_distinct(best, "scene", scenes, most_names);
    const int method_number = csv_distinct(best, "method", methods, most_names);
    for (int i = 0; i < method_number; ++i) {
        const int ours = csv_next(best, -1, "schedule=direct,method=%s", methods[i]) >= 0;
        if (ours) rules[rule_number++] = methods[i];
    }
    head_of(columns, "scene", rules, rule_number);
    page_table(out, caption, columns);
    for (int i = 0; i < scene_number; ++i) {
        page_row(out);
        page_cell(out, NULL, "`%s`", scenes[i]);
        for (int k = 0; k < rule_number; ++k) {
            const int row =
                csv_next(best, -1, "scene=%s,schedule=direct,method=%s", scenes[i], rules[k]);
            if (row < 0) page_cell(out, "quiet", "no licence");
            if (row >= 0) page_cell_number(out, NULL, best, row, column, "%.2f");
        }
    }
    page_table_end(out);
}

void error_products(page *out, const csv_table *best) {
    page_fold(out, "The least product of error and cost, over all budgets");
    page_begin(out);
    page_words(out, "How many times as small as that of `basic` the least product of a rule is. It "
                    "is reached with budgets at which nearly all rays are done, where the error is "
                    "that of the stop and differs little: what remains is the cost.");
    page_end(out);
    product_table(out, best, "Error times evaluations, `basic` over the rule.",
                  "error_evaluations_over_basic");
    product_table(out, best, "Error times time, `basic` over the rule.", "error_time_over_basic");
    page_source(out, "error_best");
    page_fold_end(out);
}
