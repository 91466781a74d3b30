/* SPDX-License-Identifier: MIT
 *
 * Runs, placed bodies, certified crossings: see surface_oracle.h. */
#include "surface_oracle.h"
#include "../check.h"
#include "../rules.h"

#include <math.h>
#include <string.h>

enum { searches = 100, samples_between = 64 };

/* ---- Runs ---------------------------------------------------------------------------------- */

surface_run surface_runs(unsigned selection) {
    const surface_run run = {selection, 0, 0, 0, NULL};
    return run;
}

int surface_next(surface_run *run) {
    const int methods = (run->selection & SURFACE_ALL_RULES) != 0 ? rule_count : 1;
    const uint32_t flags = (run->selection & SURFACE_CONVEX) != 0 ? SPT_FIELD_CONVEX : 0;
    while (run->state < methods * width_count * 2) {
        const int index = run->state / (width_count * 2);
        const rule *one = &rules[index];
        run->point = run->state % 2;
        run->lanes = widths[run->state / 2 % width_count];
        ++run->state;
        if (run->lanes > (uint32_t)spt_lanes()) continue;
        run->method = methods == 1 ? spt_adaptive() : one->method();
        if (methods > 1 && !rule_allowed(one, flags)) continue;
        check_context("%s, %u lanes, %s callback", spt_method_name(run->method), run->lanes,
                      run->point ? "point" : "batch");
        return 1;
    }
    return 0;
}

spt_settings surface_settings(const surface_run *run, const spt_settings *given) {
    spt_settings settings = *given;
    settings.method = run->method;
    settings.max_lanes = run->lanes;
    return settings;
}

static float rounded_point(void *user, float x, float y, float z) {
    const reference_field *field = user;
    const real position[3] = {(real)x, (real)y, (real)z};
    return (float)field->distance(field->user, position);
}

spt_field surface_field(const surface_run *run, const reference_field *field, uint32_t flags) {
    spt_field view = oracle_field(field, (flags & SPT_FIELD_CONVEX) != 0);
    if (run->point) {
        view.batch = NULL;
        view.point = rounded_point;
    }
    return view;
}

/* ---- Vectors ------------------------------------------------------------------------------- */

double surface_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double surface_length(const double a[3]) {
    return sqrt(surface_dot(a, a));
}

void surface_unit(double a[3]) {
    const double length = surface_length(a);
    for (int axis = 0; axis < 3; ++axis) a[axis] /= length;
}

double surface_angle(const double a[3], const double b[3]) {
    const double across[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
    return atan2(surface_length(across), surface_dot(a, b));
}

void surface_random_unit(double a[3]) {
    do {
        for (int axis = 0; axis < 3; ++axis) a[axis] = check_uniform(-1, 1);
    } while (surface_dot(a, a) > 1 || surface_dot(a, a) < 1e-4);
    surface_unit(a);
}

/* ---- Bodies -------------------------------------------------------------------------------- */

surface_body surface_place_at(analytic_shape shape, double x, double y, double z) {
    const surface_body body = {shape, {x, y, z}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1};
    return body;
}

surface_body surface_sphere(double x, double y, double z, double radius) {
    const analytic_shape shape = {ANALYTIC_SPHERE, radius, 0, {0, 0, 0}};
    return surface_place_at(shape, x, y, z);
}

surface_body surface_plane(double height) {
    const analytic_shape shape = {ANALYTIC_PLANE, 0, 0, {0, 0, 0}};
    return surface_place_at(shape, 0, height, 0);
}

void surface_turn(surface_body *body) {
    double *x = body->axis[0], *y = body->axis[1], *z = body->axis[2], along;
    surface_random_unit(x);
    do {
        surface_random_unit(y);
        along = surface_dot(x, y);
    } while (fabs(along) > 0.9);
    for (int axis = 0; axis < 3; ++axis) y[axis] -= along * x[axis];
    surface_unit(y);
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        z[axis] = x[next] * y[last] - x[last] * y[next];
    }
}

static void to_own_axes(const surface_body *body, const double p[3], double own[3]) {
    double offset[3];
    for (int axis = 0; axis < 3; ++axis) offset[axis] = p[axis] - body->center[axis];
    for (int axis = 0; axis < 3; ++axis) own[axis] = surface_dot(body->axis[axis], offset);
}

double surface_distance(const surface_body *body, const double p[3]) {
    double own[3], distance;
    to_own_axes(body, p, own);
    distance = analytic_distance(&body->shape, own);
    return body->factor < 0 ? -distance : distance;
}

/* The outward unit gradient in the shape's own axes; the cylinder is not used. */
static void own_gradient(const analytic_shape *shape, const double p[3], double g[3]) {
    const double ring = hypot(p[0], p[2]);
    double q[3];
    int most = 0, outside = 0;
    for (int axis = 0; axis < 3; ++axis) g[axis] = p[axis];
    switch (shape->kind) {
    case ANALYTIC_SPHERE:
        break;
    case ANALYTIC_PLANE:
        g[0] = g[2] = 0;
        g[1] = 1;
        break;
    case ANALYTIC_BOX:
        for (int axis = 0; axis < 3; ++axis) {
            q[axis] = fabs(p[axis]) - shape->half[axis];
            if (q[axis] > q[most]) most = axis;
            outside |= q[axis] > 0;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const double size = outside ? fmax(q[axis], 0) : axis == most;
            g[axis] = copysign(size, p[axis]);
        }
        break;
    case ANALYTIC_TORUS:
        g[0] *= 1 - shape->extent / ring;
        g[2] *= 1 - shape->extent / ring;
        break;
    default: /* the capsule */
        g[1] = p[1] - fmin(fmax(p[1], -shape->extent), shape->extent);
        break;
    }
    surface_unit(g);
}

void surface_gradient(const surface_body *body, const double p[3], double gradient[3]) {
    double own[3], g[3];
    to_own_axes(body, p, own);
    own_gradient(&body->shape, own, g);
    for (int axis = 0; axis < 3; ++axis) {
        gradient[axis] = 0;
        for (int i = 0; i < 3; ++i) gradient[axis] += g[i] * body->axis[i][axis];
        if (body->factor < 0) gradient[axis] = -gradient[axis];
    }
}

static real body_value(const void *user, const real position[3]) {
    const surface_body *body = user;
    const double p[3] = {position[0], position[1], position[2]};
    return (real)(fabs(body->factor) * surface_distance(body, p));
}

reference_field surface_body_field(const surface_body *body) {
    reference_field field = {body_value, NULL, 1};
    field.user = body;
    field.lipschitz = (real)fabs(body->factor);
    return field;
}

double surface_group_distance(const surface_group *group, const double p[3], size_t *which) {
    double least = HUGE_VAL;
    for (size_t i = 0; i < group->count; ++i) {
        const double distance = surface_distance(&group->bodies[i], p);
        if (!(distance < least)) continue;
        least = distance;
        if (which != NULL) *which = i;
    }
    return least;
}

static real group_value(const void *user, const real position[3]) {
    const double p[3] = {position[0], position[1], position[2]};
    return (real)surface_group_distance(user, p, NULL);
}

reference_field surface_group_field(const surface_group *group) {
    reference_field field = {group_value, NULL, 1};
    field.user = group;
    return field;
}

/* ---- Rays ---------------------------------------------------------------------------------- */

spt_ray surface_aim(const double origin[3], const double target[3], double length, double t_max) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 0};
    double d[3];
    for (int axis = 0; axis < 3; ++axis) d[axis] = target[axis] - origin[axis];
    surface_unit(d);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)origin[axis];
        ray.direction[axis] = (float)(length * d[axis]);
    }
    ray.t_max = (float)t_max;
    return ray;
}

void surface_point(const spt_ray *ray, double t, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
}

double surface_tolerance(const spt_settings *settings, const spt_ray *ray, double path, double t) {
    const double cone = (double)settings->pixel_radius * (path + t * oracle_length(ray));
    return fmax(cone, oracle_tolerance(settings, ray, t));
}

double surface_rounding(const spt_ray *ray, double t) {
    double o[3];
    surface_point(ray, 0, o);
    return 0x1p-21 * (surface_length(o) + t * oracle_length(ray));
}

typedef struct along_ray {
    const reference_field *field;
    const spt_ray *ray;
} along_ray;

static double value_at(const along_ray *along, double t) {
    double p[3];
    surface_point(along->ray, t, p);
    {
        const real position[3] = {(real)p[0], (real)p[1], (real)p[2]};
        return (double)(along->field->distance(along->field->user, position) /
                        along->field->lipschitz);
    }
}

typedef struct found_crossings {
    double *t;
    int most, count;
} found_crossings;

/* The crossings in [low, high], whose ends are inside or not. Depth is at most 27: 2^-27 < 1e-8. */
static void isolate(const along_ray *along, double low, double high, int low_inside,
                    int high_inside, int depth, found_crossings *found) {
    const double middle = (low + high) / 2, half = (high - low) / 2 * oracle_length(along->ray);
    const double value = value_at(along, middle);
    if (depth == 0) {
        if (low_inside == high_inside) return;
        for (int i = 0; i < searches; ++i) {
            const double next = (low + high) / 2;
            *((value_at(along, next) < 0) == low_inside ? &low : &high) = next;
        }
        if (found->count < found->most) found->t[found->count] = high;
        ++found->count;
        return;
    }
    if (fabs(value) > half * (1 + 1e-9)) return;
    isolate(along, low, middle, low_inside, value < 0, depth - 1, found);
    isolate(along, middle, high, value < 0, high_inside, depth - 1, found);
}

static double largest_between(const along_ray *along, double low, double high) {
    double most = 0;
    for (int i = 0; i <= samples_between; ++i) {
        const double t = low + (high - low) * i / samples_between;
        most = fmax(most, fabs(value_at(along, t)));
    }
    return most;
}

int surface_crossings(const reference_field *field, const spt_ray *ray, int most, double *t,
                      double *extreme) {
    const along_ray along = {field, ray};
    const double low = (double)ray->t_min, high = (double)ray->t_max;
    found_crossings found = {NULL, 0, 0};
    found.t = t;
    found.most = most;
    isolate(&along, low, high, value_at(&along, low) < 0, value_at(&along, high) < 0, 27, &found);
    if (extreme != NULL) {
        const int count = found.count < most ? found.count : most;
        for (int i = 0; i <= count; ++i) {
            extreme[i] = largest_between(&along, i == 0 ? low : t[i - 1], i == count ? high : t[i]);
        }
    }
    return found.count;
}

double surface_least(surface_function *function, const void *user, double low, double high,
                     double *where) {
    double at;
    for (int i = 0; i < searches; ++i) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        if (function(user, first) < function(user, second)) {
            high = second;
        } else {
            low = first;
        }
    }
    at = (low + high) / 2;
    if (where != NULL) *where = at;
    return function(user, at);
}
