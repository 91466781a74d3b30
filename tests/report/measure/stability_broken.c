/* SPDX-License-Identifier: MIT
 *
 * Fields that are no distance bounds: a jump, cells that do not look at their neighbours, and the
 * usual estimate of a Mandelbulb. Callbacks in double and rounded. */
#include <math.h>

#include "stability.h"

/* ---- Jump: a ball around (0, 0, 4), smaller on the side x >= 0 ------------------------------ */

enum { jump = 0, offset = 1, iterations = 2 };

static const double jump_center[3] = {0, 0, 4};

/* The half on the left sticks out by the jump, and the field on the right does not know it. */
static double jump_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - jump_center[2]};
    return stability_length(from) - 1 + (p[0] < 0 ? 0 : world->number[jump]);
}

static void jump_build(stability_world *world, double value) {
    stability_begin(world, jump_value);
    world->number[jump] = value;
    world->reach = 4;
}

/* From the right to the left. */
static void jump_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = report_uniform(random, -1.2, 1.2);
    }
    from[0] += 3;
    through[2] = 4;
    stability_aim(ray, from, through, 20);
}

/* Where the ray is in the half of a ball that lies on one side, moved in by `less`. */
static int meet_half(const spt_ray *ray, double radius, double side, double less, double *t) {
    double in, out;
    if (!stability_ball_interval(ray, jump_center, radius - less, &in, &out)) return 0;
    const double ahead = side * (double)ray->direction[0]; /* never 0 among these rays */
    const double mirror = (less - side * (double)ray->origin[0]) / ahead;
    if (ahead > 0) {
        in = fmax(in, mirror);
    } else {
        out = fmin(out, mirror);
    }
    *t = in;
    return in < out;
}

static void jump_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double small = 1 - world->number[jump], less = stability_rounding(world, ray, 5);
    double t;
    stability_nothing(truth);
    if (meet_half(ray, 1, -1, 0, &t)) stability_crossing(truth, t, 0);
    if (meet_half(ray, small, 1, 0, &t)) stability_crossing(truth, t, 0);
    if (meet_half(ray, 1, -1, less, &t)) stability_crossing(truth, t, 1);
    if (meet_half(ray, small, 1, less, &t)) stability_crossing(truth, t, 1);
}

const stability_family stability_jump = {.name = "jump",
                                         .parameter = "height",
                                         .bound = 0,
                                         .count = 8,
                                         .values = {1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2, 0.4, 0.8},
                                         .build = jump_build,
                                         .ray = jump_ray,
                                         .truth = jump_truth};

/* ---- Cells of size 1, a ball of radius 0.15 in each, off its middle by lot ------------------ */

static double cell_ball(const stability_world *world, const double p[3], const double cell[3]) {
    double from[3];
    uint64_t seed = 0;
    for (int axis = 0; axis < 3; ++axis)
        seed = seed * 0x100000001b3u + (uint64_t)(int64_t)cell[axis];
    report_random random = {seed};
    for (int axis = 0; axis < 3; ++axis) {
        const double off = world->number[offset] * report_uniform(&random, -1, 1);
        from[axis] = p[axis] - (cell[axis] + 0.5 + off);
    }
    return stability_length(from) - 0.15;
}

/* The truth: the cells around are asked, too; other balls are at least 1 away. */
static double cells_value(const stability_world *world, const double p[3]) {
    double least = 1, cell[3];
    for (int i = 0; i < 27; ++i) {
        cell[0] = floor(p[0]) + i % 3 - 1;
        cell[1] = floor(p[1]) + i / 3 % 3 - 1;
        cell[2] = floor(p[2]) + i / 9 - 1;
        least = fmin(least, cell_ball(world, p, cell));
    }
    return least;
}

static void cells_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *distance) {
    const stability_world *const world = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        const double cell[3] = {floor(p[0]), floor(p[1]), floor(p[2])};
        distance[i] = (float)cell_ball(world, p, cell);
    }
}

static void cells_build(stability_world *world, double value) {
    stability_begin(world, cells_value);
    world->field.batch = cells_batch;
    world->number[offset] = value;
    world->reach = 1;
}

/* From about a corner of cells, anywhere. */
static void cells_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.05, 0.05);
        through[axis] = report_uniform(random, -1, 1);
    }
    stability_aim(ray, from, through, 12);
}

const stability_family stability_cells = {.name = "cells",
                                          .parameter = "offset",
                                          .bound = 0,
                                          .count = 8,
                                          .values = {0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3},
                                          .build = cells_build,
                                          .ray = cells_ray,
                                          .truth = stability_walk_ray};

/* ---- Mandelbulb of power 8, around (0, 0, 3) ------------------------------------------------ */

static const double bulb_center[3] = {0, 0, 3}, bulb_radius = 1.25;

/* cos and sin of eight times an angle. */
static void turn_eightfold(double *cosine, double *sine) {
    for (int i = 0; i < 3; ++i) {
        const double c = *cosine, s = *sine;
        *cosine = c * c - s * s;
        *sine = 2 * c * s;
    }
}

/* q -> q^8 + p in the spherical coordinates of White and Nylander, and the estimate
 * |q| log|q| / (2 |dq/dp|) of Quilez. */
static double bulb_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - bulb_center[2]};
    double q[3] = {from[0], from[1], from[2]}, derivative = 1, r = stability_length(q);
    for (int i = 0; i < (int)world->number[iterations] && r < 16; ++i) {
        const double flat = sqrt(q[0] * q[0] + q[1] * q[1]) + 1e-30, r7 = pow(r, 7);
        double c = q[2] / (r + 1e-30), s = flat / (r + 1e-30), u = q[0] / flat, v = q[1] / flat;
        turn_eightfold(&c, &s);
        turn_eightfold(&u, &v);
        derivative = 8 * r7 * derivative + 1;
        q[0] = r7 * r * s * u + from[0];
        q[1] = r7 * r * s * v + from[1];
        q[2] = r7 * r * c + from[2];
        r = stability_length(q);
    }
    return 0.5 * log(r + 1e-30) * r / derivative;
}

static void bulb_build(stability_world *world, double value) {
    stability_begin(world, bulb_value);
    world->number[iterations] = value;
    world->reach = 3;
}

static void bulb_build_halved(stability_world *world, double value) {
    bulb_build(world, value);
    world->field.lipschitz = 2;
}

static void bulb_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = report_uniform(random, -1.2, 1.2);
    }
    through[2] = 3;
    stability_aim(ray, from, through, 10);
}

/* No slope is known, so the walk takes a tenth of the estimate and never less than a quarter of the
 * tolerance. What it meets is clear where the ray stays inside for two tolerances. */
static void bulb_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double tolerance = (double)world->settings.epsilon, length = 2 * tolerance;
    double t, out, entered = HUGE_VAL, p[3];
    stability_nothing(truth);
    if (!stability_ball_interval(ray, bulb_center, bulb_radius, &t, &out)) return;
    while (t <= out) {
        stability_point(ray, t, p);
        const double value = bulb_value(world, p);
        if (value < 0) {
            entered = fmin(entered, t);
            truth->first = fmin(truth->first, entered);
            if (t - entered >= length) {
                truth->clear = entered;
                truth->last = t;
                return;
            }
        } else {
            entered = HUGE_VAL;
        }
        t += value < 0 ? tolerance / 4 : fmin(fmax(value / 10, tolerance / 4), 0.01);
    }
}

#define ITERATIONS \
    .parameter = "iterations", .bound = 0, .count = 8, .values = {1, 2, 3, 4, 6, 8, 12, 16}

const stability_family stability_mandelbulb = {
    .name = "mandelbulb", ITERATIONS, .build = bulb_build, .ray = bulb_ray, .truth = bulb_truth};

const stability_family stability_mandelbulb_halved = {.name = "mandelbulb_halved",
                                                      ITERATIONS,
                                                      .build = bulb_build_halved,
                                                      .ray = bulb_ray,
                                                      .truth = bulb_truth};
