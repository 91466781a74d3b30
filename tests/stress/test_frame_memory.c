/* SPDX-License-Identifier: MIT
 *
 * Rows F6 to F9 for frames: images of any size and regions of huge ones, everything that is read or
 * written between guard pages, canaries between the pixels, workspace and state of any alignment
 * and contents, and frames for which no cone can be. */
#include "test_frame_cases.h"
#include "stress_guard.h"

#include <stdlib.h>
#include <string.h>

enum { outputs = 9 };

static frame_case self;
static spt_hit right[frame_pixels];

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE | STRESS_OWN_RAYS); \
    stress_next(&way);

static spt_sink *sink_of(spt_hits *hits, int column) {
    spt_sink *const all[outputs] = {&hits->t,           &hits->residual,        &hits->outcome,
                                    &hits->evaluations, &hits->flags,           &hits->component,
                                    &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[column];
}

/* The case for an image of another size, with a camera that fits. */
static void resize(const stress_way *way, uint32_t width, uint32_t height) {
    static const float eye[3] = {0.0f, 0.5f, 0.0f}, target[3] = {0.0f, 0.0f, 9.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    frame_base(&self, way);
    const spt_frame old = self.frame;
    CHECK(spt_camera_pinhole(&self.camera, eye, target, up, 0.45f, width, height) == SPT_OK);
    CHECK(spt_frame_init(&self.frame, &self.world.scene, &self.camera, width, height) == SPT_OK);
    self.frame.settings.method = way->method;
    self.frame.settings.max_lanes = way->lanes;
    self.frame.settings.budget = 600;
    self.frame.passes = old.passes;
    self.frame.pass_count = old.pass_count;
    self.frame.shade = old.shade;
    self.frame.shade_user = old.shade_user;
    self.frame.channels = old.channels;
}

static size_t pixels_of(const spt_frame *frame) {
    return (size_t)(frame->right - frame->left) * (frame->bottom - frame->top);
}

/* ---- F7: between guard pages ----------------------------------------------------------------- */

static stress_guard output_memory[outputs], t_max_memory, work_memory, state_memory, picture_memory;
static unsigned char *out[outputs];

static int make_memory(size_t workspace, size_t state) {
    int made = stress_guard_make(&work_memory, workspace);
    made &= stress_guard_make(&state_memory, state);
    made &= stress_guard_make(&t_max_memory, 4 * frame_pixels);
    made &= stress_guard_make(&picture_memory, 4 * frame_channels * frame_pixels);
    for (int i = 0; i < outputs; ++i)
        made &= stress_guard_make(&output_memory[i], 4 * frame_pixels);
    return made;
}

static void free_memory(void) {
    stress_guard_free(&work_memory);
    stress_guard_free(&state_memory);
    stress_guard_free(&t_max_memory);
    stress_guard_free(&picture_memory);
    for (int i = 0; i < outputs; ++i) stress_guard_free(&output_memory[i]);
}

static void *place(const stress_guard *guard, size_t size, int top) {
    return top ? stress_guard_top(guard, size) : guard->first;
}

/* Points everything of the frame into the guarded memory. */
static spt_hits guard_frame(int top) {
    const size_t pixels = pixels_of(&self.frame);
    spt_hits image;
    float *const t_max = place(&t_max_memory, 4 * pixels, top);
    for (size_t i = 0; i < pixels; ++i) t_max[i] = stress_infinity();
    self.frame.t_max.first = t_max;
    self.frame.t_max.stride = 4;
    memset(work_memory.first, 0xff, work_memory.size);
    self.frame.workspace_size = spt_frame_workspace(&self.frame);
    self.frame.workspace = place(&work_memory, self.frame.workspace_size, top);
    for (int column = 0; column < outputs; ++column) {
        memset(output_memory[column].first, 0xa5, output_memory[column].size);
        out[column] = place(&output_memory[column], 4 * pixels, top);
        sink_of(&image, column)->first = out[column];
        sink_of(&image, column)->stride = 4;
    }
    return image;
}

static void check_guarded(const char *what) {
    const size_t pixels = pixels_of(&self.frame);
    CHECK(stress_guard_is_filled(&work_memory, self.frame.workspace, self.frame.workspace_size,
                                 0xff));
    for (int column = 0; column < outputs; ++column) {
        size_t wrong = 0;
        CHECK(stress_guard_is_filled(&output_memory[column], out[column], 4 * pixels, 0xa5));
        for (size_t i = 0; i < pixels; ++i) {
            wrong += memcmp(out[column] + 4 * i, (const char *)&right[i] + 4 * column, 4) != 0;
        }
        CHECK_SAY(wrong == 0, "%s, column %d: %u of %u wrong", what, column, (unsigned)wrong,
                  (unsigned)pixels);
    }
}

static void trace_guarded(int top) {
    const spt_hits image = guard_frame(top);
    CHECK(spt_frame_trace(&self.frame, 0, spt_frame_tiles(&self.frame), &image, NULL) == SPT_OK);
    check_guarded("tiles");
}

static void advance_guarded(int top) {
    const size_t size = spt_frame_state_size(&self.frame);
    const size_t colours = 4 * frame_channels * pixels_of(&self.frame);
    const spt_hits image = guard_frame(top);
    memset(state_memory.first, 0x6b, state_memory.size);
    memset(picture_memory.first, 0x6b, picture_memory.size);
    void *const state = place(&state_memory, size, top);
    const spt_sink picture = {place(&picture_memory, colours, top), 4 * frame_channels};
    spt_frame_progress progress;
    memset(&progress, 0, sizeof progress);
    CHECK(spt_frame_restart(&self.frame, state, size) == SPT_OK);
    for (int i = 0; progress.pass < self.frame.pass_count && i < 100000; ++i) {
        CHECK(spt_frame_advance(&self.frame, state, size, 1500, &image, &progress) == SPT_OK);
        if (i % 8 == 0) CHECK(spt_frame_picture(&self.frame, state, size, &picture) == SPT_OK);
    }
    CHECK(progress.pass == self.frame.pass_count);
    CHECK(spt_frame_picture(&self.frame, state, size, &picture) == SPT_OK);
    CHECK(stress_guard_is_filled(&state_memory, state, size, 0x6b));
    CHECK(stress_guard_is_filled(&picture_memory, picture.first, colours, 0x6b));
    check_guarded("passes");
}

static void F7e_images_between_guard_pages(void) {
    static const uint32_t sizes[][2] = {{1, 1},   {1, 9},  {7, 5},   {16, 16}, {17, 15},
                                        {63, 64}, {64, 1}, {65, 33}, {64, 64}, {80, 70}};
    for (FOR_EACH_WAY) {
        for (int i = way.index % 2; i < 10; i += 2) {
            resize(&way, sizes[i][0], sizes[i][1]);
            frame_memory(&self);
            if (!make_memory(self.workspace_size, self.state_size)) {
                check_skip("F7e: no guard pages here");
                return;
            }
            check_context("method %s, %u x %u", way.name, (unsigned)sizes[i][0],
                          (unsigned)sizes[i][1]);
            frame_trace_whole(&self);
            memcpy(right, self.hits, sizeof right);
            trace_guarded(0);
            trace_guarded(1);
            self.frame.workspace = self.workspace;
            self.frame.workspace_size = self.workspace_size;
            self.frame.t_max.first = NULL;
            frame_advance_whole(&self, UINT64_MAX);
            memcpy(right, self.hits, sizeof right);
            advance_guarded(0);
            advance_guarded(1);
            free_memory();
        }
    }
}

/* Sinks with room between the pixels, and only some of them: the rest keeps its bytes. */
static void F7f_canaries_between_pixels(void) {
    enum { stride = 11 };
    static unsigned char bytes[frame_pixels * stride + 4];
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        for (int column = 0; column < outputs; ++column) {
            spt_hits image;
            memset(&image, 0, sizeof image);
            memset(bytes, 0x7e, sizeof bytes);
            /* From the last pixel to the first, unaligned, in the middle of the gaps. */
            sink_of(&image, column)->first = bytes + (frame_pixels - 1) * stride + 3;
            sink_of(&image, column)->stride = -stride;
            CHECK(spt_frame_trace(&self.frame, 0, 4, &image, NULL) == SPT_OK);
            size_t wrong = 0;
            for (size_t i = 0; i < sizeof bytes; ++i) {
                const size_t pixel = frame_pixels - 1 - i / stride, at = i % stride;
                const int inside = i < frame_pixels * stride && at >= 3 && at < 7;
                const unsigned char *const word =
                    (const unsigned char *)&right[inside ? pixel : 0] + 4 * column;
                wrong += bytes[i] != (inside ? word[at - 3] : 0x7e);
            }
            CHECK_SAY(wrong == 0, "column %d: %u bytes", column, (unsigned)wrong);
        }
    }
}

/* One tile writes its own pixels. */
static void F7g_a_tile_writes_its_own_pixels(void) {
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        for (size_t tile = 0; tile < 4; ++tile) {
            uint32_t area[4];
            size_t wrong = 0;
            memset(self.hits, 0xa5, sizeof self.hits);
            CHECK(spt_frame_tile(&self.frame, tile, &self.image) == SPT_OK);
            CHECK(spt_frame_area(&self.frame, tile, area) == SPT_OK);
            for (uint32_t i = 0; i < frame_pixels; ++i) {
                const uint32_t x = i % frame_width, y = i / frame_width;
                const int own = x >= area[0] && x < area[2] && y >= area[1] && y < area[3];
                spt_hit untouched;
                memset(&untouched, 0xa5, sizeof untouched);
                wrong += !stress_same_hit(&self.hits[i], own ? &right[i] : &untouched);
            }
            CHECK_SAY(wrong == 0, "tile %u: %u pixels", (unsigned)tile, (unsigned)wrong);
        }
    }
}

/* ---- F8: alignment and contents -------------------------------------------------------------- */

static void F8d_frame_memory_of_any_alignment(void) {
    for (FOR_EACH_WAY) {
        frame_base(&self, &way);
        frame_trace_whole(&self);
        memcpy(right, self.hits, sizeof right);
        const size_t size = spt_frame_workspace(&self.frame);
        unsigned char *const memory = malloc(size + 64);
        unsigned char *const state = malloc(self.state_size + 64);
        CHECK(memory != NULL && state != NULL);
        if (memory == NULL || state == NULL) break;
        for (size_t shift = 0; shift < 64; shift += shift < 20 ? 1 : 11) {
            memset(memory, (int)(0x90 + shift), size + 64);
            memset(self.hits, 0xa5, sizeof self.hits);
            self.frame.workspace = memory + shift;
            frame_trace_whole(&self);
            CHECK_SAY(frame_differing(self.hits, right, frame_pixels) == 0, "%u bytes off",
                      (unsigned)shift);
            for (size_t i = size + shift; i < size + 64; ++i) CHECK(memory[i] == 0x90 + shift);
            for (size_t i = 0; i < shift; ++i) CHECK(memory[i] == 0x90 + shift);
        }
        frame_advance_whole(&self, UINT64_MAX);
        memcpy(right, self.hits, sizeof right);
        void *const own = self.state;
        for (size_t shift = 1; shift < 64; shift += 9) {
            memset(state, (int)(0x90 + shift), self.state_size + 64);
            memset(self.hits, 0xa5, sizeof self.hits);
            self.state = state + shift;
            frame_advance_whole(&self, 50000);
            CHECK_SAY(frame_differing(self.hits, right, frame_pixels) == 0, "state %u off",
                      (unsigned)shift);
            for (size_t i = 0; i < shift; ++i) CHECK(state[i] == 0x90 + shift);
        }
        self.state = own;
        free(memory);
        free(state);
    }
}

/* ---- F9: huge images ------------------------------------------------------------------------- */

/* One tile of an image that no memory holds: its pixels are those of spt_scene_trace(). */
static void F9_regions_of_huge_images(void) {
    static const uint32_t sizes[] = {46341, 65536, 1u << 22};
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 6; ++i) {
            const uint32_t size = sizes[i / 2], side = 64;
            static spt_ray rays[64 * 64];
            static spt_hit hits[64 * 64];
            resize(&way, size, size);
            self.frame.left = i % 2 == 0 ? size / 2 / 64 * 64 : (size - 1) / 64 * 64;
            self.frame.top = i % 2 == 0 ? size / 2 / 64 * 64 : (size - 1) / 64 * 64;
            self.frame.right = self.frame.left + side < size ? self.frame.left + side : size;
            self.frame.bottom = self.frame.top + side < size ? self.frame.top + side : size;
            self.frame.flags = SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING;
            CHECK(spt_frame_tiles(&self.frame) == 1);
            frame_memory(&self);
            CHECK(self.workspace_size < (size_t)4 << 20 && self.state_size < (size_t)4 << 20);
            frame_trace_whole(&self);
            const uint32_t wide = self.frame.right - self.frame.left;
            const size_t pixels = pixels_of(&self.frame);
            for (size_t k = 0; k < pixels; ++k) {
                const float x = (float)(self.frame.left + (uint32_t)(k % wide)) + 0.5f;
                const float y = (float)(self.frame.top + (uint32_t)(k / wide)) + 0.5f;
                spt_camera_ray ray;
                CHECK(spt_camera_rays(&self.camera, size, size, 1, &x, &y, &ray) == SPT_OK);
                rays[k] = ray.ray;
            }
            spt_settings settings = self.frame.settings;
            union_trace(&way, &self.world.scene, self.world.parts, &settings, pixels, rays, hits);
            CHECK(frame_differing(self.hits, hits, pixels) == 0);
            frame_advance_whole(&self, 100000);
            CHECK(frame_differing(self.hits, hits, pixels) == 0);
            self.frame.flags = 0;
            frame_trace_whole(&self);
            size_t other = 0;
            for (size_t k = 0; k < pixels; ++k) other += self.hits[k].outcome != hits[k].outcome;
            CHECK(other == 0); /* a tile of 2^-9 of the image has no silhouette here */
        }
    }
}

/* ---- F6: no cone can be ---------------------------------------------------------------------- */

static void F6_frames_without_cones(void) {
    static const float eye[3] = {0.0f, 0.5f, 0.0f}, target[3] = {0.0f, 0.0f, 9.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    static const float tangents[] = {0.3f, 1.0f, 57.0f, 1e6f};
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 4; ++i) {
            resize(&way, 1, 1);
            CHECK(spt_camera_pinhole(&self.camera, eye, target, up, tangents[i], 1, 1) == SPT_OK);
            frame_memory(&self);
            self.frame.flags = SPT_FRAME_NO_CONES;
            frame_trace_whole(&self);
            memcpy(right, self.hits, sizeof right);
            self.frame.flags = 0;
            frame_trace_whole(&self);
            CHECK_SAY(stress_same_hit(&self.hits[0], &right[0]),
                      "tangent %g: %u and %u evaluations", (double)tangents[i],
                      (unsigned)self.hits[0].evaluations, (unsigned)right[0].evaluations);
        }
    }
}

void suite_frame_memory(void) {
    RUN(F6_frames_without_cones);
    RUN(F7e_images_between_guard_pages);
    RUN(F7f_canaries_between_pixels);
    RUN(F7g_a_tile_writes_its_own_pixels);
    RUN(F8d_frame_memory_of_any_alignment);
    RUN(F9_regions_of_huge_images);
    frame_free(&self);
}
