/* SPDX-License-Identifier: MIT
 *
 * Fields steeper than 1: a ball with a rippled surface, and a twisted column. With their Lipschitz
 * constant told to the library they are distance bounds; left at 1 they are not. Callbacks in
 * float, from the library's shapes. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "stability.h"

enum { ripple = 0, rate = 0 };

#define SLOPES .count = 10, .values = {1.1, 1.25, 1.5, 2, 2.5, 3, 4, 6, 8, 12}

/* ---- |p - (0, 0, 4)| - 1 + ripple sin 20x sin 20y sin 20z ----------------------------------- */

/* The gradient of the product of sines has at most the length 20: the three squares sum to at most
 * 1. So the slope is at most 1 + 20 ripple. */
static double sine_value(const stability_world *world, const double p[3]) {
    const double from[3] = {p[0], p[1], p[2] - 4};
    return stability_length(from) - 1 +
           world->number[ripple] * sin(20 * p[0]) * sin(20 * p[1]) * sin(20 * p[2]);
}

static void sine_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float amplitude = (float)world->number[ripple];
    for (size_t i = 0; i < n; ++i) {
        const float ball = spt_sphere(spt_point_of(x[i], y[i], z[i] - 4.0f), 1);
        distance[i] =
            ball + amplitude * spt_sin(20 * x[i]) * spt_sin(20 * y[i]) * spt_sin(20 * z[i]);
    }
}

static void sine_build(stability_world *world, double value) {
    stability_begin(world, sine_value);
    world->field.batch = sine_batch;
    world->number[ripple] = stability_rounded((value - 1) / 20);
    world->slope = 1 + 20 * world->number[ripple];
    world->field.lipschitz = (float)(world->slope * (1 + 1e-6)); /* rounded up */
    world->reach = 4;
}

static void sine_build_untold(stability_world *world, double value) {
    sine_build(world, value);
    world->field.lipschitz = 1;
}

/* At a square around the middle; what lies outside the ball misses. */
static void square_ray(report_random *random, double z, double half_x, double half_y,
                       spt_ray *ray) {
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = report_uniform(random, -0.3, 0.3);
    through[0] = report_uniform(random, -half_x, half_x);
    through[1] = report_uniform(random, -half_y, half_y);
    through[2] = z;
    stability_aim(ray, from, through, 20);
}

static void sine_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    (void)world;
    square_ray(random, 4, 1.5, 1.5, ray);
}

const stability_family stability_sine_told = {.name = "sine",
                                              .parameter = "slope",
                                              .bound = 1,
                                              SLOPES,
                                              .build = sine_build,
                                              .ray = sine_ray,
                                              .truth = stability_walk_ray};

const stability_family stability_sine_untold = {.name = "sine",
                                                .parameter = "slope",
                                                .bound = 0,
                                                SLOPES,
                                                .build = sine_build_untold,
                                                .ray = sine_ray,
                                                .truth = stability_walk_ray};

/* ---- A column of half size (0.4, 1.2, 0.15) around (0, 0, 4), twisted about y --------------- */

static const float column_half[3] = {0.4f, 1.2f, 0.15f};

/* What contains it: a cylinder, within which the twist has its Lipschitz constant. */
static const double column_radius = 0.45, column_height = 1.25;

typedef struct column_memory {
    spt_bound bound;
} column_memory;

static double twist_value(const stability_world *world, const double p[3]) {
    const double turn = world->number[rate] * p[1], c = cos(turn), s = sin(turn);
    const double x = p[0], z = p[2] - 4;
    const double q[3] = {c * x - s * z, p[1], s * x + c * z};
    double outside[3], inside = -HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = fabs(q[axis]) - (double)column_half[axis];
        inside = fmax(inside, beyond);
        outside[axis] = fmax(beyond, 0);
    }
    return stability_length(outside) + fmin(inside, 0);
}

static void twist_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                        const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const float turn = (float)world->number[rate];
    const spt_point half = spt_point_of(column_half[0], column_half[1], column_half[2]);
    for (size_t i = 0; i < n; ++i) {
        const spt_point p = spt_point_of(x[i], y[i], z[i] - 4.0f);
        distance[i] = spt_box(spt_twist(p, turn), half);
    }
}

/* The largest singular value of a twist is L = (a + sqrt(a^2 + 4)) / 2 with a = rate radius (Szecsi
 * et al. 2016, section 5.2, after Hart 1996), so a = L - 1 / L. */
static void twist_build(stability_world *world, double value) {
    static const float low[3] = {0, -1.25f, 4}, high[3] = {0, 1.25f, 4};
    stability_begin(world, twist_value);
    column_memory *const memory = report_allocate(sizeof *memory);
    memory->bound = spt_bound_cylinder(low, high, (float)column_radius);
    world->memory = memory;
    world->field.batch = twist_batch;
    world->field.bound = &memory->bound;
    world->number[rate] = stability_rounded((value - 1 / value) / column_radius);
    world->slope = value * (1 + 1e-6);
    world->field.lipschitz = (float)world->slope;
    world->reach = 4;
    world->units = 12; /* the sine of the shapes is off by 1.5e-7 = 2.5u more */
}

static void twist_build_untold(stability_world *world, double value) {
    twist_build(world, value);
    world->field.lipschitz = 1;
}

static void twist_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    (void)world;
    square_ray(random, 4, 0.5, 1.3, ray);
}

/* The walk goes through the cylinder only, where the slope is known. */
static void twist_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double x = (double)ray->origin[0], z = (double)ray->origin[2] - 4;
    const double dx = (double)ray->direction[0], dz = (double)ray->direction[2];
    const double dy = (double)ray->direction[1], square = dx * dx + dz * dz;
    const double middle = -(x * dx + z * dz) / square;
    const double room = column_radius * column_radius - (x + middle * dx) * (x + middle * dx) -
                        (z + middle * dz) * (z + middle * dz);
    stability_nothing(truth);
    if (!(room > 0)) return;
    double in = fmax(middle - sqrt(room / square), 0), out = middle + sqrt(room / square);
    if (fabs(dy) > 0) {
        const double a = (-column_height - (double)ray->origin[1]) / dy;
        const double b = (column_height - (double)ray->origin[1]) / dy;
        in = fmax(in, fmin(a, b));
        out = fmin(out, fmax(a, b));
    }
    stability_walk(world, ray, in, out, truth);
}

const stability_family stability_twist_told = {.name = "twist",
                                               .parameter = "slope",
                                               .bound = 1,
                                               SLOPES,
                                               .build = twist_build,
                                               .ray = twist_ray,
                                               .truth = twist_truth};

const stability_family stability_twist_untold = {.name = "twist",
                                                 .parameter = "slope",
                                                 .bound = 0,
                                                 SLOPES,
                                                 .build = twist_build_untold,
                                                 .ray = twist_ray,
                                                 .truth = twist_truth};
