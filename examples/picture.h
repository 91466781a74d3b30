/* SPDX-License-Identifier: MIT
 *
 * One picture of a scene: traced tile by tile by several threads, wholly or in part, onto a film,
 * from which it is laid out as colours or as numbers. */
#ifndef EXAMPLES_PICTURE_H
#define EXAMPLES_PICTURE_H

#include "image.h"
#include "scenes/parts.h"

typedef enum picture_kind {
    PICTURE_SHADED,   /* as the eye would see it */
    PICTURE_NORMAL,   /* the surface normal as a colour */
    PICTURE_HEAT,     /* evaluations of the rays themselves, from 0 to the budget */
    PICTURE_FALLBACK, /* the share of steps whose longer probe was rejected */
    PICTURE_DEPTH,    /* the distance: near is bright */
    PICTURE_OUTCOME,  /* how each ray ended */
    PICTURE_KEPT,     /* how many components of the union each tile kept */
    picture_kinds
} picture_kind;

/* "shaded" and so on. */
extern const char *const picture_kind_names[picture_kinds];

enum { picture_panels = 4, picture_largest_samples = 8 };

/* How the rays of a panel are traced. */
typedef struct picture_panel {
    const spt_method *method;
    uint32_t flags; /* SPT_FRAME_* */
} picture_panel;

typedef struct picture_job {
    const scene *shown;
    picture_kind kind;
    picture_panel panels[picture_panels]; /* side by side, each of the full size */
    int panel_count;
    int width, height;            /* of the whole picture */
    int left, top, right, bottom; /* what is shown of it */
    int samples; /* a pixel holds samples * samples; shaded and normal pictures only */
    uint32_t budget, max_lanes;
    float epsilon;
    int pixel_cone; /* end rays at half a pixel */
    int shadows;    /* of the sun */
    int whole;      /* the scene as one field instead of a union of its objects */
} picture_job;

/* 640 x 360, shaded, the default rule, 2 x 2 samples, the library's budget and epsilon, cones,
 * culling and shadows. */
picture_job picture_job_default(const scene *shown);

void picture_set_size(picture_job *job, int width, int height);

/* What was traced: pieces of a picture, each the pixels that a panel shows of a tile of 64 x 64. */
typedef struct film {
    picture_job job;
    size_t first, end;   /* pieces it holds */
    int channels;        /* normal: x, y, z and the share that was hit; shaded: 3; others: 1 */
    float *values;       /* film_piece() */
    unsigned char *done; /* by piece, from first on */
    spt_statistics statistics[picture_panels]; /* of the picture's own rays, without shadows */
} film;

/* Whether several rays make a pixel. */
int picture_is_averaged(picture_kind kind);

/* How many pieces a picture has. */
size_t picture_pieces(const picture_job *job);

/* The panel of a piece, and its pixels in the whole picture: left, top, right, bottom. */
int picture_piece_area(const picture_job *job, size_t piece, int area[4]);

/* An empty film; values is NULL where memory ran out. */
film film_create(const picture_job *job, size_t first, size_t end);
void film_free(film *exposed);

/* The values of a piece that the film holds, row by row of its own area. */
float *film_piece(const film *exposed, size_t piece);

/* Traces the pieces of a film by so many threads. The bits are the same for any number. label names
 * the progress bar. Returns how many pieces are missing because of an interrupt (workers.h); -1,
 * after a message on standard error, where memory ran out or the library refused. */
long film_expose(film *exposed, int threads, const char *label);

/* The picture, legend included, of a film that holds all pieces; what was not traced is black.
 * numbers: the numbers themselves (for float formats) instead of colours and legends: normal,
 * evaluations, share, t, spt_outcome, count. pixels is NULL where memory ran out. */
image film_print(const film *exposed, int numbers);

#endif
