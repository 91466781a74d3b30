/* SPDX-License-Identifier: MIT
 *
 * THE LIST of components that scenes are taken apart into. A scene's header holds their sources
 * and, at its end, a line for each, in the order in which the scene takes their minimum:
 *     PART(scene, name, members of struct piece)   the callbacks loop over SCENE_NAME(p)
 *     PART_TABLE(scene, name, distance, type, table, count, members)
 *                                                  one component for each of the first `count`
 *                                                  entries of a table of `type`, distance(entry, p)
 *     PART_WHOLE(scene, members of struct piece)   the scene itself, where it has an extent to add
 * A scene without a line is one component, as it is. Texts in GLSL stand in the headers of scenes:
 * GLSL_SCENE_NAME is an expression of p, or of a table an array of bodies. The including file
 * defines the three. */
#include "scene_primitives.h"
#include "scene_mandelbulb.h"
#include "scene_dodecahedron.h"
#include "scene_village.h"
#include "scene_solids.h"
#include "scene_boxes.h"
#include "scene_soft.h"
#include "scene_deformed.h"
#include "scene_arches.h"
#include "scene_textured.h"

#undef PART
#undef PART_TABLE
#undef PART_WHOLE
