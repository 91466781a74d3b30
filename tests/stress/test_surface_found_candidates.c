/* SPDX-License-Identifier: MIT
 *
 * Faults once found in SPT_CANDIDATE_PENUMBRA and SPT_CANDIDATE_CLOSEST, each as the smallest case
 * that shows it, against exact distances and angles, at every width. */
#include "surface_found.h"

#include <math.h>
#include <string.h>

/* ---- How near rays pass ---------------------------------------------------------------------- */

static spt_hit traced(const spt_field *field, const spt_settings *settings, const spt_ray *ray,
                      int with_sinks) {
    subject *const self = field->user;
    const spt_rays from = spt_rays_of(ray);
    spt_hit hit;
    spt_hits to = spt_hits_of(&hit);
    memset(&hit, 0, sizeof hit);
    if (!with_sinks) to.candidate_t.first = to.candidate_ratio.first = NULL;
    self->calls = 0;
    CHECK(spt_trace(field, settings, 1, &from, &to, NULL) == SPT_OK);
    CHECK_SAY(self->calls == hit.evaluations, "%u calls, %u evaluations", (unsigned)self->calls,
              (unsigned)hit.evaluations);
    return hit;
}

static void found_closest_by_few_samples(void) {
    static const spt_ray ray = {{-3, 1.5f, 0}, 0, {1, 0, 0}, 1000};
    const spt_field field = field_of(&ball, SPT_FIELD_CONVEX, NULL);
    for (FOR_EACH_WIDTH) {
        for (int i = 0; i < 2; ++i) {
            spt_settings settings = settings_of(width, SPT_CANDIDATE_CLOSEST);
            settings.method = i ? spt_basic() : spt_convex();
            const spt_hit hit = traced(&field, &settings, &ray, 1);
            CHECK(hit.outcome == SPT_MISS && hit.t >= INFINITY);
            CHECK_SAY(hit.candidate_ratio >= 0.45f && (double)hit.candidate_ratio <= 0.5 + 1e-6,
                      "%s: %.9g", spt_method_name(settings.method), (double)hit.candidate_ratio);
        }
    }
}

/* A ray that passes the unit ball, and by which angle as seen from its origin. */
static spt_ray ray_past_ball(double *angle) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 1000};
    do {
        const double away = check_uniform(1.5, 5);
        double from[3], aside[3], square = 0;
        random_unit(from);
        random_unit(aside);
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = (float)(away * from[axis]);
            aside[axis] = 2.5 * aside[axis] - (double)ray.origin[axis];
            square += aside[axis] * aside[axis];
        }
        for (int axis = 0; axis < 3; ++axis) {
            ray.direction[axis] = (float)(aside[axis] / sqrt(square));
        }
        const double distance = sqrt(product(ray.origin, ray.origin));
        *angle = acos(-product(ray.origin, ray.direction) / distance) - asin(1 / distance);
    } while (!(*angle > 0.01 && *angle < 1.1));
    return ray;
}

static void found_penumbras_of_rising_rays(void) {
    const spt_field field = field_of(&ball, SPT_FIELD_CONVEX, NULL);
    for (int i = 0; i < 300; ++i) {
        double angle;
        const spt_ray ray = ray_past_ball(&angle);
        for (FOR_EACH_WIDTH) {
            spt_settings settings = settings_of(width, SPT_CANDIDATE_PENUMBRA);
            settings.method = spt_convex();
            const spt_hit hit = traced(&field, &settings, &ray, 1);
            const double found = (double)hit.candidate_ratio;
            CHECK(hit.outcome == SPT_MISS && hit.t >= INFINITY);
            CHECK_SAY(found <= 1.0001 * tan(angle) && found >= 0.75 * sin(angle),
                      "ray %d: tangent %.9g, angle %.9g", i, found, angle);
        }
    }
}

/* ---- What must not change -------------------------------------------------------------------- */

/* Candidates make no difference to how a ray ends, and cost one sample at its end. spt_convex()
 * takes the steps of spt_basic() for them, and may know a miss earlier where f rises. */
static void expect_same_end(const spt_field *field, const spt_settings *settings,
                            const spt_ray *ray) {
    static const uint32_t kinds[] = {0, SPT_CANDIDATE_PENUMBRA, SPT_CANDIDATE_CLOSEST};
    for (int i = 0; i < 6; ++i) {
        spt_settings other = *settings, same = *settings;
        other.flags = kinds[i / 2];
        const int wanted = i % 2, plain_steps = other.method == spt_convex() && wanted && i >= 2;
        if (plain_steps) same.method = spt_basic();
        const spt_hit plain = traced(field, &same, ray, 0);
        const spt_hit hit = traced(field, &other, ray, wanted);
        const int risen = plain_steps && other.flags == SPT_CANDIDATE_CLOSEST &&
                          hit.outcome == SPT_MISS && plain.outcome != SPT_HIT;
        CHECK_SAY(risen || (hit.outcome == plain.outcome && check_same_bits(hit.t, plain.t) &&
                            check_same_bits(hit.residual, plain.residual)),
                  "%s, flags %x, sinks %d, budget %u: %d at %.9g, without %d at %.9g",
                  spt_method_name(other.method), (unsigned)other.flags, wanted,
                  (unsigned)other.budget, hit.outcome, (double)hit.t, plain.outcome,
                  (double)plain.t);
        CHECK_SAY(hit.evaluations <= plain.evaluations + 1 && hit.evaluations <= other.budget,
                  "%s, flags %x: %u, without %u", spt_method_name(other.method),
                  (unsigned)other.flags, (unsigned)hit.evaluations, (unsigned)plain.evaluations);
    }
}

static void found_candidates_that_change_outcomes(void) {
    static const spt_ray just_short = {{-3, 0, 0}, 0, {1, 0, 0}, 1.99995f};
    const spt_field field = field_of(&ball, SPT_FIELD_CONVEX, NULL);
    for (int number = 0; number < 60; ++number) {
        double angle;
        spt_ray ray = number == 0 ? just_short : ray_past_ball(&angle);
        const uint32_t budget = number % 3 == 0 ? 128 : check_random() % 12;
        if (number % 2 == 1) {
            for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = -0.6f * ray.origin[axis];
        }
        if (number > 0) ray.t_max = (float)check_uniform(0.5, 8);
        for (FOR_EACH_WIDTH) {
            for (int i = 0; i < rule_count; ++i) {
                spt_settings settings = settings_of(width, 0);
                settings.method = rules[i].method();
                settings.budget = budget;
                expect_same_end(&field, &settings, &ray);
            }
        }
    }
}

/* f is the same everywhere: no sample is less than the first, which is where the ray begins. */
static void found_candidates_before_the_ray(void) {
    static const float everywhere = 1e-3f;
    static const spt_ray ray = {{0, 0, 0}, 0, {1, 0, 0}, 1};
    subject constant = {stress_constant_distance, &everywhere, 0};
    const spt_field field = field_of(&constant, 0, NULL);
    for (FOR_EACH_WIDTH) {
        spt_settings settings = settings_of(width, SPT_CANDIDATE_CLOSEST);
        settings.method = spt_basic();
        settings.epsilon = 0.0071f;
        const spt_hit hit = traced(&field, &settings, &ray, 1);
        CHECK(hit.outcome == SPT_HIT && check_same_bits(hit.t, 0));
        CHECK_SAY(check_same_bits(hit.candidate_t, 0), "%.9g", (double)hit.candidate_t);
        CHECK(stress_within((double)hit.candidate_ratio, 1e-3, 1e-9));
    }
}

void suite_surface_found_candidates(void) {
    RUN(found_closest_by_few_samples);
    RUN(found_penumbras_of_rising_rays);
    RUN(found_candidates_that_change_outcomes);
    RUN(found_candidates_before_the_ray);
}
