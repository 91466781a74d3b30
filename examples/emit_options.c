/* SPDX-License-Identifier: MIT
 *
 * Words of the command line into numbers. */
#include "emit_options.h"

#include "image.h"
#include "step_rules.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: emit [OPTIONS] SCENE      a shader\n"
    "       emit --page FILE SCENE    a page for browsers that shows the scene\n"
    "       emit --hybrid FILE SCENE  one that draws triangles among it\n"
    "       emit --three FILE SCENE   one that puts it into a scene of three.js\n"
    "       emit --list               scenes, and words for the options\n"
    "       emit                      checks that all is well\n"
    "\n"
    "  --output FILE      (default: standard output)\n"
    "  --target WORD      (default: 300es)\n"
    "  --program WORD     (default: picture)\n"
    "  --method WORD      step rule (default: adaptive)\n"
    "  --features WORDS   separated by commas (default: none; of pages: normal,shadow,occlusion)\n"
    "  --uniforms WORDS   parameters that become uniforms; all: as many as can be (default: none)\n"
    "  --size WxH         of the picture, for its pixels' size and its shape (default: 960x640)\n"
    "  --budget N         evaluations a ray (default: 128)\n"
    "  --epsilon X        tolerance, world length (default: 0.0001)\n"
    "\n"
    "Exit status: 0; 1 where the library refuses; 2 for a bad command line, or a file that cannot\n"
    "be written.\n";

static void refuse(const char *what, const char *value) {
    fprintf(stderr, "emit: %s '%s'; see emit --help and emit --list\n", what, value);
    exit(2);
}

static uint32_t number_of(const char *const *words, const char *value, const char *what) {
    const int number = emit_word(words, value);
    if (number < 0) refuse(what, value);
    return (uint32_t)number;
}

/* Bits of a list of words. */
static uint32_t bits_of(const char *const *words, const char *value, const char *what) {
    uint32_t bits = 0;
    char word[32];
    for (const char *at = value;; ++at) {
        const size_t length = strcspn(at, ",");
        if (length >= sizeof word) refuse(what, value);
        memcpy(word, at, length);
        word[length] = '\0';
        bits |= 1u << number_of(words, word, what);
        at += length;
        if (*at == '\0') return bits;
    }
}

static uint32_t whole_of(const char *value, long most) {
    char *end = NULL;
    const long number = strtol(value, &end, 10);
    if (end == value || *end != '\0' || number < 1 || number > most) {
        refuse("no number that can be used here:", value);
    }
    return (uint32_t)number;
}

static float positive_of(const char *value) {
    char *end = NULL;
    const float number = strtof(value, &end);
    if (end == value || *end != '\0' || !(number > 0.0f) || !(number < INFINITY)) {
        refuse("no number above 0:", value);
    }
    return number;
}

static void take_size(emit_job *job, const char *value) {
    int end = 0, width, height;
    if (sscanf(value, "%5dx%5d%n", &width, &height, &end) != 2 || value[end] != '\0' || width < 1 ||
        height < 1) {
        refuse("no size of a picture:", value);
    }
    job->width = (uint32_t)width;
    job->height = (uint32_t)height;
}

/* Whether an option is known; it has a value. */
static int take(emit_options *chosen, const char *name, const char *value) {
    emit_job *const job = &chosen->job;
    if (strcmp(name, "--output") == 0) {
        chosen->output = value;
    } else if (strcmp(name, "--page") == 0) {
        chosen->page = value;
    } else if (strcmp(name, "--three") == 0) {
        chosen->three = value;
    } else if (strcmp(name, "--hybrid") == 0) {
        chosen->hybrid = value;
    } else if (strcmp(name, "--target") == 0) {
        job->target = number_of(emit_targets, value, "no target");
    } else if (strcmp(name, "--program") == 0) {
        job->program = number_of(emit_programs, value, "no program");
    } else if (strcmp(name, "--method") == 0) {
        job->settings.method = step_rule_named(value);
        if (job->settings.method == NULL) refuse("no step rule", value);
    } else if (strcmp(name, "--features") == 0) {
        job->features = bits_of(emit_features, value, "no feature in");
        chosen->features_given = 1;
    } else if (strcmp(name, "--uniforms") == 0) {
        const int all = strcmp(value, "all") == 0;
        job->uniforms =
            all ? EMIT_ALL_PARAMETERS : bits_of(emit_parameters, value, "no parameter in");
    } else if (strcmp(name, "--size") == 0) {
        take_size(job, value);
    } else if (strcmp(name, "--budget") == 0) {
        job->settings.budget = whole_of(value, 1000000);
    } else if (strcmp(name, "--epsilon") == 0) {
        job->settings.epsilon = positive_of(value);
    } else {
        return 0;
    }
    return 1;
}

emit_options emit_options_of(int count, char **arguments) {
    emit_options chosen;
    memset(&chosen, 0, sizeof chosen);
    chosen.job = emit_job_default();
    for (int i = 1; i < count; ++i) {
        const char *const argument = arguments[i];
        if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) {
            fputs(usage, stdout);
            exit(0);
        }
        if (strcmp(argument, "--list") == 0) {
            chosen.list = 1;
        } else if (argument[0] != '-') {
            if (chosen.subject != NULL) refuse("one scene at a time, not this too:", argument);
            chosen.subject = argument;
        } else if (i + 1 == count) {
            refuse("no use for, without a value,", argument);
        } else if (!take(&chosen, argument, arguments[++i])) {
            refuse("no option", argument);
        }
    }
    return chosen;
}
