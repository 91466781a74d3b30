/* SPDX-License-Identifier: MIT
 *
 * Times the loops of peak_lanes.c. */
#include "peak.h"

#include <stddef.h>

#include "bench.h"
#include "peak_loops.h"

#if defined(SCENE_ONLY_SCALAR)
#define LOOPS(name) \
    { name##_1, NULL, NULL, NULL }
#elif defined(SCENE_NO_AVX2)
#define LOOPS(name) \
    { name##_1, name##_4, NULL, NULL }
#elif defined(SCENE_NO_AVX512)
#define LOOPS(name) \
    { name##_1, name##_4, name##_8, NULL }
#else
#define LOOPS(name) \
    { name##_1, name##_4, name##_8, name##_16 }
#endif

/* Vectors a nanosecond: the best of several, since whatever disturbs only slows down. */
static double fastest(peak_loop_fn *loop) {
    const long turns = 100000;
    double best = 0;
    if (loop == NULL) return 0;
    for (int round = 0; round < 9; ++round) {
        const double start = bench_seconds();
        volatile float sink = loop(turns);
        const double seconds = bench_seconds() - start;
        const double rate = (double)turns * PEAK_CHAINS / (seconds * 1e9);
        (void)sink;
        best = rate > best ? rate : best;
    }
    return best;
}

peak peak_of(int lanes) {
    static peak_loop_fn *const flop_loops[4] = LOOPS(peak_flop_loop);
    static peak_loop_fn *const root_loops[4] = LOOPS(peak_root_loop);
    const int width = lanes >= 16 ? 3 : lanes >= 8 ? 2 : lanes >= 4 ? 1 : 0;
    peak limit;
    limit.flop = 2 * lanes * fastest(flop_loops[width]);
    limit.divider = lanes * fastest(root_loops[width]);
    return limit;
}
