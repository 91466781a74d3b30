/* SPDX-License-Identifier: MIT
 *
 * What the report measures, as parts: each part fills a table, NAME.csv, cell by cell. The program
 * report_bench runs them, shows how long is left, and goes on where it was interrupted; report_page
 * draws the page from the tables alone. Left out: drawing, see page.h. */
#ifndef TESTS_REPORT_REPORT_H
#define TESTS_REPORT_REPORT_H

#include <stdint.h>
#include <stdio.h>

#include <scenes/scenes.h>

#include "../bench/bench.h"

typedef struct report_options {
    int quick;          /* smaller pictures, fewer rounds: minutes instead of half an hour */
    const char *output; /* folder of the tables */
    const char *build;  /* folder of the build, for parts that run its programs */
} report_options;

/* A part of the report. Its cells are measured in their order, each writes its rows (which end with
 * a newline, one or more of them, cells in the C locale's "%.9g", no quotes, no commas within a
 * cell, empty: not measured). The same options must always give the same number of cells. */
typedef struct report_part {
    const char *name;   /* of the table, without .csv */
    const char *header; /* names of the columns, with commas between, no newline */
    int (*cells)(const report_options *options);
    void (*measure)(const report_options *options, int cell, FILE *rows);
    int timed; /* measures processor time: nothing runs beside its cells. Cells of others run
                        * two at a time, in threads: no static variables */
    double seconds[2]; /* that all cells take together, about, full and quick: for the time left.
                        * Of a part that is not timed: on one core */
} report_part;

/* THE LIST, in the order in which they run; a part may read the tables of those before it. */
extern const report_part *const report_parts[];
extern const int report_part_count;

/* The ten kinds of scene that step rules are judged by, in the order of the published counts, and
 * behind them those of the bench: report_kinds of report_scene_count. */
enum { report_kinds = 10 };
extern const char *const report_scenes[];
extern const int report_scene_count;

/* The step rules by name, the default last but one, spt_convex() last: for scenes with its licence
 * only. */
enum { report_rules = 6 };
extern const char *const report_rule[report_rules];

/* Random numbers of a cell's own. */
typedef struct report_random {
    uint64_t state; /* the seed, any */
} report_random;
uint32_t report_bits(report_random *random);
double report_uniform(report_random *random, double low, double high);

/* Ends the program with a line where `holds` is 0: what must never happen to a measurement. */
void report_expect(int holds, const char *what);
void *report_allocate(size_t size);

/* The value below which a share (0 .. 1) of count > 0 values lies; sorts them. share 1: the
 * largest. */
double report_quantile(double *values, size_t count, double share);

#endif
