/* SPDX-License-Identifier: MIT
 *
 * What the parts about the papers' claims share: rounds and their quartiles, and the ways to do the
 * same work that Keinert et al. 2014 compare. Left out: verdicts, which are claims.c's. */
#ifndef TESTS_REPORT_CLAIMS_H
#define TESTS_REPORT_CLAIMS_H

#include "../../bench/keinert/keinert_bench.h"
#include "../csv.h"
#include "../report.h"

/* The quartiles of rounds, or of cases. */
typedef struct claims_spread {
    double low, middle, high;
} claims_spread;

/* Sorts the values. */
claims_spread claims_spread_of(double *values, int count);

/* Half the distance between the quartiles, relative to the middle. */
double claims_noise(claims_spread spread);

/* Of the seconds that rounds took. */
claims_spread claims_seconds(const double *seconds, int rounds);

/* Of the rounds' ratios: how many times as fast as `other` the first one is. */
claims_spread claims_faster(const double *seconds, const double *other, int rounds);

/* Numbers of a row, a comma before each; empty where NAN. */
void claims_write(FILE *rows, double number);
void claims_write_spread(FILE *rows, claims_spread spread); /* middle, low, high */

extern const claims_spread claims_unknown;

/* Nanoseconds of an evaluation, in full batches. */
double claims_field_cost(const spt_field *field);

/* ---- Claims 1 and 2: step rules and convex bodies ------------------------------------------- */

enum { claims_most_ways = 6, claims_most_rounds = 15 };

/* A way to do the work of a case. */
typedef struct claims_way {
    const char *name;   /* in the table */
    const char *method; /* of the library */
    float relaxation;
    int convex;  /* rays inside the body by spt_trace_convex() */
    int licence; /* the field keeps its SPT_FIELD_CONVEX */
    int against; /* the way that it is compared with */
} claims_way;

/* What a way came to. All rounds do the same work. */
typedef struct claims_result {
    double seconds[claims_most_rounds];
    double rays, evaluations; /* of a round */
} claims_result;

typedef struct claims_case claims_case;

/* What an evaluation costs: with the callbacks that are built for the library's width, or without
 * vectors; asked so many times instead of once. */
typedef struct claims_callback {
    int scalar, times;
} claims_callback;

/* Lets all ways of a case take turns and fills in their results. The kinds of cases: rays of the
 * eye; whole frames with mirrors and glass, and the library's part of them; paths. */
typedef void claims_measure_fn(const report_options *options, const claims_case *measured,
                               claims_callback callback, int rounds, claims_result *results);
claims_measure_fn claims_cast, claims_frames, claims_glass, claims_paths;

struct claims_case {
    int claim;
    const char *name;  /* in the table */
    const char *scene; /* of scenes.h or glass_world.h */
    double printed;    /* how many times as fast in the paper, section 4; NAN: not there */
    const claims_way *ways;
    int number; /* of ways */
    claims_measure_fn *measure;
};

/* Makes the callbacks of a scene, or of a field, ask their own so many times. Only one scene at a
 * time; memory lives as long as the field. */
typedef struct claims_repeated {
    spt_distance_batch_fn *batch;
    void *user;
    int times;
} claims_repeated;

void claims_repeat_scene(scene *shown, claims_callback callback);
void claims_repeat_field(spt_field *field, int times, claims_repeated *memory);

/* Lets ways take turns, user by user, and fills in the seconds. */
void claims_race(const claims_case *measured, void *const *users, keinert_run_fn *run, int rounds,
                 claims_result *results);

#endif
