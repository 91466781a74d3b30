/* SPDX-License-Identifier: MIT
 *
 * Figure 9: f at the hits, which tracing leaves anywhere below half a pixel, and how the steps
 * between neighbouring pixels shrink with the rounds of discontinuity reduction. */
#include "figures.h"
#include "heat.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_rounds = 8, paper_rounds = 5 };

/* Pairs of neighbouring pixels of one surface, the second to the right of the first or below. */
typedef struct pairs {
    size_t count;
    size_t (*pixels)[2];
    float *steps; /* |f(p) - f(q)|, of the pairs */
} pairs;

/* How the steps are spread, world length, and f itself in half pixels. */
typedef struct spread {
    double median, nine_tenths, mean_f;
} spread;

/* Neighbours belong to one surface where their depths differ by less than 8 pixels there, so where
 * the surface is seen at more than 7 degrees. Found before any hit is moved. */
static void find_pairs(const figure_view *view, pairs *found) {
    const size_t width = (size_t)view->width;
    found->count = 0;
    for (size_t pixel = 0; pixel < view->count; ++pixel) {
        for (int below = 0; below < 2; ++below) {
            const size_t other = below ? pixel + width : pixel + 1;
            if (other >= view->count || (!below && other % width == 0)) continue;
            if (!(view->t[pixel] < INFINITY && view->t[other] < INFINITY)) continue;
            const float apart = fabsf(view->t[pixel] - view->t[other]);
            if (apart > 16 * figure_half_pixel(view, pixel)) continue;
            found->pixels[found->count][0] = pixel;
            found->pixels[found->count++][1] = other;
        }
    }
}

static int ascending(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static spread measure(const figure_view *view, pairs *found) {
    spread result = {0, 0, 0};
    size_t hits = 0;
    for (size_t i = 0; i < found->count; ++i) {
        found->steps[i] = fabsf(view->hits[found->pixels[i][0]].residual -
                                view->hits[found->pixels[i][1]].residual);
    }
    for (size_t pixel = 0; pixel < view->count; ++pixel) {
        if (!(view->t[pixel] < INFINITY)) continue;
        result.mean_f += (double)(view->hits[pixel].residual / figure_half_pixel(view, pixel));
        ++hits;
    }
    if (found->count == 0) return result;
    qsort(found->steps, found->count, sizeof *found->steps, ascending);
    result.median = (double)found->steps[found->count / 2];
    result.nine_tenths = (double)found->steps[found->count * 9 / 10];
    result.mean_f /= (double)hits;
    return result;
}

/* f in half pixels. */
static void residual_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    if (!(view->t[pixel] < INFINITY)) return;
    heat_colour(view->hits[pixel].residual / figure_half_pixel(view, pixel), rgb);
}

/* The step to the pixel on the right, in half pixels; 1/4 is the end of the scale. */
static void step_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    const size_t other = pixel + 1;
    if (!(view->t[pixel] < INFINITY) || other % (size_t)view->width == 0) return;
    const float half_pixel = figure_half_pixel(view, pixel);
    if (!(fabsf(view->t[pixel] - view->t[other]) <= 16 * half_pixel)) return;
    const float step = view->hits[pixel].residual - view->hits[other].residual;
    heat_colour(4 * fabsf(step) / half_pixel, rgb);
}

static void draw(figure_sheet *sheet, int column, const figure_view *view, int rounds) {
    char text[128];
    snprintf(text, sizeof text, "f at the hits, %d rounds", rounds);
    figure_legend(sheet, column, 0, text, 1, " half pixels");
    figure_paint(sheet, column, 0, view, residual_colour);
    snprintf(text, sizeof text, "steps of f from pixel to pixel, %d rounds", rounds);
    figure_legend(sheet, column, 1, text, 0.25, " half pixels");
    figure_paint(sheet, column, 1, view, step_colour);
}

/* Bars by rounds, 1 as high as the panel allows. */
static void draw_bars(figure_sheet *sheet, int row, int half_width, const float rgb[3],
                      const double *height) {
    static const float white[3] = {0.8f, 0.8f, 0.8f};
    const int bottom = sheet->panel_height - 24;
    int left, top;
    char text[16];
    figure_place(sheet, 2, row, &left, &top);
    for (int rounds = 0; rounds <= most_rounds; ++rounds) {
        const double share = height[rounds] > 0 ? fmin(height[rounds], 1) : 0;
        const int x = left + 80 + rounds * (sheet->panel_width - 96) / (most_rounds + 1);
        const int high = (int)(share * (bottom - 16));
        heat_fill(&sheet->picture, x - half_width, top + bottom - high, 2 * half_width, high, rgb);
        snprintf(text, sizeof text, "%d", rounds);
        heat_text(&sheet->picture, x - 2, top + bottom + 8, text, white);
    }
}

/* Lines with their numbers behind the bars of a panel, `lines` steps up to its end. */
static void draw_scale(figure_sheet *sheet, int row, int lines, const char *const *numbers) {
    static const float grey[3] = {0.06f, 0.06f, 0.06f}, white[3] = {0.8f, 0.8f, 0.8f};
    const int bottom = sheet->panel_height - 24;
    int left, top;
    figure_place(sheet, 2, row, &left, &top);
    for (int i = 0; i <= lines; ++i) {
        const int y = top + bottom - i * (bottom - 16) / lines;
        heat_fill(&sheet->picture, left + 44, y, sheet->panel_width - 52, 1, grey);
        heat_text(&sheet->picture, left + 8, y - 3, numbers[i], white);
    }
}

/* The steps on a scale of powers of ten, and below f on an even one. */
static void draw_curves(figure_sheet *sheet, const spread *curve) {
    static const char *const powers[] = {"1E-6", "1E-5", "1E-4", "1E-3", "1E-2"};
    static const char *const shares[] = {"0", "0.25", "0.5", "0.75", "1"};
    static const float median[3] = {0.15f, 0.45f, 0.9f}, upper[3] = {0.08f, 0.2f, 0.4f};
    double medians[most_rounds + 1], uppers[most_rounds + 1], means[most_rounds + 1];
    for (int rounds = 0; rounds <= most_rounds; ++rounds) {
        medians[rounds] = (log10(curve[rounds].median) + 6) / 4;
        uppers[rounds] = (log10(curve[rounds].nine_tenths) + 6) / 4;
        means[rounds] = curve[rounds].mean_f;
    }
    figure_caption(sheet, 2, 0,
                   "steps of f by rounds: median, and behind it nine in ten\n"
                   "world length");
    draw_scale(sheet, 0, 4, powers);
    draw_bars(sheet, 0, 20, upper, uppers);
    draw_bars(sheet, 0, 12, median, medians);
    figure_caption(sheet, 2, 1, "f by rounds: mean\nhalf pixels");
    draw_scale(sheet, 1, 4, shares);
    draw_bars(sheet, 1, 16, median, means);
}

/* Returns whether it was written, after a message. */
static int write_table(const figure_wish *wish, const spread *curve) {
    char path[1024];
    snprintf(path, sizeof path, "%s/keinert_fig9.csv", wish->folder);
    FILE *const file = fopen(path, "w");
    if (file == NULL) return figure_expect(0, "keinert_fig9.csv can be written");
    fprintf(file, "rounds,median_step,nine_tenths_step,mean_f_in_half_pixels\n");
    for (int rounds = 0; rounds <= most_rounds; ++rounds) {
        fprintf(file, "%d,%.6g,%.6g,%.6g\n", rounds, curve[rounds].median,
                curve[rounds].nine_tenths, curve[rounds].mean_f);
    }
    return fclose(file) == 0;
}

/* Refines fresh hits by every number of rounds. */
static void follow(figure_view *view, const spt_hit *fresh, pairs *found, figure_sheet *sheet,
                   spread *curve) {
    printf("Figure 9, textured, %d x %d: |f(p) - f(q)| of neighbouring pixels in world length,\n"
           "    f in half pixels\n"
           "    rounds    median  nine in ten    mean f\n",
           view->width, view->height);
    for (int rounds = 0; rounds <= most_rounds; ++rounds) {
        memcpy(view->hits, fresh, view->count * sizeof *fresh);
        figure_refine(view, (uint32_t)rounds);
        curve[rounds] = measure(view, found);
        printf("    %6d %9.3g %12.3g %9.3g\n", rounds, curve[rounds].median,
               curve[rounds].nine_tenths, curve[rounds].mean_f);
        if (sheet->picture.pixels == NULL) continue;
        if (rounds == 0) draw(sheet, 0, view, rounds);
        if (rounds == paper_rounds) draw(sheet, 1, view, rounds);
    }
    if (sheet->picture.pixels != NULL) draw_curves(sheet, curve);
}

int figure_9(const figure_wish *wish) {
    figure_view view;
    figure_sheet sheet = {{0, 0, 0, NULL}, 0, 0};
    spread curve[most_rounds + 1];
    pairs found;
    if (!figure_open(&view, "textured", wish)) return 0;
    found.pixels = malloc(2 * view.count * sizeof *found.pixels);
    found.steps = malloc(2 * view.count * sizeof *found.steps);
    spt_hit *const fresh = malloc(view.count * sizeof *fresh);
    int good = figure_expect(found.pixels != NULL && found.steps != NULL && fresh != NULL,
                             "enough memory");
    if (good) {
        if (wish->folder != NULL) sheet = figure_sheet_of(3, 2, wish->width, wish->height);
        (void)figure_trace(&view);
        memcpy(fresh, view.hits, view.count * sizeof *fresh);
        find_pairs(&view, &found);
        follow(&view, fresh, &found, &sheet, curve);
        good = figure_expect(5 * curve[paper_rounds].median <= curve[0].median,
                             "5 rounds bring the median step down five times") &
               figure_expect(2 * curve[paper_rounds].nine_tenths <= curve[0].nine_tenths,
                             "5 rounds halve the large steps, too");
        for (int rounds = 1; rounds <= most_rounds; ++rounds) {
            good &= figure_expect(curve[rounds].median <= curve[rounds - 1].median,
                                  "no round makes the median step larger");
        }
        if (wish->folder != NULL) {
            good &= write_table(wish, curve);
            good &= figure_sheet_write(&sheet, wish, "keinert_fig9.png");
        }
    }
    good &= !view.failed;
    free(fresh);
    free(found.steps);
    free(found.pixels);
    figure_close(&view);
    return good;
}
