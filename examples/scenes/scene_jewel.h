/* SPDX-License-Identifier: MIT
 *
 * A cut gem, lying on one of its facets: a maximum of 73 plane distances, of which its symmetry
 * leaves seven to compute. */
#ifndef EXAMPLES_SCENE_JEWEL_H
#define EXAMPLES_SCENE_JEWEL_H

#include "jewel_planes.h"
#include "scene_jewel.glsl.h"
#include "scene_source.h"

/* How far a point reaches out along the horizontal directions of the facets, at most: of those at
 * whole eighths of a turn, a sixteenth on, and at odd thirty-seconds. A facet of a ring is ahead of
 * all others where the point lies nearest to its direction; among positive cosines and sines that
 * is decided by the larger of |first| and |second| taking the larger of them. Every value is the
 * maximum of linear functions that it stands for, whatever the rounding of the cosines: convex. */
typedef struct jewel_reach {
    spt_real whole, between, odd;
} jewel_reach;

SPT_SHAPE jewel_reach jewel_reach_of(spt_real first, spt_real second) {
    const spt_real a = spt_magnitude(first), b = spt_magnitude(second);
    const spt_real more = spt_greatest(a, b), less = spt_least(a, b);
    jewel_reach reach;
    reach.whole = spt_greatest(real(0.707106781) * (more + less), more);
    reach.between = real(0.923879533) * more + real(0.382683432) * less;
    reach.odd = spt_greatest(real(0.980785280) * more + real(0.195090322) * less,
                             real(0.831469612) * more + real(0.555570233) * less);
    return reach;
}

#define JEWEL_FACET(ring, out) \
    (real(JEWEL_##ring##_ACROSS) * (out) + real(JEWEL_##ring##_UP) * up - \
     real(JEWEL_##ring##_OFFSET))

SPT_SHAPE spt_real scene_jewel_distance(spt_point p) {
    const spt_real sine = real(JEWEL_LEAN_SINE), cosine = real(JEWEL_LEAN_COSINE);
    const spt_real up = sine * p.z + cosine * p.y;
    const jewel_reach reach = jewel_reach_of(cosine * p.z - sine * p.y, p.x);
    const spt_real star = JEWEL_FACET(STAR, reach.between);
    const spt_real bezel = JEWEL_FACET(BEZEL, reach.whole);
    const spt_real upper = JEWEL_FACET(UPPER, reach.odd);
    const spt_real lower = JEWEL_FACET(LOWER, reach.odd);
    const spt_real main_facet = JEWEL_FACET(MAIN, reach.whole);
    const spt_real crown = spt_greatest(spt_greatest(star, bezel), upper);
    const spt_real pavilion = spt_greatest(lower, main_facet);
    const spt_real ends = spt_greatest(up - real(JEWEL_TABLE), reach.odd - real(JEWEL_GIRDLE));
    return spt_greatest(spt_greatest(crown, pavilion), ends);
}

#undef JEWEL_FACET

#endif

#ifdef SCENE
SCENE(jewel, .description = "brilliant-cut gem, a maximum of 73 planes; convex", .lipschitz = 1,
      .flags = SPT_FIELD_CONVEX, .bound = BALL(0, 0, 0, JEWEL_RADIUS), .eye = {1.5, 2.1, 4.3},
      .target = {0, -0.04, 0.02}, .field_of_view = 45, .t_max = 20)
#endif
