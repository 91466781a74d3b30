/* SPDX-License-Identifier: MIT
 *
 * Figure 7: how many iterations the rays of a city take, and how far they get with 80 of them, by
 * plain steps, with over-relaxation and by the default rule. */
#include "figures.h"
#include "heat.h"
#include "look.h"

#include <math.h>
#include <stdio.h>

enum { budget = 80, rules = 3 };

/* Of one rule. */
typedef struct reach {
    const char *name;
    double evaluations; /* a ray */
    int hits, far_hits, undecided;
} reach;

static const float far_away = 100;

static void count_hits(const figure_view *view, reach *found) {
    found->hits = found->far_hits = found->undecided = 0;
    for (size_t i = 0; i < view->count; ++i) {
        found->hits += view->hits[i].outcome == SPT_HIT;
        found->far_hits += view->hits[i].outcome == SPT_HIT && view->hits[i].t > far_away;
        found->undecided += view->hits[i].outcome == SPT_LIMIT;
    }
}

static void iterations_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    heat_colour((float)view->hits[pixel].evaluations / budget, rgb);
}

static void city_colour(const figure_view *view, size_t pixel, float rgb[3]) {
    static const float unreached[3] = {0.25f, 0.01f, 0.02f};
    const float half_pixel = figure_half_pixel(view, pixel);
    float point[3];
    for (int c = 0; c < 3; ++c) rgb[c] = unreached[c];
    if (view->hits[pixel].outcome == SPT_MISS) look_sky(view->rays[pixel].direction, rgb);
    if (view->hits[pixel].outcome != SPT_HIT) return;
    figure_point(view, pixel, point);
    look_albedo(look_of(view->shown->name), point, rgb);
    if (point[1] < 2 * half_pixel) {
        look_ground_albedo(point[0], point[2], 1, 4 * half_pixel, rgb);
    }
    for (int c = 0; c < 3; ++c) rgb[c] *= figure_daylight(&view->normals[3 * pixel]);
}

static void draw(figure_sheet *sheet, int column, figure_view *view, const reach *found) {
    char text[128];
    snprintf(text, sizeof text, "%s: iterations, %.2f on average", found->name, found->evaluations);
    figure_legend(sheet, column, 0, text, budget, "");
    figure_paint(sheet, column, 0, view, iterations_colour);
    snprintf(text, sizeof text,
             "%s: %d pixels reach something, %d of them beyond %.0f\n%d ran out of iterations: red",
             found->name, found->hits, found->far_hits, (double)far_away, found->undecided);
    figure_caption(sheet, column, 1, text);
    figure_find_normals(view);
    figure_paint(sheet, column, 1, view, city_colour);
}

int figure_7(const figure_wish *wish) {
    reach found[rules] = {
        {"basic", 0, 0, 0, 0}, {"relaxed 1.2", 0, 0, 0, 0}, {"adaptive", 0, 0, 0, 0}};
    const spt_method *const methods[rules] = {spt_basic(), spt_relaxed(), spt_adaptive()};
    figure_view view;
    figure_sheet sheet = {{0, 0, 0, NULL}, 0, 0};
    int good = 1;
    if (!figure_open(&view, "city", wish)) return 0;
    if (wish->folder != NULL) sheet = figure_sheet_of(rules, 2, wish->width, wish->height);
    printf("Figure 7, city, %d x %d, at most %d iterations\n"
           "    rule         iterations  saved    hits  beyond %.0f  undecided\n",
           wish->width, wish->height, budget, (double)far_away);
    for (int i = 0; i < rules; ++i) {
        view.settings.method = methods[i];
        view.settings.relaxation = 1.2f; /* as in the paper's figure */
        view.settings.budget = budget;
        found[i].evaluations = figure_trace(&view);
        count_hits(&view, &found[i]);
        printf("    %-12s %10.2f %5.1f%% %7d %11d %10d\n", found[i].name, found[i].evaluations,
               100 * (1 - found[i].evaluations / found[0].evaluations), found[i].hits,
               found[i].far_hits, found[i].undecided);
        if (sheet.picture.pixels != NULL) draw(&sheet, i, &view, &found[i]);
    }
    good &= figure_expect(found[1].evaluations < 0.95 * found[0].evaluations,
                          "over-relaxation saves a twentieth of the iterations");
    good &= figure_expect(found[2].evaluations * 1.21 < found[0].evaluations,
                          "the default rule saves as much as the paper's (1.21)");
    good &= figure_expect(found[0].hits < found[1].hits && found[1].hits < found[2].hits,
                          "each rule reaches more than the one before");
    good &= figure_expect(3 * found[0].far_hits < 2 * found[1].far_hits,
                          "over-relaxation reaches half as much again in the distance");
    if (wish->folder != NULL) good &= figure_sheet_write(&sheet, wish, "keinert_fig7.png");
    good &= !view.failed;
    figure_close(&view);
    return good;
}
