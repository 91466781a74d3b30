/* SPDX-License-Identifier: MIT
 *
 * The runs that error.csv compares: a scene with its rays and their truth, and whoever traces them
 * with a budget. Left out: rows, rounds and the clock, which are error.c's. */
#ifndef TESTS_REPORT_ERROR_RUNS_H
#define TESTS_REPORT_ERROR_RUNS_H

#include "../../bench/frame/frame_picture.h"
#include "../report.h"

/* Cells of the tables that have one for each scene; and the budgets, of which quick ones leave some
 * out. */
int error_cells(const report_options *options);
enum { error_budget_count = 12 };
extern const uint32_t error_budgets[error_budget_count];
int error_budget_wanted(const report_options *options, uint32_t budget);

/* What is true of a ray, by its scene in double and plain steps; +infinity: not up to t_max.
 *   t          the first zero of f
 *   through    from where on it is inside by more than the stop and rounding: a hit is due up to
 *              there. Where f is no distance bound a twentieth behind the surface
 *   clearance  the least f before t, in stops
 *   grazed     before that the ray came so close to a surface, or dipped so little into it, that it
 *              may count as a hit or not, and left it again */
typedef struct error_truth {
    double t, through, clearance;
    int grazed;
} error_truth;

error_truth error_truth_of(const scene *shown, const spt_settings *settings, const spt_ray *ray);

/* Clear of grazing: no tracer that keeps its promises can say otherwise. */
int error_clear_hit(const error_truth *truth);
int error_clear_miss(const error_truth *truth);

/* A scene, its rays and what is true of them. */
typedef struct error_scene {
    const scene *shown;
    frame_picture *picture;
    size_t count;          /* of rays */
    spt_settings settings; /* of all runs, but for method and budget */
    error_truth *truth;    /* of each ray */
    size_t *identity;      /* 0, 1, 2 .. */
    int bound;             /* the field is a distance bound */
    spt_hit *hits;         /* of the run at work */
} error_scene;

error_scene *error_scene_of(const report_options *options, const char *name);
void error_scene_free(error_scene *in);

/* Who traces all rays of a scene with one budget. */
typedef struct error_runner error_runner;
struct error_runner {
    const char *method;
    int lanes;           /* 0: not known */
    uint32_t budget;     /* evaluations, or, of the papers' listings, iterations */
    const size_t *place; /* of each ray's result in hits */
    double cones;        /* evaluations a ray that no result carries */
    /* Traces them; all: every result there is, and cones. Returns the seconds it took. */
    double (*run)(error_runner *runner, const error_scene *in, int all);
    void (*close)(error_runner *runner);
    const void *way; /* and memory of its own */
    void *own;
};

enum { error_most_runners = 16 }; /* of a schedule and a budget */

/* Those of a schedule and a budget; returns how many. All end by close(). */
int error_ours(error_runner *runners, const error_scene *in, const char *schedule, uint32_t budget);
int error_controls(error_runner *runners, const error_scene *in, uint32_t budget);

/* The emitted shaders by llvmpipe, where it is there; they are built for each budget anew. */
int error_shaders(error_runner *runners, const error_scene *in, uint32_t budget);

/* What a run did wrong. Lengths in t, which are world lengths: directions have length 1. Errors are
 * those of rays that hit clear of grazing, truth_hits of them; rms_both: that the run hits, too. */
typedef struct error_score {
    size_t truth_hits, lost, ghosts, late, undecided;
    double rms, maximum, rms_both, iou; /* NAN: of no rays */
    double evaluations;                 /* a ray, all of them */
} error_score;

error_score error_judge(const error_scene *in, const error_runner *runner);

/* Ends the program where a result breaks what the library promises of every result. */
void error_check_promises(const error_scene *in, const error_runner *runner);

#endif
