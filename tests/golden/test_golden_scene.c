/* SPDX-License-Identifier: MIT
 *
 * Pinned results of unions and frames: one hash of (t, outcome, component, evaluations) and the
 * evaluations per scene and rule, and per scene, schedule and cones, the same for every width,
 * compiler and architecture. A changed line of golden_scene_hashes.h is explained in the change that
 * makes it; `build/check golden_scene` prints the lines that differ. */
#include "check.h"
#include "rules.h"
#include "scenes/parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { wide = 80, high = 48, count = wide * high };

typedef struct golden {
    const char *scene, *what; /* a rule, or cones or no_cones */
    int schedule;             /* -1: a union; 0: tiles; else the number of passes */
    uint64_t evaluations;
    uint32_t hash;
} golden;

static const golden pinned[] = {
#define GOLDEN_UNION(scene, rule, evaluations, hash) {#scene, #rule, -1, evaluations, hash},
#define GOLDEN_FRAME(scene, cones, schedule, evaluations, hash) \
    {#scene, #cones, schedule, evaluations, hash},
#include "golden_scene_hashes.h"
#undef GOLDEN_UNION
#undef GOLDEN_FRAME
};
enum { pinned_count = sizeof pinned / sizeof pinned[0] };

static scene_parts parts;
static spt_ray rays[count];
static spt_hit hits[count];

static uint32_t fnv(uint32_t hash, uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) {
        hash = (hash ^ (word >> 8 * byte & 255)) * 16777619u; /* FNV-1a */
    }
    return hash;
}

/* Compares the hits with the pinned line, and prints the right one where they differ. */
static void compare(const char *scene_name, const char *what, int schedule) {
    golden now = {scene_name, what, schedule, 0, 2166136261u};
    int same = 0;
    for (int i = 0; i < count; ++i) {
        now.hash = fnv(now.hash, check_bits(hits[i].t));
        now.hash = fnv(now.hash, (uint32_t)hits[i].outcome);
        now.hash = fnv(now.hash, (uint32_t)hits[i].component);
        now.hash = fnv(now.hash, hits[i].evaluations);
        now.evaluations += hits[i].evaluations;
    }
    for (int i = 0; i < pinned_count && !same; ++i) {
        same = strcmp(pinned[i].scene, scene_name) == 0 && strcmp(pinned[i].what, what) == 0 &&
               pinned[i].schedule == schedule && pinned[i].hash == now.hash &&
               pinned[i].evaluations == now.evaluations;
    }
    check_context("scene %s, %s, schedule %d", scene_name, what, schedule);
    CHECK(same);
    if (same) return;
    if (schedule < 0) {
        printf("GOLDEN_UNION(%s, %s, %lu, 0x%08xu)\n", scene_name, what,
               (unsigned long)now.evaluations, (unsigned)now.hash);
    } else {
        printf("GOLDEN_FRAME(%s, %s, %d, %lu, 0x%08xu)\n", scene_name, what, schedule,
               (unsigned long)now.evaluations, (unsigned)now.hash);
    }
}

/* ---- Unions ---------------------------------------------------------------------------------- */

static void trace_union(const scene *shown, const rule *one, uint32_t lanes, float pixel_radius) {
    spt_settings settings = spt_settings_default();
    uint32_t common = SPT_FIELD_CONVEX;
    settings.method = one->method();
    settings.pixel_radius = pixel_radius;
    settings.max_lanes = lanes;
    scene_parts_of(shown, SCENE_OBJECTS, width_run(lanes), &parts);
    for (size_t i = 0; i < parts.scene.count; ++i) common &= parts.fields[i].flags;
    if (parts.scene.count == 1 || !rule_allowed(one, common)) return;
    const size_t size = spt_scene_workspace(&parts.scene, &settings);
    void *const workspace = malloc(size);
    const spt_rays in = spt_rays_of(rays);
    const spt_hits out = spt_hits_of(hits);
    CHECK(size > 0 && workspace != NULL);
    CHECK(spt_scene_trace(&parts.scene, &settings, count, &in, &out, workspace, size, NULL) ==
          SPT_OK);
    free(workspace);
    compare(shown->name, one->name, -1);
}

static void golden_scene_unions(void) {
    for (size_t i = 0; i < scene_count; ++i) {
        float pixel_radius;
        scene_rays_tiled(scenes[i], wide, high, rays, NULL, &pixel_radius);
        for (int j = 0; j < rule_count; ++j) {
            for (int k = 0; k < width_count; ++k) {
                trace_union(scenes[i], &rules[j], widths[k], pixel_radius);
            }
        }
    }
}

/* ---- Frames ---------------------------------------------------------------------------------- */

static void trace_frame(const scene *shown, int schedule, uint32_t flags, uint32_t lanes) {
    const spt_camera camera = scene_camera(shown, wide, high);
    const spt_hits image = spt_hits_of(hits);
    spt_frame frame;
    scene_parts_of(shown, SCENE_OBJECTS, width_run(lanes), &parts);
    CHECK(spt_frame_init(&frame, &parts.scene, &camera, wide, high) == SPT_OK);
    frame.settings.max_lanes = lanes;
    frame.flags = flags;
    frame.passes = schedule > 0 ? spt_passes((size_t)schedule) : NULL;
    frame.pass_count = (size_t)schedule;
    const size_t size = schedule > 0 ? spt_frame_state_size(&frame) : spt_frame_workspace(&frame);
    void *const memory = malloc(size);
    CHECK(size > 0 && memory != NULL);
    memset(hits, 0xa5, sizeof hits);
    if (schedule == 0) {
        frame.workspace = memory;
        frame.workspace_size = size;
        CHECK(spt_frame_trace(&frame, 0, spt_frame_tiles(&frame), &image, NULL) == SPT_OK);
    } else {
        CHECK(spt_frame_restart(&frame, memory, size) == SPT_OK);
        CHECK(spt_frame_advance(&frame, memory, size, UINT64_MAX, &image, NULL) == SPT_OK);
    }
    free(memory);
    compare(shown->name, flags == 0 ? "cones" : "no_cones", schedule);
}

static void golden_scene_frames(void) {
    static const int schedules[] = {0, 1, 2, 4, 6};
    for (size_t i = 0; i < scene_count; ++i) {
        for (int k = 0; k < 5; ++k) {
            trace_frame(scenes[i], schedules[k], 0, widths[(i + (size_t)k) % width_count]);
            trace_frame(scenes[i], schedules[k], SPT_FRAME_NO_CONES, 16);
        }
    }
}

void suite_golden_scene(void) {
    RUN(golden_scene_unions);
    RUN(golden_scene_frames);
}
