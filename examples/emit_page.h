/* SPDX-License-Identifier: MIT
 *
 * Pages for browsers around emitted shaders. */
#ifndef EXAMPLES_EMIT_PAGE_H
#define EXAMPLES_EMIT_PAGE_H

#include "emit_shader.h"

#include <stdio.h>

typedef enum emit_page_kind {
    EMIT_VIEWER, /* camera, sliders, every step rule, views of what the tracing cost */
    EMIT_HYBRID, /* triangles and field in one depth buffer, in WebGL 2 without a library */
    EMIT_THREE,  /* the same in a scene of three.js, which the user brings */
    emit_page_kinds
} emit_page_kind;

/* Writes a page; job->target, program and uniforms are the page's own choice. Returns what the
 * library said; where it is not SPT_OK nothing useful was written. Mind ferror(). */
spt_status emit_page(FILE *file, emit_page_kind kind, const emit_subject *subject,
                     const emit_job *job);

#endif
