/* SPDX-License-Identifier: MIT
 *
 * landing.c as GLSL: what the other texts of this room ask of a ray and its hit. */
#ifndef SPTI_LANDING_GLSL_H
#define SPTI_LANDING_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_landing[] = {
    {"spt_span", "// The length of a direction, world length for a unit of t.\n"
                 "float spt_span(vec3 d) {\n"
                 "    $precise float span = sqrt((d.x * d.x + d.y * d.y) + d.z * d.z);\n"
                 "    return span;\n"
                 "}\n"},
    {"spt_travelled", "// The world length up to t, and so the path of rays that begin there.\n"
                      "float spt_travelled(SptRay ray, float t) {\n"
                      "    $precise float way = spt_span(ray.direction) * t;\n"
                      "[path]    $precise float travelled = ray.path + way;\n"
                      "[path]    return travelled;\n"
                      "[!path]    return way;\n"
                      "}\n"},
    {"spt_world_tolerance",
     "// What counts as reached, world length: the largest of epsilon, the pixel cone, and what\n"
     "// float resolves at coordinates of that magnitude.\n"
     "float spt_world_tolerance($Pfloat travelled, float magnitude) {\n"
     "[!sized]    $precise float tolerance = 2.38418579e-7 * magnitude;\n"
     "[sized]    $precise float tolerance = 2.38418579e-7 * magnitude + $S;\n"
     "[pixel]    $precise float cone = $pixel_radius * travelled;\n"
     "[pixel]    tolerance = max(cone, tolerance);\n"
     "    return max($epsilon, tolerance);\n"
     "}\n"},
    {"spt_hit_tolerance", "// The tolerance that a ray has at its hit.\n"
                          "float spt_hit_tolerance($PSptRay ray, float t) {\n"
                          "    vec3 o = ray.origin;\n"
                          "    float reach = max(max(abs(o.x), abs(o.y)), abs(o.z));\n"
                          "    $precise float way = spt_span(ray.direction) * t;\n"
                          "    return spt_world_tolerance($Cspt_travelled(ray, t), reach + way);\n"
                          "}\n"},
};

#endif
