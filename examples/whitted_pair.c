/* SPDX-License-Identifier: MIT
 *
 * Pictures of the Whitted renderer: a world as it is shown, and the pair after Keinert et al. 2014,
 * Figure 11: a convex body traced through its inside, and from outside backwards. */
#include "whitted_pair.h"

#include "heat.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pictures are rendered at twice their size, these as finely as the paper's, and averaged. */
enum { panel_width = 640, panel_height = 360, finer = 2, rounds = 5, most_evaluations = 120 };

/* One of the two ways to trace. */
typedef struct way {
    image light, evaluations; /* of panels */
    double seconds[rounds];
    whitted_statistics statistics;
} way;

/* The means of finer x finer pixels. */
static void shrink(const float *pixels, const image *smaller) {
    const int channels = smaller->channels, across = smaller->width * finer;
    for (int y = 0; y < smaller->height * finer; ++y) {
        for (int x = 0; x < across; ++x) {
            float *const mean = image_at(smaller, x / finer, y / finer);
            for (int c = 0; c < channels; ++c) {
                const size_t from = (size_t)(y * across + x) * (size_t)channels + (size_t)c;
                mean[c] += pixels[from] / (finer * finer);
            }
        }
    }
}

image whitted_shown(glass_world *world, whitted_settings *settings, int width, int height,
                    whitted_statistics *statistics) {
    image shown = image_create(width, height, 3);
    image fine = image_create(width * finer, height * finer, 3);
    if (shown.pixels != NULL && fine.pixels != NULL &&
        whitted_render(world, settings, fine.width, fine.height, fine.pixels, statistics)) {
        whitted_develop(fine.pixels, (size_t)fine.width * (size_t)fine.height * 3);
        shrink(fine.pixels, &shown);
    } else {
        image_free(&shown);
        shown.pixels = NULL;
    }
    image_free(&fine);
    return shown;
}

/* One round of a way; the last one's picture is kept. */
static int run_round(glass_world *world, int convex, int round, way *result) {
    whitted_settings settings = whitted_settings_default();
    image fine = image_create(panel_width * finer, panel_height * finer, 1);
    settings.convex = convex;
    image_free(&result->light);
    image_free(&result->evaluations);
    if (round == rounds - 1) settings.inside_evaluations = fine.pixels;
    result->evaluations = image_create(panel_width, panel_height, 1);
    result->light = whitted_shown(world, &settings, panel_width, panel_height, &result->statistics);
    result->seconds[round] = result->statistics.cpu_seconds;
    const int good =
        fine.pixels != NULL && result->evaluations.pixels != NULL && result->light.pixels != NULL;
    if (good) shrink(fine.pixels, &result->evaluations);
    image_free(&fine);
    return good;
}

static int compare(const void *one, const void *other) {
    const double a = *(const double *)one, b = *(const double *)other;
    return a < b ? -1 : a > b;
}

static double median(const double *numbers) {
    double sorted[rounds];
    memcpy(sorted, numbers, sizeof sorted);
    qsort(sorted, rounds, sizeof *sorted, compare);
    return sorted[rounds / 2];
}

static double evaluations_inside(const way *result) {
    const spt_statistics *const traced = &result->statistics.of[WHITTED_INSIDE];
    return (double)traced->evaluations / (double)traced->rays;
}

static void draw_panel(image *picture, const way *result, int column, const char *title) {
    static const float white[3] = {1.0f, 1.0f, 1.0f}, black[3] = {0.0f, 0.0f, 0.0f};
    const int left = column * panel_width;
    char label[96];
    for (int y = 0; y < panel_height; ++y) {
        memcpy(image_at(picture, left, y), image_at(&result->light, 0, y),
               panel_width * 3 * sizeof(float));
        for (int x = 0; x < panel_width; ++x) {
            heat_colour(*image_at(&result->evaluations, x, y) / most_evaluations,
                        image_at(picture, left + x, panel_height + y));
        }
    }
    heat_fill(picture, left, 0, heat_text_width(title) + 12, 15, black);
    heat_text(picture, left + 6, 4, title, white);
    snprintf(label, sizeof label, "%.2f evaluations a ray inside", evaluations_inside(result));
    heat_text(picture, left + 6, panel_height + 4, label, white);
}

/* The pair: above what is seen, below how many evaluations the rays inside took. */
static int write_pair(const char *path, const way ways[2]) {
    image picture = image_create(2 * panel_width, 2 * panel_height + heat_legend_height, 3);
    if (picture.pixels == NULL) return 0;
    draw_panel(&picture, &ways[0], 0, "through the inside");
    draw_panel(&picture, &ways[1], 1, "convex: backwards from the bound");
    heat_legend(&picture, 0, 2 * panel_height, picture.width,
                "evaluations of the rays inside, a pixel", most_evaluations, "");
    const int good = image_write(path, &picture) == 0;
    image_free(&picture);
    return good;
}

int whitted_pair(const char *path) {
    static way ways[2];
    glass_world world;
    double ratios[rounds];
    int good = glass_world_named("glass", &world);
    for (int round = 0; round < rounds && good; ++round) {
        for (int convex = 0; convex < 2; ++convex) {
            good = good && run_round(&world, convex, round, &ways[convex]);
        }
        ratios[round] = ways[0].seconds[round] / ways[1].seconds[round];
    }
    if (!good || !write_pair(path, ways)) return 0;
    printf("%s\n", path);
    for (int convex = 0; convex < 2; ++convex) {
        printf("  %-8s %6.2f evaluations a ray inside, %6.3f s of processor time a frame\n",
               convex ? "convex" : "through", evaluations_inside(&ways[convex]),
               median(ways[convex].seconds));
    }
    printf("  %.2f times fewer evaluations inside, %.3f times the speed of the frame\n",
           evaluations_inside(&ways[0]) / evaluations_inside(&ways[1]), median(ratios));
    for (int convex = 0; convex < 2; ++convex) {
        image_free(&ways[convex].light);
        image_free(&ways[convex].evaluations);
    }
    return 1;
}
