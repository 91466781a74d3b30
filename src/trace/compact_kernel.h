/* SPDX-License-Identifier: MIT
 *
 * Closes the gaps that finished rays leave, array by array, in order. A template over SPT_LANES.
 * Defines compact_pass(), a spti_compact_fn. */
#ifndef SPTI_COMPACT_KERNEL_H
#define SPTI_COMPACT_KERNEL_H

#include "../lanes/lanes.h"
#include "chunk.h"

/* A vector's survivors and where the first of them goes. */
typedef struct compact_move {
    uint16_t keep, to;
} compact_move;

/* How many of 16 bits are set, without a branch that nobody foresees. */
SPTI_INLINE size_t compact_bits(unsigned bits) {
    bits -= bits >> 1 & 0x5555u;
    bits = (bits & 0x3333u) + (bits >> 2 & 0x3333u);
    bits = (bits + (bits >> 4)) & 0x0f0fu;
    return (bits + (bits >> 8)) & 0x1fu;
}

SPTI_INLINE size_t compact_pass(spti_chunk *chunk, const unsigned char *arrays, size_t array_count,
                                size_t count) {
    compact_move moves[SPT_BATCH / SPT_LANES];
    size_t first = 0, last = 0, remain = 0;
    for (size_t at = 0; at < count; at += SPT_LANES, ++last) {
        const spti_fates *fates = &chunk->fates[at / SPTI_GROUP];
        unsigned keep = ~((unsigned)fates->finished >> at % SPTI_GROUP) & SPTI_EVERY_LANE;
        if (count - at < SPT_LANES) keep &= (1u << (count - at)) - 1u;
        if (keep == SPTI_EVERY_LANE && first == last)
            ++first; /* nothing left before: it stays in place */
        moves[last].keep = (uint16_t)keep;
        moves[last].to = (uint16_t)remain;
        remain += compact_bits(keep);
    }
    if (remain == 0) return 0;
    for (size_t i = 0; i < array_count; ++i) {
        float *const array = chunk->array[arrays[i]];
        for (size_t move = first; move < last; ++move) {
            const spt_wide a = spt_load(&array[move * SPT_LANES]);
            spti_compress(&array[moves[move].to], a, moves[move].keep);
        }
        /* Lanes behind the last ray repeat the first, so that they hold ordinary numbers. */
        for (size_t pad = 0; pad < SPTI_GROUP; pad += SPT_LANES) {
            spt_store(&array[remain + pad], spt_splat(array[0]));
        }
    }
    return remain;
}

#endif
