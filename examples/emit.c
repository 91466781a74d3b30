/* SPDX-License-Identifier: MIT
 *
 * The idea introduced here: the same scene for GPUs. Writes GLSL for any target, or a page that
 * runs it in a browser. Without arguments it only checks that every scene can be written for
 * all. */
#include "emit_check.h"
#include "emit_options.h"
#include "emit_page.h"
#include "step_rules.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void list_words(const char *title, const char *const *words) {
    printf("%s:\n ", title);
    for (int i = 0; words[i] != NULL; ++i) printf(" %s", words[i]);
    putchar('\n');
}

static int list(void) {
    puts("Scenes:");
    for (size_t i = 0; emit_subject_name(i) != NULL; ++i) {
        printf("  %-18s %s\n", emit_subject_name(i), emit_subject_description(i));
    }
    list_words("Targets", emit_targets);
    list_words("Programs", emit_programs);
    fputs("Step rules:\n ", stdout);
    for (size_t i = 0; step_rule(i) != NULL; ++i) printf(" %s", spt_method_name(step_rule(i)));
    putchar('\n');
    list_words("Features", emit_features);
    list_words("Parameters", emit_parameters);
    return 0;
}

static int refused(const char *name, spt_status status) {
    fprintf(stderr, "emit: %s: %s\n", name,
            status == SPT_OK            ? "no memory"
            : status == SPT_UNSUPPORTED ? "this cannot be written"
                                        : "these options do not go together");
    return 1;
}

/* Writes a page or, for emit_page_kinds, a shader. Returns the program's exit status. */
static int write_to(const char *path, emit_page_kind kind, const emit_subject *subject,
                    const emit_job *job) {
    spt_status status = SPT_OK;
    char *text = NULL;
    if (kind == emit_page_kinds) {
        text = emit_shader(subject, job, &status);
        if (text == NULL) return refused(subject->name, status);
    }
    FILE *const file = path != NULL ? fopen(path, "wb") : stdout;
    int written = file != NULL;
    if (written && text != NULL) {
        written = fputs(text, file) != EOF;
    } else if (written) {
        status = emit_page(file, kind, subject, job);
    }
    if (file != NULL) {
        written = written && !ferror(file) && fflush(file) == 0;
        if (path != NULL && fclose(file) != 0) written = 0;
    }
    free(text);
    if (!written) {
        fprintf(stderr, "emit: cannot write '%s': %s\n", path != NULL ? path : "standard output",
                strerror(errno));
        return 2;
    }
    if (status == SPT_OK) return 0;
    if (path != NULL) remove(path);
    return refused(subject->name, status);
}

int main(int count, char **arguments) {
    if (count == 1) return emit_check();
    const emit_options options = emit_options_of(count, arguments);
    emit_subject subject;
    if (options.list) return list();
    if (options.subject == NULL || !emit_subject_open(&subject, options.subject)) {
        fprintf(stderr, "emit: %s%s; see emit --list\n",
                options.subject != NULL ? "there is no scene " : "which scene?",
                options.subject != NULL ? options.subject : "");
        return 2;
    }
    emit_job job = options.job;
    const char *const paths[] = {options.page, options.hybrid, options.three, options.output};
    emit_page_kind kind = EMIT_VIEWER;
    while (kind < emit_page_kinds && paths[kind] == NULL) kind = (emit_page_kind)(kind + 1);
    if (kind < emit_page_kinds && !options.features_given) {
        job.features = SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
    }
    const int result = write_to(paths[kind], kind, &subject, &job);
    emit_subject_close(&subject);
    return result;
}
