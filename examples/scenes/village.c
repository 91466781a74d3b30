/* SPDX-License-Identifier: MIT
 *
 * The objects of the village one by one; their callbacks are built in scenes_lanes.c. */
#include "village.h"
#include "scene_village.h"
#include "scenes_widths.h"

DECLARE_BATCHES(village_house)
DECLARE_BATCHES(village_ground)

static spt_distance_batch_fn *const house_batches[4] = BATCHES(village_house);
static spt_distance_batch_fn *const ground_batches[4] = BATCHES(village_ground);

/* The sphere around a house from the middle of its walls: through the corners of the eaves, which
 * are as high over it as the feet of the walls are below, or through the ends of the ridge.
 * Enlarged by 1e-5, some 100 times the rounding of these lines. */
static spt_bound house_bound(const village_house *house) {
    const float width = house->half_width + (float)VILLAGE_EAVES;
    const float depth = house->half_depth + (float)VILLAGE_EAVES;
    const float eaves = spt_length_3(width, depth, house->half_height);
    const float ridge = spt_length_2(depth, house->ridge - house->half_height);
    return spt_bound_sphere(house->x, house->half_height, house->z,
                            spt_greatest(eaves, ridge) * 1.00001f);
}

spt_field village_object(int index, int lanes, spt_bound *bound) {
    const float half = (float)VILLAGE_GROUND_HALF;
    const int width = batch_index(lanes);
    spt_field field = spt_field_default();
    if (index < VILLAGE_HOUSES) {
        const village_house *const house = &village_houses[index];
        *bound = house_bound(house);
        field.batch = house_batches[width];
        field.user = (void *)(uintptr_t)house; /* read only there */
    } else {
        *bound = spt_bound_box(-half, -2 * (float)VILLAGE_GROUND_DEPTH, -half, half, 0, half);
        field.batch = ground_batches[width];
    }
    field.bound = bound;
    return field;
}
