/* SPDX-License-Identifier: MIT
 *
 * Normals of balls against their radii, by the distance from the origin and by the curvature, in
 * each way that spt_normals() has. Left out: edges, whose sides are blended within a step. */
#include "accuracy.h"

#include "../../oracle/harness.h"
#include "../../oracle/surface_sampled.h"

#include <math.h>

enum { ways = 3 };
static const char *const way_names[ways] = {"tetrahedron", "central", "gradient"};

/* A ball as the library sees it; the body is looked at and must stay where it is. */
typedef struct ball {
    surface_body body;
    reference_field reference;
    spt_bound bound;
    spt_field field;
} ball;

static void gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *gradient_x, float *gradient_y, float *gradient_z) {
    const surface_body *const body = ((const reference_field *)user)->user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        double g[3];
        surface_gradient(body, p, g);
        gradient_x[i] = (float)g[0];
        gradient_y[i] = (float)g[1];
        gradient_z[i] = (float)g[2];
    }
}

static void make(ball *one, const double center[3], double radius, int way) {
    one->body = surface_sphere(center[0], center[1], center[2], radius);
    one->reference = surface_body_field(&one->body);
    one->bound = spt_bound_sphere((float)center[0], (float)center[1], (float)center[2],
                                  (float)(1.001 * radius));
    one->field = oracle_field(&one->reference, 0);
    if (way == 2) one->field.gradient = gradient;
}

static void sample(report_random *random, const ball *one, float detail, int way, size_t count,
                   accuracy_errors *errors) {
    const spt_settings settings = spt_settings_default();
    surface_sampled at;
    at.count = count;
    for (size_t i = 0; i < count; ++i) {
        double out[3];
        accuracy_unit(random, out);
        for (int axis = 0; axis < 3; ++axis)
            at.point[i][axis] =
                (float)(one->body.center[axis] + one->body.shape.radius * out[axis]);
    }
    report_expect(sampled_normals(&one->field, &settings,
                                  way == 0 ? SPT_NORMAL_TETRAHEDRON : SPT_NORMAL_CENTRAL, detail,
                                  &at) == SPT_OK,
                  "normals refuse their arguments");
    for (size_t i = 0; i < count; ++i) {
        double p[3], n[3], truth[3];
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)at.point[i][axis];
            n[axis] = (double)at.normal[i][axis];
        }
        surface_gradient(&one->body, p, truth);
        accuracy_add(errors, surface_length(n) > 0 ? surface_angle(n, truth) : HUGE_VAL);
    }
}

static const char promise[] =
    "surface.h: worst angle of six values 9e-5 at coordinates of 100 details; of four 3e-3";

/* The header's angle is that of coordinates of 100 details: nearer ones are no worse. */
static double promised(int way, double details) {
    if (way == 2 || details > 100) return 0;
    return way == 0 ? 3e-3 : 9e-5;
}

/* Balls of radius 1, whose least feature is 1. */
void accuracy_normals_distance(const report_options *options, FILE *rows) {
    for (int way = 0; way < ways; ++way) {
        char name[64];
        const accuracy_subject subject = {name, "distance", "radians", way == 2 ? "" : promise};
        snprintf(name, sizeof name, "normal_distance_%s", way_names[way]);
        for (int power = 0; power <= 7; ++power) {
            report_random random = {(uint64_t)power};
            accuracy_errors errors = {NULL, 0, 0};
            /* the ball's farthest coordinate is `away` */
            const double away = pow(10, power);
            for (size_t balls = accuracy_samples(options, 80); balls > 0; --balls) {
                double center[3];
                ball one;
                accuracy_unit(&random, center);
                for (int axis = 0; axis < 3; ++axis) center[axis] *= away > 1 ? away - 1 : 0;
                make(&one, center, 1, way);
                sample(&random, &one, 1, way, 100, &errors);
            }
            accuracy_write(rows, &subject, away, promised(way, away), &errors);
        }
    }
}

/* Balls near (1, 0, 0) whose size the library learns from their bounds: a quarter of the side, so
 * that a detail is half the radius, and never more than 1. */
void accuracy_normals_curvature(const report_options *options, FILE *rows) {
    for (int way = 0; way < ways; ++way) {
        char name[64];
        const accuracy_subject subject = {name, "radius of curvature", "radians",
                                          way == 2 ? "" : promise};
        snprintf(name, sizeof name, "normal_curvature_%s", way_names[way]);
        for (int power = -5; power <= 3; ++power) {
            report_random random = {(uint64_t)(power + 5)};
            accuracy_errors errors = {NULL, 0, 0};
            const double radius = pow(10, power), detail = fmin(1, 0.5 * radius);
            const double center[3] = {1, 0, 0};
            ball one;
            make(&one, center, radius, way);
            one.field.bound = &one.bound;
            for (size_t rounds = accuracy_samples(options, 80); rounds > 0; --rounds)
                sample(&random, &one, 0, way, 100, &errors);
            accuracy_write(rows, &subject, radius, promised(way, (1 + radius) / detail), &errors);
        }
    }
}
