/* SPDX-License-Identifier: MIT
 *
 * The two loops whose speed is the limit at one width: chains that do not wait for one another.
 * Compiled once for each width, with SPT_LANES and its flags, as the scenes are. */
#ifndef SPT_LANES
#define SPT_LANES 1
#endif
#include <spheretrace/simd.h>

#include "peak_loops.h"

#define PASTE_EXPANDED(name, lanes) name##_##lanes
#define PASTE(name, lanes) PASTE_EXPANDED(name, lanes)

float PASTE(peak_flop_loop, SPT_LANES)(long turns) {
    const spt_wide factor = spt_splat(0.75f), term = spt_splat(0.3f);
    spt_wide chain[PEAK_CHAINS], sum = term;
    float lanes[SPT_LANES];
    for (int k = 0; k < PEAK_CHAINS; ++k) chain[k] = spt_splat((float)k);
    for (long turn = 0; turn < turns; ++turn) {
        for (int k = 0; k < PEAK_CHAINS; ++k) chain[k] = spt_add(spt_mul(chain[k], factor), term);
    }
    for (int k = 0; k < PEAK_CHAINS; ++k) sum = spt_add(sum, chain[k]);
    spt_store(lanes, sum);
    return lanes[0];
}

/* The factor keeps the numbers away from 1, whose root might be found sooner. */
float PASTE(peak_root_loop, SPT_LANES)(long turns) {
    const spt_wide factor = spt_splat(2.7182817f);
    spt_wide chain[PEAK_CHAINS], sum = factor;
    float lanes[SPT_LANES];
    for (int k = 0; k < PEAK_CHAINS; ++k) chain[k] = spt_splat((float)k + 1.0f);
    for (long turn = 0; turn < turns; ++turn) {
        for (int k = 0; k < PEAK_CHAINS; ++k) chain[k] = spt_sqrt(spt_mul(chain[k], factor));
    }
    for (int k = 0; k < PEAK_CHAINS; ++k) sum = spt_add(sum, chain[k]);
    spt_store(lanes, sum);
    return lanes[0];
}
