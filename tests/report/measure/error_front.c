/* SPDX-License-Identifier: MIT
 *
 * front.csv and front_summary.csv: which step rules have points on the Pareto front of error and
 * cost, where cost is time or evaluations. A point is a rule with a budget. It is on the front
 * where no other of the same scene and schedule is better in one and no worse in the other; of
 * times, what is within the noise of both is neither. Budgets that let all rays of a rule end are
 * the same work: they are one point. */
#include <math.h>
#include <string.h>

#include "error_points.h"

static const char *const costs[] = {"nanoseconds", "evaluations"};
enum { COSTS = 2, most_points = 256 };

/* The points of a scene and a schedule. */
typedef struct error_front {
    const error_point *point[most_points];
    int count, by_time;
} error_front;

/* spt_convex() needs a licence that few fields have: the front is drawn without it, and again with
 * it. */
static int needs_licence(const error_point *point) {
    return strcmp(point->method, "convex") == 0;
}

static int cheaper(const error_front *of, const error_point *a, const error_point *b) {
    if (!of->by_time) return a->evaluations < b->evaluations;
    return error_faster(a, b);
}

static int dominates(const error_front *of, const error_point *a, const error_point *b) {
    if (a->rms > b->rms || cheaper(of, b, a)) return 0;
    return a->rms < b->rms || cheaper(of, a, b);
}

static int on_front(const error_front *of, const error_point *point, int licensed) {
    for (int i = 0; i < of->count; ++i) {
        if (!licensed && needs_licence(of->point[i])) continue;
        if (dominates(of, of->point[i], point)) return 0;
    }
    return 1;
}

/* Of twins the one with the median time stands for all. */
static int stands(const error_points *points, const error_point *point) {
    int twins = 0, before = 0;
    for (int i = 0; i < points->count; ++i) {
        const error_point *const other = &points->point[i];
        if (!error_twins(other, point)) continue;
        ++twins;
        before += other->nanoseconds < point->nanoseconds ||
                  (!(point->nanoseconds < other->nanoseconds) && other < point);
    }
    return before == (twins - 1) / 2;
}

static void gather(error_front *of, const error_points *points, const char *shown,
                   const char *schedule) {
    of->count = 0;
    for (int i = 0; i < points->count && of->count < most_points; ++i) {
        const error_point *const point = &points->point[i];
        if (strcmp(point->scene, shown) != 0 || strcmp(point->schedule, schedule) != 0) continue;
        if (!isnan(point->rms) && stands(points, point)) of->point[of->count++] = point;
    }
}

/* A rule that needs a licence is not in the front without. */
static void write_method(const error_front *of, const char *shown, const char *schedule,
                         const char *method, FILE *rows) {
    int number = 0, without = 0, with = 0, licence = 0;
    for (int i = 0; i < of->count; ++i) {
        if (strcmp(of->point[i]->method, method) != 0) continue;
        licence = needs_licence(of->point[i]);
        without += !licence && on_front(of, of->point[i], 0);
        with += on_front(of, of->point[i], 1);
        ++number;
    }
    if (number == 0) return;
    fprintf(rows, "%s,%s,%s,%s,%d", shown, schedule, costs[of->by_time ? 0 : 1], method, number);
    error_write(rows, licence ? (double)NAN : (double)without);
    error_write(rows, with);
    fputc('\n', rows);
}

static void measure_front(const report_options *options, int cell, FILE *rows) {
    error_points *const points = error_points_of(options);
    (void)cell;
    for (int i = 0; i < points->scenes; ++i) {
        for (int schedule = 0; schedule < points->schedules; ++schedule) {
            error_front of;
            if (error_is_control(points->schedule[schedule])) continue;
            gather(&of, points, points->scene[i], points->schedule[schedule]);
            for (int cost = 0; cost < COSTS; ++cost) {
                of.by_time = cost == 0;
                for (int rule = 0; rule < report_rules; ++rule) {
                    write_method(&of, points->scene[i], points->schedule[schedule],
                                 report_rule[rule], rows);
                }
            }
        }
    }
    error_points_free(points);
}

const report_part report_front = {"front",
                                  "scene,schedule,cost,method,points,on_front,on_front_with_convex",
                                  error_one_cell,
                                  measure_front,
                                  0,
                                  {0.3, 0.1}};

/* ---- How often ------------------------------------------------------------------------------ */

static void summarise(const csv_table *front, const char *schedule, const char *cost,
                      const char *method, FILE *rows) {
    int kinds = 0, without = 0, with = 0, licence = 0;
    for (int row = csv_next(front, -1, "schedule=%s,cost=%s,method=%s", schedule, cost, method);
         row >= 0;
         row = csv_next(front, row, "schedule=%s,cost=%s,method=%s", schedule, cost, method)) {
        if (!error_is_kind(csv_text(front, row, "scene"))) continue;
        ++kinds;
        licence = isnan(csv_number(front, row, "on_front"));
        without += csv_number(front, row, "on_front") > 0;
        with += csv_number(front, row, "on_front_with_convex") > 0;
    }
    if (kinds == 0) return;
    fprintf(rows, "%s,%s,%s,%d", schedule, cost, method, kinds);
    error_write(rows, licence ? (double)NAN : (double)without);
    error_write(rows, with);
    fputc('\n', rows);
}

static void measure_summary(const report_options *options, int cell, FILE *rows) {
    csv_table *const front = csv_open(options->output, "front");
    const char *schedule[error_most_names];
    const int schedules = csv_distinct(front, "schedule", schedule, error_most_names);
    (void)cell;
    for (int i = 0; i < schedules; ++i) {
        for (int cost = 0; cost < COSTS; ++cost) {
            for (int rule = 0; rule < report_rules; ++rule) {
                summarise(front, schedule[i], costs[cost], report_rule[rule], rows);
            }
        }
    }
    csv_close(front);
}

const report_part report_front_summary = {
    "front_summary",
    "schedule,cost,method,scenes,on_front,on_front_with_convex",
    error_one_cell,
    measure_summary,
    0,
    {0.1, 0.1}};
