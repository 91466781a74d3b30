/* SPDX-License-Identifier: MIT
 *
 * Writes the results of a union's rays, those that are wanted. */
#include <math.h>

#include "scene_call.h"

/* The results as words: a float, an int32_t or a uint32_t. */
typedef union record_word {
    float real;
    int32_t signed_whole;
    uint32_t whole;
} record_word;

enum {
    T,
    RESIDUAL,
    OUTCOME,
    EVALUATIONS,
    FLAGS,
    COMPONENT,
    CANDIDATE_T,
    CANDIDATE_RATIO,
    FALLBACKS,
    RESULTS
};

/* The sinks that somebody wants. */
typedef struct wanted {
    int result[RESULTS];
    char *base[RESULTS];
    ptrdiff_t stride[RESULTS];
    int count;
} wanted;

static wanted wanted_of(const spt_hits *hits) {
    const spt_sink *const sinks[RESULTS] = {
        &hits->t,           &hits->residual,        &hits->outcome,
        &hits->evaluations, &hits->flags,           &hits->component,
        &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    wanted all;
    all.count = 0;
    for (int result = 0; result < RESULTS; ++result) {
        if (sinks[result]->first == NULL) continue;
        all.result[all.count] = result;
        all.base[all.count] = sinks[result]->first;
        all.stride[all.count++] = sinks[result]->stride;
    }
    return all;
}

SPTI_INLINE float row(const spti_union *lazy, int what, size_t ray) {
    return spti_union_row(lazy, what)[ray];
}

SPTI_INLINE int is_steep(const spti_union *lazy, size_t ray) {
    return lazy->records[ray].steep || spti_is_steep(row(lazy, SPTI_ROW_STEEPEST, ray));
}

/* Without an event the nearest one is at infinity, and so is f there. */
SPTI_INLINE void words_of(const spti_union *lazy, size_t ray, record_word words[RESULTS]) {
    const spti_record *const record = &lazy->records[ray];
    const float unit = row(lazy, SPTI_ROW_UNIT, ray);
    const int there = row(lazy, SPTI_ROW_CANDIDATE_RATIO, ray) < INFINITY;
    const uint32_t steep = is_steep(lazy, ray) ? SPT_FLAG_STEEP : 0u;
    words[T].real = row(lazy, SPTI_ROW_NEAREST, ray) * unit;
    words[RESIDUAL].real = row(lazy, SPTI_ROW_VALUE, ray);
    words[OUTCOME].signed_whole = record->outcome;
    words[EVALUATIONS].real = row(lazy, SPTI_ROW_SPENT, ray); /* bits */
    words[FLAGS].whole = steep | (record->inside ? SPT_FLAG_INSIDE : 0u);
    words[COMPONENT].signed_whole = record->outcome == SPT_HIT ? record->component : -1;
    words[CANDIDATE_T].real = there ? row(lazy, SPTI_ROW_CANDIDATE_T, ray) * unit : INFINITY;
    words[CANDIDATE_RATIO].real = row(lazy, SPTI_ROW_CANDIDATE_RATIO, ray);
    words[FALLBACKS].whole = (uint32_t)row(lazy, SPTI_ROW_FALLBACKS, ray);
}

static void write_words(const wanted *all, size_t place, const record_word words[RESULTS]) {
    for (int k = 0; k < all->count; ++k) {
        memcpy(all->base[k] + (ptrdiff_t)place * all->stride[k], &words[all->result[k]], 4);
    }
}

/* Of a ray that asked nothing. */
static void words_of_miss(record_word words[RESULTS]) {
    words[T].real = words[RESIDUAL].real = INFINITY;
    words[CANDIDATE_T].real = words[CANDIDATE_RATIO].real = INFINITY;
    words[OUTCOME].signed_whole = SPT_MISS;
    words[COMPONENT].signed_whole = -1;
    words[EVALUATIONS].whole = words[FLAGS].whole = words[FALLBACKS].whole = 0;
}

/* Whether the places of four rays follow each other. */
SPTI_INLINE int is_run(const size_t *places, size_t ray) {
    return places[ray + 1] == places[ray] + 1 && places[ray + 2] == places[ray] + 2 &&
           places[ray + 3] == places[ray] + 3;
}

/* One result of all active rays; which one is a constant. From a copy of the union: then the
 * compiler knows that what is written does not change it. Pixels come in runs of four. */
SPTI_INLINE void write_result(const spti_union *lazy, int result, char *base, ptrdiff_t stride,
                              size_t first, const size_t *places) {
    const spti_union rays = *lazy;
    size_t i = 0;
    for (; i < rays.count; ++i) {
        record_word words[4][RESULTS];
        const size_t place = places != NULL ? places[i] : first + i;
        char *const to = base + (ptrdiff_t)place * stride;
        if (rays.all_active && i + 4 <= rays.count && (places == NULL || is_run(places, i))) {
            for (size_t k = 0; k < 4; ++k) words_of(&rays, i + k, words[k]);
            memcpy(to, &words[0][result], 4);
            memcpy(to + stride, &words[1][result], 4);
            memcpy(to + 2 * stride, &words[2][result], 4);
            memcpy(to + 3 * stride, &words[3][result], 4);
            i += 3;
        } else if (rays.records[i].active) {
            words_of(&rays, i, words[0]);
            memcpy(to, &words[0][result], 4);
        }
    }
}

void spti_union_write(const spti_union *lazy, const spt_hits *hits, size_t first,
                      const size_t *places) {
    const wanted all = wanted_of(hits);
    for (int k = 0; k < all.count; ++k) {
        char *const base = all.base[k];
        const ptrdiff_t stride = all.stride[k];
        switch (all.result[k]) {
#define CASE(result) \
    case result: \
        write_result(lazy, result, base, stride, first, places); \
        break;
            CASE(T)
            CASE(RESIDUAL)
            CASE(OUTCOME)
            CASE(EVALUATIONS)
            CASE(FLAGS)
            CASE(COMPONENT)
            CASE(CANDIDATE_T)
            CASE(CANDIDATE_RATIO)
            CASE(FALLBACKS)
#undef CASE
        default:
            break;
        }
    }
}

void spti_union_hit(const spti_union *lazy, size_t ray, spt_hit *hit) {
    const spt_hits sinks = spt_hits_of(hit);
    const wanted all = wanted_of(&sinks);
    record_word words[RESULTS];
    if (lazy->records[ray].active) {
        words_of(lazy, ray, words);
    } else {
        words_of_miss(words);
    }
    write_words(&all, 0, words);
}

void spti_write_misses(size_t count, const int32_t *active, const size_t *places,
                       const spt_hits *hits) {
    const wanted all = wanted_of(hits);
    record_word words[RESULTS];
    words_of_miss(words);
    for (int k = 0; k < all.count; ++k) {
        const record_word word = words[all.result[k]];
        char *const base = all.base[k];
        const ptrdiff_t stride = all.stride[k];
        for (size_t i = 0; i < count; ++i) {
            if (active != NULL && active[i] == 0) continue;
            memcpy(base + (ptrdiff_t)places[i] * stride, &word, sizeof word);
        }
    }
}

void spti_union_count(const spti_union *lazy, spt_statistics *statistics) {
    for (size_t i = 0; i < lazy->count; ++i) {
        const float steepest = row(lazy, SPTI_ROW_STEEPEST, i);
        if (!lazy->records[i].active) continue;
        statistics->rays += 1;
        statistics->outcomes[lazy->records[i].outcome] += 1;
        statistics->fallbacks += (uint64_t)row(lazy, SPTI_ROW_FALLBACKS, i);
        if (steepest > statistics->largest_slope) statistics->largest_slope = steepest;
    }
}
