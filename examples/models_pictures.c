/* SPDX-License-Identifier: MIT
 *
 * The list of pictures, and how each is written. */
#include "models_pictures.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pictures besides the models' own. A picture of a model that is not there is left out. */
typedef struct extra_picture {
    const char *name, *model;
    int variant;
    float sun; /* as in models_view; negative: as usual */
    double
        near; /* 0: the model's own view; else as models_look_at() has it, of the first component */
} extra_picture;

static const extra_picture extra_pictures[] = {
    {"rock_flat", "rock", 1, -1.0f, 0.0},             /* Figure 8 */
    {"fish_aligned", "fish", 1, -1.0f, 0.7},          /* Figure 5 */
    {"tree_straight", "twisted_tree", 1, -1.0f, 0.0}, /* Figure 6 */
    {"tree_hard", "tree", 0, 0.0f, 0.0},              /* Figure 11 */
    {"tree_soft", "tree", 0, 0.12f, 0.0},
};
enum { extra_count = sizeof extra_pictures / sizeof extra_pictures[0] };

int models_write(const char *folder, const char *name, const image *picture) {
    char path[1024];
    const int length = snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (length < 0 || (size_t)length >= sizeof path) {
        fprintf(stderr, "models: the folder's name is too long\n");
        return 0;
    }
    errno = 0;
    if (image_write(path, picture) == 0) return 1;
    fprintf(stderr, "models: cannot write '%s': %s\n", path, strerror(errno));
    return 0;
}

/* The model of a picture, its world and its view; or 0 where there is none. */
static int set_up(const models_options *options, const extra_picture *wanted, model_world *world,
                  models_view *view) {
    const model *shown = model_named(wanted->model);
    if (shown == NULL) return 0;
    if (!shown->build(world, wanted->variant)) {
        fprintf(stderr, "models: %s was not built\n", wanted->model);
        return 0;
    }
    *view = models_view_of(shown, world);
    view->width = options->width;
    view->height = options->height;
    view->samples = options->samples;
    view->threads = options->threads;
    if (wanted->sun >= 0.0f) view->sun = wanted->sun;
    if (!(wanted->near > 0.0)) return 1;
    return world->fields[0].bound != NULL &&
           models_look_at(world->fields[0].bound, wanted->near, view);
}

/* Returns 0 where a picture failed. */
static int make(const models_options *options, const extra_picture *wanted, model_world *world,
                int iterations) {
    models_view view;
    models_count count;
    char name[64];
    if (options->name != NULL && strcmp(options->name, wanted->name) != 0) return 1;
    if (model_named(wanted->model) == NULL) return 1;
    if (!set_up(options, wanted, world, &view)) return 0;
    image picture = image_create(options->width, options->height, 3);
    if (picture.pixels == NULL) return 0;
    memset(&count, 0, sizeof count);
    snprintf(name, sizeof name, "model_%s", wanted->name);
    const int done = iterations ? models_iterations(&view, &picture)
                                : models_render(&view, wanted->name, &picture, &count);
    const int written = done && models_write(options->folder, name, &picture);
    if (written && !iterations) {
        const spt_statistics *is = &count.statistics;
        const double rays = is->rays != 0 ? (double)is->rays : 1.0;
        printf("%-22s %2zu components, %5.1f evaluations a ray, hits %5.1f %%, undecided %.3f %%\n",
               name, world->scene.count, (double)(is->evaluations + is->cone_evaluations) / rays,
               100.0 * (double)is->outcomes[SPT_HIT] / rays,
               100.0 * (double)is->outcomes[SPT_LIMIT] / rays);
    }
    image_free(&picture);
    return written;
}

int models_pictures(const models_options *options) {
    static const extra_picture iterations = {"palm_iterations", "palm", 0, -1.0f, 0.0};
    model_world *world = malloc(sizeof *world);
    int good = world != NULL;
    for (size_t i = 0; good && i < model_count; ++i) {
        const extra_picture own = {models[i]->name, models[i]->name, 0, -1.0f, 0.0};
        good = make(options, &own, world, 0);
    }
    /* What is to be compared needs no size. */
    models_options smaller = *options;
    if (options->name == NULL) {
        smaller.width = options->width / 2;
        smaller.height = options->height / 2;
    }
    for (size_t i = 0; good && i < extra_count; ++i) {
        good = make(&smaller, &extra_pictures[i], world, 0);
    }
    good = good && make(options, &iterations, world, 1);
    free(world);
    return !good;
}
