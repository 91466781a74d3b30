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
    float *tile_t;  /* by component: t of the tile's chunks, */
    float *block_t; /* and of a chunk's blocks of 4x4 */
    uint32_t *list; /* components that the chunk may meet */
    float *starts;  /* by place in that list: t of the chunk's rays */
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
    size_t places[SPT_BATCH]; /* in an image of the part, of the active ones */
    spt_hit alone[SPT_BATCH]; /* results of a chunk that meets one component only */
} spti_desk;

/* Bytes for a desk of so many components; 0: more than size_t holds. */
size_t spti_desk_size(size_t components);

/* Lays it out in as many bytes aligned to 64. */
spti_desk *spti_desk_place(void *memory, size_t components);

/* Turns to a pass. settings and grid are its own. */
void spti_desk_begin(spti_desk *desk, const spti_job *job, const spt_settings *settings,
                     const spti_grid *grid, const spt_hits *wanted, spt_statistics *statistics);

/* Turns to a tile of the grid. walk: whether its cones are sent ahead; otherwise bounds alone tell
 * what it may meet. */
void spti_desk_tile(spti_desk *desk, uint32_t column, uint32_t row, int walk);

/* Turns to chunk number `index` of the tile; returns 0 where none of its pixels is to be traced. */
int spti_desk_chunk(spti_desk *desk, size_t index, int walk);

/* Begins its rays, which desk->lazy then traces. starts: where they are known to be free up to, by
 * ray, or NULL. pixel_t: where not NULL, a cone is sent ahead for each pixel, and its t put there. */
void spti_desk_open(spti_desk *desk, const float *starts, float *pixel_t);

/* Traces the chunk from its cones on to an image of the part, at one go. */
void spti_desk_trace(spti_desk *desk, const spt_hits *image);

/* Counts the chunk's rays, and writes their results to an image of the part, unless it is NULL. */
void spti_desk_write(const spti_desk *desk, const spt_hits *image);

/* The record of a ray of the chunk, a miss where it is not active; */
static inline spti_record spti_desk_record(const spti_desk *desk, size_t ray) {
    spti_record record = desk->lazy.records[ray];
    record.active = 1;
    return record;
}

/* and a limit of it. */
static inline float spti_desk_limit(const spt_column *limits, size_t ray) {
    float t;
    memcpy(&t, (const char *)limits->first + (ptrdiff_t)ray * limits->stride, sizeof t);
    return t;
}

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
    return (size_t)(spti_desk_row(desk, ray) - part->y_0) * (part->x_1 - part->x_0) +
           (spti_desk_column(desk, ray) - part->x_0);
}

#endif
