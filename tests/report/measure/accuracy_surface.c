/* SPDX-License-Identifier: MIT
 *
 * Where secondary rays begin, against the tolerance that they are off the surface by; and jumps
 * between neighbouring pixels before and after refinement. */
#include "accuracy.h"

#include "../../oracle/harness.h"
#include "../../oracle/surface_oracle.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <stdlib.h>

/* ---- Origins of secondary rays --------------------------------------------------------------- */

/* How far the new origin is off the surface, on the side that was asked for, in tolerances of the
 * ray that begins there. Returns 0 where the ray does not hit. */
static int clearance(report_random *random, double distance, int cross, double *tolerances) {
    const spt_settings settings = spt_settings_default();
    double origin[3], toward[3], target[3], at[3];
    float normal[3], start_at[3], path = 0;
    int32_t start = -1, crossing = cross;
    spt_ray ray, next;
    spt_hit hit;
    accuracy_unit(random, toward);
    const surface_body body = surface_sphere(distance * toward[0], distance * toward[1],
                                             distance * toward[2], distance / 10);
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = distance * report_uniform(random, -0.1, 0.1);
        target[axis] = body.center[axis] + distance * report_uniform(random, -0.05, 0.05);
    }
    ray = surface_aim(origin, target, accuracy_spread(random, 0.01, 100), HUGE_VAL);
    const reference_field reference = surface_body_field(&body);
    spt_field field = oracle_field(&reference, 0);
    const spt_bound bound =
        spt_bound_sphere((float)body.center[0], (float)body.center[1], (float)body.center[2],
                         (float)(1.001 * body.shape.radius));
    field.bound = &bound;
    hit = oracle_trace_one(&field, &settings, &ray);
    if (hit.outcome != SPT_HIT) return 0;
    const spt_rays rays = spt_rays_of(&ray);
    const spt_hits hits = spt_hits_of(&hit);
    const spt_vector_sinks normals = spt_vector_sinks_of(normal);
    const spt_vectors normals_again = spt_vectors_of(normal);
    const spt_column side = {&crossing, sizeof crossing};
    spt_starts starts;
    starts.origin = spt_vector_sinks_of(start_at);
    starts.path.first = &path;
    starts.path.stride = sizeof path;
    starts.start.first = &start;
    starts.start.stride = sizeof start;
    report_expect(spt_normals(&field, 1, &settings, SPT_NORMAL_CENTRAL, 0, 1, &rays, &hits,
                              &normals) == SPT_OK &&
                      spt_offset(&field, 1, &settings, 1, &rays, &hits, &normals_again, &side, 4,
                                 &starts) == SPT_OK,
                  "offsets refuse their arguments");
    next = ray;
    for (int axis = 0; axis < 3; ++axis) {
        at[axis] = (double)start_at[axis];
        next.origin[axis] = start_at[axis];
    }
    spt_settings there = settings;
    there.size = (float)(1.1 * distance); /* that of the bound, which counts by itself */
    *tolerances =
        (cross ? -1 : 1) * surface_distance(&body, at) / oracle_tolerance(&there, &next, 0);
    if (start != SPT_START_CLEAR) *tolerances = HUGE_VAL;
    return 1;
}

void accuracy_offsets(const report_options *options, FILE *rows) {
    for (int cross = 0; cross < 2; ++cross) {
        const accuracy_subject subject = {
            cross ? "offset_cross" : "offset_stay", "distance",
            "tolerances from where it should be",
            "surface.h: moved to twice the tolerance; SPT_START_CLEAR: beyond the tolerance"};
        for (int power = 0; power <= 7; ++power) {
            report_random random = {(uint64_t)power};
            accuracy_errors errors = {NULL, 0, 0};
            const size_t samples = accuracy_samples(options, 4000);
            while (errors.count < samples) {
                double tolerances;
                if (!clearance(&random, pow(10, power), cross, &tolerances)) continue;
                accuracy_add(&errors, fabs(tolerances - 2));
            }
            accuracy_write(rows, &subject, pow(10, power), 1, &errors);
        }
    }
}

/* ---- Refinement ------------------------------------------------------------------------------ */

typedef struct picture {
    int width, height;
    spt_ray *rays;
    spt_hit *hits;
    double *height_over; /* distance from the surface over half a pixel there */
} picture;

static void shoot(picture *view, float *pixel_radius) {
    const double half = tan(0.35), eye[3] = {0, 0, 0};
    *pixel_radius = (float)(half / view->width);
    for (int i = 0; i < view->width * view->height; ++i) {
        const double target[3] = {half * (2 * (i % view->width + 0.5) / view->width - 1),
                                  half * (2 * (i / view->width + 0.5) - view->height) / view->width,
                                  1};
        view->rays[i] = surface_aim(eye, target, 1, 50);
    }
}

/* What the heights of neighbours differ by: the steps that show as rings. */
static void jumps(const picture *view, accuracy_errors *errors) {
    const int count = view->width * view->height;
    for (int i = 0; i < count; ++i) {
        const int beside[2] = {i % view->width + 1 < view->width ? i + 1 : i,
                               i + view->width < count ? i + view->width : i};
        for (int side = 0; side < 2; ++side) {
            const int other = beside[side];
            if (other == i || view->hits[i].outcome != SPT_HIT) continue;
            if (view->hits[other].outcome != SPT_HIT) continue;
            accuracy_add(errors, fabs(view->height_over[i] - view->height_over[other]));
        }
    }
}

void accuracy_refining(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {"refining", "rounds", "half pixels between neighbours", ""};
    static const uint32_t rounds[] = {0, 1, 2, 3, 4, 6, 8, 12, 16};
    const surface_body ball = surface_sphere(0.1, 0.05, 4, 1.3);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    spt_settings settings = spt_settings_default();
    picture view = {0, 0, NULL, NULL, NULL};
    view.width = options->quick ? 64 : 192;
    view.height = view.width * 3 / 4;
    const size_t count = (size_t)(view.width * view.height);
    view.rays = report_allocate(count * sizeof *view.rays);
    view.hits = report_allocate(count * sizeof *view.hits);
    view.height_over = report_allocate(count * sizeof *view.height_over);
    shoot(&view, &settings.pixel_radius);
    for (size_t i = 0; i < sizeof rounds / sizeof rounds[0]; ++i) {
        const spt_rays rays = spt_rays_of(view.rays);
        const spt_hits hits = spt_hits_of(view.hits);
        accuracy_errors errors = {NULL, 0, 0};
        oracle_trace(&field, &settings, count, view.rays, view.hits);
        report_expect(spt_refine(&field, 1, &settings, rounds[i], count, &rays, &hits) == SPT_OK,
                      "refinement refuses its arguments");
        for (size_t k = 0; k < count; ++k) {
            const double t = (double)view.hits[k].t;
            double p[3];
            if (view.hits[k].outcome != SPT_HIT) continue;
            surface_point(&view.rays[k], t, p);
            view.height_over[k] = surface_distance(&ball, p) / ((double)settings.pixel_radius * t *
                                                                oracle_length(&view.rays[k]));
        }
        jumps(&view, &errors);
        accuracy_write(rows, &subject, rounds[i], 0, &errors);
    }
    free(view.rays);
    free(view.hits);
    free(view.height_over);
}
