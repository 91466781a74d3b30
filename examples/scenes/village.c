/* SPDX-License-Identifier: MIT
 *
 * Where the bodies of the village lie: the upright boxes around its turned houses. */
#include "village.h"
#include "scene_village.h"

/* The box around what reaches half_width across and half_depth along the ridge of a house. */
static void turned(const village_house *house, double half_width, double half_depth, double low,
                   double high, part_extent *extent) {
    const double cosine = fabs((double)house->cosine), sine = fabs((double)house->sine);
    const double half_x = cosine * half_width + sine * half_depth;
    const double half_z = sine * half_width + cosine * half_depth;
    const double x = (double)house->x, z = (double)house->z;
    const part_extent around = BOX(x - half_x, low, z - half_z, x + half_x, high, z + half_z);
    *extent = around;
}

void village_walls_extent(const void *entry, part_extent *extent) {
    const village_house *const house = entry;
    turned(house, (double)house->half_width, (double)house->half_depth, 0,
           2 * (double)house->half_height, extent);
}

/* The roof, from the top of the walls up, is widest there, where it reaches out over them. */
void village_roof_extent(const void *entry, part_extent *extent) {
    const village_house *const house = entry;
    turned(house, (double)house->half_width + VILLAGE_EAVES,
           (double)house->half_depth + VILLAGE_EAVES, 2 * (double)house->half_height,
           (double)house->ridge, extent);
}

void village_house_extent(const void *entry, part_extent *extent) {
    village_roof_extent(entry, extent);
    extent->low[1] = 0;
}
