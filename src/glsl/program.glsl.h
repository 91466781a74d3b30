/* SPDX-License-Identifier: MIT
 *
 * What main() does for each program, and the pictures. */
#ifndef SPTI_PROGRAM_GLSL_H
#define SPTI_PROGRAM_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_macros[] = {
    {"SPT_PRECISE", "[library]#ifndef SPT_PRECISE\n"
                    "[library]#if __VERSION__ >= 400 || (defined(GL_ES) && __VERSION__ >= 320)\n"
                    "[library]#define SPT_PRECISE precise\n"
                    "[library]#else\n"
                    "[library]#define SPT_PRECISE\n"
                    "[library]#endif\n"
                    "[library]#endif\n"
                    "[!library][exact]#define SPT_PRECISE precise\n"
                    "[!library][!exact]#define SPT_PRECISE\n"},
    /* No compiler knows that it is 0, so that none unrolls the loops that begin at it. */
    {"SPT_ZERO",
     "[library]#ifndef SPT_ZERO\n"
     "[library]#define SPT_ZERO 0 // better: 0 as an expression that no compiler knows\n"
     "[library]#endif\n"
     "[shadertoy]#define SPT_ZERO min(0, iFrame)\n"
     "[!library][!shadertoy]#define SPT_ZERO min(0, $size.x)\n"},
};

static const spti_glsl_piece spti_glsl_cone_pass[] = {
    {"spt_cone_over", "// How far all rays meet nothing through a block of the picture; blocks are "
                      "counted from the top\n"
                      "// where they go to a buffer, from the bottom where they are texels.\n"
                      "float spt_cone_over(ivec2 block, int budget) {\n"
                      "    vec2 size = vec2($size), low = vec2(block * $cone_size);\n"
                      "    vec2 high = min(low + float($cone_size), size);\n"
                      "[compute]    return spt_block_cone(low, high, budget);\n"
                      "[!compute]    return spt_block_cone(vec2(low.x, size.y - high.y), "
                      "vec2(high.x, size.y - low.y), "
                      "budget);\n"
                      "}\n"},
};

static const spti_glsl_piece spti_glsl_picture[] = {
    {"spt_heat",
     "// From dark blue over green and yellow to white: lighter is more, in grey, too.\n"
     "vec3 spt_heat(float share) {\n"
     "    vec3 low = mix(vec3(0.02, 0.02, 0.12), vec3(0.1, 0.25, 0.65), min(share * 4.0, 1.0));\n"
     "    vec3 middle = mix(low, vec3(0.1, 0.6, 0.45), clamp(share * 4.0 - 1.0, 0.0, 1.0));\n"
     "    vec3 high = mix(middle, vec3(0.95, 0.8, 0.25), clamp(share * 4.0 - 2.0, 0.0, 1.0));\n"
     "    return mix(high, vec3(1.0, 0.98, 0.92), clamp(share * 4.0 - 3.0, 0.0, 1.0));\n"
     "}\n"},
    {"spt_colour_of",
     "// A colour for a number: neighbours differ.\n"
     "vec3 spt_colour_of(int number) {\n"
     "    vec3 turns = fract(float(number + 1) * vec3(0.618034, 0.754878, 0.569840));\n"
     "    return 0.25 + 0.6 * turns;\n"
     "}\n"},
    {"spt_sky", "vec3 spt_sky(vec3 direction) {\n"
                "    float up = 0.5 + 0.5 * direction.y / length(direction);\n"
                "    return mix(vec3(0.80, 0.84, 0.88), vec3(0.36, 0.52, 0.74), up);\n"
                "}\n"},
    {"spt_light_at",
     "// The sun, with its shadow, and the sky.\n"
     "vec3 spt_light_at(SptRay ray, SptHit hit, vec3 p, vec3 normal) {\n"
     "    float sun = max(dot(normal, $light), 0.0), open = 1.0;\n"
     "[occlusion]    open = spt_ambient_occlusion(p, normal, $occlusion, $samples);\n"
     "[shadow]    if (sun > 0.0) {\n"
     "[shadow]        SptRay to_light;\n"
     "[shadow]        to_light.origin = spt_offset(ray, hit, normal, false);\n"
     "[shadow]        to_light.t_min = 0.0;\n"
     "[shadow]        to_light.direction = $light;\n"
     "[shadow]        to_light.t_max = min(ray.t_max * spt_span(ray.direction), 1.0e6);\n"
     "[shadow][path]        to_light.path = spt_travelled(ray, hit.t);\n"
     "[shadow]        sun *= spt_soft_shadow(to_light, $light_tangent, $budget);\n"
     "[shadow]    }\n"
     "    vec3 sky = mix(vec3(0.20, 0.19, 0.18), vec3(0.36, 0.43, 0.53), 0.5 + 0.5 * normal.y);\n"
     "    return sun * vec3(1.0, 0.94, 0.84) + open * sky;\n"
     "}\n"},
    {"spt_shade",
     "vec3 spt_shade(SptRay ray, SptHit hit) {\n"
     "    if (hit.outcome == $miss) return spt_sky(ray.direction);\n"
     "    hit.outcome = $hit; // out of budget, it is the best guess\n"
     "    vec3 p = ray.origin + hit.t * ray.direction;\n"
     "    vec3 normal = spt_hit_normal(ray, hit, $detail);\n"
     "[!component]    vec3 colour = vec3(0.72, 0.68, 0.62);\n"
     "[component][!materials]    vec3 colour = spt_colour_of(hit.component);\n"
     "[component][materials]    vec3 colour = spt_colour_of(spt_material(hit.component));\n"
     "    return colour * spt_light_at(ray, hit, p, normal);\n"
     "}\n"},
    {"spt_view_tolerance", "// What counted as reached at a hit, world length.\n"
                           "float spt_view_tolerance(SptRay ray, SptHit hit) {\n"
                           "[many]    return spt_hit_tolerance(hit.component, ray, hit.t);\n"
                           "[!many]    return spt_hit_tolerance(ray, hit.t);\n"
                           "}\n"},
    {"spt_view_of",
     "// What is shown: 0 the scene, 1 evaluations, 2 the residual, 3 outcomes, 4 normals, 5\n"
     "// components.\n"
     "vec3 spt_view_of(SptRay ray, SptHit hit, int view) {\n"
     "    if (view == 1) return spt_heat(float(hit.evaluations) / float($budget));\n"
     "    if (view == 2) {\n"
     "        float tolerance = spt_view_tolerance(ray, hit);\n"
     "        float share = log2(max(abs(hit.residual) / tolerance, 1.0e-6)) / 20.0 + 1.0;\n"
     "        return hit.outcome == $hit ? spt_heat(clamp(share, 0.0, 1.0)) : vec3(0.0);\n"
     "    }\n"
     "    if (view == 3) {\n"
     "        if (hit.outcome == $miss) return vec3(0.16, 0.18, 0.22);\n"
     "        if (hit.outcome == $hit) return vec3(0.36, 0.62, 0.48);\n"
     "        return hit.outcome == $limit ? vec3(0.94, 0.72, 0.22) : vec3(0.85, 0.2, 0.2);\n"
     "    }\n"
     "    if (view == 4 && hit.outcome == $hit) {\n"
     "        return 0.5 + 0.5 * spt_hit_normal(ray, hit, $detail);\n"
     "    }\n"
     "[component]    if (view == 5 && hit.outcome == $hit) return spt_colour_of(hit.component);\n"
     "    return view >= 4 ? vec3(0.1) : sqrt(clamp(spt_shade(ray, hit), 0.0, 1.0));\n"
     "}\n"},
};

#endif
