/* SPDX-License-Identifier: MIT
 *
 * scene_solids.h as GLSL. */
#ifndef EXAMPLES_SCENE_SOLIDS_GLSL_H
#define EXAMPLES_SCENE_SOLIDS_GLSL_H

#define GLSL_sphere "    return spt_sphere(p, 1.0);\n"
#define GLSL_box "    return spt_box(p, vec3(1.0, 0.7, 0.85));\n"
#define GLSL_plane "    return p.y;\n"
#define GLSL_thin_torus "    return spt_torus(p, 1.0, 0.05);\n"
#define GLSL_hollow_box \
    "    float outer = spt_box(p, vec3(1.0, 0.7, 0.85));\n" \
    "    float inner = spt_box(p - vec3(0.0, 0.5, 0.0), vec3(0.97, 1.17, 0.82));\n" \
    "    return spt_difference(outer, inner);\n"

#endif
