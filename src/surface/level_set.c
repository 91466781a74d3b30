/* SPDX-License-Identifier: MIT
 *
 * The field that undoes the half pixel by which the stop at half a pixel inflates bodies.
 *
 * With L the Lipschitz constant of f, p the pixel radius, e the distance from the eye along the
 * path, and a the share, this is F = f + L a p e. e grows by one per unit of length at most, so
 * F has the constant L (1 + a p), and the driver stops where
 *     F / (L (1 + a p)) < p' e   with   p' = p / (1 + a p),
 * which is f / L < (1 - a) p e, whatever L is. (Keinert et al. 2014, section 3.2, for L = 1.) */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../base/marks.h"
#include "../trace/driver.h"

#include <spheretrace/surface.h>

/* An eighth of the distance from the eye, which exists as a float for any points. In double, whose
 * range squares any float. */
static void measure_eighths(const spt_level_set *set, size_t n, const float *x, const float *y,
                            const float *z, float *eighths) {
    const double eye_x = (double)set->eye[0], eye_y = (double)set->eye[1];
    const double eye_z = (double)set->eye[2], path = (double)set->path;
    for (size_t i = 0; i < n; ++i) {
        const double a = (double)x[i] - eye_x, b = (double)y[i] - eye_y, c = (double)z[i] - eye_z;
        eighths[i] = (float)(0.125 * (path + sqrt(a * a + b * b + c * c)));
    }
}

static void level_set_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *distance) {
    const spt_level_set *const set = user;
    const float widening = 8.0f * set->widening;
    float eighths[SPT_BATCH];
    measure_eighths(set, n, x, y, z, eighths); /* first: the callback may use its points */
    spti_ask_groups(&set->inner, n, x, y, z, distance);
    for (size_t i = 0; i < n; ++i) distance[i] += widening * eighths[i];
}

/* That of f: its normals are those of the body that is seen, and differ from the gradient of F by
 * less than the angle of a pixel. */
static void level_set_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *gradient_x, float *gradient_y, float *gradient_z) {
    const spt_field *const inner = &((const spt_level_set *)user)->inner;
    inner->gradient(inner->user, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

spt_status spt_level_set_field(const spt_field *field, const float eye[3], float path, float share,
                               spt_settings *settings, spt_level_set *memory, spt_field *result) {
    spt_level_set set;
    spt_bound bound;
    spt_settings copy;
    if (eye == NULL || memory == NULL || result == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_field_copy(&set.inner, &bound, field)) return SPT_BAD_ARGUMENT;
    if (!spti_settings_copy(&copy, settings)) return SPT_BAD_ARGUMENT;
    if (!spti_within(path, 0.0f, FLT_MAX) || !spti_within(share, 0.0f, 1.0f)) {
        return SPT_BAD_ARGUMENT;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(eye[axis])) return SPT_BAD_ARGUMENT;
        set.eye[axis] = eye[axis];
    }
    const float undone = share * copy.pixel_radius;
    set.path = path;
    set.widening = set.inner.lipschitz * undone;
    spt_field made = set.inner;
    made.batch = level_set_distance;
    made.point = NULL;
    made.user = memory;
    made.lipschitz = set.inner.lipschitz + set.widening;
    made.gradient = set.inner.gradient != NULL ? level_set_gradient : NULL;
    made.glsl = spti_mark_level_set;
    made.glsl_prelude = NULL;
    if (!spti_within(made.lipschitz, 0x1p-100f, 0x1p100f)) return SPT_BAD_ARGUMENT;
    settings->pixel_radius = copy.pixel_radius / (1.0f + undone);
    *memory = set;
    *result = made;
    return SPT_OK;
}
