/* SPDX-License-Identifier: MIT
 *
 * Ways to trace a kernel-reflection sequence, and what is made of its hits, raced at each number of
 * levels. Belongs to claims_levels.c. */
#ifndef TESTS_REPORT_CLAIMS_LEVELS_H
#define TESTS_REPORT_CLAIMS_LEVELS_H

#include "../../bench/krs/krs_bench.h"
#include "claims.h"

/* What a way does with the picture's tiles. */
typedef enum level_work {
    LEVEL_TRACE,     /* as krs_bench.h has it */
    LEVEL_UNBOUNDED, /* the same for a field that is kept from knowing its bound: all rays ask it */
    LEVEL_OCCLUSION  /* ambient occlusion at the hits of the way that it is compared with */
} level_work;

/* Ambient occlusion: samples a point, and of how many neighbouring pixels one has it. */
typedef struct level_way {
    const char *name; /* in the table */
    level_work work;
    krs_case traced; /* LEVEL_TRACE */
    int samples, one_of;
    int against; /* the way that it is compared with */
} level_way;

/* One number of levels: its models, pictures and tiles; the same in all rounds. */
typedef struct level_track {
    krs_models models;
    frame_picture *pictures[krs_bodies]; /* NULL: not seen */
    frame_picture parts[krs_bodies];     /* the first tiles of them, as pictures */
    krs_sample samples[krs_bodies];
    bench_hit *hits, *image;            /* by ray, by pixel */
    float *points, *normals, *openness; /* of hits */
    size_t point_count;
    float reach; /* of ambient occlusion */
} level_track;

typedef struct level_runner {
    const level_way *way;
    level_track *track;
    double probe_ratio; /* of binary tracing */
    spt_frame frame;
    spt_statistics statistics;
    double seconds[claims_most_rounds];
} level_runner;

void level_enter(level_runner *runner, const level_way *way, level_track *track);
void level_leave(level_runner *runner);

/* Does it once; returns the seconds that it took. */
double level_run(void *user, int round);

/* What its hits are worth; the way must have run last. */
krs_error level_judge(const level_runner *runner);

/* Finds the points and normals of the hits that were traced last, for ambient occlusion. */
void level_find_points(level_track *track);

#endif
