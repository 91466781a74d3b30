/* SPDX-License-Identifier: MIT
 *
 * The dodecahedron of Keinert et al. 2014, Figure 11: a generalised distance function (Akleman &
 * Chen 1999) of exponent 32 in its bounding sphere, as it lies on one of its faces. Left out: the
 * plane and the balls around it, which are no distance fields (glass_world.h). */
#ifndef EXAMPLES_SCENE_GLASS_H
#define EXAMPLES_SCENE_GLASS_H

#include "scene_dodecahedron.glsl.h"
#include "scene_source.h"

/* That of scene_dodecahedron.h, which comes first in the list of scenes, turned about z: the normal
 * (short, long, 0) comes to point up. */
SPT_SHAPE spt_real scene_glass_distance(spt_point p) {
    const spt_real s = real(DODECAHEDRON_SHORT), l = real(DODECAHEDRON_LONG);
    return scene_dodecahedron_p32_distance(spt_point_of(l * p.x + s * p.y, l * p.y - s * p.x, p.z));
}

#endif

#ifdef SCENE
SCENE(glass, .description = "rounded dodecahedron on a face; convex", .lipschitz = 1,
      .flags = SPT_FIELD_CONVEX, .bound = BALL(0, 0, 0, 1.26f), .eye = {3.0, 1.7, 6.9},
      .target = {0.1, -0.27, -0.3}, .field_of_view = 35, .t_max = 40,
      .glsl_prelude = DODECAHEDRON_P32_GLSL_PRELUDE)
#endif
