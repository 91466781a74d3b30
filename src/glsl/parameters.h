/* SPDX-License-Identifier: MIT
 *
 * Parameters: what a text writes as $name, and what the host knows by a uniform's name. */
#ifndef SPTI_GLSL_PARAMETERS_H
#define SPTI_GLSL_PARAMETERS_H

#include "writer.h"

/* Writes what stands for $word. */
void spti_glsl_parameter(spti_glsl *out, const char *word, size_t length);

/* While scanning: a word of a caller's text may be the name of a uniform, which is then declared. One
 * of our own texts (`own`) must not be. */
void spti_glsl_use_name(spti_glsl *out, const char *word, int own);

/* "precise", "SPT_PRECISE" or "". */
const char *spti_glsl_precise(const spti_glsl *out);

/* An int as decimal digits. */
void spti_glsl_integer(spti_glsl *out, int number);

/* Writes the declarations of the uniforms, or the macros of a library's settings, that were used.
 */
void spti_glsl_declare(spti_glsl *out);

/* Whether a caller's names are legal (glsl.h). */
int spti_glsl_names_are_good(const char *const *names);

/* The parameters that are always uniforms. */
#define SPTI_GLSL_ALWAYS \
    ((1u << SPT_GLSL_NAME_SIZE) | (1u << SPT_GLSL_NAME_BUDGET) | \
     (1u << SPT_GLSL_NAME_RAY_ORIGIN) | (1u << SPT_GLSL_NAME_RAY_DIRECTION) | \
     (1u << SPT_GLSL_NAME_RAY_PATH) | (1u << SPT_GLSL_NAME_STARTS))

#endif
