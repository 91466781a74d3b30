/* SPDX-License-Identifier: MIT
 *
 * Pictures by tiles, and the frames that trace them. */
#include "frame_picture.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK_SIDE = 16, BLOCK_BITS = 4, BLOCK_RAYS = BLOCK_SIDE * BLOCK_SIDE };

void *frame_allocate(size_t size) {
    void *memory = calloc(1, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    return memory;
}

bench_hit *frame_image_of(size_t count) {
    bench_hit *const image = frame_allocate(count * sizeof *image);
    memset(image, 0xff, count * sizeof *image);
    return image;
}

void frame_expect(spt_status status, const char *what) {
    if (status == SPT_OK) return;
    fprintf(stderr, "%s: %s\n", what, spt_status_name(status));
    exit(1);
}

static size_t common_divisor(size_t a, size_t b) {
    return b == 0 ? a : common_divisor(b, a % b);
}

/* Tiles a golden section of the picture apart follow one another (an additive recurrence). */
static void order_tiles(frame_picture *picture) {
    size_t stride = (size_t)(0.618033988749895 * (double)picture->tiles);
    while (common_divisor(picture->tiles, stride) != 1) ++stride;
    for (size_t i = 0; i < picture->tiles; ++i) picture->order[i] = i * stride % picture->tiles;
}

/* Every second bit of a Morton index, which is one coordinate of the place in the block. */
static uint32_t every_second_bit(uint32_t index) {
    uint32_t coordinate = 0;
    for (int bit = 0; bit < BLOCK_BITS; ++bit) coordinate |= (index >> bit) & (1u << bit);
    return coordinate;
}

/* The rays through the block with this corner, cut by the area; returns how many. */
static size_t add_block(const frame_picture *picture, const uint32_t area[4], uint32_t left,
                        uint32_t top, spt_ray *rays, size_t *pixel) {
    float x[BLOCK_RAYS], y[BLOCK_RAYS];
    spt_camera_ray found[BLOCK_RAYS];
    size_t count = 0;
    for (uint32_t index = 0; index < BLOCK_RAYS; ++index) {
        const uint32_t column = left + every_second_bit(index);
        const uint32_t row = top + every_second_bit(index >> 1);
        if (column >= area[2] || row >= area[3]) continue;
        x[count] = (float)column + 0.5f;
        y[count] = (float)row + 0.5f;
        pixel[count] = (size_t)row * picture->width + column;
        ++count;
    }
    frame_expect(
        spt_camera_rays(&picture->camera, picture->width, picture->height, count, x, y, found),
        "spt_camera_rays");
    for (size_t i = 0; i < count; ++i) rays[i] = found[i].ray;
    return count;
}

static void fill_rays(frame_picture *picture, const spt_frame *frame) {
    size_t filled = 0;
    for (size_t i = 0; i < picture->tiles; ++i) {
        uint32_t area[4];
        picture->first[i] = filled;
        frame_expect(spt_frame_area(frame, picture->order[i], area), "spt_frame_area");
        for (uint32_t top = area[1]; top < area[3]; top += BLOCK_SIDE) {
            for (uint32_t left = area[0]; left < area[2]; left += BLOCK_SIDE) {
                filled += add_block(picture, area, left, top, picture->rays + filled,
                                    picture->pixel + filled);
            }
        }
    }
    picture->first[picture->tiles] = filled;
    if (filled != picture->count) frame_expect(SPT_BAD_ARGUMENT, "the tiles are not the picture");
}

frame_picture *frame_picture_of(const scene *shown, int width, int height) {
    scene_parts *const parts = frame_allocate(sizeof *parts);
    frame_picture *const picture = frame_allocate(sizeof *picture);
    spt_frame frame;
    picture->shown = shown;
    picture->width = (uint32_t)width;
    picture->height = (uint32_t)height;
    picture->count = (size_t)width * (size_t)height;
    picture->camera = scene_camera(shown, picture->width, picture->height);
    scene_parts_of(shown, SCENE_WHOLE, 1, parts);
    frame_expect(
        spt_frame_init(&frame, &parts->scene, &picture->camera, picture->width, picture->height),
        "spt_frame_init");
    picture->pixel_radius = frame.settings.pixel_radius;
    picture->tiles = spt_frame_tiles(&frame);
    picture->order = frame_allocate(picture->tiles * sizeof *picture->order);
    picture->first = frame_allocate((picture->tiles + 1) * sizeof *picture->first);
    picture->rays = frame_allocate(picture->count * sizeof *picture->rays);
    picture->pixel = frame_allocate(picture->count * sizeof *picture->pixel);
    order_tiles(picture);
    fill_rays(picture, &frame);
    free(parts);
    return picture;
}

void frame_picture_free(frame_picture *picture) {
    free(picture->order);
    free(picture->first);
    free(picture->rays);
    free(picture->pixel);
    free(picture);
}

frame_slice frame_slice_of(const frame_picture *picture, int round, int rounds) {
    frame_slice slice;
    slice.begin = picture->tiles * (size_t)round / (size_t)rounds;
    slice.end = picture->tiles * ((size_t)round + 1) / (size_t)rounds;
    return slice;
}

size_t frame_slice_rays(const frame_picture *picture, frame_slice slice) {
    return picture->first[slice.end] - picture->first[slice.begin];
}

frame_tracer *frame_tracer_of(const frame_picture *picture, const frame_way *way, const char *rule,
                              int lanes) {
    const int width = lanes != 0 ? lanes : spt_lanes();
    frame_tracer *const tracer = frame_allocate(sizeof *tracer);
    spt_frame *const frame = &tracer->frame;
    const spt_method *const method = bench_method(rule);
    scene_parts_of(picture->shown, way->grain, width, &tracer->parts);
    frame_expect(spt_frame_init(frame, &tracer->parts.scene, &picture->camera, picture->width,
                                picture->height),
                 "spt_frame_init");
    /* The convex rule needs no name here: it is taken where the flag is. */
    if (method != spt_convex()) frame->settings.method = method;
    if (method != spt_convex() && tracer->parts.scene.count == 1) {
        tracer->parts.fields[0].flags &= ~(uint32_t)SPT_FIELD_CONVEX;
    }
    frame->settings.max_lanes = (uint32_t)width;
    frame->flags = (way->cones ? 0 : (uint32_t)SPT_FRAME_NO_CONES) |
                   (way->culling ? 0 : (uint32_t)SPT_FRAME_NO_CULLING);
    frame->workspace_size = spt_frame_workspace(frame);
    frame->workspace = frame_allocate(frame->workspace_size);
    return tracer;
}

void frame_tracer_free(frame_tracer *tracer) {
    free(tracer->frame.workspace);
    free(tracer);
}

void frame_tracer_run(const frame_tracer *tracer, const frame_picture *picture, frame_slice slice,
                      bench_hit *image) {
    const spt_hits sinks = bench_hits_of(image);
    for (size_t i = slice.begin; i < slice.end; ++i) {
        frame_expect(spt_frame_tile(&tracer->frame, picture->order[i], &sinks), "spt_frame_tile");
    }
}

spt_statistics frame_tracer_count(const frame_tracer *tracer, const frame_picture *picture) {
    spt_statistics statistics = spt_statistics_default();
    spt_frame frame = tracer->frame;
    spt_hits nothing;
    memset(&nothing, 0, sizeof nothing);
    frame.statistics = &statistics;
    frame_expect(spt_frame_trace(&frame, 0, picture->tiles, &nothing, NULL), "spt_frame_trace");
    return statistics;
}

double frame_evaluations(const spt_statistics *statistics, const frame_picture *picture) {
    return (double)(statistics->evaluations + statistics->cone_evaluations) /
           (double)picture->count;
}
