/* SPDX-License-Identifier: MIT
 *
 * The progress bar. Wall time, since processor time counts other threads and stands still while
 * others compute. */
#define _POSIX_C_SOURCE 200809L /* isatty, clock_gettime */
#include "progress.h"

#include <stdio.h>
#include <time.h>

#ifdef _WIN32
#include <io.h>

static int is_terminal(void) {
    return _isatty(2);
}

static double wall_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC; /* wall time on this system */
}
#else
#include <unistd.h>

static int is_terminal(void) {
    return isatty(2);
}

static double wall_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
#endif

progress progress_start(const char *label, size_t total) {
    const double now = wall_seconds();
    progress bar = {label, total, now, now, is_terminal(), 0};
    return bar;
}

void progress_show(progress *bar, size_t done) {
    if (!bar->visible) return;
    const double now = wall_seconds();
    const int finished = done >= bar->total;
    if (now - bar->last < 0.1 && !finished) return;
    bar->last = now;
    const double share = bar->total != 0 ? (double)done / (double)bar->total : 1.0;
    const double left = share > 0.0 ? (now - bar->start) * (1.0 - share) / share : 0.0;
    char line[41];
    const int filled = (int)(share * 40.0);
    for (int i = 0; i < 40; ++i) line[i] = i < filled ? '#' : '.';
    line[40] = '\0';
    fprintf(stderr, "\r%-20.20s [%s] %3d %% %6.1f s left", bar->label, line, (int)(share * 100.0),
            left);
    if (finished) fputc('\n', stderr);
    bar->unfinished_line = !finished;
    fflush(stderr);
}

void progress_end(progress *bar) {
    if (bar->unfinished_line) fputc('\n', stderr);
    bar->unfinished_line = 0;
}
