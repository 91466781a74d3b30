/* SPDX-License-Identifier: MIT
 *
 * Convex bodies by their planes: a regular dodecahedron as the greatest of six slab distances, and
 * rounded as a generalised distance function (Akleman & Chen 1999) with exponent 32. Both are norms
 * minus 1, so convex functions; their slope is at most the largest norm of a unit vector, which is
 * 1 for the first and, at a face normal, (1 + 5 / 5^16)^(1/32) = 1 + 1e-12 for the second. */
#ifndef EXAMPLES_SCENE_DODECAHEDRON_H
#define EXAMPLES_SCENE_DODECAHEDRON_H

#include "scene_dodecahedron.glsl.h"
#include "scene_source.h"

/* Normals of the faces: (0, 1, phi) / |..| and so on, phi the golden ratio. */
#define DODECAHEDRON_SHORT 0.525731112
#define DODECAHEDRON_LONG 0.850650808

typedef struct dodecahedron_heights {
    spt_real over[6]; /* |normal.p| */
} dodecahedron_heights;

SPT_SHAPE dodecahedron_heights dodecahedron_heights_of(spt_point p) {
    const spt_real s = real(DODECAHEDRON_SHORT), l = real(DODECAHEDRON_LONG);
    const spt_real short_x = s * p.x, short_y = s * p.y, short_z = s * p.z;
    const spt_real long_x = l * p.x, long_y = l * p.y, long_z = l * p.z;
    dodecahedron_heights heights;
    heights.over[0] = spt_magnitude(short_x + long_y);
    heights.over[1] = spt_magnitude(short_x - long_y);
    heights.over[2] = spt_magnitude(short_y + long_z);
    heights.over[3] = spt_magnitude(short_y - long_z);
    heights.over[4] = spt_magnitude(short_z + long_x);
    heights.over[5] = spt_magnitude(short_z - long_x);
    return heights;
}

SPT_SHAPE spt_real dodecahedron_greatest(const dodecahedron_heights *heights) {
    const spt_real first = spt_greatest(heights->over[0], heights->over[1]);
    const spt_real second = spt_greatest(heights->over[2], heights->over[3]);
    const spt_real third = spt_greatest(heights->over[4], heights->over[5]);
    return spt_greatest(spt_greatest(first, second), third);
}

SPT_SHAPE spt_real scene_dodecahedron_distance(spt_point p) {
    const dodecahedron_heights heights = dodecahedron_heights_of(p);
    return dodecahedron_greatest(&heights) - 1;
}

/* The power of a number in [0, 1]. Without the addition the power of a small one would be denormal,
 * which is slow; for 1 it is below rounding. */
SPT_SHAPE spt_real dodecahedron_power_32(spt_real a) {
    const spt_real a2 = a * a, a4 = a2 * a2;
    const spt_real a8 = a4 * a4 + real(1e-9), a16 = a8 * a8;
    return a16 * a16;
}

/* The powers are those of ratios to the greatest height, so that none overflows; what is added to
 * that height matters only at the origin, where it is all there is. */
SPT_SHAPE spt_real scene_dodecahedron_p32_distance(spt_point p) {
    const dodecahedron_heights heights = dodecahedron_heights_of(p);
    const spt_real greatest = dodecahedron_greatest(&heights) + SPT_REAL_MIN;
    const spt_real inverse = 1 / greatest;
    const spt_real sum = (dodecahedron_power_32(heights.over[0] * inverse) +
                          dodecahedron_power_32(heights.over[1] * inverse)) +
                         (dodecahedron_power_32(heights.over[2] * inverse) +
                          dodecahedron_power_32(heights.over[3] * inverse)) +
                         (dodecahedron_power_32(heights.over[4] * inverse) +
                          dodecahedron_power_32(heights.over[5] * inverse));
    const spt_real root_8 = spt_root(spt_root(spt_root(sum)));
    return greatest * spt_root(spt_root(root_8)) - 1;
}

#endif

#ifdef SCENE
/* The corners of the dodecahedron lie at 1.2584. */
SCENE(dodecahedron, .description = "regular dodecahedron, a maximum of six slabs; convex",
      .lipschitz = 1, .flags = SPT_FIELD_CONVEX, .bound = BALL(0, 0, 0, 1.26f),
      .eye = {1.6, 2.1, 4.2}, .target = {0, 0, 0}, .field_of_view = 45, .t_max = 20,
      .glsl_prelude = DODECAHEDRON_GLSL_PRELUDE)
SCENE(dodecahedron_p32, .description = "generalised distance with exponent 32; convex",
      .lipschitz = 1, .flags = SPT_FIELD_CONVEX, .bound = BALL(0, 0, 0, 1.26f),
      .eye = {1.6, 2.1, 4.2}, .target = {0, 0, 0}, .field_of_view = 45, .t_max = 20,
      .glsl_prelude = DODECAHEDRON_P32_GLSL_PRELUDE)
#endif
