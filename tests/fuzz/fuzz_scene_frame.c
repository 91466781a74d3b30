/* SPDX-License-Identifier: MIT
 *
 * The frames of fuzz_scene.c: tiles and passes give valid results within the budget, write nothing
 * else, have the same bits at every width and in any division into calls, and without cones they
 * are what spt_scene_trace() makes of the camera's rays. */
#include "fuzz_scene.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { untouched = 0x5b };

static spt_hit first[fuzz_most_pixels], other[fuzz_most_pixels], none[fuzz_most_pixels];
static fuzz_ray rays[fuzz_most_pixels];
static float colours[fuzz_most_pixels * 4], other_colours[fuzz_most_pixels * 4];

static size_t pixels_of(const spt_frame *frame) {
    return (size_t)(frame->right - frame->left) * (frame->bottom - frame->top);
}

/* The rays of the region, as far as the camera shows them. */
static void make_rays(const fuzz_scene_case *what) {
    const spt_frame *const frame = &what->frame;
    const uint32_t columns = frame->right - frame->left;
    for (size_t i = 0; i < pixels_of(frame); ++i) {
        const float x = (float)(frame->left + i % columns) + 0.5f;
        const float y = (float)(frame->top + i / columns) + 0.5f;
        spt_camera_ray ray;
        FUZZ_CHECK(spt_camera_rays(&what->camera, frame->width, frame->height, 1, &x, &y, &ray) ==
                   SPT_OK);
        memcpy(rays[i].origin, ray.ray.origin, sizeof rays[i].origin);
        memcpy(rays[i].direction, ray.ray.direction, sizeof rays[i].direction);
        rays[i].t_min = ray.ray.t_min;
        rays[i].t_max = ray.ray.t_max;
        rays[i].path = ray.path;
        rays[i].active = ray.active;
        if (frame->t_max.first == NULL) continue;
        const float depth = what->depths[i];
        if (depth < ray.ray.t_max || !(depth <= INFINITY)) rays[i].t_max = depth;
    }
}

static spt_status trace(fuzz_scene_case *what, uint32_t lanes, uint32_t flags, spt_hit *found,
                        spt_statistics *statistics) {
    const size_t size = spt_frame_workspace(&what->frame);
    const spt_hits image = spt_hits_of(found);
    spt_frame frame = what->frame;
    frame.settings.max_lanes = lanes;
    frame.flags = flags;
    frame.statistics = statistics;
    frame.workspace = (char *)fuzz_memory(0, size + 3, (int)lanes * 15) + 3;
    frame.workspace_size = size;
    memset(found, untouched, sizeof first);
    fuzz_scene_clear(what);
    const size_t tiles = spt_frame_tiles(&what->frame);
    const spt_status status = spt_frame_trace(&frame, 0, tiles != 0 ? tiles : 1, &image, NULL);
    FUZZ_CHECK(fuzz_memory_kept(0, size + 3) && fuzz_scene_faults(what) == 0);
    return status;
}

static void check_image(const fuzz_scene_case *what, const spt_settings *settings,
                        const spt_hit *found) {
    const size_t pixels = pixels_of(&what->frame);
    for (size_t i = 0; i < pixels; ++i) {
        if (rays[i].active != 0) {
            fuzz_scene_check_hit(what, settings, &rays[i], &found[i]);
        } else {
            FUZZ_CHECK(memcmp(&found[i], none, sizeof *none) == 0);
        }
    }
    FUZZ_CHECK(memcmp(found + pixels, none, (fuzz_most_pixels - pixels) * sizeof *none) == 0);
}

static void check_statistics(const fuzz_scene_case *what, const spt_statistics *statistics,
                             const spt_hit *found) {
    uint64_t count = 0, evaluations = 0;
    for (size_t i = 0; i < pixels_of(&what->frame); ++i) {
        if (rays[i].active == 0) continue;
        ++count;
        evaluations += found[i].evaluations;
    }
    FUZZ_CHECK(statistics->rays == count && statistics->evaluations == evaluations);
    FUZZ_CHECK(statistics->slots >= evaluations);
    FUZZ_CHECK(fuzz_scene_points(what) >= statistics->slots + statistics->cone_evaluations);
}

/* spt_scene_trace() on the camera's rays; all must be the same, or where and what was hit. */
static void check_rays(fuzz_scene_case *what, const spt_hit *found, int all) {
    const size_t pixels = pixels_of(&what->frame), stride = sizeof *rays;
    const size_t size = spt_scene_workspace(&what->scene, &what->frame.settings);
    void *const workspace = fuzz_memory(0, size, 0x80);
    const spt_hits hits = spt_hits_of(other);
    spt_rays view;
    memset(&view, 0, sizeof view);
    for (int axis = 0; axis < 3; ++axis) {
        view.origin[axis].first = &rays[0].origin[axis];
        view.direction[axis].first = &rays[0].direction[axis];
        view.origin[axis].stride = view.direction[axis].stride = (ptrdiff_t)stride;
    }
    view.t_min.first = &rays[0].t_min;
    view.t_max.first = &rays[0].t_max;
    view.path.first = &rays[0].path;
    view.active.first = &rays[0].active;
    view.t_min.stride = view.t_max.stride = view.path.stride = (ptrdiff_t)stride;
    view.active.stride = (ptrdiff_t)stride;
    memset(other, untouched, sizeof other);
    FUZZ_CHECK(spt_scene_trace(&what->scene, &what->frame.settings, pixels, &view, &hits, workspace,
                               size, NULL) == SPT_OK);
    for (size_t i = 0; i < pixels; ++i) {
        const spt_hit *const a = &found[i], *const b = &other[i];
        if (all) {
            FUZZ_CHECK(memcmp(a, b, sizeof *a) == 0);
        } else if (a->outcome != SPT_LIMIT && b->outcome != SPT_LIMIT) {
            FUZZ_CHECK(a->outcome == b->outcome && a->component == b->component);
            FUZZ_CHECK(memcmp(&a->t, &b->t, sizeof a->t) == 0);
            FUZZ_CHECK(memcmp(&a->residual, &b->residual, sizeof a->residual) == 0);
        }
    }
}

/* ---- Passes ---------------------------------------------------------------------------------- */

/* From the start to the end in calls of a budget. */
static void advance(fuzz_scene_case *what, uint32_t lanes, uint64_t budget, spt_hit *found) {
    const size_t size = spt_frame_state_size(&what->frame);
    const spt_hits image = spt_hits_of(found);
    spt_frame frame = what->frame;
    spt_frame_progress progress;
    frame.settings.max_lanes = lanes;
    char *const state = (char *)fuzz_memory(1, size + 5, 0x80) + 5;
    memset(found, untouched, sizeof first);
    memset(&progress, 0, sizeof progress);
    FUZZ_CHECK(size != 0 && spt_frame_restart(&frame, state, size) == SPT_OK);
    for (int call = 0; progress.pass < frame.pass_count && call < 1000000; ++call) {
        FUZZ_CHECK(spt_frame_advance(&frame, state, size, budget, &image, &progress) == SPT_OK);
        FUZZ_CHECK(progress.restarted == 0 && progress.pixels <= progress.pixel_count);
    }
    FUZZ_CHECK(progress.pass == frame.pass_count);
    if (frame.shade != NULL) {
        const spt_sink picture = {colours, (ptrdiff_t)(frame.channels * sizeof *colours)};
        memset(colours, untouched, sizeof colours);
        FUZZ_CHECK(spt_frame_picture(&frame, state, size, &picture) == SPT_OK);
    }
    FUZZ_CHECK(fuzz_memory_kept(1, size + 5));
}

void fuzz_scene_frame(fuzz_scene_case *what) {
    static const uint32_t widths[] = {0, 4, 8, 16};
    const int legal = fuzz_scene_is_legal(what);
    const uint32_t flags = what->frame.flags, no_cones = SPT_FRAME_NO_CONES;
    spt_statistics statistics = spt_statistics_default();
    spt_settings last_pass;
    memset(none, untouched, sizeof none);
    FUZZ_CHECK((spt_frame_workspace(&what->frame) != 0) == (spt_frame_tiles(&what->frame) != 0));
    if (spt_frame_tiles(&what->frame) == 0) { /* the scene, the settings or the camera is bad */
        FUZZ_CHECK(trace(what, 1, flags, first, &statistics) == SPT_BAD_ARGUMENT);
        FUZZ_CHECK(memcmp(first, none, sizeof none) == 0 && fuzz_scene_points(what) == 0);
        return;
    }
    FUZZ_CHECK(legal);
    make_rays(what);
    FUZZ_CHECK(trace(what, 1, flags, first, &statistics) == SPT_OK);
    check_image(what, &what->frame.settings, first);
    check_statistics(what, &statistics, first);
    FUZZ_CHECK(trace(what, widths[what->slice / 16 % 4], flags, other, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(first, other, sizeof first) == 0);
    FUZZ_CHECK(trace(what, 0, no_cones | SPT_FRAME_NO_CULLING, first, NULL) == SPT_OK);
    check_rays(what, first, 1);
    FUZZ_CHECK(trace(what, 0, no_cones, first, NULL) == SPT_OK);
    check_rays(what, first, 0);
    advance(what, 1, UINT64_MAX, first);
    memcpy(other_colours, colours, sizeof colours);
    last_pass = what->frame.settings;
    last_pass.budget = (uint32_t)ceil((double)what->frame.passes[what->frame.pass_count - 1].share *
                                      (double)last_pass.budget);
    check_image(what, &last_pass, first);
    advance(what, widths[what->slice / 64 % 4], what->slice, other);
    FUZZ_CHECK(memcmp(first, other, sizeof first) == 0);
    if (what->frame.shade != NULL) {
        FUZZ_CHECK(memcmp(colours, other_colours, sizeof colours) == 0);
    }
}
