/* SPDX-License-Identifier: MIT
 *
 * Reading the tables of the report. A table or a column that is not there, or a row with too few
 * cells, ends the program with a line that says so. */
#ifndef TESTS_REPORT_CSV_H
#define TESTS_REPORT_CSV_H

typedef struct csv_table csv_table;

/* Reads NAME.csv of a folder. */
csv_table *csv_open(const char *folder, const char *name);
void csv_close(csv_table *table); /* NULL: nothing to do */

/* Whether there is one, for what may do without. */
int csv_exists(const char *folder, const char *name);

const char *csv_name(const csv_table *table);
int csv_rows(const csv_table *table);

/* A cell. csv_number: NAN where it is empty; what is no number ends the program. */
const char *csv_text(const csv_table *table, int row, const char *column);
double csv_number(const csv_table *table, int row, const char *column);

/* The first row behind `row` (-1: from the top) whose cells are as `where` says, a printf-style
 * text like "scene=%s,budget=%d" (at most 8 pairs, each cell compared as text; "": every row); -1:
 * none. */
int csv_next(const csv_table *table, int row, const char *where, ...);

/* The different texts of a column in order of first appearance, at most `most`; returns how many. */
int csv_distinct(const csv_table *table, const char *column, const char **texts, int most);

/* The numbers of two columns in the rows where `where` holds (as csv_next, but no arguments; rows
 * with either empty are left out), at most `most`; returns how many. */
int csv_points(const csv_table *table, const char *where, const char *x_column,
               const char *y_column, double *x, double *y, int most);

#endif
