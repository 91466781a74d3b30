/* SPDX-License-Identifier: MIT
 *
 * Frames: made, checked, and cut into tiles. */
#include "job.h"

#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../scene/scene_call.h"

enum { MOST_PIXELS_A_SIDE = 1 << 22, FRAME_FLAGS = SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING };

const spt_pass *spt_passes(size_t count) {
    static const spt_pass one[] = {{1, 1, 1.0f}};
    static const spt_pass two[] = {{1, 2, 0.125f}, {1, 1, 0.875f}};
    static const spt_pass four[] = {{1, 4, 0.125f}, {1, 2, 0.125f}, {3, 4, 0.125f}, {1, 1, 0.625f}};
    static const spt_pass six[] = {{1, 6, 0.125f}, {1, 3, 0.125f}, {1, 2, 0.125f},
                                   {2, 3, 0.125f}, {5, 6, 0.125f}, {1, 1, 0.375f}};
    return count == 1 ? one : count == 2 ? two : count == 4 ? four : count == 6 ? six : NULL;
}

static int passes_are_good(const spt_frame *frame) {
    if (frame->passes == NULL) return 1;
    if (frame->pass_count < 1 || frame->pass_count > SPTI_MOST_PASSES) return 0;
    for (size_t i = 0; i < frame->pass_count; ++i) {
        const spt_pass *pass = &frame->passes[i];
        if (pass->numerator == 0 || pass->numerator > pass->denominator) return 0;
        if (!(pass->share > 0.0f) || !(pass->share <= 1.0f)) return 0;
    }
    const spt_pass *last = &frame->passes[frame->pass_count - 1];
    return last->numerator == last->denominator;
}

/* The tiles that the frame's region touches. */
static spti_rectangle tiles_of(const spt_frame *frame) {
    const spti_rectangle tiles = {frame->left / SPT_TILE, frame->top / SPT_TILE,
                                  (frame->right - 1) / SPT_TILE + 1,
                                  (frame->bottom - 1) / SPT_TILE + 1};
    return tiles;
}

int spti_job_of(spti_job *job, const spt_frame *from) {
    spt_frame *const frame = &job->frame;
    spt_settings chosen;
    memset(frame, 0, sizeof *frame);
    frame->struct_size = sizeof *frame;
    if (from == NULL || !spti_copy_sized(frame, from, sizeof *frame)) return 0;
    if (!spti_settings_copy(&chosen, &frame->settings)) return 0;
    frame->settings = chosen;
    if (!spti_camera_copy(&job->camera, frame->camera)) return 0;
    if (!spti_scene_copy(&job->scene, frame->scene)) return 0;
    if (!spti_scene_check(&job->scene, &frame->settings)) return 0;
    if (frame->width < 1 || frame->width > MOST_PIXELS_A_SIDE || frame->height < 1 ||
        frame->height > MOST_PIXELS_A_SIDE) {
        return 0;
    }
    if (frame->left >= frame->right || frame->right > frame->width || frame->top >= frame->bottom ||
        frame->bottom > frame->height) {
        return 0;
    }
    if ((frame->flags & ~(uint32_t)FRAME_FLAGS) != 0) return 0;
    if (!passes_are_good(frame)) return 0;
    if (frame->shade != NULL && (frame->channels < 1 || frame->channels > SPTI_MOST_CHANNELS)) {
        return 0;
    }
    if (frame->statistics != NULL && frame->statistics->struct_size < sizeof(spt_statistics)) {
        return 0;
    }
    job->view = spti_view_of(&job->camera, frame->width, frame->height);
    const spti_rectangle tiles = tiles_of(frame);
    return (uint64_t)(tiles.x_1 - tiles.x_0) * (tiles.y_1 - tiles.y_0) <= SIZE_MAX;
}

spti_grid spti_full_grid(const spti_job *job) {
    const spt_frame *frame = &job->frame;
    const spti_grid grid = {frame->width,
                            frame->height,
                            1.0f,
                            1.0f,
                            {frame->left, frame->top, frame->right, frame->bottom}};
    return grid;
}

/* Half the lesser side of a pixel: at distance 1 for a pinhole camera, in world length for an
 * orthographic one. */
static float half_pixel(const spt_camera *camera, uint32_t width, uint32_t height) {
    double right = 0, up = 0;
    for (int axis = 0; axis < 3; ++axis) {
        right += (double)camera->right[axis] * (double)camera->right[axis];
        up += (double)camera->up[axis] * (double)camera->up[axis];
    }
    const double across =
        sqrt(right) * fabs((double)camera->x_high - (double)camera->x_low) / (double)width;
    const double down =
        sqrt(up) * fabs((double)camera->y_high - (double)camera->y_low) / (double)height;
    const float half = (float)(0.5 * (across < down ? across : down));
    return half > FLT_MIN ? half : FLT_MIN;
}

spt_status spt_frame_init(spt_frame *frame, const spt_scene *scene, const spt_camera *camera,
                          uint32_t width, uint32_t height) {
    spt_camera copy;
    if (frame == NULL || scene == NULL || !spti_camera_copy(&copy, camera)) return SPT_BAD_ARGUMENT;
    if (width < 1 || width > MOST_PIXELS_A_SIDE || height < 1 || height > MOST_PIXELS_A_SIDE) {
        return SPT_BAD_ARGUMENT;
    }
    memset(frame, 0, sizeof *frame);
    frame->struct_size = sizeof *frame;
    frame->scene = scene;
    frame->camera = camera;
    frame->settings = spt_settings_default();
    frame->width = frame->right = width;
    frame->height = frame->bottom = height;
    if (copy.kind == SPT_CAMERA_PINHOLE) {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            square += (double)copy.forward[axis] * (double)copy.forward[axis];
        }
        frame->settings.pixel_radius = half_pixel(&copy, width, height) / (float)sqrt(square);
    } else if (copy.kind == SPT_CAMERA_ORTHOGRAPHIC) {
        frame->settings.epsilon = half_pixel(&copy, width, height);
    }
    return SPT_OK;
}

/* ---- Tiles ---------------------------------------------------------------------------------- */

size_t spti_job_tiles(const spti_job *job) {
    const spti_rectangle tiles = tiles_of(&job->frame);
    return (size_t)(tiles.x_1 - tiles.x_0) * (tiles.y_1 - tiles.y_0); /* at most 2^32, checked */
}

void spti_job_tile(const spti_job *job, size_t index, uint32_t *column, uint32_t *row) {
    const spti_rectangle tiles = tiles_of(&job->frame);
    *column = tiles.x_0 + (uint32_t)(index % (tiles.x_1 - tiles.x_0));
    *row = tiles.y_0 + (uint32_t)(index / (tiles.x_1 - tiles.x_0));
}

size_t spt_frame_tiles(const spt_frame *frame) {
    spti_job job;
    return spti_job_of(&job, frame) ? spti_job_tiles(&job) : 0;
}

static uint32_t at_most(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

static uint32_t at_least(uint32_t a, uint32_t b) {
    return a < b ? b : a;
}

spt_status spt_frame_area(const spt_frame *frame, size_t index, uint32_t area[4]) {
    spti_job job;
    uint32_t column, row;
    if (!spti_job_of(&job, frame) || area == NULL) return SPT_BAD_ARGUMENT;
    if (index >= spti_job_tiles(&job)) return SPT_BAD_ARGUMENT;
    spti_job_tile(&job, index, &column, &row);
    area[0] = at_least(column * SPT_TILE, job.frame.left);
    area[1] = at_least(row * SPT_TILE, job.frame.top);
    area[2] = at_most((column + 1) * SPT_TILE, job.frame.right);
    area[3] = at_most((row + 1) * SPT_TILE, job.frame.bottom);
    return SPT_OK;
}
