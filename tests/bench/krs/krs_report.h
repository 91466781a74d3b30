/* SPDX-License-Identifier: MIT
 *
 * What the cases came to at all numbers of levels, and what is said of it. */
#ifndef TESTS_BENCH_KRS_REPORT_H
#define TESTS_BENCH_KRS_REPORT_H

#include "krs_bench.h"

typedef struct krs_table {
    int rounds;
    uint32_t levels[KRS_NUMBERS];
    krs_result results[KRS_NUMBERS][krs_cases];
    double bound_over_binary[KRS_NUMBERS][2]; /* basic, adaptive: evaluations on rays that hit */
} krs_table;

void krs_print_heading(const bench_options *options);

/* The rows of one number of levels. */
void krs_write_levels(const krs_table *table, int number, const bench_options *options, FILE *file);

void krs_print_goals(const krs_table *table);

/* Whether no sampled ray of any case overlooked a surface. */
int krs_nothing_lost(const krs_table *table);

#endif
