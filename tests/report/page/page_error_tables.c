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

/* In how many kinds of scene each rule is on the front. */
static void front_words(page *out, const csv_table *summary, const char *cost) {
    int count = 0;
    for (int row = csv_next(summary, -1, "schedule=direct,cost=%s", cost); row >= 0;
         row = csv_next(summary, row, "schedule=direct,cost=%s", cost)) {
        if (isnan(csv_number(summary, row, "on_front"))) continue;
        page_words(out, count++ > 0 ? ", `%s` in " : "`%s` in ", csv_text(summary, row, "method"));
        page_number(out, summary, row, "on_front", "");
    }
}

void error_fronts(page *out, const csv_table *front, const csv_table *summary) {
    page_heading(out, "Who is on the Pareto front");
    page_begin(out);
    page_words(
        out, "A point, a rule with a budget, is on the front of its scene where no other has a "
             "smaller error at no more cost, or less cost at no larger error. Budgets that let all "
             "rays of a rule end are the same work and count as one point. Of ");
    page_number(out, summary, 0, "scenes", "");
    page_words(out, " kinds of scene a rule has such a point, by evaluations, ");
    front_words(out, summary, "evaluations");
    page_words(out, "; by time ");
    front_words(out, summary, "nanoseconds");
    page_words(out, ". Times that noise cannot tell apart put several rules on the same front, and "
                    "a rule may owe its place to an error at the stop that is smaller by next to "
                    "nothing: how much they differ is in the tables of equal error.");
    page_end(out);
    both_costs(out, front, summary, "direct", "on_front");
    page_source(out, "front");
    page_source(out, "front_summary");
    page_fold(out, "With `convex` in the comparison, which needs a licence");
    page_begin(out);
    page_words(out, "Where a field is a convex function the secant step takes part, too; what is "
                    "left of the others are the points that it is not better than.");
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
    const int frame = strcmp(csv_text(error, row, "schedule"), "frame") == 0;
    page_row(out);
    page_cell(out, NULL, frame ? "`%s`, frame" : "`%s`", csv_text(error, row, "method"));
    page_cell_number(out, NULL, error, row, "nanoseconds", "%.0f");
    page_cell_number(out, "quiet", error, row, "noise", "%.2g");
    page_cell_number(out, NULL, error, row, "evaluations", "%.3g");
    page_cell_number(out, NULL, error, row, "rms", "%.2g");
    page_cell_number(out, NULL, error, row, "rms_both", "%.2g");
    page_cell_number(out, NULL, error, row, "iou", "%.3f");
    wrong_cell(out, error, row, "lost", "bad");
    wrong_cell(out, error, row, "late", "bad");
    wrong_cell(out, error, row, "ghosts", "bad");
    wrong_cell(out, error, row, "undecided", "warn");
}

void error_wrongs(page *out, const csv_table *error, const char *shown) {
    static const char *const schedules[] = {"direct", "frame", "control"};
    char caption[256];
    snprintf(caption, sizeof caption, "`%s` with `budget 64`.", shown);
    page_table(out, caption,
               "method|ns a ray|noise|evaluations|RMS error|where both hit|IoU of "
               "hits|lost|late|"
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

/* ---- Equal error ---------------------------------------------------------------------------- */

/* The error that the tables are about; the CSV has others, too. */
#define EQUAL "schedule=direct,error=0.001"

static void equal_table(page *out, const csv_table *equal, const char *caption,
                        const char *column) {
    const char *scenes[most_names], *methods[most_names];
    char columns[most_columns];
    const int scene_number = csv_distinct(equal, "scene", scenes, most_names);
    int method_number = 0;
    for (int row = csv_next(equal, -1, EQUAL ",scene=mean"); row >= 0 && method_number < most_names;
         row = csv_next(equal, row, EQUAL ",scene=mean")) {
        methods[method_number++] = csv_text(equal, row, "method");
    }
    head_of(columns, "scene", methods, method_number);
    page_table(out, caption, columns);
    for (int i = 0; i < scene_number; ++i) {
        const int mean = strcmp(scenes[i], "mean") == 0;
        if (csv_next(equal, -1, EQUAL ",scene=%s", scenes[i]) < 0) continue;
        page_row(out);
        page_cell(out, NULL, mean ? "*geometric mean*" : "`%s`", scenes[i]);
        for (int k = 0; k < method_number; ++k) {
            const int row = csv_next(equal, -1, EQUAL ",scene=%s,method=%s", scenes[i], methods[k]);
            if (row < 0) page_cell(out, "quiet", "-");
            if (row >= 0) page_cell_number(out, NULL, equal, row, column, "%.2f");
        }
    }
    page_table_end(out);
}

static void equal_words(page *out, const csv_table *equal, const char *column) {
    int count = 0;
    for (int row = csv_next(equal, -1, EQUAL ",scene=mean"); row >= 0;
         row = csv_next(equal, row, EQUAL ",scene=mean")) {
        if (strcmp(csv_text(equal, row, "method"), "basic") == 0) continue;
        page_words(out, count++ > 0 ? ", `%s` " : "`%s` ", csv_text(equal, row, "method"));
        page_number(out, equal, row, column, "%.2f");
        page_words(out, " (");
        page_number(out, equal, row, "scenes", "");
        page_words(out, ")");
    }
}

void error_equals(page *out, const csv_table *equal) {
    page_heading(out, "What the same error costs");
    page_begin(out);
    page_words(out, "Single rays, to an RMS error of `1e-3`, as a share of what `basic` takes: "
                    "less is better. Between two budgets the cost is interpolated as a power of "
                    "the error. In the geometric mean (behind it the number of scenes: those of "
                    "the ten kinds in which each rule comes to that error, though not with the "
                    "least budget already), by evaluations ");
    equal_words(out, equal, "evaluations_share");
    page_words(out, "; by time ");
    equal_words(out, equal, "time_share");
    page_words(out, ".");
    page_end(out);
    equal_table(out, equal, "Evaluations, the rule over `basic`.", "evaluations_share");
    equal_table(out, equal, "Time, the rule over `basic`.", "time_share");
    page_source(out, "error_equal");
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
    page_words(out,
               "How many times as small as that of `basic` the least product of a rule is. Where "
               "it is reached with a budget that lets all rays end, the error is that of the "
               "stop, and the ratio is nearly that of the costs.");
    page_end(out);
    product_table(out, best, "Error times evaluations, `basic` over the rule.",
                  "error_evaluations_over_basic");
    product_table(out, best, "Error times time, `basic` over the rule.", "error_time_over_basic");
    page_source(out, "error_best");
    page_fold_end(out);
}
