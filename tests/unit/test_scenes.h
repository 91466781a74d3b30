/* SPDX-License-Identifier: MIT
 *
 * What both files of tests on the shared scenes need. */
#ifndef TESTS_TEST_SCENES_H
#define TESTS_TEST_SCENES_H

#include "scenes/scenes.h"

#include <math.h>

/* The scene in double at one point. */
static inline double reference_at(const scene *shown, const double point[3]) {
    double distance;
    shown->reference(1, &point[0], &point[1], &point[2], &distance);
    return distance;
}

static inline double apart(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

#endif
