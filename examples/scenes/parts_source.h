/* SPDX-License-Identifier: MIT
 *
 * What the list of components is written with: where each lies, and the type of its callback in
 * double. Left out: the list itself, see parts_list.h. */
#ifndef EXAMPLES_PARTS_SOURCE_H
#define EXAMPLES_PARTS_SOURCE_H

#include <spheretrace/bound.h>

/* A ball or a box, in decimal numbers as the source has them. parts.c rounds it outward. */
typedef struct part_extent {
    uint32_t kind; /* spt_bound_kind; 0: it has no end */
    double center[3], radius;
    double low[3], high[3];
} part_extent;

/* Initialisers. */
#define BALL(x, y, z, ball_radius) \
    { .kind = SPT_BOUND_SPHERE, .center = {x, y, z}, .radius = ball_radius }
#define BOX(low_x, low_y, low_z, high_x, high_y, high_z) \
    { \
        .kind = SPT_BOUND_BOX, .low = {low_x, low_y, low_z}, .high = { high_x, high_y, high_z } \
    }

/* The extent of a component that is an entry of a table. It comes as its line in the list says (for
 * all entries seen from their own place), or as none. */
typedef void part_place_fn(const void *entry, part_extent *extent);

/* Entry of a component's table (0 without one) in double at n points, any n. */
typedef void part_reference_fn(size_t entry, size_t n, const double *x, const double *y,
                               const double *z, double *distance);

#endif
