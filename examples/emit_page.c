/* SPDX-License-Identifier: MIT
 *
 * Fills the pages' templates: {{word}} becomes a text, or another file of examples/pages. */
#include "emit_page.h"

#include "emit_data.h"
#include "emit_pages.h"

#include <string.h>

static const struct {
    const char *name;
    const char *const *lines;
} files[] = {
    {"viewer.css", page_viewer_css},
    {"viewer_orbit.js", page_viewer_orbit_js},
    {"viewer_draw.js", page_viewer_draw_js},
    {"viewer_panel.js", page_viewer_panel_js},
    {"viewer.js", page_viewer_js},
    {"hybrid.js", page_hybrid_js},
    {"three.js", page_three_js},
};

static const char *const *const pages[emit_page_kinds] = {page_viewer_html, page_hybrid_html,
                                                          page_three_html};

/* As text of HTML, and inside of quotes. */
static void put_html(FILE *file, const char *text) {
    for (; *text != '\0'; ++text) {
        switch (*text) {
        case '&':
            fputs("&amp;", file);
            break;
        case '<':
            fputs("&lt;", file);
            break;
        case '>':
            fputs("&gt;", file);
            break;
        case '"':
            fputs("&quot;", file);
            break;
        default:
            putc(*text, file);
        }
    }
}

static void put_word(FILE *file, const char *word, const emit_data *data) {
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        if (strcmp(files[i].name, word) != 0) continue;
        for (const char *const *line = files[i].lines; *line != NULL; ++line) fputs(*line, file);
        return;
    }
    if (strcmp(word, "name") == 0) put_html(file, data->subject->name);
    if (strcmp(word, "description") == 0) put_html(file, data->subject->description);
    if (strcmp(word, "version") == 0) {
        fprintf(file, "%d.%d.%d", SPT_VERSION_MAJOR, SPT_VERSION_MINOR, SPT_VERSION_PATCH);
    }
    if (strcmp(word, "shader") == 0) {
        for (int rule = 0; rule < emit_rules_most; ++rule) {
            if (data->texts[rule] != NULL) fputs(data->texts[rule], file);
        }
    }
    if (strcmp(word, "data") == 0) emit_data_put(file, data);
}

static void put_line(FILE *file, const char *line, const emit_data *data) {
    for (;;) {
        const char *const begin = strstr(line, "{{");
        const char *const end = begin != NULL ? strstr(begin, "}}") : NULL;
        char word[32];
        if (end == NULL || end - begin - 2 >= (int)sizeof word) break;
        fwrite(line, 1, (size_t)(begin - line), file);
        memcpy(word, begin + 2, (size_t)(end - begin - 2));
        word[end - begin - 2] = '\0';
        put_word(file, word, data);
        line = end + 2;
    }
    fputs(line, file);
}

spt_status emit_page(FILE *file, emit_page_kind kind, const emit_subject *subject,
                     const emit_job *job) {
    emit_data data;
    const spt_status status = emit_data_create(&data, kind, subject, job);
    if (status != SPT_OK) return status;
    for (const char *const *line = pages[kind]; *line != NULL; ++line) put_line(file, *line, &data);
    emit_data_free(&data);
    return SPT_OK;
}
