/* SPDX-License-Identifier: MIT
 *
 * The lazy union (Szécsi et al. 2016, section 5.1): every component marches along each ray as if it
 * were alone, but only while no other one can be nearer. Resumable after any batch. */
#ifndef SPTI_UNION_H
#define SPTI_UNION_H

#include <spheretrace/scene.h>

#include "../trace/driver.h"

/* What is known of a ray, in rows of floats; t in the ray's own unit (chunk.h). */
enum {
    SPTI_ROW_ORIGIN, /* three, */
    SPTI_ROW_DIRECTION = SPTI_ROW_ORIGIN + 3,
    SPTI_ROW_LENGTH = SPTI_ROW_DIRECTION + 3, /* of the direction */
    SPTI_ROW_REACH,                           /* largest magnitude in the origin */
    SPTI_ROW_UNIT,                            /* t of the caller = unit * t, */
    SPTI_ROW_POWER,                           /* and back */
    SPTI_ROW_T_MIN,
    SPTI_ROW_T_MAX,
    SPTI_ROW_EPSILON,
    SPTI_ROW_PATH,
    SPTI_ROW_NEAREST, /* t of the nearest event so far; +infinity: none */
    SPTI_ROW_VALUE,   /* f there */
    SPTI_ROW_SPENT,   /* evaluations, as bits */
    SPTI_ROW_STEEPEST,
    SPTI_ROW_FALLBACKS,
    SPTI_ROW_CANDIDATE_T,
    SPTI_ROW_CANDIDATE_RATIO,
    SPTI_ROW_SECOND, /* the second of the components' keys, */
    SPTI_ROW_WHICH,  /* and the place in the list of the least */
    SPTI_ROWS
};

/* What is known of a component on a ray: up to where the ray is free of it, where it is to be
 * traced to, and the march while another component is nearer: of groups with a march that has begun
 * only. */
enum {
    SPTI_STATE_KEY,
    SPTI_STATE_EXIT,
    SPTI_STATE_T,
    SPTI_STATE_VALUE,
    SPTI_STATE_PROBE,
    SPTI_STATE_MEMORY,
    SPTI_STATE_PENDING_T,
    SPTI_STATE_PENDING_VALUE,
    SPTI_STATE_SCALE,
    SPTI_STATE_CLEAR, /* where the next empty zone begins; only with zones */
    SPTI_STATES
};

/* Tasks by how their marches begin. */
enum { SPTI_TASKS_BEGUN, SPTI_TASKS_FRESH, SPTI_TASKS_CUT };

/* What else is known of a ray. */
typedef struct spti_record {
    int32_t component; /* of the nearest event */
    unsigned char outcome;
    unsigned char inside, steep, active;
} spti_record;

typedef struct spti_union {
    spti_call *calls; /* one for each component of the scene, settled, with spti_union_leave */
    const uint32_t *list;
    size_t listed; /* components that take part: list[0 .. listed - 1], ascending */
    const spt_zone *zones;
    size_t zone_count;
    size_t count, pool; /* rays, and most of them */
    int all_active;
    int one_origin; /* all rays of the calls have one, and no path before (driver.h) */
    uint32_t budget, most_spent;
    spti_isa isa;
    float epsilon;     /* as in the settings */
    int64_t allowance; /* evaluations until it is left, below 0 when overdrawn; the calls take
                         * from it */

    float *rows;   /* SPTI_ROWS of pool + SPTI_GROUP */
    float *states; /* by component of the list, SPTI_STATES of pool + SPTI_GROUP */
    /* Masks of SPTI_GROUP rays: */
    uint16_t *begun;     /* by component of the list and group: its march has begun */
    uint16_t *cut;       /* and: it begins where an empty zone ends, */
    uint16_t *inside;    /* which the ray came to inside of the body */
    uint16_t *tasks;     /* and: it is the nearest one */
    uint16_t *alive;     /* by group: not at their end */
    unsigned char *busy; /* by component of the list: whether it has tasks */
    spti_record *records;
    spti_chunk chunk;
    size_t running; /* place in the list of the component at work */
} spti_union;

/* Bytes for a union of at most so many components and rays, pool a multiple of SPT_BATCH; and its
 * arrays in as many bytes of memory, aligned to 64. Sizes that exceed size_t give 0. */
size_t spti_union_size(size_t components, size_t pool);
void spti_union_place(spti_union *lazy, void *memory, size_t components, size_t pool);

/* Rays come in windows of SPT_BATCH, the last of which may be smaller: rays first .. first + size -
 * 1 of the caller's. */
void spti_union_clear(spti_union *lazy);
void spti_union_add(spti_union *lazy, const spt_rays *rays, size_t first, size_t size);

/* Turns to the components of the list. starts: by component of the list and ray (rows of pool), the
 * least t at which the component can be, in the caller's unit, +infinity: nowhere; or NULL. */
void spti_union_enter(spti_union *lazy, const float *starts);

/* Traces until all rays are at their end, and returns 1, or until the allowance is used up, and
 * returns 0. */
int spti_union_run(spti_union *lazy);

/* The leave of a component's call, whose owner is the union. */
spti_leave_fn spti_union_leave;

/* Empty zones. From t on of a ray: the first t that no zone of the component covers, and where from
 * there the next zone begins (+infinity: none). */
typedef struct spti_clearing {
    float begin, end;
} spti_clearing;
spti_clearing spti_zone_clearing(const spt_zone *zones, size_t count, int32_t component,
                                 const double origin[3], const double direction[3], float t);

/* The kernels, by instruction set. */
typedef struct spti_union_kernels {
    /* Takes a window of loaded rays over into the rows, and finds the bad ones (alive). */
    void (*begin)(spti_union *lazy, size_t window, size_t count);
    /* Where the rays enter and leave the bound of a component, if it has one; starts as in
     * spti_union_enter(), of this component. */
    void (*enter)(spti_union *lazy, size_t place, const float *starts);
    /* Finds the nearest component of every ray, ends those that are decided, and makes tasks of the
     * others. Returns whether any are left. */
    int (*plan)(spti_union *lazy);
    /* Brings tasks of one kind of the component at work into the chunk, from *group on, at most
     * SPT_BATCH. Returns how many, and the next group. */
    size_t (*take)(spti_union *lazy, int kind, size_t *group);
    spti_stop_fn *stop;
} spti_union_kernels;
extern const spti_union_kernels *const spti_union_kernels_of[];

static inline float *spti_union_row(const spti_union *lazy, int what) {
    return lazy->rows + (size_t)what * (lazy->pool + SPTI_GROUP);
}

static inline float *spti_union_state(const spti_union *lazy, size_t place, int what) {
    return lazy->states + (place * SPTI_STATES + (size_t)what) * (lazy->pool + SPTI_GROUP);
}

static inline size_t spti_union_groups(const spti_union *lazy) {
    return (lazy->count + SPTI_GROUP - 1) / SPTI_GROUP;
}

/* A component's masks. */
static inline uint16_t *spti_union_masks(const spti_union *lazy, uint16_t *masks, size_t place) {
    return masks + place * (lazy->pool / SPTI_GROUP);
}

#endif
