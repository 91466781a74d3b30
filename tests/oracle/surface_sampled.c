/* SPDX-License-Identifier: MIT
 *
 * Points of surfaces and their normals: see surface_sampled.h. */
#include "surface_sampled.h"
#include "../check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float along_z[3] = {0, 0, 1};

spt_rays sampled_rays(const surface_sampled *at) {
    spt_rays rays;
    memset(&rays, 0, sizeof rays);
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis].first = &at->point[0][axis];
        rays.origin[axis].stride = sizeof at->point[0];
        rays.direction[axis].first = &along_z[axis];
    }
    return rays;
}

spt_hits sampled_t(const float *t, size_t count) {
    spt_hits hits;
    memset(&hits, 0, sizeof hits);
    hits.t.first = (void *)(uintptr_t)t; /* read only */
    hits.t.stride = count > 1 ? sizeof *t : 0;
    return hits;
}

spt_status sampled_normals(const spt_field *field, const spt_settings *settings,
                           spt_normal_rule rule, float detail, surface_sampled *at) {
    static float t[sampled_points];
    const spt_rays rays = sampled_rays(at);
    const spt_hits hits = sampled_t(t, at->count);
    const spt_vector_sinks normals = spt_vector_sinks_of(at->normal[0]);
    return spt_normals(field, 1, settings, rule, detail, at->count, &rays, &hits, &normals);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void sampled_measure(const surface_run *run, const surface_body *body, const spt_settings *given,
                     spt_normal_rule rule, float detail, surface_sampled *at) {
    const reference_field reference = surface_body_field(body);
    const spt_field field = surface_field(run, &reference, 0);
    const spt_settings settings = surface_settings(run, given);
    CHECK(sampled_normals(&field, &settings, rule, detail, at) == SPT_OK);
    for (size_t i = 0; i < at->count; ++i) {
        double p[3], n[3], gradient[3];
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = (double)at->point[i][axis];
            n[axis] = (double)at->normal[i][axis];
        }
        surface_gradient(body, p, gradient);
        at->angle[i] = surface_angle(n, gradient);
        /* Three squares, a root and three divisions: each half an ulp. */
        CHECK_SAY(fabs(surface_length(n) - 1) <= 4 * 0x1p-23, "length %.9g", surface_length(n));
    }
    qsort(at->angle, at->count, sizeof at->angle[0], ascending);
}

void sampled_point(const surface_body *body, double margin, double p[3]) {
    const analytic_shape *shape = &body->shape;
    double own[3], n[3], ring;
    surface_random_unit(n);
    switch (shape->kind) {
    case ANALYTIC_PLANE:
        for (int axis = 0; axis < 3; ++axis) own[axis] = axis == 1 ? 0 : 3 * n[axis];
        break;
    case ANALYTIC_BOX: {
        const int face = (int)(check_random() % 3);
        for (int axis = 0; axis < 3; ++axis) own[axis] = (shape->half[axis] - margin) * n[axis];
        own[face] = copysign(shape->half[face], n[face]);
        break;
    }
    case ANALYTIC_TORUS:
        ring = hypot(n[0], n[2]);
        for (int axis = 0; axis < 3; ++axis) own[axis] = axis == 1 ? 0 : shape->extent * n[axis];
        own[0] /= ring;
        own[2] /= ring;
        surface_random_unit(n);
        for (int axis = 0; axis < 3; ++axis) own[axis] += shape->radius * n[axis];
        {
            /* From anywhere on the ring's ball to the surface, along the gradient. */
            double g[3];
            surface_body upright = surface_place_at(*shape, 0, 0, 0);
            const double distance = surface_distance(&upright, own);
            surface_gradient(&upright, own, g);
            for (int axis = 0; axis < 3; ++axis) own[axis] -= distance * g[axis];
        }
        break;
    default: /* sphere and capsule */
        for (int axis = 0; axis < 3; ++axis) own[axis] = shape->radius * n[axis];
        if (shape->kind != ANALYTIC_CAPSULE) break;
        if (fabs(own[1]) < margin) { /* on the side */
            ring = hypot(own[0], own[2]) / shape->radius;
            own[0] /= ring;
            own[2] /= ring;
            own[1] = check_uniform(-1, 1) * (shape->extent - margin);
        } else {
            own[1] += copysign(shape->extent, own[1]);
        }
        break;
    }
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = body->center[axis];
        for (int i = 0; i < 3; ++i) p[axis] += own[i] * body->axis[i][axis];
    }
}

void sampled_draw(const surface_body *body, double margin, size_t count, surface_sampled *at) {
    at->count = count;
    for (size_t i = 0; i < count; ++i) {
        double p[3];
        sampled_point(body, margin, p);
        for (int axis = 0; axis < 3; ++axis) at->point[i][axis] = (float)p[axis];
    }
}
