/* SPDX-License-Identifier: MIT
 *
 * Single bodies with distances that are known in closed form: a ball, a box, a plane seen at a
 * grazing angle, a thin ring and a box with thin walls. */
#ifndef EXAMPLES_SCENE_SOLIDS_H
#define EXAMPLES_SCENE_SOLIDS_H

#include "scene_solids.glsl.h"
#include "scene_source.h"

SPT_SHAPE spt_real scene_sphere_distance(spt_point p) {
    return spt_sphere(p, 1);
}

SPT_SHAPE spt_real scene_box_distance(spt_point p) {
    return spt_box(p, at(1, 0.7, 0.85));
}

SPT_SHAPE spt_real scene_plane_distance(spt_point p) {
    return p.y;
}

SPT_SHAPE spt_real scene_thin_torus_distance(spt_point p) {
    return spt_torus(p, 1, real(0.05));
}

SPT_SHAPE spt_real scene_hollow_box_distance(spt_point p) {
    const spt_real outer = spt_box(p, at(1, 0.7, 0.85));
    return spt_difference(outer, spt_box(from(p, 0, 0.5, 0), at(0.97, 1.17, 0.82)));
}

#endif

#ifdef SCENE
SCENE(sphere, .description = "ball of radius 1", .lipschitz = 1, .flags = SPT_FIELD_CONVEX,
      .eye = {0.7, 1.1, 3.7}, .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
SCENE(box, .description = "box", .lipschitz = 1, .flags = SPT_FIELD_CONVEX, .eye = {1.9, 1.8, 3.3},
      .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
SCENE(plane, .description = "ground plane from just above it", .lipschitz = 1,
      .flags = SPT_FIELD_CONVEX, .eye = {0, 0.5, 0}, .target = {0, 0, -6}, .field_of_view = 50,
      .t_max = 20)
SCENE(thin_torus, .description = "ring 20 times as wide as thick", .lipschitz = 1,
      .eye = {0.7, 1.3, 2.6}, .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
SCENE(hollow_box, .description = "open box with thin walls", .lipschitz = 1, .eye = {1.6, 2.6, 3.1},
      .target = {0, 0, 0}, .field_of_view = 50, .t_max = 20)
#endif

#ifdef PART
PART_WHOLE(sphere, .extent = BALL(0, 0, 0, 1))
PART_WHOLE(box, .extent = BOX(-1, -0.7, -0.85, 1, 0.7, 0.85))
PART_WHOLE(thin_torus, .extent = BOX(-1.05, -0.05, -1.05, 1.05, 0.05, 1.05))
PART_WHOLE(hollow_box, .extent = BOX(-1, -0.7, -0.85, 1, 0.7, 0.85))
#endif
