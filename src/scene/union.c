/* SPDX-License-Identifier: MIT
 *
 * The life of the rays of a lazy union: sweep by sweep each turns to the component that is nearest,
 * together with all rays that turn to the same one. */
#define SPT_LANES 1
#include "union.h"

#include <math.h>

#include "../trace/ray_kernel.h"

/* ---- Memory --------------------------------------------------------------------------------- */

/* Arrays laid out one behind the other, each aligned to 64 bytes. With base NULL only counted. */
typedef struct layout {
    char *base;
    size_t size;
    int overflows;
} layout;

static void *take(layout *all, size_t count, size_t each) {
    const size_t most = SIZE_MAX / 4;
    if (all->overflows || count > most / each || all->size > most - count * each) {
        all->overflows = 1;
        return NULL;
    }
    void *const array = all->base != NULL ? all->base + all->size : NULL;
    all->size += (count * each + 63) / 64 * 64;
    return array;
}

static void lay_out(spti_union *lazy, layout *all, size_t components, size_t pool) {
    const size_t room = pool + SPTI_GROUP; /* kernels work on whole groups */
    if (components > SIZE_MAX / (4 * room * SPTI_STATES)) all->overflows = 1;
    lazy->pool = pool;
    lazy->keys = take(all, all->overflows ? 0 : components * pool + SPTI_GROUP, sizeof(float));
    lazy->states = take(all, all->overflows ? 0 : components * SPTI_STATES * pool, sizeof(float));
    lazy->begun = take(all, all->overflows ? 0 : components * pool, 1);
    lazy->least = take(all, room, sizeof(float));
    lazy->second = take(all, room, sizeof(float));
    lazy->which = take(all, room, sizeof(float));
    lazy->records = take(all, pool, sizeof *lazy->records);
    lazy->alive = take(all, pool, sizeof *lazy->alive);
    lazy->tasks = take(all, pool, sizeof *lazy->tasks);
    lazy->groups = take(all, pool / SPTI_GROUP, sizeof *lazy->groups);
    lazy->counts = take(all, components + 1, sizeof *lazy->counts);
    lazy->chunk.array = take(all, SPTI_ARRAYS, sizeof *lazy->chunk.array);
}

size_t spti_union_size(size_t components, size_t pool) {
    layout all = {NULL, 0, 0};
    spti_union nowhere;
    lay_out(&nowhere, &all, components, pool);
    return all.overflows ? 0 : all.size;
}

void spti_union_place(spti_union *lazy, void *memory, size_t components, size_t pool) {
    layout all = {memory, 0, 0};
    lay_out(lazy, &all, components, pool);
}

/* ---- The beginning -------------------------------------------------------------------------- */

static void begin_record(spti_record *record) {
    memset(record, 0, sizeof *record);
    record->t = record->candidate_t = record->candidate_ratio = INFINITY;
    record->value = INFINITY;
    record->component = -1;
    record->outcome = SPT_MISS;
}

/* Lists the active rays of a window in chunk->picked; returns how many. */
static size_t pick_window(spti_union *lazy, size_t window, size_t size) {
    const spt_column *active = &lazy->rays->active;
    size_t count = 0;
    for (size_t i = 0; i < size; ++i) {
        spti_record *record = &lazy->records[window + i];
        int32_t value = -1;
        if (active->first != NULL) {
            memcpy(&value,
                   (const char *)active->first +
                       (ptrdiff_t)(lazy->first + window + i) * active->stride,
                   sizeof value);
        }
        begin_record(record);
        record->active = value != 0;
        lazy->chunk.picked[count] = (uint16_t)(window + i);
        count += value != 0;
    }
    return count;
}

/* The keys of the picked rays for a component: where its bound is entered. */
static void enter(spti_union *lazy, size_t place, size_t count, const float *starts) {
    SPTI_ALIGNED(64) float row[SPTI_ROOM];
    const uint16_t *picked = lazy->chunk.picked;
    const spti_call *call = &lazy->calls[lazy->list[place]];
    float *const keys = spti_union_keys(lazy, place);
    for (size_t i = 0; i < count; ++i) {
        row[i] = starts != NULL ? starts[place * lazy->pool + picked[i]] : 0.0f;
    }
    for (size_t i = count; i % SPTI_GROUP != 0; ++i) row[i] = row[count - 1];
    spti_union_kernels_of[lazy->isa]->entries(&lazy->chunk, call->march.bound, count, row);
    for (size_t i = 0; i < count; ++i) keys[picked[i]] = row[i];
}

static void begin_window(spti_union *lazy, size_t window, const float *starts) {
    const size_t left = lazy->count - window, size = left < SPT_BATCH ? left : SPT_BATCH;
    spti_chunk *const chunk = &lazy->chunk;
    const size_t count = pick_window(lazy, window, size);
    if (count == 0) return;
    spti_load_chunk(lazy->rays, chunk, count, lazy->first);
    spti_union_kernels_of[lazy->isa]->units(chunk, count);
    for (size_t i = 0; i < count; ++i) {
        lazy->records[chunk->picked[i]].unit = chunk->unit[i];
        if (chunk->fates[i / SPTI_GROUP].bad >> i % SPTI_GROUP & 1) {
            lazy->records[chunk->picked[i]].outcome = SPT_BAD_RAY;
        } else {
            lazy->alive[lazy->alive_count++] = chunk->picked[i];
        }
    }
    for (size_t place = 0; place < lazy->listed; ++place) enter(lazy, place, count, starts);
}

void spti_union_begin(spti_union *lazy, const float *starts) {
    lazy->alive_count = 0;
    for (size_t place = 0; place < lazy->listed; ++place) {
        float *const keys = spti_union_keys(lazy, place);
        memset(lazy->begun + place * lazy->pool, SPTI_FRESH, lazy->pool);
        for (size_t i = 0; i < lazy->pool; ++i) keys[i] = INFINITY;
    }
    for (size_t window = 0; window < lazy->count; window += SPT_BATCH) {
        begin_window(lazy, window, starts);
    }
}

/* ---- A component's turn --------------------------------------------------------------------- */

static float *state_row(const spti_union *lazy, size_t place, int what) {
    return lazy->states + (place * SPTI_STATES + (size_t)what) * lazy->pool;
}

/* Cuts fresh rays of a component off where an empty zone begins. */
static void cut_with_zones(spti_union *lazy, size_t count) {
    const size_t place = lazy->running;
    const int32_t component = (int32_t)lazy->list[place];
    spti_chunk *const chunk = &lazy->chunk;
    for (size_t slot = 0; slot < count; ++slot) {
        const uint16_t ray = chunk->picked[slot];
        const spti_clearing clear =
            spti_zone_clearing(lazy->zones, lazy->zone_count, component, lazy->rays,
                               lazy->first + ray, spti_union_keys(lazy, place)[ray]);
        state_row(lazy, place, SPTI_STATE_T_MAX)[ray] = clear.end;
    }
}

/* Gives a slot what its ray has gathered so far, and where it is to stop. */
static void load_record(spti_union *lazy, size_t slot) {
    spti_chunk *const chunk = &lazy->chunk;
    const uint16_t ray = chunk->picked[slot];
    const spti_record *record = &lazy->records[ray];
    const float unit = chunk->unit[slot], second = lazy->second[ray];
    spti_set_spent(chunk, slot, record->evaluations);
    chunk->array[SPTI_STEEPEST][slot] = record->steepest;
    chunk->array[SPTI_FALLBACKS][slot] = record->fallbacks;
    chunk->array[SPTI_CANDIDATE_T][slot] = record->candidate_t / unit;
    chunk->array[SPTI_CANDIDATE_RATIO][slot] = record->candidate_ratio;
    chunk->array[SPTI_STOP][slot] = (second < record->t ? second : record->t) / unit;
}

static void load_state(spti_union *lazy, size_t slot) {
    static const unsigned char arrays[] = {SPTI_T,      SPTI_VALUE,     SPTI_PROBE,
                                           SPTI_MEMORY, SPTI_PENDING_T, SPTI_PENDING_VALUE};
    spti_chunk *const chunk = &lazy->chunk;
    const uint16_t ray = chunk->picked[slot];
    const size_t place = lazy->running;
    for (int what = SPTI_STATE_T; what < SPTI_STATE_T_MAX; ++what) {
        chunk->array[arrays[what]][slot] = state_row(lazy, place, what)[ray];
    }
    if (lazy->begun[place * lazy->pool + ray] == SPTI_BEGUN_INSIDE) {
        chunk->array[SPTI_SCALE][slot] = -chunk->array[SPTI_SCALE][slot];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float probe = chunk->array[SPTI_PROBE][slot];
        chunk->array[SPTI_X + axis][slot] = ray_point(chunk, axis, slot, probe);
    }
}

static void pad(spti_chunk *chunk, const spti_call *call, size_t count) {
    for (size_t i = 0; i < call->array_count && count % SPTI_GROUP != 0; ++i) {
        float *const array = chunk->array[call->arrays[i]];
        for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) array[slot] = array[count - 1];
    }
}

/* Marches up to SPT_BATCH rays, picked already, along the component at work. */
static void march(spti_union *lazy, size_t count, int begun) {
    const size_t place = lazy->running;
    const spti_call *call = &lazy->calls[lazy->list[place]];
    spti_chunk *const chunk = &lazy->chunk;
    spti_load_chunk(lazy->rays, chunk, count, lazy->first);
    if (lazy->zone_count > 0) {
        const float *const ends = state_row(lazy, place, SPTI_STATE_T_MAX);
        if (!begun) cut_with_zones(lazy, count);
        for (size_t slot = 0; slot < count; ++slot) {
            float *const t_max = &chunk->array[SPTI_T_MAX][slot];
            const float end = ends[chunk->picked[slot]];
            *t_max = end < *t_max ? end : *t_max;
        }
    }
    if (!begun) {
        const float *const keys = spti_union_keys(lazy, place);
        for (size_t slot = 0; slot < count; ++slot) {
            chunk->array[SPTI_T][slot] = keys[chunk->picked[slot]];
        }
    }
    for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) {
        chunk->array[SPTI_T][slot] = chunk->array[SPTI_T][count - 1];
        chunk->array[SPTI_T_MAX][slot] = chunk->array[SPTI_T_MAX][count - 1];
    }
    const int any = spti_chunk_kernels_of[lazy->isa].prepare(chunk, &call->march, count);
    for (size_t slot = 0; slot < count; ++slot) {
        load_record(lazy, slot);
        if (begun) load_state(lazy, slot);
    }
    pad(chunk, call, count);
    spti_run_chunk(call, chunk, count, lazy->first, any, !begun);
}

/* All rays that turn to a component: the fresh ones, then those it knows. */
static void take_turn(spti_union *lazy, size_t place, const uint16_t *tasks, size_t count) {
    const unsigned char *const how = lazy->begun + place * lazy->pool;
    unsigned char known[SPT_BATCH]; /* asked before the first march changes it */
    lazy->running = place;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t left = count - first, size = left < SPT_BATCH ? left : SPT_BATCH;
        for (size_t i = 0; i < size; ++i) known[i] = how[tasks[first + i]] != SPTI_FRESH;
        for (int begun = 0; begun < 2; ++begun) {
            size_t picked = 0;
            if (lazy->allowance == 0) return;
            for (size_t i = 0; i < size; ++i) {
                lazy->chunk.picked[picked] = tasks[first + i];
                picked += known[i] == begun;
            }
            if (picked > 0) march(lazy, picked, begun);
        }
    }
}

/* ---- Leaving -------------------------------------------------------------------------------- */

/* Keeps a march for later. */
static void save_state(spti_union *lazy, size_t slot, uint16_t ray, float unit) {
    static const unsigned char arrays[] = {SPTI_T,      SPTI_VALUE,     SPTI_PROBE,
                                           SPTI_MEMORY, SPTI_PENDING_T, SPTI_PENDING_VALUE};
    spti_chunk *const chunk = &lazy->chunk;
    const size_t place = lazy->running;
    const float scale = chunk->array[SPTI_SCALE][slot];
    const float t = chunk->array[SPTI_T][slot], radius = chunk->array[SPTI_VALUE][slot] * scale;
    for (int what = SPTI_STATE_T; what < SPTI_STATE_T_MAX; ++what) {
        state_row(lazy, place, what)[ray] = chunk->array[arrays[what]][slot];
    }
    lazy->begun[place * lazy->pool + ray] = scale < 0.0f ? SPTI_BEGUN_INSIDE : SPTI_BEGUN;
    spti_union_keys(lazy, place)[ray] = (t + radius) * unit;
}

/* The component ended on a ray: at an event, or without one. */
static void end_march(spti_union *lazy, size_t slot, uint16_t ray, float unit, int outcome) {
    const size_t place = lazy->running;
    const int32_t component = (int32_t)lazy->list[place];
    spti_record *const record = &lazy->records[ray];
    float *const key = &spti_union_keys(lazy, place)[ray];
    const float t = lazy->chunk.array[SPTI_T][slot] * unit;
    *key = INFINITY;
    if (outcome == SPT_MISS) {
        if (lazy->zone_count > 0) { /* until the zone at which it was cut off, and on behind it */
            *key = state_row(lazy, place, SPTI_STATE_T_MAX)[ray];
            lazy->begun[place * lazy->pool + ray] = SPTI_FRESH;
        }
    } else if (t < record->t || (t <= record->t && component < record->component)) {
        record->t = t;
        record->value = lazy->chunk.array[SPTI_VALUE][slot];
        record->component = component;
        record->outcome = (unsigned char)outcome;
    }
}

void spti_union_leave(const spti_call *call, spti_chunk *chunk, spti_leavers *leavers,
                      size_t first) {
    spti_union *const lazy = call->owner;
    (void)first;
    spti_name_leavers(chunk, leavers);
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        const uint16_t ray = leavers->rays[i];
        const float unit = chunk->unit[leavers->indices[i]];
        spti_record *const record = &lazy->records[ray];
        record->evaluations = leavers->age + spti_spent(chunk, slot);
        record->inside |= chunk->array[SPTI_SCALE][slot] < 0.0f;
        record->steep |= leavers->steep != 0;
        if (call->wants & SPTI_WANT_SLOPE) record->steepest = chunk->array[SPTI_STEEPEST][slot];
        if (call->wants & SPTI_WANT_FALLBACKS) {
            record->fallbacks = chunk->array[SPTI_FALLBACKS][slot];
        }
        if (call->wants & SPTI_WANT_CANDIDATE) {
            record->candidate_t = chunk->array[SPTI_CANDIDATE_T][slot] * unit;
            record->candidate_ratio = chunk->array[SPTI_CANDIDATE_RATIO][slot];
        }
        if (leavers->outcomes[i] == SPTI_STOPPED) {
            save_state(lazy, slot, ray, unit);
        } else {
            end_march(lazy, slot, ray, unit, leavers->outcomes[i]);
        }
    }
}

/* ---- Sweeps --------------------------------------------------------------------------------- */

/* Looks for the nearest component of all rays that are alive. */
static void find_nearest(spti_union *lazy) {
    size_t group_count = 0;
    for (size_t i = 0; i < lazy->alive_count; ++i) {
        const uint16_t group = (uint16_t)(lazy->alive[i] / SPTI_GROUP);
        if (group_count == 0 || lazy->groups[group_count - 1] != group) {
            lazy->groups[group_count++] = group;
        }
    }
    spti_union_kernels_of[lazy->isa]->least(lazy, group_count);
}

/* The budget is used up: the ray stays undecided where its nearest component is. */
static void run_out(spti_union *lazy, uint16_t ray, size_t place) {
    spti_record *const record = &lazy->records[ray];
    const int begun = lazy->begun[place * lazy->pool + ray] != SPTI_FRESH;
    record->outcome = SPT_LIMIT;
    record->component = -1;
    record->t = spti_union_keys(lazy, place)[ray];
    record->value = INFINITY;
    if (begun) {
        record->t = state_row(lazy, place, SPTI_STATE_T)[ray] * record->unit;
        record->value = state_row(lazy, place, SPTI_STATE_VALUE)[ray];
    }
}

/* Whether a ray's nearest component, fresh on it, is to be met only behind an empty zone. */
static int in_zone(spti_union *lazy, uint16_t ray, size_t place) {
    float *const key = &spti_union_keys(lazy, place)[ray];
    if (lazy->zone_count == 0 || lazy->begun[place * lazy->pool + ray] != SPTI_FRESH) return 0;
    const spti_clearing clear =
        spti_zone_clearing(lazy->zones, lazy->zone_count, (int32_t)lazy->list[place], lazy->rays,
                           lazy->first + ray, *key);
    const int moved = clear.begin > *key;
    *key = clear.begin;
    return moved;
}

/* Ends the rays that are decided and counts the tasks of the others by component. The place of a
 * ray's task is kept in which; -1: it has none in this sweep. */
static void decide(spti_union *lazy) {
    size_t still = 0;
    memset(lazy->counts, 0, (lazy->listed + 1) * sizeof *lazy->counts);
    for (size_t i = 0; i < lazy->alive_count; ++i) {
        const uint16_t ray = lazy->alive[i];
        const spti_record *record = &lazy->records[ray];
        const float least = lazy->least[ray];
        if (record->t < least || !(least < INFINITY)) continue;
        const size_t place = (size_t)lazy->which[ray];
        if (record->evaluations >= lazy->budget) {
            run_out(lazy, ray, place);
            continue;
        }
        lazy->alive[still++] = ray;
        if (in_zone(lazy, ray, place)) {
            lazy->which[ray] = -1.0f;
        } else {
            lazy->counts[place + 1] += 1;
        }
    }
    lazy->alive_count = still;
}

/* Sorts the tasks by component: those of a place begin at counts[place + 1]; counts[0] is where the
 * last ones end. */
static void sort_tasks(spti_union *lazy) {
    uint32_t *const counts = lazy->counts;
    for (size_t place = 0; place < lazy->listed; ++place) counts[place + 1] += counts[place];
    counts[0] = counts[lazy->listed];
    for (size_t i = lazy->alive_count; i-- > 0;) {
        const uint16_t ray = lazy->alive[i];
        if (lazy->which[ray] < 0.0f) continue;
        lazy->tasks[--counts[(size_t)lazy->which[ray] + 1]] = ray;
    }
}

int spti_union_run(spti_union *lazy) {
    /* In a sweep every ray spends an evaluation, is done with a component, or jumps over a zone. */
    const size_t most = lazy->budget + 2 * lazy->listed * (lazy->zone_count + 1) + 2;
    for (size_t sweep = 0; lazy->alive_count > 0 && sweep < most; ++sweep) {
        if (lazy->allowance == 0) return 0;
        find_nearest(lazy);
        decide(lazy);
        sort_tasks(lazy);
        for (size_t place = 0; place < lazy->listed; ++place) {
            const size_t begin = lazy->counts[place + 1];
            const size_t end = place + 1 < lazy->listed ? lazy->counts[place + 2] : lazy->counts[0];
            if (end > begin) take_turn(lazy, place, lazy->tasks + begin, end - begin);
        }
    }
    return 1;
}
