/* SPDX-License-Identifier: MIT
 *
 * Writes the results of rays that leave a chunk, column by column: what is absent is asked once a
 * column and not once a ray, and no branch depends on how a ray ended. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "driver.h"

/* Where the word of a leaving ray goes. */
typedef struct leave_column {
    char *base;
    ptrdiff_t stride;
} leave_column;

/* base is NULL where the sink is absent. By value: then the compiler knows it does not change. */
static leave_column column_of(const spt_sink *sink) {
    const leave_column column = {sink->first, sink->stride};
    return column;
}

static void write_word(leave_column column, size_t place, const void *word) {
    memcpy(column.base + (ptrdiff_t)place * column.stride, word, 4);
}

/* Whether t and f of the slot are the result. */
static int reached(unsigned char outcome) {
    return outcome != SPT_MISS && outcome != SPT_BAD_RAY;
}

static void write_place(const spti_call *call, const spti_chunk *chunk,
                        const spti_leavers *leavers) {
    const size_t count = leavers->count;
    const leave_column to_t = column_of(&call->hits->t);
    if (to_t.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            const float t = chunk->array[SPTI_T][slot] * chunk->unit[leavers->indices[i]];
            const float written = reached(leavers->outcomes[i]) ? t : INFINITY;
            write_word(to_t, leavers->places[i], &written);
        }
    }
    const leave_column to_residual = column_of(&call->hits->residual);
    if (to_residual.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            const float value = chunk->array[SPTI_VALUE][slot];
            const float written = reached(leavers->outcomes[i]) ? value : INFINITY;
            write_word(to_residual, leavers->places[i], &written);
        }
    }
}

static void write_end(const spti_call *call, const spti_chunk *chunk, const spti_leavers *leavers) {
    const size_t count = leavers->count;
    const leave_column to_outcome = column_of(&call->hits->outcome);
    if (to_outcome.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const int32_t outcome = leavers->outcomes[i];
            write_word(to_outcome, leavers->places[i], &outcome);
        }
    }
    const leave_column to_evaluations = column_of(&call->hits->evaluations);
    if (to_evaluations.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const uint32_t spent = spti_spent(chunk, leavers->slots[i]);
            const uint32_t evaluations = leavers->age + spent;
            write_word(to_evaluations, leavers->places[i], &evaluations);
        }
    }
    const leave_column to_component = column_of(&call->hits->component);
    if (to_component.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const int32_t component = leavers->outcomes[i] == SPT_HIT ? call->component : -1;
            write_word(to_component, leavers->places[i], &component);
        }
    }
}

static void write_candidate(const spti_call *call, const spti_chunk *chunk,
                            const spti_leavers *leavers) {
    const size_t count = leavers->count;
    const leave_column to_candidate_t = column_of(&call->hits->candidate_t);
    if (to_candidate_t.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            const int there = chunk->array[SPTI_CANDIDATE_RATIO][slot] < INFINITY;
            const float t = chunk->array[SPTI_CANDIDATE_T][slot] * chunk->unit[leavers->indices[i]];
            const float written = there ? t : INFINITY;
            write_word(to_candidate_t, leavers->places[i], &written);
        }
    }
    const leave_column to_candidate_ratio = column_of(&call->hits->candidate_ratio);
    if (to_candidate_ratio.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            write_word(to_candidate_ratio, leavers->places[i],
                       &chunk->array[SPTI_CANDIDATE_RATIO][slot]);
        }
    }
}

static void write_audit(const spti_call *call, const spti_chunk *chunk,
                        const spti_leavers *leavers) {
    const size_t count = leavers->count;
    const leave_column to_flags = column_of(&call->hits->flags);
    if (to_flags.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            const int steep = leavers->steep || spti_is_steep(chunk->array[SPTI_STEEPEST][slot]);
            const int inside = chunk->array[SPTI_SCALE][slot] < 0.0f;
            const uint32_t flags = (steep ? SPT_FLAG_STEEP : 0u) | (inside ? SPT_FLAG_INSIDE : 0u);
            write_word(to_flags, leavers->places[i], &flags);
        }
    }
    const leave_column to_fallbacks = column_of(&call->hits->fallbacks);
    if (to_fallbacks.base != NULL) {
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = leavers->slots[i];
            const uint32_t fallbacks = (uint32_t)chunk->array[SPTI_FALLBACKS][slot];
            write_word(to_fallbacks, leavers->places[i], &fallbacks);
        }
    }
}

static void count_in(const spti_call *call, const spti_chunk *chunk, const spti_leavers *leavers) {
    spt_statistics *const statistics = call->statistics;
    statistics->rays += leavers->count;
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        const float product = chunk->array[SPTI_STEEPEST][slot] * call->field.lipschitz;
        const float slope = product < FLT_MAX ? product : FLT_MAX;
        statistics->outcomes[leavers->outcomes[i]] += 1;
        statistics->fallbacks += (uint64_t)chunk->array[SPTI_FALLBACKS][slot];
        if (slope > statistics->largest_slope) statistics->largest_slope = slope;
    }
}

void spti_place_leavers(const spti_call *call, const spti_chunk *chunk, spti_leavers *leavers,
                        size_t first) {
    const size_t *const places = call->places;
    for (size_t i = 0; i < leavers->count; ++i) {
        const int index = (int)chunk->array[SPTI_INDEX][leavers->slots[i]];
        const size_t ray = first + chunk->picked[index];
        leavers->indices[i] = (unsigned char)index;
        leavers->places[i] = places != NULL ? places[ray] : ray;
    }
}

void spti_write_hits(const spti_call *call, spti_chunk *chunk, spti_leavers *leavers,
                     size_t first) {
    spti_place_leavers(call, chunk, leavers, first);
    write_place(call, chunk, leavers);
    write_end(call, chunk, leavers);
    if (call->wants & SPTI_WANT_CANDIDATE) write_candidate(call, chunk, leavers);
    write_audit(call, chunk, leavers);
    if (call->statistics != NULL) count_in(call, chunk, leavers);
}
