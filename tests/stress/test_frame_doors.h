/* SPDX-License-Identifier: MIT
 *
 * Every function of frame.h that takes a frame as a door that wrong arguments must not pass: a call
 * of each with right arguments, and a check that a refused call changed nothing and called nobody. */
#ifndef TESTS_FRAME_DOORS_H
#define TESTS_FRAME_DOORS_H

#include "test_frame_cases.h"

enum {
    DOOR_TILES = 1,
    DOOR_AREA = 2,
    DOOR_WORKSPACE = 4,
    DOOR_TILE = 8,
    DOOR_TRACE = 16,
    DOOR_STATE_SIZE = 32,
    DOOR_RESTART = 64,
    DOOR_ADVANCE = 128,
    DOOR_ADVANCE_FOR = 256,
    DOOR_PICTURE = 512,
    DOOR_DEPTH = 1024,
    DOOR_T_OF_DEPTH = 2048,
    DOORS = 4096,
    DOORS_THAT_TRACE = DOOR_TILE | DOOR_TRACE | DOOR_ADVANCE | DOOR_ADVANCE_FOR,
    DOORS_OF_PASSES =
        DOOR_STATE_SIZE | DOOR_RESTART | DOOR_ADVANCE | DOOR_ADVANCE_FOR | DOOR_PICTURE
};

/* All that the calls take and could write to. */
typedef struct door_case {
    frame_case base;
    const spt_frame *given; /* &base.frame, or NULL where the test wants that */
    spt_statistics statistics;
    uint32_t area[4];
    size_t done;
    spt_frame_progress progress;
    spt_depth depth;
    spt_column depths_in;
    spt_sink depths_out;
    float depths[frame_pixels];
} door_case;

extern door_case door;

/* Everything anew, and right. */
void door_prepare(const stress_way *way);

spt_status door_enter(int which);

/* A hash of all that a call could write to but the large arrays. */
uint64_t door_bytes(void);

/* A call that was refused: with this status, and door_bytes() are what they were before. */
void door_refused(spt_status status, spt_status expected, uint64_t before, const char *why);

/* Every one of these doors is closed to the arguments as they are now. */
void door_closed(int doors, spt_status expected, const char *why);

#define DOOR_REFUSE(doors, spoil) \
    (door_prepare(&way), (void)(spoil), door_closed(doors, SPT_BAD_ARGUMENT, #spoil))
#define DOOR_REFUSE_CALL(expected, call) \
    (door_prepare(&way), before = door_bytes(), door_refused(call, expected, before, #call))

#endif
