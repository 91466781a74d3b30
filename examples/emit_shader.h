/* SPDX-License-Identifier: MIT
 *
 * A shader of a subject, and the words by which a command line says which. */
#ifndef EXAMPLES_EMIT_SHADER_H
#define EXAMPLES_EMIT_SHADER_H

#include "emit_subject.h"

/* Words for targets, programs, features (bits) and parameters (bits), NULL behind the last. */
extern const char *const emit_targets[];
extern const char *const emit_programs[];
extern const char *const emit_features[];
extern const char *const emit_parameters[];

/* All parameters of the list. */
#define EMIT_ALL_PARAMETERS ((2u << SPT_GLSL_NAME_VIEW) - 1u)

/* The number of a word in a list, or -1. */
int emit_word(const char *const *words, const char *word);

/* What to write beside the subject. */
typedef struct emit_job {
    uint32_t target, program, features, uniforms; /* as in spt_glsl_options */
    uint32_t width, height;                       /* of the picture */
    spt_settings settings;                        /* emit_shader() sets the pixel radius */
    float depth[2];
} emit_job;

/* Pictures by the default settings, 960x640; nothing is a uniform that need not be. */
emit_job emit_job_default(void);

/* Writes the shader. Returns memory of malloc(), or NULL with *status: what the library said,
 * SPT_OK where memory ran out. */
char *emit_shader(const emit_subject *subject, const emit_job *job, spt_status *status);

#endif
