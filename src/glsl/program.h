/* SPDX-License-Identifier: MIT
 *
 * What stands before and behind the functions of a shader. */
#ifndef SPTI_GLSL_PROGRAM_H
#define SPTI_GLSL_PROGRAM_H

#include "writer.h"

/* The version, and where data comes from and goes to. */
void spti_glsl_begin(spti_glsl *out);

/* main(). While scanning also in a library: what was asked for. */
void spti_glsl_end(spti_glsl *out);

#endif
