/* SPDX-License-Identifier: MIT
 *
 * What the stress tests of frames share: a small frame of the base scene with everything a call
 * needs, and calls that trace it whole, tile by tile or progressively. */
#ifndef TESTS_FRAME_CASES_H
#define TESTS_FRAME_CASES_H

#include <spheretrace/frame.h>

#include "test_scene_cases.h"

enum { frame_width = 80, frame_height = 70, frame_pixels = frame_width * frame_height };
enum { frame_channels = 3 };

/* Not to be copied: it points into itself. Memory is its own, from malloc. */
typedef struct frame_case {
    union_scene world;
    spt_camera camera;
    spt_frame frame;
    spt_hit hits[frame_pixels];
    spt_hits image;
    float colours[frame_pixels * frame_channels];
    spt_sink picture;
    void *workspace, *state;
    size_t workspace_size, state_size;
    size_t shaded; /* pixels */
} frame_case;

/* Four tiles of the base scene through a pinhole camera; four resolutions; colours from t and
 * component. Everything is ready for a call. Fills the results with 0xa5, workspace and state with
 * 0x3c. */
void frame_base(frame_case *self, const stress_way *way);

/* Its memory back; before the case ends or is made anew. */
void frame_free(frame_case *self);

/* Workspace and state anew for the frame as it is now. */
void frame_memory(frame_case *self);

/* All tiles in one call. */
void frame_trace_whole(frame_case *self);

/* From the start to the end in calls of this many evaluations; returns how many calls it took. */
size_t frame_advance_whole(frame_case *self, uint64_t evaluations);

/* How many of the results differ in any bit. */
size_t frame_differing(const spt_hit *a, const spt_hit *b, size_t count);

#endif
