/* SPDX-License-Identifier: MIT
 *
 * Rounds, medians and quartiles. */
#include "choosing_times.h"

choosing_times choosing_race(int contenders, int first, int rounds, choosing_run_fn *run,
                             void *user) {
    double spent[choosing_most_contenders][BENCH_MOST_ROUNDS];
    double values[BENCH_MOST_ROUNDS];
    choosing_times times;
    for (int i = 0; i < contenders; ++i) run(user, i);
    for (int round = 0; round < rounds; ++round) {
        /* Each round begins with another one. */
        for (int turn = 0; turn < contenders; ++turn) {
            const int contender = (turn + round) % contenders;
            const double begun = bench_seconds();
            run(user, contender);
            spent[contender][round] = bench_seconds() - begun;
        }
    }
    for (int i = 0; i < contenders; ++i) {
        for (int round = 0; round < rounds; ++round) values[round] = spent[i][round];
        times.seconds[i] = bench_median(values, rounds);
        for (int round = 0; round < rounds; ++round) {
            values[round] = spent[i][round] / spent[first][round];
        }
        const double low = report_quantile(values, (size_t)rounds, 0.25);
        const double high = report_quantile(values, (size_t)rounds, 0.75);
        times.ratio[i] = bench_median(values, rounds);
        times.noise[i] = (high - low) / 2 / times.ratio[i];
    }
    return times;
}
