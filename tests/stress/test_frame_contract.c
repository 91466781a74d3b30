/* SPDX-License-Identifier: MIT
 *
 * Row F10 for cameras and frames: wrong arguments of every function of frame.h that takes a frame.
 * Each must be refused with nothing written - results, state, workspace and frame are compared byte
 * by byte - and no callback called. What only the progressive functions and depth buffers take is in
 * test_frame_progressive.c. */
#include "test_frame_doors.h"
#include "stress_guard.h"

#include <string.h>

static frame_case *const base = &door.base;

#define EVERYWHERE(spoil) DOOR_REFUSE(DOORS - 1, spoil)
#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); \
    stress_next(&way);

static void F10o_frame_pointers_and_sizes(void) {
    for (FOR_EACH_WAY) {
        EVERYWHERE(door.given = NULL);
        EVERYWHERE(base->frame.struct_size = 0);
        EVERYWHERE(base->frame.struct_size -= 1);
        EVERYWHERE(base->frame.scene = NULL);
        EVERYWHERE(base->frame.camera = NULL);
        EVERYWHERE(base->frame.settings.struct_size = 0);
        EVERYWHERE(base->camera.struct_size = 0);
        EVERYWHERE(base->camera.struct_size -= 1);
        EVERYWHERE(base->frame.width = 0);
        EVERYWHERE(base->frame.height = 0);
        EVERYWHERE(base->frame.width = (1u << 22) + 1);
        EVERYWHERE(base->frame.height = (1u << 22) + 1);
        EVERYWHERE(base->frame.width = UINT32_MAX);
        EVERYWHERE(base->frame.left = base->frame.right + 1);
        EVERYWHERE(base->frame.top = base->frame.bottom + 1);
        EVERYWHERE(base->frame.right = frame_width + 1);
        EVERYWHERE(base->frame.bottom = frame_height + 1);
        EVERYWHERE(base->frame.right = UINT32_MAX);
        for (int bit = 2; bit < 32; ++bit) EVERYWHERE(base->frame.flags = (uint32_t)1 << bit);
    }
}

static void F10p_frame_scene_and_settings(void) {
    const int doors = DOOR_WORKSPACE | DOORS_THAT_TRACE;
    for (FOR_EACH_WAY) {
        DOOR_REFUSE(doors, base->world.scene.struct_size = 0);
        DOOR_REFUSE(doors, base->world.scene.count = 0);
        DOOR_REFUSE(doors, base->world.scene.fields = NULL);
        DOOR_REFUSE(doors, base->world.fields[4].lipschitz = 0.0f);
        DOOR_REFUSE(doors,
                    (base->world.fields[2].batch = NULL, base->world.fields[2].point = NULL));
        DOOR_REFUSE(doors, base->world.bounds[0].radius = -1.0f);
        DOOR_REFUSE(doors, base->world.scene.zone_count = 1);
        DOOR_REFUSE(doors, base->frame.settings.method = NULL);
        DOOR_REFUSE(doors, base->frame.settings.epsilon = 0.0f);
        DOOR_REFUSE(doors, base->frame.settings.pixel_radius = -1.0f);
        DOOR_REFUSE(doors, base->frame.settings.max_lanes = 3);
        DOOR_REFUSE(doors, base->frame.settings.flags = 32);
        DOOR_REFUSE(DOORS_THAT_TRACE, door.statistics.struct_size = 0);
    }
}

static void F10q_frame_cameras(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity()};
    for (FOR_EACH_WAY) {
        EVERYWHERE(base->camera.kind = 0);
        EVERYWHERE(base->camera.kind = 4);
        EVERYWHERE(base->camera.kind = UINT32_MAX);
        EVERYWHERE((base->camera.kind = SPT_CAMERA_RAYS, base->camera.rays = NULL));
        for (int i = 0; i < 9; ++i) {
            EVERYWHERE(base->camera.eye[i / 3] = bad[i % 3]);
            EVERYWHERE(base->camera.right[i / 3] = bad[i % 3]);
            EVERYWHERE(base->camera.up[i / 3] = bad[i % 3]);
            EVERYWHERE(base->camera.forward[i / 3] = bad[i % 3]);
        }
        for (int i = 0; i < 3; ++i) {
            EVERYWHERE(base->camera.x_low = bad[i]);
            EVERYWHERE(base->camera.x_high = bad[i]);
            EVERYWHERE(base->camera.y_low = bad[i]);
            EVERYWHERE(base->camera.y_high = bad[i]);
            EVERYWHERE(base->camera.t_min = bad[i]);
        }
        EVERYWHERE(base->camera.t_min = -1.0f);
        EVERYWHERE(base->camera.t_max = bad[0]);
        EVERYWHERE(memset(base->camera.up, 0, sizeof base->camera.up));
        EVERYWHERE(memset(base->camera.forward, 0, sizeof base->camera.forward));
        EVERYWHERE(memcpy(base->camera.up, base->camera.right, sizeof base->camera.up));
        EVERYWHERE(memcpy(base->camera.forward, base->camera.up, sizeof base->camera.up));
    }
}

static spt_sink *sink(spt_hits *hits, int index) {
    spt_sink *const all[] = {&hits->t,           &hits->residual,        &hits->outcome,
                             &hits->evaluations, &hits->flags,           &hits->component,
                             &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    return all[index];
}

static void F10r_frame_images_and_indices(void) {
    const spt_frame *const frame = &base->frame;
    const spt_hits *const image = &base->image;
    uint64_t before;
    for (FOR_EACH_WAY) {
        door_prepare(&way);
        const size_t tiles = spt_frame_tiles(frame);
        CHECK(tiles == 4);
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_tile(frame, tiles, image));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_tile(frame, SIZE_MAX, image));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_tile(frame, 0, NULL));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_area(frame, tiles, door.area));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_area(frame, SIZE_MAX, door.area));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_area(frame, 0, NULL));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_trace(frame, 0, 1, NULL, &door.done));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_trace(frame, 0, tiles + 1, image, &door.done));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_trace(frame, tiles, 1, image, &door.done));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_trace(frame, 1, SIZE_MAX, image, &door.done));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_trace(frame, SIZE_MAX, 2, image, &door.done));
        for (int i = 0; i < 9; ++i) {
            spt_sink *const one = sink(&base->image, i);
            DOOR_REFUSE(DOORS_THAT_TRACE, one->stride = 0);
            DOOR_REFUSE(DOORS_THAT_TRACE, one->stride = PTRDIFF_MAX / 1000);
            DOOR_REFUSE(DOORS_THAT_TRACE, one->stride = PTRDIFF_MIN);
            door_prepare(&way);
            *one = (spt_sink){NULL, 0};
            CHECK(spt_frame_tile(frame, 0, image) == SPT_OK);
        }
        DOOR_REFUSE(DOORS_THAT_TRACE, (base->frame.t_max.first = door.depths,
                                       base->frame.t_max.stride = PTRDIFF_MAX / 1000));
    }
}

/* Progressive frames work in their state. */
static void F10s_frame_workspaces(void) {
    const int doors = DOOR_TILE | DOOR_TRACE;
    for (FOR_EACH_WAY) {
        for (int small = 0; small < 3; ++small) {
            door_prepare(&way);
            if (small == 0) base->frame.workspace_size -= 1;
            if (small == 1) base->frame.workspace_size = 0;
            if (small == 2) base->frame.workspace_size = 1024;
            door_closed(doors, SPT_BUFFER_TOO_SMALL, "workspace_size");
        }
        for (int which = DOOR_TILE; which <= DOOR_TRACE; which *= 2) {
            door_prepare(&way);
            base->frame.workspace = NULL; /* whatever size it is said to have */
            const uint64_t before = door_bytes();
            const spt_status status = door_enter(which);
            CHECK(status == SPT_BAD_ARGUMENT || status == SPT_BUFFER_TOO_SMALL);
            door_refused(status, status, before, "no workspace");
        }
    }
}

/* 2^22 by 2^22 pixels of results that lie so far apart that size_t cannot count their bytes. */
static void F9b_sizes_beyond_memory(void) {
    static const size_t strides[] = {(size_t)1 << 20, (size_t)1 << 30, SIZE_MAX / 2 / 4};
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 3; ++i) {
            door_prepare(&way);
            base->frame.width = base->frame.height = 1u << 22;
            base->frame.right = base->frame.bottom = 1u << 22;
            for (int k = 0; k < 9; ++k) sink(&base->image, k)->stride = (ptrdiff_t)strides[i];
            door_closed(DOOR_TILE | DOOR_TRACE, SPT_BAD_ARGUMENT, "2^44 pixels");
        }
    }
}

/* ---- Structures longer than this library knows ---------------------------------------------- */

/* The known part lies against the upper guard: whoever reads the rest that struct_size claims, or
 * writes it, ends the program. */
static void F10t_frame_longer_structures(void) {
    enum { structures = 2, future = 4096 };
    stress_guard guard[structures];
    int made = 1;
    for (int i = 0; i < structures; ++i) made &= stress_guard_make(&guard[i], 1024);
    if (!made) {
        check_skip("F10t: no guard pages here");
        return;
    }
    spt_frame *const frame = stress_guard_top(&guard[0], sizeof *frame);
    spt_camera *const camera = stress_guard_top(&guard[1], sizeof *camera);
    for (FOR_EACH_WAY) {
        static spt_hit right[frame_pixels];
        door_prepare(&way);
        frame_trace_whole(base);
        memcpy(right, base->hits, sizeof right);
        *camera = base->camera;
        camera->struct_size += future;
        *frame = base->frame;
        frame->struct_size += future;
        frame->camera = camera;
        memset(base->hits, 0xa5, sizeof base->hits);
        CHECK(spt_frame_workspace(frame) == base->workspace_size);
        CHECK(spt_frame_state_size(frame) == base->state_size);
        CHECK(spt_frame_trace(frame, 0, 4, &base->image, NULL) == SPT_OK);
        CHECK(frame_differing(base->hits, right, frame_pixels) == 0);
        CHECK(spt_frame_restart(frame, base->state, base->state_size) == SPT_OK);
        CHECK(spt_frame_advance(frame, base->state, base->state_size, 1000, NULL, NULL) == SPT_OK);
        CHECK(frame->struct_size == sizeof *frame + future);
    }
    for (int i = 0; i < structures; ++i) stress_guard_free(&guard[i]);
}

void suite_frame_contract(void) {
    RUN(F10o_frame_pointers_and_sizes);
    RUN(F10p_frame_scene_and_settings);
    RUN(F10q_frame_cameras);
    RUN(F10r_frame_images_and_indices);
    RUN(F10s_frame_workspaces);
    RUN(F9b_sizes_beyond_memory);
    RUN(F10t_frame_longer_structures);
    frame_free(base);
}
