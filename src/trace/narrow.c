/* SPDX-License-Identifier: MIT
 *
 * What a caller's own bounding volume says of rays that are about to be traced. In plain C: its
 * callback takes longer than that, and is not to be called among vectors. */
#define SPT_LANES 1
#include "narrow.h"

#include "../bound/bound_check.h"
#include "slot.h"

/* The ray in a slot begins at t. The same operations as of prepare_vector(). */
static void begin_at(const spti_call *call, spti_chunk *chunk, size_t slot, float t) {
    const float own = chunk->array[SPTI_PROBE][slot];
    const float tolerance = spti_slot_tolerance(call, chunk, slot, t);
    spti_slot_point(chunk, slot, slot, t);
    chunk->array[SPTI_T][slot] = chunk->array[SPTI_PROBE][slot] = t;
    chunk->array[SPTI_PENDING_VALUE][slot] = own + tolerance < t ? 1.0f : 0.0f;
}

int spti_narrow_chunk(const spti_call *call, spti_chunk *chunk, size_t count) {
    float(*const array)[SPTI_ROOM] = chunk->array;
    const float *const origin[3] = {array[SPTI_ORIGIN], array[SPTI_ORIGIN + 1],
                                    array[SPTI_ORIGIN + 2]};
    const float *const direction[3] = {array[SPTI_DIRECTION], array[SPTI_DIRECTION + 1],
                                       array[SPTI_DIRECTION + 2]};
    /* Arrays that hold nothing yet, or what is made anew below. */
    float *const t_in = chunk->distance, *const t_out = array[SPTI_X];
    int any = 0;
    spti_bound_ask(call->march.bound, count, origin, direction, t_in, t_out);
    memset(chunk->fates, 0, sizeof chunk->fates);
    for (size_t slot = 0; slot < count; ++slot) {
        const float before = array[SPTI_T][slot];
        float t = before;
        const int met = spti_bound_cut(t_in[slot], t_out[slot], &t, &array[SPTI_T_MAX][slot]);
        if (!met) {
            spti_fates *const fates = &chunk->fates[slot / SPTI_GROUP];
            fates->missed = fates->finished |= (uint16_t)(1u << slot % SPTI_GROUP);
            any = 1;
        }
        begin_at(call, chunk, slot, met ? t : before);
    }
    spti_pad_rays(call, chunk, count);
    return any;
}
