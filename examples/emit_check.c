/* SPDX-License-Identifier: MIT
 *
 * Writes everything, and looks at it as far as that is possible without a compiler of GLSL: those
 * are asked by the tests. */
#include "emit_check.h"

#include "emit_page.h"
#include "step_rules.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int lines_of(const char *text) {
    int lines = 0;
    for (; *text != '\0'; ++text) lines += *text == '\n';
    return lines;
}

/* Whether brackets are closed in their order (but for comments), and all is printable ASCII in
 * lines that have no blanks at their ends. */
static int is_tidy(const char *text) {
    const char *const brackets = "(){}[]";
    char open[64];
    int depth = 0, comment = 0;
    for (const char *at = text; *at != '\0'; ++at) {
        const char *const bracket = strchr(brackets, *at);
        if (*at == '\n' ? at > text && at[-1] == ' ' : !isprint((unsigned char)*at)) return 0;
        if (at[0] == '/' && at[1] == '/') comment = 1;
        if (*at == '\n') comment = 0;
        if (bracket == NULL || comment) continue;
        if ((bracket - brackets) % 2 == 0) {
            if (depth == (int)sizeof open) return 0;
            open[depth++] = bracket[1];
        } else if (depth == 0 || open[--depth] != *at) {
            return 0;
        }
    }
    return depth == 0 && lines_of(text) > 0;
}

/* Whether a host finds what it expects. */
static int has_ends(const emit_job *job, const char *text) {
    static const char *const versions[] = {
        NULL,           "#version 330 core\n", "#version 300 es\n", NULL, "#version 310 es\n",
        "#version 430", "#version 450",        "#version 450"};
    const int has_main = strstr(text, "void main()") != NULL;
    const int has_image = strstr(text, "void mainImage(") != NULL;
    if (strstr(text, "#version") != NULL && versions[job->target] == NULL) return 0;
    if (versions[job->target] != NULL && strstr(text, versions[job->target]) != text) return 0;
    return has_main == (versions[job->target] != NULL) &&
           has_image == (job->target == SPT_GLSL_SHADERTOY);
}

/* glsl.h: Shadertoy has pictures only, compute targets have none; a library does not look. */
static int is_possible(uint32_t target, uint32_t program) {
    if (target == SPT_GLSL_LIBRARY) return 1;
    if (target == SPT_GLSL_SHADERTOY) return program == SPT_GLSL_PICTURE;
    return target < SPT_GLSL_COMPUTE_310_ES || program != SPT_GLSL_PICTURE;
}

/* Whether all of it has a text: a callback without one cannot be written and must be refused. */
static int is_writable(const emit_subject *subject) {
    if (subject->world == NULL) return subject->field.glsl != NULL;
    for (size_t i = 0; i < subject->world->count; ++i) {
        const model_component *const component = &subject->world->components[i];
        const spt_distorted *const distorted = component->distorted;
        const spt_krs *const krs = component->krs;
        if (distorted != NULL && distorted->distortion.kind == SPT_DISTORTION_MAP &&
            distorted->distortion.glsl == NULL) {
            return 0;
        }
        for (uint32_t level = 0; krs != NULL && level <= krs->levels; ++level) {
            const spt_built_kernel *const kernel = &krs->kernels[level];
            if (kernel->kind == SPT_KERNEL_FIELD && kernel->glsl == NULL) return 0;
        }
    }
    return 1;
}

/* Writes a shader twice, and judges it. Returns its lines; 0 where it is rightly refused, -1 where
 * anything is wrong. */
static int check_shader(const emit_subject *subject, const emit_job *job, int possible) {
    spt_status status, again;
    char *const text = emit_shader(subject, job, &status);
    char *const twin = emit_shader(subject, job, &again);
    const char *wrong = NULL;
    if (!possible) {
        if (status != SPT_UNSUPPORTED || again != SPT_UNSUPPORTED) wrong = "not refused";
    } else if (text == NULL || twin == NULL) {
        wrong = "refused";
    } else if (strcmp(text, twin) != 0) {
        wrong = "not twice the same";
    } else if (!is_tidy(text)) {
        wrong = "not tidy";
    } else if (!has_ends(job, text)) {
        wrong = "not what a host expects";
    }
    const int lines = wrong != NULL ? -1 : text != NULL ? lines_of(text) : 0;
    if (wrong != NULL) {
        printf("%s, target %s, program %s: %s\n", subject->name, emit_targets[job->target],
               emit_programs[job->program], wrong);
    }
    free(text);
    free(twin);
    return lines;
}

/* Every target and program. Returns how many were wrong. */
static int check_shaders(const emit_subject *subject, int writable) {
    int wrong = 0, lines[SPT_GLSL_TARGETS][SPT_GLSL_PROGRAMS] = {{0}};
    for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
        for (uint32_t program = 0; program < SPT_GLSL_PROGRAMS; ++program) {
            emit_job job = emit_job_default();
            /* Points are asked of the first component only, which may have a text. */
            if (!writable && program == SPT_GLSL_POINTS) continue;
            job.target = target;
            job.program = program;
            if (program == SPT_GLSL_PICTURE) {
                job.features = SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
            }
            const int possible = writable && is_possible(target, program);
            lines[target][program] = check_shader(subject, &job, possible);
            wrong += lines[target][program] < 0;
        }
    }
    printf("%-18s", subject->name);
    if (writable) {
        printf(" lines: library %d, picture for WebGL %d, hits for Vulkan %d\n",
               lines[SPT_GLSL_LIBRARY][SPT_GLSL_HITS],
               lines[SPT_GLSL_FRAGMENT_300_ES][SPT_GLSL_PICTURE],
               lines[SPT_GLSL_VULKAN_450][SPT_GLSL_HITS]);
    } else {
        printf(" has a callback without a text, and is refused\n");
    }
    return wrong;
}

/* The whole of a file that was just written; from malloc(), or NULL. */
static char *read_back(FILE *file) {
    const long size = ftell(file);
    char *const text = size > 0 ? malloc((size_t)size + 1) : NULL;
    if (text == NULL) return NULL;
    rewind(file);
    text[fread(text, 1, (size_t)size, file)] = '\0';
    return text;
}

/* The pages: whole, every word of their templates filled, no address of a server. */
static int check_pages(const emit_subject *subject, int writable) {
    int wrong = 0;
    for (int kind = 0; kind < emit_page_kinds; ++kind) {
        emit_job job = emit_job_default();
        FILE *const file = tmpfile();
        job.features = SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
        spt_status status = SPT_UNSUPPORTED;
        if (file != NULL) status = emit_page(file, (emit_page_kind)kind, subject, &job);
        char *const page = status == SPT_OK ? read_back(file) : NULL;
        const int good = page != NULL && strncmp(page, "<!doctype html>", 15) == 0 &&
                         strstr(page, "</html>\n") != NULL && strstr(page, "{{") == NULL &&
                         strstr(page, "://") == NULL;
        if (writable ? !good : status != SPT_UNSUPPORTED) {
            printf("%s, page %d: %s\n", subject->name, kind, page == NULL ? "none" : "not sound");
            ++wrong;
        }
        free(page);
        if (file != NULL) fclose(file);
    }
    return wrong;
}

int emit_check(void) {
    int wrong = 0;
    for (size_t i = 0; emit_subject_name(i) != NULL; ++i) {
        emit_subject subject;
        if (!emit_subject_open(&subject, emit_subject_name(i))) {
            printf("%s: not built\n", emit_subject_name(i));
            ++wrong;
            continue;
        }
        const int writable = is_writable(&subject);
        wrong += check_shaders(&subject, writable) + check_pages(&subject, writable);
        emit_subject_close(&subject);
    }
    printf("%d wrong\n", wrong);
    return wrong != 0;
}
