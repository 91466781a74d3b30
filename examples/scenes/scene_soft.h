/* SPDX-License-Identifier: MIT
 *
 * Smooth forms: two bodies blended, a ball with bumps whose slope exceeds 1, and blends on a
 * floor. */
#ifndef EXAMPLES_SCENE_SOFT_H
#define EXAMPLES_SCENE_SOFT_H

#include "scene_soft.glsl.h"
#include "scene_source.h"

SPT_SHAPE spt_real scene_smooth_union_distance(spt_point p) {
    const spt_real ball = spt_sphere(from(p, 0.55, 0.45, 0.1), real(0.65));
    const spt_real block = spt_box(from(p, -0.4, -0.3, 0), at(0.6, 0.45, 0.5));
    return spt_smooth_union(ball, block, real(0.5));
}

/* Bumps of height h = 0.06 and wave number w = 10: h sin(w x) sin(w y) sin(w z) has a slope of at
 * most h w. (Its square is multilinear in the squares of the sines, so greatest where each of them
 * is 0 or 1: one 0, two 1.) So the whole has a slope of at most 1 + h w = 1.6. */
SPT_SHAPE spt_real scene_bumpy_ball_distance(spt_point p) {
    const spt_real wave = 10;
    const spt_real bumps = spt_sin(wave * p.x) * spt_sin(wave * p.y) * spt_sin(wave * p.z);
    return spt_sphere(p, 1) + real(0.06) * bumps;
}

SPT_SHAPE spt_real scene_blended_distance(spt_point p) {
    const spt_real k = real(0.6);
    spt_real d = p.y;
    d = spt_smooth_union(d, spt_sphere(from(p, -1.5, 0.85, -0.3), real(0.7)), k);
    d = spt_smooth_union(d, spt_capsule(p, at(0.1, 0, -0.9), at(0.35, 1.9, -0.7), real(0.3)), k);
    d = spt_smooth_union(d, spt_sphere(from(p, 0.35, 2.05, -0.7), real(0.5)), real(0.3));
    d = spt_smooth_union(d, spt_torus(from(p, 0.15, 0.25, 0.95), real(0.75), real(0.16)), k);
    d = spt_smooth_union(d, spt_rounded_box(from(p, 1.9, 0.55, 0.1), at(0.5, 0.5, 0.5), real(0.1)),
                         k);
    return spt_smooth_difference(d, spt_sphere(from(p, 1.9, 1.15, 0.1), real(0.45)), real(0.2));
}

#endif

#ifdef SCENE
SCENE(smooth_union, .description = "ball and box, blended", .lipschitz = 1, .eye = {1.1, 1.4, 3.6},
      .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
SCENE(bumpy_ball, .description = "ball with bumps, steeper than a distance", .lipschitz = 1.6f,
      .eye = {0.7, 1.1, 3.7}, .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
SCENE(blended, .description = "bodies that grow smoothly out of a floor", .lipschitz = 1,
      .eye = {0.8, 3.1, 6.6}, .target = {0.2, 0.8, 0}, .field_of_view = 50, .t_max = 40)
#endif

#ifdef PART
/* The box of ball and block, wider by what a blend adds at most, a quarter of 0.5. */
PART_WHOLE(smooth_union, .extent = BOX(-1.125, -0.875, -0.675, 1.325, 1.225, 0.875))
PART_WHOLE(bumpy_ball, .extent = BALL(0, 0, 0, 1.06))
#endif
