/* SPDX-License-Identifier: MIT
 *
 * Writes the results of rays that leave a chunk, column by column: what is absent is asked once a
 * column and not once a ray, and no branch depends on how a ray ended. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "driver.h"

/* Exact fields were seen to reach a slope of 1.0003. */
#define STEEP_SLOPE 1.001f

/* Where the word of a leaving ray goes. */
typedef struct leave_column {
    char *base;
    ptrdiff_t stride;
} leave_column;

static int wanted(const spt_sink *sink, size_t first, leave_column *column) {
    if (sink->first == NULL) return 0;
    column->stride = sink->stride;
    column->base = (char *)sink->first + (ptrdiff_t)first * sink->stride;
    return 1;
}

static void write_word(const leave_column *column, unsigned char ray, const void *word) {
    memcpy(column->base + ray * column->stride, word, 4);
}

/* Whether t and f of the slot are the result. */
static int reached(unsigned char outcome) {
    return outcome != SPT_MISS && outcome != SPT_BAD_RAY;
}

static void write_place(const spti_call *call, const spti_chunk *chunk, const spti_leavers *leavers,
                        size_t first) {
    leave_column column;
    if (wanted(&call->hits->t, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            const float t = chunk->array[SPTI_T][slot] * chunk->unit[leavers->indices[i]];
            const float written = reached(leavers->outcomes[i]) ? t : INFINITY;
            write_word(&column, leavers->rays[i], &written);
        }
    }
    if (wanted(&call->hits->residual, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            const float value = chunk->array[SPTI_VALUE][slot];
            const float written = reached(leavers->outcomes[i]) ? value : INFINITY;
            write_word(&column, leavers->rays[i], &written);
        }
    }
}

static void write_end(const spti_call *call, const spti_chunk *chunk, const spti_leavers *leavers,
                      size_t first) {
    leave_column column;
    if (wanted(&call->hits->outcome, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const int32_t outcome = leavers->outcomes[i];
            write_word(&column, leavers->rays[i], &outcome);
        }
    }
    if (wanted(&call->hits->evaluations, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const uint32_t spent = spti_spent(chunk, leavers->slots[i]);
            const uint32_t evaluations = leavers->age + spent;
            write_word(&column, leavers->rays[i], &evaluations);
        }
    }
    if (wanted(&call->hits->component, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const int32_t component = leavers->outcomes[i] == SPT_HIT ? 0 : -1;
            write_word(&column, leavers->rays[i], &component);
        }
    }
}

static void write_candidate(const spti_call *call, const spti_chunk *chunk,
                            const spti_leavers *leavers, size_t first) {
    leave_column column;
    if (wanted(&call->hits->candidate_t, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            const int there = chunk->array[SPTI_CANDIDATE_RATIO][slot] < INFINITY;
            const float t = chunk->array[SPTI_CANDIDATE_T][slot] * chunk->unit[leavers->indices[i]];
            const float written = there ? t : INFINITY;
            write_word(&column, leavers->rays[i], &written);
        }
    }
    if (wanted(&call->hits->candidate_ratio, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            write_word(&column, leavers->rays[i], &chunk->array[SPTI_CANDIDATE_RATIO][slot]);
        }
    }
}

static void write_audit(const spti_call *call, const spti_chunk *chunk, const spti_leavers *leavers,
                        size_t first) {
    leave_column column;
    if (wanted(&call->hits->flags, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            const int steep = leavers->steep || chunk->array[SPTI_STEEPEST][slot] > STEEP_SLOPE;
            const int inside = chunk->array[SPTI_SCALE][slot] < 0.0f;
            const uint32_t flags = (steep ? SPT_FLAG_STEEP : 0u) | (inside ? SPT_FLAG_INSIDE : 0u);
            write_word(&column, leavers->rays[i], &flags);
        }
    }
    if (wanted(&call->hits->fallbacks, first, &column)) {
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            const uint32_t fallbacks = (uint32_t)chunk->array[SPTI_FALLBACKS][slot];
            write_word(&column, leavers->rays[i], &fallbacks);
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

void spti_write_hits(const spti_call *call, const spti_chunk *chunk, spti_leavers *leavers,
                     size_t first) {
    for (size_t i = 0; i < leavers->count; ++i) {
        const int index = (int)chunk->array[SPTI_INDEX][leavers->slots[i]];
        leavers->indices[i] = (unsigned char)index;
        leavers->rays[i] = chunk->picked[index];
    }
    write_place(call, chunk, leavers, first);
    write_end(call, chunk, leavers, first);
    if (call->wants & SPTI_WANT_CANDIDATE) write_candidate(call, chunk, leavers, first);
    write_audit(call, chunk, leavers, first);
    if (call->statistics != NULL) count_in(call, chunk, leavers);
}
