/* SPDX-License-Identifier: MIT
 *
 * Claims, what is read to judge them, and what they come to. Belongs to claims.c. */
#ifndef TESTS_REPORT_CLAIMS_VERDICT_H
#define TESTS_REPORT_CLAIMS_VERDICT_H

#include "claims.h"

/* What is read. */
typedef struct claims_tables {
    csv_table *steps, *levels, *lines, *secondary, *error, *means;
} claims_tables;

extern const char claims_exceeded[], claims_reached[], claims_not_reached[];

/* What a claim comes to. */
typedef struct claims_verdict {
    claims_spread ours;
    const char *verdict; /* one of the three */
    char why[800];
} claims_verdict;

typedef struct claims_claim {
    const char *paper, *section, *text;
    double printed_low, printed_high; /* NAN: no figure */
    const char *unit;
    void (*judge)(const claims_tables *tables, const struct claims_claim *claim,
                  claims_verdict *verdict);
} claims_claim;

/* Gains are reached where the middle is enough, and exceeded where even the lower quartile is as
 * large as the most that is printed. Costs the other way round. */
const char *claims_gain_is(claims_spread ours, double enough, double most);
const char *claims_cost_is(claims_spread ours, double most);

/* Adds to the reason; without commas, for it is a cell. */
void claims_say(claims_verdict *verdict, const char *format, ...);

/* The geometric mean of rows. */
typedef struct claims_mean {
    double logarithms, least, most;
    int count;
} claims_mean;

double claims_mean_of(const claims_mean *of);

/* Of a column, in the rows where `where` holds (csv_next()) and the column `known` has a number. */
claims_mean claims_mean_where(const csv_table *table, const char *where, const char *known,
                              const char *column);
double claims_value(const csv_table *table, const char *where, const char *known,
                    const char *column);

/* Of the columns NAME, NAME_low and NAME_high. */
claims_spread claims_spread_where(const csv_table *table, const char *where, const char *known,
                                  const char *name);

#endif
