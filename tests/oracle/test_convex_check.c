/* SPDX-License-Identifier: MIT
 *
 * Broken promises of spt_trace_convex(): rows F3 and F4b of the catalogue, two slabs (row K13 of
 * the errata), rays in a torus. With SPT_CHECK_CONVEX they are reported and traced forward; without
 * it they give a valid outcome. */
#include "analytic.h"
#include "check.h"
#include "rules.h"

#include <spheretrace/surface.h>

#include <math.h>

static const analytic_shape ring = {ANALYTIC_TORUS, 0.3, 1, {0, 0, 0}};
static const analytic_shape ball = {ANALYTIC_SPHERE, 1, 0, {0, 0, 0}};

typedef double distance_fn(const double p[3]);

static double ring_distance(const double p[3]) {
    return analytic_distance(&ring, p);
}

static double ball_distance(const double p[3]) {
    return analytic_distance(&ball, p);
}

/* Layers 0 < z < 1 and 3 < z < 3.5. */
static double layers_distance(const double p[3]) {
    return fmin(fabs(p[2] - 0.5) - 0.5, fabs(p[2] - 3.25) - 0.25);
}

typedef struct body {
    distance_fn *distance;
    unsigned calls;
} body;

static void distances(void *user, size_t n, const float *x, const float *y, const float *z,
                      float *distance) {
    body *self = user;
    ++self->calls;
    for (size_t i = 0; i < n; ++i) {
        const double p[3] = {(double)x[i], (double)y[i], (double)z[i]};
        distance[i] = (float)self->distance(p);
    }
}

static spt_field field_of(body *self, const spt_bound *bound, uint32_t flags) {
    spt_field field = spt_field_default();
    field.batch = distances;
    field.user = self;
    field.bound = bound;
    field.flags = flags;
    return field;
}

static spt_hit trace(const spt_field *field, const spt_settings *settings, const spt_ray *ray) {
    spt_hit hit;
    const spt_rays from = spt_rays_of(ray);
    const spt_hits to = spt_hits_of(&hit);
    body *self = field->user;
    self->calls = 0;
    CHECK(spt_trace_convex(field, settings, 1, &from, &to, NULL) == SPT_OK);
    CHECK_SAY(self->calls == hit.evaluations && hit.evaluations <= settings->budget,
              "%u calls, %u evaluations", self->calls, hit.evaluations);
    return hit;
}

/* Every rule at every width, declared convex or not, with or without the check. */
typedef struct way {
    int number;
    uint32_t field_flags;
    spt_settings settings;
    int checked;
} way;

static int next_way(way *at) {
    const rule *one;
    const int number = at->number++;
    if (number >= rule_count * width_count * 4) return 0;
    one = &rules[number / 4 % rule_count];
    at->field_flags = number % 2 != 0 ? SPT_FIELD_CONVEX : 0;
    at->checked = number / 2 % 2;
    at->settings = spt_settings_default();
    at->settings.method = rule_allowed(one, at->field_flags) ? one->method() : spt_basic();
    at->settings.max_lanes = widths[number / 4 / rule_count];
    at->settings.flags = at->checked ? SPT_CHECK_CONVEX : 0;
    check_context("%s, %u lanes, declared %u, checked %d", one->name, at->settings.max_lanes,
                  (unsigned)at->field_flags, at->checked);
    return 1;
}

/* A valid outcome of row F3 and F4: section 2 of the catalogue, in the interval of the bound. */
static void expect_valid(const spt_hit *hit, double low, double high) {
    CHECK_SAY(hit->outcome == SPT_HIT || hit->outcome == SPT_MISS || hit->outcome == SPT_LIMIT,
              "outcome %d", hit->outcome);
    CHECK_SAY(hit->outcome == SPT_MISS
                  ? hit->t >= INFINITY && hit->residual >= INFINITY
                  : (double)hit->t >= low - 1e-5 && (double)hit->t <= high + 1e-5,
              "outcome %d at %g, residual %g", hit->outcome, (double)hit->t, (double)hit->residual);
    CHECK((hit->flags & SPT_FLAG_INSIDE) != 0 && hit->residual == hit->residual);
}

/* The first exit where the check is on; the last where it is off, as surface.h says. */
static void expect_exits(distance_fn *distance, const spt_bound *bound, const spt_ray *ray,
                         double first, double last) {
    for (way at = {0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0}; next_way(&at);) {
        body self = {distance, 0};
        const spt_field field = field_of(&self, bound, at.field_flags);
        const double wanted = at.checked ? first : last;
        const spt_hit hit = trace(&field, &at.settings, ray);
        expect_valid(&hit, 0, last + 2);
        CHECK_SAY(hit.outcome == SPT_HIT && fabs((double)hit.t - wanted) <= 1.1e-4,
                  "outcome %d at %.7g, not %g", hit.outcome, (double)hit.t, wanted);
        CHECK_SAY(hit.flags ==
                      (SPT_FLAG_INSIDE | (at.checked ? (uint32_t)SPT_FLAG_NOT_CONVEX : 0u)),
                  "flags %x", hit.flags);
    }
}

static void F3_torus_declared_convex(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    const spt_ray ray = {{1, 0, 0}, 0, {-1, 0, 0}, INFINITY};
    expect_exits(ring_distance, &bound, &ray, 0.3, 2.3);
}

static void K13_two_slabs(void) {
    const spt_bound bound = spt_bound_box(-2, -2, -1, 2, 2, 5);
    const spt_ray ray = {{0, 0, 0.5f}, 0, {0, 0, 1}, INFINITY};
    expect_exits(layers_distance, &bound, &ray, 0.5, 3.0);
}

/* The bound cuts the ball: from within it the whole bound is inside, and the checked ray finds no
 * way out; from outside, the ray begins inside where it enters the bound. */
static void F4b_bound_cuts_the_body(void) {
    const spt_bound bounds[] = {spt_bound_sphere(0, 0, 0, 0.8f),
                                spt_bound_box(-0.8f, -0.8f, -0.8f, 0.8f, 0.8f, 0.8f)};
    const spt_ray rays[] = {{{0, 0, -1.5f}, 0, {0, 0, 1}, INFINITY},
                            {{0, 0, 0}, 0, {0, 0, 1}, INFINITY}};
    for (way at = {0, 0, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0}; next_way(&at);) {
        for (int i = 0; i < 4; ++i) {
            body self = {ball_distance, 0};
            const spt_field field = field_of(&self, &bounds[i / 2], at.field_flags);
            const double entry = i % 2 == 0 ? 0.7 : 0, exit = i % 2 == 0 ? 2.3 : 0.8;
            const spt_hit hit = trace(&field, &at.settings, &rays[i % 2]);
            expect_valid(&hit, entry, exit);
            CHECK_SAY(!at.checked || (hit.flags & SPT_FLAG_NOT_CONVEX) != 0, "flags %x", hit.flags);
            CHECK_SAY(!at.checked || hit.outcome == SPT_MISS, "outcome %d", hit.outcome);
        }
    }
}

/* Rays that begin in the ring; many meet it again. What is betrayed has the first exit; a ray that
 * was not betrayed ends at some exit; and of those with a later one most are betrayed. */
static void F3_rays_in_a_torus(void) {
    const spt_bound bound = spt_bound_sphere(0, 0, 0, 1.5f);
    int betrayed = 0, wrong = 0, rays = 0;
    body self = {ring_distance, 0};
    const spt_field field = field_of(&self, &bound, 0);
    spt_settings settings = spt_settings_default();
    settings.flags = SPT_CHECK_CONVEX;
    settings.budget = 10000;
    while (rays < 1000) {
        spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, 10};
        reference_ray exact;
        analytic_hit truth;
        spt_hit hit;
        double p[3], square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = (float)check_uniform(-1.3, 1.3);
            ray.direction[axis] = (float)(check_uniform(-1, 1) * (axis == 1 ? 0.1 : 1));
            p[axis] = (double)ray.origin[axis];
            square += (double)ray.direction[axis] * (double)ray.direction[axis];
        }
        if (ring_distance(p) > -0.01 || square < 0.1) continue;
        ++rays;
        exact = reference_ray_of(&ray);
        truth = analytic_trace(&ring, &exact, 2e-4);
        hit = trace(&field, &settings, &ray);
        expect_valid(&hit, 0, 10);
        CHECK_SAY((hit.flags & ~(uint32_t)(SPT_FLAG_INSIDE | SPT_FLAG_NOT_CONVEX)) == 0, "flags %x",
                  hit.flags);
        for (int axis = 0; axis < 3; ++axis) p[axis] += (double)hit.t * (double)ray.direction[axis];
        CHECK_SAY(hit.outcome == SPT_HIT && fabs(ring_distance(p)) < 1.1e-4, "outcome %d, f %g",
                  hit.outcome, ring_distance(p));
        if (hit.flags & SPT_FLAG_NOT_CONVEX) {
            /* Within a tolerance before the crossing, by the cosine. */
            const double early = 1.1e-4 / (fabs(truth.cosine) * sqrt(square));
            ++betrayed;
            CHECK_SAY((double)hit.t > truth.t - early && (double)hit.t < truth.deep,
                      "at %.7g, not %.7g, cosine %g", (double)hit.t, truth.t, truth.cosine);
        } else if ((double)hit.t > truth.deep + 0.01) {
            ++wrong;
        }
    }
    CHECK_SAY(betrayed > 3 * wrong && betrayed > 100, "%d betrayed, %d with a later exit", betrayed,
              wrong);
}

void suite_convex_check(void) {
    RUN(F3_torus_declared_convex);
    RUN(K13_two_slabs);
    RUN(F4b_bound_cuts_the_body);
    RUN(F3_rays_in_a_torus);
}
