/* SPDX-License-Identifier: MIT
 *
 * The working set of a tile: what it keeps of the scene, how far its cones came, and the chunk of
 * 16x16 rays at work. */
#ifndef SPTI_DESK_H
#define SPTI_DESK_H

#include "../scene/scene_call.h"
#include "job.h"

enum { SPTI_CHUNKS = 16 }; /* of a tile */

typedef struct spti_desk {
    const spti_job *job;
    spt_settings settings; /* of the pass */
    spti_isa isa;
    spti_grid grid;
    const spt_hits *wanted;
    spt_statistics *statistics;
    uint64_t cone_evaluations; /* of the tile so far, and */
    uint64_t kept, culled;

    spti_call *calls;       /* by component, made when first needed: */
    unsigned char *settled; /* whether it was */
    uint32_t *tile_list;    /* components that the tile may meet */
    size_t tile_listed;
    uint32_t tile_column, tile_row;
    size_t chunk;         /* its number in the tile */
    spti_bundles bundles; /* that are on their way, and */
    size_t next;          /* along which component, */
    int walks;            /* and how many walks of that are done */
    float *tile_t;        /* by component: t of the tile's chunks, */
    float *block_t;       /* and of a chunk's blocks of 4x4 */
    uint32_t *chunk_list; /* components that the chunk may meet */
    size_t chunk_listed;

    /* Chunks that meet several components are traced together, so that batches fill. */
    size_t pooled, most_pooled;
    unsigned char *in_pool; /* by component: whether one of the chunks may meet it */
    float *pool_t;          /* and t of their blocks */
    uint32_t *list;         /* components that they may meet */
    float *starts;          /* by place in that list: t of their rays */
    size_t *places;         /* of their rays in an image of the part, if active */
    spti_union lazy;

    /* The chunk: ray 16 b + i is pixel i of block b, row by row in both. */
    uint32_t left, top; /* its first pixel in the grid */
    int all;            /* all of its pixels are traced */
    spt_rays columns;
    spti_ray_arrays rays;
    float path[SPT_BATCH], t_min[SPT_BATCH], t_max[SPT_BATCH];
    int32_t active[SPT_BATCH];
    SPTI_ALIGNED(64) float x[SPT_BATCH]; /* in pixels of the full image */
    SPTI_ALIGNED(64) float y[SPT_BATCH];
    spt_camera_ray camera_rays[SPT_BATCH];
    size_t own_places[SPT_BATCH]; /* in an image of the part, if active */
} spti_desk;

/* Whether the rays are a caller's. */
static inline int spti_desk_owns_rays(const spti_desk *desk) {
    return desk->job->view.kind == SPT_CAMERA_RAYS;
}

static inline void spti_set_column(spt_column *column, const void *first, ptrdiff_t stride) {
    column->first = first;
    column->stride = stride;
}

/* Bytes for a desk of so many components; 0: more than size_t holds. */
size_t spti_desk_size(size_t components);

/* Lays it out in as many bytes aligned to 64. */
spti_desk *spti_desk_place(void *memory, size_t components);

/* Turns to a pass. settings and grid are its own. */
void spti_desk_begin(spti_desk *desk, const spti_job *job, const spt_settings *settings,
                     const spti_grid *grid, const spt_hits *wanted, spt_statistics *statistics);

/* Turns to a tile of the grid, and sends its cones ahead along every component, each time as far as
 * the union's allowance goes; returns whether all are there. walk: 0 where bounds alone are to tell
 * what the tile may meet. */
void spti_desk_tile(spti_desk *desk, uint32_t column, uint32_t row);
int spti_desk_tile_cones(spti_desk *desk, int walk);

/* Turns to chunk number `index` of the tile; returns 0 where none of its pixels is to be traced.
 * And its cones, likewise. */
int spti_desk_chunk(spti_desk *desk, size_t index);
int spti_desk_chunk_cones(spti_desk *desk, int walk);

/* Traces it from its cones on to an image of the part, now or with others: */
void spti_desk_trace(spti_desk *desk, const spt_hits *image);

/* by now. */
void spti_desk_flush(spti_desk *desk, const spt_hits *image);

/* Or alone, and step by step: its rays are pooled (starts: where they are known to be free up
 * to, by ray, or NULL); a cone may be sent ahead for each pixel, likewise, and its t put into
 * pixel_t; and desk->lazy has what it needs to trace them. */
void spti_desk_open(spti_desk *desk, const float *starts);
int spti_desk_pixel_cones(spti_desk *desk, float *pixel_t);
void spti_desk_enter(spti_desk *desk);

/* Counts the pool's rays, and writes their results to an image of the part, unless it is NULL. */
void spti_desk_write(const spti_desk *desk, const spt_hits *image);

/* A limit of a ray of the chunk. */
static inline float spti_desk_limit(const spt_column *limits, size_t ray) {
    float t;
    memcpy(&t, (const char *)limits->first + (ptrdiff_t)ray * limits->stride, sizeof t);
    return t;
}

/* The call of a component, made when first asked for. */
spti_call *spti_desk_call(spti_desk *desk, uint32_t component);

/* The rays of the chunk, but for what spti_desk_fill_rays() does, which only those need that may
 * meet something. Returns 0 where none of its pixels is traced. */
int spti_desk_make_rays(spti_desk *desk);
void spti_desk_fill_rays(spti_desk *desk);

/* Counts elsewhere from now on. */
void spti_desk_adopt(spti_desk *desk, spt_statistics *statistics);

/* The place of ray i of the chunk in the grid. */
static inline uint32_t spti_desk_column(const spti_desk *desk, size_t ray) {
    return desk->left + (uint32_t)(ray / 16 % 4 * 4 + ray % 4);
}

static inline uint32_t spti_desk_row(const spti_desk *desk, size_t ray) {
    return desk->top + (uint32_t)(ray / 64 * 4 + ray / 4 % 4);
}

/* And in an image of the grid's part. */
static inline size_t spti_desk_place_of(const spti_desk *desk, size_t ray) {
    const spti_rectangle *const part = &desk->grid.part;
    return ((size_t)spti_desk_row(desk, ray) - part->y_0) * (part->x_1 - part->x_0) +
           ((size_t)spti_desk_column(desk, ray) - part->x_0);
}

#endif
