/* SPDX-License-Identifier: MIT
 *
 * The t of hits against closed forms, by distance: sphere tracing by the tolerance, by the rounding
 * floor alone, and tracing by probes. Left out: rays that graze, where either answer is right. */
#include "accuracy.h"

#include "../../oracle/harness.h"
#include "../../oracle/surface_oracle.h"

#include <spheretrace/mobius.h>

#include <math.h>

static const double distances[] = {1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
enum { distance_count = sizeof distances / sizeof distances[0] };

/* Convex bodies: along a ray to one the distance falls until the ray is inside, so that no answer
 * before the hit is right. */
static const analytic_kind kinds[] = {ANALYTIC_SPHERE, ANALYTIC_BOX, ANALYTIC_CAPSULE,
                                      ANALYTIC_CYLINDER};

typedef struct shot {
    surface_body body;
    spt_ray ray;
    double cosine, t; /* of the first crossing */
    int clear;        /* it gets so deep inside that no rounding makes it a miss */
} shot;

/* A body a tenth as large as it is far away, and a ray at it from near the origin. */
static void draw(report_random *random, double distance, int number, shot *one) {
    double origin[3], toward[3], target[3];
    accuracy_unit(random, toward);
    one->body = surface_place_at(analytic_sample(kinds[number % 4], distance / 10),
                                 distance * toward[0], distance * toward[1], distance * toward[2]);
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = distance * report_uniform(random, -0.1, 0.1);
        target[axis] = one->body.center[axis] + distance * report_uniform(random, -0.05, 0.05);
    }
    one->ray = surface_aim(origin, target, accuracy_spread(random, 0.01, 100), HUGE_VAL);
}

static void find(const spt_settings *settings, shot *one) {
    reference_ray ray = reference_ray_of(&one->ray);
    double most;
    analytic_hit hit;
    for (int axis = 0; axis < 3; ++axis) ray.origin[axis] -= one->body.center[axis];
    ray.t_max = 4 * surface_length(one->body.center) / oracle_length(&one->ray);
    hit = analytic_trace(&one->body.shape, &ray, 0);
    one->t = hit.t;
    one->cosine = hit.cosine;
    one->clear = 0;
    if (!(hit.t < ray.t_max) || !(hit.t > 0)) return;
    most = oracle_tolerance(settings, &one->ray, hit.t) + oracle_floor(settings, &one->ray, hit.t);
    hit = analytic_trace(&one->body.shape, &ray, 4 * most);
    one->clear = hit.deep < ray.t_max;
}

/* What every hit keeps to: |f| < tolerance at a position that float32 rounds by less than the
 * floor, and before the crossing of a convex body f is at least the cosine times the way to it. */
static void sweep(const report_options *options, FILE *rows, const accuracy_subject *subject,
                  const spt_settings *settings) {
    for (int i = 0; i < distance_count; ++i) {
        report_random random = {(uint64_t)i};
        accuracy_errors errors = {NULL, 0, 0};
        double promised = 0;
        const size_t samples = accuracy_samples(options, 4000);
        for (int number = 0; errors.count < samples; ++number) {
            shot one;
            spt_hit hit;
            draw(&random, distances[i], number, &one);
            find(settings, &one);
            if (!one.clear) continue;
            const reference_field reference = surface_body_field(&one.body);
            const spt_field field = oracle_field(&reference, 0);
            hit = oracle_trace_one(&field, settings, &one.ray);
            const double off = fabs((double)hit.t - one.t) * oracle_length(&one.ray) * one.cosine;
            accuracy_add(&errors, hit.outcome == SPT_HIT ? off : HUGE_VAL);
            promised = fmax(promised, oracle_tolerance(settings, &one.ray, one.t) +
                                          oracle_floor(settings, &one.ray, one.t));
        }
        accuracy_write(rows, subject, distances[i], promised, &errors);
    }
}

void accuracy_hits(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "hit", "distance", "world length along the normal",
        "trace.h: reached where |f| / lipschitz < tolerance(t); positions resolve floor(t)"};
    spt_settings settings = spt_settings_default();
    settings.budget = 100000;
    sweep(options, rows, &subject, &settings);
}

void accuracy_hits_floor(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "hit_floor", "distance", "world length along the normal",
        "trace.h: reached where |f| / lipschitz < tolerance(t); positions resolve floor(t)"};
    spt_settings settings = spt_settings_default();
    settings.budget = 100000;
    settings.epsilon = 1e-20f;
    sweep(options, rows, &subject, &settings);
}

/* How short of the surface, in the most that the header allows at this cosine. Its tolerance is
 * that at t; what float32 positions resolve comes on top. */
void accuracy_binary(const report_options *options, FILE *rows) {
    const accuracy_subject subject = {
        "binary", "distance", "of the most that is allowed",
        "mobius.h: short by at most (probe_ratio tolerance / penalty) (1 + c) / c"};
    const spt_binary binary = spt_binary_default();
    spt_settings settings = spt_settings_default();
    settings.budget = 100000;
    for (int i = 0; i < distance_count; ++i) {
        report_random random = {(uint64_t)i};
        accuracy_errors errors = {NULL, 0, 0};
        const size_t samples = accuracy_samples(options, 2000);
        for (int number = 0; errors.count < samples; ++number) {
            shot one;
            spt_hit hit;
            draw(&random, distances[i], number, &one);
            find(&settings, &one);
            if (!one.clear) continue;
            const reference_field reference = surface_body_field(&one.body);
            const spt_field field = oracle_field(&reference, 0);
            const spt_probe probe = spt_probe_of_field(&field);
            const spt_rays rays = spt_rays_of(&one.ray);
            const spt_hits hits = spt_hits_of(&hit);
            report_expect(spt_binary_trace(&probe, &binary, &settings, 1, &rays, &hits, NULL) ==
                              SPT_OK,
                          "binary tracing refuses its arguments");
            const double c = one.cosine, length = oracle_length(&one.ray);
            const double allowed = (double)binary.probe_ratio / (double)binary.penalty *
                                       oracle_tolerance(&settings, &one.ray, one.t) * (1 + c) / c +
                                   oracle_floor(&settings, &one.ray, one.t) / c;
            const double off = fabs((double)hit.t - one.t) * length / allowed;
            accuracy_add(&errors, hit.outcome == SPT_HIT ? off : HUGE_VAL);
        }
        accuracy_write(rows, &subject, distances[i], 1, &errors);
    }
}
