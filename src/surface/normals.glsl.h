/* SPDX-License-Identifier: MIT
 *
 * normals.c and differences.c as GLSL: six values. Left out: the caller's own gradients. */
#ifndef SPTI_NORMALS_GLSL_H
#define SPTI_NORMALS_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_normals[] = {
    {"spt_cube_root",
     "// To 1e-3, of a number from 2^-40 to 2^20: a third of the exponent, then Newton's rule.\n"
     "float spt_cube_root(float a) {\n"
     "    $precise float guess = uintBitsToFloat(floatBitsToUint(a) / 3u + 0x2a5137a0u);\n"
     "    guess = (2.0 * guess + a / (guess * guess)) * 0.333333343;\n"
     "    $precise float root = (2.0 * guess + a / (guess * guess)) * 0.333333343;\n"
     "    return root;\n"
     "}\n"},
    {"spt_normal_step",
     "// The step h of the differences. A value of f is off by u C, u = 2^-24 and C the largest\n"
     "// coordinate, which turns the gradient by u C / h; a curvature 1 / R turns it by\n"
     "// (h / R)^2. Both are least at h = (u C R^2)^(1/3). A power of two, so that p + h is not\n"
     "// rounded.\n"
     "//   detail  R, the size of the least features\n"
     "//   least   so long at least: a quarter of the pixel cone's radius\n"
     "float spt_normal_step(vec3 p, float detail, float least) {\n"
     "    float reach = max(max(abs(p.x), abs(p.y)), abs(p.z));\n"
     "    $precise float ratio = reach / detail + 1.0;\n"
     "    $precise float share = 5.96046448e-8 * min(ratio, 1.09951163e12);\n"
     "    $precise float best = max(spt_cube_root(share) * detail, least) * 1.41421354;\n"
     "    float step = spt_power_below(best); // the nearest power\n"
     "    if (step < least) step *= 2.0;\n"
     "    return max(step, spt_power_below(reach) * 1.1920929e-7);\n"
     "}\n"},
    {"spt_unit",
     "// To unit length; 0 where there is none, or a component is not finite. In units of the\n"
     "// power of two below the largest component: then no square over- or underflows.\n"
     "vec3 spt_unit(vec3 v) {\n"
     "    uvec3 bits = floatBitsToUint(v) & 0x7fffffffu;\n"
     "    uint largest = max(max(bits.x, bits.y), bits.z);\n"
     "    if (largest < 0x00800000u || largest >= 0x7f800000u) return vec3(0.0);\n"
     "    float power = min(spt_power_below(uintBitsToFloat(largest)), 8.50705917e37);\n"
     "    $precise vec3 u = v * (1.0 / power);\n"
     "    $precise vec3 unit = u / sqrt((u.x * u.x + u.y * u.y) + u.z * u.z);\n"
     "    return unit;\n"
     "}\n"},
    {"spt_normal",
     "// The unit normal, outward; 0 where there is none: six values of f, in a loop, so that\n"
     "// compilers do not write f out six times.\n"
     "vec3 spt_normal($Pvec3 p, float step) {\n"
     "    $precise vec3 gradient = vec3(0.0);\n"
     "    for (int i = $zero; i < 6; ++i) {\n"
     "        vec3 axis = vec3(equal(ivec3(i >> 1), ivec3(0, 1, 2)));\n"
     "        if ((i & 1) != 0) axis = -axis;\n"
     "        $precise vec3 q = p + step * axis;\n"
     "        gradient += axis * spt_map($Cq);\n"
     "    }\n"
     "    return spt_unit(gradient);\n"
     "}\n"},
    {"spt_hit_normal",
     "// The normal at a hit; 0 for other rays.\n"
     "vec3 spt_hit_normal(SptRay ray, SptHit hit, float detail) {\n"
     "    if (hit.outcome != $hit) return vec3(0.0);\n"
     "[library]    if (!(detail > 0.0)) detail = $detail; // as usual\n"
     "    $precise vec3 p = ray.origin + hit.t * ray.direction;\n"
     "[!pixel]    float least = 0.0;\n"
     "[pixel]    $precise float least = 0.25 * ($pixel_radius * spt_travelled(ray, hit.t));\n"
     "[!many]    return spt_normal(p, spt_normal_step(p, detail, least));\n"
     "[many]    return spt_normal(hit.component, p, spt_normal_step(p, detail, least));\n"
     "}\n"},
};

#endif
