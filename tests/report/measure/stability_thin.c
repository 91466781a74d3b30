/* SPDX-License-Identifier: MIT
 *
 * Thin bodies before a wall, as exact distances in float, and where rays meet them by closed form.
 * A sheet thinner than float resolves is still met for certain: whichever way a ray is rounded, it
 * begins before the sheet and ends behind it. Of a wire that does not hold. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "stability.h"

#define THICKNESSES \
    .parameter = "thickness", .bound = 1, .count = 11, \
    .values = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6}

/* So small a tolerance that what float resolves takes its place: about 1e-6 in these scenes. */
#define FINE 1e-9f

/* ---- The wall: z = number[0], solid behind -------------------------------------------------- */

enum { wall = 0, half_thickness = 1 };

static void meet_wall(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double ahead = (double)ray->direction[2];
    if (!(ahead > 0)) return;
    const double t = (world->number[wall] - (double)ray->origin[2]) / ahead;
    if (t <= (double)ray->t_max) stability_crossing(truth, t, 1);
}

static void begin_before_wall(stability_world *world, stability_value_fn *value, double thickness,
                              double wall_z, spt_distance_batch_fn *batch) {
    stability_begin(world, value);
    world->field.batch = batch;
    world->number[wall] = wall_z;
    world->number[half_thickness] = stability_rounded(thickness / 2);
    world->reach = wall_z;
    world->units = 16; /* turned by a matrix of floats, whose entries are off by half an ulp each */
}

/* ---- Plate: |x|, |y| <= 1, |z| <= thickness / 2, turned, at z = 2 --------------------------- */

static const double plate_center[3] = {0, 0, 2};

/* Its axes: two small turns, in double. The callback rounds them to float. */
static const double plate_axes[3][3] = {
    {0.93969262078590843, 0, -0.34202014332566871},
    {0.059391174613884703, 0.98480775301220802, 0.16317591116653482},
    {0.33682408883346515, -0.17364817766693033, 0.92541657839832336}};

static void to_plate(const double p[3], double q[3]) {
    double from[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = p[axis] - plate_center[axis];
    for (int axis = 0; axis < 3; ++axis) q[axis] = stability_dot(plate_axes[axis], from);
}

static double box_distance(const double q[3], const double half[3]) {
    double outside[3], inside = -HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = fabs(q[axis]) - half[axis];
        inside = fmax(inside, beyond);
        outside[axis] = fmax(beyond, 0);
    }
    return stability_length(outside) + fmin(inside, 0);
}

static double plate_value(const stability_world *world, const double p[3]) {
    const double half[3] = {1, 1, world->number[half_thickness]};
    double q[3];
    to_plate(p, q);
    return fmin(box_distance(q, half), world->number[wall] - p[2]);
}

static void plate_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                        const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float behind = (float)world->number[wall], half = (float)world->number[half_thickness];
    spt_point axes[3];
    for (int i = 0; i < 3; ++i) {
        axes[i] =
            spt_point_of((float)plate_axes[i][0], (float)plate_axes[i][1], (float)plate_axes[i][2]);
    }
    for (size_t i = 0; i < n; ++i) {
        const spt_point from = spt_point_of(x[i], y[i], z[i] - 2.0f);
        const spt_point q =
            spt_point_of(spt_dot(axes[0], from), spt_dot(axes[1], from), spt_dot(axes[2], from));
        distance[i] = spt_least(spt_box(q, spt_point_of(1, 1, half)), behind - z[i]);
    }
}

static void plate_build(stability_world *world, double value) {
    begin_before_wall(world, plate_value, value, 4, plate_batch);
}

/* At and around a square of 1.3 times the plate. */
static void plate_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double u = report_uniform(random, -1.3, 1.3), v = report_uniform(random, -1.3, 1.3);
    double from[3] = {0, 0, 0}, through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = plate_center[axis] + u * plate_axes[0][axis] + v * plate_axes[1][axis];
    }
    stability_aim(ray, from, through, 20);
}

/* Where a ray enters the plate with its sides moved in by `less`; 0: it does not. */
static int meet_plate(const stability_world *world, const spt_ray *ray, double less, double *t) {
    const double half[3] = {1 - less, 1 - less, world->number[half_thickness]};
    double origin[3], ahead[3], in = 0, out = (double)ray->t_max;
    stability_point(ray, 0, ahead);
    to_plate(ahead, origin);
    stability_point(ray, 1, ahead);
    to_plate(ahead, ahead);
    for (int axis = 0; axis < 3; ++axis) {
        const double direction = ahead[axis] - origin[axis]; /* never 0 among these rays */
        const double a = (-half[axis] - origin[axis]) / direction;
        const double b = (half[axis] - origin[axis]) / direction;
        in = fmax(in, fmin(a, b));
        out = fmin(out, fmax(a, b));
    }
    *t = in;
    return in <= out;
}

static void plate_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    double t;
    stability_nothing(truth);
    meet_wall(world, ray, truth);
    if (meet_plate(world, ray, 0, &t)) stability_crossing(truth, t, 0);
    if (meet_plate(world, ray, stability_rounding(world, ray, 3), &t))
        stability_crossing(truth, t, 1);
}

static void plate_build_fine(stability_world *world, double value) {
    plate_build(world, value);
    world->settings.epsilon = FINE;
}

const stability_family stability_plate = {
    .name = "plate", THICKNESSES, .build = plate_build, .ray = plate_ray, .truth = plate_truth};

const stability_family stability_plate_fine = {.name = "plate_fine",
                                               THICKNESSES,
                                               .build = plate_build_fine,
                                               .ray = plate_ray,
                                               .truth = plate_truth};

/* ---- Shell: between two balls around (0, 0, 3), whose mean radius is 1 ---------------------- */

static const double shell_center[3] = {0, 0, 3};

static double shell_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - shell_center[2]};
    return fmin(fabs(stability_length(from) - 1) - world->number[half_thickness],
                world->number[wall] - p[2]);
}

static void shell_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                        const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float behind = (float)world->number[wall], half = (float)world->number[half_thickness];
    for (size_t i = 0; i < n; ++i) {
        const float ball = spt_sphere(spt_point_of(x[i], y[i], z[i] - 3.0f), 1);
        distance[i] = spt_least(spt_magnitude(ball) - half, behind - z[i]);
    }
}

static void shell_build(stability_world *world, double value) {
    begin_before_wall(world, shell_value, value, 6, shell_batch);
}

static void disc_ray(report_random *random, const double center[3], double radius, double t_max,
                     spt_ray *ray) {
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = center[axis] + report_uniform(random, -radius, radius);
    }
    through[2] = center[2];
    stability_aim(ray, from, through, t_max);
}

static void shell_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    (void)world;
    disc_ray(random, shell_center, 1.2, 20, ray);
}

static void shell_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double outer = 1 + world->number[half_thickness];
    double in, out;
    stability_nothing(truth);
    meet_wall(world, ray, truth);
    if (stability_ball_interval(ray, shell_center, outer, &in, &out))
        stability_crossing(truth, in, 0);
    if (stability_ball_interval(ray, shell_center, outer - stability_rounding(world, ray, 4), &in,
                                &out)) {
        stability_crossing(truth, in, 1);
    }
}

static void shell_build_fine(stability_world *world, double value) {
    shell_build(world, value);
    world->settings.epsilon = FINE;
}

const stability_family stability_shell = {
    .name = "shell", THICKNESSES, .build = shell_build, .ray = shell_ray, .truth = shell_truth};

const stability_family stability_shell_fine = {.name = "shell_fine",
                                               THICKNESSES,
                                               .build = shell_build_fine,
                                               .ray = shell_ray,
                                               .truth = shell_truth};

/* ---- Wire: an endless cylinder through (0, 0, 2) -------------------------------------------- */

static const double wire_center[3] = {0, 0, 2};
static const double wire_axis[3] = {0.28221626051507914, 0.9407208683835973, 0.18814417367671946};

/* The part of a vector across the axis. */
static void across_wire(const double vector[3], double across[3]) {
    const double along = stability_dot(vector, wire_axis);
    for (int axis = 0; axis < 3; ++axis) across[axis] = vector[axis] - along * wire_axis[axis];
}

static double wire_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - wire_center[2]};
    double across[3];
    across_wire(from, across);
    return fmin(stability_length(across) - world->number[half_thickness],
                world->number[wall] - p[2]);
}

static void wire_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float behind = (float)world->number[wall], half = (float)world->number[half_thickness];
    const spt_point axis =
        spt_point_of((float)wire_axis[0], (float)wire_axis[1], (float)wire_axis[2]);
    for (size_t i = 0; i < n; ++i) {
        const spt_point q = spt_point_of(x[i], y[i], z[i] - 2.0f);
        const float h = spt_dot(q, axis);
        const float wire =
            spt_length_3(q.x - axis.x * h, q.y - axis.y * h, q.z - axis.z * h) - half;
        distance[i] = spt_least(wire, behind - z[i]);
    }
}

static void wire_build(stability_world *world, double value) {
    begin_before_wall(world, wire_value, value, 4, wire_batch);
}

/* Every other ray at the wire itself, the rest at what is near: within four times its thickness and
 * the tolerance. */
static void wire_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double half = world->number[half_thickness];
    const double near = 8 * half + 4 * (double)world->settings.epsilon;
    const double beside = (report_bits(random) & 1) != 0 ? half : near;
    const double along = report_uniform(random, -0.8, 0.8);
    double from[3], through[3], side[3] = {1, 0, 0};
    across_wire(side, side);
    const double length = stability_length(side), offset = report_uniform(random, -beside, beside);
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.3, 0.3);
        through[axis] = wire_center[axis] + along * wire_axis[axis] + offset / length * side[axis];
    }
    stability_aim(ray, from, through, 20);
}

/* Where a ray is within the cylinder of a radius. */
static int meet_wire(const spt_ray *ray, double radius, double *t) {
    double origin[3], ahead[3], apart[3];
    stability_point(ray, 0, origin);
    stability_point(ray, 1, ahead);
    for (int axis = 0; axis < 3; ++axis) {
        ahead[axis] -= origin[axis];
        origin[axis] -= wire_center[axis];
    }
    across_wire(origin, origin);
    across_wire(ahead, ahead);
    const double square = stability_dot(ahead, ahead);
    const double middle = -stability_dot(origin, ahead) / square;
    for (int axis = 0; axis < 3; ++axis) apart[axis] = origin[axis] + middle * ahead[axis];
    const double least = stability_length(apart);
    if (!(least < radius)) return 0;
    *t = middle - sqrt((radius - least) * (radius + least) / square);
    return 1;
}

static void wire_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double radius = world->number[half_thickness];
    double t;
    stability_nothing(truth);
    meet_wall(world, ray, truth);
    if (meet_wire(ray, radius, &t)) stability_crossing(truth, t, 0);
    if (meet_wire(ray, radius - stability_rounding(world, ray, 3), &t))
        stability_crossing(truth, t, 1);
}

static void wire_build_fine(stability_world *world, double value) {
    wire_build(world, value);
    world->settings.epsilon = FINE;
}

const stability_family stability_wire = {
    .name = "wire", THICKNESSES, .build = wire_build, .ray = wire_ray, .truth = wire_truth};

const stability_family stability_wire_fine = {.name = "wire_fine",
                                              THICKNESSES,
                                              .build = wire_build_fine,
                                              .ray = wire_ray,
                                              .truth = wire_truth};
