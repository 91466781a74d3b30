/* SPDX-License-Identifier: MIT
 *
 * The command line of render: what it asks for, checked before anything is traced. */
#ifndef EXAMPLES_RENDER_OPTIONS_H
#define EXAMPLES_RENDER_OPTIONS_H

#include "picture.h"

typedef struct render_options {
    picture_job job;
    const char *output;  /* NULL: named by the scene */
    const char *gallery; /* the folder, or NULL */
    int large;           /* the large gallery */
    int threads;
    int samples;  /* as asked for, or 0 */
    int part, of; /* 0: the whole picture */
    int merge;
    char **words; /* scene, or files to be merged: word_count of them, in the program's arguments */
    int word_count;
} render_options;

/* Reads the command line, and moves its words in front of its options. Where it only asks for text,
 * prints that and ends the program; ends it with a message where it is wrong. */
render_options render_options_of(int count, char **arguments);

/* Ends the program with status 2 after a printf-style message about the command line. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 1, 2)))
#endif
void
render_refuse(const char *format, ...);

#endif
