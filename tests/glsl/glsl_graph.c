/* SPDX-License-Identifier: MIT
 *
 * Reading functions and calls of a shader. */
#include "glsl_graph.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static int in_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

static const char *line_end(const char *at) {
    return at + strcspn(at, "\n");
}

/* The name that stands before the first bracket of a line at the margin, such as
 * "vec2 spt_clip_0(vec3 ..."; its length, or 0 where no function begins. */
static int function_name(const char *line, const char **name) {
    const char *const end = line_end(line);
    const char *bracket = memchr(line, '(', (size_t)(end - line));
    if (!isalpha((unsigned char)line[0]) || bracket == NULL) return 0;
    const char *from = bracket;
    while (from > line && in_word(from[-1])) --from;
    /* A type stands before it, and nothing but words and blanks. */
    if (from == line || from[-1] != ' ' || from == bracket) return 0;
    for (const char *at = line; at < from; ++at) {
        if (!in_word(*at) && *at != ' ') return 0;
    }
    *name = from;
    return (int)(bracket - from);
}

void glsl_graph_read(glsl_graph *graph, const char *text) {
    memset(graph, 0, sizeof *graph);
    graph->text = text;
    for (const char *line = text; *line != '\0';) {
        const char *name;
        const int length = function_name(line, &name);
        ++graph->lines;
        if (length > 0 && graph->count < GLSL_GRAPH_FUNCTIONS) {
            const char *body = strchr(line, '{'), *end = strstr(line, "\n}");
            if (body != NULL && end != NULL && body < end) {
                graph->functions[graph->count].name = name;
                graph->functions[graph->count].length = length;
                graph->functions[graph->count].body = body;
                graph->functions[graph->count++].end = end;
            }
        }
        line = line_end(line);
        line += *line == '\n';
    }
}

/* The functions of that name; several differ in their arguments. */
static void reach(glsl_graph *graph, const char *name, int length) {
    for (int i = 0; i < graph->count; ++i) {
        if (graph->functions[i].length == length && !graph->functions[i].reached &&
            memcmp(graph->functions[i].name, name, (size_t)length) == 0) {
            graph->functions[i].reached = 1;
        }
    }
}

/* Every word before a bracket that is no comment. */
static void reach_calls(glsl_graph *graph, const char *from, const char *end) {
    for (const char *at = from; at < end; ++at) {
        const char *word = at;
        if (at[0] == '/' && at[1] == '/') {
            at = line_end(at);
            continue;
        }
        if (!isalpha((unsigned char)*at) || in_word(at[-1])) continue;
        while (in_word(*at)) ++at;
        if (*at == '(') reach(graph, word, (int)(at - word));
        --at;
    }
}

/* Bodies of macros call, too. */
static void reach_macros(glsl_graph *graph) {
    const char *at = graph->text;
    while ((at = strstr(at, "#define ")) != NULL) {
        reach_calls(graph, at + 8, line_end(at));
        at += 8;
    }
}

int glsl_graph_dead(glsl_graph *graph, const char *roots, char which[128]) {
    while (*roots != '\0') {
        const int length = (int)strcspn(roots, " ");
        reach(graph, roots, length);
        roots += length + (roots[length] == ' ');
    }
    reach_macros(graph);
    /* Functions stand before those that call them. */
    for (int i = graph->count - 1; i >= 0; --i) {
        if (!graph->functions[i].reached) {
            snprintf(which, 128, "%.*s", graph->functions[i].length, graph->functions[i].name);
            return 1;
        }
        reach_calls(graph, graph->functions[i].body, graph->functions[i].end);
    }
    return 0;
}

static int is_ours(const char *name) {
    return strncmp(name, "spt_", 4) == 0 || strncmp(name, "Spt", 3) == 0 ||
           strncmp(name, "SPT_", 4) == 0 || strncmp(name, "main(", 5) == 0 ||
           strncmp(name, "mainImage(", 10) == 0 || strncmp(name, "caller_", 7) == 0;
}

static int strange(const char *name, char which[128]) {
    if (is_ours(name)) return 0;
    int length = 0;
    while (in_word(name[length])) ++length;
    snprintf(which, 128, "%.*s", length, name);
    return 1;
}

int glsl_graph_stranger(const glsl_graph *graph, char which[128]) {
    static const char *const before[] = {"#define ", "struct ",   "uniform ",
                                         "buffer ",  "out vec4 ", "push_constant) uniform "};
    for (int i = 0; i < graph->count; ++i) {
        if (strange(graph->functions[i].name, which)) return 1;
    }
    for (const char *line = graph->text; *line != '\0';) {
        for (size_t k = 0; k < sizeof before / sizeof before[0]; ++k) {
            const char *at = line;
            if (k < 3 ? strncmp(line, before[k], strlen(before[k])) != 0
                      : strncmp(line, "layout(", 7) != 0 ||
                            (at = strstr(line, before[k])) == NULL || at > line_end(line)) {
                continue;
            }
            const char *name = at + strlen(before[k]);
            if (k == 2) name = strchr(name, ' ') + 1; /* behind the type */
            if (strange(name, which)) return 1;
        }
        line = line_end(line);
        line += *line == '\n';
    }
    return 0;
}
