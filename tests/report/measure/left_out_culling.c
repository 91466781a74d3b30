/* SPDX-License-Identifier: MIT
 *
 * culling.csv: how many components of a union the tiles of a picture keep, and what that saves.
 * culling_tiles.csv and culling_SCENE.png: the same tile by tile, beside what is seen there. */
#include <math.h>
#include <picture.h>
#include <stdlib.h>
#include <string.h>

#include <heat.h>

#include "../../bench/frame/frame_picture.h"
#include "../report.h"

static const char *const culled_scenes[] = {"village", "primitives", "village_boxes",
                                            "arches",  "slabs",      "repeated"};
enum {
    culled_count = sizeof culled_scenes / sizeof culled_scenes[0],
    pictured_count = 2, /* the first of them */
    tile_columns = 9,   /* of the pictures */
    tile_rows = 5,
    panel_width = tile_columns * SPT_TILE,
    panel_height = tile_rows * SPT_TILE,
    margin = 4,
    most_rounds = 32
};

/* ---- Numbers --------------------------------------------------------------------------------- */

/* Components that each tile keeps, tile by tile. */
static void count_kept(const frame_tracer *tracer, size_t tiles, double *kept) {
    spt_frame frame = tracer->frame;
    spt_hits nothing;
    memset(&nothing, 0, sizeof nothing);
    for (size_t tile = 0; tile < tiles; ++tile) {
        spt_statistics statistics = spt_statistics_default();
        frame.statistics = &statistics;
        frame_expect(spt_frame_tile(&frame, tile, &nothing), "spt_frame_tile");
        kept[tile] = (double)statistics.kept;
    }
}

static double run_once(const frame_tracer *tracer, const frame_picture *picture,
                       bench_hit *results) {
    const double before = bench_seconds();
    frame_tracer_run(tracer, picture, frame_slice_of(picture, 0, 1), results);
    return bench_seconds() - before;
}

static void write_row(const report_options *options, const frame_picture *picture,
                      const frame_tracer *with, const frame_tracer *without, FILE *rows) {
    const size_t rounds = options->quick ? 5 : 15, tiles = picture->tiles;
    double *const kept = report_allocate(tiles * sizeof *kept);
    double ratios[most_rounds], sum = 0;
    bench_hit *const results = frame_image_of(picture->count);
    const spt_statistics less = frame_tracer_count(with, picture);
    const spt_statistics all = frame_tracer_count(without, picture);
    count_kept(with, tiles, kept);
    for (size_t tile = 0; tile < tiles; ++tile) sum += kept[tile];
    for (size_t round = 0; round < rounds; ++round) {
        const double shorter = run_once(with, picture, results);
        ratios[round] = shorter / run_once(without, picture, results);
    }
    fprintf(rows, "%s,%zu,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", picture->shown->name,
            tiles, with->parts.scene.count, report_quantile(kept, tiles, 0), sum / (double)tiles,
            report_quantile(kept, tiles, 1), frame_evaluations(&less, picture),
            frame_evaluations(&all, picture), report_quantile(ratios, rounds, 0.5),
            report_quantile(ratios, rounds, 0.25), report_quantile(ratios, rounds, 0.75));
    free(kept);
    free(results);
}

/* ---- The picture ----------------------------------------------------------------------------- */

static image print_film(const picture_job *job) {
    film exposed = film_create(job, 0, picture_pieces(job));
    report_expect(exposed.values != NULL && film_expose(&exposed, 1, "culling_tiles") == 0,
                  "a picture was not traced");
    const image printed = film_print(&exposed, 0);
    report_expect(printed.pixels != NULL, "out of memory");
    film_free(&exposed);
    return printed;
}

/* The number of each tile, dark on light colours and light on dark ones, and lines between. */
static void label_tiles(image *map, const double *kept) {
    static const float dark[3] = {0.0f, 0.0f, 0.0f}, light[3] = {1.0f, 1.0f, 1.0f};
    for (int tile = 0; tile < tile_columns * tile_rows; ++tile) {
        const int x = tile % tile_columns * SPT_TILE, y = tile / tile_columns * SPT_TILE;
        const float *const colour = image_at(map, x + SPT_TILE / 2, y + SPT_TILE / 2);
        const float lightness = 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
        char text[32];
        snprintf(text, sizeof text, "%.0f", kept[tile]);
        heat_text(map, x + (SPT_TILE - heat_text_width(text)) / 2, y + SPT_TILE / 2 - 3, text,
                  lightness > 0.2f ? dark : light);
        heat_fill(map, x, y, SPT_TILE, 1, dark);
        heat_fill(map, x, y, 1, SPT_TILE, dark);
    }
}

static void paste(const image *from, int left, image *to) {
    for (int y = 0; y < from->height && y < to->height; ++y) {
        memcpy(image_at(to, left, y), image_at(from, 0, y),
               (size_t)from->width * 3 * sizeof(float));
    }
}

static void draw(const report_options *options, const scene *shown, const double *kept) {
    static const float black[3] = {0.0f, 0.0f, 0.0f}, grey[3] = {0.6f, 0.6f, 0.6f};
    char path[1024];
    picture_job job = picture_job_default(shown);
    picture_set_size(&job, panel_width, panel_height);
    image seen = print_film(&job);
    job.kind = PICTURE_KEPT;
    image map = print_film(&job);
    image both = image_create(seen.width + margin + map.width, map.height, 3);
    report_expect(both.pixels != NULL, "out of memory");
    label_tiles(&map, kept);
    paste(&seen, 0, &both);
    paste(&map, seen.width + margin, &both);
    /* Words that hold no numbers in the place of the legend's. */
    heat_fill(&both, seen.width + margin, panel_height, map.width, 13, black);
    heat_text(&both, seen.width + margin + 4, panel_height + 4, "components that each tile keeps",
              grey);
    heat_text(&both, 4, panel_height + 4, "what is seen", grey);
    snprintf(path, sizeof path, "%s/culling_%s.png", options->output, shown->name);
    report_expect(image_write(path, &both) == 0, "a picture cannot be written");
    image_free(&seen);
    image_free(&map);
    image_free(&both);
}

static void measure_tiles(const report_options *options, int cell, FILE *rows) {
    static const frame_way culled = {SCENE_OBJECTS, 1, 1};
    const scene *const shown = scene_named(culled_scenes[cell]);
    frame_picture *const picture = frame_picture_of(shown, panel_width, panel_height);
    frame_tracer *const tracer = frame_tracer_of(picture, &culled, "adaptive", 0);
    double *const kept = report_allocate(picture->tiles * sizeof *kept);
    report_expect(picture->tiles == tile_columns * tile_rows, "the picture has other tiles");
    count_kept(tracer, picture->tiles, kept);
    draw(options, shown, kept);
    for (int tile = 0; tile < tile_columns * tile_rows; ++tile) {
        fprintf(rows, "%s,%d,%d,%.9g\n", shown->name, tile % tile_columns, tile / tile_columns,
                kept[tile]);
    }
    free(kept);
    frame_tracer_free(tracer);
    frame_picture_free(picture);
}

/* ---- The parts ------------------------------------------------------------------------------- */

static int all_scenes(const report_options *options) {
    (void)options;
    return culled_count;
}

static int pictured_scenes(const report_options *options) {
    (void)options;
    return pictured_count;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    static const frame_way with = {SCENE_OBJECTS, 1, 1}, without = {SCENE_OBJECTS, 1, 0};
    const scene *const shown = scene_named(culled_scenes[cell]);
    frame_picture *const picture =
        frame_picture_of(shown, options->quick ? 640 : 1280, options->quick ? 360 : 720);
    frame_tracer *const culled = frame_tracer_of(picture, &with, "adaptive", 0);
    frame_tracer *const whole = frame_tracer_of(picture, &without, "adaptive", 0);
    write_row(options, picture, culled, whole, rows);
    frame_tracer_free(culled);
    frame_tracer_free(whole);
    frame_picture_free(picture);
}

const report_part report_culling = {
    "culling",
    "scene,tiles,components,kept_least,kept_mean,kept_most,evaluations_with,evaluations_without,"
    "seconds_ratio,low,high",
    all_scenes,
    measure,
    1,
    {14, 2}};

const report_part report_culling_tiles = {
    "culling_tiles", "scene,column,row,kept", pictured_scenes, measure_tiles, 0, {1, 1}};
