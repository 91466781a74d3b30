/* SPDX-License-Identifier: MIT
 *
 * shadow.c and ambient.c as GLSL. */
#ifndef SPTI_LIGHT_GLSL_H
#define SPTI_LIGHT_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_light[] = {
    {"spt_penumbra",
     "// How much of a light of that tangent of its angular radius a shadow ray sees past what it\n"
     "// misses (Szecsi et al. 2016, section 8.5).\n"
     "float spt_penumbra(int outcome, float candidate_ratio, float tangent) {\n"
     "    $precise float seen = candidate_ratio / tangent;\n"
     "    return outcome == $miss || outcome == $limit ? min(seen, 1.0) : 0.0;\n"
     "}\n"},
    {"spt_soft_shadow",
     "// Visibility of a light at ray.t_max, from 0 to 1, smoothed.\n"
     "float spt_soft_shadow(SptRay ray, float tangent, int budget) {\n"
     "    SptHit hit = spt_trace_shadow(ray, budget);\n"
     "    float seen = spt_penumbra(hit.outcome, hit.candidate_ratio, tangent);\n"
     "    $precise float smoothed = seen * seen * (3.0 - 2.0 * seen);\n"
     "    return smoothed;\n"
     "}\n"},
    {"spt_ambient_occlusion",
     "// Openness, 1 above a plane and 0 in a closed gap: samples of the distance along the\n"
     "// normal, `spacing` apart (Evans 2006).\n"
     "float spt_ambient_occlusion(vec3 p, vec3 normal, float spacing, int samples) {\n"
     "    float weight = 1.0, weights = 0.0;\n"
     "    $precise float sum = 0.0;\n"
     "    for (int i = 1 + $zero; i <= samples; ++i) {\n"
     "        $precise float t = float(i) * spacing;\n"
     "        $precise vec3 q = p + t * normal;\n"
     "        $precise float ratio = spt_scene_distance(q) / t;\n"
     "        float open = ratio > 0.0 ? min(ratio, 1.0) : 0.0;\n"
     "        weight *= 0.5;\n"
     "        float share = float(i) * weight;\n"
     "        sum += share * open;\n"
     "        weights += share;\n"
     "    }\n"
     "    return sum / weights;\n"
     "}\n"},
};

#endif
