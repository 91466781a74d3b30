/* SPDX-License-Identifier: MIT
 *
 * The life of a chunk: loaded, marched pass by pass, and emptied as its rays finish. Per ray and
 * pass everything happens in the kernels; here is what happens once a ray or once a pass. */
#include <math.h>

#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "narrow.h"

/* Reads the picked rays of a column, or what stands for an absent one. By memcpy, since values need
 * no alignment. A run of rays is unrolled. */
static void load_column(spti_chunk *chunk, int array, const spt_column *column, float absent,
                        size_t count, size_t first, int run) {
    float *const to = chunk->array[array];
    const char *base = column->first;
    if (base != NULL) base += (ptrdiff_t)first * column->stride;
    if (base == NULL || column->stride == 0) {
        if (base != NULL) memcpy(&absent, base, sizeof absent);
        /* To the end: it may not be moved. */
        for (size_t slot = 0; slot < SPTI_ROOM; ++slot) to[slot] = absent;
        return;
    }
    if (run && column->stride == sizeof *to) {
        memcpy(to, base + (size_t)chunk->picked[0] * sizeof *to, count * sizeof *to);
    } else if (run) {
        const ptrdiff_t stride = column->stride;
        size_t slot = 0;
        base += (ptrdiff_t)chunk->picked[0] * stride;
        for (; slot + 4 <= count; slot += 4) { /* half the time */
            const char *const from = base + (ptrdiff_t)slot * stride;
            memcpy(&to[slot], from, sizeof *to);
            memcpy(&to[slot + 1], from + stride, sizeof *to);
            memcpy(&to[slot + 2], from + 2 * stride, sizeof *to);
            memcpy(&to[slot + 3], from + 3 * stride, sizeof *to);
        }
        for (; slot < count; ++slot) {
            memcpy(&to[slot], base + (ptrdiff_t)slot * stride, sizeof *to);
        }
    } else {
        for (size_t slot = 0; slot < count; ++slot) {
            memcpy(&to[slot], base + chunk->picked[slot] * column->stride, sizeof *to);
        }
    }
    for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) to[slot] = to[count - 1];
}

/* Which rays of a window are active; returns how many. */
static size_t pick(const spt_column *active, uint16_t *picked, size_t first, size_t window) {
    size_t count = 0;
    if (active->first == NULL) {
        for (int i = 0; i < (int)window; ++i) picked[i] = (uint16_t)i;
        return window;
    }
    for (size_t i = 0; i < window; ++i) {
        int32_t value;
        memcpy(&value, (const char *)active->first + (ptrdiff_t)(first + i) * active->stride,
               sizeof value);
        picked[count] = (uint16_t)i;
        count += value != 0;
    }
    return count;
}

void spti_load_chunk(const spt_rays *rays, spti_chunk *chunk, size_t count, size_t first) {
    const int run = chunk->picked[count - 1] - chunk->picked[0] + 1u == count; /* they ascend */
    for (int axis = 0; axis < 3; ++axis) {
        load_column(chunk, SPTI_ORIGIN + axis, &rays->origin[axis], 0, count, first, run);
        load_column(chunk, SPTI_DIRECTION + axis, &rays->direction[axis], 0, count, first, run);
    }
    load_column(chunk, SPTI_T, &rays->t_min, 0, count, first, run);
    load_column(chunk, SPTI_T_MAX, &rays->t_max, INFINITY, count, first, run);
    load_column(chunk, SPTI_PATH, &rays->path, 0, count, first, run);
    for (int slot = 0; slot < SPT_BATCH; ++slot) chunk->array[SPTI_INDEX][slot] = (float)slot;
}

void spti_ask_groups(const spt_field *field, size_t n, const float *x, const float *y,
                     const float *z, float *distance) {
    const size_t whole = (n + SPTI_GROUP - 1) / SPTI_GROUP * SPTI_GROUP;
    if (field->batch != NULL) {
        /* In steps of a constant, which compilers vectorise at any level. */
        for (size_t at = 0; at < whole; at += SPTI_GROUP) {
            for (size_t i = 0; i < SPTI_GROUP; ++i) distance[at + i] = NAN;
        }
        field->batch(field->user, whole, x, y, z, distance);
    } else {
        for (size_t i = 0; i < n; ++i) distance[i] = field->point(field->user, x[i], y[i], z[i]);
        for (size_t i = n; i < whole; ++i) distance[i] = distance[0];
    }
}

void spti_ask(const spt_field *field, size_t n, float *x, float *y, float *z, float *distance) {
    if (n == 0) return;
    for (size_t i = n; i % SPTI_GROUP != 0; ++i) {
        x[i] = x[n - 1];
        y[i] = y[n - 1];
        z[i] = z[n - 1];
    }
    spti_ask_groups(field, n, x, y, z, distance);
}

void spti_count_asked(const spti_call *call, size_t n) {
    const size_t whole = (n + SPTI_GROUP - 1) / SPTI_GROUP * SPTI_GROUP;
    if (call->allowance != NULL) *call->allowance -= (int64_t)n;
    if (call->statistics != NULL) {
        call->statistics->passes += 1;
        call->statistics->evaluations += n;
        call->statistics->slots += call->field.batch != NULL ? whole : n;
    }
}

void spti_evaluate(const spti_call *call, spti_chunk *chunk, size_t n) {
    spti_ask_groups(&call->field, n, chunk->array[SPTI_X], chunk->array[SPTI_Y],
                    chunk->array[SPTI_Z], chunk->distance);
    spti_count_asked(call, n);
}

/* Closes the gaps of a pass that bracketed rays, and moves those to the end of each array once its
 * other rays have made room. Returns how many rays go on; *brackets counts those set aside. */
static SPTI_COLD size_t set_brackets_aside(const spti_call *call, spti_chunk *chunk, size_t count,
                                           uint32_t age, size_t *brackets) {
    spti_compact_fn *const compact = spti_chunk_kernels_of[call->isa].compact;
    unsigned char slots[SPT_BATCH];
    float kept[SPT_BATCH];
    size_t aside = 0, remain = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        const unsigned bracketed = chunk->fates[slot / SPTI_GROUP].bracketed;
        if (bracketed >> slot % SPTI_GROUP & 1) slots[aside++] = (unsigned char)slot;
    }
    for (size_t i = 0; i < call->array_count; ++i) {
        float *const array = chunk->array[call->arrays[i]];
        for (size_t k = 0; k < aside; ++k) kept[k] = array[slots[k]];
        remain = compact(chunk, &call->arrays[i], 1, count);
        for (size_t k = 0; k < aside; ++k) array[SPTI_ROOM - 1 - *brackets - k] = kept[k];
    }
    for (size_t k = 0; k < aside; ++k) {
        const size_t to = SPTI_ROOM - 1 - *brackets - k;
        chunk->array[SPTI_PENDING_T][to] = chunk->distance[slots[k]]; /* f beyond the crossing */
        spti_set_spent(chunk, to, age + (spti_keeps_spent(call) ? spti_spent(chunk, to) : 0));
    }
    *brackets += aside;
    return remain;
}

/* Lists the slots of finished rays, but for bracketed ones, in order, and how each ended. From three
 * masks a group, one for each bit of an outcome's number, so that there is no branch an outcome. */
static void list_finished(const spti_chunk *chunk, size_t count, spti_leavers *leavers) {
    size_t listed = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        const spti_fates *fates = &chunk->fates[group];
        const unsigned hit = fates->hit, missed = fates->missed & ~hit;
        const unsigned nonfinite = fates->nonfinite & ~(hit | missed);
        const unsigned bad = fates->bad & ~(hit | missed | nonfinite);
        const unsigned stopped = fates->stopped & ~(hit | missed | nonfinite | bad);
        const unsigned limit = ~(hit | missed | nonfinite | bad | stopped);
        const unsigned ones = hit | nonfinite | stopped;
        const unsigned twos = limit | nonfinite, fours = bad | stopped;
        unsigned ended = fates->finished & ~(unsigned)fates->bracketed;
        for (; ended != 0; ended &= ended - 1) {
            const unsigned bit = spti_lowest_bit(ended);
            const unsigned outcome =
                (ones >> bit & 1) + 2 * (twos >> bit & 1) + 4 * (fours >> bit & 1);
            leavers->slots[listed] = (uint16_t)(group * SPTI_GROUP + bit);
            leavers->outcomes[listed++] = (unsigned char)outcome;
        }
    }
    leavers->count = listed;
}

/* Writes out the finished rays and closes the gaps; returns how many rays go on. Brackets are set
 * aside and counted. */
static size_t empty_finished(const spti_call *call, spti_chunk *chunk, size_t count, size_t first,
                             uint32_t age, size_t *brackets) {
    spti_leavers leavers;
    unsigned bracketed = 0;
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        bracketed |= chunk->fates[group].finished & (unsigned)chunk->fates[group].bracketed;
    }
    list_finished(chunk, count, &leavers);
    leavers.age = age;
    leavers.steep = 0;
    call->leave(call, chunk, &leavers, first);
    if (bracketed) return set_brackets_aside(call, chunk, count, age, brackets);
    return spti_chunk_kernels_of[call->isa].compact(chunk, call->arrays, call->array_count, count);
}

/* What the samples at t_min decide: on which side each ray is. */
static void start_rays(spti_chunk *chunk, size_t count) {
    float *const scale = chunk->array[SPTI_SCALE];
    memcpy(chunk->array[SPTI_VALUE], chunk->distance, sizeof chunk->distance);
    for (size_t slot = 0; slot < (count + SPTI_GROUP - 1) / SPTI_GROUP * SPTI_GROUP; ++slot) {
        scale[slot] = chunk->distance[slot] < 0.0f ? -scale[slot] : scale[slot];
    }
}

/* The options that change what a first sample means. Returns whether a ray finished. */
static SPTI_COLD int apply_start_options(const spti_call *call, spti_chunk *chunk, size_t count) {
    unsigned any = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        spti_fates *fates = &chunk->fates[slot / SPTI_GROUP];
        const uint16_t bit = (uint16_t)(1u << slot % SPTI_GROUP);
        const int inside = chunk->array[SPTI_SCALE][slot] < 0.0f && !(fates->nonfinite & bit);
        if ((call->settings.flags & SPT_SKIP_START) && (fates->hit & bit) &&
            !spti_enters(chunk, slot)) {
            /* Still within the tolerance: the budget ended while skipping, and it is no hit. */
            fates->hit &= (uint16_t)~bit;
        } else if ((call->settings.flags & SPT_STOP_INSIDE) && inside) {
            fates->hit |= bit;
            fates->missed &= (uint16_t)~bit;
            fates->finished |= bit;
        }
        any |= fates->finished;
    }
    return any != 0;
}

/* Ends the rays whose budget is used up. Returns whether there was one. */
static SPTI_COLD int expire(const spti_call *call, spti_chunk *chunk, size_t count, uint32_t age) {
    int any = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        if (age + spti_spent(chunk, slot) >= call->settings.budget) {
            chunk->fates[slot / SPTI_GROUP].finished |= (uint16_t)(1u << slot % SPTI_GROUP);
            any = 1;
        }
    }
    return any;
}

/* Sets all rays aside that are not finished. */
static SPTI_COLD void stop_all(spti_chunk *chunk, size_t count) {
    for (size_t group = 0; group * SPTI_GROUP < count; ++group) {
        const size_t left = count - group * SPTI_GROUP;
        const unsigned rays = left < SPTI_GROUP ? (1u << left) - 1u : 0xffffu;
        chunk->fates[group].stopped |= (uint16_t)(rays & ~(unsigned)chunk->fates[group].finished);
        chunk->fates[group].finished = (uint16_t)rays;
    }
}

static uint32_t most_spent_of(const spti_call *call, const spti_chunk *chunk, size_t count) {
    uint32_t most = 0;
    if (!spti_keeps_spent(call)) return 0;
    for (size_t slot = 0; slot < count; ++slot) {
        const uint32_t spent = spti_spent(chunk, slot);
        most = spent > most ? spent : most;
    }
    return most;
}

/* Each pass is an evaluation of each ray. */
void spti_run_chunk(const spti_call *call, spti_chunk *chunk, size_t count, size_t first, int any,
                    int first_pass) {
    const uint32_t flags = call->settings.flags, budget = call->settings.budget;
    size_t brackets = 0;
    if (any) count = empty_finished(call, chunk, count, first, 0, &brackets);
    uint32_t most_spent = most_spent_of(call, chunk, count);
    for (uint32_t age = 0; count > 0 && age < budget; ++age) {
        const int fresh = first_pass && age == 0;
        spti_evaluate(call, chunk, count);
        if (fresh) {
            if (flags & SPT_SKIP_START) most_spent += spti_skip_start(call, chunk, count);
            if (call->turn != NULL) most_spent += call->turn(call, chunk, count);
            start_rays(chunk, count);
        }
        any = call->pass(chunk, &call->march, count, fresh);
        if (fresh && flags != 0) any = apply_start_options(call, chunk, count);
        if (call->march.between != 0) spti_look_at_ends(call, chunk, count, age + 1);
        if (call->stop != NULL) any = call->stop(chunk, count);
        if (budget - age - 1 <= most_spent) any |= expire(call, chunk, count, age + 1);
        if (call->allowance != NULL && *call->allowance <= 0) {
            stop_all(chunk, count);
            any = 1;
        }
        if (any) count = empty_finished(call, chunk, count, first, age + 1, &brackets);
    }
    if (brackets > 0) spti_close_brackets(call, chunk, brackets, first);
}

void spti_trace_chunk(const spti_call *call, spti_chunk *chunk, size_t first, size_t window) {
    size_t count = pick(&call->rays->active, chunk->picked, first, window);
    if (count == 0) return;
    spti_load_chunk(call->rays, chunk, count, first);
    int any = spti_chunk_kernels_of[call->isa].prepare(chunk, &call->march, count);
    if (spti_bound_asks(call->march.bound)) { /* only for rays that are alive */
        size_t brackets = 0;
        if (any) count = empty_finished(call, chunk, count, first, 0, &brackets);
        if (count == 0) return;
        any = spti_narrow_chunk(call, chunk, count);
    }
    if (call->settings.budget == 0) any |= expire(call, chunk, count, 0);
    spti_run_chunk(call, chunk, count, first, any, 1);
}
