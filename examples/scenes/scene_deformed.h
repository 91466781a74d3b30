/* SPDX-License-Identifier: MIT
 *
 * Space deformed: a twisted tower, a bent bridge and a repeated colonnade. Twist and bend stretch
 * space the more the farther from their axis, so that these two keep their Lipschitz constants only
 * inside their bounds. */
#ifndef EXAMPLES_SCENE_DEFORMED_H
#define EXAMPLES_SCENE_DEFORMED_H

#include "scene_deformed.glsl.h"
#include "scene_source.h"

#define TWISTED_RATE 0.8
#define TWISTED_REACH 1.9092       /* from the axis to an upright edge of the bound, 1.35 sqrt(2) */
#define TWISTED_TOWER_REACH 1.1936 /* likewise for the bound of the tower alone, 0.844 sqrt(2) */
#define BENT_RATE -0.4
#define BENT_REACH 2.6401 /* from the axis to the lower edges of the bound, |(2.1, 1.6)| */

/* A fluted tower: a box with grooves, twisted, on a round plinth. */
SPT_SHAPE spt_real twisted_tower(spt_point p) {
    const spt_point q = spt_twist(p, real(TWISTED_RATE));
    const spt_point folded = spt_point_of(spt_magnitude(q.x), q.y, spt_magnitude(q.z));
    const spt_real tower = spt_rounded_box(q, at(0.62, 1.9, 0.62), real(0.08));
    const spt_real groove_x = spt_sphere(spt_point_of(folded.x - real(0.75), 0, q.z), real(0.28));
    const spt_real groove_z = spt_sphere(spt_point_of(q.x, 0, folded.z - real(0.75)), real(0.28));
    const spt_real grooves = spt_union(groove_x, groove_z);
    return spt_smooth_difference(tower, grooves, real(0.06));
}

SPT_SHAPE spt_real twisted_plinth(spt_point p) {
    return spt_cylinder(from(p, 0, -2, 0), real(0.15), real(1.3));
}

SPT_SHAPE spt_real scene_twisted_distance(spt_point p) {
    const spt_real tower = twisted_tower(p);
    return spt_union(tower, twisted_plinth(p));
}

/* A bridge bent down to its ends: a slab with a railing of balls between two rails. The balls are
 * symmetric in their cells, which makes the repetition right across the borders. */
SPT_SHAPE spt_real bent_deck_of(spt_point q) {
    return spt_rounded_box(q, at(2.2, 0.12, 0.85), real(0.05));
}

/* A point as the railing sees it, of which there is one on each side. */
SPT_SHAPE spt_point bent_side(spt_point q) {
    return spt_point_of(q.x, q.y, spt_magnitude(q.z) - real(0.7));
}

SPT_SHAPE spt_real bent_row_of(spt_point q) {
    const spt_point cell = spt_repeat(from(bent_side(q), 0, 0.3, 0), at(0.4, 0, 0));
    const spt_real posts = spt_box(cell, at(0.06, 0.26, 0.06));
    return spt_intersection(spt_union(posts, spt_sphere(cell, real(0.12))),
                            spt_magnitude(q.x) - real(2.1));
}

SPT_SHAPE spt_real bent_rail_of(spt_point q) {
    return spt_rounded_box(from(bent_side(q), 0, 0.58, 0), at(2.2, 0.07, 0.1), real(0.05));
}

SPT_SHAPE spt_real scene_bent_distance(spt_point p) {
    const spt_point q = spt_bend(p, real(BENT_RATE));
    return spt_union(bent_deck_of(q), spt_union(bent_row_of(q), bent_rail_of(q)));
}

SPT_SHAPE spt_real bent_deck(spt_point p) {
    return bent_deck_of(spt_bend(p, real(BENT_RATE)));
}

SPT_SHAPE spt_real bent_row(spt_point p) {
    return bent_row_of(spt_bend(p, real(BENT_RATE)));
}

SPT_SHAPE spt_real bent_rail(spt_point p) {
    return bent_rail_of(spt_bend(p, real(BENT_RATE)));
}

/* Columns with rings on a floor, for ever. Each is symmetric in its cell. */
SPT_SHAPE spt_point repeated_cell(spt_point p) {
    return spt_repeat(p, at(2.4, 0, 2.4));
}

SPT_SHAPE spt_real repeated_shaft_of(spt_point q) {
    return spt_capsule(q, at(0, 0, 0), at(0, 1.6, 0), real(0.28));
}

SPT_SHAPE spt_real repeated_ring_of(spt_point q) {
    return spt_torus(from(q, 0, 1.15, 0), real(0.5), real(0.1));
}

SPT_SHAPE spt_real repeated_foot_of(spt_point q) {
    return spt_torus(from(q, 0, 0.12, 0), real(0.7), real(0.12));
}

SPT_SHAPE spt_real repeated_ball_of(spt_point q) {
    return spt_sphere(from(q, 0, 2.1, 0), real(0.4));
}

SPT_SHAPE spt_real repeated_ground(spt_point p) {
    return p.y;
}

SPT_SHAPE spt_real scene_repeated_distance(spt_point p) {
    const spt_point q = repeated_cell(p);
    spt_real d = repeated_shaft_of(q);
    d = spt_union(d, repeated_ring_of(q));
    d = spt_union(d, repeated_foot_of(q));
    d = spt_union(d, repeated_ball_of(q));
    return spt_union(d, repeated_ground(p));
}

SPT_SHAPE spt_real repeated_shaft(spt_point p) {
    return repeated_shaft_of(repeated_cell(p));
}

SPT_SHAPE spt_real repeated_ring(spt_point p) {
    return repeated_ring_of(repeated_cell(p));
}

SPT_SHAPE spt_real repeated_foot(spt_point p) {
    return repeated_foot_of(repeated_cell(p));
}

SPT_SHAPE spt_real repeated_ball(spt_point p) {
    return repeated_ball_of(repeated_cell(p));
}

#endif

#ifdef SCENE
/* spt_twist_lipschitz(0.8, reach) = (a + sqrt(a^2 + 4)) / 2, a = 0.8 reach */
SCENE(twisted, .description = "twisted tower", .lipschitz = 2.02202f,
      .bound = BOX(-1.35f, -2.2f, -1.35f, 1.35f, 1.95f, 1.35f), .eye = {2.3, 2.7, 8.7},
      .target = {0, -0.15, 0}, .field_of_view = 45, .t_max = 40,
      .glsl_prelude = TWISTED_GLSL_PRELUDE)
/* spt_bend_lipschitz(0.4, reach) = 1 + 0.4 reach */
SCENE(bent, .description = "bent bridge", .lipschitz = 2.0561f,
      .bound = BOX(-2.1f, -1.6f, -0.9f, 2.1f, 0.75f, 0.9f), .eye = {2.7, 1.7, 5.3},
      .target = {0, -0.5, 0}, .field_of_view = 48, .t_max = 40, .glsl_prelude = BENT_GLSL_PRELUDE)
SCENE(repeated, .description = "columns and rings, repeated for ever", .lipschitz = 1,
      .eye = {1.2, 3.7, 8.4}, .target = {0.5, 0.4, 0}, .field_of_view = 55, .t_max = 60)
#endif

#ifdef PART
/* Twisted by 1.5 to each side, the corners of the tower come round by all axes. */
PART(twisted, tower, .lipschitz = 1.58568f, .extent = BOX(-0.844, -1.9, -0.844, 0.844, 1.9, 0.844),
     .glsl_prelude = TWISTED_GLSL_PRELUDE)
PART(twisted, plinth, .lipschitz = 1, .flags = SPT_FIELD_CONVEX,
     .extent = BOX(-1.3, -2.15, -1.3, 1.3, -1.85, 1.3))
PART(bent, deck, .extent = BOX(-1.75, -1.44, -0.85, 1.75, 0.12, 0.85),
     .glsl_prelude = BENT_GLSL_PRELUDE)
PART(bent, row, .extent = BOX(-1.89, -1.235, -0.82, 1.89, 0.56, 0.82),
     .glsl_prelude = BENT_GLSL_PRELUDE)
PART(bent, rail, .extent = BOX(-1.99, -1.16, -0.8, 1.99, 0.65, 0.8),
     .glsl_prelude = BENT_GLSL_PRELUDE)
PART(repeated, shaft, .flags = 0)
PART(repeated, ring, .flags = 0)
PART(repeated, foot, .flags = 0)
PART(repeated, ball, .flags = 0)
PART(repeated, ground, .flags = SPT_FIELD_CONVEX)
#endif
