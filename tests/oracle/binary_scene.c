/* SPDX-License-Identifier: MIT
 *
 * Exact distances, intersections and probes of simple bodies. */
#include "binary_scene.h"
#include "../check.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

void binary_draw(binary_scene *scene, double scale) {
    scene->count = 1 + (int)(check_random() % binary_bodies);
    scene->only_says = (int)(check_random() % 2);
    scene->asked = scene->refused = 0;
    for (int i = 0; i < scene->count; ++i) {
        binary_body *body = &scene->body[i];
        const uint32_t draw = check_random() % 6;
        double square = 0;
        body->kind = draw < 3 ? BINARY_BALL : draw < 5 ? BINARY_BOX : BINARY_HALF_SPACE;
        for (int axis = 0; axis < 3; ++axis) {
            body->center[axis] = scale * check_uniform(-8, 8);
            body->size[axis] = scale * pow(10, check_uniform(-2, 0.5));
            square += body->center[axis] * body->center[axis];
        }
        if (body->kind != BINARY_HALF_SPACE) continue;
        for (int axis = 0; axis < 3; ++axis) body->center[axis] /= sqrt(square);
        body->size[0] = -scale * check_uniform(1, 8);
    }
}

spt_ray binary_ray(const binary_scene *scene, double scale, double length) {
    const binary_body *at = &scene->body[check_random() % (uint32_t)scene->count];
    const int aimed = at->kind != BINARY_HALF_SPACE && check_random() % 2 == 0;
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 0};
    double d[3], square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (float)(scale * check_uniform(-9, 9));
        d[axis] = scale * check_uniform(-4, 4);
        d[axis] = (aimed ? at->center[axis] : d[axis]) - (double)ray.origin[axis];
        square += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
        ray.direction[axis] = (float)(d[axis] / sqrt(square) * length);
    ray.t_max = (float)(40 * scale / length);
    if (check_random() % 4 == 0) ray.t_min = (float)(scale * check_uniform(0, 4) / length);
    return ray;
}

double binary_length(const spt_ray *ray) {
    const double x = (double)ray->direction[0], y = (double)ray->direction[1],
                 z = (double)ray->direction[2];
    return sqrt(x * x + y * y + z * z);
}

void binary_at(const spt_ray *ray, double t, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = (double)ray->origin[axis] + t * (double)ray->direction[axis];
    }
}

double binary_body_distance(const binary_body *body, const double p[3]) {
    double outside = 0, inside = -HUGE_VAL, along = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = p[axis] - body->center[axis], over = fabs(from) - body->size[axis];
        along += p[axis] * body->center[axis];
        square += from * from;
        if (over > 0) outside += over * over;
        if (over > inside) inside = over;
    }
    if (body->kind == BINARY_BALL) return sqrt(square) - body->size[0];
    if (body->kind == BINARY_HALF_SPACE) return along - body->size[0];
    return inside > 0 ? sqrt(outside) : inside;
}

double binary_distance(const binary_scene *scene, const double p[3], int *which) {
    double least = HUGE_VAL;
    for (int i = 0; i < scene->count; ++i) {
        const double distance = binary_body_distance(&scene->body[i], p);
        if (distance < least) {
            least = distance;
            if (which != NULL) *which = i;
        }
    }
    return least;
}

/* Cuts [from, to] with low <= o + t d <= high. */
static void cut(double o, double d, double low, double high, double *from, double *to) {
    const double a = (low - o) / d, b = (high - o) / d;
    if (low > high || (fabs(d) <= 0 && (o < low || o > high))) {
        *from = HUGE_VAL;
        *to = -HUGE_VAL;
    } else if (fabs(d) > 0) {
        *from = fmax(*from, fmin(a, b));
        *to = fmin(*to, fmax(a, b));
    }
}

void binary_inside(const binary_body *body, const spt_ray *ray, double shrink, double *from,
                   double *to) {
    const double length = binary_length(ray), radius = body->size[0] - shrink;
    double o[3], d[3], along = 0, across = 0, on = 0, towards = 0;
    *from = -HUGE_VAL;
    *to = HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = body->size[axis] - shrink, center = body->center[axis];
        o[axis] = (double)ray->origin[axis] - (body->kind == BINARY_HALF_SPACE ? 0 : center);
        d[axis] = (double)ray->direction[axis];
        along -= o[axis] * d[axis] / (length * length);
        on += o[axis] * center;
        towards += d[axis] * center;
        if (body->kind == BINARY_BOX) cut(o[axis], d[axis], -half, half, from, to);
    }
    if (body->kind == BINARY_HALF_SPACE) cut(on, towards, -HUGE_VAL, radius, from, to);
    if (body->kind != BINARY_BALL) return;
    for (int axis = 0; axis < 3; ++axis) {
        const double off = o[axis] + along * d[axis];
        across += off * off;
    }
    if (!(radius > 0 && across <= radius * radius)) {
        *from = HUGE_VAL;
        *to = -HUGE_VAL;
        return;
    }
    *from = along - sqrt(radius * radius - across) / length;
    *to = along + sqrt(radius * radius - across) / length;
}

double binary_first(const binary_scene *scene, const spt_ray *ray, double shrink, int *which) {
    double first = HUGE_VAL;
    for (int i = 0; i < scene->count; ++i) {
        double from, to;
        binary_inside(&scene->body[i], ray, shrink, &from, &to);
        from = fmax(from, (double)ray->t_min);
        if (from > to || from > (double)ray->t_max || from >= first) continue;
        first = from;
        if (which != NULL) *which = i;
    }
    return first;
}

/* From the slope of the distance, taken a little outside and a little inside: the face that the ray
 * enters by. */
double binary_cosine(const binary_body *body, const spt_ray *ray, double t) {
    const double length = binary_length(ray);
    const double step = 1e-6 * (body->size[0] < 0 ? 1 : body->size[0]) / length;
    double before[3];
    binary_at(ray, t - step, before);
    return binary_body_distance(body, before) / (step * length);
}

/* ---- Probes -------------------------------------------------------------------------------- */

static float answer(const binary_scene *scene, const float p[3], float radius) {
    const double at[3] = {(double)p[0], (double)p[1], (double)p[2]};
    const double gap = binary_distance(scene, at, NULL) - (double)radius;
    if (gap >= 0) return scene->only_says ? 0.0f : (float)gap;
    return scene->only_says || gap > -(double)FLT_MIN ? -1.0f : (float)gap;
}

static void answer_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         const float *radius, float *clearance) {
    binary_scene *scene = user;
    for (size_t i = 0; i < n; ++i) {
        const float p[3] = {x[i], y[i], z[i]};
        clearance[i] = answer(scene, p, radius[i]);
    }
    ++scene->asked;
    scene->refused += clearance[0] < 0;
}

static float answer_point(void *user, float x, float y, float z, float radius) {
    const float p[3] = {x, y, z};
    return answer(user, p, radius);
}

spt_probe binary_probe(binary_scene *scene, int point) {
    spt_probe probe = spt_probe_default();
    probe.user = scene;
    if (point) {
        probe.point = answer_point;
    } else {
        probe.batch = answer_batch;
    }
    return probe;
}

binary_end binary_printed(double (*gap)(double t), int mended, double first, double stop,
                          double t_max, int most) {
    binary_end end = {0, 0};
    double s = first;
    while (s > stop && end.t < t_max && end.probes < most) {
        ++end.probes;
        if (gap(end.t + s) >= s) {
            const double radius = s;
            s *= 2;                             /* line 5 */
            end.t += 2 * (mended ? radius : s); /* line 6 */
        } else {
            s *= 0.3; /* line 8 */
        }
    }
    return end;
}
