/* SPDX-License-Identifier: MIT
 *
 * What the parts of the driver's bench share: the clock, medians, pictures of rays and the options
 * of a run. Times are process CPU times, since the machine may be busy with other things. */
#ifndef TESTS_BENCH_BENCH_H
#define TESTS_BENCH_BENCH_H

#include <stdio.h>

#include <scenes/scenes.h>

#include "scalar_loop.h"

enum { BENCH_MOST_ROUNDS = 64, BENCH_WIDTHS = 4 };

/* 1, 4, 8, 16. */
extern const int bench_lanes[BENCH_WIDTHS];

typedef struct bench_options {
    int width, height;             /* of the pictures that are raced */
    int small_width, small_height; /* of those whose evaluations are counted */
    int rounds;                    /* odd, so that there is a middle one */
    double slice_seconds;          /* what the slowest runner is given in a round */
    const char *output;            /* folder of the tables */
} bench_options;

/* Process CPU time. */
double bench_seconds(void);

/* The middle one of count values, count odd; sorts them. */
double bench_median(double *values, int count);

/* A picture's rays, in an order of tiles in which every run of them is spread over the picture. */
typedef struct bench_picture {
    spt_ray *rays;
    size_t count;
    float pixel_radius;
} bench_picture;

bench_picture bench_picture_of(const scene *shown, int width, int height);
void bench_picture_free(bench_picture *picture);

/* A run of rays for round number `round`. */
size_t bench_slice_start(const bench_picture *picture, size_t slice, int round);

const spt_method *bench_method(const char *name);
spt_settings bench_settings(const char *method, float pixel_radius, int lanes);

/* The view of results that a race writes: t, residual, outcome and evaluations. */
spt_hits bench_hits_of(bench_hit *hits);

/* Opens the table `name` in the output folder and writes its header; ends the program where that
 * fails. */
FILE *bench_open(const bench_options *options, const char *name, const char *header);

/* The parts. Each writes a table and prints it; the first returns whether all results agreed. */
int bench_race(const bench_options *options);
void bench_overhead(const bench_options *options);
void bench_evaluations(const bench_options *options);

#endif
