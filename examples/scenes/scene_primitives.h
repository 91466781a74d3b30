/* SPDX-License-Identifier: MIT
 *
 * 21 exact primitives on a ground plane, hard union: what a modeller's scene costs. Five boxes,
 * five balls, three tori, two cylinders, four capsules and two rounded boxes. */
#ifndef EXAMPLES_SCENE_PRIMITIVES_H
#define EXAMPLES_SCENE_PRIMITIVES_H

#include "scene_primitives.glsl.h"
#include "scene_source.h"

/* A stepped plinth with a ring and a ball over it, between two columns under a beam. */
SPT_SHAPE spt_real primitives_plinth(spt_point p) {
    return spt_box(from(p, 0, 0.2, 0), at(1.5, 0.2, 1.5));
}

SPT_SHAPE spt_real primitives_step(spt_point p) {
    return spt_rounded_box(from(p, 0, 0.65, 0), at(0.95, 0.25, 0.95), real(0.1));
}

SPT_SHAPE spt_real primitives_collar(spt_point p) {
    return spt_torus(from(p, 0, 0.98, 0), real(0.7), real(0.12));
}

SPT_SHAPE spt_real primitives_globe(spt_point p) {
    return spt_sphere(from(p, 0, 1.55, 0), real(0.62));
}

SPT_SHAPE spt_real primitives_left_column(spt_point p) {
    return spt_cylinder(from(p, -2.6, 1.5, -0.6), real(1.5), real(0.3));
}

SPT_SHAPE spt_real primitives_right_column(spt_point p) {
    return spt_cylinder(from(p, 2.6, 1.5, -0.6), real(1.5), real(0.3));
}

SPT_SHAPE spt_real primitives_beam(spt_point p) {
    return spt_box(from(p, 0, 3.12, -0.6), at(3.1, 0.12, 0.4));
}

SPT_SHAPE spt_real primitives_middle(spt_point p) {
    spt_real d = primitives_plinth(p);
    d = spt_union(d, primitives_step(p));
    d = spt_union(d, primitives_collar(p));
    d = spt_union(d, primitives_globe(p));
    d = spt_union(d, primitives_left_column(p));
    d = spt_union(d, primitives_right_column(p));
    return spt_union(d, primitives_beam(p));
}

/* Before it, low things. */
SPT_SHAPE spt_real primitives_large_ball(spt_point p) {
    return spt_sphere(from(p, -1.9, 0.35, 1.9), real(0.35));
}

SPT_SHAPE spt_real primitives_small_ball(spt_point p) {
    return spt_sphere(from(p, -1.15, 0.22, 2.3), real(0.22));
}

SPT_SHAPE spt_real primitives_ringed_ball(spt_point p) {
    return spt_sphere(from(p, 2.35, 0.45, 1.5), real(0.45));
}

SPT_SHAPE spt_real primitives_loose_ring(spt_point p) {
    return spt_torus(from(p, 0.75, 0.13, 2.45), real(0.42), real(0.13));
}

SPT_SHAPE spt_real primitives_ring(spt_point p) {
    return spt_torus(from(p, 2.35, 0.08, 1.5), real(0.62), real(0.08));
}

SPT_SHAPE spt_real primitives_log(spt_point p) {
    return spt_capsule(p, at(-3.3, 0.16, 0.5), at(-2.7, 0.16, 1.5), real(0.16));
}

SPT_SHAPE spt_real primitives_die(spt_point p) {
    return spt_rounded_box(from(p, -3.1, 0.3, 2.1), at(0.3, 0.3, 0.3), real(0.08));
}

SPT_SHAPE spt_real primitives_front(spt_point p) {
    spt_real d = primitives_large_ball(p);
    d = spt_union(d, primitives_small_ball(p));
    d = spt_union(d, primitives_ringed_ball(p));
    d = spt_union(d, primitives_loose_ring(p));
    d = spt_union(d, primitives_ring(p));
    d = spt_union(d, primitives_log(p));
    return spt_union(d, primitives_die(p));
}

/* And behind. */
SPT_SHAPE spt_real primitives_pedestal(spt_point p) {
    return spt_box(from(p, -4.4, 0.9, -1.6), at(0.5, 0.9, 0.5));
}

SPT_SHAPE spt_real primitives_chest(spt_point p) {
    return spt_box(from(p, 4.5, 0.6, -1.8), at(0.7, 0.6, 0.6));
}

SPT_SHAPE spt_real primitives_lid(spt_point p) {
    return spt_box(from(p, 4.5, 1.45, -1.8), at(0.4, 0.25, 0.4));
}

SPT_SHAPE spt_real primitives_pedestal_ball(spt_point p) {
    return spt_sphere(from(p, -4.4, 2.25, -1.6), real(0.45));
}

SPT_SHAPE spt_real primitives_leaning_pole(spt_point p) {
    return spt_capsule(p, at(3.9, 0.14, 0.3), at(4.3, 1.9, -1), real(0.14));
}

SPT_SHAPE spt_real primitives_left_brace(spt_point p) {
    return spt_capsule(p, at(-1.6, 0.12, -2.6), at(0, 2.7, -2.9), real(0.12));
}

SPT_SHAPE spt_real primitives_right_brace(spt_point p) {
    return spt_capsule(p, at(1.6, 0.12, -2.6), at(0, 2.7, -2.9), real(0.12));
}

SPT_SHAPE spt_real primitives_back(spt_point p) {
    spt_real d = primitives_pedestal(p);
    d = spt_union(d, primitives_chest(p));
    d = spt_union(d, primitives_lid(p));
    d = spt_union(d, primitives_pedestal_ball(p));
    d = spt_union(d, primitives_leaning_pole(p));
    d = spt_union(d, primitives_left_brace(p));
    return spt_union(d, primitives_right_brace(p));
}

SPT_SHAPE spt_real primitives_ground(spt_point p) {
    return p.y;
}

SPT_SHAPE spt_real scene_primitives_distance(spt_point p) {
    const spt_real near = spt_union(primitives_middle(p), primitives_front(p));
    return spt_union(spt_union(near, primitives_back(p)), primitives_ground(p));
}

#endif

#ifdef SCENE
SCENE(primitives, .description = "21 primitives and a ground plane", .lipschitz = 1,
      .eye = {1.7, 3.5, 9.9}, .target = {0.15, 1.2, 0}, .field_of_view = 52, .t_max = 60)
#endif

#ifdef PART
PART(primitives, plinth, .flags = SPT_FIELD_CONVEX, .extent = BOX(-1.5, 0, -1.5, 1.5, 0.4, 1.5))
PART(primitives, step, .flags = SPT_FIELD_CONVEX, .extent = BOX(-0.95, 0.4, -0.95, 0.95, 0.9, 0.95))
PART(primitives, collar, .extent = BOX(-0.82, 0.86, -0.82, 0.82, 1.1, 0.82))
PART(primitives, globe, .flags = SPT_FIELD_CONVEX, .extent = BALL(0, 1.55, 0, 0.62))
PART(primitives, left_column, .flags = SPT_FIELD_CONVEX,
     .extent = BOX(-2.9, 0, -0.9, -2.3, 3, -0.3))
PART(primitives, right_column, .flags = SPT_FIELD_CONVEX, .extent = BOX(2.3, 0, -0.9, 2.9, 3, -0.3))
PART(primitives, beam, .flags = SPT_FIELD_CONVEX, .extent = BOX(-3.1, 3, -1, 3.1, 3.24, -0.2))
PART(primitives, large_ball, .flags = SPT_FIELD_CONVEX, .extent = BALL(-1.9, 0.35, 1.9, 0.35))
PART(primitives, small_ball, .flags = SPT_FIELD_CONVEX, .extent = BALL(-1.15, 0.22, 2.3, 0.22))
PART(primitives, ringed_ball, .flags = SPT_FIELD_CONVEX, .extent = BALL(2.35, 0.45, 1.5, 0.45))
PART(primitives, loose_ring, .extent = BOX(0.2, 0, 1.9, 1.3, 0.26, 3))
PART(primitives, ring, .extent = BOX(1.65, 0, 0.8, 3.05, 0.16, 2.2))
PART(primitives, log, .flags = SPT_FIELD_CONVEX, .extent = BOX(-3.46, 0, 0.34, -2.54, 0.32, 1.66))
PART(primitives, die, .flags = SPT_FIELD_CONVEX, .extent = BOX(-3.4, 0, 1.8, -2.8, 0.6, 2.4))
PART(primitives, pedestal, .flags = SPT_FIELD_CONVEX, .extent = BOX(-4.9, 0, -2.1, -3.9, 1.8, -1.1))
PART(primitives, chest, .flags = SPT_FIELD_CONVEX, .extent = BOX(3.8, 0, -2.4, 5.2, 1.2, -1.2))
PART(primitives, lid, .flags = SPT_FIELD_CONVEX, .extent = BOX(4.1, 1.2, -2.2, 4.9, 1.7, -1.4))
PART(primitives, pedestal_ball, .flags = SPT_FIELD_CONVEX, .extent = BALL(-4.4, 2.25, -1.6, 0.45))
PART(primitives, leaning_pole, .flags = SPT_FIELD_CONVEX,
     .extent = BOX(3.76, 0, -1.14, 4.44, 2.04, 0.44))
PART(primitives, left_brace, .flags = SPT_FIELD_CONVEX,
     .extent = BOX(-1.72, 0, -3.02, 0.12, 2.82, -2.48))
PART(primitives, right_brace, .flags = SPT_FIELD_CONVEX,
     .extent = BOX(-0.12, 0, -3.02, 1.72, 2.82, -2.48))
PART(primitives, ground, .flags = SPT_FIELD_CONVEX)
#endif
