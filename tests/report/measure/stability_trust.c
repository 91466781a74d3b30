/* SPDX-License-Identifier: MIT
 *
 * trust.csv and trust_summary.csv, from stability.csv: up to which value of a family's parameter
 * each step rule can be trusted, and how that sums up over the families. */
#include <math.h>
#include <string.h>

#include "../csv.h"
#include "../report.h"

/* The rows of one family, which follow one another. */
typedef struct family_rows {
    int first, end;
} family_rows;

static int same_family(const csv_table *table, int row, int other) {
    return strcmp(csv_text(table, row, "family"), csv_text(table, other, "family")) == 0 &&
           strcmp(csv_text(table, row, "bound"), csv_text(table, other, "bound")) == 0;
}

static family_rows next_family(const csv_table *table, int first) {
    family_rows family = {first, first};
    while (family.end < csv_rows(table) && same_family(table, family.end, first)) ++family.end;
    return family;
}

static int is_rule(const csv_table *table, int row, const char *rule) {
    return strcmp(csv_text(table, row, "method"), rule) == 0;
}

static double failures(const csv_table *table, int row) {
    return csv_number(table, row, "wrong") + csv_number(table, row, "lost") +
           csv_number(table, row, "ghosts");
}

/* Where more than half of the rays that have an answer got none, that nothing is wrong says little. */
static int is_undecided(const csv_table *table, int row) {
    const double clear =
        csv_number(table, row, "clear_hits") + csv_number(table, row, "clear_misses");
    return 2 * csv_number(table, row, "clear_undecided") > clear;
}

/* What a rule came to over all values of a family. */
typedef struct verdict {
    int rows;
    const char *from, *to, *failing, *undecided; /* values, "": none */
    double wrong, lost, ghosts;
} verdict;

static verdict judge(const csv_table *table, family_rows family, const char *rule) {
    verdict sum = {0, "", "", "", "", 0, 0, 0};
    for (int row = family.first; row < family.end; ++row) {
        if (!is_rule(table, row, rule)) continue;
        const char *const value = csv_text(table, row, "value");
        sum.wrong += csv_number(table, row, "wrong");
        sum.lost += csv_number(table, row, "lost");
        sum.ghosts += csv_number(table, row, "ghosts");
        if (failures(table, row) > 0 && sum.failing[0] == '\0') sum.failing = value;
        if (is_undecided(table, row) && sum.undecided[0] == '\0') sum.undecided = value;
        if (sum.failing[0] == '\0' && sum.undecided[0] == '\0') {
            if (sum.rows == 0) sum.from = value;
            sum.to = value;
        }
        ++sum.rows;
    }
    return sum;
}

static int one(const report_options *options) {
    (void)options;
    return 1;
}

static void measure_trust(const report_options *options, int cell, FILE *rows) {
    csv_table *const table = csv_open(options->output, "stability");
    (void)cell;
    for (int row = 0; row < csv_rows(table);) {
        const family_rows family = next_family(table, row);
        for (int rule = 0; rule < report_rules; ++rule) {
            const verdict sum = judge(table, family, report_rule[rule]);
            if (sum.rows == 0) continue;
            fprintf(rows, "%s,%s,%s,%s,%s,%s,%s,%.9g,%.9g,%.9g\n", csv_text(table, row, "family"),
                    csv_text(table, row, "bound"), report_rule[rule], sum.from, sum.to, sum.failing,
                    sum.undecided, sum.wrong, sum.lost, sum.ghosts);
        }
        row = family.end;
    }
    csv_close(table);
}

static void measure_summary(const report_options *options, int rule, FILE *rows) {
    csv_table *const table = csv_open(options->output, "stability");
    int families = 0, trusted = 0, half = 0;
    double lost = 0, undecided = 0, rays = 0;
    for (int row = 0; row < csv_rows(table);) {
        const family_rows family = next_family(table, row);
        const verdict sum = judge(table, family, report_rule[rule]);
        families += sum.rows > 0;
        if (sum.rows > 0 && sum.failing[0] == '\0') {
            *(sum.undecided[0] == '\0' ? &trusted : &half) += 1;
        }
        if (strcmp(csv_text(table, row, "bound"), "1") == 0) lost += sum.lost;
        for (; row < family.end; ++row) {
            if (!is_rule(table, row, report_rule[rule])) continue;
            undecided += csv_number(table, row, "undecided");
            rays += csv_number(table, row, "rays");
        }
    }
    fprintf(rows, "%s,%d,%d,%d,%.9g,%.9g\n", report_rule[rule], families, trusted, half, lost,
            undecided / fmax(rays, 1));
    csv_close(table);
}

static int each_rule(const report_options *options) {
    (void)options;
    return report_rules;
}

/* from, to: where nothing was wrong, lost or a ghost, and at least half of what there was to decide
 * was decided, from the harmless end; undecided_from: where it first was not; wrong, lost, ghosts:
 * over all values. */
const report_part report_trust = {"trust",
                                  "family,bound,method,trusted_from,trusted_to,first_failing,"
                                  "undecided_from,wrong,lost,ghosts",
                                  one,
                                  measure_trust,
                                  0,
                                  {0.1, 0.1}};

/* trusted: families that are so to the end; half: those without a failing ray that are undecided
 * from some value on; undecided_share: of all rays of the families that the rule traces. */
const report_part report_trust_summary = {"trust_summary",
                                          "method,families,trusted,half_undecided,lost_on_bounds,"
                                          "undecided_share",
                                          each_rule,
                                          measure_summary,
                                          0,
                                          {0.1, 0.1}};
