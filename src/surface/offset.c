/* SPDX-License-Identifier: MIT
 *
 * Dynamic epsilon (Keinert et al. 2014, section 3.3): origins of secondary rays at twice the
 * tolerance that the next ray will have, on the side that is asked for. The paper moves the point
 * by 2 max(epsilon, |f|), which leaves it between |f| and 2 epsilon - |f| of the surface: after a
 * stop at half a pixel that is within the tolerance, and each secondary ray hits at once. Here the
 * clearance that the point has is taken into account, and the outcome is looked at. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "landing.h"

enum { MOST_CHECKS = 4 };

/* Depths behind the surface, over the first choice, in the order in which they are tried: half for
 * a gap or a sheet thinner than the offset, more for a bound that underestimates. */
static const float depths[MOST_CHECKS] = {1.0f, 0.5f, 2.0f, 4.0f};

/* What becomes of the hits of a landing, by slot. */
typedef struct offsets {
    float origin[3][SPT_BATCH];  /* the best so far */
    float towards[3][SPT_BATCH]; /* the unit normal on the side that is asked for */
    float sign[SPT_BATCH];       /* of f on that side */
    float clearance[SPT_BATCH];  /* of the hit point on that side, world length */
    float depth[SPT_BATCH];      /* first choice */
    float best[SPT_BATCH];       /* clearance of the best so far */
    int32_t start[SPT_BATCH];
    uint16_t open[SPT_BATCH]; /* slots that still look for a place */
    size_t open_count;
} offsets;

typedef struct offset_call {
    const spti_target *target;
    const spt_settings *settings;
    const spti_wish *wish;
    const spt_vectors *normals;
    const spt_column *cross;
    uint32_t checks;
} offset_call;

/* Reads what a hit's offset depends on. Returns whether it has a normal. */
static int read_hit(const offset_call *call, const spti_landing *landing, size_t slot,
                    offsets *state) {
    const spt_column residuals = spti_column_of(&call->wish->hits->residual);
    const spt_column flags = spti_column_of(&call->wish->hits->flags);
    const size_t index = call->wish->first + landing->place[slot];
    const int inside = (spti_read_integer(&flags, index, 0) & SPT_FLAG_INSIDE) != 0;
    const int crosses = call->cross != NULL && spti_read_integer(call->cross, index, 0) != 0;
    const float sign = inside != crosses ? -1.0f : 1.0f;
    const float residual = spti_read(&residuals, index, 0.0f);
    const float tolerance = spti_landing_tolerance(call->target, call->settings, landing, slot);
    int there = spti_converged(call->target, call->settings, landing, slot, residual);
    float square = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float normal = spti_read(&call->normals->axis[axis], index, 0.0f);
        state->towards[axis][slot] = sign * normal;
        state->origin[axis][slot] = spti_point(landing, axis, slot, landing->t[slot]);
        square += normal * normal;
    }
    state->sign[slot] = sign;
    state->clearance[slot] = sign * residual * call->target->inverse_lipschitz;
    state->depth[slot] = 2.0f * tolerance;
    state->best[slot] = 0.0f;
    state->start[slot] = SPT_START_AT_HIT;
    there = there && spti_within(square, 0.25f, 4.0f); /* of unit length, or none */
    return there && spti_finite(state->depth[slot]) && spti_finite(state->clearance[slot]);
}

/* The point of a slot at a depth, into the landing's place i. */
static void place(const offsets *state, size_t slot, float depth, spti_landing *landing, size_t i) {
    const float way = depth - state->clearance[slot];
    float *const to[3] = {landing->x, landing->y, landing->z};
    for (int axis = 0; axis < 3; ++axis) {
        const float from = spti_point(landing, axis, slot, landing->t[slot]);
        to[axis][i] = way > 0.0f ? from + way * state->towards[axis][slot] : from;
    }
}

static void keep(offsets *state, size_t slot, const spti_landing *landing, size_t i,
                 spt_start start) {
    state->origin[0][slot] = landing->x[i];
    state->origin[1][slot] = landing->y[i];
    state->origin[2][slot] = landing->z[i];
    state->start[slot] = (int32_t)start;
}

/* The path of the next ray before its own start. */
static float path_of(const spti_landing *landing, size_t slot) {
    const float path = landing->path[slot] + landing->length[slot] * landing->t[slot];
    return path < FLT_MAX ? path : FLT_MAX;
}

/* The tolerance that a ray has at its own start, at place i. */
static float next_tolerance(const offset_call *call, const spti_landing *landing, size_t slot,
                            size_t i) {
    float reach = fabsf(landing->x[i]);
    if (fabsf(landing->y[i]) > reach) reach = fabsf(landing->y[i]);
    if (fabsf(landing->z[i]) > reach) reach = fabsf(landing->z[i]);
    return spti_tolerance(call->target, call->settings, path_of(landing, slot), reach);
}

/* Tries one depth for all hits that still look for a place. */
static void try_depth(const offset_call *call, float depth, spti_landing *landing, offsets *state) {
    size_t kept = 0, asked = 0;
    for (size_t i = 0; i < state->open_count; ++i) {
        const size_t slot = state->open[i];
        place(state, slot, depth * state->depth[slot], landing, asked);
        if (!spti_finite(landing->x[asked]) || !spti_finite(landing->y[asked]) ||
            !spti_finite(landing->z[asked])) {
            continue;
        }
        state->open[asked++] = (uint16_t)slot;
    }
    spti_ask(&call->target->field, asked, landing->x, landing->y, landing->z, landing->distance);
    for (size_t i = 0; i < asked; ++i) {
        const size_t slot = state->open[i];
        /* Anew: the callback may have used its points. */
        place(state, slot, depth * state->depth[slot], landing, i);
        const float clearance =
            state->sign[slot] * landing->distance[i] * call->target->inverse_lipschitz;
        const int clear = clearance > next_tolerance(call, landing, slot, i);
        if (clear || clearance > state->best[slot]) {
            keep(state, slot, landing, i, clear ? SPT_START_CLEAR : SPT_START_NEAR);
            state->best[slot] = clearance;
        }
        if (!clear) state->open[kept++] = (uint16_t)slot;
    }
    state->open_count = kept;
}

/* Without a look: f is trusted. */
static void trust(spti_landing *landing, offsets *state) {
    for (size_t i = 0; i < state->open_count; ++i) {
        const size_t slot = state->open[i];
        place(state, slot, state->depth[slot], landing, 0);
        if (spti_finite(landing->x[0]) && spti_finite(landing->y[0]) &&
            spti_finite(landing->z[0])) {
            keep(state, slot, landing, 0, SPT_START_CLEAR);
        }
    }
}

static void write(const offset_call *call, const spti_landing *landing, const offsets *state,
                  const spt_starts *starts) {
    for (size_t slot = 0; slot < landing->count; ++slot) {
        const size_t index = call->wish->first + landing->place[slot];
        for (int axis = 0; axis < 3; ++axis) {
            spti_write(&starts->origin.axis[axis], index, state->origin[axis][slot]);
        }
        spti_write(&starts->path, index, path_of(landing, slot));
        spti_write_integer(&starts->start, index, state->start[slot]);
    }
}

static void offset_window(const offset_call *call, const spt_starts *starts) {
    spti_landing landing;
    offsets state;
    spti_land(call->wish, &landing);
    state.open_count = 0;
    for (size_t slot = 0; slot < landing.count; ++slot) {
        if (!read_hit(call, &landing, slot, &state)) continue;
        if (state.clearance[slot] >= state.depth[slot]) {
            state.start[slot] = SPT_START_CLEAR; /* where it is */
        } else {
            state.open[state.open_count++] = (uint16_t)slot;
        }
    }
    if (call->checks == 0) trust(&landing, &state);
    for (uint32_t check = 0; check < call->checks && state.open_count > 0; ++check) {
        try_depth(call, depths[check], &landing, &state);
    }
    write(call, &landing, &state, starts);
}

static int starts_fit(const spt_starts *starts, size_t count) {
    return spti_sinks_fit(&starts->origin, count) && spti_sink_fits(&starts->path, count) &&
           spti_sink_fits(&starts->start, count);
}

spt_status spt_offset(const spt_field *fields, size_t field_count, const spt_settings *settings,
                      size_t count, const spt_rays *rays, const spt_hits *hits,
                      const spt_vectors *normals, const spt_column *cross, uint32_t checks,
                      const spt_starts *starts) {
    spt_settings copy;
    if (!spti_door(fields, field_count, settings, &copy, count, rays, hits)) {
        return SPT_BAD_ARGUMENT;
    }
    if (checks > MOST_CHECKS) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (hits->t.first == NULL || hits->residual.first == NULL || hits->outcome.first == NULL ||
        normals == NULL || starts == NULL || !spti_vectors_fit(normals, count) ||
        !starts_fit(starts, count) || (cross != NULL && !spti_column_fits(cross, count))) {
        return SPT_BAD_ARGUMENT;
    }
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        spti_wish wish;
        spti_wish_begin(&wish, rays, hits, first, count, field_count);
        for (; wish.component >= 0; spti_wish_next(&wish)) {
            spti_target target;
            const offset_call call = {&target, &copy, &wish, normals, cross, checks};
            spti_target_of(&target, fields, (size_t)wish.component, &copy);
            offset_window(&call, starts);
        }
    }
    return SPT_OK;
}
