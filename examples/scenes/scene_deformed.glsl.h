/* SPDX-License-Identifier: MIT
 *
 * scene_deformed.h as GLSL. */
#ifndef EXAMPLES_SCENE_DEFORMED_GLSL_H
#define EXAMPLES_SCENE_DEFORMED_GLSL_H

#define TWISTED_GLSL_PRELUDE \
    "float twisted_tower(vec3 p) {\n" \
    "    vec3 q = spt_twist(p, 0.8);\n" \
    "    float tower = spt_rounded_box(q, vec3(0.62, 1.9, 0.62), 0.08);\n" \
    "    float groove_x = spt_sphere(vec3(abs(q.x) - 0.75, 0.0, q.z), 0.28);\n" \
    "    float groove_z = spt_sphere(vec3(q.x, 0.0, abs(q.z) - 0.75), 0.28);\n" \
    "    return spt_smooth_difference(tower, spt_union(groove_x, groove_z), 0.06);\n" \
    "}\n"
#define GLSL_twisted_tower "twisted_tower(p)"
#define GLSL_twisted_plinth "spt_cylinder(p - vec3(0.0, -2.0, 0.0), 0.15, 1.3)"
#define GLSL_twisted "    return spt_union(" GLSL_twisted_tower ", " GLSL_twisted_plinth ");\n"

#define BENT_GLSL_PRELUDE \
    "float bent_deck(vec3 q) {\n" \
    "    return spt_rounded_box(q, vec3(2.2, 0.12, 0.85), 0.05);\n" \
    "}\n" \
    "\n" \
    "// A point as the railing sees it, of which there is one on each side.\n" \
    "vec3 bent_side(vec3 q) {\n" \
    "    return vec3(q.x, q.y, abs(q.z) - 0.7);\n" \
    "}\n" \
    "\n" \
    "float bent_row(vec3 q) {\n" \
    "    vec3 cell = spt_repeat(bent_side(q) - vec3(0.0, 0.3, 0.0), vec3(0.4, 0.0, 0.0));\n" \
    "    float posts = spt_box(cell, vec3(0.06, 0.26, 0.06));\n" \
    "    return spt_intersection(spt_union(posts, spt_sphere(cell, 0.12)), abs(q.x) - 2.1);\n" \
    "}\n" \
    "\n" \
    "float bent_rail(vec3 q) {\n" \
    "    vec3 above = bent_side(q) - vec3(0.0, 0.58, 0.0);\n" \
    "    return spt_rounded_box(above, vec3(2.2, 0.07, 0.1), 0.05);\n" \
    "}\n"
#define GLSL_bent_deck "bent_deck(spt_bend(p, -0.4))"
#define GLSL_bent_row "bent_row(spt_bend(p, -0.4))"
#define GLSL_bent_rail "bent_rail(spt_bend(p, -0.4))"
#define GLSL_bent \
    "    vec3 q = spt_bend(p, -0.4);\n" \
    "    return spt_union(bent_deck(q), spt_union(bent_row(q), bent_rail(q)));\n"

#define REPEATED_CELL "spt_repeat(p, vec3(2.4, 0.0, 2.4))"
#define REPEATED_SHAFT(q) "spt_capsule(" q ", vec3(0.0), vec3(0.0, 1.6, 0.0), 0.28)"
#define REPEATED_RING(q) "spt_torus(" q " - vec3(0.0, 1.15, 0.0), 0.5, 0.1)"
#define REPEATED_FOOT(q) "spt_torus(" q " - vec3(0.0, 0.12, 0.0), 0.7, 0.12)"
#define REPEATED_BALL(q) "spt_sphere(" q " - vec3(0.0, 2.1, 0.0), 0.4)"
#define GLSL_repeated_shaft REPEATED_SHAFT(REPEATED_CELL)
#define GLSL_repeated_ring REPEATED_RING(REPEATED_CELL)
#define GLSL_repeated_foot REPEATED_FOOT(REPEATED_CELL)
#define GLSL_repeated_ball REPEATED_BALL(REPEATED_CELL)
#define GLSL_repeated_ground "p.y"
#define GLSL_repeated \
    "    vec3 q = " REPEATED_CELL ";\n" \
    "    float d = " REPEATED_SHAFT( \
        "q") ";\n" \
             "    d = spt_union(d, " REPEATED_RING( \
                 "q") ");\n" \
                      "    d = spt_union(d, " REPEATED_FOOT( \
                          "q") ");\n" \
                               "    d = spt_union(d, " REPEATED_BALL( \
                                   "q") ");\n" \
                                        "    return spt_union(d, p.y);\n"

#endif
