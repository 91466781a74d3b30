/* SPDX-License-Identifier: MIT
 *
 * Fields that remember where they were asked. */
#include "trail.h"
#include "../check.h"

#include <math.h>

float trail_ball(void *user, float x, float y, float z) {
    const trail *t = user;
    return sqrtf(x * x + y * y + (z - t->a) * (z - t->a)) - t->b;
}

float trail_wall(void *user, float x, float y, float z) {
    const trail *t = user;
    (void)x, (void)y;
    return (t->a - z) * t->b;
}

float trail_slab(void *user, float x, float y, float z) {
    const trail *t = user;
    (void)x, (void)y;
    return t->a - z > z - t->b ? t->a - z : z - t->b;
}

float trail_sheet(void *user, float x, float y, float z) {
    (void)x, (void)y;
    return fabsf(((const trail *)user)->a - z);
}

float trail_grazed(void *user, float x, float y, float z) {
    (void)x, (void)y, (void)z;
    return ((const trail *)user)->a;
}

float trail_above(void *user, float x, float y, float z) {
    const trail *t = user;
    const float above = trail_ball(user, x, y, z);
    return t->b > 0 && above < z + 1 ? above : z + 1;
}

float trail_passed(void *user, float x, float y, float z) {
    const float dx = x - 0.5f, dz = z - 3, side = sqrtf(dx * dx + y * y + dz * dz) - 0.4f;
    const float ahead = ((const trail *)user)->a - z;
    return side < ahead ? side : ahead;
}

/* What Keinert Equation 1 allows inside: five times the distance. */
float trail_steep(void *user, float x, float y, float z) {
    const float f = trail_slab(user, x, y, z);
    return f < 0 ? 5 * f : f;
}

/* Padding repeats the last place, a march never does. */
float trail_listen(void *user, float x, float y, float z) {
    trail *t = user;
    const int repeats = t->count > 0 && check_same_bits(t->z[t->count - 1], z);
    if (!repeats && t->count < most_places) t->z[t->count++] = z;
    return t->distance(user, x, y, z);
}

trail trail_of(spt_distance_fn *distance, float a, float b) {
    trail t = {NULL, 0, 0, 0, {0}};
    t.distance = distance;
    t.a = a;
    t.b = b;
    return t;
}

listing trail_listing(trail *t) {
    listing in = {trail_listen, NULL, {0, 0, 0}, {0, 0, 1}, 128, 0};
    in.user = t;
    return in;
}

spt_ray trail_ray(float t_min, float t_max) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 0};
    ray.t_min = t_min;
    ray.t_max = t_max;
    return ray;
}

spt_hit trail_trace(trail *t, const spt_settings *settings, const spt_ray *ray) {
    spt_field field = spt_field_default();
    field.point = trail_listen;
    field.user = t;
    t->count = 0;
    return oracle_trace_one(&field, settings, ray);
}
