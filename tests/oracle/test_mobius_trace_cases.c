/* SPDX-License-Identifier: MIT
 *
 * spt_conformal_trace() in stiff cases and under its contract: rays through the pole and from it
 * (row M4), ways without end, starts inside, budgets, bad rays, absent sinks, inactive rays, broken
 * calls. Ordinary rays are in test_mobius_trace.c. */
#include "../check.h"
#include "mobius_world.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const uint32_t lanes[] = {1, 4, 8, 16};

/* The inversion in the unit sphere of the ball of radius 1/2 around (2, 0, 0): a ball from 0.4 to
 * 2/3 on the x axis, the pole at the origin. */
static void build_world(mapped_world *world) {
    const chain steps = {1, {{CHAIN_INVERSION, {0, 0, 0}, 1}}};
    const solid ball = {SPT_REGION_BALL, {2, 0, 0}, 0.5L};
    world->steps = steps;
    world->extent = 1;
    world->count = 1;
    world->kernel[0] = ball;
    mapped_build(world);
}

static spt_ray ray_of(float x, float y, float z, float along_x, float along_y, float along_z) {
    spt_ray ray = {{0, 0, 0}, 0, {0, 0, 0}, INFINITY};
    ray.origin[0] = x;
    ray.origin[1] = y;
    ray.origin[2] = z;
    ray.direction[0] = along_x;
    ray.direction[1] = along_y;
    ray.direction[2] = along_z;
    return ray;
}

static int same_hit(const spt_hit *a, const spt_hit *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

/* One ray at every width, alone and among copies: the same bits. */
static spt_hit trace_one(const mapped_world *world, const spt_settings *settings,
                         const spt_ray *ray) {
    spt_hit hits[18], first;
    spt_ray rays[18];
    memset(hits, 0, sizeof hits);
    memset(&first, 0, sizeof first);
    for (int i = 0; i < 18; ++i) rays[i] = *ray;
    for (int k = 0; k < 4; ++k) {
        const spt_rays from = spt_rays_of(rays);
        const spt_hits to = spt_hits_of(hits);
        spt_settings own = *settings;
        own.max_lanes = lanes[k];
        CHECK(spt_conformal_trace(&world->memory, &own, k == 0 ? 1 : 18, &from, &to, NULL) ==
              SPT_OK);
        if (k == 0) first = hits[0];
        for (int i = 0; i < (k == 0 ? 1 : 18); ++i)
            CHECK_SAY(same_hit(&hits[i], &first), "%u lanes, copy %d", lanes[k], i);
    }
    return first;
}

static void expect(const spt_hit *hit, spt_outcome outcome, double t, double tolerance) {
    CHECK_SAY(hit->outcome == (int32_t)outcome, "outcome %d, not %d, at %g", (int)hit->outcome,
              (int)outcome, (double)hit->t);
    if (outcome == SPT_MISS || outcome == SPT_BAD_RAY) {
        CHECK(hit->t > FLT_MAX && hit->residual > FLT_MAX);
    } else {
        CHECK_SAY(fabs((double)hit->t - t) <= tolerance, "t %.9g, not %.9g", (double)hit->t, t);
    }
}

/* The same by the field, with the default rule. */
static spt_hit trace_centred(const mapped_world *world, const spt_settings *settings,
                             const spt_ray *ray) {
    const spt_rays from = spt_rays_of(ray);
    spt_hit hit;
    const spt_hits to = spt_hits_of(&hit);
    memset(&hit, 0, sizeof hit);
    CHECK(spt_trace(&world->field, settings, 1, &from, &to, NULL) == SPT_OK);
    return hit;
}

/* ---- M4: the pole ---------------------------------------------------------------------------- */

/* No number that is none comes out, and t stays in the interval. */
static void sane(const spt_hit *hit, const spt_ray *ray, const spt_settings *settings) {
    CHECK_SAY(hit->outcome == SPT_HIT || hit->outcome == SPT_MISS || hit->outcome == SPT_LIMIT,
              "outcome %d", (int)hit->outcome);
    CHECK(!isnan(hit->t) && !isnan(hit->residual));
    CHECK_SAY(hit->evaluations <= settings->budget, "%u evaluations", hit->evaluations);
    if (hit->outcome == SPT_MISS)
        CHECK(hit->t > FLT_MAX);
    else
        CHECK_SAY(hit->t >= ray->t_min && hit->t <= ray->t_max, "t %g", (double)hit->t);
}

/* The pole lies before the body and beyond it; exactly on the way, and beside it by less and more
 * than the tolerance. A hit is the body or the pole, never behind the body. */
static void M4_through_the_pole(void) {
    mapped_world world;
    spt_settings settings = spt_settings_default();
    build_world(&world);
    settings.budget = 300;
    for (int n = 0; n < 400; ++n) {
        const double beside = n % 4 == 0 ? 0 : pow(10, check_uniform(-9, -1));
        const float way = n % 8 < 4 ? 1.0f : -1.0f;
        const spt_ray ray = ray_of(-3 * way, (float)beside, 0, way * (float)(n % 3 + 1), 0, 0);
        const spt_hit hit = trace_one(&world, &settings, &ray);
        const spt_hit centred = trace_centred(&world, &settings, &ray);
        const double reached = (double)(hit.t * (float)(n % 3 + 1));
        check_context("ray %d, %g beside", n, beside);
        sane(&hit, &ray, &settings);
        sane(&centred, &ray, &settings);
        /* From -3 the body begins at 3.4, from 3 at 2.333; a little later beside the axis. */
        if (hit.outcome == SPT_HIT && beside < 0.01)
            CHECK_SAY(reached <= (way > 0 ? 3.4 : 7.0 / 3) + 1e-3, "behind, at %g", reached);
        if (way < 0 && beside < 0.01) CHECK(hit.outcome == SPT_HIT);
    }
}

static void M4_from_the_pole(void) {
    mapped_world world;
    spt_settings settings = spt_settings_default();
    build_world(&world);
    for (int n = 0; n < 200; ++n) {
        spt_ray ray = ray_of(0, 0, 0, (float)check_uniform(-1, 1), (float)check_uniform(-1, 1),
                             (float)check_uniform(-1, 1));
        spt_hit hit;
        if (n % 2 == 1)
            for (int i = 0; i < 3; ++i) ray.origin[i] = (float)(1e-6 * check_uniform(-1, 1));
        check_context("ray %d", n);
        hit = trace_one(&world, &settings, &ray);
        sane(&hit, &ray, &settings);
        hit = trace_centred(&world, &settings, &ray);
        sane(&hit, &ray, &settings);
        CHECK(!isnan(mapped_value(&world, ray.origin)));
    }
}

/* ---- Ways without end ------------------------------------------------------------------------ */

/* From (3, 0, 0) on outward: the first ball holds infinity, and the way. */
static void infinite_exits_are_misses(void) {
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    build_world(&world);
    for (int n = 0; n < 100; ++n) {
        spt_ray ray = ray_of(3, 0, 0, 1, (float)check_uniform(-1, 1), (float)check_uniform(-1, 1));
        spt_hit hit;
        if (n % 2 == 0) ray.t_max = (float)pow(10, check_uniform(0, 30));
        hit = trace_one(&world, &settings, &ray);
        check_context("ray %d", n);
        expect(&hit, SPT_MISS, 0, 0);
        CHECK_SAY(hit.evaluations == 1, "%u evaluations", hit.evaluations);
    }
}

/* ---- Starts, budgets, intervals -------------------------------------------------------------- */

static void inside_starts_end_there(void) {
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    build_world(&world);
    for (int n = 0; n < 40; ++n) {
        spt_ray ray =
            ray_of(0.5f, 0, 0, (float)check_uniform(-1, 1), (float)check_uniform(-1, 1), 0.25f);
        spt_hit hit;
        if (n % 2 == 1) { /* enters at 2 + 1/3, inside from there to 2.6 */
            ray = ray_of(3, 0, 0, -1, 0, 0);
            ray.t_min = (float)check_uniform(2.36, 2.58);
        }
        hit = trace_one(&world, &settings, &ray);
        check_context("ray %d", n);
        expect(&hit, SPT_HIT, (double)ray.t_min, 0);
        CHECK(hit.flags == SPT_FLAG_INSIDE && hit.evaluations == 1 && hit.residual < 0);
    }
}

static void budgets_and_intervals(void) {
    mapped_world world;
    spt_settings settings = spt_settings_default();
    spt_ray ray = ray_of(3, 0.05f, 0, -2, 0, 0);
    spt_hit hit, whole;
    build_world(&world);
    whole = trace_one(&world, &settings, &ray);
    /* |(x, 0.05) - (8/15, 0)| = 2/15 */
    expect(&whole, SPT_HIT, (3 - 8.0 / 15 - sqrt(4.0 / 225 - 0.0025)) / 2, 2e-4);
    CHECK(whole.flags == 0 && whole.component == 0);
    for (uint32_t budget = 0; budget < whole.evaluations; ++budget) {
        check_context("budget %u of %u", budget, whole.evaluations);
        settings.budget = budget;
        hit = trace_one(&world, &settings, &ray);
        CHECK(hit.outcome == SPT_LIMIT && hit.evaluations == budget);
        CHECK(hit.t >= ray.t_min && hit.t <= whole.t && hit.component == -1);
        if (budget == 0) {
            CHECK(!(hit.t > ray.t_min) && hit.residual > FLT_MAX);
        } else {
            const place at = {{3 - 2 * (extended)hit.t, 0.05L, 0}, 0};
            CHECK_SAY((extended)hit.residual <= mapped_distance(&world, &at) + 1e-5L, "residual %g",
                      (double)hit.residual);
        }
    }
    settings.budget = whole.evaluations;
    hit = trace_one(&world, &settings, &ray);
    CHECK(same_hit(&hit, &whole));
    settings = spt_settings_default();
    check_context("t_min = t_max");
    for (int i = 0; i < 3; ++i) { /* outside, at the surface, inside */
        ray.t_min = ray.t_max = i == 0 ? 0.5f : i == 1 ? whole.t : 1.2f;
        hit = trace_one(&world, &settings, &ray);
        expect(&hit, i == 0 ? SPT_MISS : SPT_HIT, (double)ray.t_max, 0);
        CHECK_SAY(hit.evaluations == 1, "%u evaluations", hit.evaluations);
    }
    check_context("t_min > t_max");
    ray.t_min = 1;
    ray.t_max = 0.5f;
    hit = trace_one(&world, &settings, &ray);
    expect(&hit, SPT_MISS, 0, 0);
    CHECK(hit.evaluations == 0);
    check_context("t_max before and behind the body");
    ray.t_min = 0;
    ray.t_max = whole.t - 1e-3f;
    hit = trace_one(&world, &settings, &ray);
    expect(&hit, SPT_MISS, 0, 0);
    ray.t_max = whole.t + 1e-3f;
    hit = trace_one(&world, &settings, &ray);
    expect(&hit, SPT_HIT, (double)whole.t, 2e-4);
}

static void bad_rays(void) {
    static const float not_finite[] = {INFINITY, -INFINITY, NAN};
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    build_world(&world);
    for (int n = 0; n < 3 * 8 + 3; ++n) {
        spt_ray ray = ray_of(3, 0, 0, -1, 0, 0);
        spt_hit hit;
        float *numbers[] = {&ray.origin[0],    &ray.origin[1],    &ray.origin[2], &ray.direction[0],
                            &ray.direction[1], &ray.direction[2], &ray.t_min,     &ray.t_max};
        if (n < 24) {
            *numbers[n / 3] = not_finite[n % 3];
            if (n == 21) continue; /* t_max = +infinity is none */
        } else if (n == 24) {
            ray.t_min = -1e-6f;
        } else {
            ray.direction[0] = n == 25 ? 0 : FLT_MIN / 2;
        }
        hit = trace_one(&world, &settings, &ray);
        check_context("ray %d", n);
        /* t_max = -infinity is a miss, as t_min lies behind it. */
        expect(&hit, n == 22 ? SPT_MISS : SPT_BAD_RAY, 0, 0);
        CHECK(hit.evaluations == 0 && hit.component == -1);
    }
}

static void nan_kernel(void *user, size_t n, const float *x, const float *y, const float *z,
                       float *distance) {
    (void)user, (void)y, (void)z;
    for (size_t i = 0; i < n; ++i) distance[i] = x[i] > 0.5f ? NAN : 0.25f;
}

/* Kernel points with x > 1/2 are the ball from 0 to 2. */
static void nan_kernels_are_nonfinite(void) {
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    const spt_ray ray = ray_of(3, 0, 0, -1, 0, 0);
    spt_hit hit;
    build_world(&world);
    world.inner.batch = nan_kernel;
    CHECK(spt_conformal_field(&world.inner, &world.map, &world.memory, &world.field) == SPT_OK);
    hit = trace_one(&world, &settings, &ray);
    CHECK_SAY(hit.outcome == SPT_NONFINITE && hit.t >= 1 && hit.t <= 3, "outcome %d at %g",
              (int)hit.outcome, (double)hit.t);
    CHECK(isnan(hit.residual));
}

/* ---- The contract ---------------------------------------------------------------------------- */

enum { many = 40 };

static void draw_many(spt_ray *rays) {
    for (int i = 0; i < many; ++i)
        rays[i] = ray_of((float)check_uniform(1, 3), (float)check_uniform(-1, 1),
                         (float)check_uniform(-1, 1), -1, (float)check_uniform(-0.2, 0.2),
                         (float)check_uniform(-0.2, 0.2));
}

/* Each sink alone, and all but each: what is asked for has the same bits, the rest stays. */
static void absent_sinks(void) {
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    spt_ray rays[many];
    spt_hit all[many], some[many], blank[many];
    const spt_rays from = spt_rays_of(rays);
    spt_hits to = spt_hits_of(all);
    build_world(&world);
    draw_many(rays);
    memset(blank, 0x5a, sizeof blank);
    CHECK(spt_conformal_trace(&world.memory, &settings, many, &from, &to, NULL) == SPT_OK);
    for (int n = 0; n < 2 * 9; ++n) {
        spt_sink *sinks[9];
        to = spt_hits_of(some);
        sinks[0] = &to.t;
        sinks[1] = &to.residual;
        sinks[2] = &to.outcome;
        sinks[3] = &to.evaluations;
        sinks[4] = &to.flags;
        sinks[5] = &to.component;
        sinks[6] = &to.candidate_t;
        sinks[7] = &to.candidate_ratio;
        sinks[8] = &to.fallbacks;
        memcpy(some, blank, sizeof some);
        for (int k = 0; k < 9; ++k)
            if ((k == n % 9) == (n < 9)) sinks[k]->first = NULL;
        CHECK(spt_conformal_trace(&world.memory, &settings, many, &from, &to, NULL) == SPT_OK);
        for (int i = 0; i < many; ++i) {
            for (int k = 0; k < 9; ++k) {
                /* spt_hit is nine words in the order of the sinks. */
                const spt_hit *other = sinks[k]->first == NULL ? &blank[i] : &all[i];
                CHECK_SAY(memcmp((const char *)&some[i] + 4 * k, (const char *)other + 4 * k, 4) ==
                              0,
                          "case %d, ray %d, sink %d", n, i, k);
            }
        }
    }
}

static void inactive_rays(void) {
    mapped_world world;
    const spt_settings settings = spt_settings_default();
    spt_ray rays[many];
    spt_hit all[many], some[many], blank[many];
    int32_t active[many];
    spt_rays from = spt_rays_of(rays);
    spt_hits to = spt_hits_of(all);
    spt_statistics statistics = spt_statistics_default();
    uint64_t lit = 0;
    build_world(&world);
    draw_many(rays);
    CHECK(spt_conformal_trace(&world.memory, &settings, many, &from, &to, NULL) == SPT_OK);
    memset(blank, 0x5a, sizeof blank);
    memcpy(some, blank, sizeof some);
    for (int i = 0; i < many; ++i) {
        active[i] = check_random() % 2 == 0 ? 0 : -1;
        lit += active[i] != 0;
        if (active[i] == 0) rays[i].origin[0] = NAN;
    }
    from.active.first = active;
    from.active.stride = sizeof *active;
    to = spt_hits_of(some);
    CHECK(spt_conformal_trace(&world.memory, &settings, many, &from, &to, &statistics) == SPT_OK);
    CHECK(statistics.rays == lit);
    for (int i = 0; i < many; ++i)
        CHECK_SAY(same_hit(&some[i], active[i] ? &all[i] : &blank[i]), "ray %d", i);
}

static void broken_calls(void) {
    mapped_world world;
    const spt_settings good = spt_settings_default();
    spt_ray ray = ray_of(3, 0, 0, -1, 0, 0);
    const spt_rays from = spt_rays_of(&ray);
    spt_rays no_rays = from;
    spt_hit hit, blank;
    const spt_hits to = spt_hits_of(&hit);
    spt_statistics statistics = spt_statistics_default();
    const spt_statistics untouched = statistics;
    build_world(&world);
    memset(&blank, 0x5a, sizeof blank);
    hit = blank;
#define REFUSED(conformal, settings, rays, hits) \
    CHECK(spt_conformal_trace(conformal, settings, 1, rays, hits, &statistics) == SPT_BAD_ARGUMENT)
    REFUSED(NULL, &good, &from, &to);
    REFUSED(&world.memory, NULL, &from, &to);
    REFUSED(&world.memory, &good, NULL, &to);
    REFUSED(&world.memory, &good, &from, NULL);
    no_rays.direction[1].first = NULL;
    REFUSED(&world.memory, &good, &no_rays, &to);
    for (int n = 0; n < 10; ++n) {
        spt_settings bad = good;
        if (n == 0) bad.flags = SPT_STOP_INSIDE;
        if (n == 1) bad.flags = 0x40000000u;
        if (n == 2) bad.epsilon = 0;
        if (n == 3) bad.epsilon = NAN;
        if (n == 4) bad.pixel_radius = -1;
        if (n == 5) bad.size = INFINITY;
        if (n == 6) bad.max_lanes = 3;
        if (n == 7) bad.struct_size = 8;
        if (n == 8) bad.epsilon = -1;
        if (n == 9) bad.flags = SPT_CANDIDATE_CLOSEST;
        check_context("settings %d", n);
        REFUSED(&world.memory, &bad, &from, &to);
    }
#undef REFUSED
    CHECK(same_hit(&hit, &blank));
    CHECK(memcmp(&statistics, &untouched, sizeof statistics) == 0);
    CHECK(spt_conformal_trace(&world.memory, &good, 0, NULL, NULL, NULL) == SPT_OK);
}

void suite_mobius_trace_cases(void) {
    RUN(M4_through_the_pole);
    RUN(M4_from_the_pole);
    RUN(infinite_exits_are_misses);
    RUN(inside_starts_end_there);
    RUN(budgets_and_intervals);
    RUN(bad_rays);
    RUN(nan_kernels_are_nonfinite);
    RUN(absent_sinks);
    RUN(inactive_rays);
    RUN(broken_calls);
}
