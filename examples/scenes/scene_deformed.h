/* SPDX-License-Identifier: MIT
 *
 * Space deformed: a twisted tower, a bent bridge and a repeated colonnade. Twist and bend stretch
 * space the more the farther from their axis, so that these two keep their Lipschitz constants only
 * inside their bounds. */
#ifndef EXAMPLES_SCENE_DEFORMED_H
#define EXAMPLES_SCENE_DEFORMED_H

#include "scene_source.h"

#define TWISTED_RATE 0.8
#define TWISTED_REACH 1.9092 /* from the axis to an upright edge of the bound, 1.35 sqrt(2) */
#define BENT_RATE -0.4
#define BENT_REACH 2.6401 /* from the axis to the lower edges of the bound, |(2.1, 1.6)| */

/* A fluted tower: a box with grooves, twisted, on a round plinth. */
SPT_SHAPE spt_real scene_twisted_distance(spt_point p) {
    const spt_point q = spt_twist(p, real(TWISTED_RATE));
    const spt_point folded = spt_point_of(spt_magnitude(q.x), q.y, spt_magnitude(q.z));
    const spt_real tower = spt_rounded_box(q, at(0.62, 1.9, 0.62), real(0.08));
    const spt_real groove_x = spt_sphere(spt_point_of(folded.x - real(0.75), 0, q.z), real(0.28));
    const spt_real groove_z = spt_sphere(spt_point_of(q.x, 0, folded.z - real(0.75)), real(0.28));
    const spt_real grooves = spt_union(groove_x, groove_z);
    const spt_real plinth = spt_cylinder(from(p, 0, -2, 0), real(0.15), real(1.3));
    return spt_union(spt_smooth_difference(tower, grooves, real(0.06)), plinth);
}

/* A bridge bent down to its ends: a slab with a railing of balls between two rails. The balls are
 * symmetric in their cells, which makes the repetition right across the borders. */
SPT_SHAPE spt_real scene_bent_distance(spt_point p) {
    const spt_point q = spt_bend(p, real(BENT_RATE));
    const spt_point side = spt_point_of(q.x, q.y, spt_magnitude(q.z) - real(0.7));
    const spt_real deck = spt_rounded_box(q, at(2.2, 0.12, 0.85), real(0.05));
    const spt_point cell = spt_repeat(from(side, 0, 0.3, 0), at(0.4, 0, 0));
    const spt_real posts = spt_box(cell, at(0.06, 0.26, 0.06));
    const spt_real row = spt_intersection(spt_union(posts, spt_sphere(cell, real(0.12))),
                                          spt_magnitude(q.x) - real(2.1));
    const spt_real rail = spt_rounded_box(from(side, 0, 0.58, 0), at(2.2, 0.07, 0.1), real(0.05));
    return spt_union(deck, spt_union(row, rail));
}

/* Columns with rings on a floor, for ever. Each is symmetric in its cell. */
SPT_SHAPE spt_real scene_repeated_distance(spt_point p) {
    const spt_point q = spt_repeat(p, at(2.4, 0, 2.4));
    spt_real d = spt_capsule(q, at(0, 0, 0), at(0, 1.6, 0), real(0.28));
    d = spt_union(d, spt_torus(from(q, 0, 1.15, 0), real(0.5), real(0.1)));
    d = spt_union(d, spt_torus(from(q, 0, 0.12, 0), real(0.7), real(0.12)));
    d = spt_union(d, spt_sphere(from(q, 0, 2.1, 0), real(0.4)));
    return spt_union(d, p.y);
}

#endif

#ifdef SCENE
/* spt_twist_lipschitz(0.8, reach) = (a + sqrt(a^2 + 4)) / 2, a = 0.8 reach */
SCENE(twisted, .description = "twisted tower", .lipschitz = 2.02202f,
      .bound = BOX(-1.35f, -2.2f, -1.35f, 1.35f, 1.95f, 1.35f), .eye = {2.3, 2.7, 8.7},
      .target = {0, -0.15, 0}, .field_of_view = 45, .t_max = 40)
/* spt_bend_lipschitz(0.4, reach) = 1 + 0.4 reach */
SCENE(bent, .description = "bent bridge", .lipschitz = 2.0561f,
      .bound = BOX(-2.1f, -1.6f, -0.9f, 2.1f, 0.75f, 0.9f), .eye = {2.7, 1.7, 5.3},
      .target = {0, -0.5, 0}, .field_of_view = 48, .t_max = 40)
SCENE(repeated, .description = "columns and rings, repeated for ever", .lipschitz = 1,
      .eye = {1.2, 3.7, 8.4}, .target = {0.5, 0.4, 0}, .field_of_view = 55, .t_max = 60)
#endif
