/* SPDX-License-Identifier: MIT
 *
 * Lists the rays that finished, and closes the gaps that they leave, array by array, in order. A
 * template over SPT_LANES. Defines list_pass(), a spti_list_fn, and compact_pass(), a
 * spti_compact_fn. */
#ifndef SPTI_COMPACT_KERNEL_H
#define SPTI_COMPACT_KERNEL_H

#include "../lanes/lanes.h"
#include "chunk.h"

/* A vector's survivors and where the first of them goes. */
typedef struct compact_move {
    uint16_t keep, to;
} compact_move;

/* Those of an array, from the first gap on. */
typedef struct compact_moves {
    compact_move moves[SPT_BATCH / SPT_LANES];
    size_t first, last, remain;
} compact_moves;

/* How many of 16 bits are set, without a branch that nobody foresees. */
SPTI_INLINE size_t compact_bits(unsigned bits) {
    bits -= bits >> 1 & 0x5555u;
    bits = (bits & 0x3333u) + (bits >> 2 & 0x3333u);
    bits = (bits + (bits >> 4)) & 0x0f0fu;
    return (bits + (bits >> 8)) & 0x1fu;
}

/* The numbers from a first one on. */
SPTI_INLINE spt_wide compact_numbers(size_t first) {
    static const SPTI_ALIGNED(64) float lanes[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                     8, 9, 10, 11, 12, 13, 14, 15};
    return spt_add(spt_load(lanes), spt_splat((float)(int)first));
}

SPTI_INLINE size_t list_pass(const spti_chunk *chunk, size_t count, uint16_t *slots) {
    SPTI_ALIGNED(64) float numbers[SPTI_ROOM];
    size_t listed = 0;
    for (size_t at = 0; at < count; at += SPT_LANES) {
        const spti_fates *fates = &chunk->fates[at / SPTI_GROUP];
        const unsigned ended = fates->finished & ~(unsigned)fates->bracketed;
        const unsigned keep = ended >> at % SPTI_GROUP & SPTI_EVERY_LANE;
        spti_compress(&numbers[listed], compact_numbers(at), keep);
        listed += compact_bits(keep);
    }
    for (size_t i = 0; i < listed; ++i) slots[i] = (uint16_t)(int)numbers[i];
    return listed;
}

/* A constant number of arrays at a time, since what is to be kept costs as much as keeping it. */
SPTI_INLINE void compact_arrays(spti_chunk *chunk, const unsigned char *arrays, size_t count,
                                const compact_moves *all) {
    float *array[4];
    for (size_t i = 0; i < count; ++i) array[i] = chunk->array[arrays[i]];
    for (size_t move = all->first; move < all->last; ++move) {
        const unsigned keep = all->moves[move].keep, to = all->moves[move].to;
        for (size_t i = 0; i < count; ++i) {
            spti_compress(&array[i][to], spt_load(&array[i][move * SPT_LANES]), keep);
        }
    }
    /* Lanes behind the last ray repeat the first, so that they hold ordinary numbers. */
    for (size_t i = 0; i < count; ++i) {
        for (size_t pad = 0; pad < SPTI_GROUP; pad += SPT_LANES) {
            spt_store(&array[i][all->remain + pad], spt_splat(array[i][0]));
        }
    }
}

SPTI_INLINE size_t compact_pass(spti_chunk *chunk, const unsigned char *arrays, size_t array_count,
                                size_t count) {
    compact_moves all;
    size_t first = 0, last = 0, remain = 0;
    for (size_t at = 0; at < count; at += SPT_LANES, ++last) {
        const spti_fates *fates = &chunk->fates[at / SPTI_GROUP];
        unsigned keep = ~((unsigned)fates->finished >> at % SPTI_GROUP) & SPTI_EVERY_LANE;
        if (count - at < SPT_LANES) keep &= (1u << (count - at)) - 1u;
        if (keep == SPTI_EVERY_LANE && first == last)
            ++first; /* nothing left before: it stays in place */
        all.moves[last].keep = (uint16_t)keep;
        all.moves[last].to = (uint16_t)remain;
        remain += compact_bits(keep);
    }
    if (remain == 0) return 0;
    all.first = first;
    all.last = last;
    all.remain = remain;
    size_t i = 0;
    for (; i + 4 <= array_count; i += 4) compact_arrays(chunk, &arrays[i], 4, &all);
    for (; i < array_count; ++i) compact_arrays(chunk, &arrays[i], 1, &all);
    return remain;
}

#endif
