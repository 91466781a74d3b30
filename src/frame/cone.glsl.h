/* SPDX-License-Identifier: MIT
 *
 * Cones as a pass of low resolution, as GLSL: bundle.c and cone_kernel.h for one block of pixels.
 * Left out: the secant of convex fields. */
#ifndef SPTI_CONE_GLSL_H
#define SPTI_CONE_GLSL_H

#include "../base/glsl_piece.h"

/* Answers are not those of spti_bundles_walk(), whose blocks nest, but as safe. With
 *     beta + alpha t   how far the block's rays are from the point at t of its middle one, and how
 *                      far from a surface they take it for reached there
 * no ray of the block ends before the t that comes back, nor meets anything where that is 3.0e38. A
 * field is asked only in its bound's sphere or box, so its text need be right only there.
 * spt_block_cone() takes edges of the block as spt_camera_ray() does a point; spt_start() a pixel as
 * the texture counts its texels. */
static const spti_glsl_piece spti_glsl_cone[] = {
    {"spt_cone_of",
     "// How far a cone is empty. A step is (distance - beta - alpha t) / (1 + alpha): the slice\n"
     "// at its end, wider by alpha times the step, is still within the sphere. (By the distance,\n"
     "// as printed in Balint & Valasek 2018, section 4, it skips surfaces.)\n"
     "float spt_cone_of($Pvec3 origin, vec3 direction, float alpha, float beta, vec2 range,\n"
     "                  int budget) {\n"
     "    float reach = max(max(abs(origin.x), abs(origin.y)), abs(origin.z));\n"
     "    float t = range.x;\n"
     "    for (int i = $zero; i < budget; ++i) {\n"
     "        $precise vec3 p = origin + t * direction;\n"
     "        $precise float width = beta + alpha * t;\n"
     "[!sized]        $precise float resolved = 2.38418579e-7 * (reach + t);\n"
     "[sized]        $precise float resolved = 2.38418579e-7 * (reach + t) + $S;\n"
     "        $precise float kept = width + resolved;\n"
     "[bounded][!many]        vec3 nearest = spt_hull_0(p);\n"
     "[bounded][many]        vec3 nearest = spt_hull(component, p);\n"
     "[bounded]        $precise vec3 way = p - nearest;\n"
     "[bounded]        $precise vec3 along = way * direction;\n"
     "[bounded]        $precise float square = (way.x * way.x + way.y * way.y) + way.z * way.z;\n"
     "[bounded]        $precise float leaving = ((along.x + along.y) + along.z) - resolved;\n"
     "[bounded]        float gap = sqrt(square);\n"
     "[bounded]        // The bound is behind a plane at right angles to that way. A cone that is\n"
     "[bounded]        // before it and goes away never comes back;\n"
     "[bounded]        if (gap > kept && leaving > alpha * gap) return 3.0e38;\n"
     "[bounded]        // and far from the bound there is no need to ask.\n"
     "[bounded]        $precise float before = (gap - kept) / (1.0 + alpha);\n"
     "[bounded]        if (before > 0.5 * gap) {\n"
     "[bounded]            t += before;\n"
     "[bounded]            if (t > range.y) return 3.0e38;\n"
     "[bounded]            continue;\n"
     "[bounded]        }\n"
     "[bounded]        float value = spt_map($Cnearest);\n"
     "[!bounded]        float value = spt_map($Cp);\n"
     "[guards]        if (!spt_is_number(value)) break;\n"
     "        $precise float radius = value * $L;\n"
     "[bounded]        float inner = max(radius, 0.0); // from that point\n"
     "[bounded]        $precise float slant = sqrt(square + inner * inner);\n"
     "[bounded]        if (gap > 0.0) radius = slant;\n"
     "        $precise float step = (radius - kept) / (1.0 + alpha);\n"
     "        if (!(step > max(0.1 * width, resolved))) break;\n"
     "        t += step;\n"
     "        if (t > range.y) return 3.0e38;\n"
     "    }\n"
     "    return t;\n"
     "}\n"},
    {"spt_block_cone",
     "// How far all rays through a block of the picture meet nothing; 3.0e38: they never do.\n"
     "// The cap around its middle ray that holds its corners meets the image plane in a convex\n"
     "// region, so it holds all of them.\n"
     "float spt_block_cone(vec2 low, vec2 high, int budget) {\n"
     "    SptRay ray = spt_camera_ray(0.5 * (low + high));\n"
     "    float farthest = 0.0;\n"
     "    for (int corner = $zero; corner < 4; ++corner) {\n"
     "        float x = (corner & 1) == 0 ? low.x : high.x;\n"
     "        float y = (corner & 2) == 0 ? low.y : high.y;\n"
     "        SptRay edge = spt_camera_ray(vec2(x, y));\n"
     "[pinhole]        $precise vec3 apart = edge.direction - ray.direction;\n"
     "[!pinhole]        $precise vec3 apart = edge.origin - ray.origin;\n"
     "        $precise float square =\n"
     "            (apart.x * apart.x + apart.y * apart.y) + apart.z * apart.z;\n"
     "        farthest = max(sqrt(square), farthest);\n"
     "    }\n"
     "    // 2^-21: what rounding can add to the distance of directions, or of origins.\n"
     "[pinhole]    $precise float alpha = farthest + 4.76837158e-7;\n"
     "[pinhole]    float beta = $epsilon;\n"
     "[pinhole]    if (!(alpha < 1.0)) return ray.t_min;\n"
     "[!pinhole]    float alpha = 4.76837158e-7;\n"
     "[!pinhole]    vec3 far = max(abs(ray.origin), abs($eye));\n"
     "[!pinhole]    float reach = max(max(far.x, far.y), far.z);\n"
     "[!pinhole]    $precise float beta = (farthest + 4.76837158e-7 * reach) + $epsilon;\n"
     "[pixel]    alpha += $pixel_radius;\n"
     "[!many]    return spt_cone_of(ray.origin, ray.direction, alpha, beta,\n"
     "[!many]                       vec2(ray.t_min, ray.t_max), budget);\n"
     "[many]    float least = 3.0e38;\n"
     "[many]    for (int component = $zero; component < $n; ++component) {\n"
     "[many]        vec2 range = vec2(ray.t_min, min(ray.t_max, least));\n"
     "[many]        float t = spt_cone_of($Cray.origin, ray.direction, alpha, beta, range,\n"
     "[many]                              budget);\n"
     "[many]        least = min(t, least);\n"
     "[many]    }\n"
     "[many]    return least;\n"
     "}\n"},
    {"spt_start",
     "// Where the cone of a pixel's block stopped: rays begin there. Blocks nest, so a\n"
     "// pixel is in one.\n"
     "float spt_start(ivec2 pixel) {\n"
     "    return texelFetch($starts, pixel / $cone_size, 0).x;\n"
     "}\n"},
};

#endif
