/* SPDX-License-Identifier: MIT
 *
 * What the benches of whole frames share: a picture's tiles in an order of which every run is
 * spread over the picture, the rays through them for whoever wants rays, and the ways to trace a
 * scene as a frame. */
#ifndef TESTS_BENCH_FRAME_PICTURE_H
#define TESTS_BENCH_FRAME_PICTURE_H

#include <scenes/parts.h>

#include "../bench.h"

/* Tiles i of the order hold the rays first[i] .. first[i + 1] - 1, in blocks of 16x16 pixels and
 * Morton order within; the rays are those that the frame traces, by spt_camera_rays(). */
typedef struct frame_picture {
    const scene *shown;
    spt_camera camera;
    uint32_t width, height;
    float pixel_radius;
    size_t count; /* of rays */
    size_t tiles;
    size_t *order; /* numbers of tiles */
    size_t *first; /* tiles + 1 of them */
    spt_ray *rays;
    size_t *pixel; /* of each ray: y * width + x */
} frame_picture;

/* Ends the program where memory or the library refuses. */
frame_picture *frame_picture_of(const scene *shown, int width, int height);
void frame_picture_free(frame_picture *picture);

/* The places in the order that a round traces: all rounds together trace every tile once. */
typedef struct frame_slice {
    size_t begin, end;
} frame_slice;

frame_slice frame_slice_of(const frame_picture *picture, int round, int rounds);

/* The rays of a slice. */
size_t frame_slice_rays(const frame_picture *picture, frame_slice slice);

/* How a scene is traced as a frame. */
typedef struct frame_way {
    scene_grain grain;
    int cones, culling; /* 0 or 1 */
} frame_way;

/* A frame that is ready to trace, with the workspace of one thread. */
typedef struct frame_tracer {
    scene_parts parts;
    spt_frame frame;
} frame_tracer;

/* rule: "basic" and so on. The components of a union that are convex are traced with the convex
 * rule, as always; a body by itself is traced with the named one, so that it is the same on both
 * sides of a race. picture must live as long. lanes 0: the widest. */
frame_tracer *frame_tracer_of(const frame_picture *picture, const frame_way *way, const char *rule,
                              int lanes);
void frame_tracer_free(frame_tracer *tracer);

/* Traces the tiles of a slice. image: t, residual, outcome and evaluations by pixel. */
void frame_tracer_run(const frame_tracer *tracer, const frame_picture *picture, frame_slice slice,
                      bench_hit *image);

/* What the whole picture takes by spt_statistics, all of it counted. */
spt_statistics frame_tracer_count(const frame_tracer *tracer, const frame_picture *picture);

/* Evaluations a pixel, cones included. Those of components, where the scene is a union of them. */
double frame_evaluations(const spt_statistics *statistics, const frame_picture *picture);

/* Zeroed memory; ends the program where there is none. */
void *frame_allocate(size_t size);

/* Results of which no byte is what a tracer writes: those that are left out show, and no clock counts
 * the first touch of a page. */
bench_hit *frame_image_of(size_t count);

/* Ends the program with a line where the status is not SPT_OK. */
void frame_expect(spt_status status, const char *what);

#endif
