/* SPDX-License-Identifier: MIT
 *
 * Figure 8: what is shown of rays that ran out of 64 iterations, most of them past an outline: the
 * last sample, or the candidate of screen space where that is within half a pixel of a surface. */
#include "figures.h"
#include "look.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { budget = 64, true_budget = 10000, ways = 2 };

/* What is seen in a direction. */
typedef enum seen { SKY, FLOOR, BODY } seen;

/* What is true of a pixel: what its ray meets, and what that comes within half a pixel of first. A
 * picture may show either. */
typedef struct truth {
    unsigned char met, touched;
    float t; /* where it is met; +infinity for the sky */
} truth;

/* f in double at t, and whose it is. */
static double value_at(const figure_view *view, size_t pixel, double t, seen *nearest) {
    const spt_ray *const ray = &view->rays[pixel];
    const double ground = (double)look_of(view->shown->name)->ground;
    double p[3], f;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    view->shown->reference(1, &p[0], &p[1], &p[2], &f);
    *nearest = f < p[1] - ground - 1e-6 ? BODY : FLOOR; /* the scene's ground is a rounded number */
    return f;
}

static truth true_pixel(const figure_view *view, size_t pixel) {
    const double half_pixel = (double)view->settings.pixel_radius;
    truth result = {SKY, SKY, INFINITY};
    double t = 0;
    for (int i = 0; i < true_budget && t < (double)view->rays[pixel].t_max; ++i) {
        seen nearest;
        const double f = value_at(view, pixel, t, &nearest);
        if (result.touched == SKY && f < half_pixel * t) result.touched = (unsigned char)nearest;
        if (f < 1e-7) { /* far below a pixel */
            result.met = (unsigned char)nearest;
            result.t = (float)t;
            break;
        }
        t += f;
    }
    return result;
}

/* Whether the body's outline passes within two pixels. */
static int is_outline(const figure_view *view, const truth *truths, int x, int y) {
    int body = 0, others = 0;
    for (int j = y - 2; j <= y + 2; ++j) {
        for (int i = x - 2; i <= x + 2; ++i) {
            if (i < 0 || j < 0 || i >= view->width || j >= view->height) continue;
            const int is_body = truths[j * view->width + i].met == BODY;
            body += is_body;
            others += !is_body;
        }
    }
    return body > 0 && others > 0;
}

/* How many pixels along the outline show neither of what is true of them. */
static int count_wrong(const figure_view *view, const truth *truths, int *outline) {
    int wrong = 0;
    *outline = 0;
    for (int y = 0; y < view->height; ++y) {
        for (int x = 0; x < view->width; ++x) {
            const size_t pixel = (size_t)y * (size_t)view->width + (size_t)x;
            seen shown = SKY;
            if (!is_outline(view, truths, x, y)) continue;
            if (view->t[pixel] < INFINITY) {
                (void)value_at(view, pixel, (double)view->t[pixel], &shown);
            }
            ++*outline;
            wrong += shown != (seen)truths[pixel].met && shown != (seen)truths[pixel].touched;
        }
    }
    return wrong;
}

/* What is shown of a ray: its hit, and else its last sample or its candidate. */
static void choose(figure_view *view, int candidate) {
    for (size_t i = 0; i < view->count; ++i) {
        const spt_hit *const hit = &view->hits[i];
        if (candidate) {
            view->t[i] = spt_hit_or_candidate(hit, SPT_FORCE_PIXEL, view->settings.pixel_radius);
        } else {
            view->t[i] = hit->outcome == SPT_HIT || hit->outcome == SPT_LIMIT ? hit->t : INFINITY;
        }
    }
}

/* The normals, and a part of the outline close up. The floor is below the picture: all green
 * before the background is wrong. */
static void draw_row(figure_sheet *sheet, int row, figure_view *view, const char *text) {
    figure_find_normals(view);
    figure_caption(sheet, 0, row, text);
    figure_paint(sheet, 0, row, view, figure_normal_colour);
    figure_caption(sheet, 1, row, "6 times as large");
    figure_paint_close(sheet, 1, row, view, figure_normal_colour, view->width * 41 / 100,
                       view->height * 65 / 100, 6);
}

int figure_8(const figure_wish *wish) {
    static const char *const names[] = {"basic", "relaxed", "adaptive"};
    const spt_method *const methods[] = {spt_basic(), spt_relaxed(), spt_adaptive()};
    figure_view view;
    figure_sheet sheet = {{0, 0, 0, NULL}, 0, 0};
    int good = 1;
    if (!figure_open(&view, "silhouette", wish)) return 0;
    const float pixel_radius = view.settings.pixel_radius;
    truth *const truths = malloc(view.count * sizeof *truths);
    if (truths == NULL) {
        figure_close(&view);
        return figure_expect(0, "enough memory");
    }
    if (wish->folder != NULL) sheet = figure_sheet_of(2, 3, wish->width, wish->height);
    for (size_t i = 0; i < view.count; ++i) truths[i] = true_pixel(&view, i);
    printf("Figure 8, silhouette, %d x %d, at most %d iterations\n"
           "    rule      outline pixels  wrong: last sample  candidate\n",
           wish->width, wish->height, budget);
    for (int i = 0; i < 3; ++i) {
        int wrong[ways], outline = 0;
        view.settings.method = methods[i];
        view.settings.budget = budget;
        view.settings.pixel_radius = 0;
        (void)figure_trace(&view);
        view.settings.pixel_radius = pixel_radius;
        for (int way = 0; way < ways; ++way) {
            char text[128];
            choose(&view, way);
            wrong[way] = count_wrong(&view, truths, &outline);
            if (sheet.picture.pixels == NULL || i != 1) continue;
            snprintf(text, sizeof text,
                     "%s: normals, %d iterations, %s\n%d of %d outline pixels wrong", names[i],
                     budget, way == 0 ? "last sample" : "screen-space candidate", wrong[way],
                     outline);
            draw_row(&sheet, way, &view, text);
        }
        printf("    %-9s %14d %19d %10d\n", names[i], outline, wrong[0], wrong[1]);
        good &= figure_expect(wrong[0] > outline / 200, "last samples draw wrong outlines");
        good &= figure_expect(wrong[1] * 20 <= wrong[0], "candidates mend 19 in 20");
    }
    for (size_t i = 0; i < view.count; ++i) view.t[i] = truths[i].t;
    if (sheet.picture.pixels != NULL) {
        draw_row(&sheet, 2, &view, "truth: 10000 iterations in double");
    }
    if (wish->folder != NULL) good &= figure_sheet_write(&sheet, wish, "keinert_fig8.png");
    good &= !view.failed;
    free(truths);
    figure_close(&view);
    return good;
}
