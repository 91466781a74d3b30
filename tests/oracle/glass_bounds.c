/* SPDX-License-Identifier: MIT
 *
 * The volumes, by their least distance from the center: none comes closer than 1.05 radii. */
#include "glass_bounds.h"

#include <math.h>

/* At right angles: a rotation by halves and roots of two. */
static float turned[3][3] = {
    {0.5f, 0.5f, 0.70710678f}, {-0.70710678f, 0.70710678f, 0.0f}, {-0.5f, -0.5f, 0.70710678f}};

static void ball_interval(void *user, const float origin[3], const float direction[3], float *t_in,
                          float *t_out) {
    const glass_volume *ball = user;
    double square = 0, along = 0, apart = 0, offset[3], half;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = (double)direction[axis];
        offset[axis] = (double)origin[axis] - ball->center[axis];
        square += d * d;
        along += d * offset[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double side = offset[axis] - along / square * (double)direction[axis];
        apart += side * side;
    }
    half = ball->radius * ball->radius - apart;
    *t_in = 1;
    *t_out = 0;
    if (half < 0) return;
    half = sqrt(half / square);
    /* Rounding to float may cut off half an ulp, which is the callback's to add. */
    *t_in = nextafterf((float)(-along / square - half), -INFINITY);
    *t_out = nextafterf((float)(-along / square + half), INFINITY);
}

static void ball_intervals(void *user, size_t n, const float *const origin[3],
                           const float *const direction[3], float *t_in, float *t_out) {
    for (size_t i = 0; i < n; ++i) {
        const float o[3] = {origin[0][i], origin[1][i], origin[2][i]};
        const float d[3] = {direction[0][i], direction[1][i], direction[2][i]};
        ball_interval(user, o, d, &t_in[i], &t_out[i]);
    }
}

/* With a box, as bound.h asks for. */
static void cut(spt_bound *bound, const double center[3], double half) {
    for (int axis = 0; axis < 3; ++axis) {
        bound->low[axis] = (float)(center[axis] - half);
        bound->high[axis] = (float)(center[axis] + half);
    }
}

static spt_bound of_planes(const double center[3], double radius, glass_volume *volume) {
    spt_bound bound;
    for (int i = 0; i < 8; ++i) {
        spt_bound_plane *plane = &volume->planes[i];
        double offset = 1.1 * radius * sqrt(3.0); /* the normal's length */
        for (int axis = 0; axis < 3; ++axis) {
            plane->normal[axis] = (i >> axis) % 2 != 0 ? 1.0f : -1.0f;
            offset += (double)plane->normal[axis] * center[axis];
        }
        plane->offset = (float)offset;
    }
    bound = spt_bound_polytope(volume->planes, 8);
    cut(&bound, center, 2 * radius);
    return bound;
}

static spt_bound of_slab(const double center[3], double radius) {
    const float normal[3] = {1.0f, 2.0f, 2.0f}; /* the length is 3 */
    const double across = center[0] + 2 * center[1] + 2 * center[2];
    spt_bound bound =
        spt_bound_slab(normal, (float)(across - 3.3 * radius), (float)(across + 3.3 * radius));
    cut(&bound, center, 3 * radius);
    return bound;
}

static spt_bound of_caller(const double center[3], double radius, int batch, glass_volume *volume) {
    spt_bound bound =
        spt_bound_callback(batch ? ball_intervals : NULL, batch ? NULL : ball_interval, volume);
    volume->radius = 1.2 * radius;
    for (int axis = 0; axis < 3; ++axis) volume->center[axis] = center[axis];
    cut(&bound, center, 1.15 * radius);
    return bound;
}

spt_bound glass_bound(int number, const double center[3], double radius, glass_volume *volume,
                      const char **name) {
    static const char *const names[glass_bound_count] = {
        "sphere",    "box",  "oriented box", "capsule",        "cylinder",
        "ellipsoid", "slab", "polytope",     "callback batch", "callback point"};
    const float c[3] = {(float)center[0], (float)center[1], (float)center[2]}, r = (float)radius;
    const float from[3] = {c[0] - r, c[1] - 0.5f * r, c[2] - r};
    const float to[3] = {c[0] + r, c[1] + 0.5f * r, c[2] + r};
    const float half[3] = {1.05f * r, 1.2f * r, 1.5f * r};
    *name = names[number];
    switch (number) {
    case 0:
        return spt_bound_sphere(c[0], c[1] + 0.1f * r, c[2], 1.2f * r);
    case 1:
        return spt_bound_box(c[0] - 1.1f * r, c[1] - 1.2f * r, c[2] - 1.3f * r, c[0] + 1.4f * r,
                             c[1] + 1.1f * r, c[2] + 1.05f * r);
    case 2:
        return spt_bound_oriented_box(c, turned, half);
    case 3:
        return spt_bound_capsule(from, c, 1.05f * r);
    case 4: /* the ends are 1.5 radii away */
        return spt_bound_cylinder(from, to, 1.05f * r);
    case 5:
        return spt_bound_ellipsoid(c, turned, half);
    case 6:
        return of_slab(center, radius);
    case 7:
        return of_planes(center, radius, volume);
    default:
        return of_caller(center, radius, number == 8, volume);
    }
}
