/* SPDX-License-Identifier: MIT
 *
 * Arches on a floor: rings in part and branches with round ends. */
#ifndef EXAMPLES_SCENE_ARCHES_H
#define EXAMPLES_SCENE_ARCHES_H

#include "scene_arches.glsl.h"
#include "scene_source.h"

/* The curved parts of a bay: a brace inside, a flying buttress outside. */
typedef struct arches_curves {
    spt_arc brace, buttress;
} arches_curves;

SPT_SHAPE spt_arc arches_brace_arc(void) {
    return spt_arc_of(at(1.3, 1, 0), at(0, 2.3, 0), at(0.8, 1.55, 0), real(0.07));
}

SPT_SHAPE spt_arc arches_buttress_arc(void) {
    return spt_arc_of(at(3.1, 0, 0), at(1.4, 2.1, 0), at(2.65, 1.35, 0), real(0.12));
}

SPT_SHAPE arches_curves arches_curves_of(void) {
    arches_curves curves;
    curves.brace = arches_brace_arc();
    curves.buttress = arches_buttress_arc();
    return curves;
}

/* The straight parts, of which q.x >= 0 sees one. The ring lies in x and z there, and in x and y
 * here. */
SPT_SHAPE spt_real arches_ring(spt_point q) {
    const spt_point above = from(q, 0, 1.6, 0);
    return spt_capped_torus(spt_point_of(above.x, above.z, above.y), 1, 0, real(1.4), real(0.16));
}

SPT_SHAPE spt_real arches_pillar(spt_point q) {
    return spt_capsule(q, at(1.4, 0, 0), at(1.4, 1.6, 0), real(0.16));
}

SPT_SHAPE spt_real arches_foot(spt_point q) {
    return spt_rounded_box(from(q, 1.4, 0.12, 0), at(0.3, 0.12, 0.3), real(0.05));
}

SPT_SHAPE spt_real arches_stone(spt_point q) {
    return spt_rounded_box(from(q, 3.1, 0.2, 0), at(0.28, 0.2, 0.24), real(0.05));
}

/* One bay, its middle at the origin: a half ring on pillars and the curves. Symmetric in x and z,
 * so that folding at x = 0 is right. */
SPT_SHAPE spt_real arches_bay(spt_point p, const arches_curves *curves) {
    const spt_point q = spt_point_of(spt_magnitude(p.x), p.y, p.z);
    const spt_real ring = arches_ring(q), pillar = arches_pillar(q);
    const spt_real foot = arches_foot(q), stone = arches_stone(q);
    spt_real d = spt_union(spt_union(ring, pillar), spt_union(foot, stone));
    d = spt_union(d, spt_toroidal_capsule(q, &curves->brace));
    return spt_union(d, spt_toroidal_capsule(q, &curves->buttress));
}

SPT_SHAPE spt_real arches_ridge(spt_point p) {
    return spt_capsule(p, at(0, 3, -3.6), at(0, 3, 1.2), real(0.1));
}

SPT_SHAPE spt_real arches_ground(spt_point p) {
    return p.y;
}

/* A nave of three bays, 2 apart, under a ridge. Of bays that are symmetric the one whose middle is
 * nearest in z is the nearest. */
SPT_SHAPE spt_real arches_nave(spt_point p, const arches_curves *curves) {
    const spt_real z = spt_magnitude(p.z + real(1.2));
    const spt_point q = spt_point_of(p.x, p.y, spt_least(z, spt_magnitude(z - 2)));
    const spt_real ridge = arches_ridge(p);
    return spt_union(spt_union(arches_bay(q, curves), ridge), arches_ground(p));
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

/* Where a part of a bay stands: its side, and its bay counted from the middle one. Seen from there
 * a point has the coordinates, bit for bit, that the folds above give it if this part is the
 * nearest, and else larger ones. Rings and curves are folded: one part for both sides. */
typedef struct arches_place {
    spt_real side, bay; /* 1 or -1; -1, 0 or 1 */
} arches_place;

enum { ARCHES_BAYS = 3, ARCHES_SIDES = 6 };
static const arches_place arches_places[ARCHES_SIDES] = {{1, -1},  {1, 0},  {1, 1},
                                                         {-1, -1}, {-1, 0}, {-1, 1}};

SPT_SHAPE spt_point arches_seen_from(const arches_place *place, spt_point p) {
    return spt_point_of(place->side * p.x, p.y, spt_magnitude((p.z + real(1.2)) - 2 * place->bay));
}

SPT_SHAPE spt_point arches_folded(const arches_place *place, spt_point p) {
    const spt_point q = arches_seen_from(place, p);
    return spt_point_of(spt_magnitude(q.x), q.y, q.z);
}

SPT_SHAPE spt_real arches_ring_at(const arches_place *place, spt_point p) {
    return arches_ring(arches_folded(place, p));
}

SPT_SHAPE spt_real arches_brace_at(const arches_place *place, spt_point p) {
    const spt_arc arc = arches_brace_arc();
    return spt_toroidal_capsule(arches_folded(place, p), &arc);
}

SPT_SHAPE spt_real arches_buttress_at(const arches_place *place, spt_point p) {
    const spt_arc arc = arches_buttress_arc();
    return spt_toroidal_capsule(arches_folded(place, p), &arc);
}

SPT_SHAPE spt_real arches_pillar_at(const arches_place *place, spt_point p) {
    return arches_pillar(arches_seen_from(place, p));
}

SPT_SHAPE spt_real arches_foot_at(const arches_place *place, spt_point p) {
    return arches_foot(arches_seen_from(place, p));
}

SPT_SHAPE spt_real arches_stone_at(const arches_place *place, spt_point p) {
    return arches_stone(arches_seen_from(place, p));
}

#endif

#ifdef SCENE
SCENE_BLOCKS(arches, .description = "arches on a floor", .lipschitz = 1, .eye = {3.4, 2.6, 7.2},
             .target = {0, 1.2, -0.9}, .field_of_view = 52, .t_max = 60,
             .glsl_prelude = ARCHES_GLSL_PRELUDE)
#endif

#ifdef PART
/* The extents are those of the middle bay's right-hand parts, seen from there. */
PART_TABLE(arches, ring, arches_ring_at, arches_place, arches_places, ARCHES_BAYS,
           .extent = BOX(-1.56, 1.44, -0.16, 1.56, 3.16, 0.16), .place = arches_extent,
           .glsl_prelude = ARCHES_PART_PRELUDE)
PART_TABLE(arches, pillar, arches_pillar_at, arches_place, arches_places, ARCHES_SIDES,
           .flags = SPT_FIELD_CONVEX, .extent = BOX(1.24, -0.16, -0.16, 1.56, 1.76, 0.16),
           .place = arches_extent, .glsl_prelude = ARCHES_PART_PRELUDE)
PART_TABLE(arches, foot, arches_foot_at, arches_place, arches_places, ARCHES_SIDES,
           .flags = SPT_FIELD_CONVEX, .extent = BOX(1.1, 0, -0.3, 1.7, 0.24, 0.3),
           .place = arches_extent, .glsl_prelude = ARCHES_PART_PRELUDE)
PART_TABLE(arches, stone, arches_stone_at, arches_place, arches_places, ARCHES_SIDES,
           .flags = SPT_FIELD_CONVEX, .extent = BOX(2.82, 0, -0.24, 3.38, 0.4, 0.24),
           .place = arches_extent, .glsl_prelude = ARCHES_PART_PRELUDE)
/* The circle of the buttress reaches 0.001 beyond its foot. */
PART_TABLE(arches, brace, arches_brace_at, arches_place, arches_places, ARCHES_BAYS,
           .extent = BOX(-1.37, 0.93, -0.07, 1.37, 2.37, 0.07), .place = arches_extent,
           .glsl_prelude = ARCHES_PART_PRELUDE)
PART_TABLE(arches, buttress, arches_buttress_at, arches_place, arches_places, ARCHES_BAYS,
           .extent = BOX(-3.221, -0.12, -0.12, 3.221, 2.22, 0.12), .place = arches_extent,
           .glsl_prelude = ARCHES_PART_PRELUDE)
PART(arches, ridge, .flags = SPT_FIELD_CONVEX, .extent = BOX(-0.1, 2.9, -3.7, 0.1, 3.1, 1.3))
PART(arches, ground, .flags = SPT_FIELD_CONVEX)
#endif
