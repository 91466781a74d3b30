/* SPDX-License-Identifier: MIT
 *
 * What tiles of a picture leave out of a scene, what empty kernels leave out of a model, and what
 * shaders leave out of the emitter. */
#include "page_left_out.h"

#include <string.h>

enum { most_models = 16, most_scenes = 48, most_sets = 4 };

/* ---- Tiles ----------------------------------------------------------------------------------- */

static void picture(page *out, const char *scene, const char *words) {
    char file[256];
    snprintf(file, sizeof file, "culling_%s.png", scene);
    page_picture(out, file, "a scene, and beside it how many components each tile keeps");
    page_words(out, "%s ", words);
    page_source(out, "culling_tiles");
    page_figure_end(out);
}

static void table_culling(page *out, const csv_table *table) {
    page_table(
        out,
        "What culling saves, with cones on both sides, in pictures of more pixels than those "
        "above: components that tiles keep, "
        "evaluations of components a pixel, and time over that without (median of rounds, "
        "and quartiles).",
        "scene|components|tiles|kept: least|mean|most|evaluations|without|time|from|to");
    for (int row = 0; row < csv_rows(table); ++row) {
        page_row(out);
        page_cell_number(out, NULL, table, row, "scene", "");
        page_cell_number(out, NULL, table, row, "components", "%.0f");
        page_cell_number(out, NULL, table, row, "tiles", "%.0f");
        page_cell_number(out, NULL, table, row, "kept_least", "%.0f");
        page_cell_number(out, NULL, table, row, "kept_mean", "%.1f");
        page_cell_number(out, NULL, table, row, "kept_most", "%.0f");
        page_cell_number(out, NULL, table, row, "evaluations_with", "%.2f");
        page_cell_number(out, NULL, table, row, "evaluations_without", "%.2f");
        page_cell_number(out, NULL, table, row, "seconds_ratio", "%.2f");
        page_cell_number(out, NULL, table, row, "low", "%.2f");
        page_cell_number(out, NULL, table, row, "high", "%.2f");
    }
    page_table_end(out);
    page_source(out, "culling");
}

/* ---- Kernels --------------------------------------------------------------------------------- */

static void plot_kernels(page *out) {
    static double kernels[most_models], ratio[most_models], low[most_models], high[most_models];
    static double lines[most_models];
    static const char *const files[] = {"left_out_kernels", "left_out_kernel_lines"};
    csv_table *const table = csv_open(out->tables, "kernels");
    plot drawn[2] = {{0}, {0}};
    int count = 0;
    for (int row = 0; row < csv_rows(table) && count < most_models; ++row, ++count) {
        kernels[count] = csv_number(table, row, "kernels");
        ratio[count] = csv_number(table, row, "ratio");
        low[count] = csv_number(table, row, "low");
        high[count] = csv_number(table, row, "high");
        lines[count] = csv_number(table, row, "code_lines");
    }
    for (int i = 0; i < 2; ++i) {
        plot_series *const series =
            plot_add(&drawn[i], NULL, PLOT_LINE, count, kernels, i == 0 ? ratio : lines);
        if (i == 0) series->low = low;
        if (i == 0) series->high = high;
        drawn[i].title = i == 0 ? "Time of an evaluation" : "The emitted shader";
        drawn[i].x.title = "levels with a kernel";
        drawn[i].y.title = i == 0 ? "time, relative" : "lines of code";
        drawn[i].y.low = 0;
        drawn[i].y.high = i == 0 ? 1.1 : 0;
        drawn[i].width = 470;
        drawn[i].height = 300;
    }
    page_figures(out, files, drawn, 2);
    page_words(out, "A kernel-reflection sequence of ");
    page_number(out, table, 0, "levels", "%.0f");
    page_words(out, " mirrors, most of whose levels have no kernel of their own on the left: what "
                    "is left there is the time of the mirrors. The model with a kernel everywhere "
                    "takes ");
    page_number(out, table, csv_rows(table) - 1, "nanoseconds", "%.1f");
    page_words(out, " nanoseconds an evaluation. In the shader a level without kernel is one line, "
                    "its mirror. ");
    page_source(out, "kernels");
    page_figure_end(out);
    csv_close(table);
}

void left_out_tiles(page *out) {
    csv_table *const table = csv_open(out->tables, "culling");
    page_heading(out, "Tiles: components that are not asked");
    page_begin(out);
    page_words(out,
               "Before a tile of a picture is traced, components whose bound the tile's cone of "
               "rays cannot meet are taken off its list; they are neither evaluated nor tested by "
               "its rays. In a kernel-reflection sequence a level whose kernel is empty does no "
               "more than its mirror.");
    page_end(out);
    picture(out, "village",
            "The village, and how many of its houses, the ground among them, each tile of pixels "
            "has to know. Most houses are far away or on one side: no tile knows many.");
    picture(out, "primitives", "The same for the scene of primitives.");
    table_culling(out, table);
    csv_close(table);
    plot_kernels(out);
}

/* ---- Shaders --------------------------------------------------------------------------------- */

static void plot_shaders(page *out, const csv_table *table) {
    static const char *scenes[most_scenes], *sets[most_sets];
    static double x[most_sets][most_scenes], lines[most_sets][most_scenes];
    const int scene_count = csv_distinct(table, "scene", scenes, most_scenes);
    const int set_count = csv_distinct(table, "features", sets, most_sets);
    plot drawn = {0};
    for (int set = 0; set < set_count; ++set) {
        for (int scene = 0; scene < scene_count; ++scene) {
            const int row = csv_next(table, -1, "scene=%s,target=library,features=%s",
                                     scenes[scene], sets[set]);
            x[set][scene] = scene;
            lines[set][scene] = csv_number(table, row, "code_lines");
        }
        plot_add(&drawn, sets[set], PLOT_BARS, scene_count, x[set], lines[set]);
    }
    drawn.title = "Emitted shaders";
    drawn.x.title = "scene";
    drawn.x.names = scenes;
    drawn.x.name_count = scene_count;
    drawn.y.title = "lines of code";
    drawn.width = 720;
    page_figure(out, "left_out_shaders", &drawn);
    page_words(
        out,
        "Lines of the library of functions that is emitted for a scene traced with the "
        "default rule: *none* of the optional results, *normal* vectors, or *all* that there is. "
        "Comments and the lines for those who replace a function are not counted. The "
        "step rule and the ray are the same everywhere; what differs from scene to scene "
        "is the scene. ");
    page_source(out, "shaders");
    page_figure_end(out);
}

static void table_shaders(page *out, const csv_table *table) {
    static const char *scenes[most_scenes];
    const int scene_count = csv_distinct(table, "scene", scenes, most_scenes);
    page_fold(out, "Lines, functions and bytes");
    page_table(out,
               "Lines of code and functions: of the library with nothing optional, with normals, "
               "with everything; and of a program with nothing optional.",
               "scene|none: lines|functions|bytes|normal: lines|functions|all: lines|functions|"
               "program: lines|functions");
    for (int i = 0; i < scene_count; ++i) {
        static const char *const asked[][2] = {
            {"library", "none"}, {"library", "normal"}, {"library", "all"}, {"program", "none"}};
        page_row(out);
        page_cell(out, NULL, "%s", scenes[i]);
        for (int k = 0; k < 4; ++k) {
            const int row = csv_next(table, -1, "scene=%s,target=%s,features=%s", scenes[i],
                                     asked[k][0], asked[k][1]);
            page_cell_number(out, NULL, table, row, "code_lines", "%.0f");
            page_cell_number(out, NULL, table, row, "functions", "%.0f");
            if (k == 0) page_cell_number(out, NULL, table, row, "bytes", "%.0f");
        }
    }
    page_table_end(out);
    page_fold_end(out);
}

void left_out_shaders(page *out) {
    csv_table *const table = csv_open(out->tables, "shaders");
    page_heading(out, "Shaders: functions that are not written");
    page_begin(out);
    page_words(out, "The emitter writes the functions that the settings and the scene reach, and "
                    "of a model only what each kernel needs.");
    page_end(out);
    plot_shaders(out, table);
    table_shaders(out, table);
    csv_close(table);
}
