/* SPDX-License-Identifier: MIT
 *
 * Two threads share a frame: whether its work divides, and whether sharing costs anything. By CPU
 * times of each thread; what the wall clock says depends on who else uses the machine. */
#define _POSIX_C_SOURCE 199506L
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "frame_bench.h"

enum { THREADS = 2 };

static double seconds_of(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A work counter. A tile takes some 100 microseconds, a lock a fraction of one. */
typedef struct thread_queue {
    pthread_mutex_t lock;
    size_t next, tiles;
} thread_queue;

typedef struct thread_worker {
    thread_queue *queue;
    frame_tracer *tracer;
    const frame_picture *picture;
    bench_hit *image;
    double seconds; /* of CPU */
} thread_worker;

static size_t take(thread_queue *queue) {
    pthread_mutex_lock(&queue->lock);
    const size_t place = queue->next;
    queue->next += place < queue->tiles;
    pthread_mutex_unlock(&queue->lock);
    return place;
}

static void *work(void *argument) {
    thread_worker *const worker = argument;
    const double before = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    for (size_t place = take(worker->queue); place < worker->queue->tiles;
         place = take(worker->queue)) {
        const frame_slice slice = {place, place + 1};
        frame_tracer_run(worker->tracer, worker->picture, slice, worker->image);
    }
    worker->seconds = seconds_of(CLOCK_THREAD_CPUTIME_ID) - before;
    return NULL;
}

/* One frame by so many threads. */
typedef struct thread_times {
    double sum, largest, wall;
} thread_times;

static thread_times run_frame(thread_worker *workers, int threads) {
    thread_queue queue = {PTHREAD_MUTEX_INITIALIZER, 0, workers[0].picture->tiles};
    thread_times times = {0, 0, 0};
    pthread_t handles[THREADS];
    const double before = seconds_of(CLOCK_MONOTONIC);
    for (int k = 0; k < threads; ++k) {
        workers[k].queue = &queue;
        if (pthread_create(&handles[k], NULL, work, &workers[k]) != 0) exit(1);
    }
    for (int k = 0; k < threads; ++k) pthread_join(handles[k], NULL);
    times.wall = seconds_of(CLOCK_MONOTONIC) - before;
    for (int k = 0; k < threads; ++k) {
        times.sum += workers[k].seconds;
        times.largest = workers[k].seconds > times.largest ? workers[k].seconds : times.largest;
    }
    return times;
}

frame_threads_result frame_threads(const bench_options *options, const frame_picture *picture,
                                   const frame_way *way, const char *rule,
                                   const bench_hit *expected) {
    double share[BENCH_MOST_ROUNDS], cost[BENCH_MOST_ROUNDS], wall[BENCH_MOST_ROUNDS];
    double largest[BENCH_MOST_ROUNDS];
    bench_hit *const image = frame_image_of(picture->count);
    thread_worker workers[THREADS];
    frame_threads_result result;
    memset(workers, 0, sizeof workers);
    for (int k = 0; k < THREADS; ++k) {
        workers[k].picture = picture;
        workers[k].image = image;
        workers[k].tracer = frame_tracer_of(picture, way, rule, 0);
    }
    for (int round = 0; round < options->rounds; ++round) {
        const thread_times one = run_frame(workers, 1), two = run_frame(workers, THREADS);
        share[round] = two.sum / two.largest;
        cost[round] = two.sum / one.sum;
        wall[round] = one.wall / two.wall;
        largest[round] = two.largest;
    }
    result.median_share = bench_median(share, options->rounds);
    result.share = share[options->rounds - 1]; /* bench_median() sorts */
    result.cost = bench_median(cost, options->rounds);
    result.wall = bench_median(wall, options->rounds);
    result.largest = bench_median(largest, options->rounds);
    result.different = 0;
    for (size_t i = 0; i < picture->count; ++i) {
        result.different += memcmp(&image[i], &expected[i], sizeof *image) != 0;
    }
    for (int k = 0; k < THREADS; ++k) frame_tracer_free(workers[k].tracer);
    free(image);
    return result;
}
