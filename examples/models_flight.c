/* SPDX-License-Identifier: MIT
 *
 * A flight through a model, frame by frame, and whether it is smooth: where nothing flickers, half
 * a step of the eye changes half as much. Steps must be small beside what is seen, or pictures
 * differ by all that is in them, whatever the step; of foliage, a few millimetres. */
#include "models_pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The mean difference of two pictures as they are shown: after the sRGB curve, without rounding. */
static double difference(const image *one, const image *other) {
    const size_t count = 3 * (size_t)one->width * (size_t)one->height;
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        /* The curve is close to a power of 1 / 2.2. */
        sum +=
            fabs(pow((double)one->pixels[i], 1.0 / 2.2) - pow((double)other->pixels[i], 1.0 / 2.2));
    }
    return sum / (double)count;
}

/* The eye moves along its line of sight, level; what it looks at moves with it. */
static void move(const model *shown, double way, models_view *view) {
    double forward[3];
    for (int axis = 0; axis < 3; ++axis) forward[axis] = shown->target[axis] - shown->eye[axis];
    forward[1] = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        view->eye[axis] = shown->eye[axis] + way * forward[axis];
        view->target[axis] = shown->target[axis] + way * forward[axis];
    }
}

int models_flight(const models_view *view, int frames, double apart, double step,
                  const char *folder, models_flight_figures *figures) {
    image shots[3]; /* a frame, half a step ahead, a step ahead */
    int good = 1;
    for (int i = 0; i < 3; ++i) {
        shots[i] = image_create(view->width, view->height, 3);
        good = good && shots[i].pixels != NULL;
    }
    figures->difference = figures->half_step_difference = 0.0;
    for (int frame = 0; good && frame < frames; ++frame) {
        char name[32];
        snprintf(name, sizeof name, "flight_%02d", frame);
        for (int i = 0; good && i < 3; ++i) {
            models_view moved = *view;
            move(view->shown, apart * frame + 0.5 * step * i, &moved);
            good = models_render(&moved, "flight", &shots[i], NULL);
        }
        if (good && folder != NULL) good = models_write(folder, name, &shots[0]);
        figures->difference += difference(&shots[0], &shots[2]) / frames;
        figures->half_step_difference +=
            0.5 / frames * (difference(&shots[0], &shots[1]) + difference(&shots[1], &shots[2]));
    }
    for (int i = 0; i < 3; ++i) image_free(&shots[i]);
    return good;
}
