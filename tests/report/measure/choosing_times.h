/* SPDX-License-Identifier: MIT
 *
 * Contenders that are timed in turns: ratios of their times to those of one of them, round by
 * round. Left out: what they do. */
#ifndef TESTS_REPORT_CHOOSING_TIMES_H
#define TESTS_REPORT_CHOOSING_TIMES_H

#include "../report.h"

enum { choosing_most_contenders = 8 };

typedef void choosing_run_fn(void *user, int contender);

/* By contender. */
typedef struct choosing_times {
    double seconds[choosing_most_contenders]; /* medians */
    double ratio[choosing_most_contenders];   /* medians of the ratios to contender `first` */
    double noise[choosing_most_contenders];   /* half of what is between the quartiles of those,
                                               * over their median */
} choosing_times;

/* rounds: odd, at most BENCH_MOST_ROUNDS. Runs each once before the first. */
choosing_times choosing_race(int contenders, int first, int rounds, choosing_run_fn *run,
                             void *user);

#endif
