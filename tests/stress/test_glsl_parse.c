/* SPDX-License-Identifier: MIT
 *
 * What a text of GLSL declares, and whether each name that it uses has been declared before. */
#include "test_glsl_text.h"

#include <string.h>

/* ---- Tokens of code -------------------------------------------------------------------------- */

/* The first token from i on that is not on a line of the preprocessor. */
static int32_t code(const glsl_text *text, int32_t i) {
    while (text->tokens[i].directive && text->tokens[i].kind != GLSL_END) ++i;
    return i;
}

static int32_t next(const glsl_text *text, int32_t i) {
    return text->tokens[i].kind == GLSL_END ? i : code(text, i + 1);
}

static int is_mark(const glsl_text *text, int32_t i, int32_t mark) {
    return text->tokens[i].kind == GLSL_MARK && text->tokens[i].value == mark;
}

static glsl_name *name_at(glsl_text *text, int32_t i) {
    return text->tokens[i].kind == GLSL_NAME ? &text->names[text->tokens[i].value] : NULL;
}

static int is_a(glsl_text *text, int32_t i, uint32_t what) {
    const glsl_name *const name = name_at(text, i);
    return name != NULL && (name->what & what) != 0;
}

static int is_word(glsl_text *text, int32_t i, const char *word) {
    const glsl_token *const token = &text->tokens[i];
    return token->kind == GLSL_NAME && token->size == strlen(word) &&
           memcmp(token->first, word, token->size) == 0;
}

static int complain(glsl_text *text, int32_t i, const char *what) {
    const glsl_token *const token = &text->tokens[i];
    return glsl_text_fault(text, token->line, what, token->first, token->size);
}

/* Behind the bracket that closes the one at i. */
static int32_t behind_bracket(const glsl_text *text, int32_t i) {
    int depth = 0;
    for (; text->tokens[i].kind != GLSL_END; i = next(text, i)) {
        const int32_t mark = text->tokens[i].kind == GLSL_MARK ? text->tokens[i].value : 0;
        if (mark == '(' || mark == '{' || mark == '[') ++depth;
        if ((mark == ')' || mark == '}' || mark == ']') && --depth == 0) return next(text, i);
    }
    return i;
}

/* The comma or semicolon or closing bracket behind this declarator. */
static int32_t end_of_declarator(const glsl_text *text, int32_t i) {
    while (text->tokens[i].kind != GLSL_END) {
        const int32_t mark = text->tokens[i].kind == GLSL_MARK ? text->tokens[i].value : 0;
        if (mark == ',' || mark == ';' || mark == ')' || mark == '}') return i;
        i = mark == '(' || mark == '{' || mark == '[' ? behind_bracket(text, i) : next(text, i);
    }
    return i;
}

/* ---- Declarations ---------------------------------------------------------------------------- */

static int is_ours(const glsl_name *name) {
    static const char *const starts[] = {"spt", "Spt", "SPT"};
    for (int i = 0; i < 3; ++i) {
        if (name->size > 3 && memcmp(name->first, starts[i], 3) == 0) return 1;
    }
    return 0;
}

/* Something that all of the text sees. */
static void declare_global(glsl_text *text, int32_t i, uint32_t what) {
    glsl_name *const name = name_at(text, i);
    if (name == NULL) {
        complain(text, i, "no name where one is declared");
        return;
    }
    const uint32_t again = GLSL_IS_GLOBAL | GLSL_IS_UNIFORM | GLSL_IS_STRUCTURE | GLSL_IS_LOCAL;
    const uint32_t function = GLSL_IS_FUNCTION;
    const int macro = (name->what & (GLSL_IS_MACRO | GLSL_IS_GUARD)) == GLSL_IS_MACRO;
    if (!is_ours(name) && (name->what & GLSL_IS_CALLERS) == 0)
        complain(text, i, "a global name that does not begin with spt");
    if ((name->what & (GLSL_IS_BUILT_IN | GLSL_IS_KEYWORD)) != 0)
        complain(text, i, "a word of the language is declared");
    if ((name->what & again) != 0 || macro || (name->what & function & ~what) != 0)
        complain(text, i, "a global name is already something else");
    name->what |= what;
}

static void end_local(glsl_text *text, glsl_name *name) {
    if (name->idle)
        glsl_text_fault(text, name->declared, "a local variable is not used", name->first,
                        name->size);
    name->idle = 0;
}

static void declare_local(glsl_text *text, int32_t i, int32_t function, uint32_t what) {
    glsl_name *const name = name_at(text, i);
    if (name == NULL) {
        complain(text, i, "no name where one is declared");
        return;
    }
    const uint32_t hidden = GLSL_IS_KEYWORD | GLSL_IS_TYPE | GLSL_IS_FUNCTION | GLSL_IS_MACRO |
                            GLSL_IS_GLOBAL | GLSL_IS_UNIFORM;
    if ((name->what & hidden) != 0) complain(text, i, "a local name hides another");
    end_local(text, name);
    name->what |= GLSL_IS_LOCAL | what;
    name->owner = function;
    name->declared = text->tokens[i].line;
    name->idle = (what & GLSL_IS_PARAMETER) == 0;
}

/* A use of a name in the body of a function, or (function -1) elsewhere. */
static void use(glsl_text *text, int32_t i, int32_t function) {
    glsl_name *const name = name_at(text, i);
    if (i > 0 && is_mark(text, i - 1, '.')) {
        const int swizzle = name->size <= 4 && strspn(name->first, "xyzw") >= name->size;
        if (!swizzle && (name->what & GLSL_IS_MEMBER) == 0 && !is_word(text, i, "length"))
            complain(text, i, "an unknown member");
        ++name->uses;
        return;
    }
    const uint32_t known = GLSL_IS_KEYWORD | GLSL_IS_TYPE | GLSL_IS_BUILT_IN | GLSL_IS_CALLERS |
                           GLSL_IS_FUNCTION | GLSL_IS_STRUCTURE | GLSL_IS_MACRO | GLSL_IS_GLOBAL |
                           GLSL_IS_UNIFORM;
    const int local = (name->what & GLSL_IS_LOCAL) != 0 && name->owner == function;
    if (!local && (name->what & known) == 0) complain(text, i, "an unknown name");
    name->idle = 0;
    ++name->uses;
}

/* Declarators from i to the semicolon, which is returned. */
static int32_t declarators(glsl_text *text, int32_t i, int32_t function, uint32_t what) {
    for (;;) {
        const int32_t end = end_of_declarator(text, i);
        for (int32_t at = next(text, i); at < end; at = next(text, at)) {
            if (name_at(text, at) != NULL) use(text, at, function);
        }
        if (function >= 0) {
            declare_local(text, i, function, what); /* not yet there in its own initialiser */
        } else if ((what & GLSL_IS_MEMBER) != 0) {
            if (name_at(text, i) != NULL) name_at(text, i)->what |= what;
        } else {
            declare_global(text, i, what);
        }
        if (!is_mark(text, end, ',')) return end;
        i = next(text, end);
    }
}

/* ---- Functions ------------------------------------------------------------------------------- */

static int is_qualifier(glsl_text *text, int32_t i) {
    static const char *const words[] = {"const",     "uniform", "buffer", "coherent", "restrict",
                                        "readonly",  "in",      "out",    "inout",    "flat",
                                        "writeonly", "smooth",  "highp",  "precise",  "invariant"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        if (is_word(text, i, words[k])) return 1;
    }
    return is_a(text, i, GLSL_IS_MACRO);
}

/* From ( on; returns what is behind ). */
static int32_t parameters(glsl_text *text, int32_t i, int32_t function) {
    const int32_t end = behind_bracket(text, i);
    for (i = next(text, i); i < end && !is_mark(text, i, ')'); i = next(text, i)) {
        while (is_qualifier(text, i)) i = next(text, i);
        if (!is_a(text, i, GLSL_IS_TYPE)) complain(text, i, "no type of a parameter");
        use(text, i, -1);
        i = next(text, i);
        if (name_at(text, i) != NULL) declare_local(text, i, function, GLSL_IS_PARAMETER);
        i = end_of_declarator(text, i);
        if (!is_mark(text, i, ',')) break;
    }
    return end;
}

/* From { on; returns what is behind }. */
static int32_t body(glsl_text *text, int32_t i, int32_t function) {
    const int32_t end = behind_bracket(text, i);
    for (; i < end; i = next(text, i)) {
        if (name_at(text, i) == NULL) continue;
        const int32_t after = next(text, i);
        if (is_a(text, i, GLSL_IS_TYPE) && name_at(text, after) != NULL) {
            use(text, i, function);
            i = declarators(text, after, function, 0);
        } else {
            use(text, i, function);
        }
    }
    for (int32_t n = 0; n < text->name_count; ++n) {
        if (text->names[n].owner == function) end_local(text, &text->names[n]);
    }
    return end;
}

/* From the name of a function on, whose first token is at begin. */
static int32_t function_at(glsl_text *text, int32_t begin, int32_t i) {
    if (text->function_count == glsl_most_functions) {
        complain(text, i, "too many functions for this reader");
        return text->token_count - 1;
    }
    const int32_t number = text->function_count++;
    glsl_function *const function = &text->functions[number];
    function->name = text->tokens[i].value;
    function->begin = begin;
    declare_global(text, i, GLSL_IS_FUNCTION);
    i = parameters(text, next(text, i), number);
    function->from = i;
    function->naming = 0;
    if (is_mark(text, i, ';')) { /* it is only announced */
        --text->function_count;
        return next(text, i);
    }
    if (!is_mark(text, i, '{')) complain(text, i, "no body of a function");
    return function->to = body(text, i, number);
}

/* ---- The whole ------------------------------------------------------------------------------- */

/* Members of a structure or block from { on; returns what is behind }. */
static int32_t members(glsl_text *text, int32_t i, uint32_t what) {
    const int32_t end = behind_bracket(text, i);
    for (i = next(text, i); i < end && !is_mark(text, i, '}'); i = next(text, i)) {
        while (is_qualifier(text, i)) i = next(text, i);
        if (!is_a(text, i, GLSL_IS_TYPE)) complain(text, i, "no type of a member");
        if (name_at(text, i) != NULL) use(text, i, -1);
        i = declarators(text, next(text, i), -1, what);
    }
    return end;
}

static int32_t structure(glsl_text *text, int32_t i) {
    declare_global(text, i, GLSL_IS_STRUCTURE | GLSL_IS_TYPE);
    i = next(text, i);
    if (!is_mark(text, i, '{')) complain(text, i, "no members of a structure");
    return members(text, i, GLSL_IS_MEMBER);
}

/* A block of uniforms or of a buffer: its members are global, unless the block has a name. */
static int32_t block(glsl_text *text, int32_t i, int uniform) {
    declare_global(text, i, GLSL_IS_STRUCTURE);
    ++name_at(text, i)->uses;
    i = next(text, i);
    const int32_t behind = behind_bracket(text, i);
    const int named = name_at(text, behind) != NULL;
    const uint32_t global = uniform ? GLSL_IS_UNIFORM : GLSL_IS_GLOBAL;
    members(text, i, named ? GLSL_IS_MEMBER | global : global);
    return named ? declarators(text, behind, -1, GLSL_IS_GLOBAL) : behind;
}

/* Something global; returns what is behind it. */
static int32_t declaration(glsl_text *text, int32_t i) {
    const int32_t begin = i;
    int uniform = 0;
    if (is_mark(text, i, ';')) return next(text, i);
    if (is_word(text, i, "precision")) return next(text, end_of_declarator(text, i));
    if (is_word(text, i, "invariant") && is_mark(text, next(text, next(text, i)), ';')) {
        use(text, next(text, i), -1);
        return next(text, next(text, next(text, i)));
    }
    if (is_word(text, i, "struct")) return structure(text, next(text, i));
    for (;; i = next(text, i)) {
        uniform |= is_word(text, i, "uniform");
        if (is_word(text, i, "layout")) {
            i = behind_bracket(text, next(text, i)) - 1;
        } else if (!is_qualifier(text, i)) {
            break;
        } else if (is_a(text, i, GLSL_IS_MACRO)) {
            ++name_at(text, i)->uses;
        }
    }
    if (is_mark(text, i, ';')) return next(text, i); /* layout(...) in; */
    const int32_t after = next(text, i);
    if (is_mark(text, after, '{')) return block(text, i, uniform);
    if (!is_a(text, i, GLSL_IS_TYPE)) {
        complain(text, i, "not understood");
        return text->token_count - 1;
    }
    use(text, i, -1);
    if (is_mark(text, next(text, after), '(')) return function_at(text, begin, after);
    return next(text, declarators(text, after, -1, uniform ? GLSL_IS_UNIFORM : GLSL_IS_GLOBAL));
}

/* #define: macros are known from the beginning. Those that only say that something is there stand
 * behind their own #ifndef and have no text but their own name. */
static void define(glsl_text *text, int32_t i) {
    const uint32_t line = text->tokens[i].line;
    glsl_name *const name = name_at(text, i);
    if (name == NULL) {
        complain(text, i, "no name of a macro");
        return;
    }
    if (!is_ours(name)) complain(text, i, "a macro that does not begin with spt");
    name->what |= GLSL_IS_MACRO;
    name->from = name->to = i + 1;
    while (text->tokens[name->to].line == line && text->tokens[name->to].kind != GLSL_END)
        ++name->to;
    const int32_t own = name->to - name->from;
    const int empty = own == 0 || (own == 1 && name_at(text, i + 1) == name);
    if (empty && i >= 5 && is_word(text, i - 4, "ifndef") && name_at(text, i - 3) == name) {
        name->what |= GLSL_IS_GUARD;
        name->to = name->from;
    }
    for (int32_t at = name->from; at < name->to; ++at) {
        if (name_at(text, at) != NULL) ++name_at(text, at)->uses;
    }
}

static void look_at_macros(glsl_text *text) {
    for (int32_t n = 0; n < text->name_count; ++n) {
        const glsl_name *const name = &text->names[n];
        if ((name->what & GLSL_IS_MACRO) == 0) continue;
        for (int32_t i = name->from; i < name->to; ++i) {
            if (name_at(text, i) == NULL) continue;
            if (name_at(text, i)->what == 0 && !is_mark(text, i - 1, '.'))
                complain(text, i, "an unknown name");
        }
    }
}

int glsl_text_parse(glsl_text *text) {
    for (int32_t i = 0; i + 2 < text->token_count; ++i) {
        if (is_mark(text, i, '#') && is_word(text, i + 1, "define")) define(text, i + 2);
    }
    for (int32_t i = code(text, 0); text->tokens[i].kind != GLSL_END && text->fault[0] == 0;) {
        i = declaration(text, i);
    }
    look_at_macros(text);
    return text->fault[0] == 0;
}
