/* SPDX-License-Identifier: MIT
 *
 * The loops of peak_lanes.c by width. The build defines SCENE_NO_AVX2, SCENE_NO_AVX512 or
 * SCENE_ONLY_SCALAR for those that it leaves out. */
#ifndef TESTS_BENCH_PEAK_LOOPS_H
#define TESTS_BENCH_PEAK_LOOPS_H

enum { PEAK_CHAINS = 12 }; /* a turn of a loop: so many vectors, each once */

/* The result is something to compute for. */
typedef float peak_loop_fn(long turns);

extern peak_loop_fn peak_flop_loop_1, peak_root_loop_1;
#ifndef SCENE_ONLY_SCALAR
extern peak_loop_fn peak_flop_loop_4, peak_root_loop_4;
#ifndef SCENE_NO_AVX2
extern peak_loop_fn peak_flop_loop_8, peak_root_loop_8;
#ifndef SCENE_NO_AVX512
extern peak_loop_fn peak_flop_loop_16, peak_root_loop_16;
#endif
#endif
#endif

#endif
