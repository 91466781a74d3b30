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
    spt_rays rays;
    spt_hits hits;
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
    uint32_t evaluations;  /* of each, and */
    const uint16_t *extra; /* by index, those before the first pass; or NULL */
    int steep;             /* a bracket betrayed the field */
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
 * it. extra, by index and zero at first, receives the evaluations that this took. Returns the
 * most. */
uint32_t spti_skip_start(const spti_call *call, spti_chunk *chunk, size_t count, uint16_t *extra);

/* The tolerance at t for the ray in a slot, in t. */
float spti_tolerance(const spti_call *call, const spti_chunk *chunk, size_t slot, float t);

/* Puts the point at t of the ray in slot `from` into place `to` of those to evaluate. */
void spti_place_point(spti_chunk *chunk, size_t from, size_t to, float t);

#endif
