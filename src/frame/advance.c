/* SPDX-License-Identifier: MIT
 *
 * Progressive frames: passes of rising resolution (Bálint & Valasek 2018, section 4), chunk by
 * chunk, that can be left after any batch and taken up again. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "state.h"

/* ---- Levels --------------------------------------------------------------------------------- */

static uint32_t at_most(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

/* The first pixel of m that pixel i of n overlaps, and the one behind the last: in integers, so
 * that no rounding leaves one out. */
static uint32_t overlap_begin(uint32_t i, uint32_t n, uint32_t m) {
    return (uint32_t)((uint64_t)i * m / n);
}

static uint32_t overlap_end(uint32_t i, uint32_t n, uint32_t m) {
    return (uint32_t)(((uint64_t)(i + 1) * m + n - 1) / n);
}

static uint32_t scaled(uint32_t size, const spt_pass *pass) {
    return (uint32_t)(((uint64_t)size * pass->numerator + pass->denominator - 1) /
                      pass->denominator);
}

static size_t part_pixels(const spti_grid *grid) {
    return (size_t)(grid->part.x_1 - grid->part.x_0) * (grid->part.y_1 - grid->part.y_0);
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
        grid->part.x_0 = overlap_begin(part.x_0, width, grid->width);
        grid->part.y_0 = overlap_begin(part.y_0, height, grid->height);
        grid->part.x_1 = overlap_end(part.x_1 - 1, width, grid->width);
        grid->part.y_1 = overlap_end(part.y_1 - 1, height, grid->height);
        const double budget = ceil((double)pass->share * (double)frame->settings.budget);
        state->levels[k].budget = budget < (double)UINT32_MAX ? (uint32_t)budget : UINT32_MAX;
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

/* Whether a level keeps where its cones came to: the caller's rays have none. */
static int keeps_cones(const spti_state *state, size_t k) {
    return k + 1 < state->pass_count && state->job.camera.kind != SPT_CAMERA_RAYS;
}

/* Sets the state up for a job; with memory NULL only counts. Returns the bytes, 0: too many. */
static size_t lay_out(spti_state *state, const spti_job *job, char *memory) {
    static const spt_pass whole[] = {{1, 1, 1.0f}};
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
        const size_t floats = (keeps_cones(state, k) ? 1u : 0u) +
                              (job->frame.shade != NULL ? job->frame.channels : 0u);
        const size_t pixels = part_pixels(&level->grid);
        if (floats != 0 && pixels > (most - size) / (floats * sizeof(float))) return 0;
        if (memory != NULL && keeps_cones(state, k)) {
            level->free_t = (float *)(void *)(memory + size);
        }
        size += keeps_cones(state, k) ? (pixels * sizeof(float) + 63) / 64 * 64 : 0;
        if (job->frame.shade == NULL) continue;
        if (memory != NULL) level->colours = (float *)(void *)(memory + size);
        size += (pixels * job->frame.channels * sizeof(float) + 63) / 64 * 64;
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

/* Whether a caller's memory holds the state of a job. */
static spt_status check_state(const spti_job *job, const void *memory, size_t size) {
    spti_state counted;
    if (memory == NULL) return SPT_BAD_ARGUMENT;
    const size_t needed = lay_out(&counted, job, NULL);
    if (needed == 0 || size < needed + 63) return SPT_BUFFER_TOO_SMALL;
    return SPT_OK;
}

static void begin(spti_state *state, const spti_job *job) {
    lay_out(state, job, (char *)state);
    state->begun = SPTI_STATE_BEGUN;
}

spt_status spt_frame_restart(const spt_frame *frame, void *state, size_t state_size) {
    spti_job job;
    if (!spti_job_of(&job, frame)) return SPT_BAD_ARGUMENT;
    const spt_status status = check_state(&job, state, state_size);
    if (status == SPT_OK) begin(spti_state_at(state), &job);
    return status;
}

/* The bytes of a structure from one member to the end of another; there is no padding between. */
#define SAME(a, b, type, first, last) \
    (memcmp((const char *)(a) + offsetof(type, first), (const char *)(b) + offsetof(type, first), \
            offsetof(type, last) + sizeof(a)->last - offsetof(type, first)) == 0)

/* Whether a state was begun with the same frame. */
int spti_state_fits(const spti_state *state, const spti_job *job) {
    static const spt_pass whole[] = {{1, 1, 1.0f}};
    const spti_job *const old = &state->job;
    const spt_frame *const a = &old->frame, *const b = &job->frame;
    const size_t pass_count = b->passes != NULL ? b->pass_count : 1;
    const spt_pass *const passes = b->passes != NULL ? b->passes : whole;
    return state->begun == SPTI_STATE_BEGUN && pass_count == state->pass_count &&
           memcmp(passes, state->passes, pass_count * sizeof *passes) == 0 &&
           SAME(&old->camera, &job->camera, spt_camera, kind, t_max) &&
           old->camera.rays == job->camera.rays && old->camera.user == job->camera.user &&
           SAME(&old->scene, &job->scene, spt_scene, fields, zone_count) &&
           SAME(&a->settings, &b->settings, spt_settings, method, flags) &&
           SAME(a, b, spt_frame, width, flags) && a->t_max.first == b->t_max.first &&
           a->t_max.stride == b->t_max.stride && a->shade == b->shade &&
           a->shade_user == b->shade_user && a->channels == b->channels;
}

enum { STAGE_NEXT, STAGE_TILE, STAGE_CHUNK, STAGE_PIXELS, STAGE_RAYS, STAGE_DONE, STAGE_NONE };

/* ---- Chunks --------------------------------------------------------------------------------- */

/* The least t of all cones of the pass below that a pixel overlaps. */
static float inherited(const spti_state *state, uint32_t x, uint32_t y) {
    const spti_level *const level = &state->levels[state->pass], *const below = level - 1;
    const spti_rectangle *const part = &below->grid.part;
    const uint32_t x_0 = overlap_begin(x, level->grid.width, below->grid.width);
    const uint32_t x_1 = overlap_end(x, level->grid.width, below->grid.width);
    const uint32_t y_0 = overlap_begin(y, level->grid.height, below->grid.height);
    const uint32_t y_1 = overlap_end(y, level->grid.height, below->grid.height);
    float least = INFINITY;
    for (uint32_t row = y_0; row < y_1; ++row) {
        for (uint32_t column = x_0; column < x_1; ++column) {
            const float t = below->free_t[(size_t)(row - part->y_0) * (part->x_1 - part->x_0) +
                                          (column - part->x_0)];
            if (t < least) least = t;
        }
    }
    return least;
}

static int inherits(const spti_state *state) {
    return state->pass > 0 && keeps_cones(state, state->pass - 1);
}

/* Pools the rays of the chunk at work. */
static void open_rays(spti_state *state) {
    const spti_level *const level = &state->levels[state->pass];
    const spti_desk *const desk = state->desk;
    for (size_t i = 0; inherits(state) && i < SPT_BATCH; ++i) {
        const uint32_t x = at_most(spti_desk_column(desk, i), level->grid.part.x_1 - 1);
        const uint32_t y = at_most(spti_desk_row(desk, i), level->grid.part.y_1 - 1);
        state->starts[i] = desk->all || desk->active[i] != 0 ? inherited(state, x, y) : 0.0f;
    }
    spti_desk_open(state->desk, inherits(state) ? state->starts : NULL);
}

/* Begins the next chunk, and its tile if it is the first one of that. */
static void open_chunk(spti_state *state) {
    uint32_t column, row;
    size_t index;
    spti_level_chunk(&state->levels[state->pass], state->chunk, &column, &row, &index);
    if (index == 0) {
        spti_desk_tile(state->desk, column, row);
        state->stage = STAGE_TILE;
    } else {
        state->stage = spti_desk_chunk(state->desk, index) ? STAGE_CHUNK : STAGE_NONE;
    }
}

/* Goes on with the chunk at work, stage by stage. Returns whether the allowance lasted; at the end
 * the stage is STAGE_DONE, or STAGE_NONE where there is nothing to trace. */
static int work_on(spti_state *state) {
    spti_desk *const desk = state->desk;
    if (state->stage == STAGE_TILE) {
        if (!spti_desk_tile_cones(desk, !inherits(state))) return 0;
        state->stage = spti_desk_chunk(desk, 0) ? STAGE_CHUNK : STAGE_NONE;
    }
    if (state->stage == STAGE_CHUNK) {
        if (!spti_desk_chunk_cones(desk, !inherits(state))) return 0;
        open_rays(state);
        state->stage = STAGE_PIXELS;
    }
    if (state->stage == STAGE_PIXELS) {
        const int keeps = keeps_cones(state, state->pass);
        if (keeps && !spti_desk_pixel_cones(desk, state->pixel_t)) return 0;
        spti_desk_enter(desk);
        state->stage = STAGE_RAYS;
    }
    if (state->stage == STAGE_RAYS) {
        if (!spti_union_run(&desk->lazy)) return 0;
        state->stage = STAGE_DONE;
    }
    return 1;
}

static void shade_chunk(spti_state *state) {
    const spti_desk *const desk = state->desk;
    const spt_frame *const frame = &state->job.frame;
    spti_level *const level = &state->levels[state->pass];
    float x[SPTI_GROUP], y[SPTI_GROUP], colours[SPTI_GROUP * SPTI_MOST_CHANNELS];
    size_t places[SPTI_GROUP];
    spt_ray rays[SPTI_GROUP];
    spt_hit hits[SPTI_GROUP];
    for (size_t block = 0; block < SPT_BATCH; block += SPTI_GROUP) {
        size_t count = 0;
        for (size_t i = block; i < block + SPTI_GROUP; ++i) {
            const uint32_t column = spti_desk_column(desk, i), row = spti_desk_row(desk, i);
            const spti_rectangle *const part = &level->grid.part;
            if (column < part->x_0 || column >= part->x_1 || row < part->y_0 || row >= part->y_1) {
                continue;
            }
            spti_union_hit(&desk->lazy, i, &hits[count]);
            for (int axis = 0; axis < 3; ++axis) {
                rays[count].origin[axis] = desk->rays.origin[axis][i];
                rays[count].direction[axis] = desk->rays.direction[axis][i];
            }
            rays[count].t_min = spti_desk_limit(&desk->columns.t_min, i);
            rays[count].t_max = spti_desk_limit(&desk->columns.t_max, i);
            x[count] = desk->x[i];
            y[count] = desk->y[i];
            places[count++] = spti_desk_place_of(desk, i);
        }
        if (count == 0) continue;
        frame->shade(frame->shade_user, count, x, y, rays, hits, colours);
        for (size_t i = 0; i < count; ++i) {
            memcpy(level->colours + places[i] * frame->channels, colours + i * frame->channels,
                   frame->channels * sizeof *colours);
        }
    }
}

/* Keeps what a finished chunk found out. */
static void close_chunk(spti_state *state, const spt_hits *image) {
    spti_desk *const desk = state->desk;
    spti_level *const level = &state->levels[state->pass];
    const spti_rectangle *const part = &level->grid.part;
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const uint32_t column = spti_desk_column(desk, i), row = spti_desk_row(desk, i);
        if (column < part->x_0 || column >= part->x_1 || row < part->y_0 || row >= part->y_1) {
            continue;
        }
        state->pixels += 1;
        if (level->free_t != NULL) level->free_t[spti_desk_place_of(desk, i)] = state->pixel_t[i];
    }
    if (state->job.frame.shade != NULL) shade_chunk(state);
    spti_desk_write(desk, state->pass + 1 == state->pass_count && image != NULL ? image : NULL);
}

/* ---- Calls ---------------------------------------------------------------------------------- */

/* Turns the desk to the pass at work. */
static void begin_pass(spti_state *state) {
    spti_level *const level = &state->levels[state->pass];
    spt_settings settings = state->job.frame.settings;
    const float step =
        level->grid.step_x < level->grid.step_y ? level->grid.step_x : level->grid.step_y;
    settings.budget = level->budget;
    settings.pixel_radius *= step;
    /* Every result, whoever asks for it in a later call. */
    state->wanted = spt_hits_of(&state->anything);
    spti_desk_begin(state->desk, &state->job, &settings, &level->grid, &state->wanted,
                    state->job.frame.statistics);
    state->begun_pass = 1;
    state->stage = STAGE_NEXT;
    state->chunk = state->pixels = 0;
}

/* Counts what the cones did since the last time. */
static void count_cones(spti_state *state) {
    spti_desk *const desk = state->desk;
    spt_statistics *const statistics = state->job.frame.statistics;
    if (statistics != NULL) {
        statistics->cone_evaluations += desk->cone_evaluations;
        statistics->kept += desk->kept;
        statistics->culled += desk->culled;
        statistics->lanes = (uint32_t)spti_isa_lanes(desk->isa);
    }
    desk->cone_evaluations = desk->kept = desk->culled = 0;
}

/* Goes on with the chunk at work, or the next one. */
static void advance_chunk(spti_state *state, int64_t *allowance, const spt_hits *image) {
    spti_union *const lazy = &state->desk->lazy;
    const int64_t before = *allowance;
    if (state->stage == STAGE_NEXT) open_chunk(state);
    lazy->allowance = before;
    const int ended = work_on(state);
    *allowance = lazy->allowance;
    state->evaluations += (uint64_t)(before - *allowance);
    count_cones(state);
    if (!ended) return;
    if (state->stage == STAGE_DONE) close_chunk(state, image);
    state->stage = STAGE_NEXT;
    state->chunk += 1;
}

static void advance(spti_state *state, uint64_t evaluations, const spt_hits *image) {
    int64_t allowance = evaluations < (uint64_t)INT64_MAX ? (int64_t)evaluations : INT64_MAX;
    for (; state->pass < state->pass_count && allowance > 0;) {
        if (!state->begun_pass) begin_pass(state);
        if (state->chunk < spti_level_chunks(&state->levels[state->pass])) {
            advance_chunk(state, &allowance, image);
        } else {
            state->pass += 1;
            state->begun_pass = 0;
        }
    }
    /* A pass whose last chunk is done is finished, whoever finds no allowance left. */
    if (state->pass < state->pass_count && state->begun_pass && state->stage == STAGE_NEXT &&
        state->chunk == spti_level_chunks(&state->levels[state->pass])) {
        state->pass += 1;
        state->begun_pass = 0;
    }
}

static void report(const spti_state *state, int restarted, spt_frame_progress *progress) {
    if (progress == NULL) return;
    const size_t last = state->pass_count - 1;
    const size_t shown = state->pass < state->pass_count ? state->pass : last;
    progress->pass = (uint32_t)state->pass;
    progress->restarted = restarted ? 1u : 0u;
    progress->pixel_count = part_pixels(&state->levels[shown].grid);
    progress->pixels = state->pass == state->pass_count ? progress->pixel_count
                       : state->begun_pass              ? state->pixels
                                                        : 0;
    progress->evaluations = state->evaluations;
}

/* What a call brings along that the state does not depend on: it may differ from call to call. */
static void adopt(spti_state *state, const spti_job *job) {
    state->job.frame.statistics = job->frame.statistics;
    if (state->begun_pass) spti_desk_adopt(state->desk, job->frame.statistics);
}

/* Checks a call, and begins anew where the frame has changed. */
static spt_status take_up(const spt_frame *frame, void *memory, size_t size, const spt_hits *image,
                          spti_state **state, int *restarted) {
    spti_job job;
    if (!spti_job_of(&job, frame)) return SPT_BAD_ARGUMENT;
    if (image != NULL && !spti_image_fits(&job.frame, image)) return SPT_BAD_ARGUMENT;
    const spt_status status = check_state(&job, memory, size);
    if (status != SPT_OK) return status;
    *state = spti_state_at(memory);
    *restarted = !spti_state_fits(*state, &job);
    if (*restarted) begin(*state, &job);
    adopt(*state, &job);
    return SPT_OK;
}

spt_status spt_frame_advance(const spt_frame *frame, void *state, size_t state_size,
                             uint64_t evaluations, const spt_hits *image,
                             spt_frame_progress *progress) {
    spti_state *begun;
    int restarted;
    const spt_status status = take_up(frame, state, state_size, image, &begun, &restarted);
    if (status != SPT_OK) return status;
    advance(begun, evaluations, image);
    report(begun, restarted, progress);
    return SPT_OK;
}

/* A clock that has not moved by then stands still. */
enum { MOST_WITHOUT_A_TICK = 1 << 16, MOST_SLICES = 1 << 20 };

/* Evaluations for the next slice: half of what is left, so that a slice that is dearer than those
 * before does not overrun by as much again. Without experience as many as since the start. */
static uint64_t slice_of(const spti_state *state, double left, uint64_t since) {
    const double each = state->seconds_an_evaluation;
    const double guess = each > 0 ? 0.5 * left / each : (double)since;
    if (!(guess > SPT_BATCH)) return SPT_BATCH;
    return guess < 1e15 ? (uint64_t)guess : (uint64_t)1e15;
}

spt_status spt_frame_advance_for(const spt_frame *frame, void *state, size_t state_size,
                                 double seconds, spt_clock_fn *clock, void *clock_user,
                                 const spt_hits *image, spt_frame_progress *progress) {
    spti_state *begun;
    int restarted, stands_still = 0;
    if (clock == NULL || !(seconds >= 0)) return SPT_BAD_ARGUMENT;
    const spt_status status = take_up(frame, state, state_size, image, &begun, &restarted);
    if (status != SPT_OK) return status;
    const double start = clock(clock_user);
    const uint64_t first = begun->evaluations;
    double now = start;
    for (int slice = 0; slice < MOST_SLICES && now - start < seconds && !stands_still; ++slice) {
        if (begun->pass == begun->pass_count) break;
        const uint64_t before = begun->evaluations;
        advance(begun, slice_of(begun, seconds - (now - start), before - first), image);
        const double later = clock(clock_user);
        const uint64_t spent = begun->evaluations - first;
        if (later > start && spent > 0) {
            begun->seconds_an_evaluation = (later - start) / (double)spent;
        }
        stands_still = !(later > start) && spent >= MOST_WITHOUT_A_TICK;
        now = later;
    }
    report(begun, restarted, progress);
    return stands_still && begun->pass < begun->pass_count ? SPT_UNSUPPORTED : SPT_OK;
}
