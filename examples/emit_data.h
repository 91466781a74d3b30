/* SPDX-License-Identifier: MIT
 *
 * What a page is told about its scene: shaders, camera, numbers and colours, as JSON. */
#ifndef EXAMPLES_EMIT_DATA_H
#define EXAMPLES_EMIT_DATA_H

#include "emit_page.h"

enum { emit_rules_most = 8 };

typedef struct emit_data {
    const emit_subject *subject;
    emit_job job;
    char *texts[emit_rules_most]; /* a shader for each step rule of step_rules.h, or NULL */
    float planes[2];              /* near and far, of the hybrid page */
} emit_data;

/* Writes the shaders of a page. Returns what the library said; unless it is SPT_OK there is nothing
 * to be freed. */
spt_status emit_data_create(emit_data *data, emit_page_kind kind, const emit_subject *subject,
                            const emit_job *job);
void emit_data_free(emit_data *data);

/* One object of JSON, which may stand in an element <script>. */
void emit_data_put(FILE *file, const emit_data *data);

#endif
