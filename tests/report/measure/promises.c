/* SPDX-License-Identifier: MIT
 *
 * promises.csv: what the library promises, and whether the tables of this run keep it. Exact ones
 * are counts that do not depend on the machine or on what else it does. */
#include "../csv.h"
#include "../report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct promise_sheet {
    FILE *rows;
    const char *table; /* that is looked at */
    csv_table *open;
} promise_sheet;

static void look_at(promise_sheet *sheet, const report_options *options, const char *table) {
    if (sheet->open != NULL) csv_close(sheet->open);
    sheet->open = csv_open(options->output, table);
    sheet->table = table;
}

/* seen: NAN where nothing was measured, which keeps and breaks nothing. */
static void promise(const promise_sheet *sheet, const char *words, double seen, const char *how,
                    double limit, int exact) {
    fprintf(sheet->rows, "%s,", words);
    if (!isnan(seen)) fprintf(sheet->rows, "%.9g", seen);
    fprintf(sheet->rows, ",%s %.9g,", how, limit);
    if (!isnan(seen)) {
        fputc((strcmp(how, "at least") == 0 ? seen >= limit : seen <= limit) ? '1' : '0',
              sheet->rows);
    }
    fprintf(sheet->rows, ",%d,%s\n", exact, sheet->table);
}

/* The sum of a column over the rows where `where` holds ("": over all); NAN of none. */
static double sum_of(const promise_sheet *sheet, const char *column, const char *where) {
    double sum = 0;
    int count = 0;
    for (int row = csv_next(sheet->open, -1, "%s", where); row >= 0;
         row = csv_next(sheet->open, row, "%s", where)) {
        const double value = csv_number(sheet->open, row, column);
        if (isnan(value)) continue;
        sum += value;
        ++count;
    }
    return count > 0 ? sum : (double)NAN;
}

/* How many rows there are, of whose column all that is there is 0 or 1. */
static double rows_without(const promise_sheet *sheet, const char *column) {
    return csv_rows(sheet->open) - sum_of(sheet, column, "");
}

static double value_where(const promise_sheet *sheet, const char *column, const char *where) {
    const int row = csv_next(sheet->open, -1, "%s", where);
    report_expect(row >= 0, "a promise finds no row");
    return csv_number(sheet->open, row, column);
}

static void from_error(promise_sheet *sheet, const report_options *options) {
    look_at(sheet, options, "front_summary");
    promise(sheet,
            "the default is on the Pareto front of error and evaluations in so many scenes of ten",
            value_where(sheet, "on_front", "schedule=direct,cost=evaluations,method=adaptive"),
            "at least", 8, 1);
    promise(sheet, "the default is on the Pareto front of error and time in so many scenes of ten",
            value_where(sheet, "on_front", "schedule=direct,cost=nanoseconds,method=adaptive"),
            "at least", 8, 0);
}

static void from_stability(promise_sheet *sheet, const report_options *options) {
    look_at(sheet, options, "stability");
    promise(sheet, "rays that the default loses in fields that are distance bounds",
            sum_of(sheet, "lost", "bound=1,method=adaptive"), "at most", 0, 1);
    promise(sheet, "rays that any step rule loses in fields that are distance bounds",
            sum_of(sheet, "lost", "bound=1"), "at most", 0, 1);
    promise(sheet, "wrong hits of any step rule in fields that are distance bounds",
            sum_of(sheet, "wrong", "bound=1"), "at most", 0, 1);
    promise(sheet, "hits of any step rule where nothing is in fields that are distance bounds",
            sum_of(sheet, "ghosts", "bound=1"), "at most", 0, 1);
    promise(sheet, "NaN in results but for the echoed residual", sum_of(sheet, "bad_nan", ""),
            "at most", 0, 1);
    promise(sheet, "hits beyond the tolerance of fields that are distance bounds",
            sum_of(sheet, "bad_residual", "bound=1"), "at most", 0, 1);
    promise(sheet, "rays with more evaluations than their budget", sum_of(sheet, "bad_budget", ""),
            "at most", 0, 1);
    look_at(sheet, options, "planes");
    promise(sheet, "planes at a distance of 1e2 to 1e8 that are missed or not decided",
            sum_of(sheet, "missed", "") + sum_of(sheet, "undecided", ""), "at most", 0, 1);
    look_at(sheet, options, "powers");
    promise(sheet, "results that change when all is scaled by a power of two",
            sum_of(sheet, "different", ""), "at most", 0, 1);
}

static void from_accuracy(promise_sheet *sheet, const report_options *options) {
    double beyond = 0;
    int promised_rows = 0;
    look_at(sheet, options, "accuracy");
    for (int row = 0; row < csv_rows(sheet->open); ++row) {
        const double promised = csv_number(sheet->open, row, "promised");
        if (isnan(promised)) continue;
        beyond += !(csv_number(sheet->open, row, "error_100") <= promised);
        ++promised_rows;
    }
    promise(sheet, "parts whose error is larger than their header promises",
            promised_rows > 0 ? beyond : (double)NAN, "at most", 0, 1);
}

static void from_the_rest(promise_sheet *sheet, const report_options *options) {
    look_at(sheet, options, "sizes");
    promise(sheet, "bytes of library code in the smallest program",
            value_where(sheet, "text_bytes", "program=minimal"), "at most", 40960, 0);
    look_at(sheet, options, "instructions");
    promise(sheet, "kernels in which what is off leaves an instruction",
            rows_without(sheet, "identical"), "at most", 0, 1);
    look_at(sheet, options, "defaults");
    promise(sheet, "defaults of the headers that the sweeps do not choose",
            rows_without(sheet, "agrees"), "at most", 0, !options->quick);
    look_at(sheet, options, "claims");
    double reached = 0;
    for (int row = 0; row < csv_rows(sheet->open); ++row) {
        reached += strcmp(csv_text(sheet->open, row, "verdict"), "not reached") != 0;
    }
    promise(sheet, "claims of the papers that are reached or exceeded of ten", reached, "at least",
            8, 0);
}

static int one(const report_options *options) {
    (void)options;
    return 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    promise_sheet sheet = {rows, NULL, NULL};
    (void)cell;
    from_error(&sheet, options);
    from_stability(&sheet, options);
    from_accuracy(&sheet, options);
    from_the_rest(&sheet, options);
    csv_close(sheet.open);
}

const report_part report_promises = {
    "promises", "promise,seen,required,kept,exact,table", one, measure, 0, {0.01, 0.01}};
