/* SPDX-License-Identifier: MIT
 *
 * The objects of the scene "village" as fields of their own, each with its bound: what a union that
 * evaluates only what a ray can meet is made from. Their least distance is the scene's. */
#ifndef EXAMPLES_VILLAGE_H
#define EXAMPLES_VILLAGE_H

#include <spheretrace/spheretrace.h>

/* 40 houses and, last, the ground. */
enum { VILLAGE_OBJECTS = 41 };

/* Object index (0 .. VILLAGE_OBJECTS - 1) with the batch callback built for a width (1, 4, 8, 16:
 * pass spt_lanes()). A house is bounded by a sphere, the ground by its box. bound receives it and
 * must live as long as the field, which points there. */
spt_field village_object(int index, int lanes, spt_bound *bound);

#endif
