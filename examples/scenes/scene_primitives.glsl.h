/* SPDX-License-Identifier: MIT
 *
 * scene_primitives.h as GLSL: each body is an expression of p, and the scene their union. */
#ifndef EXAMPLES_SCENE_PRIMITIVES_GLSL_H
#define EXAMPLES_SCENE_PRIMITIVES_GLSL_H

#define GLSL_primitives_plinth "spt_box(p - vec3(0.0, 0.2, 0.0), vec3(1.5, 0.2, 1.5))"
#define GLSL_primitives_step \
    "spt_rounded_box(p - vec3(0.0, 0.65, 0.0), vec3(0.95, 0.25, 0.95), 0.1)"
#define GLSL_primitives_collar "spt_torus(p - vec3(0.0, 0.98, 0.0), 0.7, 0.12)"
#define GLSL_primitives_globe "spt_sphere(p - vec3(0.0, 1.55, 0.0), 0.62)"
#define GLSL_primitives_left_column "spt_cylinder(p - vec3(-2.6, 1.5, -0.6), 1.5, 0.3)"
#define GLSL_primitives_right_column "spt_cylinder(p - vec3(2.6, 1.5, -0.6), 1.5, 0.3)"
#define GLSL_primitives_beam "spt_box(p - vec3(0.0, 3.12, -0.6), vec3(3.1, 0.12, 0.4))"

#define GLSL_primitives_large_ball "spt_sphere(p - vec3(-1.9, 0.35, 1.9), 0.35)"
#define GLSL_primitives_small_ball "spt_sphere(p - vec3(-1.15, 0.22, 2.3), 0.22)"
#define GLSL_primitives_ringed_ball "spt_sphere(p - vec3(2.35, 0.45, 1.5), 0.45)"
#define GLSL_primitives_loose_ring "spt_torus(p - vec3(0.75, 0.13, 2.45), 0.42, 0.13)"
#define GLSL_primitives_ring "spt_torus(p - vec3(2.35, 0.08, 1.5), 0.62, 0.08)"
#define GLSL_primitives_log "spt_capsule(p, vec3(-3.3, 0.16, 0.5), vec3(-2.7, 0.16, 1.5), 0.16)"
#define GLSL_primitives_die "spt_rounded_box(p - vec3(-3.1, 0.3, 2.1), vec3(0.3, 0.3, 0.3), 0.08)"

#define GLSL_primitives_pedestal "spt_box(p - vec3(-4.4, 0.9, -1.6), vec3(0.5, 0.9, 0.5))"
#define GLSL_primitives_chest "spt_box(p - vec3(4.5, 0.6, -1.8), vec3(0.7, 0.6, 0.6))"
#define GLSL_primitives_lid "spt_box(p - vec3(4.5, 1.45, -1.8), vec3(0.4, 0.25, 0.4))"
#define GLSL_primitives_pedestal_ball "spt_sphere(p - vec3(-4.4, 2.25, -1.6), 0.45)"
#define GLSL_primitives_leaning_pole \
    "spt_capsule(p, vec3(3.9, 0.14, 0.3), vec3(4.3, 1.9, -1.0), 0.14)"
#define GLSL_primitives_left_brace \
    "spt_capsule(p, vec3(-1.6, 0.12, -2.6), vec3(0.0, 2.7, -2.9), 0.12)"
#define GLSL_primitives_right_brace \
    "spt_capsule(p, vec3(1.6, 0.12, -2.6), vec3(0.0, 2.7, -2.9), 0.12)"
#define GLSL_primitives_ground "p.y"

/* As groups are formed there: the order of minima decides which of two zeros remains. */
#define PRIMITIVES_FIRST(group, body) "    float " #group " = " GLSL_primitives_##body ";\n"
#define PRIMITIVES_NEXT(group, body) \
    "    " #group " = spt_union(" #group ", " GLSL_primitives_##body ");\n"
#define GLSL_primitives \
    PRIMITIVES_FIRST(middle, plinth) \
    PRIMITIVES_NEXT(middle, step) \
    PRIMITIVES_NEXT(middle, collar) \
    PRIMITIVES_NEXT(middle, globe) \
    PRIMITIVES_NEXT(middle, left_column) \
    PRIMITIVES_NEXT(middle, right_column) \
    PRIMITIVES_NEXT(middle, beam) \
    PRIMITIVES_FIRST(front, large_ball) \
    PRIMITIVES_NEXT(front, small_ball) \
    PRIMITIVES_NEXT(front, ringed_ball) \
    PRIMITIVES_NEXT(front, loose_ring) \
    PRIMITIVES_NEXT(front, ring) \
    PRIMITIVES_NEXT(front, log) \
    PRIMITIVES_NEXT(front, die) \
    PRIMITIVES_FIRST(back, pedestal) \
    PRIMITIVES_NEXT(back, chest) \
    PRIMITIVES_NEXT(back, lid) \
    PRIMITIVES_NEXT(back, pedestal_ball) \
    PRIMITIVES_NEXT(back, leaning_pole) \
    PRIMITIVES_NEXT(back, left_brace) \
    PRIMITIVES_NEXT(back, right_brace) \
    "    return spt_union(spt_union(spt_union(middle, front), back), p.y);\n"

#endif
