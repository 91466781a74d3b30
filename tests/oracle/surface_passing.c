/* SPDX-License-Identifier: MIT
 *
 * Rays that pass convex bodies: see surface_passing.h. */
#include "surface_passing.h"
#include "../check.h"

#include <math.h>

static double distance_at(const void *user, double t) {
    const passing *what = user;
    double p[3];
    surface_point(&what->ray, t, p);
    return surface_distance(&what->body, p);
}

static double slope_at(const void *user, double t) {
    const passing *what = user;
    return distance_at(user, t) / (t * oracle_length(&what->ray));
}

passing passing_of(const surface_body *body, const spt_ray *ray) {
    passing what = {{{ANALYTIC_SPHERE, 0, 0, {0, 0, 0}}, {0, 0, 0}, {{0, 0, 0}}, 0},
                    {{0, 0, 0}, 0, {0, 0, 0}, 0},
                    0,
                    0,
                    0};
    what.body = *body;
    what.ray = *ray;
    what.closest =
        surface_least(distance_at, &what, (double)ray->t_min, (double)ray->t_max, &what.at);
    what.sine =
        surface_least(slope_at, &what, fmax((double)ray->t_min, 1e-30), (double)ray->t_max, NULL);
    return what;
}

static surface_body draw_body(passing_kind kind, double away) {
    static const analytic_kind shapes[passing_kinds] = {ANALYTIC_SPHERE, ANALYTIC_SPHERE,
                                                        ANALYTIC_BOX, ANALYTIC_CAPSULE};
    double center[3];
    surface_body body;
    surface_random_unit(center);
    body = surface_place_at(analytic_sample(shapes[kind], away * check_uniform(0.1, 0.5)),
                            away * center[0], away * center[1], away * center[2]);
    if (kind == PASSING_POINT) body.shape.radius = away * 1e-9;
    surface_turn(&body);
    body.factor = pow(2, check_uniform(-3, 3));
    return body;
}

passing passing_draw(passing_kind kind) {
    const double origin[3] = {0, 0, 0}, length = pow(2, check_uniform(-4, 4));
    for (;;) {
        const double away = pow(2, check_uniform(-2, 2));
        const surface_body body = draw_body(kind, away);
        double target[3], toward;
        spt_ray ray;
        passing what;
        surface_random_unit(target);
        for (int axis = 0; axis < 3; ++axis) {
            target[axis] = body.center[axis] + 1.5 * away * check_uniform(0, 1) * target[axis];
        }
        toward = surface_angle(target, body.center);
        if (toward > 1.04) continue;
        ray = surface_aim(origin, target, length, 60 * away / length);
        if (check_random() % 2 != 0) ray.t_min = (float)(0.1 * away / length);
        what = passing_of(&body, &ray);
        if (what.closest > 0.1 * away && what.closest < 2.5 * away) return what;
    }
}

double passing_reach(const passing *what) {
    return 2 * (surface_length(what->body.center) + what->closest);
}

double passing_rounding(const passing *what, double closest) {
    const double reach = passing_reach(what);
    return 0x1p-17 * reach * reach / (closest + what->closest);
}
