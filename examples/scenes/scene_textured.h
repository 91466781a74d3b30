/* SPDX-License-Identifier: MIT
 *
 * Smooth bodies with round outlines: a turned piece, such as would have a grain (textures are the
 * pictures' choice), and long arms before the sky and a floor without end, past whose sides rays go
 * by small steps. */
#ifndef EXAMPLES_SCENE_TEXTURED_H
#define EXAMPLES_SCENE_TEXTURED_H

#include "scene_textured.glsl.h"
#include "scene_source.h"

/* Belly, brim, neck and foot, grown together. Blends never leave the mean of their parts' slopes,
 * see shapes_operators.h. */
SPT_SHAPE spt_real scene_textured_distance(spt_point p) {
    const spt_real k = real(0.35);
    const spt_real belly = spt_sphere(from(p, 0, -0.15, 0), real(0.8));
    const spt_real brim = spt_torus(from(p, 0, -0.1, 0), real(1.05), real(0.16));
    const spt_real neck = spt_capsule(p, at(0, 0.5, 0), at(0, 1.15, 0), real(0.16));
    const spt_real knob = spt_sphere(from(p, 0, 1.2, 0), real(0.3));
    const spt_real foot = spt_torus(from(p, 0, -1.05, 0), real(0.5), real(0.14));
    const spt_real body = spt_smooth_union(spt_smooth_union(belly, brim, k), foot, k);
    return spt_smooth_union(spt_smooth_union(body, neck, k), knob, real(0.2));
}

/* Six arms and a ball, blended. */
SPT_SHAPE spt_real silhouette_arms(spt_point p) {
    const spt_point q = spt_point_of(spt_magnitude(p.x), spt_magnitude(p.y), spt_magnitude(p.z));
    const spt_real middle = spt_sphere(p, real(0.8));
    const spt_real across = spt_capsule(q, at(0, 0, 0), at(1.8, 0, 0), real(0.25));
    const spt_real up = spt_capsule(q, at(0, 0, 0), at(0, 1.8, 0), real(0.25));
    const spt_real along = spt_capsule(q, at(0, 0, 0), at(0, 0, 1.8), real(0.25));
    const spt_real arms = spt_union(spt_union(across, up), along);
    return spt_smooth_union(middle, arms, real(0.3));
}

SPT_SHAPE spt_real scene_silhouette_distance(spt_point p) {
    return spt_union(silhouette_arms(p), p.y + real(2.6));
}

#endif

#ifdef SCENE
SCENE(textured, .description = "a smooth turned body, to be textured", .lipschitz = 1,
      .eye = {2.1, 2.4, 5.2}, .target = {0, 0.1, 0}, .field_of_view = 50, .t_max = 20)
SCENE(silhouette, .description = "long round arms over a floor without end", .lipschitz = 1,
      .eye = {2.6, -2.3, 8}, .target = {0, 0.1, 0}, .field_of_view = 50, .t_max = 250)
#endif

#ifdef PART
/* The brim reaches 1.21, the knob up to 1.5, the foot down to 1.19; blends add k/4 each. */
PART_WHOLE(textured, .extent = BOX(-1.39, -1.37, -1.39, 1.39, 1.6, 1.39))
#endif
