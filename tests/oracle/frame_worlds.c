/* SPDX-License-Identifier: MIT
 *
 * Unions of balls, and cameras that answer by the point alone. */
#include "frame_worlds.h"
#include "../check.h"

#include <math.h>

static double part_distance(const ball_part *part, double x, double y, double z) {
    const world *w = part->shape;
    double a, b, c;
    if (part->index == w->count) return y + 3 * w->scale;
    a = x - w->scale * w->center[part->index][0];
    b = y - w->scale * w->center[part->index][1];
    c = z - w->scale * w->center[part->index][2];
    return sqrt(a * a + b * b + c * c) - w->scale * w->radius[part->index];
}

static void part_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    const ball_part *part = user;
    for (size_t i = 0; i < n; ++i) {
        distance[i] = (float)part_distance(part, (double)x[i], (double)y[i], (double)z[i]);
    }
}

void ball_scene_of(ball_scene *balls, const world *shape, uint32_t bounded, uint32_t convex) {
    balls->shape = *shape;
    balls->scene = spt_scene_default();
    balls->scene.fields = balls->fields;
    balls->scene.count = (size_t)(shape->count + shape->has_floor);
    for (int i = 0; i < shape->count + shape->has_floor; ++i) {
        spt_field *field = &balls->fields[i];
        *field = spt_field_default();
        balls->parts[i].shape = &balls->shape;
        balls->parts[i].index = i;
        field->batch = part_batch;
        field->user = &balls->parts[i];
        field->flags = (convex >> i & 1) != 0 ? SPT_FIELD_CONVEX : 0;
        if (i < shape->count && (bounded >> i & 1) != 0) {
            const double *c = shape->center[i];
            const float radius = (float)(shape->scale * shape->radius[i] * 1.01);
            balls->bounds[i] =
                spt_bound_sphere((float)(shape->scale * c[0]), (float)(shape->scale * c[1]),
                                 (float)(shape->scale * c[2]), radius);
            field->bound = &balls->bounds[i];
        }
    }
}

void ball_scene_draw(ball_scene *balls, const world *shape) {
    const uint32_t bounded = check_random(), convex = check_random();
    ball_scene_of(balls, shape, bounded, convex);
}

static double union_distance(const void *user, const double p[3]) {
    const ball_scene *balls = user;
    double least = HUGE_VAL;
    for (size_t i = 0; i < balls->scene.count; ++i) {
        least = fmin(least, part_distance(&balls->parts[i], p[0], p[1], p[2]));
    }
    return least;
}

truth_field ball_scene_truth(const ball_scene *balls) {
    truth_field field = {union_distance, NULL};
    field.user = balls;
    return field;
}

double ball_scene_first(const world *shape, const double o[3], const double d[3], double slack) {
    double first = HUGE_VAL;
    for (int i = 0; i < shape->count; ++i) {
        const double radius = shape->scale * shape->radius[i] - slack;
        double v[3], along, across = 0, half;
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = shape->scale * shape->center[i][axis] - o[axis];
        along = camera_dot(v, d);
        for (int axis = 0; axis < 3; ++axis) {
            const double offset = v[axis] - along * d[axis];
            across += offset * offset;
        }
        half = radius * radius - across;
        if (half > 0 && along - sqrt(half) >= 0) first = fmin(first, along - sqrt(half));
    }
    if (shape->has_floor && d[1] < 0) {
        first = fmin(first, -(o[1] + 3 * shape->scale + slack) / d[1]);
    }
    return first;
}

double lens_noise(double a, double b) {
    uint32_t bits = (uint32_t)(a * 64) * 0x9e3779b9u ^ (uint32_t)(b * 64) * 0x85ebca6bu;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 12) * 0x297a2d39u;
    return (bits ^ bits >> 15) / 4294967296.0;
}

static void thin_ray(const lens *user, double x, double y, double o[3], double d[3]) {
    const double angle = 6.283185307179586 * lens_noise(x, y);
    const double radius = user->aperture * sqrt(lens_noise(y, x + 1e3));
    const double focus = 8;
    o[0] = radius * cos(angle);
    o[1] = radius * sin(angle);
    o[2] = 0;
    d[0] = focus * 0.6 * (2 * x / user->width - 1) - o[0];
    d[1] = focus * 0.45 * (1 - 2 * y / user->height) - o[1];
    d[2] = focus;
}

/* The poles at the top and the bottom of the image; its middle looks along z. */
static void panorama_ray(const lens *user, double x, double y, double o[3], double d[3]) {
    const double longitude = 6.283185307179586 * (x / user->width - 0.5);
    const double latitude = 3.141592653589793 * (0.5 - y / user->height);
    o[0] = o[1] = o[2] = 0;
    d[0] = cos(latitude) * sin(longitude);
    d[1] = sin(latitude);
    d[2] = cos(latitude) * cos(longitude);
}

/* Origins off the balls, most directions towards them. */
static void disorderly_ray(double x, double y, double o[3], double d[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        o[axis] = 2 * lens_noise(x + 7 * axis, y) - 1;
        d[axis] = 2 * lens_noise(y + 3 * axis, x + 500) - 1;
    }
    if (lens_noise(x + 900, y) < 0.8) d[2] = 1;
}

static void mix(spt_camera_ray *ray, double x, double y) {
    const double which = lens_noise(x + 50, y + 60);
    ray->path = (float)(3 * lens_noise(x, y + 70));
    if (which < 0.1) {
        ray->active = 0;
    } else if (which < 0.15) {
        ray->ray.direction[(int)x % 3] = NAN;
    } else if (which < 0.3) {
        for (int axis = 0; axis < 3; ++axis) ray->ray.direction[axis] *= 1.75f;
    } else if (which < 0.5) {
        ray->ray.t_min = (float)(2.5 * lens_noise(y, y)); /* still before the balls */
    } else if (which < 0.7) {
        ray->ray.t_max = (float)(12 * lens_noise(x, x));
    } else if (which < 0.75) {
        ray->ray.t_max = NAN;
    }
}

static void lens_rays(void *user, size_t count, const float *x, const float *y,
                      spt_camera_ray *rays) {
    const lens *one = user;
    for (size_t i = 0; i < count; ++i) {
        const double a = (double)x[i], b = (double)y[i];
        double o[3], d[3];
        if (one->kind == LENS_PANORAMA) {
            panorama_ray(one, a, b, o, d);
        } else if (one->kind == LENS_DISORDER) {
            disorderly_ray(a, b, o, d);
        } else {
            thin_ray(one, a, b, o, d);
        }
        camera_unit(d);
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].ray.origin[axis] = (float)o[axis];
            rays[i].ray.direction[axis] = (float)d[axis];
        }
        rays[i].ray.t_max = 50;
        if (one->kind == LENS_MIXED) mix(&rays[i], a, b);
    }
}

spt_camera lens_camera(lens *user, int kind, uint32_t width, uint32_t height) {
    user->kind = kind;
    user->width = (double)width;
    user->height = (double)height;
    user->aperture = 0.3;
    return spt_camera_of_rays(lens_rays, user);
}
