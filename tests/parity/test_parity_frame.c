/* SPDX-License-Identifier: MIT
 *
 * Equal bits of frames: every scene, taken apart, has the same image at every width, whatever the
 * order of the tiles, as a part of a larger image, with either form of the callbacks, and in any
 * division of its passes into calls; without cones and culling it is what spt_scene_trace() makes of
 * the camera's rays, and culling alone changes no result. Threads are in test_frame_host.c. */
#include "check.h"
#include "rules.h"
#include "scenes/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { wide = 70, high = 66, pixels = wide * high, channels = 2 }; /* four tiles */

static scene_parts parts;
static spt_camera camera;
static spt_frame frame;
static spt_hit expected[pixels], found[pixels];
static spt_ray rays[pixels];
static float colours[pixels * channels], expected_colours[pixels * channels];
static void *workspace, *state;
static size_t state_size;

static void give_back(void) {
    free(workspace);
    free(state);
    workspace = state = NULL;
}

static void take_memory(int progressive) {
    give_back();
    frame.workspace_size = spt_frame_workspace(&frame);
    frame.workspace = workspace = malloc(frame.workspace_size);
    CHECK(frame.workspace_size > 0 && workspace != NULL);
    if (workspace != NULL) memset(workspace, 0xff, frame.workspace_size);
    state_size = progressive ? spt_frame_state_size(&frame) : 0;
    if (!progressive) return;
    state = malloc(state_size);
    CHECK(state_size > 0 && state != NULL);
    if (state != NULL) memset(state, 0xff, state_size);
}

static void shade(void *user, size_t count, const float *x, const float *y, const spt_ray *from,
                  const spt_hit *hits, float *to) {
    (void)user, (void)from;
    for (size_t i = 0; i < count; ++i) {
        to[i * channels] = hits[i].t < 1e6f ? hits[i].t : x[i] + y[i];
        to[i * channels + 1] = (float)hits[i].component;
    }
}

/* A scene's frame for a width; lanes 0: callbacks of one point, on the widest. */
static void prepare(const scene *shown, const rule *one, uint32_t lanes, uint32_t flags) {
    scene_parts_of(shown, SCENE_OBJECTS, lanes != 0 ? width_run(lanes) : 0, &parts);
    camera = scene_camera(shown, wide, high);
    CHECK(spt_frame_init(&frame, &parts.scene, &camera, wide, high) == SPT_OK);
    frame.settings.method = one->method();
    frame.settings.max_lanes = lanes;
    frame.flags = flags;
}

static void trace(void) {
    const spt_hits image = spt_hits_of(found);
    memset(found, 0xa5, sizeof found);
    CHECK(spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &image, NULL) == SPT_OK);
}

static size_t differences(const spt_hit *a, const spt_hit *b, size_t count) {
    size_t differing = 0;
    for (size_t i = 0; i < count; ++i) differing += memcmp(&a[i], &b[i], sizeof a[i]) != 0;
    return differing;
}

static void expect_same(const char *what, unsigned number) {
    CHECK_SAY(differences(found, expected, pixels) == 0, "%s %u: %u differ", what, number,
              (unsigned)differences(found, expected, pixels));
}

/* The rule for a scene: all of them get their turns. */
static const rule *rule_of(size_t index) {
    const rule *const one = &rules[index % rule_count];
    return one->method() != spt_convex() ? one : &rules[0];
}

/* ---- Tiles ----------------------------------------------------------------------------------- */

static void parity_frame_widths(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        for (uint32_t flags = 0; flags < 4; ++flags) {
            const rule *const one = rule_of(i + flags);
            check_context("scene %s, rule %s, flags %u", scenes[i]->name, one->name, flags);
            prepare(scenes[i], one, 1, flags);
            take_memory(0);
            trace();
            memcpy(expected, found, sizeof found);
            for (int width = 1; width < width_count; ++width) {
                prepare(scenes[i], one, widths[width], flags);
                take_memory(0);
                trace();
                expect_same("lanes", widths[width]);
            }
            prepare(scenes[i], one, 0, flags);
            take_memory(0);
            trace();
            expect_same("one point, flags", flags);
        }
    }
    give_back();
}

/* Rays of the camera as spt_scene_trace() takes them, in the order of the image. */
static void make_rays(void) {
    for (size_t i = 0; i < pixels; ++i) {
        const float x = (float)(i % wide) + 0.5f, y = (float)(i / wide) + 0.5f;
        spt_camera_ray ray;
        CHECK(spt_camera_rays(&camera, wide, high, 1, &x, &y, &ray) == SPT_OK);
        rays[i] = ray.ray;
    }
}

static int same_place(const spt_hit *a, const spt_hit *b) {
    return check_same_bits(a->t, b->t) && check_same_bits(a->residual, b->residual) &&
           a->outcome == b->outcome && a->component == b->component;
}

static void parity_frame_is_its_rays(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        const rule *const one = rule_of(i);
        check_context("scene %s, rule %s", scenes[i]->name, one->name);
        prepare(scenes[i], one, 16, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING);
        take_memory(0);
        trace();
        const size_t size = spt_scene_workspace(&parts.scene, &frame.settings);
        void *const memory = malloc(size);
        const spt_rays in = spt_rays_of(rays);
        const spt_hits out = spt_hits_of(expected);
        make_rays();
        CHECK(spt_scene_trace(&parts.scene, &frame.settings, pixels, &in, &out, memory, size,
                              NULL) == SPT_OK);
        free(memory);
        expect_same("rays of", pixels);
        frame.flags = SPT_FRAME_NO_CONES;
        trace();
        size_t wrong = 0;
        for (size_t k = 0; k < pixels; ++k) wrong += !same_place(&found[k], &expected[k]);
        CHECK_SAY(wrong == 0, "culling changes %u pixels", (unsigned)wrong);
    }
    give_back();
}

static void parity_frame_order_of_tiles(void) {
    static const size_t orders[][4] = {{3, 2, 1, 0}, {1, 3, 0, 2}, {2, 0, 3, 1}};
    for (size_t i = 0; i < scene_count; ++i) {
        const spt_hits image = spt_hits_of(found);
        prepare(scenes[i], rule_of(i), 16, 0);
        check_context("scene %s", scenes[i]->name);
        take_memory(0);
        trace();
        memcpy(expected, found, sizeof found);
        for (int order = 0; order < 3; ++order) {
            memset(found, 0xa5, sizeof found);
            for (int k = 0; k < 4; ++k) {
                CHECK(spt_frame_tile(&frame, orders[order][k], &image) == SPT_OK);
            }
            expect_same("order", (unsigned)order);
        }
    }
    give_back();
}

/* ---- Parts of an image ----------------------------------------------------------------------- */

/* Draws a region; some are a pixel wide. */
static void draw_region(int narrow) {
    frame.left = check_random() % wide;
    frame.top = check_random() % high;
    frame.right = narrow ? frame.left + 1 : frame.left + 1 + check_random() % (wide - frame.left);
    frame.bottom = frame.top + 1 + check_random() % (high - frame.top);
}

static size_t differing_in_region(void) {
    const size_t columns = frame.right - frame.left;
    size_t differing = 0;
    for (uint32_t y = frame.top; y < frame.bottom; ++y) {
        differing += differences(found + (y - frame.top) * columns,
                                 expected + y * wide + frame.left, columns);
    }
    return differing;
}

static void run(uint64_t budget) {
    const spt_hits image = spt_hits_of(found);
    const uint32_t end = frame.passes != NULL ? (uint32_t)frame.pass_count : 1;
    spt_frame_progress progress;
    memset(found, 0xa5, sizeof found);
    memset(&progress, 0, sizeof progress);
    CHECK(spt_frame_restart(&frame, state, state_size) == SPT_OK);
    for (int call = 0; progress.pass < end && call < 1000000; ++call) {
        const uint64_t most = budget != 0 ? budget : 1 + check_random() % 20000;
        CHECK(spt_frame_advance(&frame, state, state_size, most, &image, &progress) == SPT_OK);
    }
    CHECK(progress.pass == end);
}

static void parity_frame_parts_of_an_image(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        for (uint32_t flags = 0; flags < 4; flags += 3) {
            prepare(scenes[i], rule_of(i), 16, flags);
            check_context("scene %s, flags %u", scenes[i]->name, flags);
            take_memory(0);
            trace();
            memcpy(expected, found, sizeof found);
            for (int k = 0; k < 6; ++k) {
                draw_region(k == 0);
                trace();
                CHECK_SAY(differing_in_region() == 0, "%u pixels of %u..%u, %u..%u differ",
                          (unsigned)differing_in_region(), (unsigned)frame.left,
                          (unsigned)frame.right, (unsigned)frame.top, (unsigned)frame.bottom);
            }
            prepare(scenes[i], rule_of(i), 16, flags);
            frame.passes = spt_passes(4);
            frame.pass_count = 4;
            take_memory(1);
            run(UINT64_MAX);
            memcpy(expected, found, sizeof found);
            for (int k = 0; k < 3; ++k) {
                draw_region(k == 0);
                take_memory(1);
                run(UINT64_MAX);
                CHECK_SAY(differing_in_region() == 0, "passes: %u pixels of %u..%u, %u..%u differ",
                          (unsigned)differing_in_region(), (unsigned)frame.left,
                          (unsigned)frame.right, (unsigned)frame.top, (unsigned)frame.bottom);
            }
        }
    }
    give_back();
}

/* ---- Passes ---------------------------------------------------------------------------------- */

static void take_picture(void) {
    const spt_sink picture = {colours, channels * sizeof *colours};
    memset(colours, 0xa5, sizeof colours);
    CHECK(spt_frame_picture(&frame, state, state_size, &picture) == SPT_OK);
}

/* Every schedule, at every width, in calls of any size, has the image and the picture of one lane
 * and one call. */
static void parity_frame_passes(void) {
    static const size_t schedules[] = {1, 2, 4, 6};
    for (size_t i = 0; i < scene_count; ++i) {
        const size_t schedule = schedules[i % 4];
        for (int width = 0; width <= width_count; ++width) {
            const uint32_t lanes = width < width_count ? widths[width] : 0;
            prepare(scenes[i], rule_of(i + 1), lanes, (uint32_t)(i / 4) % 4);
            frame.passes = spt_passes(schedule);
            frame.pass_count = schedule;
            frame.shade = shade;
            frame.channels = channels;
            take_memory(1);
            run(width == 0 ? UINT64_MAX : 0);
            take_picture();
            check_context("scene %s, %u passes", scenes[i]->name, (unsigned)schedule);
            if (width == 0) {
                memcpy(expected, found, sizeof found);
                memcpy(expected_colours, colours, sizeof colours);
            }
            expect_same("lanes", lanes);
            CHECK(memcmp(colours, expected_colours, sizeof colours) == 0);
        }
    }
    give_back();
}

void suite_parity_frame(void) {
    RUN(parity_frame_widths);
    RUN(parity_frame_is_its_rays);
    RUN(parity_frame_order_of_tiles);
    RUN(parity_frame_parts_of_an_image);
    RUN(parity_frame_passes);
}
