/* SPDX-License-Identifier: MIT
 *
 * 21 exact primitives on a ground plane, hard union: what a modeller's scene costs. Five boxes,
 * five balls, three tori, two cylinders, four capsules and two rounded boxes. */
#ifndef EXAMPLES_SCENE_PRIMITIVES_H
#define EXAMPLES_SCENE_PRIMITIVES_H

#include "scene_source.h"

/* A stepped plinth with a ring over it, between two columns. */
SPT_SHAPE spt_real primitives_middle(spt_point p) {
    spt_real d = spt_box(from(p, 0, 0.2, 0), at(1.5, 0.2, 1.5));
    d = spt_union(d, spt_rounded_box(from(p, 0, 0.65, 0), at(0.95, 0.25, 0.95), real(0.1)));
    d = spt_union(d, spt_torus(from(p, 0, 0.98, 0), real(0.7), real(0.12)));
    d = spt_union(d, spt_sphere(from(p, 0, 1.55, 0), real(0.62)));
    d = spt_union(d, spt_cylinder(from(p, -2.6, 1.5, -0.6), real(1.5), real(0.3)));
    d = spt_union(d, spt_cylinder(from(p, 2.6, 1.5, -0.6), real(1.5), real(0.3)));
    return spt_union(d, spt_box(from(p, 0, 3.12, -0.6), at(3.1, 0.12, 0.4)));
}

/* Before it, low things. */
SPT_SHAPE spt_real primitives_front(spt_point p) {
    spt_real d = spt_sphere(from(p, -1.9, 0.35, 1.9), real(0.35));
    d = spt_union(d, spt_sphere(from(p, -1.15, 0.22, 2.3), real(0.22)));
    d = spt_union(d, spt_sphere(from(p, 2.35, 0.45, 1.5), real(0.45)));
    d = spt_union(d, spt_torus(from(p, 0.75, 0.13, 2.45), real(0.42), real(0.13)));
    d = spt_union(d, spt_torus(from(p, 2.35, 0.08, 1.5), real(0.62), real(0.08)));
    d = spt_union(d, spt_capsule(p, at(-3.3, 0.16, 0.5), at(-2.7, 0.16, 1.5), real(0.16)));
    return spt_union(d, spt_rounded_box(from(p, -3.1, 0.3, 2.1), at(0.3, 0.3, 0.3), real(0.08)));
}

/* And behind. */
SPT_SHAPE spt_real primitives_back(spt_point p) {
    spt_real d = spt_box(from(p, -4.4, 0.9, -1.6), at(0.5, 0.9, 0.5));
    d = spt_union(d, spt_box(from(p, 4.5, 0.6, -1.8), at(0.7, 0.6, 0.6)));
    d = spt_union(d, spt_box(from(p, 4.5, 1.45, -1.8), at(0.4, 0.25, 0.4)));
    d = spt_union(d, spt_sphere(from(p, -4.4, 2.25, -1.6), real(0.45)));
    d = spt_union(d, spt_capsule(p, at(3.9, 0.14, 0.3), at(4.3, 1.9, -1), real(0.14)));
    d = spt_union(d, spt_capsule(p, at(-1.6, 0.12, -2.6), at(0, 2.7, -2.9), real(0.12)));
    return spt_union(d, spt_capsule(p, at(1.6, 0.12, -2.6), at(0, 2.7, -2.9), real(0.12)));
}

SPT_SHAPE spt_real scene_primitives_distance(spt_point p) {
    const spt_real near = spt_union(primitives_middle(p), primitives_front(p));
    return spt_union(spt_union(near, primitives_back(p)), p.y);
}

#endif

#ifdef SCENE
SCENE(primitives, .description = "21 primitives and a ground plane", .lipschitz = 1,
      .eye = {1.7, 3.5, 9.9}, .target = {0.15, 1.2, 0}, .field_of_view = 52, .t_max = 60)
#endif
