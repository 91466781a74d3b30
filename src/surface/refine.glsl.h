/* SPDX-License-Identifier: MIT
 *
 * refine.c as GLSL. Needs the list of landing.glsl.h before. */
#ifndef SPTI_REFINE_GLSL_H
#define SPTI_REFINE_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_refine[] = {
    {"spt_gap", "// How far f is beyond what the pixel cone allows at t, world length.\n"
                "float spt_gap($PSptRay ray, float t, float f) {\n"
                "    $precise float gap = f * $L;\n"
                "[pixel]    $precise float allowance = $pixel_radius * spt_travelled(ray, t);\n"
                "[pixel]    gap -= allowance;\n"
                "    return gap;\n"
                "}\n"},
    {"spt_refine",
     "// Discontinuity reduction: moves a hit to where f is what the pixel cone allows, so that\n"
     "// normals show no steps between pixels (Keinert et al. 2014, section 3.4, Equation 3). A\n"
     "// move is kept only if it brings f closer: no hit is worse than before.\n"
     "void spt_refine(SptRay ray, inout SptHit hit, int iterations) {\n"
     "    if (hit.outcome != $hit) return;\n"
     "[flags]    if ((hit.flags & $steep) != 0) return;\n"
     "[many]    int component = hit.component;\n"
     "    $precise float apart = hit.residual * $L;\n"
     "    // Where a ray began inside a hit is no root to converge to.\n"
     "    if (!(abs(apart) <= 4.0 * spt_hit_tolerance($Cray, hit.t))) return;\n"
     "    float side = 1.0, span = spt_span(ray.direction);\n"
     "[flags]    if ((hit.flags & $inside) != 0) side = -1.0;\n"
     "    float gap = spt_gap($Cray, hit.t, side * hit.residual);\n"
     "    for (int i = $zero; i < iterations; ++i) {\n"
     "        $precise float most = abs(hit.residual) * $L;\n"
     "[pixel]        $precise float allowance = $pixel_radius * spt_travelled(ray, hit.t);\n"
     "[pixel]        most += allowance;\n"
     "        $precise float aim = hit.t + max(min(gap, most), -most) / span;\n"
     "        float t = max(min(aim, ray.t_max), ray.t_min);\n"
     "        if (t == hit.t) return;\n"
     "        $precise vec3 p = ray.origin + t * ray.direction;\n"
     "        float f = spt_map($Cp);\n"
     "        hit.evaluations += 1;\n"
     "[guards]        if (!spt_is_number(f)) return;\n"
     "        float gap_there = spt_gap($Cray, t, side * f);\n"
     "        if (!(abs(gap_there) < abs(gap))) return;\n"
     "        gap = gap_there;\n"
     "        hit.t = t;\n"
     "        hit.residual = f;\n"
     "    }\n"
     "}\n"},
};

#endif
