/* SPDX-License-Identifier: MIT
 *
 * Balls far away, of one size or growing with their distance, a planet under the camera, and a
 * sheet without thickness. Fields in double and rounded, and as users write them, |p - c| - R in
 * float. All are convex. */
#include <math.h>

#include <spheretrace/shapes.h>

#include "stability.h"

enum { center_x = 0, center_y = 1, center_z = 2, radius = 3 };

static double ball_value(const stability_world *world, const double p[3]) {
    double from[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = p[axis] - world->number[center_x + axis];
    return stability_length(from) - world->number[radius];
}

static void ball_batch(void *user, size_t n, const float *restrict x, const float *restrict y,
                       const float *restrict z, float *restrict distance) {
    const stability_world *const world = user;
    const spt_point center =
        spt_point_of((float)world->number[center_x], (float)world->number[center_y],
                     (float)world->number[center_z]);
    const float size = (float)world->number[radius];
    for (size_t i = 0; i < n; ++i) {
        distance[i] = spt_sphere(spt_translate(spt_point_of(x[i], y[i], z[i]), center), size);
    }
}

static void ball_build(stability_world *world, double x, double y, double z, double size) {
    stability_begin(world, ball_value);
    world->field.flags = SPT_FIELD_CONVEX;
    world->number[center_x] = stability_rounded(x);
    world->number[center_y] = stability_rounded(y);
    world->number[center_z] = stability_rounded(z);
    world->number[radius] = stability_rounded(size);
}

static void ball_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    const double size = world->number[radius];
    double in, out;
    stability_nothing(truth);
    if (!stability_ball_interval(ray, &world->number[center_x], size, &in, &out)) return;
    if (in <= (double)ray->t_max) stability_crossing(truth, in, 0);
    const double less = stability_rounding(world, ray, fabs(in));
    if (stability_ball_interval(ray, &world->number[center_x], size - less, &in, &out) &&
        in <= (double)ray->t_max) {
        stability_crossing(truth, in, 1);
    }
}

/* At and around the ball: up to 1.3 radii from its centre. The camera moves by a tenth of the
 * ball's size, so that no number is a round one. */
static void ball_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double size = world->number[radius];
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = report_uniform(random, -0.1, 0.1) * size;
        through[axis] = world->number[center_x + axis] + report_uniform(random, -1, 1) * size;
    }
    through[2] = world->number[center_z];
    stability_aim(ray, from, through, 3 * world->number[center_z]);
}

static void far_build(stability_world *world, double value) {
    ball_build(world, 0.3, -0.2, value * 1.0137 + 1, 1);
}

static void far_build_float(stability_world *world, double value) {
    far_build(world, value);
    world->field.batch = ball_batch;
    world->reach = world->number[center_z];
}

static void growing_build(stability_world *world, double value) {
    ball_build(world, 0.1 * value, -0.05 * value, value * 1.2637, value / 4);
}

static void growing_build_float(stability_world *world, double value) {
    growing_build(world, value);
    world->field.batch = ball_batch;
    world->reach = world->number[center_z];
}

#define DISTANCES \
    .parameter = "distance", .bound = 1, .convex = 1, .count = 9, \
    .values = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}

const stability_family stability_far_ball = {
    .name = "far_ball", DISTANCES, .build = far_build, .ray = ball_ray, .truth = ball_truth};

const stability_family stability_far_ball_float = {.name = "far_ball_float",
                                                   DISTANCES,
                                                   .build = far_build_float,
                                                   .ray = ball_ray,
                                                   .truth = ball_truth};

const stability_family stability_growing_ball = {.name = "growing_ball",
                                                 DISTANCES,
                                                 .build = growing_build,
                                                 .ray = ball_ray,
                                                 .truth = ball_truth};

const stability_family stability_growing_ball_float = {.name = "growing_ball_float",
                                                       DISTANCES,
                                                       .build = growing_build_float,
                                                       .ray = ball_ray,
                                                       .truth = ball_truth};

/* ---- A planet of growing radius, two units under the camera --------------------------------- */

/* |p - c| - R in float is off by 3u R (squares, root, difference), which is no distance bound by
 * any tolerance below that, unless the library is told that the callback works with numbers as
 * large as R: settings.size. Untold, what float costs is taken to be what the ray alone explains,
 * so that what the callback gets wrong counts as wrong. */
static void planet_build_untold(stability_world *world, double value) {
    ball_build(world, 0, -value - 2, 0, value);
    world->field.batch = ball_batch;
}

static void planet_build(stability_world *world, double value) {
    planet_build_untold(world, value);
    world->settings.size = (float)value;
    world->reach = value;
}

/* Down at 10 to 80 degrees. */
static void planet_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double steep = report_uniform(random, 0.17, 1.4), turn = report_uniform(random, 0, 6.28);
    double from[3], through[3];
    (void)world;
    for (int axis = 0; axis < 3; ++axis) from[axis] = report_uniform(random, -0.5, 0.5);
    through[0] = from[0] + cos(steep) * cos(turn);
    through[1] = from[1] - sin(steep);
    through[2] = from[2] + cos(steep) * sin(turn);
    stability_aim(ray, from, through, 100);
}

#define RADII \
    .parameter = "radius", .convex = 1, .count = 8, \
    .values = {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}

const stability_family stability_planet_told = {.name = "planet",
                                                RADII,
                                                .bound = 1,
                                                .build = planet_build,
                                                .ray = planet_ray,
                                                .truth = ball_truth};

const stability_family stability_planet_untold = {.name = "planet",
                                                  RADII,
                                                  .bound = 0,
                                                  .build = planet_build_untold,
                                                  .ray = planet_ray,
                                                  .truth = ball_truth};

/* ---- A sheet of no thickness, met head-on --------------------------------------------------- */

/* |normal . p - offset|: the spheres of both sides touch on it and tell no more. Whether one of a
 * probe beyond overlaps the one before is decided by rounding unless a margin is kept, and by that
 * alone where the tolerance is no larger than what float resolves. */
enum { sheet_normal = 0, sheet_offset = 3 };

static double sheet_side(const stability_world *world, const double p[3]) {
    return world->number[sheet_offset] - stability_dot(&world->number[sheet_normal], p);
}

static double sheet_value(const stability_world *world, const double p[3]) {
    return fabs(sheet_side(world, p));
}

static void sheet_build(stability_world *world, double value) {
    static const double normal[3] = {0.28, -0.4, 0.8726969691708572};
    stability_begin(world, sheet_value);
    for (int axis = 0; axis < 3; ++axis)
        world->number[sheet_normal + axis] = stability_rounded(normal[axis]);
    world->number[sheet_offset] = stability_rounded(1.0137 * value);
    world->settings.epsilon = 1e-9f;
    world->field.flags = SPT_FIELD_CONVEX;
}

/* Every other ray along the normal, the rest within 0.1 of it, from a tenth of the distance around
 * the origin. */
static void sheet_ray(const stability_world *world, report_random *random, spt_ray *ray) {
    const double far = world->number[sheet_offset];
    const double most = (report_bits(random) & 1) != 0 ? 0.1 : 0;
    double from[3], through[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = stability_rounded(report_uniform(random, -0.1, 0.1) * far);
        through[axis] = from[axis] + far * (world->number[sheet_normal + axis] +
                                            report_uniform(random, -most, most));
    }
    stability_aim(ray, from, through, 3 * far);
}

/* However it is rounded, the ray begins on one side and ends on the other. */
static void sheet_truth(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    double start[3], end[3];
    stability_point(ray, 0, start);
    stability_point(ray, 1, end);
    const double from = sheet_side(world, start), closer = from - sheet_side(world, end);
    stability_nothing(truth);
    stability_crossing(truth, from / closer, 1);
}

const stability_family stability_sheet = {
    .name = "sheet", DISTANCES, .build = sheet_build, .ray = sheet_ray, .truth = sheet_truth};
