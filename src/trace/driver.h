/* SPDX-License-Identifier: MIT
 *
 * What the files of the driver share: the call that is running. */
#ifndef SPTI_DRIVER_H
#define SPTI_DRIVER_H

#include "method.h"

typedef struct spti_call {
    spt_field field;
    spt_bound bound;
    spt_settings settings;
    spti_march march;
    const spt_rays *rays;
    const spt_hits *hits;
    spt_statistics *statistics; /* the caller's, or NULL */
    spti_isa isa;
    spti_march_fn *pass;
    unsigned wants;
    unsigned char arrays[SPTI_ARRAYS]; /* those that follow the rays in this call */
    size_t array_count;
} spti_call;

/* Rays that leave a chunk together. */
typedef struct spti_leavers {
    size_t count;
    uint32_t age; /* passes they were in */
    int steep;    /* a bracket betrayed the field */
    uint16_t slots[SPT_BATCH];
    unsigned char outcomes[SPT_BATCH];
    unsigned char indices[SPT_BATCH]; /* where they were loaded, and */
    unsigned char rays[SPT_BATCH];    /* which rays of the window they are: set when written */
} spti_leavers;

/* Takes in a caller's field and the bound it points to; 0 where either breaks its rules. */
int spti_field_copy(spt_field *to, spt_bound *bound, const spt_field *from);

/* Traces the rays first .. first + window - 1, window <= SPT_BATCH. */
void spti_trace_chunk(const spti_call *call, size_t first, size_t window);

/* Asks the callback for n points (rounded up to whole groups, which must be filled) into
 * chunk->distance; what it does not write is NaN. */
void spti_evaluate(const spti_call *call, spti_chunk *chunk, size_t n);

/* Writes the results of rays; `first` is the number of the chunk's first ray. For SPT_NONFINITE,
 * SPT_HIT and SPT_LIMIT t and f are those of the slot. */
void spti_write_hits(const spti_call *call, const spti_chunk *chunk, spti_leavers *leavers,
                     size_t first);

/* Finishes the `count` bracketed rays in the last slots of the chunk. */
void spti_close_brackets(const spti_call *call, spti_chunk *chunk, size_t count, size_t first);

/* SPT_SKIP_START: walks the rays of the chunk whose sample at t_min is within the tolerance out of
 * it. Returns the most evaluations that this took a ray; each ray's own are its spti_spent(). */
uint32_t spti_skip_start(const spti_call *call, spti_chunk *chunk, size_t count);

#endif
