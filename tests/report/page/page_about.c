/* SPDX-License-Identifier: MIT
 *
 * The last section of the page: on what was measured and how, where the tables are, and how to get
 * them again. */
#include <string.h>

#include "../page.h"

/* The tables in the order in which they are measured. */
static const char *const tables[] = {
#define PART(name) #name,
#include "../report_list.h"
#undef PART
    "parts", "machine"};
enum { table_count = sizeof tables / sizeof tables[0] };

static void machine(page *out) {
    csv_table *const table = csv_open(out->tables, "machine");
    page_table(out, "The machine and the compiler. *Lanes* are the rays that one vector holds.",
               "what|value");
    for (int row = 0; row < csv_rows(table); ++row) {
        page_row(out);
        page_cell(out, NULL, "%s", csv_text(table, row, "what"));
        page_cell_begin(out, NULL);
        page_number(out, table, row, "value", "");
        page_cell_end(out);
    }
    page_table_end(out);
    page_source(out, "machine");
    csv_close(table);
}

static void how(page *out) {
    page_heading(out, "Counts, times and truth");
    page_begin(out);
    page_words(out,
               "*Evaluations* of the distance function are counted, and are exact: they are "
               "the same on every machine and at every width of vectors. *Times* are processor "
               "time of the process, not time on the wall, since other programs may run beside "
               "it. Contenders take turns within each round, and what is shown is the median "
               "over the rounds, or the median of the ratios of a round. The spread of the rounds "
               "is drawn as bars or stands in the tables, mostly as a column `noise`; means over "
               "scenes have none. Ratios travel to other machines better than times do.");
    page_end(out);
    page_begin(out);
    page_words(out,
               "*The truth* that results are compared with is never the code under test: it is "
               "an analytic hit, a brute-force search, or the textbook's loop in double "
               "precision with steps to spare. Rays that graze a surface closer than single "
               "precision can tell are not counted as lost.");
    page_end(out);
    page_begin(out);
    page_words(out,
               "*Numbers* on this page come from the tables beside it, unchanged but for "
               "rounding: each names its table, line and column when it is pointed at. What the "
               "papers print is set ^like this^. Figures lie beside the page as SVG files.");
    page_end(out);
}

static void all_tables(page *out) {
    const int timed = csv_exists(out->tables, "parts");
    csv_table *const parts = timed ? csv_open(out->tables, "parts") : NULL;
    page_heading(out, "All tables");
    page_table(out, "The tables, and how long each took.",
               "table|cells|of those from before an interruption|seconds");
    for (int i = 0; i < table_count; ++i) {
        if (!csv_exists(out->tables, tables[i])) continue;
        const int row = parts != NULL ? csv_next(parts, -1, "part=%s", tables[i]) : -1;
        page_row(out);
        page_cell_begin(out, NULL);
        page_source(out, tables[i]);
        page_cell_end(out);
        if (row >= 0) {
            page_cell_number(out, NULL, parts, row, "cells", "%.0f");
            page_cell_number(out, NULL, parts, row, "resumed", "%.0f");
            page_cell_number(out, NULL, parts, row, "seconds", "%.1f");
        } else {
            for (int k = 0; k < 3; ++k) page_cell(out, "quiet", "–");
        }
    }
    page_table_end(out);
    csv_close(parts);
}

void page_about(page *out) {
    page_section(out, "about", "How this was measured");
    machine(out);
    how(out);
    all_tables(out);
    page_heading(out, "To measure again");
    page_begin(out);
    page_words(out,
               "`make report` measures everything and draws this page anew, `make report "
               "REPORT=quick` with smaller pictures and fewer rounds, in minutes. A run that was "
               "interrupted goes on where it was. `report_bench --output FOLDER PART` measures one "
               "table again; tables that are made from it are then out of date until they are "
               "measured again, too, so that a page to be shown to others is best made by a whole "
               "run. `report_page FOLDER` draws the page from the tables as they are.");
    page_end(out);
}
