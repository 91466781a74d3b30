/* SPDX-License-Identifier: MIT
 *
 * Fields as functions: callers' texts, and the library's own fields by the rooms that made them. */
#include "../base/arguments.h"
#include "../base/marks.h"
#include "parameters.h"
#include "writer.h"

/* Lines that are the caller's: compilers name them by source string and line. In a library the
 * host's line numbers count. */
static void put_text(spti_glsl *out, const char *text, uint32_t string) {
    const int numbered = out->options->target != SPT_GLSL_LIBRARY;
    const size_t length = strlen(text);
    if (numbered) spti_glsl_format(out, "#line 1 %d\n", (int)string);
    out->callers = 1;
    spti_glsl_put_bytes(out, text, length);
    out->callers = 0;
    if (length > 0 && text[length - 1] != '\n') spti_glsl_put(out, "\n");
    if (numbered) spti_glsl_format(out, "#line %d 0\n", (int)out->line + 1);
}

void spti_glsl_prelude(spti_glsl *out, const char *prelude) {
    if (prelude == NULL) return;
    for (uint32_t i = 0; i < out->preludes; ++i) {
        if (strcmp(out->prelude[i], prelude) == 0) return;
    }
    if (out->preludes == SPT_GLSL_FIELDS || !spti_glsl_text_is_good(prelude)) {
        spti_glsl_stop(out, SPT_BAD_ARGUMENT);
        return;
    }
    out->prelude[out->preludes++] = prelude;
    put_text(out, prelude, 2 * out->texts + 2);
    if (out->fields == 0) spti_glsl_put(out, "\n"); /* else the next field's does it */
}

void spti_glsl_body(spti_glsl *out, const char *head, const char *body) {
    if (!spti_glsl_text_is_good(body)) {
        spti_glsl_stop(out, SPT_BAD_ARGUMENT);
        return;
    }
    spti_glsl_format(out, "%s {\n", head);
    put_text(out, body, 2 * out->texts + 1);
    out->texts += 1;
    spti_glsl_put(out, "}\n");
}

int spti_glsl_next_field(spti_glsl *out) {
    if (out->fields == SPT_GLSL_FIELDS) {
        spti_glsl_stop(out, SPT_BAD_ARGUMENT);
        return 0;
    }
    if (out->fields > 0) spti_glsl_put(out, "\n");
    return (int)out->fields++;
}

static int put_callers(spti_glsl *out, const spt_field *field) {
    char head[64] = "float spt_field_";
    spti_glsl_prelude(out, field->glsl_prelude);
    const int number = spti_glsl_next_field(out);
    char digits[4] = {0};
    int count = 0;
    for (int rest = number; count == 0 || rest != 0; rest /= 10)
        digits[count++] = (char)('0' + rest % 10);
    size_t length = strlen(head);
    for (; count > 0;) head[length++] = digits[--count];
    memcpy(head + length, "(vec3 p)", sizeof "(vec3 p)");
    spti_glsl_body(out, head, field->glsl);
    return number;
}

int spti_glsl_field(spti_glsl *out, const spt_field *field) {
    const struct {
        const char *mark;
        spti_glsl_field_fn *write;
    } own[] = {{spti_mark_krs, spti_glsl_krs},
               {spti_mark_moekrs, spti_glsl_moekrs},
               {spti_mark_conformal, spti_glsl_conformal},
               {spti_mark_distorted, spti_glsl_distorted},
               {spti_mark_level_set, spti_glsl_level_set}};
    int number = 0;
    if (out->status != SPT_OK) return 0;
    if (field->glsl == NULL || out->depth == SPT_GLSL_DEPTH) {
        spti_glsl_stop(out, field->glsl == NULL ? SPT_UNSUPPORTED : SPT_BAD_ARGUMENT);
        return 0;
    }
    out->depth += 1;
    for (size_t i = 0; i < sizeof own / sizeof *own; ++i) {
        if (field->glsl != own[i].mark) continue;
        number = own[i].write(out, field);
        out->depth -= 1;
        return number;
    }
    number = put_callers(out, field);
    out->depth -= 1;
    return number;
}
