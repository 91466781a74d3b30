/* SPDX-License-Identifier: MIT
 *
 * The surfaces, random hits on them, and the judgement of new origins. */
#include "glass_landing.h"
#include "check.h"

#include <math.h>
#include <string.h>

double landing_distance(const landing *surface, const double p[3]) {
    const double z = p[2] - surface->place, width = surface->width;
    switch (surface->kind) {
    case LANDING_BALL:
        return sqrt(p[0] * p[0] + p[1] * p[1] + (z + width) * (z + width)) - width;
    case LANDING_SHEET:
        return fabs(z + width / 2) - width / 2;
    case LANDING_GAP:
        return fmin(z, width - z);
    default:
        return z;
    }
}

void landing_normal(const landing *surface, const double p[3], float normal[3]) {
    const double z = p[2] - surface->place, width = surface->width;
    normal[0] = normal[1] = 0.0f;
    normal[2] = 1.0f;
    if (surface->kind == LANDING_SHEET && z < -width / 2) normal[2] = -1.0f;
    if (surface->kind == LANDING_GAP && z > width / 2) normal[2] = -1.0f;
    if (surface->kind == LANDING_BALL) {
        const double v[3] = {p[0], p[1], z + width};
        const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int axis = 0; axis < 3; ++axis) normal[axis] = (float)(v[axis] / length);
    }
}

static void distances(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    landing *surface = user;
    ++surface->calls;
    surface->points += (unsigned)n;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)(landing_distance(surface, p) / surface->weak);
    }
}

spt_field landing_field(landing *surface) {
    spt_field field = spt_field_default();
    field.batch = distances;
    field.user = surface;
    return field;
}

/* Where a ray is at t, in the library's arithmetic: one multiplication, one addition. */
static void position(const spt_ray *ray, float t, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const float step = t * ray->direction[axis];
        const float at = ray->origin[axis] + step;
        p[axis] = (double)at;
    }
}

landing_case landing_hit(const landing *surface, double over, int inside, double path) {
    landing_case one;
    const int doublings = (int)(check_random() % 10) - 5;
    const double scale = ldexp(check_uniform(1, 2), doublings);
    const double length = check_uniform(1, 4);
    double d[3], p[3], square = 0;
    memset(&one, 0, sizeof one);
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = axis < 2 ? check_uniform(-1, 1) : (inside ? 1 : -1) * check_uniform(0.2, 1);
        square += d[axis] * d[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double target = axis < 2 ? 0 : surface->place + over;
        d[axis] /= sqrt(square);
        one.ray.origin[axis] = (float)(target - length * d[axis]);
        one.ray.direction[axis] = (float)(scale * d[axis]);
    }
    one.ray.t_max = INFINITY;
    one.hit.t = (float)(length / scale);
    one.hit.outcome = SPT_HIT;
    one.hit.flags = inside ? SPT_FLAG_INSIDE : 0;
    one.path = (float)path;
    position(&one.ray, one.hit.t, p);
    one.hit.residual = (float)(landing_distance(surface, p) / surface->weak);
    landing_normal(surface, p, one.normal);
    return one;
}

void landing_offset(const spt_field *field, const spt_settings *settings, uint32_t checks,
                    size_t count, const landing_case *cases, landing_result *results) {
    spt_rays rays = spt_rays_of(&cases->ray);
    /* The library only reads these hits. */
    spt_hits hits = spt_hits_of((spt_hit *)(uintptr_t)&cases->hit);
    spt_vectors normals = spt_vectors_of(cases->normal);
    const ptrdiff_t stride = (ptrdiff_t)sizeof *cases, step = (ptrdiff_t)sizeof *results;
    const spt_column cross = {&cases->cross, stride};
    spt_starts starts;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis].stride = rays.direction[axis].stride = normals.axis[axis].stride = stride;
        starts.origin.axis[axis].first = &results->origin[axis];
        starts.origin.axis[axis].stride = step;
    }
    rays.t_min.stride = rays.t_max.stride = stride;
    rays.path.first = &cases->path;
    rays.path.stride = stride;
    hits.t.stride = hits.residual.stride = hits.outcome.stride = hits.flags.stride = stride;
    hits.component.first = hits.evaluations.first = hits.fallbacks.first = NULL;
    hits.candidate_t.first = hits.candidate_ratio.first = NULL;
    starts.path.first = &results->path;
    starts.start.first = &results->start;
    starts.path.stride = starts.start.stride = step;
    CHECK(spt_offset(field, 1, settings, count, &rays, &hits, &normals, &cross, checks, &starts) ==
          SPT_OK);
}

double landing_tolerance(const spt_settings *settings, const landing_result *result) {
    const double x = fabs((double)result->origin[0]), y = fabs((double)result->origin[1]);
    const double largest = fmax(fmax(x, y), fabs((double)result->origin[2]));
    const double cone = (double)settings->pixel_radius * (double)result->path;
    const double rounding = 0x1p-22 * (largest + (double)settings->size);
    return fmax(fmax((double)settings->epsilon, cone), rounding);
}

double landing_clearance(const landing *surface, const landing_case *one, const double p[3]) {
    const int from_inside = (one->hit.flags & SPT_FLAG_INSIDE) != 0;
    const double side = from_inside == (one->cross != 0) ? 1 : -1;
    return side * landing_distance(surface, p) / surface->weak;
}

void landing_expect_true(const landing *surface, const spt_settings *settings,
                         const landing_case *one, const landing_result *result) {
    const double tolerance = landing_tolerance(settings, result);
    const double p[3] = {(double)result->origin[0], (double)result->origin[1],
                         (double)result->origin[2]};
    const double clearance = landing_clearance(surface, one, p);
    /* The tolerance is rounded four times, f once. */
    const double round = 0x1p-21 * tolerance;
    double square = 0, hit[3];
    for (int axis = 0; axis < 3; ++axis) {
        square += (double)one->ray.direction[axis] * (double)one->ray.direction[axis];
    }
    switch (result->start) {
    case SPT_START_CLEAR:
        CHECK_SAY(clearance > tolerance - round, "clear by %.9g at a tolerance of %.9g", clearance,
                  tolerance);
        break;
    case SPT_START_NEAR:
        CHECK_SAY(clearance >= 0 && clearance < tolerance + round,
                  "near by %.9g at a tolerance of %.9g", clearance, tolerance);
        break;
    default:
        CHECK_SAY(result->start == SPT_START_AT_HIT, "start %d", (int)result->start);
        position(&one->ray, one->hit.t, hit);
        CHECK_SAY(p[0] - hit[0] == 0 && p[1] - hit[1] == 0 && p[2] - hit[2] == 0,
                  "at %.9g %.9g %.9g, not at the hit %.9g %.9g %.9g", p[0], p[1], p[2], hit[0],
                  hit[1], hit[2]);
    }
    CHECK_SAY(
        fabs((double)result->path - ((double)one->path + (double)one->hit.t * sqrt(square))) <=
            0x1p-21 * (double)result->path,
        "path %.9g", (double)result->path);
}
