/* SPDX-License-Identifier: MIT
 *
 * The bounding volumes of bound.h in double, from their definitions: how far a point is outside,
 * and where a ray is inside, of the volume itself or of one as much larger as bound.h allows. And
 * random ones, with rays that touch them. */
#ifndef TESTS_ORACLE_BOUNDS_VOLUME_H
#define TESTS_ORACLE_BOUNDS_VOLUME_H

#include <spheretrace/bound.h>

enum { volume_planes = 12 };

/* A volume and what it points to; not to be copied. */
typedef struct volume {
    spt_bound bound;
    spt_bound_plane planes[volume_planes];
    double middle[3], size; /* a point of it, and about its radius */
} volume;

/* A volume of this kind (all but the callback) of any size, with its middle up to scale away from
 * the origin on each axis. Some are flat, thin, skewed as far as is allowed, or cut with a box. */
void volume_draw(volume *out, spt_bound_kind kind, double scale);

/* Where a ray is inside, t >= 0; none: entry > exit. */
typedef struct volume_interval {
    double entry, exit;
} volume_interval;

/* Of the volume itself, and of what spt_bound_interval() may at most say. */
volume_interval volume_truth(const spt_bound *bound, const float origin[3],
                             const float direction[3]);
volume_interval volume_widest(const spt_bound *bound, const float origin[3],
                              const float direction[3]);

/* How far a point is outside, in world length or somewhat less; negative inside. Of ellipsoids in
 * axes in which it is a ball of its longest half axis. */
double volume_excess(const spt_bound *bound, const double p[3]);

/* The largest coordinate along an axis of a volume with ends of its own, not a slab or polytope;
 * with sign -1 the least. */
double volume_support(const spt_bound *bound, int axis, int sign);

/* A ray of any length that meets the volume's boundary, from near or far; half of them touch it. */
void volume_ray(const volume *self, float origin[3], float direction[3]);

/* A volume of this kind, the callback too, that holds a box, as it is or turned anyhow, and with or
 * without a box of its own. The callback is a ball; `point` for the one without batches. */
void volume_around(volume *out, spt_bound_kind kind, const float low[3], const float high[3]);
spt_interval_batch_fn volume_ball_batch;
spt_interval_fn volume_ball_point;

/* A power of ten, between the ones of -decades and decades. */
double volume_magnitude(double decades);

#endif
