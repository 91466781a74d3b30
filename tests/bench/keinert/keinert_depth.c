/* SPDX-License-Identifier: MIT
 *
 * From a hit to the root of f behind it, or before it. */
#include "keinert_depth.h"

#include <math.h>

enum { MOST_STEPS = 10000 };

/* Positions are of order 1 to 100, so double has 1e-14 of them; the roots of slopes down to 1e-3
 * are then known to 1e-9, a millionth of the tolerances. */
static const double at_the_root = 1e-12;

double keinert_depth(const scene *shown, const spt_settings *settings, const spt_ray *ray,
                     float path, double sign, double t) {
    const double start = t;
    for (int i = 0; i < MOST_STEPS; ++i) {
        double p[3], f;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
        }
        shown->reference(1, &p[0], &p[1], &p[2], &f);
        f *= sign / (double)shown->lipschitz;
        if (fabs(f) < at_the_root) return t - start;
        /* The hit itself may be out of the tolerance by the rounding of the callback. */
        const double cone = (double)settings->pixel_radius * ((double)path + t);
        if (i > 0 && f > 1.01 * fmax((double)settings->epsilon, cone)) return (double)NAN;
        t += f; /* backwards where f is negative: the root is before */
    }
    return (double)NAN;
}
