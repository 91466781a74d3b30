/* SPDX-License-Identifier: MIT
 *
 * What the files of the driver share: the call that is running. */
#ifndef SPTI_DRIVER_H
#define SPTI_DRIVER_H

#include "method.h"

struct spti_leavers;
struct spti_call;

/* What happens to rays that leave a chunk; `first` is the number of the chunk's first ray. For
 * SPT_NONFINITE, SPT_HIT, SPT_LIMIT and SPTI_STOPPED t and f are those of the slot. */
typedef void spti_leave_fn(const struct spti_call *call, spti_chunk *chunk,
                           struct spti_leavers *leavers, size_t first);

/* Finds the rays that are free up to their SPTI_STOP (fates). Returns whether any ray finished. */
typedef int spti_stop_fn(spti_chunk *chunk, size_t count);

/* Looks at the first samples of a chunk, in chunk->distance, and may replace rays by others that go
 * on in their stead: with first samples of their own, that count to spti_spent(). Returns the most
 * evaluations that this took a ray. */
typedef uint32_t spti_turn_fn(const struct spti_call *call, spti_chunk *chunk, size_t count);

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
    int one_origin; /* all rays have one, and no path before: arrays that are the same throughout */
    spti_leave_fn *leave;
    const size_t *places; /* where the results of a ray go; NULL: to its own number */
    int32_t component;    /* what a hit is said to have hit */
    spti_stop_fn *stop;   /* NULL: rays are traced to their end */
    int64_t *allowance;   /* evaluations until all rays are set aside, with stop; or NULL */
    spti_turn_fn *turn;   /* or NULL */
    void *owner;          /* of leave and turn */
} spti_call;

/* Beside the public outcomes: the ray is not at its end. */
enum { SPTI_STOPPED = SPT_OUTCOMES };

/* Rays that leave a chunk together. */
typedef struct spti_leavers {
    size_t count;
    uint32_t age; /* passes they were in */
    int steep;    /* a bracket betrayed the field */
    uint16_t slots[SPT_BATCH];
    unsigned char outcomes[SPT_BATCH];
    unsigned char indices[SPT_BATCH]; /* where they were loaded, and */
    size_t places[SPT_BATCH];         /* where their results go: set when written */
} spti_leavers;

/* Takes in a caller's field and the bound it points to; 0 where either breaks its rules. */
int spti_field_copy(spt_field *to, spt_bound *bound, const spt_field *from);

int spti_settings_copy(spt_settings *to, const spt_settings *from);

/* Whether a rule may trace a field. */
int spti_method_allowed(const spt_method *method, const spt_field *field);

/* Whether count rays and hits can be read and written where they are said to be. */
int spti_views_fit(const spt_rays *rays, const spt_hits *hits, size_t count);

/* Whether a ray begins where it enters something (prepare_kernel.h), asked before it has moved. */
static inline int spti_enters(const spti_chunk *chunk, size_t slot) {
    return chunk->array[SPTI_PENDING_VALUE][slot] > 0.0f;
}

/* Whether rays spend evaluations beside those of the passes of a chunk. */
static inline int spti_keeps_spent(const spti_call *call) {
    return (call->settings.flags & SPT_SKIP_START) != 0 || call->stop != NULL ||
           call->turn != NULL || call->march.between != 0;
}

/* Settles what follows from a call's field, bound, settings, hits, statistics, stop, and rays or
 * one_origin. */
void spti_call_settle(spti_call *call);

/* Traces the rays first .. first + window - 1, window <= SPT_BATCH: in a chunk of its own, */
void spti_trace_window(const spti_call *call, size_t first, size_t window);

/* or in one that is there. */
void spti_trace_chunk(const spti_call *call, spti_chunk *chunk, size_t first, size_t window);

/* The steps of that. Loads the `count` rays first + chunk->picked[i], which ascend; */
void spti_load_chunk(const spt_rays *rays, spti_chunk *chunk, size_t count, size_t first);

/* and marches them, after they were prepared, until all have left. any: whether some are finished
 * already. first_pass: 1 for fresh rays, 0 for rays whose points to evaluate are in place. */
void spti_run_chunk(const spti_call *call, spti_chunk *chunk, size_t count, size_t first, int any,
                    int first_pass);

/* Asks a field for n <= SPT_BATCH points. The arrays are aligned to 64 bytes and hold whole groups;
 * what the callback does not write is NaN. spti_ask() fills the last group up by its last point, */
void spti_ask(const spt_field *field, size_t n, float *x, float *y, float *z, float *distance);

/* and here it must be full. */
void spti_ask_groups(const spt_field *field, size_t n, const float *x, const float *y,
                     const float *z, float *distance);

/* Asks the callback for n points (rounded up to whole groups, which must be filled) into
 * chunk->distance; what it does not write is NaN. */
void spti_evaluate(const spti_call *call, spti_chunk *chunk, size_t n);

/* Sets the indices and places of leavers. */
void spti_place_leavers(const spti_call *call, const spti_chunk *chunk, spti_leavers *leavers,
                        size_t first);

/* The leave of spt_trace(): writes the results of rays. */
spti_leave_fn spti_write_hits;

/* Whether a slope betrays the field: exact ones were seen to reach 1.0003. */
static inline int spti_is_steep(float slope) {
    return slope > 1.001f;
}

/* Finishes the `count` bracketed rays in the last slots of the chunk. */
void spti_close_brackets(const spti_call *call, spti_chunk *chunk, size_t count, size_t first);

/* SPT_CANDIDATE_PENUMBRA and _CLOSEST: takes a last sample of rays that are about to end as a miss,
 * at t_max, for their candidates. age: evaluations of the passes so far. */
void spti_look_at_ends(const spti_call *call, spti_chunk *chunk, size_t count, uint32_t age);

/* Counts n evaluations in one batch. */
void spti_count_asked(const spti_call *call, size_t n);

/* SPT_SKIP_START: walks the rays of the chunk whose sample at t_min is within the tolerance out of
 * it. Returns the most evaluations that this took a ray; each ray's own are its spti_spent(). */
uint32_t spti_skip_start(const spti_call *call, spti_chunk *chunk, size_t count);

#endif
