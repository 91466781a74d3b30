/* SPDX-License-Identifier: MIT
 *
 * Row F10 for what only progressive frames and depth buffers take: passes, colours, states, clocks
 * and depths. Each wrong argument is refused with nothing written and no callback called. What
 * progressive frames do is in test_frame_resume.c. */
#include "test_frame_doors.h"

#include <string.h>

static frame_case *const base = &door.base;

#define FOR_EACH_WAY \
    stress_way way = stress_ways(STRESS_CONVEX | STRESS_ONCE); \
    stress_next(&way);

/* ---- Passes and colours ---------------------------------------------------------------------- */

static spt_pass passes[17];

static void take_passes(size_t count) {
    for (size_t i = 0; i < 17; ++i) {
        const spt_pass pass = {1, i + 1 == count ? 1 : 2, 0.25f};
        passes[i] = pass;
    }
    base->frame.passes = passes;
    base->frame.pass_count = count;
}

#define REFUSE_PASSES(spoil) DOOR_REFUSE(DOORS_OF_PASSES, (take_passes(3), (spoil)))

static void F10z_frame_passes(void) {
    const float bad[] = {0.0f, -0.0f, -0.5f, 1.0000001f, stress_nan(), stress_infinity()};
    for (FOR_EACH_WAY) {
        for (int i = 0; i < 3; ++i) {
            REFUSE_PASSES(passes[i].numerator = 0);
            REFUSE_PASSES(passes[i].numerator = passes[i].denominator + 1);
            REFUSE_PASSES(passes[i].denominator = 0);
            REFUSE_PASSES((passes[i].numerator = 0, passes[i].denominator = 0, 0));
            for (int k = 0; k < 6; ++k) REFUSE_PASSES(passes[i].share = bad[k]);
        }
        REFUSE_PASSES((passes[2].numerator = 3, passes[2].denominator = 4)); /* not full size */
        REFUSE_PASSES((passes[2].numerator = UINT32_MAX - 1, passes[2].denominator = UINT32_MAX));
        REFUSE_PASSES(base->frame.pass_count = 0);
        REFUSE_PASSES(base->frame.pass_count = 17);
        REFUSE_PASSES(base->frame.pass_count = SIZE_MAX);
        for (size_t count = 1; count <= 16; count += 5) {
            door_prepare(&way);
            take_passes(count);
            frame_memory(base);
            CHECK(spt_frame_restart(&base->frame, base->state, base->state_size) == SPT_OK);
            CHECK(door_enter(DOOR_ADVANCE) == SPT_OK);
        }
        DOOR_REFUSE(DOORS_OF_PASSES, base->frame.channels = 0);
        DOOR_REFUSE(DOORS_OF_PASSES, base->frame.channels = 17);
        DOOR_REFUSE(DOORS_OF_PASSES, base->frame.channels = UINT32_MAX);
        DOOR_REFUSE(DOOR_PICTURE, base->frame.shade = NULL);
        DOOR_REFUSE(DOOR_PICTURE, base->picture.first = NULL);
        DOOR_REFUSE(DOOR_PICTURE, base->picture.stride = 0);
        DOOR_REFUSE(DOOR_PICTURE, base->picture.stride = PTRDIFF_MAX / 1000);
    }
}

/* ---- States and clocks ----------------------------------------------------------------------- */

static double running_clock(void *user) {
    double *const seconds = user;
    return *seconds += 3e-6;
}

static double broken_clock(void *user) {
    double *const seconds = user;
    *seconds += 1.0;
    return 42.0;
}

static void F10za_frame_states(void) {
    const spt_frame *const frame = &base->frame;
    spt_frame_progress *const progress = &door.progress;
    uint64_t before;
    for (FOR_EACH_WAY) {
        door_prepare(&way);
        void *const state = base->state;
        const size_t size = base->state_size;
        const int doors = DOOR_RESTART | DOOR_ADVANCE | DOOR_ADVANCE_FOR;
        base->state_size -= 1;
        door_closed(doors, SPT_BUFFER_TOO_SMALL, "one byte too small");
        base->state_size = 0;
        door_closed(doors, SPT_BUFFER_TOO_SMALL, "no bytes");
        before = door_bytes();
        const spt_status status = door_enter(DOOR_PICTURE);
        CHECK(status == SPT_BAD_ARGUMENT || status == SPT_BUFFER_TOO_SMALL);
        door_refused(status, status, before, "no bytes to make a picture of");
        base->state_size = size;
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_restart(frame, NULL, size));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT,
                         spt_frame_advance(frame, NULL, size, 9, &base->image, progress));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_picture(frame, NULL, size, &base->picture));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_picture(frame, state, size, NULL));
    }
}

/* No surface, and never far from one: takes every evaluation there is. */
static float never_far(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return 0.02f;
}

static void F10zb_frame_clocks(void) {
    const float bad[] = {stress_nan(), -1.0f, -stress_infinity()};
    uint64_t before;
    for (FOR_EACH_WAY) {
        const spt_frame *const frame = &base->frame;
        double seconds = 0.0;
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT,
                         spt_frame_advance_for(frame, base->state, base->state_size, 1.0, NULL,
                                               NULL, &base->image, &door.progress));
        for (int i = 0; i < 3; ++i) {
            DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT,
                             spt_frame_advance_for(frame, base->state, base->state_size,
                                                   (double)bad[i], running_clock, &seconds,
                                                   &base->image, &door.progress));
        }
        door_prepare(&way);
        base->world.parts[4] = union_part_of(never_far, NULL);
        CHECK(spt_frame_restart(frame, base->state, base->state_size) == SPT_OK);
        seconds = 0.0;
        CHECK(spt_frame_advance_for(frame, base->state, base->state_size, 1.0, broken_clock,
                                    &seconds, NULL, &door.progress) == SPT_UNSUPPORTED);
        CHECK_SAY(door.progress.evaluations >= 1 << 16 && door.progress.evaluations < 1 << 17,
                  "%lu evaluations", (unsigned long)door.progress.evaluations);
        CHECK(seconds >= 2.0);
        /* A clock of small steps ends the call long before the frame. */
        CHECK(spt_frame_restart(frame, base->state, base->state_size) == SPT_OK);
        seconds = 0.0;
        CHECK(spt_frame_advance_for(frame, base->state, base->state_size, 1e-5, running_clock,
                                    &seconds, NULL, &door.progress) == SPT_OK);
        CHECK(door.progress.pass < 4 && door.progress.evaluations > 0);
        CHECK_SAY(seconds > 1e-5 && seconds < 1e-3, "%g seconds", seconds);
    }
}

/* ---- Depths ---------------------------------------------------------------------------------- */

enum { DOORS_OF_DEPTH = DOOR_DEPTH | DOOR_T_OF_DEPTH };

static void set_depth(uint32_t kind, float near_plane, float far_plane) {
    door.depth.kind = kind;
    door.depth.near_plane = near_plane;
    door.depth.far_plane = far_plane;
}

static void refuse_depth(const stress_way *way, int flat, uint32_t kind, float near_plane,
                         float far_plane) {
    static const float eye[3] = {0.0f, 0.0f, 0.0f}, ahead[3] = {0.0f, 0.0f, 1.0f};
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    door_prepare(way);
    if (flat) {
        CHECK(spt_camera_orthographic(&base->camera, eye, ahead, up, 2.0f, frame_width,
                                      frame_height) == SPT_OK);
    }
    set_depth(kind, near_plane, far_plane);
    check_context("kind %u, %g to %g, %s", (unsigned)kind, (double)near_plane, (double)far_plane,
                  flat ? "orthographic" : "pinhole");
    door_closed(DOORS_OF_DEPTH, SPT_BAD_ARGUMENT, "planes");
}

static void no_rays(void *user, size_t count, const float *x, const float *y,
                    spt_camera_ray *rays) {
    (void)user, (void)count, (void)x, (void)y, (void)rays;
    CHECK(0); /* no callback is called */
}

static void F10zc_frame_depths(void) {
    const float infinity = stress_infinity(), nan = stress_nan();
    const float bad[][2] = {{0.0f, 10.0f},      {-1.0f, 10.0f}, {nan, 10.0f},
                            {1.0f, nan},        {1.0f, 1.0f},   {infinity, infinity},
                            {-infinity, 10.0f}, {1.0f, -0.0f},  {1.0f, -5.0f}};
    const float flat[][2] = {{nan, 1.0f},   {1.0f, nan},      {2.0f, 2.0f},
                             {0.0f, -0.0f}, {1.0f, infinity}, {-infinity, 1.0f}};
    for (stress_way way = stress_ways(STRESS_ONCE); stress_next(&way);) {
        if (way.index > 0) continue;
        for (uint32_t kind = SPT_DEPTH_DEVICE; kind <= SPT_DEPTH_DEVICE_GL; ++kind) {
            for (int i = 0; i < 9; ++i) refuse_depth(&way, 0, kind, bad[i][0], bad[i][1]);
            for (int i = 0; i < 6; ++i) refuse_depth(&way, 1, kind, flat[i][0], flat[i][1]);
        }
        static const uint32_t kinds[] = {0, 4, UINT32_MAX};
        for (int i = 0; i < 3; ++i) refuse_depth(&way, i % 2, kinds[i], 1.0f, 10.0f);
        DOOR_REFUSE(DOORS_OF_DEPTH, door.depths_in.first = NULL);
        DOOR_REFUSE(DOORS_OF_DEPTH, door.depths_out.first = NULL);
        DOOR_REFUSE(DOORS_OF_DEPTH, door.depths_out.stride = 0);
        DOOR_REFUSE(DOORS_OF_DEPTH, door.depths_out.stride = PTRDIFF_MAX / 1000);
        DOOR_REFUSE(DOORS_OF_DEPTH, door.depths_in.stride = PTRDIFF_MAX / 1000);
        uint64_t before;
        const spt_frame *const frame = &base->frame;
        const spt_column *const in = &door.depths_in;
        const spt_sink *const out = &door.depths_out;
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_depth(frame, NULL, in, out));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_depth(frame, &door.depth, NULL, out));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_depth(frame, &door.depth, in, NULL));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_t_of_depth(frame, NULL, in, out));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_t_of_depth(frame, &door.depth, NULL, out));
        DOOR_REFUSE_CALL(SPT_BAD_ARGUMENT, spt_frame_t_of_depth(frame, &door.depth, in, NULL));
        door_prepare(&way);
        base->camera = spt_camera_of_rays(no_rays, NULL);
        door_closed(DOORS_OF_DEPTH, SPT_UNSUPPORTED, "the caller's rays");
    }
}

void suite_frame_progressive(void) {
    RUN(F10z_frame_passes);
    RUN(F10za_frame_states);
    RUN(F10zb_frame_clocks);
    RUN(F10zc_frame_depths);
    frame_free(base);
}
