/* SPDX-License-Identifier: MIT
 *
 * What a shader is made of: its functions, who calls whom, and the names it gives to things. Reads
 * texts as the emitter writes them, where a function begins at the left margin; no preprocessor. */
#ifndef TESTS_GLSL_GRAPH_H
#define TESTS_GLSL_GRAPH_H

enum { GLSL_GRAPH_FUNCTIONS = 512, GLSL_GRAPH_NAMES = 1024 };

typedef struct glsl_graph {
    int lines, count; /* functions */
    const char *text;
    struct {
        const char *name;
        int length;
        const char *body, *end;
        int reached;
    } functions[GLSL_GRAPH_FUNCTIONS];
} glsl_graph;

void glsl_graph_read(glsl_graph *graph, const char *text);

/* Whether a function is not called on any way from the roots, which have blanks between them; its
 * name goes to `which`. */
int glsl_graph_dead(glsl_graph *graph, const char *roots, char which[128]);

/* Whether a function, structure, macro or global has a name that does not begin with spt_, Spt,
 * SPT_ or (in callers' texts) caller_ and is not main or mainImage. */
int glsl_graph_stranger(const glsl_graph *graph, char which[128]);

#endif
