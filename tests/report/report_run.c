/* SPDX-License-Identifier: MIT
 *
 * The runner. A cell is written to a file that gets its name when it is whole; the cells of a part
 * become its table when all are there. */
#define _POSIX_C_SOURCE 200809L
#include "report_run.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <progress.h>

enum { longest_path = 1024 };

typedef struct report_job {
    const report_options *options;
    const report_part *part;
    int count, next;
    double *done, weight; /* of the progress: milliseconds by estimate */
    progress *bar;
    pthread_mutex_t lock;
} report_job;

static void path_of(char *path, const report_options *options, const char *format, const char *name,
                    int number) {
    char tail[256];
    snprintf(tail, sizeof tail, format, name, number);
    report_expect((size_t)snprintf(path, longest_path, "%s/%s", options->output, tail) <
                      longest_path,
                  "the folder's name is too long");
}

/* Of wall time: parts also wait for programs that they start. */
static double wall_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int is_there(const char *path) {
    struct stat about;
    return stat(path, &about) == 0;
}

static void make_folder(const char *path) {
    if (mkdir(path, 0777) == 0 || errno == EEXIST) return;
    perror(path);
    exit(1);
}

static void table_path(char *path, const report_options *options, const report_part *part) {
    path_of(path, options, "%s.csv", part->name, 0);
}

static void cell_path(char *path, const report_options *options, const report_part *part,
                      int cell) {
    path_of(path, options, "cells/%s-%04d", part->name, cell);
}

static FILE *open_new(const char *path, const char *how) {
    FILE *const file = fopen(path, how);
    if (file == NULL) perror(path);
    report_expect(file != NULL, "a file cannot be opened");
    return file;
}

static void close_whole(FILE *file) {
    const int failed = ferror(file);
    report_expect(fclose(file) == 0 && !failed, "a file cannot be written");
}

static void measure_cell(const report_job *job, int cell) {
    char path[longest_path], unfinished[longest_path + 8];
    cell_path(path, job->options, job->part, cell);
    snprintf(unfinished, sizeof unfinished, "%s.new", path);
    FILE *const rows = open_new(unfinished, "w");
    job->part->measure(job->options, cell, rows);
    close_whole(rows);
    report_expect(rename(unfinished, path) == 0, "a cell cannot be renamed");
}

static int take_cell(report_job *job) {
    char path[longest_path];
    int cell;
    pthread_mutex_lock(&job->lock);
    for (; job->next < job->count; ++job->next) {
        cell_path(path, job->options, job->part, job->next);
        if (!is_there(path)) break;
    }
    cell = job->next++;
    pthread_mutex_unlock(&job->lock);
    return cell < job->count ? cell : -1;
}

static void *work(void *user) {
    report_job *const job = user;
    for (int cell = take_cell(job); cell >= 0; cell = take_cell(job)) {
        measure_cell(job, cell);
        pthread_mutex_lock(&job->lock);
        *job->done += job->weight;
        progress_show(job->bar, (size_t)*job->done);
        pthread_mutex_unlock(&job->lock);
    }
    return NULL;
}

/* What no clock watches runs two cells at a time. */
static void run_cells(report_job *job) {
    pthread_t other;
    const int two = !job->part->timed && pthread_create(&other, NULL, work, job) == 0;
    work(job);
    if (two) pthread_join(other, NULL);
}

static void join_cells(const report_options *options, const report_part *part, int count) {
    char path[longest_path], table[longest_path], unfinished[longest_path + 8], block[4096];
    table_path(table, options, part);
    snprintf(unfinished, sizeof unfinished, "%s.new", table);
    FILE *const to = open_new(unfinished, "w");
    fprintf(to, "%s\n", part->header);
    for (int cell = 0; cell < count; ++cell) {
        cell_path(path, options, part, cell);
        FILE *const from = open_new(path, "r");
        for (size_t size; (size = fread(block, 1, sizeof block, from)) > 0;) {
            fwrite(block, 1, size, to);
        }
        fclose(from);
    }
    close_whole(to);
    report_expect(rename(unfinished, table) == 0, "a table cannot be renamed");
    for (int cell = 0; cell < count; ++cell) {
        cell_path(path, options, part, cell);
        remove(path);
    }
}

static int cells_there(const report_options *options, const report_part *part, int count) {
    char path[longest_path];
    int there = 0;
    for (int cell = 0; cell < count; ++cell) {
        cell_path(path, options, part, cell);
        there += is_there(path);
    }
    return there;
}

static double part_weight(const report_options *options, const report_part *part) {
    return 1000 * part->seconds[options->quick] / (part->timed ? 1 : 2);
}

static void run_part(const report_options *options, const report_part *part, progress *bar,
                     double *done, FILE *parts) {
    char table[longest_path];
    report_job job = {options, part, part->cells(options),     0, done,
                      0,       bar,  PTHREAD_MUTEX_INITIALIZER};
    table_path(table, options, part);
    const int finished = is_there(table);
    const int resumed = finished ? job.count : cells_there(options, part, job.count);
    const double begun = wall_seconds();
    bar->label = part->name;
    if (!finished) {
        if (resumed < job.count) job.weight = part_weight(options, part) / (job.count - resumed);
        run_cells(&job);
        join_cells(options, part, job.count);
    }
    const double seconds = wall_seconds() - begun;
    printf("%-18s %4d cells %4d of them from before %8.1f s\n", part->name, job.count, resumed,
           seconds);
    fflush(stdout);
    if (parts == NULL || finished) return;
    fprintf(parts, "%s,%d,%d,%.3f\n", part->name, job.count, resumed, seconds);
    fflush(parts);
}

/* Scenes that are built when they are first asked for must not be asked from two threads. */
static void build_scenes(void) {
    const double origin = 0;
    double distance;
    for (size_t i = 0; i < scene_count; ++i) {
        scene_field(scenes[i], spt_lanes());
        scenes[i]->reference(1, &origin, &origin, &origin, &distance);
    }
}

void report_run(const report_options *options, const char *wanted, const char *mode) {
    char path[longest_path];
    FILE *parts = NULL;
    double total = 0, done = 0;
    build_scenes();
    path_of(path, options, "cells", "", 0);
    make_folder(path);
    for (int i = 0; i < report_part_count; ++i) {
        table_path(path, options, report_parts[i]);
        if (wanted[i] && !is_there(path)) total += part_weight(options, report_parts[i]);
    }
    progress bar = progress_start("report", (size_t)total);
    path_of(path, options, "parts.csv", "", 0);
    if (mode != NULL) {
        parts = open_new(path, mode);
        if (mode[0] == 'w') fputs("part,cells,resumed,seconds\n", parts);
        fflush(parts);
    }
    for (int i = 0; i < report_part_count; ++i) {
        if (wanted[i]) run_part(options, report_parts[i], &bar, &done, parts);
    }
    progress_end(&bar);
    if (parts != NULL) close_whole(parts);
}

void report_forget(const report_options *options, int part) {
    char path[longest_path];
    table_path(path, options, report_parts[part]);
    remove(path);
    for (int cell = report_parts[part]->cells(options) - 1; cell >= 0; --cell) {
        cell_path(path, options, report_parts[part], cell);
        remove(path);
    }
}

/* ---- One run, perhaps in pieces ------------------------------------------------------------- */

/* FNV-1a of this very program. */
static uint64_t program_hash(void) {
    unsigned char block[4096];
    uint64_t hash = 0xcbf29ce484222325u;
    FILE *const file = fopen("/proc/self/exe", "rb");
    if (file == NULL) return 0;
    for (size_t size; (size = fread(block, 1, sizeof block, file)) > 0;) {
        for (size_t i = 0; i < size; ++i) hash = (hash ^ block[i]) * 0x100000001b3u;
    }
    fclose(file);
    return hash;
}

/* What must be the same for a run to go on: the folder must not hold another machine's figures. */
static void describe_run(const report_options *options, char *text, size_t size) {
    char host[128] = "";
    gethostname(host, sizeof host - 1);
    snprintf(text, size, "%s %016llx %s\n", options->quick ? "quick" : "full",
             (unsigned long long)program_hash(), host);
}

void report_lock(const report_options *options) {
    char path[longest_path];
    struct flock all = {0};
    path_of(path, options, "lock", "", 0);
    const int file =
        open(path, O_RDWR | O_CREAT, 0666); /* closed, and free, when the program ends */
    if (file < 0) perror(path);
    report_expect(file >= 0, "the folder cannot be written to");
    all.l_type = F_WRLCK;
    report_expect(fcntl(file, F_SETLK, &all) == 0, "another run is at work in this folder");
}

int report_begin(const report_options *options) {
    char path[longest_path], now[512], before[512] = "";
    describe_run(options, now, sizeof now);
    path_of(path, options, "unfinished", "", 0);
    FILE *file = fopen(path, "r");
    if (file != NULL) {
        if (fgets(before, sizeof before, file) == NULL) before[0] = '\0';
        fclose(file);
    }
    if (strcmp(now, before) == 0) return 1;
    for (int i = 0; i < report_part_count; ++i) report_forget(options, i);
    path_of(path, options, "index.html", "", 0);
    remove(path);
    path_of(path, options, "unfinished", "", 0);
    file = open_new(path, "w");
    fputs(now, file);
    close_whole(file);
    return 0;
}

void report_finish(const report_options *options) {
    char path[longest_path];
    path_of(path, options, "cells", "", 0);
    rmdir(path);
    path_of(path, options, "unfinished", "", 0);
    remove(path);
}
