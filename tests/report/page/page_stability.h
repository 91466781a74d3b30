/* SPDX-License-Identifier: MIT
 *
 * What the files of the section on stability share: what families are called, and the small plots
 * over their parameters. */
#ifndef TESTS_REPORT_PAGE_STABILITY_H
#define TESTS_REPORT_PAGE_STABILITY_H

#include "../page.h"

/* A family of stability.csv as the page calls it. */
typedef struct stability_name {
    const char *family, *bound; /* as in the table */
    const char *title;
    const char *axis;  /* the parameter */
    const char *words; /* what it is */
} stability_name;

extern const stability_name stability_names[];
extern const int stability_name_count;

const stability_name *stability_name_of(const char *family, const char *bound);

/* What a small plot shows of a row, NAN: nothing. */
typedef double stability_measure(const csv_table *table, int row);

/* In per cent of the rays: wrong, lost and ghosts together; out of budget; ended by NaN. */
stability_measure stability_failing, stability_undecided, stability_nonfinite;
/* Evaluations that 99 of 100 rays keep to. */
stability_measure stability_evaluations;

/* One of several small plots. */
typedef struct stability_panel {
    const char *family, *bound;
    stability_measure *measure;
} stability_panel;

/* Begins a figure of small plots, a line for each step rule, logarithmic where what is measured are
 * evaluations. name: of the files, with a number behind it. */
void stability_panels(page *out, const csv_table *table, const char *name,
                      const stability_panel *panels, int count);

/* The same for the loops of stability_loops.csv, with the default beside them. */
void stability_loop_panels(page *out, const csv_table *loops, const csv_table *table,
                           const char *const *families, int count);

/* The tables of the section. */
void stability_trust_tables(page *out);
void stability_audit_table(page *out);
void stability_planes_table(page *out);
void stability_powers_table(page *out);
void stability_family_table(page *out);

#endif
