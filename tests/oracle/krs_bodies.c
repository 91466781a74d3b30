/* SPDX-License-Identifier: MIT
 *
 * The kernels of krs.h in double: distances by the nearest point of what each is swept from, so
 * that none shares a formula with a fast one. */
#include "krs_oracle.h"
#include "surface_oracle.h"
#include "../check.h"

#include <math.h>

static const double turn = 6.283185307179586;

static void between(const double from[3], const double to[3], double out[3]) {
    for (int axis = 0; axis < 3; ++axis) out[axis] = to[axis] - from[axis];
}

static double apart(const double a[3], const double b[3]) {
    double way[3];
    between(a, b, way);
    return surface_length(way);
}

/* The circle through a, control and b: its center from a is the one combination of both chords that
 * is as far from all three (the textbook's circumcenter). */
static void prepare_capsule(krs_body *body) {
    double to_b[3], to_control[3], on[3], normal[3], towards_b[3], towards_control[3], last[3];
    between(body->a, body->b, to_b);
    between(body->a, body->control, to_control);
    between(body->control, body->b, on);
    krs_cross(to_control, on, normal);
    const double size = surface_length(normal);
    body->angle = 0;
    if (size <= 1e-9 * surface_length(to_control) * surface_length(on)) return;
    for (int axis = 0; axis < 3; ++axis) body->axis[2][axis] = normal[axis] / size;
    krs_cross(to_b, to_control, normal);
    krs_cross(normal, to_b, towards_control);
    krs_cross(to_control, normal, towards_b);
    const double square = surface_dot(normal, normal);
    for (int axis = 0; axis < 3; ++axis) {
        body->center[axis] =
            body->a[axis] + (surface_dot(to_control, to_control) * towards_control[axis] +
                             surface_dot(to_b, to_b) * towards_b[axis]) /
                                (2 * square);
    }
    between(body->center, body->a, body->axis[0]);
    body->circle_radius = surface_length(body->axis[0]);
    surface_unit(body->axis[0]);
    krs_cross(body->axis[2], body->axis[0], body->axis[1]);
    between(body->center, body->b, last);
    body->angle = atan2(surface_dot(last, body->axis[1]), surface_dot(last, body->axis[0]));
    if (body->angle < 0) body->angle += turn;
}

/* Each edge is an arc through both tips whose middle is `width` off the axis: a circle of radius r
 * with half^2 + (r - width)^2 = r^2. */
static void prepare_leaf(krs_body *body) {
    between(body->a, body->b, body->axis[0]);
    body->half = surface_length(body->axis[0]) / 2;
    surface_unit(body->axis[0]);
    krs_cross(body->control, body->axis[0], body->axis[1]);
    surface_unit(body->axis[1]);
    krs_cross(body->axis[0], body->axis[1], body->axis[2]);
    body->circle_radius = (body->half * body->half + body->width * body->width) / (2 * body->width);
    for (int axis = 0; axis < 3; ++axis) body->center[axis] = (body->a[axis] + body->b[axis]) / 2;
}

krs_body krs_body_of(const spt_kernel *kernel) {
    krs_body body = {0};
    body.kind = kernel->kind;
    krs_widen(kernel->a, body.a);
    krs_widen(kernel->b, body.b);
    krs_widen(kernel->control, body.control);
    body.radius = (double)kernel->radius;
    body.width = (double)kernel->width;
    if (kernel->kind == SPT_KERNEL_HALF_SPACE) {
        const double length = surface_length(body.a);
        for (int axis = 0; axis < 3; ++axis) body.a[axis] /= length;
        body.radius /= length;
    }
    if (kernel->kind == SPT_KERNEL_CAPSULE) prepare_capsule(&body);
    if (kernel->kind == SPT_KERNEL_LEAF) prepare_leaf(&body);
    if (kernel->kind == SPT_KERNEL_FIELD) body.field = kernel->field->user;
    return body;
}

/* ---- Distances ------------------------------------------------------------------------------- */

static double segment_place(const krs_body *body, const double p[3]) {
    double along[3], to_p[3];
    between(body->a, body->b, along);
    between(body->a, p, to_p);
    const double place = surface_dot(to_p, along) / surface_dot(along, along);
    return place > 0 ? (place < 1 ? place : 1) : 0;
}

static double around_circle(const krs_body *body, const double p[3]) {
    double from_center[3];
    between(body->center, p, from_center);
    const double angle =
        atan2(surface_dot(from_center, body->axis[1]), surface_dot(from_center, body->axis[0]));
    return angle < 0 ? angle + turn : angle;
}

double krs_arc_fraction(const krs_body *body, const double p[3]) {
    if (!(body->angle > 0)) return segment_place(body, p);
    const double angle = around_circle(body, p);
    if (angle <= body->angle) return angle / body->angle;
    return apart(p, body->a) < apart(p, body->b) ? 0 : 1;
}

static double capsule_distance(const krs_body *body, const double p[3]) {
    if (!(body->angle > 0)) {
        const double place = segment_place(body, p);
        double nearest[3];
        for (int axis = 0; axis < 3; ++axis)
            nearest[axis] = body->a[axis] + place * (body->b[axis] - body->a[axis]);
        return apart(p, nearest) - body->radius;
    }
    if (around_circle(body, p) > body->angle)
        return fmin(apart(p, body->a), apart(p, body->b)) - body->radius;
    double from_center[3];
    between(body->center, p, from_center);
    const double in_plane =
        hypot(surface_dot(from_center, body->axis[0]), surface_dot(from_center, body->axis[1]));
    return hypot(in_plane - body->circle_radius, surface_dot(from_center, body->axis[2])) -
           body->radius;
}

/* In the leaf's plane, folded to one quarter: within both arcs, or nearest to the arc on p's side
 * if the way there from its center meets it between the tips, else to the tip. */
static double leaf_distance(const krs_body *body, const double p[3]) {
    double q[3];
    between(body->center, p, q);
    const double x = fabs(surface_dot(q, body->axis[0])), y = fabs(surface_dot(q, body->axis[1])),
                 out = surface_dot(q, body->axis[2]);
    const double below = body->circle_radius - body->width; /* of the arc's center */
    const double from_center = hypot(x, y + below);
    double in_plane = 0;
    if (from_center > body->circle_radius) {
        const double arc_y = (y + below) * body->circle_radius / from_center - below;
        in_plane = arc_y >= 0 ? from_center - body->circle_radius : hypot(x - body->half, y);
    }
    return hypot(in_plane, out) - body->radius;
}

double krs_body_distance(const krs_body *body, const double p[3]) {
    switch (body->kind) {
    case SPT_KERNEL_SPHERE:
        return apart(p, body->a) - body->radius;
    case SPT_KERNEL_HALF_SPACE:
        return surface_dot(p, body->a) - body->radius;
    case SPT_KERNEL_CAPSULE:
        return capsule_distance(body, p);
    case SPT_KERNEL_LEAF:
        return leaf_distance(body, p);
    case SPT_KERNEL_FIELD:
        return (double)body->field->distance(body->field->user, p) / (double)body->field->lipschitz;
    default:
        return HUGE_VAL;
    }
}

void krs_body_gradient(const krs_body *body, const double p[3], double gradient[3]) {
    const double step = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
        double there[3] = {p[0], p[1], p[2]};
        there[axis] = p[axis] + step;
        const double above = krs_body_distance(body, there);
        there[axis] = p[axis] - step;
        gradient[axis] = (above - krs_body_distance(body, there)) / (2 * step);
    }
}

/* ---- Extent ---------------------------------------------------------------------------------- */

int krs_body_ball(const krs_body *body, double center[3], double *radius) {
    const int leaf = body->kind == SPT_KERNEL_LEAF, field = body->kind == SPT_KERNEL_FIELD;
    for (int axis = 0; axis < 3; ++axis)
        center[axis] = leaf ? body->center[axis] : field ? 0 : body->a[axis];
    *radius = leaf ? body->half + body->radius : field ? 1 : body->radius;
    if (body->kind == SPT_KERNEL_CAPSULE) {
        /* No point of an arc up to a half circle is farther from one end than the other is. */
        *radius += body->angle > turn / 2 ? 2 * body->circle_radius : apart(body->a, body->b);
    }
    return body->kind != SPT_KERNEL_HALF_SPACE && body->kind != SPT_KERNEL_EMPTY;
}

/* From a random point in the ball straight to the surface: along the gradient, which for an exact
 * distance leads there at once. */
void krs_body_sample(const krs_body *body, double p[3]) {
    double center[3], radius;
    krs_body_ball(body, center, &radius);
    for (int tries = 0; tries < 50; ++tries) {
        double gradient[3], way[3];
        const double far = radius * check_uniform(0.02, 1.5);
        surface_random_unit(way);
        for (int axis = 0; axis < 3; ++axis) p[axis] = center[axis] + far * way[axis];
        const double distance = krs_body_distance(body, p);
        krs_body_gradient(body, p, gradient);
        surface_unit(gradient);
        for (int axis = 0; axis < 3; ++axis) p[axis] -= distance * gradient[axis];
        if (fabs(krs_body_distance(body, p)) < 1e-7) return;
    }
    CHECK_SAY(0, "no point on a body of kind %u", body->kind);
}
