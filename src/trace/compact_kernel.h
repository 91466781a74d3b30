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

/* Lanes behind the last ray repeat the first, so that they hold ordinary numbers. */
SPTI_INLINE void compact_pad(float *array, size_t remain) {
    const spt_wide first = spt_splat(array[0]);
    for (size_t pad = 0; pad < SPTI_GROUP; pad += SPT_LANES) spt_store(&array[remain + pad], first);
}

SPTI_INLINE void compact_one(float *array, const compact_moves *all) {
    for (size_t move = all->first; move < all->last; ++move) {
        const compact_move to = all->moves[move];
        spti_compress(&array[to.to], spt_load(&array[move * SPT_LANES]), to.keep);
    }
    compact_pad(array, all->remain);
}

/* Four arrays at a time, since what is to be kept costs as much as keeping it. */
SPTI_INLINE void compact_four(spti_chunk *chunk, const unsigned char *arrays,
                              const compact_moves *all) {
    float *const a = chunk->array[arrays[0]], *const b = chunk->array[arrays[1]];
    float *const c = chunk->array[arrays[2]], *const d = chunk->array[arrays[3]];
    for (size_t move = all->first; move < all->last; ++move) {
        const size_t from = move * SPT_LANES;
        const compact_move to = all->moves[move];
        spti_compress(&a[to.to], spt_load(&a[from]), to.keep);
        spti_compress(&b[to.to], spt_load(&b[from]), to.keep);
        spti_compress(&c[to.to], spt_load(&c[from]), to.keep);
        spti_compress(&d[to.to], spt_load(&d[from]), to.keep);
    }
    compact_pad(a, all->remain);
    compact_pad(b, all->remain);
    compact_pad(c, all->remain);
    compact_pad(d, all->remain);
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
    for (; i + 4 <= array_count; i += 4) compact_four(chunk, &arrays[i], &all);
    for (; i < array_count; ++i) compact_one(chunk->array[arrays[i]], &all);
    return remain;
}

#endif
