/* SPDX-License-Identifier: MIT
 *
 * Races of a call with something switched on against the same call without: times as ratios, and
 * how they spread. What is switched is left_out_features.c's and left_out_queries.c's. */
#ifndef TESTS_REPORT_LEFT_OUT_RACE_H
#define TESTS_REPORT_LEFT_OUT_RACE_H

#include "../report.h"

enum { left_out_most_runners = 24, left_out_slice = 4096 /* rays */ };

/* Does its work for a slice of rays that begins at `start`. */
typedef void left_out_run(const void *work, size_t start);

/* One side of a race. */
typedef struct left_out_runner {
    const char *feature, *kind; /* NULL: others are compared to it, and it to none */
    int against;                /* the runner it is compared to */
    left_out_run *run;
    const void *work;
} left_out_runner;

typedef struct left_out_field {
    const char *scene, *method;
    size_t rays; /* of a picture; slices begin at multiples of left_out_slice in it */
    int count;
    left_out_runner runners[left_out_most_runners];
} left_out_field;

void left_out_enter(left_out_field *field, const char *feature, const char *kind, int against,
                    left_out_run *run, const void *work);

/* Lets all run in turns, round by round, and writes a row for each feature: the median of its time
 * over that of what it is compared to in the same round, and the quartiles. */
void left_out_race(const report_options *options, const left_out_field *field, FILE *rows);

/* The cells of features.csv that left_out_queries.c measures. */
extern const int left_out_query_cells;
void left_out_measure_query(const report_options *options, int cell, FILE *rows);

#endif
