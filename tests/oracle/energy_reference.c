/* SPDX-License-Identifier: MIT
 *
 * A path tracer with exact intersections in double: one path at a time, the rendering equation as it
 * is written. It shares the random numbers with that of the examples, and nothing else. */
#include "energy_world.h"

#include <path_wave.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const double nearest = 1e-9; /* surfaces that a ray begins on are no nearer */

typedef struct meeting {
    double t, normal[3];
    int body; /* -1: none */
} meeting;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int c = 0; c < 3; ++c) v[c] /= length;
}

static void widen(const float from[3], double to[3]) {
    for (int c = 0; c < 3; ++c) to[c] = (double)from[c];
}

/* ---- Where a ray of unit direction enters a body ------------------------------------------- */

static double enter_ball(const double v[3], const double d[3], double radius, int from_inside) {
    const double along = dot(v, d);
    const double square = radius * radius - dot(v, v) + along * along;
    if (square < 0) return HUGE_VAL;
    return from_inside ? sqrt(square) - along : -sqrt(square) - along;
}

static double enter_box(const energy_body *body, const double v[3], const double d[3], int *axis) {
    double in = -HUGE_VAL, out = HUGE_VAL;
    for (int c = 0; c < 3; ++c) {
        const double half = (double)body->half[c];
        if (d[c] == 0) {
            if (fabs(v[c]) > half) return HUGE_VAL;
            continue;
        }
        const double a = (-half - v[c]) / d[c], b = (half - v[c]) / d[c];
        if (fmin(a, b) > in) {
            in = fmin(a, b);
            *axis = c;
        }
        out = fmin(out, fmax(a, b));
    }
    return in < out ? in : HUGE_VAL;
}

static double enter(const energy_body *body, const double o[3], const double d[3], int *axis) {
    double v[3], normal[3];
    for (int c = 0; c < 3; ++c) v[c] = o[c] - (double)body->center[c];
    widen(body->normal, normal);
    switch (body->kind) {
    case ENERGY_BALL:
        return enter_ball(v, d, (double)body->radius, 0);
    case ENERGY_HOLLOW:
        return enter_ball(v, d, (double)body->radius, 1);
    case ENERGY_BOX:
        return enter_box(body, v, d, axis);
    case ENERGY_WALL:
        return dot(normal, d) < 0 ? ((double)body->offset - dot(normal, o)) / dot(normal, d)
                                  : HUGE_VAL;
    case ENERGY_RING:
        break;
    }
    return HUGE_VAL;
}

static void find_normal(const energy_body *body, const double p[3], const double d[3], int axis,
                        double normal[3]) {
    widen(body->normal, normal); /* of a wall */
    if (body->kind == ENERGY_BOX) {
        memset(normal, 0, 3 * sizeof *normal);
        normal[axis] = d[axis] < 0 ? 1 : -1;
    } else if (body->kind != ENERGY_WALL) {
        const double side = body->kind == ENERGY_BALL ? 1 : -1;
        for (int c = 0; c < 3; ++c) normal[c] = side * (p[c] - (double)body->center[c]);
        unit(normal);
    }
}

static meeting meet(const energy_world *self, const double o[3], const double d[3], double t_max) {
    meeting first = {t_max, {0, 0, 0}, -1};
    int face = 0;
    for (int k = 0; k < self->count; ++k) {
        int axis = 0;
        const double t = enter(&self->bodies[k], o, d, &axis);
        if (t > nearest && t < first.t) {
            first.t = t;
            first.body = k;
            face = axis;
        }
    }
    if (first.body >= 0) {
        double p[3];
        for (int c = 0; c < 3; ++c) p[c] = o[c] + first.t * d[c];
        find_normal(&self->bodies[first.body], p, d, face, first.normal);
    }
    return first;
}

/* ---- Light --------------------------------------------------------------------------------- */

/* path_direction() in double, with the frame of path_frame(). */
static void direction_around(const double n[3], double square, double turn, double d[3]) {
    const double sign = n[2] < -0.6 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    const double tangent[3] = {1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
    const double bitangent[3] = {b, sign + n[1] * n[1] * a, -n[1]};
    const double x = sqrt(square) * cos(2 * pi * turn), y = sqrt(square) * sin(2 * pi * turn);
    for (int c = 0; c < 3; ++c) {
        d[c] = x * tangent[c] + y * bitangent[c] + sqrt(1 - square) * n[c];
    }
}

typedef struct walk {
    const energy_world *self;
    uint32_t seed, x, y, sample, bounce;
    double p[3], throughput[3], light[3];
} walk;

static path_pair draw(const walk *at, path_draw what) {
    return path_drawn(at->seed, at->x, at->y, at->bounce, what, at->sample);
}

static void add(walk *at, const float radiance[3], double share) {
    for (int c = 0; c < 3; ++c) at->light[c] += at->throughput[c] * share * (double)radiance[c];
}

/* The front of the panel, as long as it is large. */
static void panel_front(const path_panel *panel, double front[3]) {
    double u[3], v[3];
    widen(panel->along, u);
    widen(panel->across, v);
    for (int c = 0; c < 3; ++c) {
        front[c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
    }
}

static void add_panel(walk *at, const double normal[3]) {
    const path_panel *panel = at->self->world.panel;
    const path_pair drawn = draw(at, PATH_DRAW_PANEL);
    double to[3], front[3];
    panel_front(panel, front);
    for (int c = 0; c < 3; ++c) {
        to[c] = (double)panel->corner[c] + (double)drawn.first * (double)panel->along[c] +
                (double)drawn.second * (double)panel->across[c] - at->p[c];
    }
    const double length = sqrt(dot(to, to));
    unit(to);
    const double cosine = dot(to, normal), faced = -dot(to, front);
    if (!(cosine > 0 && faced > 0)) return;
    if (meet(at->self, at->p, to, length - nearest).body >= 0) return;
    add(at, panel->radiance, cosine * faced / (pi * length * length));
}

static void add_sun(walk *at, const double normal[3], double t_max) {
    const path_sun *sun = at->self->world.sun;
    const path_pair drawn = draw(at, PATH_DRAW_SUN);
    const double sine = (double)sun->sine;
    double axis[3], to[3];
    widen(sun->direction, axis);
    direction_around(axis, (double)drawn.first * sine * sine, (double)drawn.second, to);
    if (!(dot(to, normal) > 0)) return;
    if (meet(at->self, at->p, to, t_max).body >= 0) return;
    add(at, sun->irradiance, dot(to, normal) / pi);
}

static void walk_path(walk *at, double d[3], double t_max, uint32_t bounces, int next_event) {
    const path_world *world = &at->self->world;
    for (at->bounce = 0;; ++at->bounce) {
        const meeting hit = meet(at->self, at->p, d, t_max);
        if (hit.body < 0) {
            const float narrow[3] = {(float)d[0], (float)d[1], (float)d[2]};
            float sky[3] = {0, 0, 0};
            if (world->sky != NULL) world->sky(world->sky_user, narrow, sky);
            add(at, sky, 1);
            return;
        }
        const path_material *material = &at->self->bodies[hit.body].material;
        for (int c = 0; c < 3; ++c) at->p[c] += hit.t * d[c];
        add(at, material->emission, 1);
        if (world->panel != NULL && hit.body == world->panel->component &&
            (at->bounce == 0 || !next_event)) {
            double front[3];
            panel_front(world->panel, front);
            if (dot(front, hit.normal) > 0.9 * sqrt(dot(front, front))) {
                add(at, world->panel->radiance, 1);
            }
        }
        if (at->bounce == bounces) return;
        for (int c = 0; c < 3; ++c) at->throughput[c] *= (double)material->albedo[c];
        if (next_event && world->panel != NULL) add_panel(at, hit.normal);
        if (next_event && world->sun != NULL) add_sun(at, hit.normal, t_max);
        const path_pair drawn = draw(at, PATH_DRAW_DIRECTION);
        direction_around(hit.normal, (double)drawn.first, (double)drawn.second, d);
    }
}

void energy_reference(const energy_world *self, const path_settings *settings, int next_event,
                      uint32_t x, uint32_t y, uint32_t width, uint32_t height, uint32_t first,
                      uint32_t count, double light[3]) {
    memset(light, 0, 3 * sizeof *light);
    for (uint32_t sample = first; sample < first + count; ++sample) {
        walk at = {self, settings->seed, x, y, sample, 0, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}};
        const path_pair place = draw(&at, PATH_DRAW_PLACE);
        const float column = (float)x + place.first, row = (float)y + place.second;
        spt_camera_ray eye_ray;
        double d[3];
        (void)spt_camera_rays(&self->world.camera, width, height, 1, &column, &row, &eye_ray);
        widen(eye_ray.ray.origin, at.p);
        widen(eye_ray.ray.direction, d);
        walk_path(&at, d, (double)eye_ray.ray.t_max, settings->bounces, next_event);
        for (int c = 0; c < 3; ++c) light[c] += at.light[c];
    }
}
