/* SPDX-License-Identifier: MIT
 *
 * The life of the rays of a lazy union: sweep by sweep each turns to the component that is nearest,
 * together with all rays that turn to the same one. */
#include "union.h"

#include <math.h>

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
    const size_t room = pool + SPTI_GROUP; /* kernels work on whole vectors */
    const size_t groups = pool / SPTI_GROUP;
    if (components > SIZE_MAX / (4 * room * SPTI_STATES * sizeof(float))) {
        all->overflows = 1;
        components = 0;
    }
    lazy->pool = pool;
    lazy->rows = take(all, SPTI_ROWS * room, sizeof(float));
    lazy->states = take(all, components * SPTI_STATES * room, sizeof(float));
    lazy->begun = take(all, components * groups, sizeof *lazy->begun);
    lazy->cut = take(all, components * groups, sizeof *lazy->cut);
    lazy->inside = take(all, components * groups, sizeof *lazy->inside);
    lazy->tasks = take(all, components * groups, sizeof *lazy->tasks);
    lazy->busy = take(all, components, sizeof *lazy->busy);
    lazy->alive = take(all, groups, sizeof *lazy->alive);
    lazy->records = take(all, pool, sizeof *lazy->records);
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

static int is_active(const spt_column *active, size_t ray) {
    int32_t value;
    if (active->first == NULL) return 1;
    memcpy(&value, (const char *)active->first + (ptrdiff_t)ray * active->stride, sizeof value);
    return value != 0;
}

void spti_union_clear(spti_union *lazy) {
    lazy->count = 0;
    lazy->most_spent = 0;
    lazy->all_active = 1;
}

/* Marks which rays of a window are active, and picks those to look at: an inactive ray is not, its
 * slot repeats an active one. Returns whether there is one. */
static int pick_active(spti_union *lazy, const spt_column *active, size_t window, size_t first,
                       size_t size) {
    spti_record *const records = lazy->records + window;
    uint16_t *const alive = lazy->alive + window / SPTI_GROUP;
    uint16_t *const picked = lazy->chunk.picked;
    size_t some = size;
    if (active->first == NULL) {
        const unsigned last = (1u << (size - 1) % SPTI_GROUP) * 2u - 1u;
        for (size_t group = 0; group * SPTI_GROUP < size; ++group) alive[group] = 0xffff;
        alive[(size - 1) / SPTI_GROUP] = (uint16_t)last;
        for (int i = 0; i < (int)size; ++i) picked[i] = (uint16_t)i;
        return 1;
    }
    memset(alive, 0, (size + SPTI_GROUP - 1) / SPTI_GROUP * sizeof *alive);
    for (size_t i = size; i-- > 0;) {
        if (is_active(active, first + i)) {
            some = i;
            alive[i / SPTI_GROUP] |= (uint16_t)(1u << i % SPTI_GROUP);
        } else {
            records[i].active = 0;
            lazy->all_active = 0;
        }
    }
    if (some == size) return 0;
    for (size_t i = 0; i < size; ++i) picked[i] = (uint16_t)(records[i].active ? i : some);
    return 1;
}

void spti_union_add(spti_union *lazy, const spt_rays *rays, size_t first, size_t size) {
    static const spti_record fresh = {-1, SPT_MISS, 0, 0, 1};
    const size_t window = lazy->count;
    spti_chunk *const chunk = &lazy->chunk;
    spti_record *const records = lazy->records + window;
    uint16_t *const alive = lazy->alive + window / SPTI_GROUP;
    lazy->count += size;
    for (size_t i = 0; i < size; ++i) records[i] = fresh;
    if (!pick_active(lazy, &rays->active, window, first, size)) return;
    spti_load_chunk(rays, chunk, size, first);
    spti_union_kernels_of[lazy->isa]->begin(lazy, window, size);
    for (size_t group = 0; group * SPTI_GROUP < size; ++group) {
        const unsigned bad = (unsigned)alive[group] & chunk->fates[group].bad;
        alive[group] = (uint16_t)(alive[group] & ~bad);
        for (unsigned i = 0; bad != 0 && i < SPTI_GROUP; ++i) {
            if (bad >> i & 1) records[group * SPTI_GROUP + i].outcome = SPT_BAD_RAY;
        }
    }
}

/* ---- Empty zones ---------------------------------------------------------------------------- */

static int has(const uint16_t *masks, size_t ray) {
    return masks[ray / SPTI_GROUP] >> ray % SPTI_GROUP & 1;
}

static void set(uint16_t *masks, size_t ray) {
    masks[ray / SPTI_GROUP] |= (uint16_t)(1u << ray % SPTI_GROUP);
}

static void clear(uint16_t *masks, size_t ray) {
    masks[ray / SPTI_GROUP] &= (uint16_t) ~(1u << ray % SPTI_GROUP);
}

/* A ray that is fresh for a component where an empty zone is jumps over it, and is asked again in
 * the next sweep; otherwise it is cut off where the next zone begins. */
static void clear_ray(spti_union *lazy, size_t place, size_t ray) {
    float *const key = &spti_union_state(lazy, place, SPTI_STATE_KEY)[ray];
    double origin[3], direction[3];
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = (double)spti_union_row(lazy, SPTI_ROW_ORIGIN + axis)[ray];
        direction[axis] = (double)spti_union_row(lazy, SPTI_ROW_DIRECTION + axis)[ray];
    }
    const spti_clearing found = spti_zone_clearing(
        lazy->zones, lazy->zone_count, (int32_t)lazy->list[place], origin, direction, *key);
    if (found.begin > *key) {
        const float last = spti_union_state(lazy, place, SPTI_STATE_EXIT)[ray];
        /* Whoever begins in the zone, or comes to it inside of the body, has not entered it. */
        const float own = spti_union_row(lazy, SPTI_ROW_T_MIN)[ray];
        const spti_clearing begins = spti_zone_clearing(
            lazy->zones, lazy->zone_count, (int32_t)lazy->list[place], origin, direction, own);
        const int outside =
            begins.begin < found.begin && !has(spti_union_masks(lazy, lazy->inside, place), ray);
        if (outside) set(spti_union_masks(lazy, lazy->cut, place), ray);
        *key = found.begin <= last ? found.begin : INFINITY;
        clear(spti_union_masks(lazy, lazy->inside, place), ray);
        clear(spti_union_masks(lazy, lazy->tasks, place), ray);
    }
    spti_union_state(lazy, place, SPTI_STATE_CLEAR)[ray] = found.end;
}

static void clear_tasks(spti_union *lazy, size_t place) {
    const uint16_t *const tasks = spti_union_masks(lazy, lazy->tasks, place);
    const uint16_t *const begun = spti_union_masks(lazy, lazy->begun, place);
    for (size_t ray = 0; ray < lazy->count; ++ray) {
        if (has(tasks, ray) && !has(begun, ray)) clear_ray(lazy, place, ray);
    }
}

/* ---- Leaving -------------------------------------------------------------------------------- */

/* Some of the rays that leave a chunk. */
typedef struct union_leavers {
    size_t count;
    uint16_t slots[SPT_BATCH], rays[SPT_BATCH];
} union_leavers;

static void copy_column(const union_leavers *leavers, const float *from, float *to) {
    for (size_t i = 0; i < leavers->count; ++i) to[leavers->rays[i]] = from[leavers->slots[i]];
}

/* Before the first march of a group is kept: its vectors are taken whole, and what stands for
 * nothing must be ordinary numbers. */
static void clear_states(spti_union *lazy, size_t group) {
    for (int what = SPTI_STATE_T; what <= SPTI_STATE_SCALE; ++what) {
        float *const state = spti_union_state(lazy, lazy->running, what) + group * SPTI_GROUP;
        memset(state, 0, SPTI_GROUP * sizeof *state);
    }
}

/* Keeps marches for later. */
static void save_marches(spti_union *lazy, const union_leavers *leavers) {
    static const unsigned char from[] = {SPTI_T,      SPTI_VALUE,     SPTI_PROBE,
                                         SPTI_MEMORY, SPTI_PENDING_T, SPTI_PENDING_VALUE,
                                         SPTI_SCALE};
    float(*const array)[SPTI_ROOM] = lazy->chunk.array;
    const size_t place = lazy->running;
    const float *const t = array[SPTI_T], *const value = array[SPTI_VALUE];
    const float *const scale = array[SPTI_SCALE];
    float *const key = spti_union_state(lazy, place, SPTI_STATE_KEY);
    uint16_t *const begun = spti_union_masks(lazy, lazy->begun, place);
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t ray = leavers->rays[i];
        if (begun[ray / SPTI_GROUP] == 0) clear_states(lazy, ray / SPTI_GROUP);
        set(begun, ray);
    }
    for (int what = SPTI_STATE_T; what <= SPTI_STATE_SCALE; ++what) {
        copy_column(leavers, array[from[what - SPTI_STATE_T]], spti_union_state(lazy, place, what));
    }
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        key[leavers->rays[i]] = t[slot] + value[slot] * scale[slot];
    }
}

/* The component is left without an event: until the zone at which it was cut off, and on behind
 * it. */
static void miss_until_zone(spti_union *lazy, size_t slot, size_t ray) {
    const size_t place = lazy->running;
    const float begin = spti_union_state(lazy, place, SPTI_STATE_CLEAR)[ray];
    if (begin <= spti_union_state(lazy, place, SPTI_STATE_EXIT)[ray]) {
        spti_union_state(lazy, place, SPTI_STATE_KEY)[ray] = begin;
    }
    clear(spti_union_masks(lazy, lazy->begun, place), ray);
    clear(spti_union_masks(lazy, lazy->cut, place), ray);
    clear(spti_union_masks(lazy, lazy->tasks, place), ray);
    if (lazy->chunk.array[SPTI_SCALE][slot] < 0.0f) {
        set(spti_union_masks(lazy, lazy->inside, place), ray);
    }
}

/* What rays take along to whatever comes next. */
static void keep_rays(const spti_call *call, const spti_leavers *leavers, spti_union *lazy) {
    static const struct {
        unsigned char wanted, from, to;
    } columns[] = {{SPTI_WANT_SLOPE, SPTI_STEEPEST, SPTI_ROW_STEEPEST},
                   {SPTI_WANT_FALLBACKS, SPTI_FALLBACKS, SPTI_ROW_FALLBACKS},
                   {SPTI_WANT_CANDIDATE, SPTI_CANDIDATE_T, SPTI_ROW_CANDIDATE_T},
                   {SPTI_WANT_CANDIDATE, SPTI_CANDIDATE_RATIO, SPTI_ROW_CANDIDATE_RATIO}};
    const float *const index = lazy->chunk.array[SPTI_INDEX];
    for (size_t k = 0; k < sizeof columns / sizeof *columns; ++k) {
        const float *const from = lazy->chunk.array[columns[k].from];
        float *const to = spti_union_row(lazy, columns[k].to);
        if (!(call->wants & columns[k].wanted)) continue;
        for (size_t i = 0; i < leavers->count; ++i) {
            const size_t slot = leavers->slots[i];
            to[(int)index[slot]] = from[slot];
        }
    }
    for (size_t i = 0; leavers->steep && i < leavers->count; ++i) {
        lazy->records[(int)index[leavers->slots[i]]].steep = 1;
    }
}

static void list_ray(union_leavers *leavers, size_t slot, size_t ray) {
    leavers->slots[leavers->count] = (uint16_t)slot;
    leavers->rays[leavers->count++] = (uint16_t)ray;
}

/* Ends the component on rays, at an event or without one, and lists those that it only stopped on,
 * and those that it missed. Nearly all rays meet what they turn to first, from outside, so that the
 * branches are foreseen. */
static void end_marches(spti_union *lazy, const spti_leavers *leavers, union_leavers *stopped,
                        union_leavers *missed) {
    float(*const array)[SPTI_ROOM] = lazy->chunk.array;
    const int32_t component = (int32_t)lazy->list[lazy->running];
    const uint16_t *const cut = spti_union_masks(lazy, lazy->cut, lazy->running);
    float *const key = spti_union_state(lazy, lazy->running, SPTI_STATE_KEY);
    float *const nearest = spti_union_row(lazy, SPTI_ROW_NEAREST);
    float *const value = spti_union_row(lazy, SPTI_ROW_VALUE);
    float *const row_spent = spti_union_row(lazy, SPTI_ROW_SPENT);
    spti_record *const records = lazy->records;
    const size_t count = leavers->count;
    const uint32_t age = leavers->age;
    uint32_t most_spent = lazy->most_spent;
    for (size_t i = 0; i < count; ++i) {
        const size_t slot = leavers->slots[i], ray = (size_t)(int)array[SPTI_INDEX][slot];
        const unsigned char outcome = leavers->outcomes[i];
        const float t = array[SPTI_T][slot];
        uint32_t spent;
        memcpy(&spent, &array[SPTI_SPENT][slot], sizeof spent);
        spent += age;
        memcpy(&row_spent[ray], &spent, sizeof spent);
        most_spent = spent > most_spent ? spent : most_spent;
        key[ray] = INFINITY;
        /* What shows its cut is entered there, not left. */
        if (array[SPTI_SCALE][slot] < 0.0f && !has(cut, ray)) records[ray].inside = 1;
        if (outcome == SPTI_STOPPED) {
            list_ray(stopped, slot, ray);
        } else if (outcome == SPT_MISS) {
            list_ray(missed, slot, ray);
        } else if (t < nearest[ray] || (t <= nearest[ray] && component < records[ray].component)) {
            nearest[ray] = t;
            value[ray] = array[SPTI_VALUE][slot];
            records[ray].component = component;
            records[ray].outcome = outcome;
        }
    }
    lazy->most_spent = most_spent;
}

void spti_union_leave(const spti_call *call, spti_chunk *chunk, spti_leavers *leavers,
                      size_t first) {
    spti_union *const lazy = call->owner;
    union_leavers stopped, missed;
    (void)chunk;
    (void)first;
    stopped.count = missed.count = 0;
    end_marches(lazy, leavers, &stopped, &missed);
    if (call->wants != 0 || leavers->steep) keep_rays(call, leavers, lazy);
    if (stopped.count > 0) save_marches(lazy, &stopped);
    for (size_t i = 0; lazy->zone_count > 0 && i < missed.count; ++i) {
        miss_until_zone(lazy, missed.slots[i], missed.rays[i]);
    }
}

/* ---- Sweeps --------------------------------------------------------------------------------- */

/* All rays whose nearest component it is: those it knows, the fresh ones, those at a cut. */
static void take_turn(spti_union *lazy, size_t place) {
    const spti_call *const call = &lazy->calls[lazy->list[place]];
    const size_t groups = spti_union_groups(lazy);
    lazy->running = place;
    for (int kind = SPTI_TASKS_BEGUN; kind <= SPTI_TASKS_CUT; ++kind) {
        if (kind == SPTI_TASKS_CUT && lazy->zone_count == 0) continue;
        for (size_t group = 0; group < groups && lazy->allowance > 0;) {
            const size_t count = spti_union_kernels_of[lazy->isa]->take(lazy, kind, &group);
            if (count == 0) continue;
            if (kind == SPTI_TASKS_CUT) { /* a first sample that is inside is on the cut */
                spti_call ends_inside = *call;
                ends_inside.settings.flags |= SPT_STOP_INSIDE;
                spti_run_chunk(&ends_inside, &lazy->chunk, count, 0, 0, 1);
            } else {
                spti_run_chunk(call, &lazy->chunk, count, 0, 0, kind != SPTI_TASKS_BEGUN);
            }
        }
    }
}

/* The budget is used up: the ray stays undecided where its nearest component is. */
static void run_out(spti_union *lazy, size_t ray) {
    const size_t place = (size_t)spti_union_row(lazy, SPTI_ROW_WHICH)[ray];
    if (!has(spti_union_masks(lazy, lazy->tasks, place), ray)) return; /* jumped over a zone */
    const int begun = has(spti_union_masks(lazy, lazy->begun, place), ray);
    lazy->records[ray].outcome = SPT_LIMIT;
    spti_union_row(lazy, SPTI_ROW_NEAREST)[ray] =
        spti_union_state(lazy, place, begun ? SPTI_STATE_T : SPTI_STATE_KEY)[ray];
    spti_union_row(lazy, SPTI_ROW_VALUE)[ray] =
        begun ? spti_union_state(lazy, place, SPTI_STATE_VALUE)[ray] : INFINITY;
    clear(lazy->alive, ray);
    clear(spti_union_masks(lazy, lazy->tasks, place), ray);
}

static void run_all_out(spti_union *lazy) {
    for (size_t ray = 0; ray < lazy->count; ++ray) {
        uint32_t spent;
        memcpy(&spent, &spti_union_row(lazy, SPTI_ROW_SPENT)[ray], sizeof spent);
        if (has(lazy->alive, ray) && spent >= lazy->budget) run_out(lazy, ray);
    }
}

int spti_union_run(spti_union *lazy) {
    /* In a sweep every ray spends an evaluation, is done with a component, or jumps over a zone. */
    const size_t most = lazy->budget + 2 * lazy->listed * (lazy->zone_count + 1) + 2;
    for (size_t sweep = 0; sweep < most; ++sweep) {
        if (!spti_union_kernels_of[lazy->isa]->plan(lazy)) return 1;
        if (lazy->allowance <= 0) return 0;
        for (size_t place = 0; lazy->zone_count > 0 && place < lazy->listed; ++place) {
            if (lazy->busy[place]) clear_tasks(lazy, place);
        }
        if (lazy->most_spent >= lazy->budget) run_all_out(lazy);
        for (size_t place = 0; place < lazy->listed; ++place) {
            if (lazy->busy[place]) take_turn(lazy, place);
        }
    }
    return 1;
}
