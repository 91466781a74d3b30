/* SPDX-License-Identifier: MIT
 *
 * Figure 10: a texture that depends on the hit point, wood, whose rings run nearly along the
 * surface, so that a small step in depth moves them far; without and with 3 rounds of discontinuity
 * reduction. */
#include "figures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { paper_rounds = 3 };

/* How dark the wood is, 0 to 1. The rings, 16 a length, are around an axis beside the body, a little
 * inclined, wavy; each darkens slowly and ends soon. */
static float wood(const float p[3]) {
    const float x = p[0] - 0.12f + 0.05f * p[1], z = p[2] + 0.1f - 0.03f * p[1];
    const float from_axis = sqrtf(x * x + z * z);
    const float wave = 0.012f * sinf(5 * p[1]) + 0.01f * sinf(3 * atan2f(x, z));
    const float ring = 16 * (from_axis + wave), age = ring - floorf(ring);
    const float late = age < 0.8f ? age / 0.8f : (1 - age) / 0.2f;
    return late * late;
}

static void wood_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    static const float early[3] = {0.62f, 0.40f, 0.20f}, dark[3] = {0.16f, 0.07f, 0.025f};
    static const float background[3] = {0.25f, 0.27f, 0.30f};
    float point[3];
    memcpy(rgb, background, sizeof background);
    if (!(view->t[pixel] < INFINITY)) return;
    figure_point(view, pixel, point);
    const float late = wood(point), light = figure_daylight(&view->normals[3 * pixel]);
    for (int c = 0; c < 3; ++c) rgb[c] = light * (early[c] + late * (dark[c] - early[c]));
}

/* The mean of |v(x-1) - 2 v(x) + v(x+1)| over pixels whose neighbours in the row are of the same
 * surface, v the texture: what is not smooth in it. */
static double roughness(const figure_view *view) {
    double sum = 0;
    size_t count = 0;
    for (size_t pixel = 1; pixel + 1 < view->count; ++pixel) {
        float v[3], point[3];
        int one_surface = view->t[pixel] < INFINITY;
        for (size_t i = 0; i < 3 && one_surface; ++i) {
            const size_t at = pixel + i - 1;
            const float apart = fabsf(view->t[at] - view->t[pixel]);
            one_surface = apart <= 16 * figure_half_pixel(view, pixel); /* 8 pixels, not NaN */
            figure_point(view, at, point);
            v[i] = wood(point);
        }
        if (!one_surface) continue;
        sum += fabs((double)v[0] - 2 * (double)v[1] + (double)v[2]);
        ++count;
    }
    return count > 0 ? sum / (double)count : 0;
}

static void draw(figure_sheet *sheet, int column, figure_view *view, int rounds, double rough) {
    char text[128];
    figure_find_normals(view);
    snprintf(text, sizeof text, "%d rounds of discontinuity reduction\nroughness %.4f", rounds,
             rough);
    figure_caption(sheet, column, 0, text);
    figure_paint(sheet, column, 0, view, wood_colour);
    figure_caption(sheet, column, 1, "6 times as large");
    figure_paint_close(sheet, column, 1, view, wood_colour, view->width * 49 / 100,
                       view->height * 19 / 100, 6);
}

int figure_10(const figure_wish *wish) {
    figure_view view;
    figure_sheet sheet = {{0, 0, 0, NULL}, 0, 0};
    if (!figure_open(&view, "textured", wish)) return 0;
    if (wish->folder != NULL) sheet = figure_sheet_of(2, 2, wish->width, wish->height);
    (void)figure_trace(&view);
    const double without = roughness(&view);
    if (sheet.picture.pixels != NULL) draw(&sheet, 0, &view, 0, without);
    figure_refine(&view, paper_rounds);
    const double with = roughness(&view);
    if (sheet.picture.pixels != NULL) draw(&sheet, 1, &view, paper_rounds, with);
    /* What is left is the texture's own: that of hits far closer than half a pixel. */
    const float pixel_radius = view.settings.pixel_radius;
    view.settings.pixel_radius = 0;
    view.settings.epsilon = 1e-6f;
    view.settings.budget = 1000;
    (void)figure_trace(&view);
    view.settings.pixel_radius = pixel_radius;
    const double own = roughness(&view);
    printf("Figure 10, textured, %d x %d: roughness of the texture %.4f, with %d rounds %.4f; its "
           "own %.4f\n",
           wish->width, wish->height, without, paper_rounds, with, own);
    int good = figure_expect(2 * (with - own) < without - own,
                             "3 rounds take away more than half of the roughness");
    if (wish->folder != NULL) good &= figure_sheet_write(&sheet, wish, "keinert_fig10.png");
    good &= !view.failed;
    figure_close(&view);
    return good;
}
