/* SPDX-License-Identifier: MIT
 *
 * One picture of a model of nature, traced and shaded tile by tile by several threads. */
#ifndef EXAMPLES_MODELS_RENDER_H
#define EXAMPLES_MODELS_RENDER_H

#include "image.h"
#include "scenes/models.h"

typedef struct models_view {
    const model *shown;
    const model_world *world;   /* as it was built */
    double eye[3], target[3];   /* those of the model, unless changed */
    int width, height, threads; /* of the picture, pixels */
    int samples;                /* a pixel holds samples * samples */
    float sun;                  /* tangent of the sun's angular radius; 0: hard shadows */
} models_view;

typedef struct models_count {
    spt_statistics statistics; /* of rays from the eye */
    uint64_t steep;            /* rays that saw a broken promise */
} models_count;

/* The model's own view, 960 x 540, one sample a pixel, soft shadows, one thread. */
models_view models_view_of(const model *shown, const model_world *world);

/* Turns the view's eye to the middle of a bound and moves it, on the same side, so near that the
 * bound fills the picture's width; farther by `share`. Returns 0 for a bound without an end. */
int models_look_at(const spt_bound *bound, double share, models_view *view);

/* The camera of a picture of that many pixels. */
spt_status models_camera(const models_view *view, uint32_t width, uint32_t height,
                         spt_camera *camera);

/* Renders into picture, which has the view's size. label names the progress bar; count may be NULL.
 * Returns 0 where it was interrupted or, after a message on standard error, failed. */
int models_render(const models_view *view, const char *label, image *picture, models_count *count);

#endif
