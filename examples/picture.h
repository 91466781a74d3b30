/* SPDX-License-Identifier: MIT
 *
 * One picture of a scene: traced tile by tile, as colours or as numbers. */
#ifndef EXAMPLES_PICTURE_H
#define EXAMPLES_PICTURE_H

#include "image.h"
#include "scenes/scenes.h"

typedef enum picture_kind {
    PICTURE_SHADED,   /* as the eye would see it */
    PICTURE_NORMAL,   /* the surface normal as a colour */
    PICTURE_HEAT,     /* evaluations a ray, from 0 to the budget */
    PICTURE_FALLBACK, /* the share of steps whose longer probe was rejected */
    PICTURE_DEPTH,    /* the distance: near is bright */
    PICTURE_OUTCOME,  /* how each ray ended */
    picture_kinds
} picture_kind;

/* "shaded" and so on. */
extern const char *const picture_kind_names[picture_kinds];

enum { picture_panels = 4, picture_largest_samples = 8 };

typedef struct picture_job {
    const scene *shown;
    picture_kind kind;
    const spt_method *methods[picture_panels]; /* side by side, each in a panel of the full size */
    int panels;
    int width, height; /* of a panel */
    int samples;       /* a pixel holds samples * samples; shaded and normal pictures only */
    uint32_t budget, max_lanes;
    float epsilon;
    int pixel_cone; /* end rays at half a pixel */
    int numbers;    /* the numbers themselves (for float formats) instead of colours and legends:
                     * normal, evaluations, share, t, spt_outcome */
} picture_job;

/* 640 x 360, shaded, the default rule, 2 x 2 samples, the library's budget and epsilon, the cone. */
picture_job picture_job_default(const scene *shown);

/* The picture; pixels is NULL, after a message on standard error, where memory ran out or the
 * library refused. Counts what was traced for the picture itself, without shadows, in statistics.
 * label names the progress bar. */
image picture_render(const picture_job *job, const char *label, spt_statistics *statistics);

#endif
