/* SPDX-License-Identifier: MIT
 *
 * Rays that come to a plane or a ball at a small angle, or pass it by as closely. Both fields are
 * convex, so all step rules run. */
#include <math.h>

#include "stability.h"

enum { angle = 0 };

/* ---- Plane y = 0, solid below --------------------------------------------------------------- */

static double plane_value(const stability_world *world, const double p[3]) {
    (void)world;
    return p[1];
}

static void plane_build(stability_world *world, double value) {
    stability_begin(world, plane_value);
    world->field.flags = SPT_FIELD_CONVEX;
    world->number[angle] = value;
}

static void plane_build_patient(stability_world *world, double value) {
    plane_build(world, value);
    world->settings.budget = 1000;
}

/* From heights of 0.05 to 0.5 down to the plane, four times as far as it takes to come there; one
 * of four goes up instead. */
static void plane_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double up = (report_bits(random) & 3) == 0 ? 1 : -1;
    const double height = report_uniform(random, 0.05, 0.5);
    const double turn = report_uniform(random, 0, 6.283185307179586);
    const double from[3] = {report_uniform(random, -1, 1), height, report_uniform(random, -1, 1)};
    const double along = cos(world->number[angle]), steep = sin(world->number[angle]);
    stability_aim(ray, from, from, 0);
    ray->direction[0] = (float)(along * cos(turn));
    ray->direction[1] = (float)(up * steep);
    ray->direction[2] = (float)(along * sin(turn));
    ray->t_max = (float)(4 * height / steep);
}

static void plane_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double height = (double)ray->origin[1], down = -(double)ray->direction[1];
    stability_nothing(truth);
    if (!(down > 0)) return;
    const double end = (double)ray->t_max;
    stability_crossing(truth, height / down,
                       down * end - height > stability_rounding(world, ray, end));
}

#define PLANE_VALUES \
    .count = 11, .values = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6}

const stability_family stability_grazing_plane = {.name = "grazing_plane",
                                                  .parameter = "angle",
                                                  .bound = 1,
                                                  .convex = 1,
                                                  PLANE_VALUES,
                                                  .build = plane_build,
                                                  .ray = plane_ray,
                                                  .truth = plane_truth};

const stability_family stability_grazing_plane_patient = {.name = "grazing_plane_patient",
                                                          .parameter = "angle",
                                                          .bound = 1,
                                                          .convex = 1,
                                                          PLANE_VALUES,
                                                          .build = plane_build_patient,
                                                          .ray = plane_ray,
                                                          .truth = plane_truth};

/* ---- Ball of radius 1 around (0, 0, 3) ------------------------------------------------------ */

static const double ball_center[3] = {0, 0, 3};

static double ball_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - ball_center[2]};
    (void)world;
    return stability_length(from) - 1;
}

static void ball_build(stability_world *world, double value) {
    stability_begin(world, ball_value);
    world->field.flags = SPT_FIELD_CONVEX;
    world->number[angle] = value;
    world->reach = 3;
}

/* Half of the rays meet the ball at the angle, so that they come as deep as 1 - cos(angle); half
 * pass it by at about that height. */
static void ball_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double cosine = cos(world->number[angle]);
    const double least = (report_bits(random) & 1) != 0 ? cosine : 1 / cosine;
    double from[3], to[3], side[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = stability_rounded(report_uniform(random, -0.3, 0.3));
        to[axis] = ball_center[axis] - from[axis];
        side[axis] = report_uniform(random, -1, 1);
    }
    const double far = stability_length(to);
    for (int axis = 0; axis < 3; ++axis) to[axis] /= far;
    const double along = stability_dot(side, to);
    for (int axis = 0; axis < 3; ++axis) side[axis] -= along * to[axis];
    const double length = stability_length(side);
    /* the ray's foot: `least` from the centre, across the ray */
    const double sine = least / far, foot = sqrt(1 - sine * sine);
    for (int axis = 0; axis < 3; ++axis) {
        through[axis] = from[axis] + far * foot * (foot * to[axis] + sine * side[axis] / length);
    }
    stability_aim(ray, from, through, 20);
}

static void ball_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    double in, out;
    stability_nothing(truth);
    if (stability_ball_interval(ray, ball_center, 1, &in, &out)) stability_crossing(truth, in, 0);
    if (stability_ball_interval(ray, ball_center, 1 - stability_rounding(world, ray, 3), &in, &out))
        stability_crossing(truth, in, 1);
}

const stability_family stability_grazing_ball = {
    .name = "grazing_ball",
    .parameter = "angle",
    .bound = 1,
    .convex = 1,
    .count = 11,
    .values = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6},
    .build = ball_build,
    .ray = ball_ray,
    .truth = ball_truth};
