/* SPDX-License-Identifier: MIT
 *
 * Whether a text holds only what it needs, and nothing that a compiler of shaders should not meet:
 * functions that no one calls, circles of calls, loops without a bound. */
#include "test_glsl_text.h"

#include <string.h>

static int complain(glsl_text *text, uint32_t line, const char *what, const glsl_name *name) {
    return glsl_text_fault(text, line, what, name->first, name->size);
}

/* ---- Calls ----------------------------------------------------------------------------------- */

enum { white, grey, black };

static int visit(glsl_text *text, int32_t number, int32_t from_function);

/* What the tokens name: functions, and what macros among them stand for. Of overloaded functions
 * all are meant, which is more than is called. */
static int visit_tokens(glsl_text *text, int32_t from, int32_t to, int32_t function) {
    for (int32_t i = from; i < to; ++i) {
        const glsl_token *const token = &text->tokens[i];
        if (token->kind != GLSL_NAME) continue;
        if ((text->names[token->value].what & (GLSL_IS_FUNCTION | GLSL_IS_MACRO)) == 0) continue;
        if (!visit(text, token->value, function)) return 0;
    }
    return 1;
}

/* Depth first; the depth is that of calls, which is small or the text is wrong. */
static int visit(glsl_text *text, int32_t number, int32_t from_function) {
    glsl_name *const name = &text->names[number];
    if (name->color == grey && (name->what & GLSL_IS_FUNCTION) != 0)
        return complain(text, text->tokens[text->functions[from_function].begin].line,
                        "a circle of calls through", name);
    if ((name->what & (GLSL_IS_MACRO | GLSL_IS_GUARD)) == GLSL_IS_MACRO) {
        if (name->color == grey) return 1; /* a macro is not replaced inside itself */
        name->color = grey;
        const int fine = visit_tokens(text, name->from, name->to, from_function);
        name->color = white;
        return fine;
    }
    if (name->color == black) return 1;
    name->color = grey;
    for (int32_t i = 0; i < text->function_count; ++i) {
        const glsl_function *const function = &text->functions[i];
        if (function->name != number) continue;
        if (!visit_tokens(text, function->from, function->to, i)) return 0;
    }
    name->color = black;
    return 1;
}

static void look_at_calls(glsl_text *text, const char *const *roots, int root_count) {
    for (int32_t i = 0; i < text->name_count; ++i) text->names[i].color = white;
    for (int i = 0; i < root_count; ++i) {
        const int32_t root = glsl_text_find(text, roots[i]);
        if (root < 0 || (text->names[root].what & GLSL_IS_FUNCTION) == 0) {
            glsl_text_fault(text, 1, "no function", roots[i], strlen(roots[i]));
        } else if (!visit(text, root, 0)) {
            return;
        }
    }
    for (int32_t i = 0; i < text->function_count; ++i) {
        const glsl_name *const name = &text->names[text->functions[i].name];
        if (name->color == white && (name->what & GLSL_IS_CALLERS) == 0)
            complain(text, text->tokens[text->functions[i].begin].line,
                     "a function that no one calls", name);
    }
}

/* ---- Loops ----------------------------------------------------------------------------------- */

static int is_mark(const glsl_text *text, int32_t i, int32_t mark) {
    return text->tokens[i].kind == GLSL_MARK && text->tokens[i].value == mark;
}

static int is_word(const glsl_text *text, int32_t i, const char *word) {
    const glsl_token *const token = &text->tokens[i];
    return token->kind == GLSL_NAME && token->size == strlen(word) &&
           memcmp(token->first, word, token->size) == 0;
}

/* The token of the innermost #ifndef around token i, or -1; of all around it only one of the name
 * `own` counts where that is not negative. */
static int32_t guard_of(const glsl_text *text, int32_t i, int32_t own) {
    enum { deepest = 32 };
    int32_t open[deepest], found = -1;
    int depth = 0;
    for (int32_t at = 0; at < i; ++at) {
        if (!is_mark(text, at, '#')) continue;
        if (is_word(text, at + 1, "endif") && depth > 0) --depth;
        if (depth == deepest) return -1;
        if (is_word(text, at + 1, "ifndef")) open[depth++] = at;
        if (is_word(text, at + 1, "ifdef") || is_word(text, at + 1, "if")) open[depth++] = -1;
    }
    for (int k = 0; k < depth; ++k) {
        if (open[k] >= 0 && (own < 0 || text->tokens[open[k] + 2].value == own)) found = open[k];
    }
    return found;
}

/* Whether a variable of this function begins with a number and nothing else, and is never set. */
static int is_constant(const glsl_text *text, const glsl_function *function, int32_t name) {
    int numbers = 0, others = 0;
    for (int32_t i = function->from; i + 3 < function->to; ++i) {
        if (text->tokens[i].kind != GLSL_NAME || text->tokens[i].value != name) continue;
        if (!is_mark(text, i + 1, '=')) continue;
        if (text->tokens[i + 2].kind == GLSL_NUMBER && is_mark(text, i + 3, ';')) {
            ++numbers;
        } else {
            ++others;
        }
    }
    return numbers > 0 && others == 0;
}

/* Something that a compiler does not know: a parameter, a uniform, what was computed, or a setting
 * that the host of a library may replace. */
static int is_variable(const glsl_text *text, const glsl_function *function, int32_t name) {
    const glsl_name *const what = &text->names[name];
    if ((what->what & GLSL_IS_MACRO) != 0) {
        if (guard_of(text, what->from - 3, name) >= 0) return 1;
        for (int32_t i = what->from; i < what->to; ++i) {
            if (text->tokens[i].kind == GLSL_NAME && text->tokens[i].value != name &&
                is_variable(text, function, text->tokens[i].value))
                return 1;
        }
        return 0;
    }
    if ((what->what & (GLSL_IS_UNIFORM | GLSL_IS_PARAMETER | GLSL_IS_CALLERS)) != 0) return 1;
    return (what->what & GLSL_IS_LOCAL) != 0 && !is_constant(text, function, name);
}

static int is_comparison(const glsl_text *text, int32_t i) {
    return is_mark(text, i, '<') || is_mark(text, i, '>') || is_mark(text, i, GLSL_TWO('<', '=')) ||
           is_mark(text, i, GLSL_TWO('>', '='));
}

/* for (int i = start; i < bound && ...; ++i): what the counter is compared with, or where it begins,
 * must not be known to a compiler, which would write the body out as often. */
static void look_at_loop(glsl_text *text, const glsl_function *function, int32_t i) {
    const uint32_t line = text->tokens[i].line;
    int32_t counter = -1, depth = 0;
    int compared = 0, comparing = 0, bounded = 0, part = 0;
    for (++i; i < function->to; ++i) {
        const glsl_token *const token = &text->tokens[i];
        if (is_mark(text, i, '(')) ++depth;
        if (is_mark(text, i, ')') && --depth == 0) break;
        if (depth == 1 && is_mark(text, i, ';')) ++part;
        if (token->kind == GLSL_NAME && part == 0 && is_mark(text, i + 1, '=') && counter < 0) {
            counter = token->value;
        } else if (token->kind == GLSL_NAME && part == 0) {
            bounded |= is_variable(text, function, token->value);
        }
        if (part != 1 || is_mark(text, i, GLSL_TWO('&', '&')) ||
            is_mark(text, i, GLSL_TWO('|', '|')))
            comparing = 0;
        if (part != 1) continue;
        if (comparing && token->kind == GLSL_NAME)
            bounded |= is_variable(text, function, token->value);
        if (is_comparison(text, i) && token[-1].kind == GLSL_NAME && token[-1].value == counter)
            compared = comparing = 1;
    }
    if (counter < 0 || !compared || part != 2)
        glsl_text_fault(text, line, "a loop that does not count", "", 0);
    if (!bounded) glsl_text_fault(text, line, "a loop with a constant bound", "", 0);
}

static void look_at_loops(glsl_text *text) {
    for (int32_t f = 0; f < text->function_count; ++f) {
        const glsl_function *const function = &text->functions[f];
        if ((text->names[function->name].what & GLSL_IS_CALLERS) != 0) continue;
        for (int32_t i = function->from; i < function->to; ++i) {
            if (is_word(text, i, "for")) look_at_loop(text, function, i);
        }
    }
}

/* ---- What is not used ------------------------------------------------------------------------ */

int glsl_text_audit(glsl_text *text, const char *const *roots, int root_count) {
    const uint32_t needed =
        GLSL_IS_STRUCTURE | GLSL_IS_MACRO | GLSL_IS_GLOBAL | GLSL_IS_UNIFORM | GLSL_IS_FUNCTION;
    look_at_calls(text, roots, root_count);
    look_at_loops(text);
    /* A block of push constants holds what was asked for, used or not: hosts count on its layout. */
    const uint32_t in_block = glsl_text_find(text, "push_constant") >= 0 ? GLSL_IS_UNIFORM : 0;
    for (int32_t i = 0; i < text->name_count; ++i) {
        const glsl_name *const name = &text->names[i];
        if ((name->what & (GLSL_IS_GUARD | GLSL_IS_FUNCTION)) != 0) continue;
        if ((name->what & needed & ~in_block) != 0 && name->uses == 0)
            complain(text, 0, "declared and not used", name);
    }
    return text->fault[0] == 0;
}

/* ---- Libraries ------------------------------------------------------------------------------- */

static void look_at_macros(glsl_text *text) {
    for (int32_t i = 0; i + 2 < text->token_count; ++i) {
        if (!is_mark(text, i, '#') || !is_word(text, i + 1, "define")) continue;
        if (guard_of(text, i, text->tokens[i + 2].value) < 0)
            complain(text, text->tokens[i].line, "a setting that cannot be replaced",
                     &text->names[text->tokens[i + 2].value]);
    }
}

/* What stands before a function that can be replaced, which alone calls it. */
static int is_part(const glsl_name *name) {
    static const char *const parts[] = {"spt_field_", "spt_march", "spt_clip_", "spt_hull_",
                                        "spt_unmap_"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i) {
        const size_t length = strlen(parts[i]);
        if (name->size >= length && memcmp(name->first, parts[i], length) == 0) return 1;
    }
    return 0;
}

static void look_at_guards(glsl_text *text) {
    for (int32_t i = 0; i < text->function_count; ++i) {
        const glsl_function *const function = &text->functions[i];
        const glsl_name *const name = &text->names[function->name];
        if ((name->what & GLSL_IS_CALLERS) != 0 || is_part(name)) continue;
        if (guard_of(text, function->begin, -1) < 0) {
            complain(text, text->tokens[function->begin].line, "a function that cannot be replaced",
                     name);
        }
    }
}

int glsl_text_audit_library(glsl_text *text) {
    static const char *const foreign[] = {"main",      "mainImage", "version", "extension",
                                          "precision", "layout",    "discard"};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; ++i) {
        if (glsl_text_find(text, foreign[i]) >= 0)
            glsl_text_fault(text, 0, "a library with", foreign[i], strlen(foreign[i]));
    }
    for (int32_t i = 0; i < text->name_count; ++i) {
        const glsl_name *const name = &text->names[i];
        if ((name->what & (GLSL_IS_UNIFORM | GLSL_IS_GLOBAL)) != 0)
            complain(text, 0, "a library with a global variable", name);
    }
    look_at_macros(text);
    look_at_guards(text);
    return text->fault[0] == 0;
}

int glsl_text_check(glsl_text *text, const char *source, int is_library, const char *const *roots,
                    int root_count) {
    return glsl_text_read(text, source) && glsl_text_parse(text) &&
           glsl_text_audit(text, roots, root_count) &&
           (!is_library || glsl_text_audit_library(text));
}
