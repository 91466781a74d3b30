/* SPDX-License-Identifier: MIT
 *
 * The small frame of the frame tests. */
#include "test_frame_cases.h"

#include <stdlib.h>
#include <string.h>

static void shade(void *user, size_t count, const float *x, const float *y, const spt_ray *rays,
                  const spt_hit *hits, float *colours) {
    frame_case *const self = user;
    self->shaded += count;
    for (size_t i = 0; i < count; ++i) {
        const int hit = hits[i].outcome == SPT_HIT;
        const float all[frame_channels] = {hit ? 1.0f / hits[i].t : 0.0f,
                                           hit ? (float)(hits[i].component + 1) : 0.5f,
                                           x[i] + y[i] * rays[i].direction[2]};
        for (uint32_t c = 0; c < self->frame.channels; ++c) {
            colours[i * self->frame.channels + c] = all[c];
        }
    }
}

void frame_memory(frame_case *self) {
    free(self->workspace);
    free(self->state);
    self->workspace_size = spt_frame_workspace(&self->frame);
    self->state_size = spt_frame_state_size(&self->frame);
    self->workspace = malloc(self->workspace_size + 1);
    self->state = malloc(self->state_size + 1);
    CHECK(self->workspace_size > 0 && self->state_size > 0);
    CHECK(self->workspace != NULL && self->state != NULL);
    if (self->workspace != NULL) memset(self->workspace, 0x3c, self->workspace_size);
    if (self->state != NULL) memset(self->state, 0x3c, self->state_size);
    self->frame.workspace = self->workspace;
    self->frame.workspace_size = self->workspace_size;
}

void frame_base(frame_case *self, const stress_way *way) {
    static const float eye[3] = {0.0f, 0.5f, 0.0f}, target[3] = {0.0f, 0.0f, 9.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    void *const workspace = self->workspace, *const state = self->state;
    memset(self, 0, sizeof *self);
    self->workspace = workspace;
    self->state = state;
    union_base(&self->world, way);
    CHECK(spt_camera_pinhole(&self->camera, eye, target, up, 0.45f, frame_width, frame_height) ==
          SPT_OK);
    self->camera.t_max = 60.0f;
    CHECK(spt_frame_init(&self->frame, &self->world.scene, &self->camera, frame_width,
                         frame_height) == SPT_OK);
    self->frame.settings.method = way->method;
    self->frame.settings.max_lanes = way->lanes;
    self->frame.settings.budget = 600;
    self->frame.passes = spt_passes(4);
    self->frame.pass_count = 4;
    self->frame.shade = shade;
    self->frame.shade_user = self;
    self->frame.channels = frame_channels;
    memset(self->hits, 0xa5, sizeof self->hits);
    memset(self->colours, 0xa5, sizeof self->colours);
    self->image = spt_hits_of(self->hits);
    self->picture.first = self->colours;
    self->picture.stride = frame_channels * sizeof *self->colours;
    frame_memory(self);
}

void frame_free(frame_case *self) {
    free(self->workspace);
    free(self->state);
    self->workspace = self->state = NULL;
}

void frame_trace_whole(frame_case *self) {
    size_t done = 0;
    const size_t tiles = spt_frame_tiles(&self->frame);
    CHECK(spt_frame_trace(&self->frame, 0, tiles, &self->image, &done) == SPT_OK);
    CHECK(tiles > 0 && done == tiles);
}

size_t frame_advance_whole(frame_case *self, uint64_t evaluations) {
    enum { most_calls = 1000000 };
    const uint32_t last = self->frame.passes != NULL ? (uint32_t)self->frame.pass_count : 1;
    spt_frame_progress progress;
    size_t calls = 0;
    CHECK(spt_frame_restart(&self->frame, self->state, self->state_size) == SPT_OK);
    memset(&progress, 0, sizeof progress);
    for (; progress.pass < last && calls < most_calls; ++calls) {
        const spt_status status = spt_frame_advance(&self->frame, self->state, self->state_size,
                                                    evaluations, &self->image, &progress);
        CHECK(status == SPT_OK);
        if (status != SPT_OK) return calls;
    }
    CHECK_SAY(progress.pass == last, "pass %u after %u calls", (unsigned)progress.pass,
              (unsigned)calls);
    return calls;
}

size_t frame_differing(const spt_hit *a, const spt_hit *b, size_t count) {
    size_t differ = 0;
    for (size_t i = 0; i < count; ++i) differ += !stress_same_hit(&a[i], &b[i]);
    return differ;
}
