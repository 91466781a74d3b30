/* SPDX-License-Identifier: MIT
 *
 * The renderer's picture once more, slowly and in double precision, to compare with: one ray at a
 * time, no tolerances, no offsets. Light and colours (glass_light.c) are shared, and nothing else. */
#include "shade_light.h"
#include "whitted.h"

#include <math.h>
#include <string.h>

static const double nowhere = 1e300; /* in place of infinity, which is a float */

typedef struct exact_job {
    const glass_world *world;
    const whitted_settings *settings;
    double pixel_radius;
} exact_job;

typedef struct exact_ray {
    double origin[3], direction[3], path;
    int from, inside, reflections, refractions;
} exact_ray;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void point_at(const exact_ray *ray, double t, double point[3]) {
    for (int axis = 0; axis < 3; ++axis) point[axis] = ray->origin[axis] + t * ray->direction[axis];
}

/* ---- Where rays meet things ---------------------------------------------------------------- */

static double body_at(const exact_job *job, const double point[3]) {
    double distance;
    job->world->body->reference(1, &point[0], &point[1], &point[2], &distance);
    return distance;
}

static double body_along(const exact_job *job, const exact_ray *ray, double t) {
    double point[3];
    point_at(ray, t, point);
    return body_at(job, point);
}

/* Both ends of a ball's chord, which may be negative; 0 if there is none. */
static int chord(const double center[3], double radius, const exact_ray *ray, double t[2]) {
    double to_center[3], across[3];
    for (int axis = 0; axis < 3; ++axis) to_center[axis] = center[axis] - ray->origin[axis];
    const double along = dot(to_center, ray->direction);
    for (int axis = 0; axis < 3; ++axis) {
        across[axis] = to_center[axis] - along * ray->direction[axis];
    }
    const double square = radius * radius - dot(across, across);
    t[0] = along - sqrt(fmax(square, 0));
    t[1] = along + sqrt(fmax(square, 0));
    return square > 0;
}

static int chord_of_ball(const glass_ball *ball, const exact_ray *ray, double t[2]) {
    const double center[3] = {(double)ball->center[0], (double)ball->center[1],
                              (double)ball->center[2]};
    return chord(center, (double)ball->radius, ray, t);
}

static int chord_of_bound(const exact_job *job, const exact_ray *ray, double t[2]) {
    const spt_bound *const bound = job->world->body->bound;
    const double center[3] = {(double)bound->center[0], (double)bound->center[1],
                              (double)bound->center[2]};
    return chord(center, (double)bound->radius, ray, t);
}

/* The change of sign between a positive and a negative place. */
static double bisect(const exact_job *job, const exact_ray *ray, double outside, double inside) {
    for (int i = 0; i < 52; ++i) {
        const double middle = 0.5 * (outside + inside);
        *(body_along(job, ray, middle) > 0 ? &outside : &inside) = middle;
    }
    return 0.5 * (outside + inside);
}

/* A place inside the body on [low, high], or infinity: along a ray f is convex, so that the golden
 * section finds its least value. */
static double find_inside(const exact_job *job, const exact_ray *ray, double low, double high) {
    const double golden = 0.6180339887498949;
    double first = high - golden * (high - low), second = low + golden * (high - low);
    double at_first = body_along(job, ray, first), at_second = body_along(job, ray, second);
    for (int i = 0; i < 70 && high > low; ++i) {
        if (at_first < 0) return first;
        if (at_second < 0) return second;
        if (at_first < at_second) {
            high = second;
            second = first;
            at_second = at_first;
            first = high - golden * (high - low);
            at_first = body_along(job, ray, first);
        } else {
            low = first;
            first = second;
            at_first = at_second;
            second = low + golden * (high - low);
            at_second = body_along(job, ray, second);
        }
    }
    return nowhere;
}

/* Where a ray from outside enters the body before t_max, or infinity. */
static double way_in(const exact_job *job, const exact_ray *ray, double t_max) {
    double t[2];
    if (!chord_of_bound(job, ray, t)) return nowhere;
    const double low = fmax(t[0], 0), high = fmin(t[1], t_max);
    if (!(low < high)) return nowhere;
    const double inside = find_inside(job, ray, low, high);
    return inside < nowhere ? bisect(job, ray, low, inside) : nowhere;
}

/* Where a ray from inside, or from the surface inwards, leaves the body. */
static double way_out(const exact_job *job, const exact_ray *ray, double from) {
    double t[2];
    chord_of_bound(job, ray, t);
    const double inside = find_inside(job, ray, from, t[1]);
    return inside < nowhere ? bisect(job, ray, t[1], inside) : from;
}

static void normal_at(const exact_job *job, int object, const double point[3], double normal[3]) {
    const double step = 1e-5;
    for (int axis = 0; axis < 3; ++axis) {
        if (object >= 0) {
            const glass_ball *const ball = &job->world->balls[object];
            normal[axis] = (point[axis] - (double)ball->center[axis]) / (double)ball->radius;
        } else if (object == GLASS_GROUND) {
            normal[axis] = axis == 1;
        } else {
            double ahead[3], behind[3];
            memcpy(ahead, point, sizeof ahead);
            memcpy(behind, point, sizeof behind);
            ahead[axis] += step;
            behind[axis] -= step;
            normal[axis] = (body_at(job, ahead) - body_at(job, behind)) / (2 * step);
        }
    }
    const double length = sqrt(dot(normal, normal));
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= length;
}

/* The first thing on a ray, and where. */
static double meet(const exact_job *job, const exact_ray *ray, int *object) {
    const glass_world *const world = job->world;
    double nearest = nowhere, t[2];
    *object = GLASS_NOTHING;
    if (ray->inside != GLASS_NOTHING) {
        *object = ray->inside;
        if (ray->inside == GLASS_BODY) return way_out(job, ray, 0);
        chord_of_ball(&world->balls[ray->inside], ray, t);
        return t[1];
    }
    for (int i = 0; i < world->ball_count; ++i) {
        if (i == ray->from || !chord_of_ball(&world->balls[i], ray, t)) continue;
        if (!(t[0] > 0 && t[0] < nearest)) continue;
        nearest = t[0];
        *object = i;
    }
    if (world->has_ground && ray->from != GLASS_GROUND && ray->direction[1] < 0) {
        t[0] = fmax((ray->origin[1] - (double)world->ground) / -ray->direction[1], 0);
        if (t[0] < nearest) {
            nearest = t[0];
            *object = GLASS_GROUND;
        }
    }
    if (ray->from == GLASS_BODY) return nearest; /* convex */
    t[0] = way_in(job, ray, nearest);
    if (t[0] < nearest) *object = GLASS_BODY;
    return fmin(t[0], nearest);
}

/* ---- Light --------------------------------------------------------------------------------- */

/* What part of unpolarised light is reflected (Fresnel), by the cosine on the side it comes from;
 * ratio is that side's index over the other's. cosine_into receives the other side's. */
static double reflectance_of(double cosine, double ratio, double *cosine_into) {
    const double square = 1 - ratio * ratio * (1 - cosine * cosine);
    *cosine_into = sqrt(fmax(square, 0));
    if (square <= 0) return 1;
    const double across = (ratio * cosine - *cosine_into) / (ratio * cosine + *cosine_into);
    const double along = (ratio * *cosine_into - cosine) / (ratio * *cosine_into + cosine);
    return 0.5 * (across * across + along * along);
}

/* What is left of light that goes unbent through glass between two points of a ray; entered: it
 * passes the nearer surface, too. */
static void pass_glass(const exact_job *job, const exact_ray *ray, int object, const double t[2],
                       int entered, double light[3]) {
    const glass_material *const glass =
        object == GLASS_BODY ? &job->world->body_material : &job->world->balls[object].material;
    for (int end = entered ? 0 : 1; end < 2; ++end) {
        double point[3], normal[3], into;
        point_at(ray, t[end], point);
        normal_at(job, object, point, normal);
        const double cosine = fabs(dot(normal, ray->direction));
        const double left = 1 - reflectance_of(cosine, 1 / (double)glass->index, &into);
        for (int c = 0; c < 3; ++c) light[c] *= left;
    }
    for (int c = 0; c < 3; ++c) light[c] *= exp(-(double)glass->absorption[c] * (t[1] - t[0]));
}

/* How much of the sun's light comes through to a point. */
static void sunlight_at(const exact_job *job, const exact_ray *to_sun, double light[3]) {
    double t[2];
    for (int i = 0; i < job->world->ball_count; ++i) {
        const glass_ball *const ball = &job->world->balls[i];
        if (i == to_sun->from || !chord_of_ball(ball, to_sun, t) || !(t[0] > 0)) continue;
        if (ball->material.surface != GLASS_CLEAR) {
            memset(light, 0, 3 * sizeof *light);
            return;
        }
        pass_glass(job, to_sun, i, t, 1, light);
    }
    const int touches = body_along(job, to_sun, 0) < (double)job->settings->epsilon;
    t[0] = touches ? 0 : way_in(job, to_sun, nowhere);
    if (!(t[0] < nowhere)) return;
    t[1] = way_out(job, to_sun, t[0]);
    if (!(t[1] > t[0])) return;
    pass_glass(job, to_sun, GLASS_BODY, t, !touches, light);
}

static void matt_light(const exact_job *job, const exact_ray *ray, int object, double t,
                       const double point[3], double light[3]) {
    exact_ray to_sun;
    glass_point at;
    double normal[3], sun[3] = {1, 1, 1};
    float by_sun[3], rest[3];
    normal_at(job, object, point, normal);
    for (int axis = 0; axis < 3; ++axis) {
        to_sun.origin[axis] = point[axis];
        to_sun.direction[axis] = (double)light_sun_direction[axis];
        at.position[axis] = (float)point[axis];
        at.normal[axis] = (float)normal[axis];
        at.view[axis] = (float)ray->direction[axis];
    }
    to_sun.from = at.object = object;
    at.way = (float)(ray->path + t);
    const double slope = fmax(fabs(dot(normal, ray->direction)), 1e-3);
    at.footprint = (float)(2 * job->pixel_radius * (ray->path + t) / slope);
    glass_shade(job->world, &at, by_sun, rest);
    if (by_sun[0] > 0) sunlight_at(job, &to_sun, sun);
    for (int c = 0; c < 3; ++c) light[c] = (double)rest[c] + (double)by_sun[c] * sun[c];
}

static void ray_light(const exact_job *job, const exact_ray *ray, double light[3]);

/* The light from one of the two ways on from a surface of glass or a mirror. */
static void way_light(const exact_job *job, const exact_ray *next, double light[3]) {
    if (next->reflections >= 0 && next->refractions >= 0) {
        ray_light(job, next, light);
        return;
    }
    float direction[3], around[3];
    for (int axis = 0; axis < 3; ++axis) direction[axis] = (float)next->direction[axis];
    glass_environment(job->world, direction, around);
    for (int c = 0; c < 3; ++c) light[c] = (double)around[c];
}

static void glass_light(const exact_job *job, const exact_ray *ray, int object, double t,
                        const double point[3], double light[3]) {
    const glass_material *const material =
        object == GLASS_BODY ? &job->world->body_material : &job->world->balls[object].material;
    const int mirror = material->surface == GLASS_MIRROR, inside = ray->inside == object;
    const double ratio = inside ? (double)material->index : 1 / (double)material->index;
    double normal[3], part[3], into = 0;
    exact_ray next = *ray;
    normal_at(job, object, point, normal);
    const double side = inside ? -1 : 1, cosine = fabs(dot(normal, ray->direction));
    const double reflectance = mirror ? 1 : reflectance_of(cosine, ratio, &into);
    next.path = ray->path + t;
    next.from = object;
    memcpy(next.origin, point, sizeof next.origin);
    for (int axis = 0; axis < 3; ++axis) {
        next.direction[axis] += 2 * cosine * side * normal[axis];
    }
    *(reflectance < 1 || mirror ? &next.reflections : &next.refractions) -= 1;
    way_light(job, &next, light);
    for (int c = 0; c < 3; ++c) {
        light[c] *= reflectance * (mirror ? (double)material->colour[c] : 1.0);
    }
    if (reflectance < 1) {
        next.reflections = ray->reflections;
        next.refractions = ray->refractions - 1;
        next.inside = inside ? GLASS_NOTHING : object;
        for (int axis = 0; axis < 3; ++axis) {
            next.direction[axis] =
                ratio * ray->direction[axis] + (ratio * cosine - into) * side * normal[axis];
        }
        way_light(job, &next, part);
        for (int c = 0; c < 3; ++c) light[c] += (1 - reflectance) * part[c];
    }
    for (int c = 0; c < 3 && inside; ++c) light[c] *= exp(-(double)material->absorption[c] * t);
}

static void ray_light(const exact_job *job, const exact_ray *ray, double light[3]) {
    int object;
    double point[3];
    const double t = meet(job, ray, &object);
    if (object == GLASS_NOTHING) {
        exact_ray ended = *ray;
        ended.reflections = -1;
        way_light(job, &ended, light);
        return;
    }
    point_at(ray, t, point);
    if (object == GLASS_GROUND ||
        (object >= 0 && job->world->balls[object].material.surface == GLASS_MATT)) {
        matt_light(job, ray, object, t, point, light);
    } else {
        glass_light(job, ray, object, t, point, light);
    }
}

void whitted_exact(const glass_world *world, const whitted_settings *settings, int width,
                   int height, double x, double y, double light[3]) {
    const spt_camera camera = scene_camera(world->body, (uint32_t)width, (uint32_t)height);
    const double across = (double)camera.x_high - (double)camera.x_low;
    const double down = (double)camera.y_high - (double)camera.y_low;
    exact_job job;
    exact_ray ray;
    job.world = world;
    job.settings = settings;
    job.pixel_radius = across / (2.0 * width);
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = (double)camera.eye[axis];
        ray.direction[axis] =
            (double)camera.forward[axis] +
            ((double)camera.x_low + across * x / width) * (double)camera.right[axis] +
            ((double)camera.y_high - down * y / height) * (double)camera.up[axis];
    }
    const double length = sqrt(dot(ray.direction, ray.direction));
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] /= length;
    ray.path = 0;
    ray.from = ray.inside = GLASS_NOTHING;
    ray.reflections = settings->reflections;
    ray.refractions = settings->refractions;
    ray_light(&job, &ray, light);
}
