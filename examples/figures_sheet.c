/* SPDX-License-Identifier: MIT
 *
 * Pictures of panels with captions, for the figures. Letters and palette are in heat.c. */
#include "figures.h"
#include "heat.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { gap = 8, line = 12 };

figure_sheet figure_sheet_of(int columns, int rows, int panel_width, int panel_height) {
    figure_sheet sheet;
    sheet.panel_width = panel_width;
    sheet.panel_height = panel_height;
    sheet.picture = image_create(columns * (panel_width + gap) - gap,
                                 rows * (panel_height + heat_legend_height + gap) - gap, 3);
    return sheet;
}

void figure_place(const figure_sheet *sheet, int column, int row, int *left, int *top) {
    *left = column * (sheet->panel_width + gap);
    *top = row * (sheet->panel_height + heat_legend_height + gap) + heat_legend_height;
}

void figure_caption(figure_sheet *sheet, int column, int row, const char *text) {
    static const float white[3] = {0.8f, 0.8f, 0.8f};
    int left, top;
    char first[128];
    const size_t length = strcspn(text, "\n");
    figure_place(sheet, column, row, &left, &top);
    snprintf(first, sizeof first, "%.*s", (int)length, text);
    top -= heat_legend_height;
    heat_text(&sheet->picture, left + 4, top + 6, first, white);
    if (text[length] != '\0') {
        heat_text(&sheet->picture, left + 4, top + 6 + line, text + length + 1, white);
    }
}

void figure_legend(figure_sheet *sheet, int column, int row, const char *title, double largest,
                   const char *unit) {
    int left, top;
    figure_place(sheet, column, row, &left, &top);
    heat_legend(&sheet->picture, left, top - heat_legend_height, sheet->panel_width, title, largest,
                unit);
}

void figure_paint(figure_sheet *sheet, int column, int row, const figure_view *view,
                  figure_colour_fn *colour) {
    figure_paint_close(sheet, column, row, view, colour, view->width / 2, view->height / 2, 1);
}

void figure_paint_close(figure_sheet *sheet, int column, int row, const figure_view *view,
                        figure_colour_fn *colour, int middle_x, int middle_y, int times) {
    int left, top;
    const int from_x = middle_x - sheet->panel_width / (2 * times);
    const int from_y = middle_y - sheet->panel_height / (2 * times);
    figure_place(sheet, column, row, &left, &top);
    for (int y = 0; y < sheet->panel_height; ++y) {
        for (int x = 0; x < sheet->panel_width; ++x) {
            const int of_x = from_x + x / times, of_y = from_y + y / times;
            if (of_x < 0 || of_y < 0 || of_x >= view->width || of_y >= view->height) continue;
            colour(view, (size_t)of_y * (size_t)view->width + (size_t)of_x,
                   image_at(&sheet->picture, left + x, top + y));
        }
    }
}

void figure_normal_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    const float *const normal = &view->normals[3 * pixel];
    const int shown = view->t[pixel] < (float)HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        /* Numbers that only look like a colour: the writer's curve must give them back. */
        rgb[axis] = image_linear(shown ? 0.5f + 0.5f * normal[axis] : 0.09f);
    }
}

float figure_daylight(const float normal[3]) {
    static const float sun[3] = {-0.5345f, 0.6682f, 0.5176f};
    const float cosine = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
    return 0.4f + 0.2f * normal[1] + 1.1f * (cosine > 0 ? cosine : 0);
}

int figure_sheet_write(figure_sheet *sheet, const figure_wish *wish, const char *name) {
    char path[1024];
    int good = 0;
    errno = 0;
    if (sheet->picture.pixels != NULL && strlen(wish->folder) < sizeof path - 64) {
        snprintf(path, sizeof path, "%s/%s", wish->folder, name);
        good = image_write(path, &sheet->picture) == 0;
    }
    if (!good) {
        fprintf(stderr, "cannot write %s: %s\n", name, errno != 0 ? strerror(errno) : "failed");
    }
    image_free(&sheet->picture);
    return good;
}
