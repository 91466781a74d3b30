/* SPDX-License-Identifier: MIT
 *
 * A reader of GLSL, as far as an emitted text must be read to say what is wrong with it: tokens,
 * functions and who calls them, what is declared and what is named. Types are not looked at, which
 * compilers do (tests/glsl). */
#ifndef TESTS_GLSL_TEXT_H
#define TESTS_GLSL_TEXT_H

#include <stddef.h>
#include <stdint.h>

enum {
    glsl_most_tokens = 1 << 17,
    glsl_most_names = 1 << 13,
    glsl_most_functions = 1 << 11,
    glsl_columns = 100 /* of a line */
};

typedef enum glsl_kind { GLSL_NAME, GLSL_NUMBER, GLSL_MARK, GLSL_END } glsl_kind;

/* A mark of two characters, such as ++. */
#define GLSL_TWO(a, b) ((a) | (b) << 8)

typedef struct glsl_token {
    const char *first;
    size_t size;
    uint32_t line;
    int32_t value;     /* of a name: its number; of a mark: its characters */
    uint8_t kind;      /* glsl_kind */
    uint8_t directive; /* on a line that begins with # */
} glsl_token;

/* What a name is; several may hold. */
enum {
    GLSL_IS_KEYWORD = 1u << 0,
    GLSL_IS_RESERVED = 1u << 1,
    GLSL_IS_TYPE = 1u << 2, /* of the language, or a structure of the text */
    GLSL_IS_BUILT_IN = 1u << 3,
    GLSL_IS_CALLERS = 1u << 4,  /* said to be so by glsl_text_allow() */
    GLSL_IS_FUNCTION = 1u << 5, /* this and what follows: declared in the text */
    GLSL_IS_STRUCTURE = 1u << 6,
    GLSL_IS_MACRO = 1u << 7,
    GLSL_IS_GUARD = 1u << 8, /* a macro that only says that something is there */
    GLSL_IS_GLOBAL = 1u << 9,
    GLSL_IS_UNIFORM = 1u << 10,
    GLSL_IS_MEMBER = 1u << 11,
    GLSL_IS_LOCAL = 1u << 12, /* a variable or parameter of some function */
    GLSL_IS_PARAMETER = 1u << 13
};

typedef struct glsl_name {
    const char *first;
    size_t size;
    uint32_t what;
    uint32_t uses;     /* in code and macros, declarations left out */
    int32_t owner;     /* the last function that has it as a local name, */
    uint32_t declared; /* on which line, */
    int32_t idle;      /* and whether it has not been used there */
    int32_t from, to;  /* of a macro: its tokens, from and behind */
    int32_t color;     /* while looking for circles */
} glsl_name;

typedef struct glsl_function {
    int32_t name;
    int32_t begin;    /* its first token: a type, or a qualifier of one */
    int32_t from, to; /* the body, from { and behind } */
    int32_t naming;   /* how many other functions name it */
} glsl_function;

typedef struct glsl_text {
    const char *source;
    size_t length;
    uint32_t lines;
    int32_t token_count, name_count, function_count;
    glsl_token tokens[glsl_most_tokens];
    glsl_name names[glsl_most_names];
    glsl_function functions[glsl_most_functions];
    int32_t table[2 * glsl_most_names];
    const char *allowed[64];
    const char *allowed_texts[8];
    int allowed_count, allowed_text_count;
    char fault[200]; /* the first; empty: none */
} glsl_text;

/* What a text may name though it does not begin with spt (* at the end: all that begin so): call
 * before reading it. The lists are kept until they are cleared. */
void glsl_text_allow(glsl_text *text, const char *name);
/* A text that a caller brought, whose lines may be laid out as it likes. */
void glsl_text_allow_text(glsl_text *text, const char *callers);
void glsl_text_allow_nothing(glsl_text *text);

/* Splits into tokens, and looks at the outside: printable ASCII, statements indented by fours, no
 * blanks at the ends of lines, lines of at most 100 columns, balanced brackets, a newline at the end; numbers
 * that are finite, have a point or an exponent or are integers, and are no subnormal ones. Returns
 * whether there was no fault. */
int glsl_text_read(glsl_text *text, const char *source);

/* Finds functions, structures, macros and all declarations, and looks at names: each must be
 * declared before it is used, what is global must begin with spt, Spt or SPT, no local one may hide
 * what is global, and none may be idle. After glsl_text_read(). */
int glsl_text_parse(glsl_text *text);

/* Looks at what a text holds: `roots` and what they reach must be all the functions there are but
 * for the caller's; calls must not be circular; every structure, macro, constant and uniform must
 * be used; loops must have a bound that is no constant. After glsl_text_parse(). */
int glsl_text_audit(glsl_text *text, const char *const *roots, int root_count);

/* Of a library: no version, main, uniform or global; every function stands inside #ifndef, and so
 * does every setting. After glsl_text_parse(). */
int glsl_text_audit_library(glsl_text *text);

/* All three, or four; whether there was no fault. */
int glsl_text_check(glsl_text *text, const char *source, int is_library, const char *const *roots,
                    int root_count);

/* The number of a name, or -1; and what it is, 0 where it does not occur. */
int32_t glsl_text_find(const glsl_text *text, const char *name);
uint32_t glsl_text_what(const glsl_text *text, const char *name);

/* All numbers with a point or exponent, with the minus that stands before them, in the order of the
 * text; returns how many, at most `most`. */
size_t glsl_text_numbers(const glsl_text *text, float *numbers, size_t most);

/* Writes the fault, if it is the first, and returns 0. */
int glsl_text_fault(glsl_text *text, uint32_t line, const char *what, const char *word,
                    size_t size);

#endif
