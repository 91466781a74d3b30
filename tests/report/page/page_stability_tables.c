/* SPDX-License-Identifier: MIT
 *
 * Tables of the section on stability. */
#include <stdio.h>
#include <string.h>

#include "page_stability.h"

enum { most_rules = 8 };

static void names_with_bars(char *columns, size_t size, const char *first, const char *const *names,
                            int count) {
    size_t used = (size_t)snprintf(columns, size, "%s", first);
    for (int i = 0; i < count && used < size; ++i)
        used += (size_t)snprintf(columns + used, size - used, "|%s", names[i]);
}

/* Where a rule first fails, or leaves most rays open: none fails where nothing is answered. */
static void trust_cell(page *out, const csv_table *trust, int row, const char *kind) {
    if (row < 0) {
        page_cell(out, "quiet", "not run");
        return;
    }
    const int fails = csv_text(trust, row, "first_failing")[0] != '\0';
    const int open = csv_text(trust, row, "undecided_from")[0] != '\0';
    if (!fails && !open) {
        page_cell(out, "good", "none");
        return;
    }
    page_cell_begin(out, fails ? kind : "warn");
    if (fails) page_number(out, trust, row, "first_failing", "");
    if (fails && open) page_words(out, ", ");
    if (open) {
        page_words(out, "undecided from ");
        page_number(out, trust, row, "undecided_from", "");
    }
    page_cell_end(out);
}

static void trust_table(page *out, const csv_table *trust, const char *bound, const char *caption) {
    const char *rules[most_rules];
    const int count = csv_distinct(trust, "method", rules, most_rules);
    char columns[256];
    const int bounds = bound[0] == '1';
    names_with_bars(columns, sizeof columns, bounds ? "Family" : "Family|Parameter", rules, count);
    page_table(out, caption, columns);
    for (int i = 0; i < stability_name_count; ++i) {
        const stability_name *const called = &stability_names[i];
        if (strcmp(called->bound, bound) != 0 ||
            csv_next(trust, -1, "family=%s,bound=%s", called->family, bound) < 0) {
            continue;
        }
        page_row(out);
        page_cell(out, NULL, "%s", called->title);
        if (!bounds) page_cell(out, "quiet", "%s", called->axis);
        for (int rule = 0; rule < count; ++rule) {
            trust_cell(out, trust,
                       csv_next(trust, -1, "family=%s,bound=%s,method=%s", called->family, bound,
                                rules[rule]),
                       bounds ? "bad" : "warn");
        }
    }
    page_table_end(out);
    page_source(out, "trust");
}

void stability_trust_tables(page *out) {
    csv_table *const trust = csv_open(out->tables, "trust");
    trust_table(
        out, trust, "0",
        "Where each step rule stops being trustworthy in fields that are no distance "
        "bounds: the first value of the parameter at which a ray is wrong, lost or a ghost; "
        "*undecided from*: where more than half of the clear rays get no answer (budget or NaN)");
    page_fold(out, "The same for the families that are distance bounds");
    trust_table(out, trust, "1",
                "In families that are distance bounds: the first value at which a ray is wrong, "
                "lost or a ghost; *undecided from*: where more than half of the clear rays get no "
                "answer, so that little is left to fail");
    page_fold_end(out);
    csv_close(trust);
}

/* The first value at which the default fails, and what the flag says there and just before. */
void stability_audit_table(page *out) {
    csv_table *const audit = csv_open(out->tables, "stability_audit");
    page_table(out,
               "What the audit (`SPT_FLAG_STEEP`) says of fields that are no distance bounds, "
               "with the default rule",
               "Family|Rays|Flagged at the most harmless value|First failing value|Failing "
               "there|Flagged of these|Failing at the extreme|Flagged of these");
    for (int i = 0; i < stability_name_count; ++i) {
        const stability_name *const called = &stability_names[i];
        int first = -1, failing = -1, last = -1;
        if (strcmp(called->bound, "0") != 0) continue;
        for (int row = -1;
             (row = csv_next(audit, row, "family=%s,method=adaptive", called->family)) >= 0;) {
            if (first < 0) first = row;
            if (failing < 0 && csv_number(audit, row, "failing") > 0) failing = row;
            last = row;
        }
        if (first < 0) continue;
        page_row(out);
        page_cell(out, NULL, "%s", called->title);
        page_cell_number(out, "quiet", audit, first, "rays", "");
        page_cell_number(out, NULL, audit, first, "flagged", "");
        if (failing < 0) {
            page_cell(out, "good", "none");
            page_cell(out, "quiet", "");
            page_cell(out, "quiet", "");
        } else {
            page_cell_number(out, NULL, audit, failing, "value", "");
            page_cell_number(out, "warn", audit, failing, "failing", "");
            page_cell_number(out, NULL, audit, failing, "failing_flagged", "");
        }
        page_cell_number(out, NULL, audit, last, "failing", "");
        page_cell_number(out, NULL, audit, last, "failing_flagged", "");
    }
    page_table_end(out);
    page_source(out, "stability_audit");
    csv_close(audit);
}

void stability_planes_table(page *out) {
    csv_table *const planes = csv_open(out->tables, "planes");
    const char *rules[most_rules], *distances[16];
    const int count = csv_distinct(planes, "method", rules, most_rules);
    const int rows = csv_distinct(planes, "distance", distances, 16);
    char columns[256];
    names_with_bars(columns, sizeof columns, "Distance|Rays|Largest error of the default", rules,
                    count);
    page_table(
        out,
        "Planes far away, `budget 256`, planes and rays at random within `60` degrees of the "
        "normal: rays missed, rays out of budget; and how far hits of the default are from "
        "the plane, in tolerances, of which positions in float32 explain up to `1.625`",
        columns);
    for (int i = 0; i < rows; ++i) {
        const int first = csv_next(planes, -1, "distance=%s", distances[i]);
        page_row(out);
        page_cell_number(out, NULL, planes, first, "distance", "%.0e");
        page_cell_number(out, "quiet", planes, first, "rays", "");
        page_cell_number(out, NULL, planes,
                         csv_next(planes, -1, "distance=%s,method=adaptive", distances[i]),
                         "largest_error_over_tolerance", "%.2f");
        for (int rule = 0; rule < count; ++rule) {
            const int row =
                csv_next(planes, -1, "distance=%s,method=%s", distances[i], rules[rule]);
            page_cell_begin(out, csv_number(planes, row, "missed") > 0 ? "bad" : "good");
            page_number(out, planes, row, "missed", "");
            page_words(out, ", ");
            page_number(out, planes, row, "undecided", "");
            page_cell_end(out);
        }
    }
    page_table_end(out);
    page_source(out, "planes");
    csv_close(planes);
}

void stability_powers_table(page *out) {
    csv_table *const powers = csv_open(out->tables, "powers_summary");
    page_table(out,
               "Scenes and directions scaled by powers of two: t, residual, candidate, outcome, "
               "flags and counts, compared bit by bit with the unscaled ones",
               "Rule|Rays|Different|The same from two to the|to");
    for (int row = 0; row < csv_rows(powers); ++row) {
        page_row(out);
        page_cell_number(out, NULL, powers, row, "method", "");
        page_cell_number(out, NULL, powers, row, "rays", "");
        page_cell_number(out, csv_number(powers, row, "different") > 0 ? "bad" : "good", powers,
                         row, "different", "");
        page_cell_number(out, NULL, powers, row, "least_exponent", "");
        page_cell_number(out, NULL, powers, row, "largest_exponent", "");
    }
    page_table_end(out);
    page_source(out, "powers_summary");
    csv_close(powers);
}

void stability_family_table(page *out) {
    page_fold(out, "What each family is");
    page_table(out, "The families", "Family|Distance bound|Swept|What it is");
    for (int i = 0; i < stability_name_count; ++i) {
        const stability_name *const called = &stability_names[i];
        page_row(out);
        page_cell(out, NULL, "%s", called->title);
        page_cell(out, called->bound[0] == '1' ? "good" : "warn",
                  called->bound[0] == '1' ? "yes" : "no");
        page_cell(out, "quiet", "%s", called->axis);
        page_cell(out, NULL, "%s", called->words);
    }
    page_table_end(out);
    page_fold_end(out);
}
