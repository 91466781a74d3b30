/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: kernel-reflection sequences as a renderer uses them. Trees, corals and
 * rocks of a few dozen numbers each are traced as fields of a scene, with cones and culling; at
 * hits the library tells the kernel, the mirrors, and the place on it, which textures are made of.
 * Without arguments it only checks that small pictures of all models are sound. */
#include "models_pictures.h"
#include "workers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] = "usage: models [FOLDER [NAME] [--large] [--size WxH] [--samples N]]\n"
                            "       models --flight FOLDER [NAME] [--size WxH] [--samples N]\n";

static int refuse(const char *what) {
    fprintf(stderr, "models: no use for '%s'\n%s", what, usage);
    return 2;
}

static int fly(const models_options *options) {
    const model *shown = model_named(options->name != NULL ? options->name : "forest");
    model_world *world = malloc(sizeof *world);
    models_flight_figures figures;
    int good = world != NULL && shown != NULL && shown->build(world, 0);
    if (good) {
        models_view view = models_view_of(shown, world);
        view.width = options->width;
        view.height = options->height;
        view.samples = options->samples;
        view.threads = options->threads;
        good = models_flight(&view, 24, 1.0 / 40, 1.0 / 32768, options->folder, &figures);
    }
    free(world);
    if (!good) return 1;
    const double share = figures.half_step_difference / figures.difference;
    printf("a small step changes %.6f on average, half of it %.6f: %.3f of that\n",
           figures.difference, figures.half_step_difference, share);
    return !(share > 0.45 && share < 0.55);
}

/* Reads "WxH". */
static int read_size(const char *text, models_options *options) {
    int used = 0;
    return sscanf(text, "%5dx%5d%n", &options->width, &options->height, &used) == 2 &&
           text[used] == '\0' && options->width >= 16 && options->height >= 64 &&
           options->width <= image_largest_side && options->height <= image_largest_side;
}

int main(int count, char **arguments) {
    models_options options = {NULL, NULL, 640, 360, 2, 1};
    int flight = 0;
    if (count == 1) return models_check();
    options.threads = workers_processors();
    for (int i = 1; i < count; ++i) {
        if (strcmp(arguments[i], "--flight") == 0) {
            flight = 1;
            options.width = 320;
            options.height = 180;
            options.samples = 1;
        } else if (strcmp(arguments[i], "--large") == 0) {
            options.width = 1920;
            options.height = 1080;
            options.samples = 2;
        } else if (strcmp(arguments[i], "--size") == 0 && i + 1 < count) {
            if (!read_size(arguments[++i], &options)) return refuse(arguments[i]);
        } else if (strcmp(arguments[i], "--samples") == 0 && i + 1 < count) {
            options.samples = atoi(arguments[++i]);
            if (options.samples < 1 || options.samples > 8) return refuse(arguments[i]);
        } else if (arguments[i][0] == '-') {
            return refuse(arguments[i]);
        } else if (options.folder == NULL) {
            options.folder = arguments[i];
        } else if (options.name == NULL) {
            options.name = arguments[i];
        } else {
            return refuse(arguments[i]);
        }
    }
    if (options.folder == NULL) return refuse("no folder");
    workers_catch_interrupts();
    return flight ? fly(&options) : models_pictures(&options);
}
