/* SPDX-License-Identifier: MIT
 *
 * Progressive frames: passes of rising resolution (Bálint & Valasek 2018, section 4), chunk by
 * chunk, that can be left after any batch and taken up again. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "state.h"

static uint32_t at_most(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

enum { STAGE_NEXT, STAGE_TILE, STAGE_CHUNK, STAGE_PIXELS, STAGE_RAYS, STAGE_DONE, STAGE_NONE };

/* ---- Chunks --------------------------------------------------------------------------------- */

/* The least t of all cones of the pass below that a pixel overlaps. */
static float inherited(const spti_state *state, uint32_t x, uint32_t y) {
    const spti_level *const level = &state->levels[state->pass], *const below = level - 1;
    const spti_rectangle *const part = &below->grid.part;
    const uint32_t x_0 = spti_overlap_begin(x, level->grid.width, below->grid.width);
    const uint32_t x_1 = spti_overlap_end(x, level->grid.width, below->grid.width);
    const uint32_t y_0 = spti_overlap_begin(y, level->grid.height, below->grid.height);
    const uint32_t y_1 = spti_overlap_end(y, level->grid.height, below->grid.height);
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
    return state->pass > 0 && spti_keeps_cones(state, state->pass - 1);
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

/* Of a coarse pass that nobody colours only the cones live on. */
static int shows_rays(const spti_state *state) {
    return state->pass + 1 == state->pass_count || state->job.frame.shade != NULL;
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
        const int keeps = spti_keeps_cones(state, state->pass);
        if (keeps && !spti_desk_pixel_cones(desk, state->pixel_t)) return 0;
        if (shows_rays(state)) spti_desk_enter(desk);
        state->stage = shows_rays(state) ? STAGE_RAYS : STAGE_DONE;
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
    if (!shows_rays(state)) return;
    spti_desk_write(desk, state->pass + 1 == state->pass_count ? image : NULL);
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
    if (!(settings.pixel_radius <= FLT_MAX)) settings.pixel_radius = FLT_MAX;
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

/* What a chunk takes from the allowance beside its evaluations, so that a call has an end where
 * nothing needs to be asked: about what the work of 256 pixels costs in cheap evaluations. */
enum { PRICE_OF_A_CHUNK = 64 };

/* Goes on with the chunk at work, or the next one. */
static void advance_chunk(spti_state *state, int64_t *allowance, const spt_hits *image) {
    spti_union *const lazy = &state->desk->lazy;
    const int64_t before = *allowance;
    if (state->stage == STAGE_NEXT) open_chunk(state);
    lazy->allowance = before;
    const int ended = work_on(state);
    state->evaluations += (uint64_t)(before - lazy->allowance);
    *allowance = lazy->allowance - (state->stage == STAGE_DONE ? PRICE_OF_A_CHUNK : 0);
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
    progress->pixel_count = spti_part_pixels(&state->levels[shown].grid);
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
    const spt_status status = spti_state_check(&job, memory, size);
    if (status != SPT_OK) return status;
    *state = spti_state_at(memory);
    *restarted = !spti_state_fits(*state, &job);
    if (*restarted) spti_state_begin(*state, &job);
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
