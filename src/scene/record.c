/* SPDX-License-Identifier: MIT
 *
 * Writes the results of a union's rays, column by column: what is absent is asked once a column. */
#include <math.h>

#include "scene_call.h"

static int reached(const spti_record *record) {
    return record->outcome != SPT_MISS && record->outcome != SPT_BAD_RAY;
}

/* The results as words: a float, an int32_t or a uint32_t. */
typedef union record_word {
    float real;
    int32_t signed_whole;
    uint32_t whole;
} record_word;

typedef record_word word_fn(const spti_record *record);

static record_word t_of(const spti_record *record) {
    const record_word word = {.real = reached(record) ? record->t : INFINITY};
    return word;
}

static record_word residual_of(const spti_record *record) {
    const record_word word = {.real = reached(record) ? record->value : INFINITY};
    return word;
}

static record_word outcome_of(const spti_record *record) {
    const record_word word = {.signed_whole = record->outcome};
    return word;
}

static record_word evaluations_of(const spti_record *record) {
    const record_word word = {.whole = record->evaluations};
    return word;
}

static record_word flags_of(const spti_record *record) {
    const int steep = record->steep || spti_is_steep(record->steepest);
    const record_word word = {.whole = (steep ? SPT_FLAG_STEEP : 0u) |
                                       (record->inside ? SPT_FLAG_INSIDE : 0u)};
    return word;
}

static record_word component_of(const spti_record *record) {
    const record_word word = {.signed_whole = record->outcome == SPT_HIT ? record->component : -1};
    return word;
}

static record_word candidate_t_of(const spti_record *record) {
    const int there = record->candidate_ratio < INFINITY;
    const record_word word = {.real = there ? record->candidate_t : INFINITY};
    return word;
}

static record_word candidate_ratio_of(const spti_record *record) {
    const record_word word = {.real = record->candidate_ratio};
    return word;
}

static record_word fallbacks_of(const spti_record *record) {
    const record_word word = {.whole = (uint32_t)record->fallbacks};
    return word;
}

SPTI_INLINE void write_column(const spti_record *records, size_t count, const spt_sink *sink,
                              size_t first, const size_t *places, word_fn *word_of) {
    char *const base = sink->first;
    const ptrdiff_t stride = sink->stride;
    if (base == NULL) return;
    for (size_t i = 0; i < count; ++i) {
        if (!records[i].active) continue;
        const record_word word = word_of(&records[i]);
        const size_t place = places != NULL ? places[i] : first + i;
        memcpy(base + (ptrdiff_t)place * stride, &word, sizeof word);
    }
}

void spti_records_write(const spti_record *records, size_t count, const spt_hits *hits,
                        size_t first, const size_t *places) {
    write_column(records, count, &hits->t, first, places, t_of);
    write_column(records, count, &hits->residual, first, places, residual_of);
    write_column(records, count, &hits->outcome, first, places, outcome_of);
    write_column(records, count, &hits->evaluations, first, places, evaluations_of);
    write_column(records, count, &hits->flags, first, places, flags_of);
    write_column(records, count, &hits->component, first, places, component_of);
    write_column(records, count, &hits->candidate_t, first, places, candidate_t_of);
    write_column(records, count, &hits->candidate_ratio, first, places, candidate_ratio_of);
    write_column(records, count, &hits->fallbacks, first, places, fallbacks_of);
}

void spti_records_count(const spti_record *records, size_t count, spt_statistics *statistics) {
    for (size_t i = 0; i < count; ++i) {
        const spti_record *const record = &records[i];
        if (!record->active) continue;
        statistics->rays += 1;
        statistics->outcomes[record->outcome] += 1;
        statistics->fallbacks += (uint64_t)record->fallbacks;
        if (record->steepest > statistics->largest_slope) {
            statistics->largest_slope = record->steepest;
        }
    }
}
