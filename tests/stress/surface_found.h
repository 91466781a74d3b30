/* SPDX-License-Identifier: MIT
 *
 * What the tests of faults once found in surfaces share: widths, and fields that count. */
#ifndef STRESS_SURFACE_FOUND_H
#define STRESS_SURFACE_FOUND_H

#include "stress.h"

#include "../rules.h"

#include <math.h>

#define FOR_EACH_WIDTH \
    int width = 0; \
    width < width_count; \
    ++width

typedef struct subject {
    stress_distance_fn *distance;
    const void *data;
    uint32_t calls; /* of a single ray each is one evaluation */
} subject;

static inline void subject_batch(void *user, size_t n, const float *x, const float *y,
                                 const float *z, float *distance) {
    subject *const self = user;
    ++self->calls;
    for (size_t i = 0; i < n; ++i) distance[i] = self->distance(self->data, x[i], y[i], z[i]);
}

static inline spt_field field_of(subject *self, uint32_t flags, const spt_bound *bound) {
    spt_field field = spt_field_default();
    field.batch = subject_batch;
    field.user = self;
    field.flags = flags;
    field.bound = bound;
    return field;
}

static const stress_sphere unit = {{0.0f, 0.0f, 0.0f}, 1.0f};
static subject ball = {stress_sphere_distance, &unit, 0};

static inline spt_settings settings_of(int width, uint32_t flags) {
    spt_settings settings = spt_settings_default();
    settings.max_lanes = widths[width];
    settings.flags = flags;
    check_context("width %u, flags %x", widths[width], (unsigned)flags);
    return settings;
}

static inline void random_unit(double vector[3]) {
    double square;
    do {
        square = 0;
        for (int i = 0; i < 3; ++i) {
            vector[i] = check_uniform(-1, 1);
            square += vector[i] * vector[i];
        }
    } while (square > 1 || square < 0.01);
    for (int i = 0; i < 3; ++i) vector[i] /= sqrt(square);
}

static inline double product(const float a[3], const float b[3]) {
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

#endif
