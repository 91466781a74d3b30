/* SPDX-License-Identifier: MIT
 *
 * The parts of the bench of kernel-reflection sequences, and THE LIST of the cases that are raced
 * against the number of levels (Szécsi et al. 2016, section 11). */
#ifndef TESTS_BENCH_KRS_BENCH_H
#define TESTS_BENCH_KRS_BENCH_H

#include "../frame/frame_picture.h"
#include "krs_models.h"

/* 2, 4 .. 28 levels. */
enum {
    KRS_FIRST = 2,
    KRS_STEP = 2,
    KRS_LAST = KRS_MOST_LEVELS,
    KRS_NUMBERS = (KRS_LAST - KRS_FIRST) / 2 + 1
};

/* How rays are traced: handed to spt_trace() or spt_binary_trace(), or made by a frame that sends
 * cones ahead of them: the low-resolution phase. */
typedef enum krs_how { KRS_DIRECT, KRS_BINARY, KRS_FRAME } krs_how;

/* X(name, how, body, rule, whether its probes end so early that it errs as the first does) */
#define KRS_CASES(X) \
    X(single_direct, KRS_DIRECT, KRS_TREE, "basic", 0) \
    X(single_direct_adaptive, KRS_DIRECT, KRS_TREE, "adaptive", 0) \
    X(single_binary, KRS_BINARY, KRS_TREE, "", 0) \
    X(single_binary_same_error, KRS_BINARY, KRS_TREE, "", 1) \
    X(single_cones, KRS_FRAME, KRS_TREE, "basic", 0) \
    X(single_cones_adaptive, KRS_FRAME, KRS_TREE, "adaptive", 0) \
    X(moekrs_binary, KRS_BINARY, KRS_PALM, "", 0) \
    X(moekrs_bound, KRS_DIRECT, KRS_PALM, "basic", 0) \
    X(moekrs_bound_adaptive, KRS_DIRECT, KRS_PALM, "adaptive", 0) \
    X(grove_cones, KRS_FRAME, KRS_GROVE, "basic", 0) \
    X(grove_cones_adaptive, KRS_FRAME, KRS_GROVE, "adaptive", 0) \
    X(copies_cones, KRS_FRAME, KRS_COPIES, "basic", 0) \
    X(copies_cones_adaptive, KRS_FRAME, KRS_COPIES, "adaptive", 0) \
    X(compound_cones, KRS_FRAME, KRS_KINDS, "basic", 0) \
    X(compound_cones_adaptive, KRS_FRAME, KRS_KINDS, "adaptive", 0)

typedef enum krs_case {
#define X(name, ...) krs_##name,
    KRS_CASES(X)
#undef X
        krs_cases
} krs_case;

typedef struct krs_described {
    const char *name;
    krs_how how;
    krs_body body;
    const char *rule;
    int same_error;
} krs_described;

extern const krs_described krs_case_of[krs_cases];

/* What hits of sampled rays are worth, against a trace with a hundredth of the tolerance. */
typedef struct krs_error {
    double mean, most;      /* how far short of the surface along the ray, in tolerances: the mean,
                               * and what 95 of 100 keep */
    double passed;          /* share of rays: hits near a surface that the exact ray passes by */
    double lost, undecided; /* rays that overlook a surface; that ran out of their budget */
    double per_hit;         /* evaluations of a ray that hits */
} krs_error;

/* What a case came to. */
typedef struct krs_result {
    double seconds[BENCH_MOST_ROUNDS]; /* of a pixel, by round */
    double nanoseconds;                /* of a pixel in the middle round */
    double per_evaluation;             /* of the middle round */
    double evaluations;                /* a pixel, those of cones included */
    double probe_ratio;                /* of binary tracing */
    krs_error error;
} krs_result;

/* Every 16th block of 256 rays of a picture, and what is known of them. */
typedef struct krs_sample {
    size_t count;
    spt_ray *rays;
    size_t *place; /* in the picture's rays, ascending */
    double *exact; /* t; +infinity: no surface */
} krs_sample;

krs_sample krs_sample_of(const frame_picture *picture);
void krs_sample_free(krs_sample *sample);

/* Finds where the surfaces are. */
void krs_sample_exact(krs_sample *sample, const krs_models *models, krs_body body,
                      const spt_settings *settings);

/* Judges the hits of the sample's rays. */
krs_error krs_sample_judge(const krs_sample *sample, const spt_settings *settings,
                           const bench_hit *hits);

/* Evaluations of rays that both of two ways hit: those of the first over those of the second. */
double krs_hits_ratio(size_t count, const bench_hit *ones, const bench_hit *others);

/* Traces rays by a case that is no frame. statistics: or NULL. */
void krs_trace(const krs_models *models, krs_case which, float probe_ratio,
               const spt_settings *settings, size_t count, const spt_ray *rays, bench_hit *hits,
               spt_statistics *statistics);

/* Settings of a case, but for the probe ratio. */
spt_settings krs_settings(krs_case which, float pixel_radius);

/* ---- Parts --------------------------------------------------------------------------------- */

/* Races the cases at every number of levels, writes their rows and prints what they reach. Returns
 * whether nothing was overlooked. */
int krs_race(const bench_options *options, FILE *file);

/* The same for evaluations by themselves. */
void krs_evaluations(const bench_options *options, FILE *file);

/* How straight a line through points is. */
typedef struct krs_line {
    double slope, offset;
    double straight; /* R^2 */
} krs_line;

krs_line krs_line_through(const double *x, const double *y, int count);

/* Prints a line of what was to be reached. */
void krs_print_goal(const char *what, double value, const char *goal, int reached);

/* Begins a row: case, levels, components, instances. */
void krs_begin_row(FILE *file, const char *name, uint32_t levels, int components, double instances);

#endif
