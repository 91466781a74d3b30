/* SPDX-License-Identifier: MIT
 *
 * Texts in memory of their own. */
#ifndef TESTS_GLSL_WRITTEN_H
#define TESTS_GLSL_WRITTEN_H

#include "../check.h"

#include <spheretrace/glsl.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Memory that the caller frees, or NULL and a failed check. */
static inline char *written(const spt_glsl_options *options) {
    size_t length = 0;
    (void)spt_glsl_emit(options, NULL, 0, &length);
    char *const text = malloc(length + 1);
    const spt_status status =
        text == NULL ? SPT_BUFFER_TOO_SMALL : spt_glsl_emit(options, text, length + 1, NULL);
    CHECK_SAY(status == SPT_OK, "status %d", (int)status);
    if (status == SPT_OK) return text;
    free(text);
    return NULL;
}

/* Memory that the caller frees: three texts, one behind the other. */
static inline char *joined(const char *before, const char *text, const char *after) {
    const size_t size = strlen(before) + strlen(text) + strlen(after) + 1;
    char *const all = malloc(size);
    CHECK(all != NULL);
    if (all != NULL) snprintf(all, size, "%s%s%s", before, text, after);
    return all;
}

#endif
