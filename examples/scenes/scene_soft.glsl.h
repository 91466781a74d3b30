/* SPDX-License-Identifier: MIT
 *
 * scene_soft.h as GLSL. */
#ifndef EXAMPLES_SCENE_SOFT_GLSL_H
#define EXAMPLES_SCENE_SOFT_GLSL_H

#define GLSL_smooth_union \
    "    float ball = spt_sphere(p - vec3(0.55, 0.45, 0.1), 0.65);\n" \
    "    float block = spt_box(p - vec3(-0.4, -0.3, 0.0), vec3(0.6, 0.45, 0.5));\n" \
    "    return spt_smooth_union(ball, block, 0.5);\n"

#define GLSL_bumpy_ball \
    "    SPT_PRECISE float bumps = spt_sin(10.0 * p.x) * spt_sin(10.0 * p.y) *\n" \
    "                              spt_sin(10.0 * p.z);\n" \
    "    SPT_PRECISE float d = spt_sphere(p, 1.0) + 0.06 * bumps;\n" \
    "    return d;\n"

#define GLSL_blended \
    "    float d = p.y;\n" \
    "    d = spt_smooth_union(d, spt_sphere(p - vec3(-1.5, 0.85, -0.3), 0.7), 0.6);\n" \
    "    float neck = spt_capsule(p, vec3(0.1, 0.0, -0.9), vec3(0.35, 1.9, -0.7), 0.3);\n" \
    "    d = spt_smooth_union(d, neck, 0.6);\n" \
    "    d = spt_smooth_union(d, spt_sphere(p - vec3(0.35, 2.05, -0.7), 0.5), 0.3);\n" \
    "    d = spt_smooth_union(d, spt_torus(p - vec3(0.15, 0.25, 0.95), 0.75, 0.16), 0.6);\n" \
    "    float die = spt_rounded_box(p - vec3(1.9, 0.55, 0.1), vec3(0.5, 0.5, 0.5), 0.1);\n" \
    "    d = spt_smooth_union(d, die, 0.6);\n" \
    "    return spt_smooth_difference(d, spt_sphere(p - vec3(1.9, 1.15, 0.1), 0.45), 0.2);\n"

#endif
