/* SPDX-License-Identifier: MIT
 *
 * The best picture so far of a progressive frame. */
#include <math.h>

#include "state.h"

/* Whether a pass has finished the chunk that holds a pixel of its grid. */
static int is_done(const spti_state *state, size_t pass, uint32_t x, uint32_t y) {
    const spti_level *const level = &state->levels[pass];
    const spti_rectangle *const part = &level->grid.part;
    if (pass != state->pass) return pass < state->pass;
    if (!state->begun_pass) return 0;
    if (x < part->x_0 || x >= part->x_1 || y < part->y_0 || y >= part->y_1) return 0;
    return spti_level_chunk_of(level, x, y) < state->chunk;
}

static const float *colour_at(const spti_state *state, size_t pass, uint32_t x, uint32_t y) {
    const spti_level *const level = &state->levels[pass];
    const spti_rectangle *const part = &level->grid.part;
    const size_t place = (size_t)(y - part->y_0) * (part->x_1 - part->x_0) + (x - part->x_0);
    return level->colours + place * state->job.frame.channels;
}

/* The two pixels between whose centres a point lies, within low .. high - 1, and how far it is on
 * the way from one to the other. */
typedef struct between {
    uint32_t a, b;
    float share;
} between;

static between pixels_around(float point, float step, uint32_t low, uint32_t high) {
    const float place = point / step - 0.5f;
    const float least = (float)low, most = (float)(high - 1);
    between found;
    if (!(place > least)) {
        found.a = found.b = low;
        found.share = 0.0f;
    } else if (!(place < most)) {
        found.a = found.b = high - 1;
        found.share = 0.0f;
    } else {
        found.a = (uint32_t)place;
        found.b = found.a + 1;
        found.share = place - (float)found.a;
    }
    return found;
}

/* The bilinear colour of a pass at a point of the full image; 0 where one of its corners is not
 * there yet. */
static int interpolate(const spti_state *state, size_t pass, float x, float y, float *colour) {
    const spti_grid *const grid = &state->levels[pass].grid;
    const between across = pixels_around(x, grid->step_x, grid->part.x_0, grid->part.x_1);
    const between down = pixels_around(y, grid->step_y, grid->part.y_0, grid->part.y_1);
    if (!is_done(state, pass, across.a, down.a) || !is_done(state, pass, across.b, down.a) ||
        !is_done(state, pass, across.a, down.b) || !is_done(state, pass, across.b, down.b)) {
        return 0;
    }
    const float *const upper_left = colour_at(state, pass, across.a, down.a);
    const float *const upper_right = colour_at(state, pass, across.b, down.a);
    const float *const lower_left = colour_at(state, pass, across.a, down.b);
    const float *const lower_right = colour_at(state, pass, across.b, down.b);
    for (uint32_t c = 0; c < state->job.frame.channels; ++c) {
        const float upper = upper_left[c] + across.share * (upper_right[c] - upper_left[c]);
        const float lower = lower_left[c] + across.share * (lower_right[c] - lower_left[c]);
        colour[c] = upper + down.share * (lower - upper);
    }
    return 1;
}

static void best_colour(const spti_state *state, uint32_t x, uint32_t y, float *colour) {
    const size_t last = state->pass_count - 1, channels = state->job.frame.channels;
    if (is_done(state, last, x, y)) {
        memcpy(colour, colour_at(state, last, x, y), channels * sizeof *colour);
        return;
    }
    memset(colour, 0, channels * sizeof *colour);
    for (size_t pass = last; pass-- > 0;) {
        if (interpolate(state, pass, (float)x + 0.5f, (float)y + 0.5f, colour)) return;
    }
}

spt_status spt_frame_picture(const spt_frame *frame, const void *state, size_t state_size,
                             const spt_sink *picture) {
    spti_job job;
    spt_hits image;
    float colour[SPTI_MOST_CHANNELS];
    if (!spti_job_of(&job, frame) || job.frame.shade == NULL) return SPT_BAD_ARGUMENT;
    if (state == NULL) return SPT_BAD_ARGUMENT;
    if (state_size < spt_frame_state_size(frame)) return SPT_BUFFER_TOO_SMALL;
    if (picture == NULL || picture->first == NULL) return SPT_BAD_ARGUMENT;
    memset(&image, 0, sizeof image);
    image.t = *picture;
    if (!spti_image_fits(&job.frame, &image)) return SPT_BAD_ARGUMENT;
    const spti_state *const begun = spti_state_at(state);
    if (!spti_state_fits(begun, &job)) return SPT_BAD_ARGUMENT;
    size_t place = 0;
    for (uint32_t y = job.frame.top; y < job.frame.bottom; ++y) {
        for (uint32_t x = job.frame.left; x < job.frame.right; ++x, ++place) {
            best_colour(begun, x, y, colour);
            memcpy((char *)picture->first + (ptrdiff_t)place * picture->stride, colour,
                   job.frame.channels * sizeof *colour);
        }
    }
    return SPT_OK;
}
