/* SPDX-License-Identifier: MIT
 *
 * planes.csv: planes from 1e2 to 1e8 away, 10 000 rays at each distance, by every step rule. Where
 * float positions no longer resolve the tolerance a tracer without a rounding floor stalls short of
 * the surface, on every other ray from 1e5 on. */
#include <math.h>
#include <stdlib.h>

#include "../../oracle/tolerance.h"
#include "../report.h"

enum { first_decade = 2, last_decade = 8, planes = 100, rays_each = 100 };

/* normal . p = offset, the camera on the outside. */
typedef struct plane {
    double normal[3], offset;
} plane;

static double height(const plane *one, const double p[3]) {
    return one->offset - one->normal[0] * p[0] - one->normal[1] * p[1] - one->normal[2] * p[2];
}

/* In double, and rounded once. */
static void plane_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                        float *distance) {
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)height(user, p);
    }
}

static void draw_direction(report_random *random, double direction[3]) {
    double square;
    do {
        square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = report_uniform(random, -1, 1);
            square += direction[axis] * direction[axis];
        }
    } while (!(square > 0.01 && square <= 1));
    for (int axis = 0; axis < 3; ++axis) direction[axis] /= sqrt(square);
}

static void draw_plane(report_random *random, double distance, plane *one) {
    draw_direction(random, one->normal);
    one->offset = distance * (1 + report_uniform(random, 0, 0.5)) + report_uniform(random, 0, 1);
}

/* From the origin, within 60 degrees of the normal. */
static void draw_ray(report_random *random, const plane *one, spt_ray *ray) {
    double way[3], cosine;
    do {
        draw_direction(random, way);
        cosine = way[0] * one->normal[0] + way[1] * one->normal[1] + way[2] * one->normal[2];
    } while (!(cosine > 0.5));
    for (int axis = 0; axis < 3; ++axis) {
        ray->origin[axis] = 0;
        ray->direction[axis] = (float)way[axis];
    }
    ray->t_min = 0;
    ray->t_max = INFINITY;
}

typedef struct counts {
    int rays, missed, undecided;
    double error; /* the largest distance of a hit from the plane, over the tolerance there */
} counts;

/* A position is off by at most 2.5u of the coordinates, u = 2^-24, and the tolerance is 4u of them
 * here: a hit is at most 1.625 tolerances from the plane. What is farther is no hit of it. */
static void judge(const plane *one, const spt_settings *settings, const spt_ray *ray,
                  const spt_hit *hit, counts *sum) {
    const double t = (double)hit->t;
    ++sum->rays;
    if (hit->outcome == SPT_LIMIT) {
        ++sum->undecided;
        return;
    }
    double p[3], error = HUGE_VAL;
    if (hit->outcome == SPT_HIT) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = t * (double)ray->direction[axis];
        error = fabs(height(one, p)) / oracle_tolerance(settings, ray, t);
        sum->error = fmax(sum->error, error);
    }
    sum->missed += !(error <= 1.625);
}

static int cells(const report_options *options) {
    (void)options;
    return last_decade - first_decade + 1;
}

static void measure(const report_options *options, int cell, FILE *rows) {
    const double distance = pow(10, first_decade + cell);
    spt_ray rays[rays_each];
    spt_hit hits[rays_each];
    (void)options;
    for (int rule = 0; rule < report_rules; ++rule) {
        report_random random = {(uint64_t)cell};
        counts sum = {0, 0, 0, 0};
        spt_settings settings = spt_settings_default();
        settings.method = bench_method(report_rule[rule]);
        settings.budget = 256;
        for (int i = 0; i < planes; ++i) {
            plane one;
            spt_field field = spt_field_default();
            draw_plane(&random, distance, &one);
            for (int k = 0; k < rays_each; ++k) draw_ray(&random, &one, &rays[k]);
            field.batch = plane_batch;
            field.user = &one;
            field.flags = SPT_FIELD_CONVEX;
            const spt_rays traced = spt_rays_of(rays);
            const spt_hits results = spt_hits_of(hits);
            report_expect(spt_trace(&field, &settings, rays_each, &traced, &results, NULL) ==
                              SPT_OK,
                          "a plane is refused");
            for (int k = 0; k < rays_each; ++k) judge(&one, &settings, &rays[k], &hits[k], &sum);
        }
        fprintf(rows, "%.9g,%s,%d,%d,%d,%.9g\n", distance, report_rule[rule], sum.rays, sum.missed,
                sum.undecided, sum.error);
    }
}

const report_part report_planes = {"planes",
                                   "distance,method,rays,missed,undecided,"
                                   "largest_error_over_tolerance",
                                   cells,
                                   measure,
                                   0,
                                   {0.2, 0.2}};
