/* SPDX-License-Identifier: MIT
 *
 * Where the rays of a lazy union enter the bounds of its components. */
#include <math.h>

#include "../bound/bound_check.h"
#include "union.h"

/* Copies the picked rays into the chunk, which is free between tasks: into arrays that the next
 * ones write anew. The last group is filled up by the first ray. */
static void gather(spti_union *lazy, size_t count) {
    for (int axis = 0; axis < 3; ++axis) {
        const float *const origin = spti_union_row(lazy, SPTI_ROW_ORIGIN + axis);
        const float *const direction = spti_union_row(lazy, SPTI_ROW_DIRECTION + axis);
        float *const to = lazy->chunk.array[SPTI_X + axis];
        float *const along = lazy->chunk.array[SPTI_DIRECTION + axis];
        for (size_t i = 0; i < count || i % SPTI_GROUP != 0; ++i) {
            const size_t ray = lazy->chunk.picked[i < count ? i : 0];
            to[i] = origin[ray];
            along[i] = direction[ray];
        }
    }
}

/* Asks the component's volume for the picked rays, and cuts what is known of them. */
static void narrow(spti_union *lazy, size_t place, size_t count) {
    float(*const array)[SPTI_ROOM] = lazy->chunk.array;
    const float *const origin[3] = {array[SPTI_X], array[SPTI_Y], array[SPTI_Z]};
    const float *const direction[3] = {array[SPTI_DIRECTION], array[SPTI_DIRECTION + 1],
                                       array[SPTI_DIRECTION + 2]};
    float *const t_in = array[SPTI_T], *const t_out = array[SPTI_T_MAX];
    float *const key = spti_union_state(lazy, place, SPTI_STATE_KEY);
    float *const leaves = spti_union_state(lazy, place, SPTI_STATE_EXIT);
    gather(lazy, count);
    spti_bound_ask(lazy->calls[lazy->list[place]].march.bound, count, origin, direction, t_in,
                   t_out);
    for (size_t i = 0; i < count; ++i) {
        const size_t ray = lazy->chunk.picked[i];
        if (!spti_bound_cut(t_in[i], t_out[i], &key[ray], &leaves[ray])) key[ray] = INFINITY;
    }
}

/* The same for all rays that are not at their end and meet the box around the volume. */
static void narrow_all(spti_union *lazy, size_t place) {
    const float *const key = spti_union_state(lazy, place, SPTI_STATE_KEY);
    size_t count = 0;
    for (size_t ray = 0; ray < lazy->count; ++ray) {
        const int alive = lazy->alive[ray / SPTI_GROUP] >> ray % SPTI_GROUP & 1;
        if (!alive || !(key[ray] < INFINITY)) continue;
        lazy->chunk.picked[count++] = (uint16_t)ray;
        if (count < SPT_BATCH) continue;
        narrow(lazy, place, count);
        count = 0;
    }
    if (count > 0) narrow(lazy, place, count);
}

void spti_union_enter(spti_union *lazy, const float *starts) {
    const size_t masks = lazy->listed * (lazy->pool / SPTI_GROUP);
    memset(lazy->begun, 0, masks * sizeof *lazy->begun);
    memset(lazy->cut, 0, masks * sizeof *lazy->cut);
    memset(lazy->inside, 0, masks * sizeof *lazy->inside);
    for (size_t place = 0; place < lazy->listed; ++place) {
        spti_union_kernels_of[lazy->isa]->enter(
            lazy, place, starts != NULL ? starts + place * lazy->pool : NULL);
        if (spti_bound_asks(lazy->calls[lazy->list[place]].march.bound)) narrow_all(lazy, place);
    }
}
