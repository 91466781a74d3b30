/* SPDX-License-Identifier: MIT
 *
 * The first section of the page: what there is to know in a minute. */
#include <stdio.h>
#include <string.h>

#include "page_error.h"

enum { most_rules = 8 };

static void number_of(page *out, const csv_table *summary, const char *what, const char *column,
                      const char *format) {
    page_number(out, summary, csv_next(summary, -1, "what=%s", what), column, format);
}

static void in_words(page *out, const csv_table *summary) {
    page_begin(out);
    page_words(out, "libspheretrace traces rays against signed distance fields that are given as "
                    "callbacks. This page shows what it costs, how far its results can be trusted "
                    "and where they cannot, and what a scene leaves out. ");
    page_words(out, out->quick
                        ? "It was drawn from a *quick* run: small pictures and few rounds, so "
                          "that times are rough; counts are exact."
                        : "It was drawn from a full run.");
    page_end(out);
    page_begin(out);
    page_words(out, "*Promises.* ");
    number_of(out, summary, "promises_kept", "value", "");
    page_words(out, " of ");
    number_of(out, summary, "promises", "value", "");
    page_words(out, " are kept by this run; the table below has them all.");
    page_end(out);
    page_begin(out);
    page_words(out, "*The papers' claims.* Of ");
    number_of(out, summary, "claims", "value", "");
    page_words(out, ", ");
    number_of(out, summary, "claims_exceeded", "value", "");
    page_words(out, " are exceeded and ");
    number_of(out, summary, "claims_reached", "value", "");
    page_words(out, " reached; each has its row in the section on claims, with the reason where it "
                    "is not.");
    page_end(out);
}

/* What other ways cost, as multiples of the default's. */
static void costs(page *out, const csv_table *summary) {
    static const struct {
        const char *what, *way, *cost, *against;
    } rows[] = {
        {"basic_evaluations", "basic", "evaluations", "`adaptive`"},
        {"basic_nanoseconds", "basic", "time", "`adaptive`"},
        {"basic_frame_evaluations", "basic", "evaluations", "`adaptive` in `spt_frame_trace`"},
        {"basic_frame_nanoseconds", "basic", "time", "`adaptive` in `spt_frame_trace`"},
        {"plain_nanoseconds", "basic in a plain loop", "time", "`basic`"},
    };
    page_table(
        out,
        "What basic sphere tracing costs, as a multiple of the default step rule `adaptive`, "
        "alone or in tiles with cones; and what a plain loop costs, as a multiple of the "
        "library's `basic`, the same rule: one point a call, callbacks without vectors, no bound. "
        "With a budget that lets nearly all rays end; the geometric mean over ten kinds of scene, "
        "and the scenes with the least and the most.",
        "what|its|against|mean|least|most");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        const int row = csv_next(summary, -1, "what=%s", rows[i].what);
        page_row(out);
        page_cell(out, NULL, "%s", rows[i].way);
        page_cell(out, NULL, "%s", rows[i].cost);
        page_cell(out, NULL, "%s", rows[i].against);
        page_cell_number(out, NULL, summary, row, "value", "%.2fx");
        page_cell_number(out, NULL, summary, row, "low", "%.2fx");
        page_cell_number(out, NULL, summary, row, "high", "%.2fx");
    }
    page_table_end(out);
    page_source(out, "summary");
}

static void figure(page *out) {
    static const char *const cost[error_costs] = {"evaluations", "nanoseconds"};
    static const char *const reached[error_costs] = {"rms", "rms"};
    const char *rules[most_rules];
    error_pair pair;
    csv_table *const error = csv_open(out->tables, "error");
    const int direct = csv_next(error, -1, "scene=smooth_union,schedule=direct");
    int count = 0;
    for (int row = direct; row >= 0 && count < most_rules;
         row = csv_next(error, row, "scene=smooth_union,schedule=direct,budget=%s",
                        csv_text(error, direct, "budget"))) {
        rules[count++] = csv_text(error, row, "method");
    }
    error_pair_begin(&pair, "smooth_union");
    for (int i = 0; i < count; ++i) {
        char where[128];
        snprintf(where, sizeof where, "scene=smooth_union,schedule=direct,method=%s", rules[i]);
        error_pair_add(&pair, error, where, rules[i], cost, reached, PLOT_LINE);
    }
    error_pair_figure(out, &pair, "summary_error");
    page_words(out,
               "What a budget of evaluations buys, by step rule, on a smooth union of shapes, a "
               "cheap field: *left* by evaluations, *right* by processor time, in which a rule's "
               "own work counts. Each point is a budget; lower and further left is better. The "
               "section on error has all scenes. ");
    page_source(out, "error");
    page_figure_end(out);
    csv_close(error);
}

static void promises(page *out) {
    csv_table *const table = csv_open(out->tables, "promises");
    page_table(out,
               "What the library promises, and what this run saw. Those that are exact "
               "come out the same whenever this build runs; the others depend on the compiler, "
               "the machine and what else it does, or on times.",
               "promise|seen|required|kept|exact|table");
    for (int row = 0; row < csv_rows(table); ++row) {
        const int kept = strcmp(csv_text(table, row, "kept"), "1") == 0;
        const int measured = csv_text(table, row, "kept")[0] != '\0';
        const int exact = strcmp(csv_text(table, row, "exact"), "1") == 0;
        page_row(out);
        page_cell_number(out, NULL, table, row, "promise", "");
        page_cell_number(out, NULL, table, row, "seen", "%.6g");
        page_cell_number(out, NULL, table, row, "required", "");
        page_cell(out,
                  !measured ? "quiet"
                  : kept    ? "good"
                  : exact   ? "bad"
                            : "warn",
                  !measured ? "not measured"
                  : kept    ? "kept"
                            : "not kept");
        page_cell(out, NULL, exact ? "yes" : "no");
        page_cell_begin(out, NULL);
        page_source(out, csv_text(table, row, "table"));
        page_cell_end(out);
    }
    page_table_end(out);
    page_source(out, "promises");
    csv_close(table);
}

void page_summary(page *out) {
    csv_table *const summary = csv_open(out->tables, "summary");
    page_section(out, "summary", "In a minute");
    in_words(out, summary);
    costs(out, summary);
    figure(out);
    promises(out);
    csv_close(summary);
}
