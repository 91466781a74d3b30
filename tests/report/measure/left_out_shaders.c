/* SPDX-License-Identifier: MIT
 *
 * shaders.csv: how much text the emitter writes for each scene, by what is asked for. */
#include "left_out_shaders.h"

#include "../report.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* ---- Counting -------------------------------------------------------------------------------- */

/* A line of code at a depth of braces: adds to it, and returns whether a definition of a function
 * begins here. Layouts and structures are none. */
static int look_at_line(const char *line, size_t length, int *depth) {
    const int top = *depth == 0;
    int calls = 0, ends = 0;
    for (size_t i = 0; i < length; ++i) {
        if (line[i] == '/' && i + 1 < length && line[i + 1] == '/') break;
        *depth += (line[i] == '{') - (line[i] == '}');
        calls |= line[i] == '(';
        ends |= line[i] == ';' && *depth == 0;
    }
    return top && calls && !ends && isalpha((unsigned char)line[0]) &&
           strncmp(line, "layout", 6) != 0;
}

static shader_size size_of_text(const char *text, size_t bytes) {
    shader_size size = {bytes, 0, 0, 0};
    int depth = 0;
    for (const char *line = text; *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        const size_t blank = strspn(line, " \t");
        const char *const first = line + blank;
        size.lines += 1;
        if (blank < length && *first != '#' && strncmp(first, "//", 2) != 0) {
            size.code_lines += 1;
            size.functions += look_at_line(line, length, &depth);
        }
        line += length + (line[length] != '\0');
    }
    report_expect(depth == 0, "a shader's braces do not match");
    return size;
}

shader_size shader_size_of(const spt_field *field, const spt_glsl_options *options) {
    const spt_settings settings = spt_settings_default();
    spt_glsl_options wanted = *options;
    size_t length = 0;
    wanted.field = field;
    wanted.settings = &settings;
    report_expect(spt_glsl_emit(&wanted, NULL, 0, &length) == SPT_BUFFER_TOO_SMALL,
                  "a scene has no text");
    char *const text = report_allocate(length + 1);
    report_expect(spt_glsl_emit(&wanted, text, length + 1, NULL) == SPT_OK, "no shader came");
    const shader_size size = size_of_text(text, length);
    free(text);
    return size;
}

/* ---- The table ------------------------------------------------------------------------------- */

/* What both targets know. */
#define EVERY_RESULT \
    (SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS | SPT_GLSL_PATH | \
     SPT_GLSL_NORMAL | SPT_GLSL_REFINE)

static const struct {
    const char *name;
    uint32_t of_library, of_program;
} feature_sets[] = {
    {"none", 0, 0},
    {"normal", SPT_GLSL_NORMAL, SPT_GLSL_NORMAL},
    {"all", EVERY_RESULT | SPT_GLSL_OFFSET | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION, EVERY_RESULT}};
enum { set_count = sizeof feature_sets / sizeof feature_sets[0] };

static int cells(const report_options *options) {
    (void)options;
    return (int)scene_count;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const scene *const shown = scenes[cell];
    const spt_field field = scene_field(shown, spt_lanes());
    (void)options;
    for (int program = 0; program < 2; ++program) {
        for (int set = 0; set < set_count; ++set) {
            spt_glsl_options wanted = spt_glsl_options_default();
            wanted.target = program ? SPT_GLSL_FRAGMENT_330 : SPT_GLSL_LIBRARY;
            wanted.program = SPT_GLSL_HITS;
            wanted.features = program ? feature_sets[set].of_program : feature_sets[set].of_library;
            const shader_size size = shader_size_of(&field, &wanted);
            fprintf(rows, "%s,%s,%s,%d,%d,%d,%zu\n", shown->name, program ? "program" : "library",
                    feature_sets[set].name, size.lines, size.code_lines, size.functions,
                    size.bytes);
        }
    }
}

const report_part report_shaders = {
    "shaders", "scene,target,features,lines,code_lines,functions,bytes", cells, measure, 0,
    {0.5, 0.5}};
