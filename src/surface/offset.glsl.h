/* SPDX-License-Identifier: MIT
 *
 * offset.c as GLSL. Needs the list of landing.glsl.h before. */
#ifndef SPTI_OFFSET_GLSL_H
#define SPTI_OFFSET_GLSL_H

#include "../base/glsl_piece.h"

static const spti_glsl_piece spti_glsl_offset[] = {
    {"spt_side",
     "// The sign of f where a secondary ray goes: on the side that the ray came from, or across.\n"
     "float spt_side(SptHit hit, bool crosses) {\n"
     "[!flags]    return crosses ? -1.0 : 1.0;\n"
     "[flags]    bool inside = (hit.flags & $inside) != 0;\n"
     "[flags]    return inside != crosses ? -1.0 : 1.0;\n"
     "}\n"},
    {"spt_offset_depth",
     "// How far behind the surface a secondary ray begins: twice the tolerance that it will have\n"
     "// there. 0 where there is no surface to begin at, or no normal to go along.\n"
     "float spt_offset_depth($PSptRay ray, SptHit hit, vec3 normal) {\n"
     "    float tolerance = spt_hit_tolerance($Cray, hit.t);\n"
     "    $precise float apart = hit.residual * $L;\n"
     "    vec3 n = normal;\n"
     "    $precise float square = (n.x * n.x + n.y * n.y) + n.z * n.z;\n"
     "    bool there = abs(apart) <= 4.0 * tolerance && square >= 0.25 && square <= 4.0;\n"
     "    return there ? 2.0 * tolerance : 0.0;\n"
     "}\n"},
    {"spt_offset",
     "// The origin of a secondary ray from a hit, moved along the normal to twice the tolerance,\n"
     "// on its own side or across (dynamic epsilon: Keinert et al. 2014, section 3.3). f is\n"
     "// trusted to be the distance.\n"
     "vec3 spt_offset(SptRay ray, SptHit hit, vec3 normal, bool crosses) {\n"
     "[many]    int component = hit.component;\n"
     "    float side = spt_side(hit, crosses), depth = spt_offset_depth($Cray, hit, normal);\n"
     "    $precise vec3 p = ray.origin + hit.t * ray.direction;\n"
     "    $precise float way = depth - side * hit.residual * $L;\n"
     "    if (!(depth > 0.0 && way > 0.0)) return p;\n"
     "    $precise vec3 origin = p + way * (side * normal);\n"
     "    return origin;\n"
     "}\n"},
    {"spt_offset_checked",
     "// The same with up to `checks` (0 to 4) looks at f, which try other depths where a bound\n"
     "// that underestimates has not crossed, a gap is too thin or a sheet was crossed twice.\n"
     "vec3 spt_offset_checked(SptRay ray, SptHit hit, vec3 normal, bool crosses, int checks) {\n"
     "[many]    int component = hit.component;\n"
     "    float side = spt_side(hit, crosses), depth = spt_offset_depth($Cray, hit, normal);\n"
     "    float most = 0.0;\n"
     "    $precise float clearance = side * hit.residual * $L;\n"
     "    $precise vec3 p = ray.origin + hit.t * ray.direction;\n"
     "    vec3 best = p;\n"
     "    if (!(depth > 0.0 && clearance < depth)) return p;\n"
     "    for (int i = $zero; i < checks; ++i) {\n"
     "        float share = i == 0 ? 1.0 : i == 1 ? 0.5 : i == 2 ? 2.0 : 4.0;\n"
     "        $precise float way = share * depth - clearance;\n"
     "        $precise vec3 moved = p + way * (side * normal);\n"
     "        vec3 q = way > 0.0 ? moved : p;\n"
     "        float magnitude = max(max(abs(q.x), abs(q.y)), abs(q.z));\n"
     "        float tolerance = spt_world_tolerance($Cspt_travelled(ray, hit.t), magnitude);\n"
     "        $precise float there = side * spt_map($Cq) * $L;\n"
     "        if (there > tolerance) return q;\n"
     "        if (there > most) {\n"
     "            most = there;\n"
     "            best = q;\n"
     "        }\n"
     "    }\n"
     "    return best;\n"
     "}\n"},
};

#endif
