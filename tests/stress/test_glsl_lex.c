/* SPDX-License-Identifier: MIT
 *
 * Texts of GLSL as tokens, and their outside: layout, brackets, numbers. */
#include "test_glsl_text.h"
#include "test_glsl_words.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int glsl_text_fault(glsl_text *text, uint32_t line, const char *what, const char *word,
                    size_t size) {
    if (text->fault[0] == 0) {
        const int shown = size > 60 ? 60 : (int)size;
        snprintf(text->fault, sizeof text->fault, "line %u: %s%s%.*s", (unsigned)line, what,
                 shown > 0 ? ": " : "", shown, word);
    }
    return 0;
}

void glsl_text_allow(glsl_text *text, const char *name) {
    const int most = (int)(sizeof text->allowed / sizeof *text->allowed);
    if (text->allowed_count < most) text->allowed[text->allowed_count++] = name;
}

void glsl_text_allow_text(glsl_text *text, const char *callers) {
    const int most = (int)(sizeof text->allowed_texts / sizeof *text->allowed_texts);
    if (text->allowed_text_count < most) text->allowed_texts[text->allowed_text_count++] = callers;
}

void glsl_text_allow_nothing(glsl_text *text) {
    text->allowed_count = text->allowed_text_count = 0;
}

static int begins(const char *first, size_t size, const char *start) {
    const size_t length = strlen(start);
    return size >= length && memcmp(first, start, length) == 0;
}

static int is_callers(const glsl_text *text, const char *first, size_t size) {
    for (int i = 0; i < text->allowed_count; ++i) {
        const char *const name = text->allowed[i];
        const size_t length = strlen(name);
        if (length == size && memcmp(name, first, size) == 0) return 1;
        if (name[length - 1] == '*' && size >= length && memcmp(name, first, length - 1) == 0)
            return 1;
    }
    return 0;
}

/* ---- Words of the language ------------------------------------------------------------------- */

typedef struct word {
    const char *text;
    size_t size;
    uint32_t what;
} word;

enum { word_places = 2048 };
static word words[word_places];

static uint32_t hash_of(const char *first, size_t size) {
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < size; ++i) hash = (hash ^ (unsigned char)first[i]) * 16777619u;
    return hash;
}

static word *word_place(const char *first, size_t size) {
    for (uint32_t at = hash_of(first, size);; ++at) {
        word *const place = &words[at % word_places];
        if (place->text == NULL) return place;
        if (place->size == size && memcmp(place->text, first, size) == 0) return place;
    }
}

static void add_words(const char *const *list, size_t count, uint32_t what) {
    for (size_t i = 0; i < count; ++i) {
        word *const place = word_place(list[i], strlen(list[i]));
        place->text = list[i];
        place->size = strlen(list[i]);
        place->what |= what;
    }
}

static uint32_t meaning(const glsl_text *text, const char *first, size_t size) {
    static const char *const types[] = {"float", "int",   "uint",     "bool",  "void",  "vec2",
                                        "vec3",  "vec4",  "ivec2",    "ivec3", "ivec4", "uvec2",
                                        "uvec3", "uvec4", "bvec2",    "bvec3", "bvec4", "mat2",
                                        "mat3",  "mat4",  "sampler2D"};
    if (words[hash_of("if", 2) % word_places].text == NULL) {
        add_words(types, sizeof types / sizeof *types, GLSL_IS_TYPE);
        add_words(glsl_reserved, glsl_reserved_count, GLSL_IS_RESERVED);
        add_words(glsl_keywords, glsl_keyword_count, GLSL_IS_KEYWORD);
        add_words(glsl_functions, glsl_function_count, GLSL_IS_BUILT_IN);
        add_words(glsl_variables, glsl_variable_count, GLSL_IS_BUILT_IN);
    }
    return word_place(first, size)->what | (is_callers(text, first, size) ? GLSL_IS_CALLERS : 0);
}

/* ---- Names ----------------------------------------------------------------------------------- */

static int32_t *place_of(glsl_text *text, const char *first, size_t size) {
    for (uint32_t at = hash_of(first, size);; ++at) {
        int32_t *const place = &text->table[at % (2 * glsl_most_names)];
        if (*place < 0) return place;
        const glsl_name *const name = &text->names[*place];
        if (name->size == size && memcmp(name->first, first, size) == 0) return place;
    }
}

static int32_t name_of(glsl_text *text, const char *first, size_t size, uint32_t line) {
    int32_t *const place = place_of(text, first, size);
    if (*place >= 0) return *place;
    if (text->name_count == glsl_most_names) {
        glsl_text_fault(text, line, "too many names for this reader", first, size);
        return 0;
    }
    glsl_name *const name = &text->names[text->name_count];
    memset(name, 0, sizeof *name);
    name->first = first;
    name->size = size;
    name->what = meaning(text, first, size);
    name->owner = -1;
    for (size_t i = 1; i < size; ++i) {
        if (first[i - 1] == '_' && first[i] == '_' && (name->what & GLSL_IS_BUILT_IN) == 0)
            glsl_text_fault(text, line, "two underlines in a row", first, size);
    }
    if (begins(first, size, "gl_") && (name->what & GLSL_IS_BUILT_IN) == 0)
        glsl_text_fault(text, line, "begins with gl_", first, size);
    if ((name->what & (GLSL_IS_RESERVED | GLSL_IS_KEYWORD)) == GLSL_IS_RESERVED)
        glsl_text_fault(text, line, "a reserved word", first, size);
    *place = text->name_count++;
    return *place;
}

int32_t glsl_text_find(const glsl_text *text, const char *name) {
    const size_t size = strlen(name);
    for (int32_t i = 0; i < text->name_count; ++i) {
        if (text->names[i].size == size && memcmp(text->names[i].first, name, size) == 0) return i;
    }
    return -1;
}

uint32_t glsl_text_what(const glsl_text *text, const char *name) {
    const int32_t number = glsl_text_find(text, name);
    return number >= 0 ? text->names[number].what : 0;
}

/* ---- Tokens ---------------------------------------------------------------------------------- */

static int is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static int is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* The letters, digits and point of a number, with the sign of an exponent. */
static size_t size_of_number(const char *at) {
    const int hexadecimal = at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
    size_t size = 0;
    while (is_letter(at[size]) || is_digit(at[size]) || at[size] == '.' ||
           ((at[size] == '+' || at[size] == '-') && size > 0 && !hexadecimal &&
            (at[size - 1] == 'e' || at[size - 1] == 'E')))
        ++size;
    return size;
}

/* A float by the grammar of GLSL, without suffix, that is finite and no subnormal number; or an
 * integer. */
static void look_at_number(glsl_text *text, const glsl_token *token) {
    const char *const at = token->first;
    char digits[64], *end;
    if (token->size >= sizeof digits) {
        glsl_text_fault(text, token->line, "a long number", at, token->size);
        return;
    }
    memcpy(digits, at, token->size);
    digits[token->size] = 0;
    if (strpbrk(digits, ".eE") == NULL || digits[1] == 'x' || digits[1] == 'X') {
        const unsigned long value = strtoul(digits, &end, 0);
        const int is_unsigned = *end == 'u';
        if (is_unsigned) ++end;
        if (!is_unsigned && value > 0x80000000u) /* 2^31 itself may have a minus before it */
            glsl_text_fault(text, token->line, "beyond int", at, token->size);
        if (*end != 0 || value > 0xffffffffu || (digits[0] == '0' && is_digit(digits[1])))
            glsl_text_fault(text, token->line, "no integer", at, token->size);
        return;
    }
    const float value = strtof(digits, &end);
    if (*end != 0) glsl_text_fault(text, token->line, "no number", at, token->size);
    if (!(value <= FLT_MAX)) glsl_text_fault(text, token->line, "not finite", at, token->size);
    if (!(value == 0.0f || value >= FLT_MIN)) {
        glsl_text_fault(text, token->line, "a subnormal number", at, token->size);
    }
}

static glsl_token *new_token(glsl_text *text, const char *first, size_t size, uint32_t line,
                             glsl_kind kind) {
    if (text->token_count == glsl_most_tokens - 1) {
        glsl_text_fault(text, line, "too many tokens for this reader", "", 0);
        --text->token_count;
    }
    glsl_token *const token = &text->tokens[text->token_count++];
    token->first = first;
    token->size = size;
    token->line = line;
    token->value = 0;
    token->kind = (uint8_t)kind;
    token->directive = 0;
    return token;
}

static int32_t mark_at(const char *at) {
    static const char *const pairs[] = {"++", "--", "<=", ">=", "==", "!=", "&&", "||",
                                        "+=", "-=", "*=", "/=", "<<", ">>", "^^"};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        if (at[0] == pairs[i][0] && at[1] == pairs[i][1]) return GLSL_TWO(at[0], at[1]);
    }
    return strchr("+-*/%<>=!&|^~?:;,.(){}[]#", at[0]) != NULL ? at[0] : 0;
}

/* Behind the comment that begins here, or NULL. */
static const char *behind_comment(const char *at) {
    if (at[0] != '/') return NULL;
    if (at[1] == '/') return at + strcspn(at, "\n");
    if (at[1] != '*') return NULL;
    const char *const end = strstr(at + 2, "*/");
    return end != NULL ? end + 2 : at + strlen(at);
}

static void tokenize(glsl_text *text) {
    uint32_t line = 1;
    int directive = 0, begun = 0; /* whether the line has a token */
    const char *at = text->source;
    while (*at != 0) {
        const char *const behind = behind_comment(at);
        glsl_token *token = NULL;
        if (behind != NULL) {
            for (; at < behind; ++at) line += *at == '\n';
        } else if (*at == '\n') {
            ++line;
            ++at;
            directive = begun = 0;
        } else if (*at == ' ') {
            ++at;
        } else if (is_letter(*at)) {
            size_t size = 1;
            while (is_letter(at[size]) || is_digit(at[size])) ++size;
            token = new_token(text, at, size, line, GLSL_NAME);
            token->value = name_of(text, at, size, line);
        } else if (is_digit(*at) || (*at == '.' && is_digit(at[1]))) {
            token = new_token(text, at, size_of_number(at), line, GLSL_NUMBER);
            look_at_number(text, token);
        } else {
            const int32_t mark = mark_at(at);
            if (mark == 0) glsl_text_fault(text, line, "an unknown character", at, 1);
            token = new_token(text, at, mark > 255 ? 2 : 1, line, GLSL_MARK);
            token->value = mark;
            if (mark == '#' && begun) glsl_text_fault(text, line, "# inside a line", "", 0);
            if (mark == '#') directive = 1;
        }
        if (token != NULL) {
            token->directive = (uint8_t)directive;
            begun = 1;
            at += token->size;
        }
    }
    text->lines = line - 1;
    new_token(text, at, 0, line, GLSL_END);
}

/* ---- The outside ----------------------------------------------------------------------------- */

/* Behind what a caller brought, if that begins here; else NULL. */
static const char *behind_callers_text(const glsl_text *text, const char *at) {
    for (int i = 0; i < text->allowed_text_count; ++i) {
        const size_t size = strlen(text->allowed_texts[i]);
        if (strncmp(at, text->allowed_texts[i], size) == 0) return at + size;
    }
    return NULL;
}

static void look_at_line(glsl_text *text, uint32_t number, const char *at, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        if (at[i] < ' ' || at[i] > '~')
            glsl_text_fault(text, number, "a byte that is no printable ASCII", "", 0);
    }
    if (size > glsl_columns) glsl_text_fault(text, number, "a long line", at, size);
    if (size > 0 && at[size - 1] == ' ')
        glsl_text_fault(text, number, "blanks at the end", at, size);
}

static void look_at_lines(glsl_text *text) {
    uint32_t number = 1;
    const char *at = text->source;
    for (; *at != 0; ++number) {
        const char *const callers = behind_callers_text(text, at);
        for (; callers != NULL && at < callers; ++at) number += *at == '\n';
        const size_t size = strcspn(at, "\n");
        look_at_line(text, number, at, size);
        if (at[size] == 0) {
            glsl_text_fault(text, number, "no newline at the end", at, size);
            return;
        }
        at += size + 1;
        if (size == 0 && *at == '\n') glsl_text_fault(text, number, "two empty lines", "", 0);
    }
    if (number == 1) glsl_text_fault(text, number, "an empty text", "", 0);
}

/* Statements begin at four columns a brace. Lines that go on are where they look best. */
static void look_at_indents(glsl_text *text) {
    uint32_t line = 0;
    size_t depth = 0;
    int rounds = 0, fresh = 1; /* open round brackets; whether a statement begins */
    for (int i = 0; i < text->token_count; ++i) {
        const glsl_token *const token = &text->tokens[i];
        const int32_t mark = token->kind == GLSL_MARK ? token->value : 0;
        if (mark == '}' && depth > 0) --depth;
        if (token->line != line && fresh && !token->directive && token->kind != GLSL_END) {
            const char *start = token->first;
            while (start > text->source && start[-1] != '\n') --start;
            if ((size_t)(token->first - start) != 4 * depth &&
                behind_callers_text(text, start) == NULL)
                glsl_text_fault(text, token->line, "indent", start, 60);
        }
        line = token->line;
        if (token->directive) continue;
        if (mark == '{') ++depth;
        rounds += mark == '(';
        rounds -= mark == ')';
        fresh = rounds == 0 && (mark == ';' || mark == '{' || mark == '}');
    }
}

static void look_at_brackets(glsl_text *text) {
    enum { deepest = 256 };
    char open[deepest];
    int depth = 0;
    for (int i = 0; i < text->token_count; ++i) {
        const glsl_token *const token = &text->tokens[i];
        const int32_t mark = token->kind == GLSL_MARK ? token->value : 0;
        if (mark == '(' || mark == '{' || mark == '[') {
            if (depth == deepest) {
                glsl_text_fault(text, token->line, "deep brackets", "", 0);
                return;
            }
            open[depth++] = mark == '(' ? ')' : mark == '{' ? '}' : ']';
        } else if (mark == ')' || mark == '}' || mark == ']') {
            if (depth == 0 || open[--depth] != mark) {
                glsl_text_fault(text, token->line, "a bracket that does not fit", token->first, 1);
                return;
            }
        }
    }
    if (depth > 0) glsl_text_fault(text, text->lines, "an open bracket", "", 0);
}

/* x - -1.0 and x--1.0 are two ways to go wrong: behind an operator a negative number stands in
 * brackets. */
static void look_at_signs(glsl_text *text) {
    for (int i = 1; i + 1 < text->token_count; ++i) {
        const glsl_token *const before = &text->tokens[i - 1], *const token = &text->tokens[i];
        if (token->kind != GLSL_MARK || text->tokens[i + 1].kind != GLSL_NUMBER) continue;
        if (token->value == GLSL_TWO('-', '-') || token->value == GLSL_TWO('+', '+'))
            glsl_text_fault(text, token->line, "a sign behind a sign", token->first, 8);
        if (token->value == '-' && before->kind == GLSL_MARK &&
            strchr("+-*/", before->value & 255) != NULL)
            glsl_text_fault(text, token->line, "a negative number without brackets", before->first,
                            8);
    }
}

int glsl_text_read(glsl_text *text, const char *source) {
    text->source = source;
    text->length = strlen(source);
    text->token_count = text->name_count = text->function_count = 0;
    text->fault[0] = 0;
    for (int i = 0; i < 2 * glsl_most_names; ++i) text->table[i] = -1;
    tokenize(text);
    look_at_lines(text);
    look_at_brackets(text);
    look_at_indents(text);
    look_at_signs(text);
    return text->fault[0] == 0;
}

size_t glsl_text_numbers(const glsl_text *text, float *numbers, size_t most) {
    size_t count = 0;
    for (int i = 0; i < text->token_count; ++i) {
        const glsl_token *const token = &text->tokens[i];
        char digits[64];
        if (token->kind != GLSL_NUMBER || token->size >= sizeof digits) continue;
        memcpy(digits, token->first, token->size);
        digits[token->size] = 0;
        if (strpbrk(digits, ".eE") == NULL || count == most) continue;
        const int negative = i > 0 && token[-1].kind == GLSL_MARK && token[-1].value == '-';
        const float number = strtof(digits, NULL);
        numbers[count++] = negative ? -number : number;
    }
    return count;
}
