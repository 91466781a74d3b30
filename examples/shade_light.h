/* SPDX-License-Identifier: MIT
 *
 * The light that falls on points: of the sun past the scene's parts, and of the sky. Belongs to
 * shade.c. */
#ifndef EXAMPLES_SHADE_LIGHT_H
#define EXAMPLES_SHADE_LIGHT_H

#include "shade.h"

/* What is known of the points to be shaded; entry k belongs to ray place[k]. */
typedef struct surface_points {
    size_t count;
    size_t place[SPT_BATCH];
    float point[SPT_BATCH][3], normal[SPT_BATCH][3];
    float t[SPT_BATCH], half_pixel[SPT_BATCH];
    float over[SPT_BATCH];                       /* at least so far off the surface */
    float light[SPT_BATCH], openness[SPT_BATCH]; /* of sun and sky, 0 to 1 */
    int on_ground[SPT_BATCH];                    /* on the added ground */
} surface_points;

extern const float light_sun_direction[3]; /* unit length, towards the sun */

static inline float light_dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline float light_clamp(float value, float low, float high) {
    return value > low ? (value < high ? value : high) : low; /* NaN becomes low */
}

/* The whole field at the first count points of the scratch. */
void light_evaluate(const shading *shader, const shade_scratch *at, size_t count);

/* Fills shader->casters, the union as shadow rays see it, once the ground is known. */
void light_prepare_casters(shading *shader, const scene *shown, scene_grain grain);

/* Fills points->openness. */
void light_find_openness(const shading *shader, shade_scratch *scratch, surface_points *points);

/* Fills points->light; part as for shade_rays(). */
void light_find_sun(const shading *shader, shade_scratch *scratch, const int *part,
                    surface_points *points);

#endif
