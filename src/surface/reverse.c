/* SPDX-License-Identifier: MIT
 *
 * Convex bodies in convex bounds (Keinert et al. 2014, section 3.5). Rays from outside are those of
 * spt_trace(): cases 1 and 2. A ray from inside, case 3, is marched backwards from where it leaves
 * the bound; the first surface on that way is the one exit of a convex body. The paper does not
 * look whether the body is convex: of another one this gives the last exit. What the march
 * evaluates anyhow is looked at here, and on demand the middle of the way as well.
 *
 * All in one march: once a chunk has its first samples, its rays from inside are replaced by their
 * ways back, and when these leave the chunk, what they found is brought to the rays' own t. */
#define SPT_LANES 1
#include <float.h>
#include <math.h>

#include "../trace/slot.h"
#include "landing.h"

/* What became of a ray at its first sample. */
enum {
    AS_IT_IS,     /* outside, or at its end */
    FROM_INSIDE,  /* turned: the start is deeper than the tolerance, */
    FROM_SURFACE, /* or within it, and to be skipped */
    FORWARD, /* traced through the inside: the way back has no beginning, or one too far away */
    SPENT    /* the budget does not allow a second sample */
};

/* The tolerance of the way back, over that of the ray. */
#define SHARPER 0.75f

/* A window of rays, by index in the chunk; t in the rays' own units. */
typedef struct reverse_window {
    const spt_rays *rays;
    size_t first;
    uint32_t flags; /* the caller's, of settings */
    unsigned char kind[SPT_BATCH];
    float t_start[SPT_BATCH], t_out[SPT_BATCH];
    float value[SPT_BATCH]; /* f at the start */
    float tolerance[SPT_BATCH];
    /* Rays that are to be traced again, forward. */
    size_t again_count;
    unsigned char again[SPT_BATCH]; /* index */
    uint32_t spent[SPT_BATCH], again_flags[SPT_BATCH];
    uint16_t picked[SPT_BATCH];   /* their numbers in the window */
    float again_start[SPT_BATCH]; /* t_start of the caller's */
} reverse_window;

/* ---- Turning back ---------------------------------------------------------------------------- */

static unsigned char kind_of(const spti_call *call, const spti_chunk *chunk,
                             const reverse_window *window, size_t slot, float tolerance) {
    const float value = chunk->distance[slot], t_out = chunk->array[SPTI_T_MAX][slot];
    const int near = fabsf(value * chunk->array[SPTI_SCALE][slot]) < tolerance;
    const int skips = (window->flags & SPT_SKIP_START) != 0 && !spti_enters(chunk, slot);
    if (near ? !skips : !(value < 0.0f && value >= -FLT_MAX)) return AS_IT_IS;
    if (call->settings.budget < 2) return SPENT;
    /* What is rounded where the way back begins stays in its end: of the largest magnitude M there,
     * 2u M each in the origin, in a sample, and in the point at the hit's t, and u M in that t, u =
     * 2^-24. An eighth of the tolerance leaves room for that, and for twice the floor within what
     * is SHARPER. A bound without end comes to that, too. */
    const float floor = ray_floor(chunk->array[SPTI_FLOOR_AT_0][slot], t_out);
    if (!(floor <= 0.125f * tolerance)) return FORWARD;
    return near ? FROM_SURFACE : FROM_INSIDE;
}

/* The way back of the ray in a slot. Its pixel cone is nowhere wider than the ray's own, by
 * SHARPER, which may leave none. */
static void turn_ray(spti_chunk *chunk, size_t slot) {
    const float t = chunk->array[SPTI_T][slot], t_out = chunk->array[SPTI_T_MAX][slot];
    const float span = t_out - t, path = SHARPER * (chunk->array[SPTI_PATH][slot] + t);
    for (int axis = 0; axis < 3; ++axis) {
        float *const direction = &chunk->array[SPTI_DIRECTION + axis][slot];
        chunk->array[SPTI_ORIGIN + axis][slot] = ray_point(chunk, axis, slot, t_out);
        *direction = -*direction;
    }
    chunk->array[SPTI_T][slot] = chunk->array[SPTI_PROBE][slot] = 0.0f;
    chunk->array[SPTI_T_MAX][slot] = span;
    chunk->array[SPTI_PATH][slot] = path - span;
    chunk->array[SPTI_EPSILON][slot] *= SHARPER;
    chunk->array[SPTI_FLOOR_AT_0][slot] += SPTI_FLOOR * t_out;
    spti_set_spent(chunk, slot, spti_spent(chunk, slot) + 1);
}

static uint32_t turn_back(const spti_call *call, spti_chunk *chunk, size_t count) {
    reverse_window *const window = call->owner;
    unsigned char turned[SPT_BATCH];
    size_t asked = 0;
    for (size_t slot = 0; slot < count; ++slot) {
        const size_t index = (size_t)chunk->array[SPTI_INDEX][slot];
        const float t = chunk->array[SPTI_T][slot];
        const float tolerance = spti_slot_tolerance(call, chunk, slot, t);
        const unsigned char kind = kind_of(call, chunk, window, slot, tolerance);
        window->kind[index] = kind;
        if (kind == AS_IT_IS) continue;
        window->t_start[index] = t;
        window->t_out[index] = chunk->array[SPTI_T_MAX][slot];
        window->value[index] = chunk->distance[slot];
        window->tolerance[index] = tolerance;
        if (kind == FORWARD || kind == SPENT) continue;
        turn_ray(chunk, slot);
        turned[asked++] = (unsigned char)slot;
    }
    if (asked == 0) return 0;
    memcpy(chunk->array[SPTI_VALUE], chunk->distance, sizeof chunk->distance);
    for (size_t i = 0; i < asked; ++i) spti_slot_point(chunk, turned[i], i, 0.0f);
    spti_pad_points(chunk, asked);
    spti_evaluate(call, chunk, asked);
    for (size_t i = 0; i < asked; ++i) {
        chunk->array[SPTI_VALUE][turned[i]] = chunk->distance[i];
    }
    memcpy(chunk->distance, chunk->array[SPTI_VALUE], sizeof chunk->distance);
    spti_pad_rays(call, chunk, count);
    for (size_t slot = count; slot % SPTI_GROUP != 0; ++slot) {
        chunk->distance[slot] = chunk->distance[0];
    }
    return 1;
}

/* ---- Coming back ----------------------------------------------------------------------------- */

/* Whether a ray's own t_max ends it inside the bound. */
static int is_cut(const spti_chunk *chunk, const reverse_window *window, size_t index) {
    const size_t ray = window->first + chunk->picked[index];
    const float t_max = spti_read(&window->rays->t_max, ray, INFINITY);
    return !(window->t_out[index] * chunk->unit[index] < t_max);
}

enum { BETRAYED = -1 };

/* How the ray of a way back ends; BETRAYED: the body is not what it was said to be. Brings t and
 * what else is written to the ray. */
static int come_back(spti_chunk *chunk, const reverse_window *window, size_t slot, size_t index,
                     int outcome) {
    const float start = window->t_start[index], out = window->t_out[index];
    const float q = chunk->array[SPTI_T][slot], tolerance = window->tolerance[index];
    const float scale = fabsf(chunk->array[SPTI_SCALE][slot]);
    const int stopped = chunk->array[SPTI_SCALE][slot] < 0.0f; /* at t_out, and inside */
    const int deep = stopped && !(-chunk->array[SPTI_VALUE][slot] * scale < tolerance);
    const float t = out - q > start ? out - q : start;
    chunk->array[SPTI_T][slot] = t;
    chunk->array[SPTI_CANDIDATE_RATIO][slot] = INFINITY; /* that of the way back means nothing */
    if (outcome == SPT_MISS) return window->kind[index] == FROM_INSIDE ? BETRAYED : SPT_MISS;
    if (outcome == SPT_HIT && deep) return is_cut(chunk, window, index) ? SPT_MISS : BETRAYED;
    if (outcome == SPT_HIT && window->kind[index] == FROM_SURFACE &&
        !(t - start > 2.0f * tolerance)) {
        chunk->array[SPTI_SCALE][slot] = scale;
        return SPT_MISS; /* nothing but its own start */
    }
    chunk->array[SPTI_SCALE][slot] = -scale; /* SPT_FLAG_INSIDE */
    if (outcome == SPT_LIMIT) {
        chunk->array[SPTI_T][slot] = start;
        chunk->array[SPTI_VALUE][slot] = window->value[index];
    }
    return outcome;
}

static void trace_again(reverse_window *window, const spti_chunk *chunk, size_t index,
                        uint32_t spent, uint32_t flags) {
    const size_t at = window->again_count++;
    window->again[at] = (unsigned char)index;
    window->picked[at] = chunk->picked[index];
    window->spent[at] = spent;
    window->again_flags[at] = flags;
    window->again_start[at] = window->t_start[index] * chunk->unit[index];
}

/* Whether the middle of a ray's way is to be looked at: of all on demand, and of those from the
 * surface, since a way back may end within the tolerance of a shallow ray that leaves. */
static int is_looked_at(const reverse_window *window, size_t index) {
    return window->kind[index] == FROM_SURFACE ||
           (window->kind[index] == FROM_INSIDE && (window->flags & SPT_CHECK_CONVEX) != 0);
}

/* What f in the middle of the way from start to exit says. f of a convex body falls from the start
 * on if the ray runs into it, and the middle is inside. */
static int judge_middle(const spti_chunk *chunk, const reverse_window *window, size_t slot,
                        size_t index, float value) {
    const float radius = value * fabsf(chunk->array[SPTI_SCALE][slot]);
    if (window->kind[index] == FROM_SURFACE && !(value < window->value[index])) return SPT_MISS;
    if ((window->flags & SPT_CHECK_CONVEX) == 0) return SPT_HIT;
    return radius <= window->tolerance[index] ? SPT_HIT : BETRAYED;
}

/* Looks at the middles of the leavers' ways, as far as they have the budget. */
static SPTI_NOINLINE void look_at_middles(const spti_call *call, spti_chunk *chunk,
                                          const reverse_window *window, spti_leavers *leavers,
                                          int outcomes[SPT_BATCH]) {
    SPTI_ALIGNED(64) float point[3][SPT_BATCH], distance[SPT_BATCH];
    unsigned char places[SPT_BATCH];
    size_t count = 0;
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        const size_t index = (size_t)chunk->array[SPTI_INDEX][slot];
        if (outcomes[i] != SPT_HIT || !is_looked_at(window, index)) continue;
        if (leavers->age + spti_spent(chunk, slot) >= call->settings.budget) {
            outcomes[i] = SPT_LIMIT;
            chunk->array[SPTI_T][slot] = window->t_start[index];
            chunk->array[SPTI_VALUE][slot] = window->value[index];
            continue;
        }
        const float t = chunk->array[SPTI_T][slot];
        const float middle = 0.5f * window->t_start[index] + 0.5f * t;
        for (int axis = 0; axis < 3; ++axis) {
            point[axis][count] = ray_point(chunk, axis, slot, window->t_out[index] - middle);
        }
        spti_set_spent(chunk, slot, spti_spent(chunk, slot) + 1);
        places[count++] = (unsigned char)i;
    }
    if (count == 0) return;
    spti_ask(&call->field, count, point[0], point[1], point[2], distance);
    for (size_t k = 0; k < count; ++k) {
        const size_t slot = leavers->slots[places[k]];
        const size_t index = (size_t)chunk->array[SPTI_INDEX][slot];
        const int outcome = judge_middle(chunk, window, slot, index, distance[k]);
        outcomes[places[k]] = outcome;
        if (outcome == SPT_MISS) {
            chunk->array[SPTI_SCALE][slot] = fabsf(chunk->array[SPTI_SCALE][slot]);
        }
    }
    spti_count_asked(call, count);
}

/* The leave of such calls. */
static void leave(const spti_call *call, spti_chunk *chunk, spti_leavers *leavers, size_t first) {
    reverse_window *const window = call->owner;
    int outcomes[SPT_BATCH];
    size_t kept = 0;
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        const size_t index = (size_t)chunk->array[SPTI_INDEX][slot];
        const unsigned char kind = window->kind[index];
        outcomes[i] = leavers->outcomes[i];
        if (kind == FROM_INSIDE || kind == FROM_SURFACE) {
            outcomes[i] = come_back(chunk, window, slot, index, outcomes[i]);
        } else if (kind == SPENT) {
            outcomes[i] = SPT_LIMIT;
            chunk->array[SPTI_CANDIDATE_RATIO][slot] = INFINITY;
        }
    }
    if ((window->flags & (SPT_CHECK_CONVEX | SPT_SKIP_START)) != 0) {
        look_at_middles(call, chunk, window, leavers, outcomes);
    }
    for (size_t i = 0; i < leavers->count; ++i) {
        const size_t slot = leavers->slots[i];
        const size_t index = (size_t)chunk->array[SPTI_INDEX][slot];
        const uint32_t spent = leavers->age + spti_spent(chunk, slot);
        if (window->kind[index] == FORWARD) {
            trace_again(window, chunk, index, spent, 0);
        } else if (outcomes[i] == BETRAYED) {
            trace_again(window, chunk, index, spent, SPT_FLAG_NOT_CONVEX);
        } else {
            leavers->slots[kept] = (uint16_t)slot;
            leavers->outcomes[kept++] = (unsigned char)outcomes[i];
        }
    }
    leavers->count = kept;
    if (kept > 0) spti_write_hits(call, chunk, leavers, first);
}

/* ---- Going forward --------------------------------------------------------------------------- */

/* The view of one ray's results. */
static spt_hits hits_from(const spt_hits *hits, size_t ray) {
    spt_hits from = *hits;
    spt_sink *const sinks[] = {&from.t,           &from.residual,        &from.outcome,
                               &from.evaluations, &from.flags,           &from.component,
                               &from.candidate_t, &from.candidate_ratio, &from.fallbacks};
    for (size_t i = 0; i < sizeof sinks / sizeof *sinks; ++i) {
        if (sinks[i]->first == NULL) continue;
        sinks[i]->first = (char *)sinks[i]->first + (ptrdiff_t)ray * sinks[i]->stride;
    }
    return from;
}

/* One whose budget is spent: it ends where it began. */
static void end_at_start(const spti_call *call, const reverse_window *window, size_t at,
                         const spt_hits *hits) {
    const uint32_t flags = SPT_FLAG_INSIDE | window->again_flags[at];
    spti_write(&hits->t, 0, window->again_start[at]);
    spti_write(&hits->residual, 0, window->value[window->again[at]]);
    spti_write_integer(&hits->outcome, 0, SPT_LIMIT);
    spti_write_integer(&hits->evaluations, 0, (int32_t)window->spent[at]);
    spti_write_integer(&hits->flags, 0, (int32_t)flags);
    spti_write_integer(&hits->component, 0, -1);
    spti_write(&hits->candidate_t, 0, INFINITY);
    spti_write(&hits->candidate_ratio, 0, INFINITY);
    spti_write_integer(&hits->fallbacks, 0, 0);
    if (call->statistics != NULL) {
        call->statistics->rays += 1;
        call->statistics->outcomes[SPT_LIMIT] += 1;
    }
}

/* Rays that are traced through the inside. The budget is each one's own, so they go one by one. */
static void go_forward(const spti_call *call, const reverse_window *window) {
    spt_settings settings = call->settings;
    settings.flags = window->flags;
    for (size_t i = 0; i < window->again_count; ++i) {
        const size_t ray = window->first + window->picked[i];
        const spt_rays rays = spti_rays_from(call->rays, ray);
        const spt_hits hits = hits_from(call->hits, ray);
        const uint32_t spent = window->spent[i], budget = call->settings.budget;
        const spt_column evaluations = spti_column_of(&hits.evaluations);
        const spt_column flags = spti_column_of(&hits.flags);
        if (spent >= budget) {
            end_at_start(call, window, i, &hits);
            continue;
        }
        settings.budget = budget - spent;
        spt_trace(&call->field, &settings, 1, &rays, &hits, call->statistics);
        const uint32_t more = (uint32_t)spti_read_integer(&evaluations, 0, 0) + spent;
        const uint32_t all = (uint32_t)spti_read_integer(&flags, 0, 0) | window->again_flags[i];
        spti_write_integer(&hits.evaluations, 0, (int32_t)more);
        spti_write_integer(&hits.flags, 0, (int32_t)all);
        spti_write(&hits.candidate_t, 0, INFINITY);
        spti_write(&hits.candidate_ratio, 0, INFINITY);
    }
}

/* ---- The call -------------------------------------------------------------------------------- */

static void trace_window(spti_call *call, size_t first, size_t count, uint32_t flags) {
    reverse_window window;
    window.rays = call->rays;
    window.first = first;
    window.flags = flags;
    window.again_count = 0;
    memset(window.kind, AS_IT_IS, sizeof window.kind);
    call->owner = &window;
    spti_trace_window(call, first, count);
    go_forward(call, &window);
}

spt_status spt_trace_convex(const spt_field *field, const spt_settings *settings, size_t count,
                            const spt_rays *rays, const spt_hits *hits,
                            spt_statistics *statistics) {
    spti_call call;
    spt_settings given;
    memset(&call, 0, sizeof call);
    if (!spti_door(field, 1, settings, &given, count, rays, hits)) return SPT_BAD_ARGUMENT;
    spti_field_copy(&call.field, &call.bound, field);
    if (call.field.bound == NULL || (given.flags & SPT_STOP_INSIDE) != 0 ||
        !spti_method_allowed(given.method, &call.field) ||
        (statistics != NULL && statistics->struct_size < sizeof *statistics)) {
        return SPT_BAD_ARGUMENT;
    }
    if (count == 0) return SPT_OK;
    call.field.bound = &call.bound;
    call.settings = given;
    call.settings.flags = (given.flags & ~(uint32_t)SPT_SKIP_START) | SPT_STOP_INSIDE;
    if ((call.field.flags & SPT_FIELD_CONVEX) != 0) call.settings.method = spt_convex();
    call.rays = rays;
    call.hits = hits;
    call.statistics = statistics;
    call.leave = leave;
    call.turn = turn_back;
    spti_call_settle(&call);
    if (statistics != NULL) statistics->lanes = (uint32_t)spti_isa_lanes(call.isa);
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        trace_window(&call, first, spti_window(first, count), given.flags);
    }
    return SPT_OK;
}
