/* SPDX-License-Identifier: MIT
 *
 * What the tests on the shared scenes and their components have in common: points, where to draw
 * them, and what is compared. */
#ifndef TESTS_TEST_SCENES_H
#define TESTS_TEST_SCENES_H

#include "../check.h"

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

/* Points as a batch callback wants them: 64-byte aligned, in a union that is as large. */
typedef struct points {
    float room[4][SPT_BATCH + 16];
} points;

static inline float *column(points *set, int which) {
    const size_t misplaced = (size_t)((uintptr_t)set->room[which] % 64) / sizeof(float);
    return set->room[which] + (misplaced == 0 ? 0 : 16 - misplaced);
}

/* The corners of the box around a bound. */
static inline void box_of(const spt_bound *bound, double low[3], double high[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        if (bound->kind == SPT_BOUND_SPHERE) {
            low[axis] = (double)bound->center[axis] - (double)bound->radius;
            high[axis] = (double)bound->center[axis] + (double)bound->radius;
        } else {
            low[axis] = (double)bound->low[axis];
            high[axis] = (double)bound->high[axis];
        }
    }
}

static inline int inside_bound(const spt_bound *bound, const double p[3]) {
    const double center[3] = {(double)bound->center[0], (double)bound->center[1],
                              (double)bound->center[2]};
    if (bound->kind == SPT_BOUND_SPHERE) return apart(p, center) <= (double)bound->radius;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(p[axis] >= (double)bound->low[axis] && p[axis] <= (double)bound->high[axis]))
            return 0;
    }
    return 1;
}

/* Where a scene is looked at: its bound, or a cube around what the camera looks at. */
static inline void region_of(const scene *shown, double low[3], double high[3]) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
        reach = fmax(reach, 0.7 * fabs(shown->eye[axis] - shown->target[axis]));
    }
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = shown->target[axis] - reach;
        high[axis] = shown->target[axis] + reach;
    }
    if (shown->bound != NULL) box_of(shown->bound, low, high);
}

/* A random point between two corners, its coordinates floats. */
static inline void draw_between(const double low[3], const double high[3], double point[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = (double)(float)check_uniform(low[axis], high[axis]);
    }
}

/* A random point of a scene's region. */
static inline void draw_in_region(const scene *shown, double point[3]) {
    double low[3], high[3];
    region_of(shown, low, high);
    draw_between(low, high, point);
}

/* Points of the region, and at the front those where zeros and signs go wrong. */
static inline void fill(const scene *shown, points *set) {
    static const float special[8][3] = {
        {0, 0, 0}, {-0.0f, -0.0f, -0.0f}, {1, 0, 0},           {0, -1, 0},
        {0, 0, 1}, {0, 0.5f, -0.0f},      {1e-20f, 0, 1e-30f}, {1.25f, 0.75f, -0.5f}};
    for (int i = 0; i < SPT_BATCH; ++i) {
        double point[3];
        draw_in_region(shown, point);
        for (int axis = 0; axis < 3; ++axis) {
            column(set, axis)[i] = i < 8 ? special[i][axis] : (float)point[axis];
        }
    }
}

/* The distances at n points of the set, by whichever callback the field has. */
static inline void evaluate(const spt_field *field, points *set, size_t first, size_t n) {
    const float *const x = column(set, 0) + first, *const y = column(set, 1) + first,
                       *const z = column(set, 2) + first;
    float *const distance = column(set, 3) + first;
    for (size_t i = 0; i < n; ++i) {
        distance[i] = field->batch != NULL ? NAN : field->point(field->user, x[i], y[i], z[i]);
    }
    if (field->batch != NULL) field->batch(field->user, n, x, y, z, distance);
}

static inline int differing(const float *a, const float *b, size_t n) {
    int count = 0;
    for (size_t i = 0; i < n; ++i) count += !check_same_bits(a[i], b[i]);
    return count;
}

/* The next narrower width, 0 after 1. */
static inline int narrower(int lanes) {
    return lanes > 4 ? lanes / 2 : lanes == 4 ? 1 : 0;
}

#endif
