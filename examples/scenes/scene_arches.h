/* SPDX-License-Identifier: MIT
 *
 * Arches on a floor: rings in part and branches with round ends. */
#ifndef EXAMPLES_SCENE_ARCHES_H
#define EXAMPLES_SCENE_ARCHES_H

#include "scene_source.h"

/* The curved parts of a bay: a brace inside, a flying buttress outside. */
typedef struct arches_curves {
    spt_arc brace, buttress;
} arches_curves;

SPT_SHAPE arches_curves arches_curves_of(void) {
    arches_curves curves;
    curves.brace = spt_arc_of(at(1.3, 1, 0), at(0, 2.3, 0), at(0.8, 1.55, 0), real(0.07));
    curves.buttress = spt_arc_of(at(3.1, 0, 0), at(1.4, 2.1, 0), at(2.65, 1.35, 0), real(0.12));
    return curves;
}

/* One bay, its middle at the origin: a half ring on pillars and the curves. Symmetric in x and z,
 * so that folding at x = 0 is right. */
SPT_SHAPE spt_real arches_bay(spt_point p, const arches_curves *curves) {
    const spt_point q = spt_point_of(spt_magnitude(p.x), p.y, p.z);
    const spt_point above = from(q, 0, 1.6, 0);
    /* the ring lies in x and z there, and in x and y here */
    const spt_real ring =
        spt_capped_torus(spt_point_of(above.x, above.z, above.y), 1, 0, real(1.4), real(0.16));
    const spt_real pillar = spt_capsule(q, at(1.4, 0, 0), at(1.4, 1.6, 0), real(0.16));
    const spt_real foot = spt_rounded_box(from(q, 1.4, 0.12, 0), at(0.3, 0.12, 0.3), real(0.05));
    const spt_real stone = spt_rounded_box(from(q, 3.1, 0.2, 0), at(0.28, 0.2, 0.24), real(0.05));
    spt_real d = spt_union(spt_union(ring, pillar), spt_union(foot, stone));
    d = spt_union(d, spt_toroidal_capsule(q, &curves->brace));
    return spt_union(d, spt_toroidal_capsule(q, &curves->buttress));
}

/* A nave of three bays, 2 apart, under a ridge. Of bays that are symmetric the one whose middle is
 * nearest in z is the nearest. */
SPT_SHAPE spt_real arches_nave(spt_point p, const arches_curves *curves) {
    const spt_real z = spt_magnitude(p.z + real(1.2));
    const spt_point q = spt_point_of(p.x, p.y, spt_least(z, spt_magnitude(z - 2)));
    const spt_real ridge = spt_capsule(p, at(0, 3, -3.6), at(0, 3, 1.2), real(0.1));
    return spt_union(spt_union(arches_bay(q, curves), ridge), p.y);
}

SPT_SHAPE spt_real scene_arches_distance(spt_point p) {
    const arches_curves curves = arches_curves_of();
    return arches_nave(p, &curves);
}

/* The same for up to SCENE_BLOCK points: not every compiler builds the curves when it compiles. */
SPT_SHAPE void scene_arches_block(int count, const spt_real *restrict x, const spt_real *restrict y,
                                  const spt_real *restrict z, spt_real *restrict distance) {
    const arches_curves curves = arches_curves_of();
    for (int k = 0; k < count; ++k) {
        distance[k] = arches_nave(spt_point_of(x[k], y[k], z[k]), &curves);
    }
}

#endif

#ifdef SCENE
SCENE_BLOCKS(arches, .description = "arches on a floor", .lipschitz = 1, .eye = {3.4, 2.6, 7.2},
             .target = {0, 1.2, -0.9}, .field_of_view = 52, .t_max = 60)
#endif
