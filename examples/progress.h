/* SPDX-License-Identifier: MIT
 *
 * A progress bar on standard error, silent unless that is a terminal. */
#ifndef EXAMPLES_PROGRESS_H
#define EXAMPLES_PROGRESS_H

#include <stddef.h>

typedef struct progress {
    const char *label;
    size_t total;
    double start, last; /* seconds of wall time: begin, last line */
    int visible, unfinished_line;
} progress;

progress progress_start(const char *label, size_t total);

/* Shows that done of total are finished; at most 10 times a second, at once where that is all. */
void progress_show(progress *bar, size_t done);

/* Ends the line where it stands, if not all was finished. */
void progress_end(progress *bar);

#endif
