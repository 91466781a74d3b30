/* SPDX-License-Identifier: MIT
 *
 * Bodies seen through an inversion, close to its pole, where lengths shrink without end and what
 * was infinitely far lies a step away. Their images are balls, met by closed form. */
#include <math.h>

#include <spheretrace/mobius.h>

#include "stability.h"

enum { near = 0, image_x = 1, image_radius = 4, kernel_x = 5, kernel_size = 8 };

typedef struct mapped_body {
    spt_conformal conformal;
    spt_field inner;
} mapped_body;

/* The inversion in the unit sphere around the pole; the body lies towards `ahead` of it. */
static const double pole[3] = {0, 0, 1};
static const double ahead[3] = {0.28, -0.4, 0.8726969691708572};

/* How far a ball around the preimage of p that touches the kernel reaches around p, when both are
 * seen through the inversion (Szecsi et al. 2016, section 6). With d the distance of p from the
 * pole, the preimage is 1/d from it, and a ball of radius rho there has the image whose nearest
 * point to p is, on the line through both and the pole, 1 / (1/d + rho) from the pole:
 * d - 1 / (1/d + rho) = h / (1 + h / d), h = rho d^2. */
static double through_inversion(double rho, double d) {
    const double h = rho * d * d;
    return h / (1 + fabs(h) / d);
}

static void preimage(const double p[3], double q[3], double *d) {
    double from[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = p[axis] - pole[axis];
    *d = stability_length(from);
    for (int axis = 0; axis < 3; ++axis) q[axis] = pole[axis] + from[axis] / (*d * *d);
}

/* With the map's matrix [a b; c d] in float, a preimage q of p is off by 32u / d (|d| |p| + |b| +
 * |q| (|c| |p| + |a|)), and lengths there are d^2 as long in the world (the bound of the tests of
 * mobius.h). Of this inversion |a| = |c| = |d| = 1 and b = 0; |q| <= 1 + 1 / d. */
static double mapped_rounding(const stability_world *world, const double p[3]) {
    double q[3], d;
    (void)world;
    preimage(p, q, &d);
    const double far = stability_length(p);
    return 32 * 0x1p-24 * d * (far + (1 + 1 / d) * (far + 1));
}

/* ---- Kernels, in their own space ------------------------------------------------------------ */

/* |q - kernel| - kernel_size, or, with kernel_size 0, a half space: what is farther than 1/2 ahead
 * of the pole. */
static double kernel_distance(const stability_world *world, const double q[3]) {
    double from[3];
    if (!(world->number[kernel_size] > 0)) {
        for (int axis = 0; axis < 3; ++axis) from[axis] = q[axis] - pole[axis];
        return 0.5 - stability_dot(from, ahead);
    }
    for (int axis = 0; axis < 3; ++axis) from[axis] = q[axis] - world->number[kernel_x + axis];
    return stability_length(from) - world->number[kernel_size];
}

static void kernel_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    const stability_world *const world = user;
    for (size_t i = 0; i < n; ++i) {
        const double q[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)kernel_distance(world, q);
    }
}

static double mapped_value(const stability_world *world, const double p[3]) {
    double q[3], d;
    preimage(p, q, &d);
    return through_inversion(kernel_distance(world, q), d);
}

static void mapped_build(stability_world *world, double value) {
    mapped_body *const body = report_allocate(sizeof *body);
    spt_mobius map;
    stability_begin(world, mapped_value);
    world->number[near] = value;
    world->memory = body;
    body->inner = spt_field_default();
    body->inner.batch = kernel_batch;
    body->inner.user = world;
    report_expect(spt_mobius_inversion(pole, 1, &map) == SPT_OK &&
                      spt_conformal_field(&body->inner, &map, &body->conformal, &world->field) ==
                          SPT_OK,
                  "an inversion is refused");
    world->more = mapped_rounding;
}

static void mapped_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double *const center = &world->number[image_x], radius = world->number[image_radius];
    double in, out;
    stability_nothing(truth);
    if (!stability_ball_interval(ray, center, radius, &in, &out)) return;
    if (in >= 0 && in <= (double)ray->t_max) stability_crossing(truth, in, 0);
    const double less = stability_rounding(world, ray, fabs(in));
    if (stability_ball_interval(ray, center, radius - less, &in, &out) && in >= 0 &&
        in <= (double)ray->t_max) {
        stability_crossing(truth, in, 1);
    }
}

/* ---- The image passes the pole: a ball of diameter 2 that touches it ------------------------ */

static void pole_build(stability_world *world, double value) {
    mapped_build(world, value);
    world->number[image_radius] = 1;
    for (int axis = 0; axis < 3; ++axis) world->number[image_x + axis] = pole[axis] + ahead[axis];
}

/* At a place within the parameter of the pole. */
static void pole_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double radius = world->number[near];
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.5, 0.5);
        through[axis] = pole[axis] + report_uniform(random, -radius, radius);
    }
    from[2] -= 1;
    stability_aim(ray, from, through, 6);
}

const stability_family stability_conformal_pole = {
    .name = "conformal_pole",
    .parameter = "distance from the pole",
    .bound = 1,
    .count = 8,
    .values = {1, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6},
    .build = pole_build,
    .ray = pole_ray,
    .truth = mapped_truth};

/* ---- The kernel passes close to the centre: its image grows without end --------------------- */

/* A ball of radius 1, the parameter away from the centre of inversion. Its image has its near side
 * 1 / (2 + e) ahead of the pole and its far side at 1 / e. */
static void ball_build(stability_world *world, double value) {
    mapped_build(world, value);
    const double close = 1 / (2 + value), far = 1 / value;
    world->number[kernel_size] = 1;
    world->number[image_radius] = (far - close) / 2;
    for (int axis = 0; axis < 3; ++axis) {
        world->number[kernel_x + axis] = pole[axis] + (1 + value) * ahead[axis];
        world->number[image_x + axis] = pole[axis] + (far + close) / 2 * ahead[axis];
    }
}

static void ball_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.5, 0.5);
        through[axis] = pole[axis] + report_uniform(random, -1.5, 1.5);
    }
    from[2] -= 1;
    through[2] += 1;
    stability_aim(ray, from, through, 6);
}

const stability_family stability_conformal_ball = {
    .name = "conformal_ball",
    .parameter = "gap to the centre",
    .bound = 1,
    .count = 8,
    .values = {1, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6},
    .build = ball_build,
    .ray = ball_ray,
    .truth = mapped_truth};
