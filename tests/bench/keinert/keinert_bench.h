/* SPDX-License-Identifier: MIT
 *
 * The parts of the bench that repeats the measurements of Keinert et al. 2014, section 4, and what
 * they share: contenders that take turns, and rows of the table. */
#ifndef TESTS_BENCH_KEINERT_BENCH_H
#define TESTS_BENCH_KEINERT_BENCH_H

#include "../bench.h"

/* One of several ways to do the same work. */
typedef struct keinert_contender {
    const char *name;
    int against;  /* number of the contender that it is compared with */
    double paper; /* times the speed of that one, as the paper has it; 0: not measured there */
    double fewer; /* times fewer evaluations are to be reached; 0: see paper */
    void *user;   /* for the run */
    double seconds[BENCH_MOST_ROUNDS];
} keinert_contender;

/* Does a contender's share of a round, and returns the processor time that it took. */
typedef double keinert_run_fn(void *user, int round);

/* Lets contenders take turns, each round beginning with another one. */
void keinert_race(keinert_contender *contenders, int number, int rounds, keinert_run_fn *run);

/* The middle one of the rounds' ratios: how many times as fast as what it is compared with. */
double keinert_time_ratio(const keinert_contender *contenders, int which, int rounds);

/* Of the rounds, without touching them: bench_median() sorts. */
double keinert_middle_seconds(const keinert_contender *contender, int rounds);

/* The part of `count` things that belongs to a round: all rounds together have every one once. */
typedef struct keinert_part {
    size_t begin, count;
} keinert_part;

keinert_part keinert_part_of(size_t count, int round, int rounds);

/* What a contender came to. NAN: not measured. */
typedef struct keinert_row {
    const char *measure, *scene;
    double rays, evaluations;
    double nanoseconds; /* a ray of the middle round */
    double error;
    double error_of_base;  /* of what it is compared with, by the same measure */
    const char *error_of;  /* what the error is, with its unit */
    double lost, late;     /* rays that overlook a surface: miss it, or hit one behind it */
    double passed;         /* hits within half a pixel of a surface that the ray passes */
    double undecided;      /* rays out of budget */
    double inside_a_ray;   /* evaluations of rays inside glass */
    double of_the_library; /* time ratio of the library's tracing calls alone */
} keinert_row;

/* A row with nothing measured. */
keinert_row keinert_row_of(const char *measure, const char *shown);

/* Writes the rows of contenders to keinert.csv, prints them, and what is to be said of those that
 * the paper measured. */
void keinert_report(FILE *file, const keinert_contender *contenders, const keinert_row *rows,
                    int number, int rounds);

/* Ends the program with a line where the status is not SPT_OK. */
void keinert_expect(spt_status status, const char *what);

/* Zeroed memory; ends the program where there is none. */
void *keinert_allocate(size_t size);

/* The parts. Each prints its table and returns whether all results agreed that must. */
int keinert_cast(const bench_options *options, FILE *file);
int keinert_frames(const bench_options *options, FILE *file);
int keinert_glass(const bench_options *options, FILE *file);
int keinert_paths(const bench_options *options, FILE *file);
int keinert_secondary(const bench_options *options);

#endif
