/* SPDX-License-Identifier: MIT
 *
 * What the families of fields have in common: rays, tolerances, and the truth in double. */
#include "stability.h"

#include <math.h>

#include "../../oracle/tolerance.h"

#define UNIT 0x1p-24 /* half an ulp of 1 */

void stability_in_double(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    const stability_world *const world = user;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)world->value(world, p);
    }
}

void stability_begin(stability_world *world, stability_value_fn *value) {
    world->field = spt_field_default();
    world->field.batch = stability_in_double;
    world->field.user = world;
    world->settings = spt_settings_default();
    world->memory = NULL;
    world->value = value;
    world->slope = 1;
    world->units = 8;
    world->reach = 0;
    world->more = NULL;
}

double stability_rounded(double number) {
    return (double)(float)number;
}

double stability_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double stability_length(const double vector[3]) {
    return sqrt(stability_dot(vector, vector));
}

void stability_aim(spt_ray *ray, const double from[3], const double through[3], double t_max) {
    double way[3];
    for (int axis = 0; axis < 3; ++axis) {
        ray->origin[axis] = (float)from[axis];
        way[axis] = through[axis] - (double)ray->origin[axis];
    }
    const double length = stability_length(way);
    for (int axis = 0; axis < 3; ++axis) ray->direction[axis] = (float)(way[axis] / length);
    ray->t_min = 0;
    ray->t_max = (float)t_max;
}

void stability_point(const spt_ray *ray, double t, double p[3]) {
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
}

double stability_rounding(const stability_world *world, const spt_ray *ray, double t) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) reach = fmax(reach, fabs((double)ray->origin[axis]));
    const double cost = world->units * UNIT * (reach + t * oracle_length(ray) + world->reach);
    if (world->more == NULL) return cost;
    double p[3];
    stability_point(ray, t, p);
    return cost + world->more(world, p);
}

static double value_at(const stability_world *world, const spt_ray *ray, double t) {
    double p[3];
    stability_point(ray, t, p);
    return world->value(world, p);
}

int stability_near(const stability_world *world, const spt_ray *ray, double t) {
    return fabs(value_at(world, ray, t)) <=
           (double)world->field.lipschitz * oracle_tolerance(&world->settings, ray, t) +
               world->slope * stability_rounding(world, ray, t);
}

void stability_nothing(stability_truth *truth) {
    truth->first = truth->clear = truth->last = HUGE_VAL;
    truth->unknown = 0;
}

void stability_crossing(stability_truth *truth, double t, int clear) {
    truth->first = fmin(truth->first, t);
    if (clear && t < truth->clear) {
        truth->clear = t;
        truth->last = 0;
    }
}

/* A ray that runs along a surface for long takes as many steps: such rays are graze, not fault. */
enum { most_steps = 400000 };

void stability_walk(const stability_world *world, const spt_ray *ray, double t_low, double t_high,
                    stability_truth *truth) {
    const double length = oracle_length(ray);
    double t = t_low, entered = HUGE_VAL;
    stability_nothing(truth);
    for (int i = 0; i < most_steps; ++i) {
        if (!(t <= t_high)) return;
        const double free = value_at(world, ray, t) / world->slope; /* world length */
        const double rounding = stability_rounding(world, ray, t);
        if (free < 0) {
            entered = fmin(entered, t);
            stability_crossing(truth, entered, free < -rounding);
            if (truth->clear <= t) return;
        } else {
            entered = HUGE_VAL;
        }
        t += fmax(fabs(free), rounding / 4) / length;
    }
    truth->unknown = 1;
}

void stability_walk_ray(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    stability_walk(world, ray, (double)ray->t_min, (double)ray->t_max, truth);
}

int stability_ball_interval(const spt_ray *ray, const double center[3], double radius, double *in,
                            double *out) {
    double from[3], direction[3], apart[3];
    for (int axis = 0; axis < 3; ++axis) {
        direction[axis] = (double)ray->direction[axis];
        from[axis] = (double)ray->origin[axis] - center[axis];
    }
    const double square = stability_dot(direction, direction);
    const double middle = -stability_dot(from, direction) / square;
    /* Before squares are subtracted the ray's part along itself is, where ball and origin are far
     * apart: b^2 - a c would cancel. */
    for (int axis = 0; axis < 3; ++axis) apart[axis] = from[axis] + middle * direction[axis];
    const double least = stability_length(apart);
    if (!(least < radius)) return 0;
    const double half = sqrt((radius - least) * (radius + least) / square);
    *in = middle - half;
    *out = middle + half;
    return *out >= 0;
}

void stability_find_last(const stability_world *world, const spt_ray *ray, stability_truth *truth) {
    if (truth->last > 0) return;
    const double length = oracle_length(ray);
    const double band = oracle_tolerance(&world->settings, ray, truth->clear) +
                        stability_rounding(world, ray, truth->clear);
    double near = truth->clear + band / length, step = band / length;
    double far = near;
    for (int i = 0; i < 64 && stability_near(world, ray, far); ++i) {
        near = far;
        far += step;
        step *= 2;
    }
    for (int i = 0; i < 40 && far > near; ++i) {
        const double middle = (near + far) / 2;
        if (stability_near(world, ray, middle)) {
            near = middle;
        } else {
            far = middle;
        }
    }
    truth->last = far;
}
