/* SPDX-License-Identifier: MIT
 *
 * Threads that share out numbered pieces of work by a counter, show how far they are, and stop when
 * the user interrupts the program. What the pieces are is the caller's. */
#ifndef EXAMPLES_WORKERS_H
#define EXAMPLES_WORKERS_H

#include <stddef.h>

typedef struct workers workers;

/* What every thread runs: prepare its own memory, then
 *     while (workers_take(all, &piece)) { ...; workers_finish(all); }
 * and free the memory. */
typedef void workers_fn(void *user, workers *all);

/* Runs work in so many threads, the calling one among them, until the pieces first .. end - 1 are
 * done, and shows a progress bar of that label. Fewer threads where the system gives no more.
 * Returns how many pieces were finished: less than all after workers_stop() or an interrupt. */
size_t workers_run(int threads, size_t first, size_t end, workers_fn *work, void *user,
                   const char *label);

/* The next piece; 0 where none is left or the work is to stop. Pieces are given out in order. */
int workers_take(workers *all, size_t *piece);

/* Says that a piece is done. What a thread wrote for it, workers_run()'s caller sees. */
void workers_finish(workers *all);

/* Lets no thread take another piece: something failed. */
void workers_stop(workers *all);

/* Only one thread at a time is between these two. */
void workers_lock(workers *all);
void workers_unlock(workers *all);

/* The number of processors, at least 1. */
int workers_processors(void);

/* From now on Ctrl-C (and SIGTERM, which schedulers send) stops the workers instead of ending the
 * program; a second one ends it. */
void workers_catch_interrupts(void);

/* The signal that came, or 0. */
int workers_interrupted(void);

#endif
