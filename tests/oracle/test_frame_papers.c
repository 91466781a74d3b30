/* SPDX-License-Identifier: MIT
 *
 * Section 4 of Bálint & Valasek 2018 as it is printed, in double, and what goes wrong with it: the
 * angle of its cones, their step, and where the next resolution starts. The library on the same
 * worlds does none of that. */
#include "frame_advance.h"
#include "frame_camera.h"
#include "frame_worlds.h"
#include "../check.h"

#include <math.h>

static const double radians = 3.14159265358979323846 / 180;

static double chord(const double a[3], const double b[3]) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(camera_dot(d, d));
}

/* ---- P4: the angle of Equation 2 ----------------------------------------------------------- */

/* Equation 2 for an image, which knows no field of view. */
static double printed_slope(double width, double height) {
    return sqrt(2) / sqrt(width * width + height * height);
}

static spt_camera square_camera(double degrees) {
    const float eye[3] = {0, 0, 0}, target[3] = {0, 0, 1}, up[3] = {0, 1, 0};
    spt_camera camera;
    CHECK(spt_camera_pinhole(&camera, eye, target, up, (float)tan(degrees / 2 * radians), 64, 64) ==
          SPT_OK);
    return camera;
}

/* The widest pixel of a 64x64 image, from its middle to a corner. */
static double needed_slope(double degrees) {
    const spt_camera camera = square_camera(degrees);
    double widest = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const camera_ray middle = camera_ray_at(&camera, 64, 64, x + 0.5, y + 0.5);
            for (int corner = 0; corner < 4; ++corner) {
                const camera_ray ray =
                    camera_ray_at(&camera, 64, 64, x + (corner & 1), y + corner / 2);
                widest = fmax(widest, chord(middle.direction, ray.direction));
            }
        }
    }
    return widest;
}

static void P4_slope_of_equation_2(void) {
    static const double fields[] = {60, 75, 90, 120}, needed[] = {0.0128, 0.0170, 0.0221, 0.0383};
    CHECK(fabs(printed_slope(64, 64) - 0.0156) < 5e-5);
    for (int i = 0; i < 4; ++i) {
        const double slope = needed_slope(fields[i]);
        CHECK_SAY(fabs(slope - needed[i]) < 1e-4, "%g degrees: %g", fields[i], slope);
    }
}

/* ---- P5: the step -------------------------------------------------------------------------- */

/* Where a cone stops: printed, by steps of f until f < slope t; or by the step that leaves room for
 * the cone at its far end. */
typedef double cone_distance_fn(const void *user, double t);
static double cone_stop(cone_distance_fn *distance, const void *user, double start, double slope,
                        int printed) {
    double t = start;
    for (int i = 0; i < 1000 && t < 50; ++i) {
        const double f = distance(user, t);
        const double step = printed ? f : (f - slope * t) / (1 + slope);
        if (printed ? f < slope * t : !(step > 1e-7 * (1 + t))) break;
        t += step;
    }
    return t;
}

/* A point .3 off the axis at 7. */
static double point_distance(const void *user, double t) {
    (void)user;
    return sqrt(0.09 + (7 - t) * (7 - t));
}

/* The axis of a cone in a world. */
typedef struct cone_axis {
    const world *shape;
    const double *origin, *direction;
} cone_axis;

static double axis_distance(const void *user, double t) {
    const cone_axis *axis = user;
    double least = HUGE_VAL;
    for (int i = 0; i < axis->shape->count; ++i) {
        double v[3];
        for (int k = 0; k < 3; ++k) {
            v[k] = axis->origin[k] + t * axis->direction[k] - axis->shape->center[i][k];
        }
        least = fmin(least, sqrt(camera_dot(v, v)) - axis->shape->radius[i]);
    }
    return least;
}

/* Thin bodies are where it shows. */
static world thin_world(void) {
    world shape = world_draw();
    shape.has_floor = 0;
    for (int i = 0; i < shape.count; ++i) shape.radius[i] *= 0.2;
    return shape;
}

/* A ray within a cone around the z axis. */
static void draw_inside(double slope, double d[3]) {
    const double angle = check_uniform(0, 360) * radians;
    const double half = 2 * asin(slope / 2) * sqrt(check_uniform(0, 1));
    d[0] = sin(half) * cos(angle);
    d[1] = sin(half) * sin(angle);
    d[2] = cos(half);
}

static void P5_cone_steps(void) {
    enum { trials = 20000, inside = 8 };
    const double origin[3] = {0, 0, 0}, forward[3] = {0, 0, 1};
    int late[2] = {0, 0};
    CHECK(fabs(cone_stop(point_distance, NULL, 0, 0.05, 1) - 7.006) < 2e-3);
    CHECK(fabs(cone_stop(point_distance, NULL, 0, 0.05, 0) - 6.836) < 1e-3);
    for (int i = 0; i < trials; ++i) {
        const world shape = thin_world();
        const cone_axis axis = {&shape, origin, forward};
        const double slope = exp(check_uniform(-4, -1));
        for (int printed = 0; printed < 2; ++printed) {
            const double stop = cone_stop(axis_distance, &axis, 0, slope, printed);
            int is_late = 0;
            for (int ray = 0; ray < inside; ++ray) {
                double d[3];
                draw_inside(slope, d);
                is_late |= stop > ball_scene_first(&shape, origin, d, 1e-6);
            }
            late[printed] += is_late;
        }
    }
    CHECK_SAY(late[1] > trials / 200, "printed: %d of %d cones start rays too late", late[1],
              trials);
    CHECK_SAY(late[0] == 0, "%d of %d", late[0], trials);
}

/* ---- P6: the start of the next resolution -------------------------------------------------- */

enum { fine = 60 };

/* One pass of `side` pixels a side over a camera's image: each pixel's cone starts at the closest
 * pixel of the pass before (printed), or at the least of all that its footprint overlaps. */
static void walk_pass(const spt_camera *camera, const world *shape, int side, int before,
                      const double *start, double *stop, int printed) {
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double size = (double)fine / side;
            const camera_ray middle =
                camera_ray_at(camera, fine, fine, (x + 0.5) * size, (y + 0.5) * size);
            const cone_axis axis = {shape, middle.origin, middle.direction};
            double slope = 0, from = before == 0 ? 0 : HUGE_VAL;
            for (int corner = 0; corner < 4; ++corner) {
                const camera_ray ray = camera_ray_at(camera, fine, fine, (x + (corner & 1)) * size,
                                                     (y + corner / 2) * size);
                slope = fmax(slope, chord(middle.direction, ray.direction));
            }
            for (int row = y * before / side; row * side < (y + 1) * before; ++row) {
                for (int column = x * before / side; column * side < (x + 1) * before; ++column) {
                    const int closest = row == (2 * y + 1) * before / (2 * side) &&
                                        column == (2 * x + 1) * before / (2 * side);
                    if (printed && !closest) continue;
                    from = fmin(from, start[row * before + column]);
                }
            }
            stop[y * side + x] = cone_stop(axis_distance, &axis, from, slope, 0);
        }
    }
}

/* Rays of the fine image that would start beyond their first hit. */
static int count_late(const spt_camera *camera, const world *shape, int printed) {
    static double a[fine * fine], b[fine * fine];
    int late = 0;
    walk_pass(camera, shape, fine / 2, 0, a, a, printed);
    walk_pass(camera, shape, fine * 3 / 4, fine / 2, a, b, printed);
    for (int y = 0; y < fine; ++y) {
        for (int x = 0; x < fine; ++x) {
            const camera_ray ray = camera_ray_at(camera, fine, fine, x + 0.5, y + 0.5);
            double start = HUGE_VAL;
            const int before = fine * 3 / 4;
            for (int row = y * 3 / 4; row * 4 < (y + 1) * 3; ++row) {
                for (int column = x * 3 / 4; column * 4 < (x + 1) * 3; ++column) {
                    const int closest = row == (2 * y + 1) * 3 / 8 && column == (2 * x + 1) * 3 / 8;
                    if (printed && !closest) continue;
                    start = fmin(start, b[row * before + column]);
                }
            }
            late += start > ball_scene_first(shape, ray.origin, ray.direction, 1e-6);
        }
    }
    return late;
}

/* The library with the same resolutions: no ray starts beyond its hit, of thin balls. */
static void check_library(const spt_camera *camera, const world *shape) {
    static const schedule quarters = {"quarters", 3, {{1, 2, 0.4f}, {3, 4, 0.4f}, {1, 1, 1e-6f}}};
    static spt_camera_ray rays[fine * fine];
    static spt_hit hits[fine * fine];
    ball_scene balls;
    spt_frame frame;
    advance a;
    ball_scene_of(&balls, shape, 0, 0);
    CHECK(spt_frame_init(&frame, &balls.scene, camera, fine, fine) == SPT_OK);
    frame.settings.budget = 1000;
    schedule_set(&frame, &quarters);
    frame_lend_workspace(&frame);
    frame_rays(&frame, rays);
    a = advance_begin(&frame, 0, hits);
    advance_finish(&a, 1u << 30);
    for (size_t i = 0; i < fine * fine; ++i) {
        double o[3], d[3];
        for (int axis = 0; axis < 3; ++axis) {
            o[axis] = (double)rays[i].ray.origin[axis];
            d[axis] = (double)rays[i].ray.direction[axis];
        }
        camera_unit(d);
        if (hits[i].outcome == SPT_HIT) continue; /* at its start */
        /* Twice the rounding floor at the far end, t 50. */
        CHECK_SAY((double)hits[i].t <= ball_scene_first(shape, o, d, 2 * 0x1p-22 * 50) ||
                      (isinf(hits[i].t) && !(ball_scene_first(shape, o, d, 2 * 0x1p-22 * 50) < 50)),
                  "pixel %zu: outcome %d, start %.9g", i, hits[i].outcome, (double)hits[i].t);
    }
}

static void P6_closest_parent(void) {
    const double eye[3] = {0, 0, 0}, target[3] = {0, 0, 8};
    int late[2] = {0, 0};
    for (int i = 0; i < 60; ++i) {
        const world shape = thin_world();
        spt_camera camera =
            camera_draw(SPT_CAMERA_PINHOLE, 0, eye, target, 0.3, check_uniform(0.3, 1), 1);
        camera.t_max = 50;
        late[0] += count_late(&camera, &shape, 0);
        late[1] += count_late(&camera, &shape, 1);
        check_context("world %d", i);
        check_library(&camera, &shape);
    }
    check_context("all worlds");
    CHECK_SAY(late[1] > 12, "closest parent: %d rays start too late", late[1]);
    CHECK_SAY(late[0] == 0, "least of all parents: %d", late[0]);
}

void suite_frame_papers(void) {
    RUN(P4_slope_of_equation_2);
    RUN(P5_cone_steps);
    RUN(P6_closest_parent);
}
