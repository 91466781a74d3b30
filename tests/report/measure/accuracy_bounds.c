/* SPDX-License-Identifier: MIT
 *
 * Intervals of rays in bounding spheres and boxes: each end must lie outside the true one, and is
 * moved there on purpose. How much of that rounding takes away. Left out: the other kinds, whose
 * promises are alike. */
#include "accuracy.h"

#include "../../oracle/surface_oracle.h"

#include <math.h>

static const double e = 0x1p-22;

/* A ray's interval, or what is not one: from > to. */
typedef struct stretch {
    double from, to;
} stretch;

static stretch sphere_interval(const spt_ray *ray, const double center[3], double radius) {
    double o[3], d[3], v[3], side[3];
    stretch found = {HUGE_VAL, -HUGE_VAL};
    surface_point(ray, 0, o);
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = (double)ray->direction[axis];
        v[axis] = o[axis] - center[axis];
    }
    const double square = surface_dot(d, d), nearest = -surface_dot(v, d) / square;
    for (int axis = 0; axis < 3; ++axis) side[axis] = v[axis] + nearest * d[axis];
    const double inside = radius * radius - surface_dot(side, side);
    if (inside < 0) return found;
    found.from = nearest - sqrt(inside / square);
    found.to = nearest + sqrt(inside / square);
    return found;
}

static stretch box_interval(const spt_ray *ray, const double center[3], double half) {
    stretch found = {-HUGE_VAL, HUGE_VAL};
    for (int axis = 0; axis < 3; ++axis) {
        const double o = (double)ray->origin[axis], d = (double)ray->direction[axis];
        const double a = (center[axis] - half - o) / d, b = (center[axis] + half - o) / d;
        found.from = fmax(found.from, fmin(a, b));
        found.to = fmin(found.to, fmax(a, b));
    }
    return found;
}

static double largest(const double v[3]) {
    return fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
}

/* How much of the widening `most` rounding has taken away; more than all: the interval is narrower
 * than the true one. */
static double lost(double way, double most) {
    return fmax(1 - way / most, 0);
}

static void compare(const spt_ray *ray, const double center[3], double size, int box,
                    accuracy_errors *errors) {
    const float c[3] = {(float)center[0], (float)center[1], (float)center[2]}, h = (float)size;
    const spt_bound bound =
        box ? spt_bound_box(c[0] - h, c[1] - h, c[2] - h, c[0] + h, c[1] + h, c[2] + h)
            : spt_bound_sphere(c[0], c[1], c[2], h);
    double o[3], v[3];
    float from = 0, to = 0;
    surface_point(ray, 0, o);
    for (int axis = 0; axis < 3; ++axis) v[axis] = o[axis] - center[axis];
    const double outermost = largest(center) + size, length = oracle_length(ray);
    const double growth = e * (largest(o) + (box ? outermost : surface_length(v)));
    const double floor_of = box ? 0 : e * (largest(o) + outermost) / length;
    const stretch truth = (box ? box_interval : sphere_interval)(ray, center, size);
    const stretch wide = (box ? box_interval : sphere_interval)(ray, center, size + growth);
    if (!(truth.from > 0) || !(truth.from < truth.to)) return;
    report_expect(
        spt_bound_interval(&bound, ray->origin, ray->direction, 0, INFINITY, &from, &to) == SPT_OK,
        "a bound is refused");
    accuracy_add(
        errors, lost(truth.from - (double)from, truth.from - wide.from + e * wide.from + floor_of));
    accuracy_add(errors, lost((double)to - truth.to, wide.to - truth.to + e * wide.to + floor_of));
}

void accuracy_bounds(const report_options *options, FILE *rows) {
    static const accuracy_subject subjects[2] = {
        {"bound_sphere", "distance", "of the widening; lost to rounding",
         "bound.h: never narrower than the true one"},
        {"bound_box", "distance", "of the widening; lost to rounding",
         "bound.h: never narrower than the true one"}};
    for (int box = 0; box < 2; ++box) {
        for (int power = 0; power <= 8; ++power) {
            report_random random = {(uint64_t)power};
            accuracy_errors errors = {NULL, 0, 0};
            const double distance = pow(10, power);
            for (size_t left = accuracy_samples(options, 40000); left > 0; --left) {
                const double size = (double)(float)(distance / 10);
                double toward[3], center[3], origin[3], target[3];
                accuracy_unit(&random, toward);
                for (int axis = 0; axis < 3; ++axis) {
                    /* so that center and center +- size are floats */
                    center[axis] = size * floor(10 * 1024 * toward[axis]) / 1024;
                    origin[axis] = distance * report_uniform(&random, -0.1, 0.1);
                    target[axis] = center[axis] + size * report_uniform(&random, -1, 1);
                }
                const spt_ray ray =
                    surface_aim(origin, target, accuracy_spread(&random, 0.01, 100), HUGE_VAL);
                compare(&ray, center, size, box, &errors);
            }
            accuracy_write(rows, &subjects[box], distance, 1, &errors);
        }
    }
}
