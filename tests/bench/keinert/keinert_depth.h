/* SPDX-License-Identifier: MIT
 *
 * How far hits lie from the surface, in double precision. */
#ifndef TESTS_BENCH_KEINERT_DEPTH_H
#define TESTS_BENCH_KEINERT_DEPTH_H

#include "../truth.h"

/* The way along a ray from a hit to the surface that it came to, by at most 10 000 basic steps in
 * double; negative where the hit is behind it. NAN where the ray only passes by that surface: f
 * rises above the tolerance of the settings before it is 0.
 *   sign  of f before the surface: 1 for rays from outside, -1 for rays from inside
 *   path  that the ray had travelled before */
double keinert_depth(const scene *shown, const spt_settings *settings, const spt_ray *ray,
                     float path, double sign, double t);

#endif
