/* SPDX-License-Identifier: MIT
 *
 * How large an emitted shader is. */
#ifndef TESTS_REPORT_LEFT_OUT_SHADERS_H
#define TESTS_REPORT_LEFT_OUT_SHADERS_H

#include <spheretrace/spheretrace.h>

typedef struct shader_size {
    size_t bytes;
    int lines;
    int code_lines; /* that are neither empty nor comments nor for the preprocessor */
    int functions;  /* definitions */
} shader_size;

/* Of a field as the options want it; options->field and ->settings need not be set. Ends the
 * program where the emitter refuses. */
shader_size shader_size_of(const spt_field *field, const spt_glsl_options *options);

#endif
