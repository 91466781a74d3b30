/* SPDX-License-Identifier: MIT
 *
 * A chunk: up to SPT_BATCH rays that march together and are all of one age, as arrays of float.
 * What the kernels and the driver share; no code of either. */
#ifndef SPTI_CHUNK_H
#define SPTI_CHUNK_H

#include <spheretrace/trace.h>

#include <string.h>

#include "../base/compiler.h"

enum {
    SPTI_GROUP = 16, /* callbacks get whole groups of points */
    SPTI_GROUPS = SPT_BATCH / SPTI_GROUP,
    SPTI_ROOM = SPT_BATCH + SPTI_GROUP, /* a vector of slack behind each array for whole stores */
    SPTI_BRACKET_EVALUATIONS = 40       /* most that closing a bracket may take */
};

/* The results that somebody asked for; a march kernel exists for every combination. */
enum {
    SPTI_WANT_CANDIDATE = 1, /* screen-space candidate */
    SPTI_WANT_SLOPE = 2,     /* Lipschitz audit */
    SPTI_WANT_FALLBACKS = 4,
    SPTI_WANTS = 8
};

/* The arrays of a chunk that follow a ray when finished ones before it leave. A ray's own unit of
 * length makes its direction's largest component lie in [1, 2): t counts in it, so that no length
 * of a direction over- or underflows; powers of two, so that it costs no bit. */
enum {
    SPTI_X, /* the point to evaluate next */
    SPTI_Y,
    SPTI_Z,
    SPTI_ORIGIN,                      /* three, */
    SPTI_DIRECTION = SPTI_ORIGIN + 3, /* three, */
    SPTI_SCALE = SPTI_DIRECTION + 3,  /* radius in t = scale * f; negative for an inside start */
    SPTI_T_MAX,
    SPTI_EPSILON,                     /* tolerance in t = max(epsilon, */
    SPTI_PATH,                        /*     pixel_radius (path + t), */
    SPTI_FLOOR_AT_0,                  /*     SPTI_FLOOR t + floor at 0) */
    SPTI_INDEX,                       /* place in the chunk when it was loaded, as a number */
    SPTI_T,                           /* the last certified sample */
    SPTI_VALUE,                       /* f there */
    SPTI_PROBE,                       /* t of the point to evaluate next */
    SPTI_MEMORY,                      /* two arrays for the rule, or one and */
    SPTI_PENDING_T = SPTI_MEMORY + 1, /* the rejected probe that may be reached later; t 0: none */
    SPTI_PENDING_VALUE,
    SPTI_SPENT,     /* evaluations beside those of the passes; see spti_spent() */
    SPTI_STEEPEST,  /* largest slope seen, of f / lipschitz */
    SPTI_FALLBACKS, /* exact to 2^24 */
    SPTI_CANDIDATE_T,
    SPTI_CANDIDATE_RATIO,
    SPTI_STOP, /* a ray that is certified up to here is set aside; only in calls that stop */
    SPTI_ARRAYS
};

/* How the rays of a group ended in a pass: bit i of a mask for ray i of the group. A finished ray
 * that is in none of the other masks stalled, or its budget ended. */
typedef struct spti_fates {
    uint16_t finished, hit, missed, nonfinite, bracketed, bad, stopped;
} spti_fates;

typedef struct spti_chunk {
    float (*array)[SPTI_ROOM]; /* SPTI_ARRAYS of them, or as many as the call holds; aligned */
    SPTI_ALIGNED(64) float distance[SPTI_ROOM]; /* what the callback answered */
    float unit[SPT_BATCH];                      /* t of the caller = unit * t, by index */
    uint16_t picked[SPT_BATCH];                 /* which ray of the call's it is, by index */
    spti_fates fates[SPTI_GROUPS];
} spti_chunk;

/* What a call has in common for all its rays. */
typedef struct spti_march {
    float pixel_radius;
    float relaxation, extrapolation, slope_blend, step_cap;
    float epsilon, size, inverse_lipschitz; /* for the preparation, and the last for candidates */
    uint32_t between;                       /* SPT_CANDIDATE_* */
    const spt_bound *bound;
} spti_march;

/* One pass over count rays whose points were just evaluated: takes the samples in, finds out who
 * finished (fates), and proposes the next points. first: these were the samples at t_min. Returns
 * whether any ray finished. */
typedef int spti_march_fn(spti_chunk *chunk, const spti_march *march, size_t count, int first);

/* Brings count rays, loaded into origin, direction, t (t_min), t_max and path, into a chunk's own
 * units and finds the bad ones and those with nothing to trace (fates). Returns whether there are
 * any. */
typedef int spti_prepare_fn(spti_chunk *chunk, const spti_march *march, size_t count);

/* Closes the gaps that finished rays left among count rays, in the arrays whose numbers are listed.
 * Returns how many rays remain. */
typedef size_t spti_compact_fn(spti_chunk *chunk, const unsigned char *arrays, size_t array_count,
                               size_t count);

typedef struct spti_chunk_kernels {
    spti_prepare_fn *prepare;
    spti_compact_fn *compact;
} spti_chunk_kernels;

/* By instruction set (backend/isa.h). */
extern const spti_chunk_kernels spti_chunk_kernels_of[];

/* The evaluations of the ray in a slot beside those of the passes it was in. Their bits, since a
 * float counts only to 2^24, and arrays move bits. */
static inline uint32_t spti_spent(const spti_chunk *chunk, size_t slot) {
    uint32_t evaluations;
    memcpy(&evaluations, &chunk->array[SPTI_SPENT][slot], sizeof evaluations);
    return evaluations;
}

static inline void spti_set_spent(spti_chunk *chunk, size_t slot, uint32_t evaluations) {
    memcpy(&chunk->array[SPTI_SPENT][slot], &evaluations, sizeof evaluations);
}

#endif
