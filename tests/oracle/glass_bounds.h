/* SPDX-License-Identifier: MIT
 *
 * A bound of every kind around a convex body, none of them close. */
#ifndef TESTS_ORACLE_GLASS_BOUNDS_H
#define TESTS_ORACLE_GLASS_BOUNDS_H

#include <spheretrace/bound.h>

/* All kinds of bound.h, the caller's own as batch and as point. */
enum { glass_bound_count = 10 };

/* The volume that a bound refers to, which must live as long as it. */
typedef struct glass_volume {
    spt_bound_plane planes[8];
    double center[3], radius; /* of the caller's ball */
} glass_volume;

/* The bound of a number from 0 around all points within radius of center; *name is its kind. */
spt_bound glass_bound(int number, const double center[3], double radius, glass_volume *volume,
                      const char **name);

#endif
