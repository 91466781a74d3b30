/* SPDX-License-Identifier: MIT
 *
 * What is checked where no picture is wanted: that small pictures of all models are sound. */
#include "models_pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { width = 64, height = 36, pixels = width * height };

/* Pixels that are no colour, and those that are black. */
static void judge(const image *picture, int *broken, int *black) {
    *broken = *black = 0;
    for (int i = 0; i < pixels; ++i) {
        const float *rgb = picture->pixels + 3 * i;
        int sound = 1;
        for (int c = 0; c < 3; ++c) sound = sound && rgb[c] >= 0.0f && rgb[c] <= 1.0f;
        *broken += !sound;
        *black += sound && rgb[0] + rgb[1] + rgb[2] < 1e-3f;
    }
}

/* Returns 1 where the picture is as it must be: the model is in it, and all of it is light. Where
 * all fields keep their promises no ray sees one broken, and none ends without a result. */
static int check_model(const model *shown, model_world *world, image *picture) {
    models_count count;
    int broken, black;
    if (!shown->build(world, 0)) {
        printf("%s: not built\n", shown->name);
        return 0;
    }
    models_view view = models_view_of(shown, world);
    view.width = width;
    view.height = height;
    if (!models_render(&view, shown->name, picture, &count)) return 0;
    judge(picture, &broken, &black);
    const uint64_t *ended = count.statistics.outcomes;
    const int good = broken == 0 && black == 0 && ended[SPT_HIT] > pixels / 20 &&
                     ended[SPT_LIMIT] == 0 && ended[SPT_NONFINITE] == 0 && count.steep == 0;
    printf("%-14s hits %4d of %d, %d out of budget, %d not finite, %d steep, %d pixels broken, "
           "%d black\n",
           shown->name, (int)ended[SPT_HIT], (int)pixels, (int)ended[SPT_LIMIT],
           (int)ended[SPT_NONFINITE], (int)count.steep, broken, black);
    return good;
}

/* Whether half a step changes half as much, to within 10 %: where rays end now here, now there, or
 * what they show depends on chance, each step changes the same, however small it is. */
static int check_flight(const model *shown, model_world *world) {
    models_flight_figures figures;
    if (!shown->build(world, 0)) return 0;
    models_view view = models_view_of(shown, world);
    view.width = 128;
    view.height = 72;
    if (!models_flight(&view, 3, 1.0 / 5, 1.0 / 32768, NULL, &figures)) return 0;
    const double share = figures.half_step_difference / figures.difference;
    printf("half a step through the %s changes %.3f of a whole one\n", shown->name, share);
    return share > 0.45 && share < 0.55;
}

int models_check(void) {
    model_world *world = malloc(sizeof *world);
    image picture = image_create(width, height, 3);
    int good = world != NULL && picture.pixels != NULL;
    for (size_t i = 0; world != NULL && picture.pixels != NULL && i < model_count; ++i) {
        good = check_model(models[i], world, &picture) && good;
    }
    const model *forest = model_named("forest");
    good = good && forest != NULL && check_flight(forest, world);
    image_free(&picture);
    free(world);
    return !good;
}
