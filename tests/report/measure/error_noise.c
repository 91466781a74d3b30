/* SPDX-License-Identifier: MIT
 *
 * error_noise.csv: how far the times of error.csv can be trusted, by schedule and of all of ours:
 * their noise, and pairs of rows that are the same work, whose times would be equal without noise.
 * apart: pairs that differ by more than the noise of both. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error_points.h"

static int is_wanted(const error_point *point, const char *schedule) {
    const int all = strcmp(schedule, "all") == 0;
    return all ? !error_is_control(point->schedule) : strcmp(point->schedule, schedule) == 0;
}

/* The larger over the smaller time of all pairs of twins; returns how many. */
static size_t pairs_of(const error_points *points, const char *schedule, double *ratios,
                       size_t most, int *apart) {
    size_t count = 0;
    *apart = 0;
    for (int i = 0; i < points->count; ++i) {
        const error_point *const one = &points->point[i];
        if (!is_wanted(one, schedule)) continue;
        for (int k = i + 1; k < points->count && count < most; ++k) {
            const error_point *const other = &points->point[k];
            if (!error_twins(one, other)) continue;
            const double ratio = one->nanoseconds / other->nanoseconds;
            ratios[count++] = fmax(ratio, 1 / ratio);
            *apart += error_faster(one, other) || error_faster(other, one);
        }
    }
    return count;
}

static void write_noise(const error_points *points, const char *schedule, FILE *rows) {
    /* A row has at most as many twins as there are budgets. */
    const size_t most = (size_t)points->count * error_most_budgets;
    double *const values = report_allocate(most * sizeof *values);
    size_t count = 0;
    int apart;
    for (int i = 0; i < points->count; ++i) {
        const error_point *const point = &points->point[i];
        if (is_wanted(point, schedule) && !isnan(point->noise)) values[count++] = point->noise;
    }
    fprintf(rows, "%s,%zu", schedule, count);
    error_write(rows, count > 0 ? report_quantile(values, count, 0.5) : (double)NAN);
    error_write(rows, count > 0 ? report_quantile(values, count, 0.9) : (double)NAN);
    const size_t pairs = pairs_of(points, schedule, values, most, &apart);
    fprintf(rows, ",%zu,%d", pairs, apart);
    error_write(rows, pairs > 0 ? report_quantile(values, pairs, 0.5) : (double)NAN);
    error_write(rows, pairs > 0 ? report_quantile(values, pairs, 1) : (double)NAN);
    fputc('\n', rows);
    free(values);
}

static void measure(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    (void)cell;
    write_noise(points, "all", rows);
    for (int i = 0; i < points->schedules; ++i) {
        if (!error_is_control(points->schedule[i])) write_noise(points, points->schedule[i], rows);
    }
    error_points_free(points);
}

const report_part report_error_noise = {
    "error_noise",
    "schedule,rows,noise_median,noise_high,pairs,apart,ratio_median,ratio_most",
    error_one_cell,
    measure,
    0,
    {1, 0.1}};
