/* SPDX-License-Identifier: MIT
 *
 * The writer: bytes, texts with conditions and parameters, and who is named by them. */
#include <stdarg.h>

#include "../base/arguments.h"
#include "parameters.h"
#include "pieces.h"

/* ---- Bytes ---------------------------------------------------------------------------------- */

static int belongs_to_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The word that ends here may be the name of a piece or a uniform. */
static void end_word(spti_glsl *out) {
    if (out->word_length == 0) return;
    if (out->word_length < SPTI_GLSL_WORD) {
        out->word[out->word_length] = '\0';
        spti_glsl_reach(out, out->word);
        spti_glsl_use_name(out, out->word, out->own_word);
    }
    out->word_length = 0;
}

enum { CODE, SLASH, LINE_COMMENT, BLOCK_COMMENT, BLOCK_STAR };

/* While scanning: finds the words outside of comments. */
static void scan(spti_glsl *out, char c) {
    switch (out->comment) {
    case LINE_COMMENT:
        out->comment = c == '\n' ? CODE : LINE_COMMENT;
        return;
    case BLOCK_COMMENT:
        out->comment = c == '*' ? BLOCK_STAR : BLOCK_COMMENT;
        return;
    case BLOCK_STAR:
        out->comment = c == '/' ? CODE : c == '*' ? BLOCK_STAR : BLOCK_COMMENT;
        return;
    case SLASH:
        out->comment = c == '/' ? LINE_COMMENT : c == '*' ? BLOCK_COMMENT : CODE;
        if (out->comment != CODE) return;
        break;
    default:
        break;
    }
    if (belongs_to_word(c)) {
        if (out->word_length == 0) out->own_word = !out->callers && !out->naming;
        if (out->word_length < SPTI_GLSL_WORD) out->word[out->word_length++] = c;
        return;
    }
    end_word(out);
    if (c == '/') out->comment = SLASH;
}

static void put(spti_glsl *out, char c) {
    if (out->scanning) {
        scan(out, c);
        return;
    }
    if (out->length + 1 < out->capacity) out->buffer[out->length] = c;
    out->length += 1;
    out->line += c == '\n';
}

void spti_glsl_put_bytes(spti_glsl *out, const char *text, size_t length) {
    for (size_t i = 0; i < length; ++i) put(out, text[i]);
}

void spti_glsl_put(spti_glsl *out, const char *text) {
    spti_glsl_put_bytes(out, text, strlen(text));
}

/* ---- Texts ---------------------------------------------------------------------------------- */

static const char *const condition_names[] = {
#define X(name) #name,
    SPTI_GLSL_CONDITIONS(X)
#undef X
};

static int word_is(const char *word, size_t length, const char *name) {
    return strlen(name) == length && memcmp(word, name, length) == 0;
}

/* Reads the conditions at the start of a line; *text becomes what is behind them. Returns whether
 * all hold. */
static int conditions_hold(const spti_glsl *out, const char **text) {
    int hold = 1;
    for (; **text == '['; ++*text) {
        const int wanted = (*text)[1] != '!';
        const char *const word = *text + (wanted ? 1 : 2);
        const size_t length = strcspn(word, "]");
        int found = 0;
        for (int i = 0; i < SPTI_GLSL_CONDITION_COUNT; ++i) {
            if (!word_is(word, length, condition_names[i])) continue;
            found = 1;
            hold = hold && (int)(out->conditions >> i & 1) == wanted;
        }
        hold = hold && found;
        *text = word + length;
    }
    return hold;
}

static size_t word_length(const char *text) {
    size_t length = 0;
    for (; belongs_to_word(text[length]); ++length) continue;
    return length;
}

static void expand_line(spti_glsl *out, const char *line, size_t length,
                        const char *const *arguments);

/* Expands a text of whole lines, each indented by so much more. */
static void expand_lines(spti_glsl *out, const char *text, size_t indent,
                         const char *const *arguments) {
    for (const char *line = text; *line != '\0';) {
        const char *code = line;
        const int hold = conditions_hold(out, &code);
        const size_t length = strcspn(code, "\n");
        if (hold) {
            const size_t blanks = strspn(code, " ");
            const int alone = blanks + 2 == length && code[blanks] == '$' &&
                              code[blanks + 1] >= '0' && code[blanks + 1] <= '9';
            if (alone && arguments != NULL) {
                expand_lines(out, arguments[code[blanks + 1] - '0'], indent + blanks, NULL);
            } else {
                for (size_t i = 0; i < indent && length > 0; ++i) put(out, ' ');
                expand_line(out, code, length, arguments);
                if (code[length] == '\n') put(out, '\n');
            }
        }
        line = code + length + (code[length] == '\n');
    }
}

/* What stands for $ and the word behind it. */
static void expand_word(spti_glsl *out, const char *word, size_t length,
                        const char *const *arguments) {
    if (length == 1 && word[0] >= '0' && word[0] <= '9' && arguments != NULL) {
        const char *const argument = arguments[word[0] - '0'];
        expand_line(out, argument, strlen(argument), NULL);
    } else {
        spti_glsl_parameter(out, word, length);
    }
}

static void expand_line(spti_glsl *out, const char *line, size_t length,
                        const char *const *arguments) {
    for (size_t i = 0; i < length; ++i) {
        if (line[i] != '$') {
            put(out, line[i]);
            continue;
        }
        /* $C and $P stand before the word that follows. */
        const size_t whole = word_length(line + i + 1);
        const int letter = line[i + 1] == 'C' || line[i + 1] == 'P';
        const size_t word = letter ? 1 : whole;
        expand_word(out, line + i + 1, word, arguments);
        i += word;
        /* The blank behind it goes where $precise is nothing. */
        if (word_is(line + i + 1 - word, word, "precise") && spti_glsl_precise(out)[0] == '\0') ++i;
    }
}

void spti_glsl_expand(spti_glsl *out, const char *text, const char *const *arguments) {
    expand_lines(out, text, 0, arguments);
}

void spti_glsl_format(spti_glsl *out, const char *format, ...) {
    char number[24];
    va_list arguments;
    va_start(arguments, format);
    for (; *format != '\0'; ++format) {
        if (*format != '%') {
            put(out, *format);
            continue;
        }
        ++format;
        if (*format == 'f' || *format == 'F') {
            spti_glsl_number((float)va_arg(arguments, double), *format == 'f', number);
            spti_glsl_put(out, number);
        } else if (*format == 'd') {
            spti_glsl_integer(out, va_arg(arguments, int));
        } else if (*format == 's') {
            spti_glsl_put(out, va_arg(arguments, const char *));
        } else if (*format == 'v') {
            const float *const vector = va_arg(arguments, const float *);
            for (int axis = 0; axis < 3; ++axis) {
                spti_glsl_put(out, axis == 0 ? "vec3(" : ", ");
                spti_glsl_number(vector[axis], 0, number);
                spti_glsl_put(out, number);
            }
            put(out, ')');
        } else {
            put(out, '%');
        }
    }
    va_end(arguments);
}

void spti_glsl_integer(spti_glsl *out, int number) {
    char digits[16];
    int count = 0;
    unsigned rest = number < 0 ? 0u - (unsigned)number : (unsigned)number;
    for (int i = 0; i < 10 && (i == 0 || rest != 0); ++i, rest /= 10) {
        digits[count++] = (char)('0' + rest % 10);
    }
    if (number < 0) put(out, '-');
    for (int i = count; i-- > 0;) put(out, digits[i]);
}
