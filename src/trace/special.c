/* SPDX-License-Identifier: MIT
 *
 * What few rays need, one by one in plain C around the batch callback: leaving the surface a ray
 * starts on, and closing the bracket around a sign change that no distance bound would show. */
#define SPT_LANES 1
#include <float.h>
#include <math.h>

#include "slot.h"

static int within_tolerance(const spti_call *call, const spti_chunk *chunk, size_t slot) {
    const float radius = chunk->array[SPTI_VALUE][slot] * chunk->array[SPTI_SCALE][slot];
    const float t = chunk->array[SPTI_T][slot];
    return fabsf(radius) < spti_slot_tolerance(call, chunk, slot, t);
}

/* Makes one step of a ray that is within the tolerance. Returns whether there is a sample to ask
 * for, in place `to`; otherwise nothing is ahead, or the budget ends here. */
static int walk(const spti_call *call, spti_chunk *chunk, size_t slot, size_t to) {
    const float t = chunk->array[SPTI_T][slot];
    const float next = t + spti_slot_tolerance(call, chunk, slot, t);
    if (!(next > t) || !(next <= chunk->array[SPTI_T_MAX][slot])) {
        chunk->array[SPTI_VALUE][slot] = INFINITY; /* nothing ahead: a miss */
        return 0;
    }
    if (spti_spent(chunk, slot) + 1 >= call->settings.budget) return 0; /* 1 at t_min */
    chunk->array[SPTI_T][slot] = chunk->array[SPTI_PROBE][slot] = next;
    spti_slot_point(chunk, slot, to, next);
    return 1;
}

uint32_t spti_skip_start(const spti_call *call, spti_chunk *chunk, size_t count) {
    unsigned char walking[SPT_BATCH];
    size_t walkers = 0;
    uint32_t steps = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        chunk->array[SPTI_VALUE][slot] = chunk->distance[slot];
        if (spti_enters(chunk, slot)) continue;
        if (within_tolerance(call, chunk, slot)) walking[walkers++] = (unsigned char)slot;
    }
    for (; walkers > 0 && steps < call->settings.budget; ++steps) {
        size_t asked = 0, still = 0;
        for (size_t i = 0; i < walkers; ++i) {
            if (walk(call, chunk, walking[i], asked)) walking[asked++] = walking[i];
        }
        if (asked == 0) break;
        spti_pad_points(chunk, asked);
        spti_evaluate(call, chunk, asked);
        for (size_t i = 0; i < asked; ++i) {
            const size_t slot = walking[i];
            chunk->array[SPTI_VALUE][slot] = chunk->distance[i];
            spti_set_spent(chunk, slot, spti_spent(chunk, slot) + 1);
            if (within_tolerance(call, chunk, slot)) walking[still++] = walking[i];
        }
        walkers = still;
    }
    spti_pad_rays(call, chunk, count);
    memcpy(chunk->distance, chunk->array[SPTI_VALUE], sizeof chunk->distance);
    return steps;
}

/* ---- The end of a ray ------------------------------------------------------------------------ */

/* Rays that are about to end as a miss since their last sphere reaches beyond t_max; none where the
 * rule knew that f rises, and none whose end is too far away for a sample to mean anything. */
static int has_end(const spti_call *call, const spti_chunk *chunk, size_t slot, uint32_t age) {
    const spti_fates *const fates = &chunk->fates[slot / SPTI_GROUP];
    const unsigned bit = 1u << slot % SPTI_GROUP;
    const float t = chunk->array[SPTI_T][slot], t_max = chunk->array[SPTI_T_MAX][slot];
    const float radius = chunk->array[SPTI_VALUE][slot] * chunk->array[SPTI_SCALE][slot];
    if (!(fates->missed & bit) || (fates->hit & bit) || t + radius <= t_max) return 0;
    return t < t_max && t_max <= 0x1p62f && age + spti_spent(chunk, slot) < call->settings.budget;
}

/* The candidate of a ray with a last sample at its end. */
static void take_end(const spti_call *call, spti_chunk *chunk, size_t slot, float value) {
    const float scale = chunk->array[SPTI_SCALE][slot], t_max = chunk->array[SPTI_T_MAX][slot];
    const float before = chunk->array[SPTI_VALUE][slot] * scale, after = value * scale;
    const float step = t_max - chunk->array[SPTI_T][slot];
    float back;
    if (!(value >= -FLT_MAX)) return;
    const float apart = ray_closest(before, after, step, fabsf(after), &back);
    const float ends[2] = {t_max - back, t_max}, distances[2] = {apart, fabsf(after)};
    for (int i = 0; i < 2; ++i) {
        const float least = chunk->array[SPTI_EPSILON][slot];
        const float eye = ends[i] > least ? ends[i] : least;
        const float closest = distances[i] * call->march.inverse_lipschitz / fabsf(scale);
        const float ratio =
            (call->march.between & SPT_CANDIDATE_CLOSEST) ? closest : distances[i] / eye;
        if (!(ratio < chunk->array[SPTI_CANDIDATE_RATIO][slot])) continue;
        chunk->array[SPTI_CANDIDATE_RATIO][slot] = ratio;
        chunk->array[SPTI_CANDIDATE_T][slot] = ends[i];
    }
}

void spti_look_at_ends(const spti_call *call, spti_chunk *chunk, size_t count, uint32_t age) {
    SPTI_ALIGNED(64) float point[3][SPTI_GROUP], distance[SPTI_GROUP];
    unsigned char slots[SPTI_GROUP];
    size_t asked = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        if (has_end(call, chunk, slot, age)) {
            for (int axis = 0; axis < 3; ++axis) {
                point[axis][asked] = ray_point(chunk, axis, slot, chunk->array[SPTI_T_MAX][slot]);
            }
            slots[asked++] = (unsigned char)slot;
        }
        if (asked == 0 || (asked < SPTI_GROUP && slot + 1 < count)) continue;
        spti_ask(&call->field, asked, point[0], point[1], point[2], distance);
        for (size_t i = 0; i < asked; ++i) {
            take_end(call, chunk, slots[i], distance[i]);
            spti_set_spent(chunk, slots[i], spti_spent(chunk, slots[i]) + 1);
        }
        spti_count_asked(call, asked);
        asked = 0;
    }
}

/* ---- Brackets ------------------------------------------------------------------------------- */

/* A ray in a slot between a = t, free up to there, and b = probe, on the other side. */
static float *bracket_end(spti_chunk *chunk, size_t slot) {
    return &chunk->array[SPTI_PROBE][slot];
}

static float *bracket_end_value(spti_chunk *chunk, size_t slot) {
    return &chunk->array[SPTI_PENDING_T][slot];
}

/* Its next sample, in an array that only a march needs. */
static float *bracket_sample(spti_chunk *chunk, size_t slot) {
    return &chunk->array[SPTI_MEMORY][slot];
}

/* Where to sample next: the root of the chord and the middle in turn, 5 % away from the ends. */
static float split(spti_chunk *chunk, size_t slot, uint32_t turn) {
    const float scale = chunk->array[SPTI_SCALE][slot];
    const float a = chunk->array[SPTI_T][slot], b = *bracket_end(chunk, slot);
    const float before = chunk->array[SPTI_VALUE][slot] * scale;
    const float behind = *bracket_end_value(chunk, slot) * scale;
    const float width = b - a, margin = 0.05f * width;
    const float chord = a + width * (before / (before - behind)); /* before >= 0 > behind */
    const float middle = a + 0.5f * width;
    const float point = turn % 2 == 0 ? chord : middle;
    const float low = a + margin, high = b - margin;
    return point > low ? (point < high ? point : high) : low;
}

/* Ends a bracket; the outcome's t and f stand in the slot. In a frame of its own, off the way to
 * the callback. */
static SPTI_NOINLINE void leave(const spti_call *call, spti_chunk *chunk, size_t slot, size_t first,
                                spt_outcome outcome) {
    spti_leavers alone;
    alone.count = 1;
    alone.age = 0; /* the passes were counted in when it was set aside */
    alone.steep = 1;
    alone.slots[0] = (uint16_t)slot;
    alone.outcomes[0] = (unsigned char)outcome;
    call->leave(call, chunk, &alone, first);
}

/* Whether the ray in a slot needs another sample at t, its next; otherwise it was written out. */
static int goes_on(const spti_call *call, spti_chunk *chunk, size_t slot, size_t first,
                   uint32_t turn, float t) {
    const float a = chunk->array[SPTI_T][slot], b = *bracket_end(chunk, slot);
    if (b - a <= spti_slot_tolerance(call, chunk, slot, a) || !(t > a && t < b) ||
        turn == SPTI_BRACKET_EVALUATIONS) {
        leave(call, chunk, slot, first, SPT_HIT);
        return 0;
    }
    const uint32_t spent = spti_spent(chunk, slot);
    if (spent >= call->settings.budget) {
        leave(call, chunk, slot, first, SPT_LIMIT);
        return 0;
    }
    spti_set_spent(chunk, slot, spent + 1);
    return 1;
}

/* Takes a sample in. Returns whether the bracket is still open. */
static int narrow(const spti_call *call, spti_chunk *chunk, size_t slot, size_t first, float t,
                  float value) {
    const float radius = value * chunk->array[SPTI_SCALE][slot];
    const int number = value >= -FLT_MAX;
    const int close = fabsf(radius) < spti_slot_tolerance(call, chunk, slot, t);
    if (number && !close && radius < 0.0f) {
        *bracket_end(chunk, slot) = t;
        *bracket_end_value(chunk, slot) = value;
        return 1;
    }
    chunk->array[SPTI_T][slot] = t;
    chunk->array[SPTI_VALUE][slot] = value;
    if (number && !close) return 1;
    leave(call, chunk, slot, first, number ? SPT_HIT : SPT_NONFINITE);
    return 0;
}

void spti_close_brackets(const spti_call *call, spti_chunk *chunk, size_t count, size_t first) {
    unsigned char open[SPT_BATCH]; /* slots, counted from the last */
    for (size_t i = 0; i < count; ++i) open[i] = (unsigned char)i;
    for (uint32_t turn = 0; count > 0 && turn <= SPTI_BRACKET_EVALUATIONS; ++turn) {
        size_t asked = 0, still = 0;
        for (size_t i = 0; i < count; ++i) {
            const size_t slot = SPTI_ROOM - 1u - open[i];
            const float t = split(chunk, slot, turn);
            if (!goes_on(call, chunk, slot, first, turn, t)) continue;
            open[asked++] = open[i];
            *bracket_sample(chunk, slot) = t;
        }
        if (asked == 0) break;
        /* The points go to the front of arrays whose slots at the end are the brackets: their own
         * points are not needed, so that nothing is lost where the two meet. */
        for (size_t i = 0; i < asked; ++i) {
            const size_t slot = SPTI_ROOM - 1u - open[i];
            spti_slot_point(chunk, slot, i, *bracket_sample(chunk, slot));
        }
        spti_pad_points(chunk, asked);
        spti_evaluate(call, chunk, asked);
        for (size_t i = 0; i < asked; ++i) {
            const size_t slot = SPTI_ROOM - 1u - open[i];
            const float t = *bracket_sample(chunk, slot);
            if (narrow(call, chunk, slot, first, t, chunk->distance[i])) open[still++] = open[i];
        }
        count = still;
    }
}
