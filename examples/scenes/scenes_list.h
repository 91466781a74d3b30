/* SPDX-License-Identifier: MIT
 *
 * THE LIST of scenes: each header holds the source of some, and at its end a line for each of them,
 *     SCENE(name, members of struct scene)         the callbacks loop over scene_NAME_distance
 *     SCENE_BLOCKS(name, members of struct scene)  they also use scene_NAME_block: many objects
 *     SCENE_VECTORS(name, members of struct scene) they use scene_NAME_vectors, which has simd.h
 *     SCENE_BUILT(name, members of struct scene)   the field is built when it is first asked for, by
 *                                                  scene_NAME_field(); scene_NAME_distance is for
 *                                                  the reference, after scene_NAME_prepare()
 *     SCENE_UNLISTED(name, members)                the same, found by its name only: one that tests
 *                                                  of all scenes would learn nothing from
 * Beside the first three stands their text in GLSL, in a header of the same name, as GLSL_NAME.
 * The including file defines SCENE, and the others where they make a difference to it. */
#ifndef SCENE_BLOCKS
#define SCENE_BLOCKS SCENE
#endif
#ifndef SCENE_VECTORS
#define SCENE_VECTORS SCENE
#endif
#ifndef SCENE_BUILT
#define SCENE_BUILT SCENE
#endif
#ifndef SCENE_UNLISTED
#define SCENE_UNLISTED SCENE_BUILT
#endif

#include "scene_primitives.h"
#include "scene_mandelbulb.h"
#include "scene_dodecahedron.h"
#include "scene_village.h"
#include "scene_solids.h"
#include "scene_boxes.h"
#include "scene_soft.h"
#include "scene_deformed.h"
#include "scene_arches.h"
#include "scene_jewel.h"
#include "scene_city.h"
#include "scene_textured.h"
#include "scene_glass.h"
#include "scene_krs_tree.h"

#undef SCENE
#undef SCENE_BLOCKS
#undef SCENE_VECTORS
#undef SCENE_BUILT
#undef SCENE_UNLISTED
