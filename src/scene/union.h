/* SPDX-License-Identifier: MIT
 *
 * The lazy union (Szécsi et al. 2016, section 5.1): every component marches along each ray as if it
 * were alone, but only while no other one can be nearer. Resumable after any batch. */
#ifndef SPTI_UNION_H
#define SPTI_UNION_H

#include <spheretrace/scene.h>

#include "../trace/driver.h"

/* What of a component's march along a ray is kept while another component is nearer. */
enum {
    SPTI_STATE_T,
    SPTI_STATE_VALUE,
    SPTI_STATE_PROBE,
    SPTI_STATE_MEMORY,
    SPTI_STATE_PENDING_T,
    SPTI_STATE_PENDING_VALUE,
    SPTI_STATE_T_MAX, /* the caller's, or where an empty zone begins */
    SPTI_STATES
};

/* How far a component's march along a ray is. */
enum { SPTI_FRESH, SPTI_BEGUN, SPTI_BEGUN_INSIDE };

/* How a ray stands; results from its end on. */
typedef struct spti_record {
    float t, value;    /* of the nearest event so far, t in the caller's units; +infinity: none */
    int32_t component; /* whose */
    uint32_t evaluations;
    float steepest, fallbacks;          /* as in a chunk */
    float candidate_t, candidate_ratio; /* t in the caller's units */
    unsigned char outcome;
    unsigned char inside, steep, active;
    float unit; /* t of the caller = unit * t of the marches */
} spti_record;

typedef struct spti_union {
    spti_call *calls; /* one for each component of the scene, settled, with spti_union_leave */
    const uint32_t *list;
    size_t listed; /* components that take part: list[0 .. listed - 1], ascending */
    const spt_zone *zones;
    size_t zone_count;
    const spt_rays *rays; /* first .. first + count - 1, count <= pool */
    size_t first, count, pool;
    uint32_t budget;
    spti_isa isa;
    uint64_t allowance; /* evaluations until it is left; the calls take from it */

    /* By component of the list and ray: up to where the ray is free of it, in the caller's units;
     * how far its march is; and the state of that, SPTI_STATES rows a component. */
    float *keys;
    unsigned char *begun;
    float *states;

    /* By ray. */
    float *least, *second, *which; /* of the keys, and the place in the list of the least */
    spti_record *records;
    uint16_t *alive; /* the rays not at their end */
    size_t alive_count;
    uint16_t *tasks;  /* those, sorted by the component that is nearest */
    uint32_t *counts; /* by component of the list */
    uint16_t *groups; /* of SPTI_GROUP rays, with living ones among them */
    spti_chunk chunk;
    size_t running; /* place in the list of the component at work */
} spti_union;

/* Bytes for a union of at most so many components and rays, pool a multiple of SPT_BATCH; and its
 * arrays in as many bytes of memory, aligned to 64. Sizes that exceed size_t give 0. */
size_t spti_union_size(size_t components, size_t pool);
void spti_union_place(spti_union *lazy, void *memory, size_t components, size_t pool);

/* Rays that are fresh. starts: by component of the list and ray (rows of pool), the least t at
 * which the component can be, +infinity: nowhere; or NULL. */
void spti_union_begin(spti_union *lazy, const float *starts);

/* Traces until all rays are at their end, and returns 1, or until the allowance is used up, and
 * returns 0. */
int spti_union_run(spti_union *lazy);

/* The leave of a component's call, whose owner is the union. */
spti_leave_fn spti_union_leave;

/* Empty zones. From t on of a ray in the caller's units: the first t that no zone of the component
 * covers, and where from there the next zone begins (+infinity: none). */
typedef struct spti_clearing {
    float begin, end;
} spti_clearing;
spti_clearing spti_zone_clearing(const spt_zone *zones, size_t count, int32_t component,
                                 const spt_rays *rays, size_t ray, float t);

/* The kernels, by instruction set. */
typedef struct spti_union_kernels {
    /* Brings loaded rays into their own units and finds the bad ones (fates). */
    void (*units)(spti_chunk *chunk, size_t count);
    /* By ray: where it enters a bound (or NULL) at or after starts[i], in the caller's units;
     * +infinity where nowhere. In place. */
    void (*entries)(const spti_chunk *chunk, const spt_bound *bound, size_t count, float *starts);
    /* The least and the second of the keys of groups of rays. */
    void (*least)(const spti_union *lazy, size_t group_count);
    spti_stop_fn *stop;
} spti_union_kernels;
extern const spti_union_kernels *const spti_union_kernels_of[];

/* A row of keys. */
static inline float *spti_union_keys(const spti_union *lazy, size_t place) {
    return lazy->keys + place * lazy->pool;
}

#endif
