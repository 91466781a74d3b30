/* SPDX-License-Identifier: MIT
 *
 * What is true of a ray, by a slow walk in double precision: where it may start at the latest, from
 * where a hit is due, and how near it comes to what it does not hit. */
#ifndef TESTS_ORACLE_FRAME_TRUTH_H
#define TESTS_ORACLE_FRAME_TRUTH_H

#include <scenes/scenes.h>
#include <spheretrace/trace.h>

/* A field in double, over its Lipschitz constant. */
typedef double truth_distance_fn(const void *user, const double position[3]);

typedef struct truth_field {
    truth_distance_fn *distance;
    const void *user;
} truth_field;

/* A scene of scenes.h. */
truth_field truth_of_scene(const scene *shown);

/* All lengths in the ray's t; +infinity where it does not happen up to t_max.
 *   zero       the first zero of f
 *   deep       from where on the ray is inside by more than rounding explains: nothing before it is
 *              known to be free beyond it, so no ray and no cone may start or stop there
 *   through    from where on it is inside by more than rounding and the tolerance: a hit is due up
 *              to there. Where f is no distance bound its depth proves nothing: there, a twentieth
 *              behind the surface without a way out
 *   clearance  the least f over the tolerance, at samples before the first zero: along the ray f
 *              falls to no less than half of it between samples
 * A ray whose first sample is inside is walked to the way out. */
typedef struct ray_truth {
    double zero, deep, through, clearance;
} ray_truth;

/* By basic tracing with at most 10 000 steps. path: world length before the ray. */
ray_truth truth_walk(const truth_field *field, const spt_settings *settings, const spt_ray *ray,
                     double path);

/* How a result contradicts the truth; 0 where it does not. Late: it lies beyond what is free. */
enum { TRUTH_AGREES, TRUTH_LOST, TRUTH_LATE, TRUTH_FALSE };
int truth_judge(const truth_field *field, const spt_settings *settings, const spt_ray *ray,
                double path, const ray_truth *truth, const spt_hit *hit);

/* Where a hit is due, was it found? Sums for checks that many rays are decided. */
typedef struct truth_sum {
    uint64_t rays, due, found, undecided, lost, late, false_hits;
} truth_sum;
void truth_count(truth_sum *sum, const ray_truth *truth, const spt_hit *hit, int judgement);

#endif
