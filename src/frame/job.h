/* SPDX-License-Identifier: MIT
 *
 * A frame taken in: checked copies of all that the caller described, and what follows from it. */
#ifndef SPTI_JOB_H
#define SPTI_JOB_H

#include "bundle.h"

enum { SPTI_MOST_PASSES = 16, SPTI_MOST_CHANNELS = 16, SPTI_CHUNK_SIDE = 16 };

/* The pixels x_0 <= x < x_1, y_0 <= y < y_1 of a grid. */
typedef struct spti_rectangle {
    uint32_t x_0, y_0, x_1, y_1;
} spti_rectangle;

/* The pixels of one resolution. */
typedef struct spti_grid {
    uint32_t width, height;
    float step_x, step_y; /* pixels of the full image that a pixel of the grid covers */
    spti_rectangle part;  /* those that are traced */
} spti_grid;

typedef struct spti_job {
    spt_frame frame; /* with the settings checked */
    spt_scene scene;
    spt_camera camera;
    spti_view view;
} spti_job;

/* 0 where a caller's camera breaks its rules. */
int spti_camera_copy(spt_camera *to, const spt_camera *from);

/* Makes a checked camera ready for an image. */
spti_view spti_view_of(const spt_camera *camera, uint32_t width, uint32_t height);

/* The rays of a checked camera through count <= SPT_BATCH points. */
void spti_view_rays(const spti_view *view, const spt_camera *camera, spti_isa isa, size_t count,
                    const float *x, const float *y, spt_camera_ray *rays);

/* 0 where a caller's frame breaks its rules. */
int spti_job_of(spti_job *job, const spt_frame *from);

/* The grid of the full image and the frame's region. */
spti_grid spti_full_grid(const spti_job *job);

/* Whether an image of the region can be written where it is said to be, and the depths read. */
int spti_image_fits(const spt_frame *frame, const spt_hits *image);

/* How many tiles it has, and which tile of the image one of them is. */
size_t spti_job_tiles(const spti_job *job);
void spti_job_tile(const spti_job *job, size_t index, uint32_t *column, uint32_t *row);

#endif
