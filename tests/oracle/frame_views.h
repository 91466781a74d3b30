/* SPDX-License-Identifier: MIT
 *
 * What the frame tests share: frames of the shared scenes and of random worlds, traced wholly, and
 * the same rays by spt_scene_trace(). Workspaces have exactly the size that is asked for. */
#ifndef TESTS_ORACLE_FRAME_VIEWS_H
#define TESTS_ORACLE_FRAME_VIEWS_H

#include "frame_truth.h"

#include <scenes/parts.h>
#include <spheretrace/frame.h>

/* The largest region that is traced at once. */
enum { view_pixels_most = 128 * 96 };

/* A frame of a scene. parts belongs to the view; do not copy it. */
typedef struct view {
    const scene *shown;
    scene_grain grain;
    scene_parts parts;
    spt_camera camera;
    spt_frame frame;
} view;

/* The scene with its eye and target, a horizontal field of view, square pixels and its t_max; a
 * budget of 1000. */
void view_of(view *v, const scene *shown, scene_grain grain, double degrees, uint32_t width,
             uint32_t height);
/* The part of the image that is traced. */
void view_window(spt_frame *frame, uint32_t left, uint32_t top, uint32_t right, uint32_t bottom);

size_t frame_pixels(const spt_frame *frame); /* of the region */
/* x and y of a pixel of the region, at its centre. */
double frame_x(const spt_frame *frame, size_t pixel);
double frame_y(const spt_frame *frame, size_t pixel);

/* The frame with a workspace of the size it asks for, the same memory at every call. */
void frame_lend_workspace(spt_frame *frame);
/* Memory for the state of spt_frame_advance(), of the size it asks for; one at a time of 4. */
void *frame_state(const spt_frame *frame, int which, size_t *size);

/* Traces all tiles with these flags; every result must have been written, in each of its parts. */
void frame_trace(spt_frame *frame, uint32_t flags, spt_hit *hits);
/* The rays of the region's pixels, by spt_camera_rays(). */
void frame_rays(const spt_frame *frame, spt_camera_ray *rays);
/* The same rays by spt_scene_trace(). With path. */
void frame_plain(const spt_frame *frame, const spt_camera_ray *rays, spt_hit *hits);

/* Checks that two sets of results are the same bits: all of them, or what must not depend on what
 * is left out (t, residual, outcome, component, flags). */
void frame_same(const spt_frame *frame, const spt_hit *a, const spt_hit *b, const char *what);
void frame_same_answer(const spt_frame *frame, const spt_hit *a, const spt_hit *b,
                       const char *what);
/* Fills hits with a pattern that no result has. */
void frame_blank(size_t count, spt_hit *hits);
int frame_is_blank(const spt_hit *hit);

#endif
