/* SPDX-License-Identifier: MIT
 *
 * Judging answers, of the library or of anybody else, ray by ray against the truth.
 * Left out: what is asked, see stability.c and stability_loops.c. */
#ifndef TESTS_REPORT_STABILITY_JUDGE_H
#define TESTS_REPORT_STABILITY_JUDGE_H

#include "stability.h"

extern const stability_family *const stability_families[];
extern const int stability_family_count;

/* Rays of one value of a family's parameter, what they must do, and what they did. */
typedef struct stability_sample {
    size_t count;
    spt_ray *rays;
    stability_truth *truths;
    spt_hit *hits;
    double *evaluations;   /* of the hits that were judged; in any order afterwards */
    unsigned char *failed; /* by ray: wrong, lost or a ghost */
} stability_sample;

/* How many rays a value of a family gets. */
size_t stability_ray_count(const report_options *options);

stability_sample stability_sample_of(size_t count);
void stability_sample_free(stability_sample *sample);

/* Builds the world of family number `family` at a value, and draws rays. The world is the caller's,
 * who gives its memory free. */
void stability_draw(int family, double value, stability_world *world, stability_sample *sample);

/* Whether a step rule may run: spt_convex() needs its licence. And runs it. */
int stability_runs(int family, const char *rule);
void stability_trace(const stability_world *world, const char *rule,
                     const stability_sample *sample);

/* Counts of rays.
 *   wrong      hits that overlook something, or lie where nothing is, of rays that meet the body
 *   lost       misses of rays that meet it clear of grazing
 *   ghosts     hits where nothing is, of rays that meet nothing
 *   undecided  SPT_LIMIT: an answer, and no wrong one
 *   bad_*      what must never be, whatever a field is: a NaN anywhere but in a residual that
 *              echoes the callback's, more evaluations than the budget, and a hit beyond
 *              the tolerance, which SPT_FLAG_STEEP excuses in fields that are no distance bounds
 * Rays that meet the body clear of grazing (clear_hits) or meet nothing (clear_misses) are clear:
 * there is something to decide; clear_undecided are those of them that are
 * not, because their budget ended or the field gave no number. */
typedef struct stability_tally {
    int truth_hits, clear_hits, hits, wrong, lost, ghosts, undecided, nonfinite, steep;
    int clear_misses, clear_undecided;
    int bad_nan, bad_budget, bad_residual;
    double residual_over_tolerance; /* the largest; NaN: there was no hit to look at */
} stability_tally;

stability_tally stability_judge(const stability_world *world, stability_sample *sample);

/* The values of a family that a run sweeps: all, or five of them with both ends. */
int stability_value_count(const report_options *options, int family);
double stability_value(const report_options *options, int family, int number);

#endif
