/* SPDX-License-Identifier: MIT
 *
 * Columns, rays and values of a call, for what surface_results.h promises. */
#include "surface_reading.h"

#include <float.h>
#include <math.h>

/* ---- Reading --------------------------------------------------------------------------------- */

uint32_t surface_input_word(const surface_call *call, int column, size_t index, uint32_t absent) {
    return surface_read(&call->in[column], index, absent);
}

float surface_input_float(const surface_call *call, int column, size_t index, float absent) {
    return surface_float(surface_input_word(call, column, index, surface_bits(absent)));
}

static uint32_t output_word(const surface_call *call, int column, size_t index, size_t word) {
    const spt_column view = {(const char *)call->out[column].first + 4 * word,
                             call->out[column].stride};
    return surface_read(&view, index, 0);
}

uint32_t surface_written(const surface_call *call, int column, size_t index, uint32_t absent) {
    return call->out[column].first == NULL ? absent : output_word(call, column, index, 0);
}

float surface_written_float(const surface_call *call, int column, size_t index, float absent) {
    return surface_float(surface_written(call, column, index, surface_bits(absent)));
}

int surface_is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

int surface_within(float a, float low, float high) {
    return a >= low && a <= high;
}

double surface_largest(const float v[3]) {
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

surface_line surface_line_of(const surface_call *call, size_t index) {
    surface_line ray;
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = surface_input_float(call, IN_ORIGIN + axis, index, 0.0f);
        ray.direction[axis] = surface_input_float(call, IN_DIRECTION + axis, index, 0.0f);
        square += (double)ray.direction[axis] * (double)ray.direction[axis];
    }
    ray.length = sqrt(square);
    ray.t_min = surface_input_float(call, IN_T_MIN, index, 0.0f);
    ray.t_max = surface_input_float(call, IN_T_MAX, index, INFINITY);
    ray.path = surface_input_float(call, IN_PATH, index, 0.0f);
    return ray;
}

int surface_ray_is_bad(const surface_call *call, size_t index) {
    const surface_line ray = surface_line_of(call, index);
    int all = surface_is_finite(ray.t_min) && surface_is_finite(ray.path) && ray.t_min >= 0.0f &&
              ray.path >= 0.0f;
    int some = 0;
    all = all && ray.t_max <= INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        all = all && surface_is_finite(ray.origin[axis]) && surface_is_finite(ray.direction[axis]);
        some = some || fabsf(ray.direction[axis]) >= FLT_MIN;
    }
    return !(all && some);
}

int surface_is_idle(const surface_call *call, size_t index) {
    return SURFACE_HAS(surface_table[call->door].inputs, IN_ACTIVE) &&
           surface_input_word(call, IN_ACTIVE, index, 1) == 0;
}

/* One product and one sum an axis, as the library forms it. */
void surface_place_on(const surface_line *ray, float t, float position[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const float along = t * ray->direction[axis];
        position[axis] = ray->origin[axis] + along;
    }
}

float surface_value_at(const surface_truth *truth, int32_t component, const float p[3]) {
    return truth->value(truth->user, (size_t)component, p[0], p[1], p[2]);
}

/* Directions far from 1 are scaled before they are multiplied, which is exact but for the ends of
 * the range. */
int surface_can_ask(const surface_truth *truth, const surface_line *ray) {
    const double direction = surface_largest(ray->direction);
    return truth->value != NULL && direction > 1e-10 && direction < 1e10 &&
           surface_largest(ray->origin) < 1e10;
}

int surface_is_value(const surface_truth *truth, const surface_line *ray, int32_t component,
                     float t, float residual) {
    float p[3];
    if (!surface_can_ask(truth, ray)) return 1;
    surface_place_on(ray, t, p);
    return surface_bits(surface_value_at(truth, component, p)) == surface_bits(residual);
}

/* tolerance(t) of trace.h, at most. */
double surface_most_tolerance(const surface_call *call, const surface_truth *truth,
                              const surface_line *ray, double t) {
    const double world = t * ray->length, size = fmax(truth->size, (double)call->settings->size);
    const double floor_of_t = 0x1p-22 * (surface_largest(ray->origin) + world + size);
    const double cone = (double)call->settings->pixel_radius * ((double)ray->path + world);
    const double exact = fmax((double)call->settings->epsilon, fmax(cone, floor_of_t));
    return exact * (1 + surface_rounding) + 20 * 0x1p-149;
}

/* ---- Left as it was -------------------------------------------------------------------------- */

int surface_same_as_before(const surface_call *call, const surface_truth *truth, size_t index,
                           uint32_t columns) {
    for (int column = 0; column < surface_outputs; ++column) {
        const size_t words = surface_width(column) / 4;
        if (!SURFACE_HAS(columns, column) || call->out[column].first == NULL) continue;
        for (size_t word = 0; word < words; ++word) {
            const uint32_t now = column == OUT_CROSSING && word > 0
                                     ? output_word(call, column, index, word)
                                     : surface_written(call, column, index, 0);
            if (now != truth->before[column][index * words + word]) return 0;
        }
    }
    return 1;
}

int surface_untouched(const surface_call *call, const surface_truth *truth, size_t index) {
    return surface_same_as_before(call, truth, index, surface_table[call->door].outputs);
}

/* ---- Vectors --------------------------------------------------------------------------------- */

/* Of unit length by seven operations in float, each within 2^-24. */
int surface_is_normal(const surface_call *call, size_t index) {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double)surface_written_float(call, OUT_VECTOR + axis, index, 0.0f);
        square += a * a;
    }
    return !(square > 0.0 || square < 0.0) || fabs(sqrt(square) - 1.0) <= 8 * 0x1p-24;
}

int surface_is_zero(const surface_call *call, size_t index) {
    for (int axis = 0; axis < 3; ++axis) {
        const float a = surface_written_float(call, OUT_VECTOR + axis, index, 0.0f);
        if (!(fabsf(a) <= 0.0f)) return 0;
    }
    return 1;
}
