/* SPDX-License-Identifier: MIT
 *
 * POSIX threads and a counter behind a mutex. Which thread takes which piece depends on the
 * scheduler, so that pieces must not depend on one another. */
#define _POSIX_C_SOURCE 200809L /* sigaction, pthread_sigmask, sysconf */
#include "workers.h"

#include "progress.h"

#include <pthread.h>
#include <signal.h>

enum { most_threads = 1024 };

struct workers {
    pthread_mutex_t lock;
    pthread_t first_thread; /* which called workers_run() */
    size_t next, end, finished;
    int stopping;
    progress bar;
    workers_fn *work;
    void *user;
};

/* ---- Interrupts ---------------------------------------------------------------------------- */

static volatile sig_atomic_t signal_seen;

#ifdef _WIN32
static void note_signal(int number) {
    signal_seen = number;
}

void workers_catch_interrupts(void) {
    signal(SIGINT, note_signal);
    signal(SIGTERM, note_signal);
}

int workers_processors(void) {
    const int count = pthread_num_processors_np();
    return count > 0 ? count : 1;
}
#else
#include <unistd.h>

static void note_signal(int number) {
    signal_seen = number;
}

void workers_catch_interrupts(void) {
    struct sigaction action;
    sigemptyset(&action.sa_mask);
    action.sa_handler = note_signal;
    action.sa_flags = (int)(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int workers_processors(void) {
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 && count < most_threads ? (int)count : 1;
}
#endif

int workers_interrupted(void) {
    return signal_seen;
}

/* Signals are left to the first thread: only between a handler and its own thread does C define
 * what is seen of signal_seen. */
static int start_thread(pthread_t *thread, void *(*function)(void *), workers *all) {
#ifdef _WIN32
    return pthread_create(thread, NULL, function, all) == 0;
#else
    sigset_t blocked, before;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGINT);
    sigaddset(&blocked, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &blocked, &before);
    const int started = pthread_create(thread, NULL, function, all) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
#endif
}

/* ---- The counter --------------------------------------------------------------------------- */

void workers_lock(workers *all) {
    pthread_mutex_lock(&all->lock);
}

void workers_unlock(workers *all) {
    pthread_mutex_unlock(&all->lock);
}

int workers_take(workers *all, size_t *piece) {
    workers_lock(all);
    if (pthread_equal(pthread_self(), all->first_thread) && signal_seen != 0) all->stopping = 1;
    const int given = !all->stopping && all->next < all->end;
    if (given) *piece = all->next++;
    workers_unlock(all);
    return given;
}

void workers_finish(workers *all) {
    workers_lock(all);
    ++all->finished;
    progress_show(&all->bar, all->finished);
    workers_unlock(all);
}

void workers_stop(workers *all) {
    workers_lock(all);
    all->stopping = 1;
    workers_unlock(all);
}

static void *run_thread(void *argument) {
    workers *all = argument;
    all->work(all->user, all);
    return NULL;
}

size_t workers_run(int threads, size_t first, size_t end, workers_fn *work, void *user,
                   const char *label) {
    pthread_t started[most_threads];
    workers all;
    int count = 0;
    const size_t pieces = end > first ? end - first : 0;
    if (pthread_mutex_init(&all.lock, NULL) != 0) return 0;
    all.first_thread = pthread_self();
    all.next = first;
    all.end = end;
    all.finished = 0;
    all.stopping = 0;
    all.bar = progress_start(label, pieces);
    all.work = work;
    all.user = user;
    while (count < threads - 1 && count < most_threads && (size_t)count + 1 < pieces &&
           start_thread(&started[count], run_thread, &all)) {
        ++count;
    }
    work(user, &all);
    for (int i = 0; i < count; ++i) pthread_join(started[i], NULL);
    progress_end(&all.bar);
    pthread_mutex_destroy(&all.lock);
    return all.finished;
}
