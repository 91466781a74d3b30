/* SPDX-License-Identifier: MIT
 *
 * The tolerance law of trace.h in double. */
#include "tolerance.h"

#include <math.h>

double oracle_length(const spt_ray *ray) {
    const double x = (double)ray->direction[0], y = (double)ray->direction[1],
                 z = (double)ray->direction[2];
    return sqrt(x * x + y * y + z * z);
}

static double largest(const float v[3]) {
    const double x = fabs((double)v[0]), y = fabs((double)v[1]), z = fabs((double)v[2]);
    return fmax(x, fmax(y, z));
}

double oracle_floor(const spt_settings *settings, const spt_ray *ray, double t) {
    return 0x1p-22 * (largest(ray->origin) + t * oracle_length(ray) + (double)settings->size);
}

double oracle_tolerance(const spt_settings *settings, const spt_ray *ray, double t) {
    const double cone = (double)settings->pixel_radius * t * oracle_length(ray);
    return fmax(fmax((double)settings->epsilon, cone), oracle_floor(settings, ray, t));
}
