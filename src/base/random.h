/* SPDX-License-Identifier: MIT
 *
 * Random numbers for sampled checks; the caller keeps the state. */
#ifndef SPTI_RANDOM_H
#define SPTI_RANDOM_H

#include <stdint.h>

/* PCG-RXS-M-XS (O'Neill 2014). */
static inline uint32_t spti_draw(uint32_t *state) {
    const uint32_t before = *state;
    const uint32_t word = ((before >> ((before >> 28) + 4)) ^ before) * 277803737u;
    *state = before * 747796405u + 2891336453u;
    return (word >> 22) ^ word;
}

/* In [0, 1). */
static inline float spti_draw_share(uint32_t *state) {
    return (float)(spti_draw(state) >> 8) * 0x1p-24f;
}

#endif
