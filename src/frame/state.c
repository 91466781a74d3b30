/* SPDX-License-Identifier: MIT
 *
 * What a progressive frame keeps: its passes' grids, laid out in the caller's memory. */
#include "state.h"

/* ---- Levels --------------------------------------------------------------------------------- */

uint32_t spti_overlap_begin(uint32_t i, uint32_t n, uint32_t m) {
    return (uint32_t)((uint64_t)i * m / n);
}

uint32_t spti_overlap_end(uint32_t i, uint32_t n, uint32_t m) {
    return (uint32_t)(((uint64_t)(i + 1) * m + n - 1) / n);
}

static uint32_t scaled(uint32_t size, const spt_pass *pass) {
    return (uint32_t)(((uint64_t)size * pass->numerator + pass->denominator - 1) /
                      pass->denominator);
}

uint64_t spti_part_pixels(const spti_grid *grid) {
    return (uint64_t)(grid->part.x_1 - grid->part.x_0) * (grid->part.y_1 - grid->part.y_0);
}

/* Lays out the grids, from the last pass to the first: each covers the pixels of the next one. */
static void set_grids(spti_state *state) {
    const spt_frame *const frame = &state->job.frame;
    const spti_grid full = spti_full_grid(&state->job);
    spti_rectangle part = full.part;
    uint32_t width = full.width, height = full.height;
    for (size_t k = state->pass_count; k-- > 0;) {
        const spt_pass *const pass = &state->passes[k];
        spti_grid *const grid = &state->levels[k].grid;
        grid->width = scaled(frame->width, pass);
        grid->height = scaled(frame->height, pass);
        grid->step_x = (float)((double)frame->width / (double)grid->width);
        grid->step_y = (float)((double)frame->height / (double)grid->height);
        grid->part.x_0 = spti_overlap_begin(part.x_0, width, grid->width);
        grid->part.y_0 = spti_overlap_begin(part.y_0, height, grid->height);
        grid->part.x_1 = spti_overlap_end(part.x_1 - 1, width, grid->width);
        grid->part.y_1 = spti_overlap_end(part.y_1 - 1, height, grid->height);
        /* At most the budget, and rounded up, so that a small share is not nothing. */
        const double budget = (double)pass->share * (double)frame->settings.budget;
        const uint32_t whole = (uint32_t)budget;
        state->levels[k].budget = whole + ((double)whole < budget);
        part = grid->part;
        width = grid->width;
        height = grid->height;
    }
}

uint64_t spti_level_chunks(const spti_level *level) {
    const spti_rectangle *const part = &level->grid.part;
    const uint64_t columns = (part->x_1 - 1) / SPT_TILE - part->x_0 / SPT_TILE + 1;
    const uint64_t rows = (part->y_1 - 1) / SPT_TILE - part->y_0 / SPT_TILE + 1;
    return columns * rows * SPTI_CHUNKS;
}

void spti_level_chunk(const spti_level *level, uint64_t chunk, uint32_t *tile_column,
                      uint32_t *tile_row, size_t *index) {
    const spti_rectangle *const part = &level->grid.part;
    const uint32_t columns = (part->x_1 - 1) / SPT_TILE - part->x_0 / SPT_TILE + 1;
    *index = (size_t)(chunk % SPTI_CHUNKS);
    *tile_column = part->x_0 / SPT_TILE + (uint32_t)(chunk / SPTI_CHUNKS % columns);
    *tile_row = part->y_0 / SPT_TILE + (uint32_t)(chunk / SPTI_CHUNKS / columns);
}

uint64_t spti_level_chunk_of(const spti_level *level, uint32_t x, uint32_t y) {
    const spti_rectangle *const part = &level->grid.part;
    const uint64_t columns = (part->x_1 - 1) / SPT_TILE - part->x_0 / SPT_TILE + 1;
    const uint64_t tile =
        (y / SPT_TILE - part->y_0 / SPT_TILE) * columns + (x / SPT_TILE - part->x_0 / SPT_TILE);
    return tile * SPTI_CHUNKS + y % SPT_TILE / SPTI_CHUNK_SIDE * (SPT_TILE / SPTI_CHUNK_SIDE) +
           x % SPT_TILE / SPTI_CHUNK_SIDE;
}

/* ---- The state ------------------------------------------------------------------------------ */

spti_state *spti_state_at(const void *memory) {
    const uintptr_t address = (uintptr_t)memory;
    return (spti_state *)(address + 63 - (address + 63) % 64);
}

int spti_keeps_cones(const spti_state *state, size_t k) {
    return k + 1 < state->pass_count && state->job.camera.kind != SPT_CAMERA_RAYS;
}

/* Sets the state up for a job; with memory NULL only counts. Returns the bytes, 0: too many. */
static size_t lay_out(spti_state *state, const spti_job *job, char *memory) {
    const spt_pass *const whole = spt_passes(1);
    const size_t desk = spti_desk_size(job->scene.count), most = SIZE_MAX / 8;
    size_t size = (sizeof *state + 63) / 64 * 64;
    if (desk == 0 || desk > most) return 0;
    memset(state, 0, sizeof *state);
    state->job = *job;
    state->pass_count = job->frame.passes != NULL ? job->frame.pass_count : 1;
    memcpy(state->passes, job->frame.passes != NULL ? job->frame.passes : whole,
           state->pass_count * sizeof *state->passes);
    set_grids(state);
    if (memory != NULL) state->desk = spti_desk_place(memory + size, job->scene.count);
    size += desk;
    for (size_t k = 0; k < state->pass_count; ++k) {
        spti_level *const level = &state->levels[k];
        const size_t floats = (spti_keeps_cones(state, k) ? 1u : 0u) +
                              (job->frame.shade != NULL ? job->frame.channels : 0u);
        const uint64_t pixels = spti_part_pixels(&level->grid);
        if (floats != 0 && pixels > (most - size) / (floats * sizeof(float))) return 0;
        if (memory != NULL && spti_keeps_cones(state, k)) {
            level->free_t = (float *)(void *)(memory + size);
        }
        size += spti_keeps_cones(state, k) ? ((size_t)pixels * sizeof(float) + 63) / 64 * 64 : 0;
        if (job->frame.shade == NULL) continue;
        if (memory != NULL) level->colours = (float *)(void *)(memory + size);
        size += ((size_t)pixels * job->frame.channels * sizeof(float) + 63) / 64 * 64;
    }
    return size;
}

size_t spt_frame_state_size(const spt_frame *frame) {
    spti_job job;
    spti_state state;
    if (!spti_job_of(&job, frame)) return 0;
    const size_t size = lay_out(&state, &job, NULL);
    return size != 0 ? size + 63 : 0;
}

spt_status spti_state_check(const spti_job *job, const void *memory, size_t size) {
    spti_state counted;
    if (memory == NULL) return SPT_BAD_ARGUMENT;
    const size_t needed = lay_out(&counted, job, NULL);
    if (needed == 0 || size < needed + 63) return SPT_BUFFER_TOO_SMALL;
    return SPT_OK;
}

void spti_state_begin(spti_state *state, const spti_job *job) {
    lay_out(state, job, (char *)state);
    state->begun = SPTI_STATE_BEGUN ^ (uintptr_t)state; /* a moved state is none */
}

spt_status spt_frame_restart(const spt_frame *frame, void *state, size_t state_size) {
    spti_job job;
    if (!spti_job_of(&job, frame)) return SPT_BAD_ARGUMENT;
    const spt_status status = spti_state_check(&job, state, state_size);
    if (status == SPT_OK) spti_state_begin(spti_state_at(state), &job);
    return status;
}

/* The bytes of a structure from one member to the end of another; there is no padding between. */
#define SAME(a, b, type, first, last) \
    (memcmp((const char *)(a) + offsetof(type, first), (const char *)(b) + offsetof(type, first), \
            offsetof(type, last) + sizeof(a)->last - offsetof(type, first)) == 0)

int spti_state_fits(const spti_state *state, const spti_job *job) {
    const spt_pass *const whole = spt_passes(1);
    const spti_job *const old = &state->job;
    const spt_frame *const a = &old->frame, *const b = &job->frame;
    const size_t pass_count = b->passes != NULL ? b->pass_count : 1;
    const spt_pass *const passes = b->passes != NULL ? b->passes : whole;
    return state->begun == (SPTI_STATE_BEGUN ^ (uintptr_t)state) &&
           pass_count == state->pass_count &&
           memcmp(passes, state->passes, pass_count * sizeof *passes) == 0 &&
           SAME(&old->camera, &job->camera, spt_camera, kind, t_max) &&
           old->camera.rays == job->camera.rays && old->camera.user == job->camera.user &&
           SAME(&old->scene, &job->scene, spt_scene, fields, zone_count) &&
           SAME(&a->settings, &b->settings, spt_settings, method, flags) &&
           SAME(a, b, spt_frame, width, flags) && a->t_max.first == b->t_max.first &&
           a->t_max.stride == b->t_max.stride && a->shade == b->shade &&
           a->shade_user == b->shade_user && a->channels == b->channels;
}
