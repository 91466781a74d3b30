/* SPDX-License-Identifier: MIT
 *
 * The public doors of whole frames: a tile, or a run of them. */
#include "desk.h"

#include "../base/arguments.h"

size_t spt_frame_workspace(const spt_frame *frame) {
    spti_job job;
    if (!spti_job_of(&job, frame)) return 0;
    const size_t size = spti_desk_size(job.scene.count);
    return size != 0 ? size + 63 : 0;
}

/* Whether an image of the region can be written where it is said to be. */
int spti_image_fits(const spt_frame *frame, const spt_hits *image) {
    static const float anything[1] = {0.0f};
    const uint64_t pixels = (uint64_t)(frame->right - frame->left) * (frame->bottom - frame->top);
    spt_rays nothing;
    memset(&nothing, 0, sizeof nothing);
    if (pixels > PTRDIFF_MAX) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        nothing.origin[axis].first = nothing.direction[axis].first = anything;
    }
    nothing.t_max = frame->t_max;
    return spti_views_fit(&nothing, image, (size_t)pixels);
}

/* Checks what a call over tiles is handed. */
static spt_status check(spti_job *job, const spt_frame *frame, size_t first, size_t count,
                        const spt_hits *image) {
    if (!spti_job_of(job, frame) || image == NULL) return SPT_BAD_ARGUMENT;
    const size_t tiles = spti_job_tiles(job);
    if (first > tiles || count > tiles - first) return SPT_BAD_ARGUMENT;
    if (!spti_image_fits(&job->frame, image)) return SPT_BAD_ARGUMENT;
    const size_t size = spti_desk_size(job->scene.count);
    if (size == 0 || job->frame.workspace == NULL) return SPT_BAD_ARGUMENT;
    return job->frame.workspace_size < size + 63 ? SPT_BUFFER_TOO_SMALL : SPT_OK;
}

static spti_desk *open_desk(const spti_job *job, const spt_hits *image) {
    const uintptr_t memory = (uintptr_t)job->frame.workspace;
    char *const start = (char *)job->frame.workspace + ((memory + 63) / 64 * 64 - memory);
    spti_desk *const desk = spti_desk_place(start, job->scene.count);
    const spti_grid grid = spti_full_grid(job);
    spti_desk_begin(desk, job, &job->frame.settings, &grid, image, job->frame.statistics);
    return desk;
}

static void trace_tile(spti_desk *desk, size_t index, const spt_hits *image) {
    spt_statistics *const statistics = desk->statistics;
    uint32_t column, row;
    spti_job_tile(desk->job, index, &column, &row);
    spti_desk_tile(desk, column, row);
    spti_desk_tile_cones(desk, 1);
    for (size_t chunk = 0; chunk < SPTI_CHUNKS; ++chunk) {
        if (!spti_desk_chunk(desk, chunk)) continue;
        spti_desk_chunk_cones(desk, 1);
        spti_desk_trace(desk, image);
    }
    spti_desk_flush(desk, image);
    if (statistics != NULL) {
        statistics->cone_evaluations += desk->cone_evaluations;
        statistics->kept += desk->kept;
        statistics->culled += desk->culled;
        statistics->lanes = (uint32_t)spti_isa_lanes(desk->isa);
    }
    desk->cone_evaluations = desk->kept = desk->culled = 0;
}

spt_status spt_frame_tile(const spt_frame *frame, size_t index, const spt_hits *image) {
    spti_job job;
    const spt_status status = check(&job, frame, index, 1, image);
    if (status != SPT_OK) return status;
    trace_tile(open_desk(&job, image), index, image);
    return SPT_OK;
}

spt_status spt_frame_trace(const spt_frame *frame, size_t first, size_t count,
                           const spt_hits *image, size_t *done) {
    spti_job job;
    const spt_status status = check(&job, frame, first, count, image);
    if (status != SPT_OK) return status;
    spti_desk *const desk = open_desk(&job, image);
    int ended = 0;
    size_t traced = 0;
    for (; traced < count && !ended; ++traced) {
        trace_tile(desk, first + traced, image);
        if (job.frame.progress != NULL) {
            ended = job.frame.progress(job.frame.progress_user, traced + 1, count);
        }
    }
    if (done != NULL) *done = traced;
    return SPT_OK;
}
