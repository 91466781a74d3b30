/* SPDX-License-Identifier: MIT
 *
 * The command line of emit. */
#ifndef EXAMPLES_EMIT_OPTIONS_H
#define EXAMPLES_EMIT_OPTIONS_H

#include "emit_shader.h"

typedef struct emit_options {
    emit_job job;
    const char *subject; /* NULL: none was named */
    const char *output;  /* the file; NULL: standard output */
    const char *page;    /* the file of the viewer, or NULL; and of the other pages: */
    const char *three, *hybrid;
    int list;
    int features_given; /* otherwise pages choose their own */
} emit_options;

/* Reads the command line. Ends the program where it asks for help, and with status 2 and a message
 * where it is wrong. */
emit_options emit_options_of(int count, char **arguments);

#endif
