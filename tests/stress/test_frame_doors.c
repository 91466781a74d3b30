/* SPDX-License-Identifier: MIT
 *
 * The calls of test_frame_doors.h. */
#include "test_frame_doors.h"

#include <stdio.h>
#include <string.h>

door_case door;

static double stopped_clock(void *user) {
    (void)user;
    CHECK(0); /* no callback is called */
    return 0.0;
}

void door_prepare(const stress_way *way) {
    frame_base(&door.base, way);
    door.given = &door.base.frame;
    door.statistics = spt_statistics_default();
    door.base.frame.statistics = &door.statistics;
    memset(door.area, 0x5a, sizeof door.area);
    memset(&door.done, 0x5a, sizeof door.done);
    memset(&door.progress, 0x5a, sizeof door.progress);
    memset(&door.depth, 0, sizeof door.depth);
    door.depth.kind = SPT_DEPTH_LINEAR;
    memset(door.depths, 0x5a, sizeof door.depths);
    door.depths_in.first = door.depths_out.first = door.depths;
    door.depths_in.stride = door.depths_out.stride = sizeof *door.depths;
}

static uint64_t add_bytes(uint64_t hash, const void *bytes, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u; /* FNV-1a */
    }
    return hash;
}

uint64_t door_bytes(void) {
    const frame_case *const base = &door.base;
    uint64_t hash = add_bytes(0xcbf29ce484222325u, &base->frame, sizeof base->frame);
    hash = add_bytes(hash, &base->camera, sizeof base->camera);
    hash = add_bytes(hash, &base->world.parts, sizeof base->world.parts); /* and their calls */
    hash = add_bytes(hash, &base->shaded, sizeof base->shaded);
    hash = add_bytes(hash, &door.statistics, sizeof door.statistics);
    hash = add_bytes(hash, door.area, sizeof door.area);
    hash = add_bytes(hash, &door.done, sizeof door.done);
    return add_bytes(hash, &door.progress, sizeof door.progress);
}

/* The large arrays are filled with one byte each. */
static int filled(const void *bytes, size_t size, unsigned char value) {
    const unsigned char *const first = bytes;
    return size == 0 || (first[0] == value && memcmp(first, first + 1, size - 1) == 0);
}

static int memory_untouched(void) {
    const frame_case *const base = &door.base;
    return filled(base->hits, sizeof base->hits, 0xa5) &&
           filled(base->colours, sizeof base->colours, 0xa5) &&
           filled(base->workspace, base->workspace_size, 0x3c) &&
           filled(base->state, base->state_size, 0x3c) &&
           filled(door.depths, sizeof door.depths, 0x5a);
}

static spt_status size_status(size_t size) {
    return size == 0 ? SPT_BAD_ARGUMENT : SPT_OK;
}

spt_status door_enter(int which) {
    const spt_frame *const frame = door.given;
    frame_case *const base = &door.base;
    switch (which) {
    case DOOR_TILES:
        return size_status(spt_frame_tiles(frame));
    case DOOR_AREA:
        return spt_frame_area(frame, 0, door.area);
    case DOOR_WORKSPACE:
        return size_status(spt_frame_workspace(frame));
    case DOOR_TILE:
        return spt_frame_tile(frame, 0, &base->image);
    case DOOR_TRACE:
        return spt_frame_trace(frame, 0, 1, &base->image, &door.done);
    case DOOR_STATE_SIZE:
        return size_status(spt_frame_state_size(frame));
    case DOOR_RESTART:
        return spt_frame_restart(frame, base->state, base->state_size);
    case DOOR_ADVANCE:
        return spt_frame_advance(frame, base->state, base->state_size, 1000, &base->image,
                                 &door.progress);
    case DOOR_ADVANCE_FOR:
        return spt_frame_advance_for(frame, base->state, base->state_size, 1.0, stopped_clock, NULL,
                                     &base->image, &door.progress);
    case DOOR_PICTURE:
        return spt_frame_picture(frame, base->state, base->state_size, &base->picture);
    case DOOR_DEPTH:
        return spt_frame_depth(frame, &door.depth, &door.depths_in, &door.depths_out);
    default:
        return spt_frame_t_of_depth(frame, &door.depth, &door.depths_in, &door.depths_out);
    }
}

void door_refused(spt_status status, spt_status expected, uint64_t before, const char *why) {
    CHECK_SAY(status == expected, "%s: %s", why, spt_status_name(status));
    CHECK_SAY(before == door_bytes() && memory_untouched(), "%s: something was written", why);
}

void door_closed(int doors, spt_status expected, const char *why) {
    for (int which = 1; which < DOORS; which *= 2) {
        char at[200];
        if ((doors & which) == 0) continue;
        const uint64_t before = door_bytes();
        const spt_status status = door_enter(which);
        snprintf(at, sizeof at, "door %d, %s", which, why);
        door_refused(status, expected, before, at);
    }
}
