/* SPDX-License-Identifier: MIT
 *
 * scene_textured.h as GLSL. */
#ifndef EXAMPLES_SCENE_TEXTURED_GLSL_H
#define EXAMPLES_SCENE_TEXTURED_GLSL_H

#define GLSL_textured \
    "    float belly = spt_sphere(p - vec3(0.0, -0.15, 0.0), 0.8);\n" \
    "    float brim = spt_torus(p - vec3(0.0, -0.1, 0.0), 1.05, 0.16);\n" \
    "    float neck = spt_capsule(p, vec3(0.0, 0.5, 0.0), vec3(0.0, 1.15, 0.0), 0.16);\n" \
    "    float knob = spt_sphere(p - vec3(0.0, 1.2, 0.0), 0.3);\n" \
    "    float foot = spt_torus(p - vec3(0.0, -1.05, 0.0), 0.5, 0.14);\n" \
    "    float body = spt_smooth_union(spt_smooth_union(belly, brim, 0.35), foot, 0.35);\n" \
    "    return spt_smooth_union(spt_smooth_union(body, neck, 0.35), knob, 0.2);\n"

#define GLSL_silhouette \
    "    vec3 q = abs(p);\n" \
    "    float middle = spt_sphere(p, 0.8);\n" \
    "    float across = spt_capsule(q, vec3(0.0), vec3(1.8, 0.0, 0.0), 0.25);\n" \
    "    float up = spt_capsule(q, vec3(0.0), vec3(0.0, 1.8, 0.0), 0.25);\n" \
    "    float along = spt_capsule(q, vec3(0.0), vec3(0.0, 0.0, 1.8), 0.25);\n" \
    "    float arms = spt_union(spt_union(across, up), along);\n" \
    "    return spt_union(spt_smooth_union(middle, arms, 0.3), p.y + 2.6);\n"

#endif
