/* SPDX-License-Identifier: MIT
 *
 * The pictures of the models of nature: each model, the variants that the paper compares, the
 * iterations of binary tracing, and a flight. */
#ifndef EXAMPLES_MODELS_PICTURES_H
#define EXAMPLES_MODELS_PICTURES_H

#include "models_render.h"

typedef struct models_options {
    const char *folder; /* must be there */
    const char *name;   /* NULL: all pictures */
    int width, height, samples, threads;
} models_options;

/* Writes model_NAME.png for the picture of that name, or for all, and prints a line for each.
 * Returns the program's exit status. */
int models_pictures(const models_options *options);

/* Evaluations a ray of a conformal model in the model's own view, as a heat map: binary tracing on
 * the left, sphere tracing by the distance bound on the right. Returns 0 where that failed. */
int models_iterations(const models_view *view, image *picture);

/* How much a picture changes, on average over pixels, channels (0 to 1) and frames, where the eye
 * makes a small step, and half of it. */
typedef struct models_flight_figures {
    double difference, half_step_difference;
} models_flight_figures;

/* Flies through a model, the frames so far apart, and looks from every frame a small step ahead.
 * Both are shares of the distance from the eye to what it looks at. view's picture size, samples
 * and threads hold. folder: where to write flight_NN.png; or NULL. Returns 0 on failure. */
int models_flight(const models_view *view, int frames, double apart, double step,
                  const char *folder, models_flight_figures *figures);

/* Writes a picture to FOLDER/model_NAME.png, or says on standard error why not and returns 0. */
int models_write(const char *folder, const char *name, const image *picture);

/* Renders small pictures of every model and says what is wrong with them. Returns the program's
 * exit status. */
int models_check(void);

#endif
