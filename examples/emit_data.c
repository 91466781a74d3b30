/* SPDX-License-Identifier: MIT
 *
 * Numbers and texts for the pages' scripts. */
#include "emit_data.h"

#include "step_rules.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Shaders ------------------------------------------------------------------------------- */

spt_status emit_data_create(emit_data *data, emit_page_kind kind, const emit_subject *subject,
                            const emit_job *job) {
    const uint32_t flags = subject->world != NULL ? 0 : subject->field.flags;
    spt_status status = SPT_OK;
    memset(data, 0, sizeof *data);
    data->subject = subject;
    data->job = *job;
    data->job.program = SPT_GLSL_PICTURE;
    if (kind == EMIT_THREE) {
        data->job.target = SPT_GLSL_LIBRARY;
        data->job.features |= SPT_GLSL_NORMAL | SPT_GLSL_OFFSET | SPT_GLSL_SHADOW;
        data->job.uniforms = 0;
    } else {
        data->job.target = SPT_GLSL_FRAGMENT_300_ES;
        data->job.uniforms = EMIT_ALL_PARAMETERS;
    }
    if (subject->world != NULL) data->job.features |= SPT_GLSL_COMPONENT;
    if (kind == EMIT_HYBRID) {
        double away = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            away += (subject->eye[axis] - subject->target[axis]) *
                    (subject->eye[axis] - subject->target[axis]);
        }
        data->planes[0] = (float)(sqrt(away) / 50);
        data->planes[1] = (float)subject->t_max;
        data->job.features |= SPT_GLSL_DEPTH_WRITE;
        status = spt_glsl_depth(data->planes[0], data->planes[1], data->job.depth);
    }
    for (size_t rule = 0; step_rule(rule) != NULL && status == SPT_OK; ++rule) {
        emit_job one = data->job;
        if (kind != EMIT_VIEWER && step_rule(rule) != job->settings.method) continue;
        if (!step_rule_allowed(step_rule(rule), flags)) continue;
        one.settings.method = step_rule(rule);
        data->texts[rule] = emit_shader(subject, &one, &status);
        if (data->texts[rule] == NULL && status == SPT_OK) status = SPT_BUFFER_TOO_SMALL;
    }
    if (status != SPT_OK) emit_data_free(data);
    return status;
}

void emit_data_free(emit_data *data) {
    for (int rule = 0; rule < emit_rules_most; ++rule) free(data->texts[rule]);
    memset(data->texts, 0, sizeof data->texts);
}

/* ---- JSON ---------------------------------------------------------------------------------- */

/* A string; no byte of it can end an element <script>. */
static void put_string(FILE *file, const char *text, size_t length) {
    putc('"', file);
    for (size_t i = 0; i < length; ++i) {
        const unsigned char byte = (unsigned char)text[i];
        if (byte == '"' || byte == '\\') {
            fprintf(file, "\\%c", byte);
        } else if (byte == '\n') {
            fputs("\\n", file);
        } else if (byte < 0x20 || byte == '<') {
            fprintf(file, "\\u%04x", byte);
        } else {
            putc(byte, file);
        }
    }
    putc('"', file);
}

static void put_named(FILE *file, const char *name, const char *text) {
    fprintf(file, "\"%s\": ", name);
    put_string(file, text, strlen(text));
    fputs(",\n", file);
}

static void put_vector(FILE *file, const char *name, const double v[3], const char *end) {
    fprintf(file, "\"%s\": [%.9g, %.9g, %.9g]%s", name, v[0], v[1], v[2], end);
}

/* How many bytes two texts have in common, in whole lines. */
static size_t common_lines(const char *one, const char *other) {
    size_t lines = 0;
    for (size_t i = 0; one[i] != '\0' && one[i] == other[i]; ++i) {
        if (one[i] == '\n') lines = i + 1;
    }
    return lines;
}

/* The texts of the step rules differ in few lines. So each is told in pieces: what is also in the
 * first text, by its place and length there, and what is its own. */
static void put_pieces(FILE *file, const char *first, const char *text) {
    const char *own = text; /* begin of what is not told yet */
    const char *comma = "";
    putc('[', file);
    for (const char *at = text; *at != '\0';) {
        size_t most = 0, place = 0;
        for (const char *line = first; *line != '\0'; line += strcspn(line, "\n") + 1) {
            const size_t common = common_lines(line, at);
            if (common > most) {
                most = common;
                place = (size_t)(line - first);
            }
        }
        const int worth_it = most >= 64;
        const char *const next = at + (worth_it ? most : strcspn(at, "\n") + 1);
        if ((worth_it || *next == '\0') && own < (worth_it ? at : next)) {
            fputs(comma, file);
            put_string(file, own, (size_t)((worth_it ? at : next) - own));
            comma = ", ";
        }
        if (worth_it) {
            fprintf(file, "%s[%zu, %zu]", comma, place, most);
            own = next;
            comma = ", ";
        }
        at = next;
    }
    putc(']', file);
}

static void put_methods(FILE *file, const emit_data *data) {
    const char *first = NULL;
    fputs("\"methods\": [", file);
    for (size_t rule = 0; rule < emit_rules_most; ++rule) {
        const char *const text = data->texts[rule];
        if (text == NULL) continue;
        fprintf(file, "%s\n{\"name\": \"%s\", \"pieces\": ", first == NULL ? "" : ",",
                spt_method_name(step_rule(rule)));
        if (first == NULL) first = text;
        put_pieces(file, first, text);
        putc('}', file);
    }
    fputs("],\n", file);
    if (first != NULL) put_named(file, "text", first);
}

static void put_values(FILE *file, const spt_settings *settings) {
    const spt_glsl_options options = spt_glsl_options_default();
    fprintf(file, "\"values\": {\"budget\": %u, \"epsilon\": %.9g, \"pixel_radius\": 1, ",
            (unsigned)settings->budget, (double)settings->epsilon);
    fprintf(file, "\"relaxation\": %.9g, \"extrapolation\": %.9g, ", (double)settings->relaxation,
            (double)settings->extrapolation);
    fprintf(file, "\"slope_blend\": %.9g, \"step_cap\": %.9g, ", (double)settings->slope_blend,
            (double)settings->step_cap);
    fprintf(file, "\"light_tangent\": %.9g, \"occlusion\": %.9g, \"time\": 0},\n",
            (double)options.light_tangent, (double)options.occlusion);
    const double light[3] = {(double)options.light[0], (double)options.light[1],
                             (double)options.light[2]};
    put_vector(file, "light", light, ",\n");
}

void emit_data_put(FILE *file, const emit_data *data) {
    const emit_subject *const subject = data->subject;
    fputs("{\n", file);
    put_named(file, "name", subject->name);
    put_named(file, "method", spt_method_name(data->job.settings.method));
    if (data->job.target != SPT_GLSL_LIBRARY) put_methods(file, data);
    put_values(file, &data->job.settings);
    fputs("\"names\": {", file);
    for (int i = 0; emit_parameters[i] != NULL; ++i) {
        fprintf(file, "%s\"%s\": \"%s\"", i == 0 ? "" : ", ", emit_parameters[i],
                spt_glsl_default_name((uint32_t)i));
    }
    fprintf(file, "},\n\"components\": %zu,\n",
            subject->world != NULL ? subject->world->scene.count : (size_t)1);
    fprintf(file, "\"planes\": [%.9g, %.9g],\n\"depth\": [%.9g, %.9g],\n", (double)data->planes[0],
            (double)data->planes[1], (double)data->job.depth[0], (double)data->job.depth[1]);
    fputs("\"camera\": {", file);
    put_vector(file, "eye", subject->eye, ", ");
    put_vector(file, "target", subject->target, ", ");
    fprintf(file, "\"tangent\": %.9g, \"far\": %.9g}\n}\n", emit_subject_tangent(subject),
            subject->t_max);
}
