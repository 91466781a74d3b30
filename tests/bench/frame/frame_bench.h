/* SPDX-License-Identifier: MIT
 *
 * The parts of the bench of whole frames, and THE LIST of what frames are to reach. */
#ifndef TESTS_BENCH_FRAME_BENCH_H
#define TESTS_BENCH_FRAME_BENCH_H

#include <stdio.h>

#include "frame_picture.h"

/* X(scene, times the scalar loop with cones at 8 and at 16 lanes, with culling and cones at 8 and
 * at 16 lanes). 0: none; FRAME_NO_LOSS: as fast as without cones. The scenes are of those that have
 * a scalar loop (bench_scenes.h). */
#define FRAME_NO_LOSS (-1)
#define FRAME_SCENES(X) \
    X(primitives, 18, 22, 70, 85) \
    X(mandelbulb, 13, 20, 0, 0) \
    X(dodecahedron, FRAME_NO_LOSS, FRAME_NO_LOSS, 0, 0) \
    X(dodecahedron_p32, 13, 19, 0, 0) \
    X(village, 18, 25, 180, 220) \
    X(krs_tree_16, 15, 26, 0, 0) \
    X(krs_tree_28, 13, 19, 0, 0)

/* Races frames against the scalar loop and writes the rows of frame.csv. Returns whether all
 * results agreed. */
int frame_race(const bench_options *options, FILE *file);

/* Two threads with a common work counter trace a whole frame with culling and cones. Medians, but
 * for the first: what else runs on the machine takes one of the threads its turn, and can only make
 * the division less even. */
typedef struct frame_threads_result {
    double share;        /* sum of the threads' CPU times over the largest, in the best round: 2 is
                          * an even division */
    double median_share; /* the same in the middle one */
    double cost;         /* that sum over the time of one thread alone */
    double wall;         /* wall time of one thread over that of two */
    double largest;      /* the largest CPU time, seconds */
    size_t different;    /* results that are not as expected */
} frame_threads_result;

frame_threads_result frame_threads(const bench_options *options, const frame_picture *picture,
                                   const frame_way *way, const char *rule,
                                   const bench_hit *expected);

/* Counts evaluations with and without cones, for all scenes; writes cones.csv. */
void frame_cones(const bench_options *options);

/* One row of frame.csv. */
typedef struct frame_row {
    const char *scene;
    int lanes, cones, culling, threads;
    double ratio, evaluations;
    size_t flips;
    const char *rule;
    size_t components;
    double whole_ratio, nanoseconds;
    size_t own_flips; /* against frames of the same components without cones and culling */
} frame_row;

void frame_write_row(FILE *file, const frame_row *row);

#endif
