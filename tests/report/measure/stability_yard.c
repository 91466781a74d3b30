/* SPDX-License-Identifier: MIT
 *
 * A ball, a box and a floor: divided by a factor, scaled, and with NaN in a share of its space. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "stability.h"

enum { size = 0, divisor = 1, nan_share = 2 };

/* In units of the scene. Numbers of few bits, so that float and double see the same. */
static const double ball_at[3] = {-0.75, 0, 4}, ball_radius = 0.5;
static const double box_at[3] = {0.625, -0.125, 3.5}, box_half = 0.375;
static const double floor_y = -0.625;

static double yard_distance(double scale, const double p[3]) {
    double from_ball[3], outside[3], inside = -HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        from_ball[axis] = p[axis] - scale * ball_at[axis];
        const double beyond = fabs(p[axis] - scale * box_at[axis]) - scale * box_half;
        inside = fmax(inside, beyond);
        outside[axis] = fmax(beyond, 0);
    }
    const double ball = stability_length(from_ball) - scale * ball_radius;
    const double box = stability_length(outside) + fmin(inside, 0);
    return fmin(fmin(ball, box), p[1] - scale * floor_y);
}

static double yard_value(const stability_world *world, const double p[3]) {
    return yard_distance(world->number[size], p) / world->number[divisor];
}

static void yard_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float s = (float)world->number[size], factor = (float)world->number[divisor];
    const spt_point ball = spt_point_of(s * (float)ball_at[0], 0, s * (float)ball_at[2]);
    const spt_point box =
        spt_point_of(s * (float)box_at[0], s * (float)box_at[1], s * (float)box_at[2]);
    const spt_point half =
        spt_point_of(s * (float)box_half, s * (float)box_half, s * (float)box_half);
    const float radius = s * (float)ball_radius, ground = s * (float)floor_y;
    for (size_t i = 0; i < n; ++i) {
        const spt_point p = spt_point_of(x[i], y[i], z[i]);
        const float bodies = spt_least(spt_sphere(spt_translate(p, ball), radius),
                                       spt_box(spt_translate(p, box), half));
        distance[i] = spt_least(bodies, y[i] - ground) / factor;
    }
}

static void yard_build(stability_world *world, double scale) {
    stability_begin(world, yard_value);
    world->field.batch = yard_batch;
    world->number[size] = stability_rounded(scale);
    world->number[divisor] = 1;
    world->reach = 4 * scale;
}

/* At the bodies and what is around them; every fourth ray over them, into the open. */
static void yard_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double s = world->number[size];
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = s * report_uniform(random, -0.3, 0.3);
    through[0] = s * report_uniform(random, -1.5, 1.5);
    through[1] = s * report_uniform(random, -0.7, 1.2);
    through[2] = s * 4;
    stability_aim(ray, from, through, 30 * s);
}

/* ---- Divided by a factor; with that told, a Lipschitz constant below 1, and without --------- */

static void divided_build(stability_world *world, double value) {
    yard_build(world, 1);
    world->number[divisor] = value;
    world->slope = 1 / value;
}

static void divided_build_told(stability_world *world, double value) {
    divided_build(world, value);
    world->field.lipschitz = (float)(1 / value);
}

#define DIVISORS \
    .parameter = "divisor", .bound = 1, .count = 10, \
    .values = {2, 4, 8, 16, 32, 64, 128, 256, 512, 1000}

const stability_family stability_divided = {.name = "divided",
                                            DIVISORS,
                                            .build = divided_build,
                                            .ray = yard_ray,
                                            .truth = stability_walk_ray};

const stability_family stability_divided_told = {.name = "divided_told",
                                                 DIVISORS,
                                                 .build = divided_build_told,
                                                 .ray = yard_ray,
                                                 .truth = stability_walk_ray};

/* ---- All lengths times a factor, the tolerance too ------------------------------------------ */

static void scale_build(stability_world *world, double value) {
    yard_build(world, value);
    world->settings.epsilon = (float)(1e-4 * value);
}

const stability_family stability_scale = {.name = "scale",
                                          .parameter = "scale",
                                          .bound = 1,
                                          .count = 9,
                                          .values = {1e-8, 1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6, 1e8},
                                          .build = scale_build,
                                          .ray = yard_ray,
                                          .truth = stability_walk_ray};

/* ---- NaN in cells of a quarter, drawn by lot ------------------------------------------------ */

static int is_nan_cell(double share, const double p[3]) {
    uint64_t seed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        seed = seed * 0x100000001b3u + (uint64_t)(int64_t)floor(4 * p[axis]);
    }
    report_random random = {seed};
    return report_uniform(&random, 0, 1) < share;
}

static void nan_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    const stability_world *const world = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = is_nan_cell(world->number[nan_share], p) ? NAN : (float)yard_distance(1, p);
    }
}

static void nan_build(stability_world *world, double value) {
    yard_build(world, 1);
    world->field.batch = nan_batch;
    world->number[nan_share] = value;
}

const stability_family stability_nan_cells = {
    .name = "nan_cells",
    .parameter = "share",
    .bound = 0,
    .count = 8,
    .values = {1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2, 0.35, 0.5},
    .build = nan_build,
    .ray = yard_ray,
    .truth = stability_walk_ray};
