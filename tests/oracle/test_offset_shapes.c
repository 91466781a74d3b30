/* SPDX-License-Identifier: MIT
 *
 * Property Q17: rays that leave a convex shape from an offset origin do not hit it again. 50 shapes
 * and 48 rays of each; SPT_GLASS_RAYS=N takes N shapes of N rays. */
#include "analytic.h"
#include "check.h"
#include "rules.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { hit_count = 16 };

/* A convex shape of any proportions at the origin. */
static analytic_shape draw_shape(double *scale) {
    static const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_CAPSULE,
                                          ANALYTIC_CYLINDER};
    analytic_shape shape;
    *scale = pow(10, check_uniform(-3, 3));
    shape = analytic_sample(kinds[check_random() % 4], *scale);
    shape.radius *= check_uniform(0.3, 1.5);
    shape.extent *= check_uniform(0.3, 1.5);
    for (int axis = 0; axis < 3; ++axis) shape.half[axis] *= check_uniform(0.3, 1.5);
    return shape;
}

static void distances(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)analytic_distance(user, p);
    }
}

/* The gradient of the exact distance, in double: off by about 1e-9 outside the shape. */
static void gradient_of(const analytic_shape *shape, double scale, const float origin[3],
                        double gradient[3]) {
    const double h = 1e-7 * scale;
    for (int axis = 0; axis < 3; ++axis) {
        double above[3], below[3];
        for (int i = 0; i < 3; ++i) above[i] = below[i] = (double)origin[i];
        above[axis] += h;
        below[axis] -= h;
        gradient[axis] =
            (analytic_distance(shape, above) - analytic_distance(shape, below)) / (2 * h);
    }
}

static void random_direction(double d[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            d[axis] = check_uniform(-1, 1);
            square += d[axis] * d[axis];
        }
    } while (!(square > 0.01 && square < 1));
    for (int axis = 0; axis < 3; ++axis) d[axis] /= sqrt(square);
}

/* Hits on the shape from around it, and the origins off it. Returns how many were hit. */
static int make_origins(const spt_field *field, const spt_settings *settings, double scale,
                        float (*origins)[3]) {
    static spt_ray rays[hit_count];
    static spt_hit hits[hit_count];
    static float normals[hit_count][3];
    static int32_t start[hit_count];
    const spt_rays from = spt_rays_of(rays);
    const spt_hits to = spt_hits_of(hits);
    const spt_vectors read = spt_vectors_of(normals[0]);
    const spt_vector_sinks write = spt_vector_sinks_of(normals[0]);
    const spt_normal_rule differences =
        check_random() % 2 != 0 ? SPT_NORMAL_CENTRAL : SPT_NORMAL_TETRAHEDRON;
    const spt_column stay = {NULL, 0};
    const uint32_t checks = check_random() % 5;
    spt_starts starts;
    int count = 0;
    for (int i = 0; i < hit_count; ++i) {
        double d[3];
        random_direction(d);
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].origin[axis] = (float)(4 * scale * d[axis]);
            rays[i].direction[axis] =
                (float)(check_uniform(-0.3, 0.3) * scale - (double)rays[i].origin[axis]);
        }
        rays[i].t_min = 0;
        rays[i].t_max = 10;
    }
    memset(&starts, 0, sizeof starts);
    starts.origin = spt_vector_sinks_of(origins[0]);
    starts.start.first = start;
    starts.start.stride = sizeof *start;
    CHECK(spt_trace(field, settings, hit_count, &from, &to, NULL) == SPT_OK);
    CHECK(spt_normals(field, 1, settings, differences, (float)(0.1 * scale), hit_count, &from, &to,
                      &write) == SPT_OK);
    CHECK(spt_offset(field, 1, settings, hit_count, &from, &to, &read, &stay, checks, &starts) ==
          SPT_OK);
    for (int i = 0; i < hit_count; ++i) {
        if (hits[i].outcome != SPT_HIT) continue;
        CHECK_SAY(start[i] == SPT_START_CLEAR, "start %d", (int)start[i]);
        memmove(origins[count++], origins[i], sizeof *origins);
    }
    return count;
}

/* f is convex: f(o + t d) >= f(o) + t grad f . d, so where that slope is not negative the ray stays
 * as clear as its origin, by twice the tolerance. Rays close to a face take the convex rule, others
 * would crawl along it. */
static spt_ray outgoing(const analytic_shape *shape, double scale, const float origin[3],
                        double *slope) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 0};
    double gradient[3], d[3];
    gradient_of(shape, scale, origin, gradient);
    do {
        random_direction(d);
        *slope = gradient[0] * d[0] + gradient[1] * d[1] + gradient[2] * d[2];
        if (check_random() % 4 == 0) { /* close to a right angle */
            for (int axis = 0; axis < 3; ++axis) d[axis] -= 0.999 * *slope * gradient[axis];
            *slope = gradient[0] * d[0] + gradient[1] * d[1] + gradient[2] * d[2];
        }
    } while (!(*slope > 1e-6));
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = origin[axis];
        ray.direction[axis] = (float)d[axis];
    }
    ray.t_max = (float)(20 * scale);
    return ray;
}

static long leave_shape(long ray_count) {
    double scale;
    const analytic_shape shape = draw_shape(&scale);
    float origins[hit_count][3];
    spt_field field = spt_field_default();
    spt_settings settings = spt_settings_default();
    int hits;
    long returned = 0;
    field.batch = distances;
    field.user = (void *)(uintptr_t)&shape; /* read only */
    field.flags = SPT_FIELD_CONVEX;
    settings.epsilon = (float)(scale * pow(10, check_uniform(-5, -3)));
    settings.budget = 2000;
    check_context("shape %d, scale %g, epsilon %g", (int)shape.kind, scale,
                  (double)settings.epsilon);
    settings.method = spt_convex();
    hits = make_origins(&field, &settings, scale, origins);
    CHECK_SAY(hits > 0, "no hits");
    for (long i = 0; i < ray_count && hits > 0; ++i) {
        double slope;
        const spt_ray ray = outgoing(&shape, scale, origins[i % hits], &slope);
        const spt_rays from = spt_rays_of(&ray);
        spt_hit hit;
        const spt_hits to = spt_hits_of(&hit);
        settings.method =
            slope < 0.05 ? spt_convex() : rules[check_random() % (uint32_t)rule_count].method();
        settings.flags = i % 2 != 0 ? SPT_SKIP_START : 0;
        CHECK(spt_trace(&field, &settings, 1, &from, &to, NULL) == SPT_OK);
        CHECK_SAY(hit.outcome == SPT_MISS && hit.flags == 0,
                  "%s: outcome %d at %g of scale, slope %g", spt_method_name(settings.method),
                  hit.outcome, (double)hit.t / scale, slope);
        returned += hit.outcome != SPT_MISS;
    }
    return returned;
}

static void Q17_no_convex_shape_is_hit_again(void) {
    const char *wanted = getenv("SPT_GLASS_RAYS");
    const long asked = wanted != NULL ? strtol(wanted, NULL, 10) : 0;
    const long shapes = asked > 0 ? asked : 50, rays = asked > 0 ? asked : 48;
    long returned = 0;
    for (long i = 0; i < shapes; ++i) returned += leave_shape(rays);
    if (asked > 0) {
        printf("%ld shapes, %ld rays each: %ld hit it again\n", shapes, rays, returned);
    }
}

void suite_offset_shapes(void) {
    RUN(Q17_no_convex_shape_is_hit_again);
}
