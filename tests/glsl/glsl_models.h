/* SPDX-License-Identifier: MIT
 *
 * Fields of the library's own that the emitter writes without a caller's text. */
#ifndef TESTS_GLSL_MODELS_H
#define TESTS_GLSL_MODELS_H

#include <spheretrace/spheretrace.h>

typedef struct glsl_model {
    const char *name;
    spt_field field;
    int is_sequence; /* KRS or MöKRS */
} glsl_model;

const glsl_model *glsl_models(int *count);

#endif
