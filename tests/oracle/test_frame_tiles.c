/* SPDX-License-Identifier: MIT
 *
 * Tiles: they cover a region once, and nothing of how it is divided shows in the results; images
 * beyond 2^31 pixels; what is written and what is not. Refusals are in tests/stress. */
#include "frame_views.h"
#include "harness.h"
#include "../check.h"
#include "../rules.h"

#include <string.h>

enum { image_width = 125, image_height = 90, image_pixels = image_width * image_height };

static view scene_view;
static spt_hit whole[image_pixels], part[image_pixels];

/* A scene of many components, with and without bounds. */
static spt_frame *open_image(void) {
    view_of(&scene_view, scene_named("primitives"), SCENE_OBJECTS, 52, image_width, image_height);
    return &scene_view.frame;
}

/* ---- Areas --------------------------------------------------------------------------------- */

/* Every pixel of the region lies in one tile, and each tile in one square of the image. */
static void check_areas(const spt_frame *frame) {
    static unsigned char covered[256 * 256];
    const size_t tiles = spt_frame_tiles(frame);
    const size_t across = (frame->right - 1) / SPT_TILE - frame->left / SPT_TILE + 1;
    const size_t down = (frame->bottom - 1) / SPT_TILE - frame->top / SPT_TILE + 1;
    memset(covered, 0, sizeof covered);
    CHECK_SAY(tiles == across * down, "%zu tiles", tiles);
    for (size_t index = 0; index < tiles; ++index) {
        uint32_t area[4] = {0, 0, 0, 0};
        CHECK(spt_frame_area(frame, index, area) == SPT_OK);
        CHECK(area[0] >= frame->left && area[0] < area[2] && area[2] <= frame->right);
        CHECK(area[1] >= frame->top && area[1] < area[3] && area[3] <= frame->bottom);
        CHECK(area[0] / SPT_TILE == (area[2] - 1) / SPT_TILE);
        CHECK(area[1] / SPT_TILE == (area[3] - 1) / SPT_TILE);
        for (uint32_t y = area[1]; y < area[3] && y < 256; ++y) {
            for (uint32_t x = area[0]; x < area[2] && x < 256; ++x) ++covered[y * 256 + x];
        }
    }
    for (uint32_t y = 0; y < 256; ++y) {
        for (uint32_t x = 0; x < 256; ++x) {
            const int inside =
                x >= frame->left && x < frame->right && y >= frame->top && y < frame->bottom;
            CHECK_SAY(covered[y * 256 + x] == inside, "pixel %u %u is in %d tiles", x, y,
                      covered[y * 256 + x]);
        }
    }
}

static void frame_tiles_cover_once(void) {
    static const uint32_t sizes[][2] = {{1, 1},   {7, 5},   {64, 64}, {65, 63},   {128, 64},
                                        {63, 65}, {1, 256}, {256, 1}, {200, 130}, {256, 256}};
    for (size_t size = 0; size < sizeof sizes / sizeof sizes[0]; ++size) {
        const uint32_t width = sizes[size][0], height = sizes[size][1];
        spt_frame *frame = open_image();
        frame->width = width;
        frame->height = height;
        for (int i = 0; i < 12; ++i) {
            uint32_t left = check_random() % width, top = check_random() % height;
            uint32_t right = left + 1 + check_random() % (width - left);
            uint32_t bottom = top + 1 + check_random() % (height - top);
            if (i < 2) left = top = 0;
            if (i < 1) right = width;
            if (i < 1) bottom = height;
            if (i == 1) right = bottom = 1;
            if (i == 2) left = (right = width) - 1;
            if (i == 2) top = (bottom = height) - 1;
            view_window(frame, left, top, right, bottom);
            check_context("%ux%u from %u %u to %u %u", width, height, left, top, right, bottom);
            check_areas(frame);
        }
    }
}

/* All tiles of images beyond 2^31 pixels, by their areas. */
static void frame_tiles_of_large_images(void) {
    static const uint32_t sides[] = {46341, 65536};
    for (int i = 0; i < 2; ++i) {
        const uint32_t side = sides[i], tiles = (side + SPT_TILE - 1) / SPT_TILE;
        uint64_t pixels = 0;
        uint32_t area[4] = {0, 0, 0, 0};
        spt_frame *frame = open_image();
        frame->width = frame->height = side;
        view_window(frame, 0, 0, side, side);
        check_context("%ux%u", side, side);
        CHECK(spt_frame_tiles(frame) == (size_t)tiles * tiles);
        for (size_t index = 0; index < (size_t)tiles * tiles; ++index) {
            if (spt_frame_area(frame, index, area) != SPT_OK) break;
            pixels += (uint64_t)(area[2] - area[0]) * (area[3] - area[1]);
        }
        CHECK_SAY(pixels == (uint64_t)side * side, "%.0f pixels", (double)pixels);
        CHECK(area[2] == side && area[3] == side);
        CHECK(spt_frame_area(frame, (size_t)tiles * tiles, area) == SPT_BAD_ARGUMENT);
    }
}

/* ---- Results ------------------------------------------------------------------------------- */

static const uint32_t regions[][4] = {{0, 0, 1, 1},      {124, 89, 125, 90}, {0, 0, 64, 64},
                                      {64, 64, 125, 90}, {63, 63, 65, 65},   {17, 5, 119, 88},
                                      {50, 0, 51, 90},   {0, 70, 125, 71},   {61, 2, 62, 3}};
enum { region_count = sizeof regions / sizeof regions[0] };

/* A part of an image holds the same bits as the whole, with and without a depth buffer. */
static void check_regions(spt_frame *frame, const float *depth) {
    if (depth != NULL) frame->t_max = (spt_column){depth, sizeof *depth};
    frame_trace(frame, 0, whole);
    for (int i = 0; i < region_count; ++i) {
        const uint32_t *r = regions[i];
        view_window(frame, r[0], r[1], r[2], r[3]);
        check_context("region %u %u %u %u%s", r[0], r[1], r[2], r[3],
                      depth != NULL ? ", depth buffer" : "");
        if (depth != NULL) {
            static float cut[image_pixels];
            for (size_t pixel = 0; pixel < frame_pixels(frame); ++pixel) {
                cut[pixel] = depth[(size_t)frame_y(frame, pixel) * image_width +
                                   (size_t)frame_x(frame, pixel)];
            }
            frame->t_max = (spt_column){cut, sizeof *cut};
        }
        frame_trace(frame, 0, part);
        for (size_t pixel = 0; pixel < frame_pixels(frame); ++pixel) {
            const size_t x = (size_t)frame_x(frame, pixel), y = (size_t)frame_y(frame, pixel);
            CHECK_SAY(oracle_same_hit(&part[pixel], &whole[y * image_width + x]),
                      "pixel %zu %zu: outcome %d t %.9g evaluations %u, whole %d %.9g %u", x, y,
                      part[pixel].outcome, (double)part[pixel].t, part[pixel].evaluations,
                      whole[y * image_width + x].outcome, (double)whole[y * image_width + x].t,
                      whole[y * image_width + x].evaluations);
        }
    }
}

static void frame_tiles_region_is_the_whole(void) {
    static float depth[image_pixels];
    check_regions(open_image(), NULL);
    for (int i = 0; i < image_pixels; ++i) depth[i] = (float)check_uniform(0, 25);
    check_regions(open_image(), depth);
}

/* Tiles one by one in a random order, or some at a time, at every width. */
static void frame_tiles_any_division(void) {
    spt_frame *frame = open_image();
    frame_trace(frame, 0, whole);
    for (int width = 0; width < width_count; ++width) {
        const spt_hits sinks = spt_hits_of(part);
        const size_t tiles = spt_frame_tiles(frame);
        frame->settings.max_lanes = widths[width];
        frame_lend_workspace(frame);
        for (size_t step = 1; step < tiles; ++step) {
            const size_t start = check_random() % tiles;
            frame_blank(image_pixels, part);
            check_context("width %u, by %zu from %zu", widths[width], step, start);
            for (size_t i = 0; step % 2 == 1 && i < tiles; ++i) {
                /* Steps of 1 or 3 from anywhere visit all of 4 tiles. */
                CHECK(spt_frame_tile(frame, (start + i * step) % tiles, &sinks) == SPT_OK);
            }
            for (size_t i = 0; step % 2 == 0 && i < tiles; i += step) {
                const size_t count = tiles - i < step ? tiles - i : step;
                size_t done = 0;
                CHECK(spt_frame_trace(frame, i, count, &sinks, &done) == SPT_OK && done == count);
            }
            frame_same(frame, part, whole, "order");
        }
    }
}

/* One tile of an image of up to 2^44 pixels: the rays are those of spt_camera_rays(), and nothing
 * grows with the image. */
static void frame_tiles_window_of_large_image(void) {
    static const uint32_t sides[] = {1921, 46341, 65536, 1u << 22};
    static spt_camera_ray rays[SPT_TILE * SPT_TILE];
    uint32_t area[4];
    for (int i = 0; i < 4; ++i) {
        const uint32_t side = sides[i], height = side == 1921 ? 1081 : side;
        for (int corner = 0; corner < 5; ++corner) {
            spt_frame *frame;
            uint32_t left, top, right, bottom;
            size_t last, middle;
            view_of(&scene_view, scene_named("primitives"), SCENE_OBJECTS, 52, side, height);
            frame = &scene_view.frame;
            last = spt_frame_tiles(frame) - 1;
            middle = last / 2 - last / 2 % ((side + SPT_TILE - 1) / SPT_TILE) + 3;
            /* The last tile, the one before, one of a middle row, one across four, the first. */
            CHECK(spt_frame_area(frame, corner < 2 ? last - (size_t)corner : middle, area) ==
                  SPT_OK);
            left = area[0], top = area[1], right = area[2], bottom = area[3];
            if (corner == 3) left += 20, top += 30, right = left + 64, bottom = top + 64;
            if (corner == 4) left = top = 0, right = bottom = 64;
            view_window(frame, left, top, right, bottom);
            check_context("%ux%u from %u %u", side, height, left, top);
            CHECK(spt_frame_workspace(frame) < 2000000);
            frame_lend_workspace(frame);
            frame_trace(frame, SPT_FRAME_NO_CONES | SPT_FRAME_NO_CULLING, part);
            frame_rays(frame, rays);
            frame_plain(frame, rays, whole);
            frame_same(frame, part, whole, "plain");
            frame_trace(frame, SPT_FRAME_NO_CONES, whole);
            frame_same_answer(frame, whole, part, "culled");
        }
    }
}

/* ---- What is written ----------------------------------------------------------------------- */

/* Of a tile only its pixels are written, by sinks of any stride. */
static void frame_tiles_write_their_pixels(void) {
    enum { stride = 41, slack = 100 };
    static unsigned char image[image_pixels * stride + slack];
    spt_frame *frame = open_image();
    frame_trace(frame, 0, whole);
    for (size_t index = 0; index < spt_frame_tiles(frame); ++index) {
        spt_hits sinks = spt_hits_of((spt_hit *)(void *)part);
        spt_sink *const all[] = {&sinks.t,           &sinks.residual,        &sinks.outcome,
                                 &sinks.evaluations, &sinks.flags,           &sinks.component,
                                 &sinks.candidate_t, &sinks.candidate_ratio, &sinks.fallbacks};
        uint32_t area[4] = {0, 0, 0, 0};
        memset(image, 0x5a, sizeof image);
        for (int i = 0; i < 9; ++i) {
            all[i]->first = image + 3 + 4 * i; /* unaligned, with 5 bytes between the pixels */
            all[i]->stride = stride;
        }
        CHECK(spt_frame_tile(frame, index, &sinks) == SPT_OK);
        CHECK(spt_frame_area(frame, index, area) == SPT_OK);
        for (size_t i = 0; i < sizeof image; ++i) {
            const size_t pixel = i < 3 ? image_pixels : (i - 3) / stride;
            const size_t x = pixel % image_width, y = pixel / image_width;
            const size_t offset = i < 3 ? stride : (i - 3) % stride;
            if (offset < sizeof(spt_hit) && x >= area[0] && x < area[2] && y >= area[1] &&
                y < area[3]) {
                const unsigned char *expected = (const unsigned char *)&whole[pixel] + offset;
                CHECK_SAY(image[i] == *expected, "byte %zu of pixel %zu %zu", offset, x, y);
            } else {
                CHECK_SAY(image[i] == 0x5a, "byte %zu is written", i);
            }
        }
    }
}

/* Any set of sinks may be absent. */
static void frame_tiles_absent_sinks(void) {
    spt_frame *frame = open_image();
    frame_trace(frame, 0, whole);
    for (int i = 0; i < 20; ++i) {
        spt_hits sinks = spt_hits_of(part);
        spt_sink *const all[] = {&sinks.t,           &sinks.residual,        &sinks.outcome,
                                 &sinks.evaluations, &sinks.flags,           &sinks.component,
                                 &sinks.candidate_t, &sinks.candidate_ratio, &sinks.fallbacks};
        const uint32_t wanted = i < 9 ? 1u << i : check_random() % 512;
        frame_blank(image_pixels, part);
        for (int sink = 0; sink < 9; ++sink) {
            if ((wanted >> sink & 1) == 0) all[sink]->first = NULL;
        }
        CHECK(spt_frame_trace(frame, 0, spt_frame_tiles(frame), &sinks, NULL) == SPT_OK);
        for (int pixel = 0; pixel < image_pixels; ++pixel) {
            spt_hit expected;
            frame_blank(1, &expected);
            for (int sink = 0; sink < 9; ++sink) {
                if ((wanted >> sink & 1) == 0) continue;
                memcpy((char *)&expected + 4 * sink, (const char *)&whole[pixel] + 4 * sink, 4);
            }
            CHECK_SAY(memcmp(&part[pixel], &expected, sizeof expected) == 0, "sinks %x, pixel %d",
                      wanted, pixel);
        }
    }
}

void suite_frame_tiles(void) {
    RUN(frame_tiles_cover_once);
    RUN(frame_tiles_of_large_images);
    RUN(frame_tiles_region_is_the_whole);
    RUN(frame_tiles_any_division);
    RUN(frame_tiles_window_of_large_image);
    RUN(frame_tiles_write_their_pixels);
    RUN(frame_tiles_absent_sinks);
}
