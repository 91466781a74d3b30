/* SPDX-License-Identifier: MIT
 *
 * When a ray enters a convex body through a face with normal n at T, the distance f of the body,
 * which is the greatest of its planes', is at least |n.d| (T - t) at t before. A tracer that stops
 * where f < tolerance so stops at T - tolerance / |n.d| or later. It may also stop earlier, before
 * a body whose silhouette the ray passes by less than the tolerance: f is then below it there. */
#include "peers_check.h"

#include <math.h>

enum { MOST_PRINTED = 5 };

/* A float position is off by at most 2.5 u of the magnitudes that go into it, u = 2^-24; a
 * triangle's hit by a few more for its edges and normal, which have the village's size. */
static double noise_of(const spt_ray *ray, double t) {
    double reach = VILLAGE_GROUND_HALF;
    for (int axis = 0; axis < 3; ++axis) reach = fmax(reach, fabs((double)ray->origin[axis]));
    return 16 * 0x1p-24 * (reach + t);
}

static double distance_at(const scene *shown, const spt_ray *ray, double t) {
    double p[3], distance;
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
    shown->reference(1, &p[0], &p[1], &p[2], &distance);
    return distance;
}

peers_found peers_compare(const char *name, const frame_picture *picture, const peers_step *step,
                          const peers_hit *truth, const peers_hit *hits) {
    peers_found found = {0, 0, 0, 0};
    for (size_t i = 0; i < picture->count; ++i) {
        const spt_ray *const ray = &picture->rays[i];
        const size_t pixel = picture->pixel[i];
        const double t = (double)hits[pixel].t, exact = (double)truth[pixel].t;
        const int hit = t < HUGE_VAL, there = exact < HUGE_VAL;
        if (isnan(t)) {
            ++found.limit;
            continue;
        }
        if (!hit && !there) {
            ++found.equal;
            continue;
        }
        const double noise = noise_of(ray, fmin(t, exact));
        const double stop =
            step == NULL ? 0 : fmax((double)step->epsilon, (double)step->pixel_radius * t);
        const double cosine = (double)truth[pixel].cosine;
        if (hit && there && fabs(exact - t) * cosine <= noise + (t < exact ? stop : 0)) {
            ++found.equal;
        } else if (hit && !(t > exact) && distance_at(picture->shown, ray, t) < stop + noise) {
            ++found.silhouette;
        } else if (++found.different <= MOST_PRINTED) {
            printf("%s: pixel %zu,%zu: t %.7g, exactly %.7g, cosine %.3g, f there %.3g\n", name,
                   pixel % picture->width, pixel / picture->width, t, exact, cosine,
                   hit ? distance_at(picture->shown, ray, t) : 0);
        }
    }
    return found;
}
