/* SPDX-License-Identifier: MIT
 *
 * Maps on their way from double to what is evaluated point by point, and the test of the group
 * condition that every door shares. */
#ifndef SPTI_MOBIUS_BUILD_H
#define SPTI_MOBIUS_BUILD_H

#include <spheretrace/mobius.h>

/* ---- What the doors of maps share ------------------------------------------------------------ */

/* Whether a, b, c and d are finite. */
int spti_mobius_finite(const spt_mobius *map);

/* The largest magnitude of a component of a, b, c and d, NaN passed over. */
double spti_mobius_largest(const spt_mobius *map);

/* v = c p + d */
spt_quaternion spti_mobius_under(const spt_mobius *map, const double point[3]);

/* The image of infinity, a c^-1; +infinity where c = 0. */
void spti_mobius_pole(const spt_mobius *map, double pole[3]);

/* The image of a finite point with v = c p + d != 0. Returns how large its error can be, in units
 * of a few 2^-53. */
double spti_mobius_image(const spt_mobius *map, const double point[3], double image[3]);

/* orientation v g v^-1; 0 where v is. */
void spti_mobius_turn(const spt_mobius *map, spt_quaternion v, const double vector[3],
                      double image[3]);

/* ---- Maps in float --------------------------------------------------------------------------- */

/* Whether a, b, c, d are finite and in the group, as spt_mobius_matrix() tests it, whatever size
 * and sign a* d + c* b = lambda has. The orientation is not read. Squares must not overflow. */
int spti_in_group(const spt_mobius *map, double *lambda);

/* Whether a map is one: in the group, with lambda what orientation says, to 1e-5. */
int spti_map_ok(const spt_mobius *map);

/* Rounds a map, and fills in what follows from it. Returns 0, with nothing written, where the map
 * is none, or where float cannot hold its numbers: entries of up to 2^63, so that their squares are
 * floats, and the pole. Entries below the smallest normal float are 0. */
int spti_build_map(const spt_mobius *map, spt_built_map *built);

#endif
