/* SPDX-License-Identifier: MIT
 *
 * One harness for libFuzzer and for the unit run: spt_glsl_emit() and spt_glsl_check_field() on
 * options, fields, names, texts and buffers made of bytes, and what glsl.h says of what is written,
 * whatever they are.
 *     clang -std=c99 -g -O1 -DFUZZ_GLSL_ALONE -fsanitize=fuzzer,address,undefined -Iinclude -Itests \
 *         tests/fuzz/fuzz_glsl*.c build/libspheretrace.a -lm */
#include "fuzz_glsl.h"

#include "stress/test_glsl_words.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef FUZZ_GLSL_ALONE /* without fuzz_trace.c, which has these for the unit run */
fuzz_failed_fn *fuzz_failed;

void fuzz_fail(const char *condition, const char *file, int line) {
    if (fuzz_failed == NULL) {
        fprintf(stderr, "%s:%d: %s\n", file, line, condition);
        abort();
    }
    fuzz_failed(condition, file, line);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_glsl_input(data, size);
}
#endif

enum { fill = 0xa5 };
static fuzz_glsl_case what;

/* ---- What must be refused -------------------------------------------------------------------- */

static int is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c) {
    return c >= '0' && c <= '9';
}

static int is_word_of(const char *const *list, size_t count, const char *name) {
    for (size_t i = 0; i < count; ++i) {
        if (strcmp(list[i], name) == 0) return 1;
    }
    return 0;
}

static int name_is_right(const char *name, uint32_t parameter) {
    static const char *const starts[] = {"gl_", "spt_", "Spt", "SPT_"};
    if (strcmp(name, spt_glsl_default_name(parameter)) == 0) return 1;
    if (!is_letter(name[0]) || strlen(name) > 64 || strstr(name, "__") != NULL) return 0;
    for (const char *at = name; *at != 0; ++at) {
        if (!is_letter(*at) && !is_digit(*at)) return 0;
    }
    for (int i = 0; i < 4; ++i) {
        if (strncmp(name, starts[i], strlen(starts[i])) == 0) return 0;
    }
    return !is_word_of(glsl_reserved, glsl_reserved_count, name) &&
           !is_word_of(glsl_functions, glsl_function_count, name);
}

static int names_are_right(void) {
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        if (what.names[i] == NULL) continue;
        if (!name_is_right(what.names[i], i)) return 0;
        for (uint32_t k = 0; k < SPT_GLSL_NAMES; ++k) {
            const char *const other =
                what.names[k] != NULL ? what.names[k] : spt_glsl_default_name(k);
            if (k != i && strcmp(what.names[i], other) == 0) return 0;
        }
    }
    return 1;
}

/* Brackets that fit, outside of comments, which must end. */
static int is_balanced(const char *text) {
    char open[4096];
    size_t depth = 0;
    for (const char *at = text; *at != 0; ++at) {
        if (at[0] == '/' && at[1] == '/') {
            at += strcspn(at, "\n");
            if (*at == 0) break;
        } else if (at[0] == '/' && at[1] == '*') {
            at = strstr(at + 2, "*/");
            if (at == NULL) return 0;
            ++at;
        } else if (*at == '(' || *at == '{' || *at == '[') {
            if (depth == sizeof open) return 0;
            open[depth++] = (char)(*at == '(' ? ')' : *at + 2);
        } else if (*at == ')' || *at == '}' || *at == ']') {
            if (depth == 0 || open[--depth] != *at) return 0;
        }
    }
    return depth == 0;
}

static int text_is_right(const char *text) {
    for (const char *at = text; *at != 0; ++at) {
        if (*at != '\n' && *at != '\t' && (*at < ' ' || *at > '~')) return 0;
        if (*at == '#' || *at == '\\' || *at == '"' || *at == '\'') return 0;
    }
    return text[0] != 0 && is_balanced(text);
}

static int texts_are_right(void) {
    const size_t count = what.options.scene != NULL ? what.scene.count : 1;
    const size_t from = what.options.scene != NULL ? 1 : 0; /* the first may be one made of it */
    for (size_t i = from; what.options.scene != NULL && i < count; ++i) {
        const spt_field *const field = &what.fields[i];
        if (field->glsl == NULL || !text_is_right(field->glsl)) return 0;
        if (field->glsl_prelude != NULL && !text_is_right(field->glsl_prelude)) return 0;
    }
    return 1;
}

static int is_finite(float number) {
    return fabsf(number) <= FLT_MAX;
}

static int numbers_are_right(void) {
    const spt_settings *const s = &what.settings;
    const spt_glsl_options *const o = &what.options;
    return s->epsilon > 0 && is_finite(s->epsilon) && s->pixel_radius >= 0 &&
           is_finite(s->pixel_radius) && s->size >= 0 && is_finite(s->size) && s->relaxation >= 1 &&
           s->relaxation < 2 && s->extrapolation >= 0 && s->extrapolation <= 1 &&
           s->slope_blend > 0 && s->slope_blend <= 1 && s->step_cap >= 1 && s->step_cap <= 100 &&
           o->target < SPT_GLSL_TARGETS && o->features < 1u << 18;
}

/* ---- What is written ------------------------------------------------------------------------- */

/* Printable, balanced, and no number in words. */
static void check_text(const char *text, size_t length) {
    static const char *const words[] = {"nan", "NaN", "inf", "Inf", "INFINITY", "infinity"};
    FUZZ_CHECK(strlen(text) == length && length > 0 && text[length - 1] == '\n');
    FUZZ_CHECK(is_balanced(text));
    for (const char *at = text; *at != 0; ++at) {
        FUZZ_CHECK(*at == '\n' || *at == '\t' || (*at >= ' ' && *at <= '~'));
        if (at[0] == '/' && at[1] == '/') at += strcspn(at, "\n") - 1;
        if (!is_letter(*at) || (at > text && (is_letter(at[-1]) || is_digit(at[-1])))) continue;
        size_t size = 1;
        while (is_letter(at[size]) || is_digit(at[size])) ++size;
        for (int i = 0; i < 6; ++i) {
            FUZZ_CHECK(strlen(words[i]) != size || memcmp(words[i], at, size) != 0);
        }
    }
}

/* As much of the text as fits, and nothing behind: the memory is as large as it is said to be. */
static void check_capacity(const char *whole, size_t length, size_t capacity) {
    size_t told = 0;
    char *const buffer = malloc(capacity + 1);
    FUZZ_CHECK(buffer != NULL);
    if (buffer == NULL) return;
    memset(buffer, fill, capacity + 1);
    const spt_status status = spt_glsl_emit(&what.options, buffer, capacity, &told);
    const size_t written = capacity > length ? length : capacity > 0 ? capacity - 1 : 0;
    FUZZ_CHECK(status == (capacity > length ? SPT_OK : SPT_BUFFER_TOO_SMALL));
    FUZZ_CHECK(told == length);
    FUZZ_CHECK(memcmp(buffer, whole, written) == 0);
    FUZZ_CHECK(capacity == 0 || buffer[written] == 0);
    FUZZ_CHECK((unsigned char)buffer[capacity] == fill);
    free(buffer);
}

/* Values of the callback at points that are not wild. */
static void check_points(void) {
    enum { samples = 9 };
    float points[4 * samples + 1];
    memset(points, fill, sizeof points);
    const spt_status status = spt_glsl_check_field(&what.made, samples, what.seed, points);
    unsigned char bytes[sizeof points];
    memcpy(bytes, points, sizeof points);
    FUZZ_CHECK(bytes[sizeof points - 1] == fill);
    if (status != SPT_OK) {
        FUZZ_CHECK(status == SPT_BAD_ARGUMENT && what.hostile);
        FUZZ_CHECK(bytes[0] == fill);
        return;
    }
    for (int i = 0; i < samples; ++i) {
        const float *const at = &points[4 * i];
        FUZZ_CHECK(is_finite(at[0]) && is_finite(at[1]) && is_finite(at[2]));
        if (what.made.point == NULL) continue;
        const float value = what.made.point(what.made.user, at[0], at[1], at[2]);
        FUZZ_CHECK(memcmp(&value, &at[3], sizeof value) == 0 || value != value);
    }
}

int fuzz_glsl_input(const uint8_t *data, size_t size) {
    size_t length = 77, again = 77;
    fuzz_glsl_read(&what, data, size);
    check_points();
    const spt_status status = spt_glsl_emit(&what.options, NULL, 0, &length);
    if (status != SPT_BUFFER_TOO_SMALL) {
        char byte = (char)fill;
        FUZZ_CHECK(status == SPT_BAD_ARGUMENT || status == SPT_UNSUPPORTED);
        FUZZ_CHECK(length == 77);
        FUZZ_CHECK(spt_glsl_emit(&what.options, &byte, 1, &length) == status);
        FUZZ_CHECK(length == 77 && byte == (char)fill);
        return 0;
    }
    FUZZ_CHECK(names_are_right() && texts_are_right() && numbers_are_right());
    char *const whole = malloc(length + 2);
    FUZZ_CHECK(whole != NULL);
    if (whole == NULL) return 0;
    memset(whole, fill, length + 2);
    FUZZ_CHECK(spt_glsl_emit(&what.options, whole, length + 1, &again) == SPT_OK);
    FUZZ_CHECK(again == length && (unsigned char)whole[length + 1] == fill);
    check_text(whole, length);
    check_capacity(whole, length, (size_t)((uint64_t)length * what.capacity >> 16));
    check_capacity(whole, length, length + what.seed % 3);
    free(whole);
    return 0;
}
