/* SPDX-License-Identifier: MIT
 *
 * What a progressive frame keeps between calls. */
#ifndef SPTI_STATE_H
#define SPTI_STATE_H

#include "desk.h"

/* A pass: its pixels, and what is kept of them. */
typedef struct spti_level {
    spti_grid grid;
    uint32_t budget;
    float *free_t;  /* by pixel of the grid's part, up to where its cone is empty; NULL: not kept */
    float *colours; /* or NULL */
} spti_level;

typedef struct spti_state {
    uint64_t begun; /* SPTI_STATE_BEGUN */
    spti_job job;   /* as the state was begun with */
    spt_pass passes[SPTI_MOST_PASSES];
    size_t pass_count;
    spti_level levels[SPTI_MOST_PASSES];
    spti_desk *desk;
    size_t pass;
    uint64_t chunk; /* of the pass, the one at work or the next one */
    int begun_pass, stage;
    uint64_t pixels;
    uint64_t evaluations;
    double seconds_an_evaluation;
    spt_hits wanted;
    spt_hit anything;                            /* where the sinks of wanted point */
    float starts[SPT_BATCH], pixel_t[SPT_BATCH]; /* of the open chunk */
} spti_state;

#define SPTI_STATE_BEGUN UINT64_C(0x5350544652414d45)

/* The first pixel of m that pixel i of n overlaps, and the one behind the last: in integers, so
 * that no rounding leaves one out. */
uint32_t spti_overlap_begin(uint32_t i, uint32_t n, uint32_t m);
uint32_t spti_overlap_end(uint32_t i, uint32_t n, uint32_t m);

uint64_t spti_part_pixels(const spti_grid *grid);

/* Whether a level keeps where its cones came to: the caller's rays have none. */
int spti_keeps_cones(const spti_state *state, size_t level);

/* Whether a caller's memory holds the state of a job; and begins one. */
spt_status spti_state_check(const spti_job *job, const void *memory, size_t size);
void spti_state_begin(spti_state *state, const spti_job *job);

/* The order of chunks in a pass: tile by tile of the part, row by row. */
uint64_t spti_level_chunks(const spti_level *level);
void spti_level_chunk(const spti_level *level, uint64_t chunk, uint32_t *tile_column,
                      uint32_t *tile_row, size_t *index);
/* And the chunk that holds a pixel of the grid. */
uint64_t spti_level_chunk_of(const spti_level *level, uint32_t x, uint32_t y);

/* The state in a caller's memory. */
spti_state *spti_state_at(const void *memory);

/* Whether a state was begun with the same frame. */
int spti_state_fits(const spti_state *state, const spti_job *job);

#endif
