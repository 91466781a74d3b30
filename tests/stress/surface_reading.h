/* SPDX-License-Identifier: MIT
 *
 * What the checks of surface_results.h read: the columns of a call by index, rays, values of fields
 * and the tolerance of trace.h. */
#ifndef TESTS_SURFACE_READING_H
#define TESTS_SURFACE_READING_H

#include "surface_results.h"

/* Formulas in float of fewer than ten operations, each within 2^-24, on both sides of a
 * comparison. */
static const double surface_rounding = 0x1p-20;

/* In functions that return the text of the first broken promise. */
#define MUST(condition) \
    do { \
        if (!(condition)) return #condition; \
    } while (0)

uint32_t surface_input_word(const surface_call *call, int column, size_t index, uint32_t absent);
float surface_input_float(const surface_call *call, int column, size_t index, float absent);
/* The first word of an element, as it is now. */
uint32_t surface_written(const surface_call *call, int column, size_t index, uint32_t absent);
float surface_written_float(const surface_call *call, int column, size_t index, float absent);
/* The outputs of a set have the words of truth->before. */
int surface_same_as_before(const surface_call *call, const surface_truth *truth, size_t index,
                           uint32_t columns);

int surface_is_finite(float a);
int surface_within(float a, float low, float high);
double surface_largest(const float v[3]);

typedef struct surface_line {
    float origin[3], direction[3], t_min, t_max, path;
    double length; /* of the direction */
} surface_line;

surface_line surface_line_of(const surface_call *call, size_t index);
/* One product and one sum an axis, as the library forms it. */
void surface_place_on(const surface_line *ray, float t, float position[3]);
float surface_value_at(const surface_truth *truth, int32_t component, const float p[3]);
/* Whether f can be asked for the same bits that the library was given. */
int surface_can_ask(const surface_truth *truth, const surface_line *ray);
/* Whether a residual is f at a place on a ray; 1 where that cannot be asked. */
int surface_is_value(const surface_truth *truth, const surface_line *ray, int32_t component,
                     float t, float residual);
/* tolerance(t) of trace.h, at most. */
double surface_most_tolerance(const surface_call *call, const surface_truth *truth,
                              const surface_line *ray, double t);

/* Zero or of unit length. */
int surface_is_normal(const surface_call *call, size_t index);
int surface_is_zero(const surface_call *call, size_t index);

/* One call each, in surface_answers.c; the index is not idle. */
const char *surface_wrong_convex(const surface_call *call, const surface_truth *truth,
                                 size_t index);
const char *surface_wrong_occluded(const surface_call *call, size_t index);
const char *surface_wrong_shadow(const surface_call *call, size_t index);
const char *surface_wrong_crossings(const surface_call *call, const surface_truth *truth,
                                    size_t index);
const char *surface_wrong_ambient(const surface_call *call, size_t index);
const char *surface_wrong_collide(const surface_call *call, size_t index);

#endif
