/* SPDX-License-Identifier: MIT
 *
 * Where the rays of a frame are asked first, seen from the callbacks: that is where they start,
 * behind their cones. For pinhole and orthographic cameras, whose rays a point can be told from. */
#ifndef TESTS_ORACLE_FRAME_LISTEN_H
#define TESTS_ORACLE_FRAME_LISTEN_H

#include "frame_views.h"

typedef struct listener listener;

/* A component whose points are noted before it answers. */
typedef struct listened_part {
    const spt_field *field;
    listener *to;
} listened_part;

struct listener {
    spt_frame frame; /* the frame that was given, over the scene below */
    spt_scene scene;
    spt_field fields[SCENE_PARTS_MOST];
    listened_part parts[SCENE_PARTS_MOST];
    double inverse[3][3]; /* of right, up, forward */
    double forward_length;
    double first[view_pixels_most]; /* by pixel of the region; +infinity: never asked */
};

/* Traces the frame with these flags and listens. A point counts for the pixel whose centre's ray it
 * lies on, within a fiftieth of a pixel; nearer to a common eye than .05 it tells nothing. Points of
 * cones lie on such rays only by accident (their middles are corners of pixels where sides are
 * multiples of four), and then make a start look too early, never too late. */
void listen_trace(listener *ears, const spt_frame *frame, uint32_t flags, spt_hit *hits);

#endif
