/* SPDX-License-Identifier: MIT
 *
 * The page of the report: one HTML file that runs no scripts and needs no files beside it. Numbers
 * that were measured are written by page_number(), from a cell of a table, as
 *     <data value="TEXT OF THE CELL" title="TABLE.csv, line LINE, COLUMN">ROUNDED</data>
 * (line 1 is the header) so that a reader finds where each comes from, and a test can compare
 * (numbers.sh). Digits elsewhere are those of names, of the papers and of settings; see
 * page_words(). What is written where it does not belong ends the program. */
#ifndef TESTS_REPORT_PAGE_H
#define TESTS_REPORT_PAGE_H

#include <stdio.h>

#include "csv.h"
#include "plot.h"

enum { page_most_sections = 16 };

typedef enum page_place {
    PAGE_BETWEEN,
    PAGE_PARAGRAPH,
    PAGE_CAPTION,
    PAGE_TABLE,
    PAGE_ROW,
    PAGE_CELL
} page_place;

typedef struct page {
    FILE *html;
    const char *tables; /* folder of the tables, and of the page */
    int quick;
    /* What page.c keeps. */
    page_place place;
    int figures, folds, columns, cells; /* columns of the open table, cells of its open row */
    int section_count;
    const char *section_id[page_most_sections], *section_title[page_most_sections];
} page;

/* THE LIST of sections is page_list.h, which also declares them here; each draws itself from the
 * tables. */
typedef void page_section_fn(page *out);
#define SECTION(name) page_section_fn page_##name;
#include "page_list.h"
#undef SECTION

/* Headings. id: a word, the anchor; also in the list at the top. Both texts must stay. */
void page_section(page *out, const char *id, const char *title);
void page_heading(page *out, const char *title);

/* A paragraph: page_begin(), words and numbers, page_end(). Words are a printf-style text in which
 * & < > are escaped; `code` between two backquotes; *word* is emphasised; ^word^ is what a paper
 * says: its figures and its year, with their source. Headings, captions and the cells of tables
 * know the same signs. Digits that stand alone may be in `code` (settings: `1e-4`, `budget 128`),
 * in ^what a paper says^, or behind Figure, section, Algorithm, Listing, Equation, Theorem, Table,
 * level, claim; ordinals (99th), and digits behind a letter or _ (float32, passes_4) are words. All
 * others, also in tables, are page_number()'s. */
void page_begin(page *out);
void page_words(page *out, const char *format, ...);
/* format: "%.2f", "%.3g" and so on, with one number and words or % behind it; "" or NULL: the
 * cell's own text, a number or not. Of an empty cell: a dash. */
void page_number(page *out, const csv_table *table, int row, const char *column,
                 const char *format);
void page_end(page *out);

/* A figure, its number and caption: what it shows, and what to see in it. Inlined, and written as
 * NAME.svg beside the page. The caption is begun by page_figure() and ended by page_figure_end(),
 * words and numbers between. page_figures(): several plots side by side under one caption, two in
 * a row, or three where their width is below 450. */
void page_figure(page *out, const char *name, const plot *drawn);
void page_figures(page *out, const char *const *names, const plot *drawn, int count);
void page_figure_end(page *out);

/* A PNG of the tables' folder, inlined as data:. Ended by page_figure_end(). */
void page_picture(page *out, const char *file, const char *alternative);

/* A table: page_table(), then for each row page_row() and its cells, at last page_table_end().
 * columns: names with | between. kind of a cell: NULL or one of "good" "bad" "warn" "quiet", which
 * also shows without colour. page_cell_begin() and page_cell_end(): words and numbers between. */
void page_table(page *out, const char *caption, const char *columns);
void page_row(page *out);
void page_cell(page *out, const char *kind, const char *format, ...);
void page_cell_number(page *out, const char *kind, const csv_table *table, int row,
                      const char *column, const char *format);
void page_cell_begin(page *out, const char *kind);
void page_cell_end(page *out);
void page_table_end(page *out);

/* Long tables fold away: what is written between is shown when the words are clicked. */
void page_fold(page *out, const char *words);
void page_fold_end(page *out);

/* "From NAME.csv." with a link, for a figure or table whose numbers are drawn: in a caption, in a
 * paragraph, or as a line of its own; in a cell the link alone. */
void page_source(page *out, const char *name);

/* The end of the last section. */
void page_finish(page *out);

#endif
