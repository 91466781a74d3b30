/* SPDX-License-Identifier: MIT
 *
 * What a step rule does to an image of a shared scene: evaluations spent, rays lost. For tests and
 * benches alike; prints nothing and keeps no memory. */
#ifndef TESTS_ORACLE_SURVEY_H
#define TESTS_ORACLE_SURVEY_H

#include <scenes/scenes.h>

/* What is true of a ray, from the scene in double by plain steps.
 *   t        the first zero, +infinity where none is
 *   through  from where on the ray is through the surface beyond doubt: deeper than the tolerance
 *            and twice the rounding (less is undecidable). Where f changes faster than lipschitz
 *            its depth proves nothing: there, after a twentieth behind the surface without a way
 *            out. +infinity where the ray only grazes */
typedef struct survey_truth {
    double t, through;
} survey_truth;

/* The sum over some rays. Where the truth is through a surface beyond doubt,
 *   lost      missed it or hit behind it
 *   doubtful  hit behind it, but said so: SPT_FLAG_STEEP, "not certainly the first". Only fields
 *             that are no distance bounds have such rays
 * A ray that ran out of budget is undecided and counts as SPT_LIMIT only. */
typedef struct survey {
    uint64_t rays, evaluations, fallbacks, lost, doubtful, steep, outcomes[SPT_OUTCOMES];
} survey;

/* The truth for count rays of a scene, for the tolerances of the settings; up to 10000 evaluations
 * a ray. */
void survey_find_truth(const scene *shown, const spt_settings *settings, size_t count,
                       const spt_ray *rays, survey_truth *truth);

/* Traces the rays and adds them up; nothing but zeros where spt_trace refuses. truth may be NULL,
 * then lost and doubtful stay 0; hits receives count hits. */
survey survey_trace(const scene *shown, const spt_settings *settings, size_t count,
                    const spt_ray *rays, const survey_truth *truth, spt_hit *hits);

/* Evaluations a ray. */
double survey_mean(const survey *sum);

#endif
