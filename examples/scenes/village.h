/* SPDX-License-Identifier: MIT
 *
 * Where the bodies of the scene "village" lie. The components themselves are in parts.h. */
#ifndef EXAMPLES_VILLAGE_H
#define EXAMPLES_VILLAGE_H

#include "parts_source.h"

/* Of an entry of village_houses: the upright boxes around the whole house and its two bodies. */
part_place_fn village_house_extent, village_walls_extent, village_roof_extent;

#endif
