/* SPDX-License-Identifier: MIT
 *
 * Discontinuity reduction (Keinert et al. 2014, section 3.4): hits are moved to where f equals the
 * allowance of the pixel cone. Equation 3 is read as p + d (f - err), and guarded: it converges
 * only where f - err falls along the ray by less than twice the way, so a move is kept only if it
 * brings f closer. The cap on a move is |f| + err: with |f| alone, hits head-on could not move
 * back. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "landing.h"

enum { MOST_ITERATIONS = 16 };

/* Hits on their way; beside the landing's arrays, by slot. */
typedef struct refining {
    float side[SPT_BATCH]; /* that the ray came from: +1 or -1 */
    float t_min[SPT_BATCH], t_max[SPT_BATCH];
    float residual[SPT_BATCH];
    float gap[SPT_BATCH]; /* f / lipschitz - allowance, world length */
    float next[SPT_BATCH];
    uint32_t rounds[SPT_BATCH]; /* evaluations spent */
    uint16_t moving[SPT_BATCH]; /* slots that are still to be moved */
    size_t moving_count;
} refining;

static float gap_of(const spti_target *target, const spt_settings *settings,
                    const spti_landing *landing, const refining *state, size_t slot, float t,
                    float residual) {
    return state->side[slot] * residual * target->inverse_lipschitz -
           spti_allowance(settings, landing, slot, t);
}

/* Which hits may move, and how they stand. */
static void begin(const spti_target *target, const spt_settings *settings, const spti_wish *wish,
                  const spti_landing *landing, refining *state) {
    const spt_column residuals = spti_column_of(&wish->hits->residual);
    const spt_column flags = spti_column_of(&wish->hits->flags);
    state->moving_count = 0;
    for (size_t slot = 0; slot < landing->count; ++slot) {
        const size_t index = wish->first + landing->place[slot];
        const uint32_t flag = (uint32_t)spti_read_integer(&flags, index, 0);
        const float residual = spti_read(&residuals, index, 0.0f);
        state->side[slot] = (flag & SPT_FLAG_INSIDE) != 0 ? -1.0f : 1.0f;
        state->t_min[slot] = spti_read(&wish->rays->t_min, index, 0.0f);
        state->t_max[slot] = spti_read(&wish->rays->t_max, index, INFINITY);
        state->residual[slot] = residual;
        state->rounds[slot] = 0;
        if ((flag & SPT_FLAG_STEEP) != 0 || !spti_finite(residual)) continue;
        /* Where a zone cuts a body, or a ray began inside, a hit is no root to converge to. */
        if (!spti_converged(target, settings, landing, slot, residual)) continue;
        state->gap[slot] =
            gap_of(target, settings, landing, state, slot, landing->t[slot], residual);
        if (!spti_finite(state->gap[slot])) continue;
        state->moving[state->moving_count++] = (uint16_t)slot;
    }
}

/* Where each moving hit is to be tried next; those that cannot move stay. */
static void propose(const spti_target *target, const spt_settings *settings, spti_landing *landing,
                    refining *state) {
    size_t kept = 0;
    for (size_t i = 0; i < state->moving_count; ++i) {
        const size_t slot = state->moving[i];
        const float t = landing->t[slot], gap = state->gap[slot];
        const float most = fabsf(state->residual[slot]) * target->inverse_lipschitz +
                           spti_allowance(settings, landing, slot, t);
        const float move = gap < -most ? -most : gap > most ? most : gap;
        float next = t + move / landing->length[slot];
        if (next > state->t_max[slot]) next = state->t_max[slot];
        if (next < state->t_min[slot]) next = state->t_min[slot];
        if (!(next < t) && !(next > t)) continue;
        state->next[slot] = next;
        landing->x[kept] = spti_point(landing, 0, slot, next);
        landing->y[kept] = spti_point(landing, 1, slot, next);
        landing->z[kept] = spti_point(landing, 2, slot, next);
        if (!spti_finite(landing->x[kept]) || !spti_finite(landing->y[kept]) ||
            !spti_finite(landing->z[kept])) {
            continue;
        }
        state->moving[kept++] = (uint16_t)slot;
    }
    state->moving_count = kept;
}

/* Takes the moves that brought f closer. NaN does not. */
static void take(const spti_target *target, const spt_settings *settings, spti_landing *landing,
                 refining *state) {
    size_t kept = 0;
    for (size_t i = 0; i < state->moving_count; ++i) {
        const size_t slot = state->moving[i];
        const float residual = landing->distance[i], next = state->next[slot];
        const float gap = gap_of(target, settings, landing, state, slot, next, residual);
        state->rounds[slot] += 1;
        if (!(fabsf(gap) < fabsf(state->gap[slot]))) continue;
        state->gap[slot] = gap;
        state->residual[slot] = residual;
        landing->t[slot] = next;
        state->moving[kept++] = (uint16_t)slot;
    }
    state->moving_count = kept;
}

static void finish(const spti_wish *wish, const spti_landing *landing, const refining *state) {
    const spt_column evaluations = spti_column_of(&wish->hits->evaluations);
    for (size_t slot = 0; slot < landing->count; ++slot) {
        const size_t index = wish->first + landing->place[slot];
        if (state->rounds[slot] == 0) continue;
        spti_write(&wish->hits->t, index, landing->t[slot]);
        spti_write(&wish->hits->residual, index, state->residual[slot]);
        const uint32_t spent = (uint32_t)spti_read_integer(&evaluations, index, 0);
        spti_write_integer(&wish->hits->evaluations, index, (int32_t)(spent + state->rounds[slot]));
    }
}

static void refine_window(const spti_target *target, const spt_settings *settings,
                          uint32_t iterations, const spti_wish *wish) {
    spti_landing landing;
    refining state;
    spti_land(wish, &landing);
    begin(target, settings, wish, &landing, &state);
    for (uint32_t round = 0; round < iterations; ++round) {
        propose(target, settings, &landing, &state);
        if (state.moving_count == 0) break;
        spti_ask(&target->field, state.moving_count, landing.x, landing.y, landing.z,
                 landing.distance);
        take(target, settings, &landing, &state);
    }
    finish(wish, &landing, &state);
}

spt_status spt_refine(const spt_field *fields, size_t field_count, const spt_settings *settings,
                      uint32_t iterations, size_t count, const spt_rays *rays,
                      const spt_hits *hits) {
    spt_settings copy;
    if (!spti_door(fields, field_count, settings, &copy, count, rays, hits)) {
        return SPT_BAD_ARGUMENT;
    }
    if (iterations > MOST_ITERATIONS) return SPT_BAD_ARGUMENT;
    if (count > 0 &&
        (hits->t.first == NULL || hits->residual.first == NULL || hits->outcome.first == NULL)) {
        return SPT_BAD_ARGUMENT;
    }
    if (iterations == 0) return SPT_OK;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        spti_wish wish;
        spti_wish_begin(&wish, rays, hits, first, count, field_count);
        for (; wish.component >= 0; spti_wish_next(&wish)) {
            spti_target target;
            spti_target_of(&target, fields, (size_t)wish.component, &copy);
            refine_window(&target, &copy, iterations, &wish);
        }
    }
    return SPT_OK;
}
