/* SPDX-License-Identifier: MIT
 *
 * Occlusion (spt_occluded) against the first hits of random worlds, and soft shadows
 * (spt_soft_shadow, spt_penumbra) against the angle by which rays miss bodies. */
#include "surface_passing.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

/* ---- Occlusion ----------------------------------------------------------------------------- */

static void occluded(const surface_run *run, const spt_field *field, const spt_settings *given,
                     size_t count, const spt_ray *rays, int32_t *answers) {
    const spt_settings settings = surface_settings(run, given);
    const spt_rays view = spt_rays_of(rays);
    spt_sink sink = {NULL, sizeof *answers};
    spt_statistics statistics = spt_statistics_default();
    sink.first = answers;
    CHECK(spt_occluded(field, &settings, count, &view, &sink, &statistics) == SPT_OK);
    CHECK(statistics.rays == count);
    CHECK_SAY(statistics.lanes == run->lanes, "ran %u", statistics.lanes);
}

static void occluded_in_worlds(void) {
    enum { draws = 3 };
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        for (int draw = 0; draw < draws; ++draw) {
            drawn world_drawn;
            int32_t answers[drawn_rays];
            spt_field field;
            oracle_draw(&world_drawn);
            for (int i = 0; i < drawn_rays; i += 3) { /* up to a light somewhere */
                world_drawn.rays[i].t_max = (float)check_uniform(1, 15);
                world_drawn.truth[i] = world_trace(&world_drawn.scene, &world_drawn.rays[i]);
            }
            field = surface_field(&run, &world_drawn.field, 0);
            occluded(&run, &field, &world_drawn.settings, drawn_rays, world_drawn.rays, answers);
            for (int i = 0; i < drawn_rays; ++i) {
                const int truth = world_drawn.truth[i].t < HUGE_VAL;
                const spt_settings settings = surface_settings(&run, &world_drawn.settings);
                const spt_hit hit = oracle_trace_one(&field, &settings, &world_drawn.rays[i]);
                CHECK(answers[i] == 0 || answers[i] == 1);
                /* Whoever ran out of budget is not certainly free. */
                if (!(world_drawn.truth[i].gap > 0.02) || hit.outcome == SPT_LIMIT) continue;
                CHECK_SAY(answers[i] == truth, "%d, truth %g, gap %g", answers[i],
                          world_drawn.truth[i].t, world_drawn.truth[i].gap);
            }
        }
    }
}

static real wall_of_nan(const void *user, const real position[3]) {
    (void)user;
    return (double)position[2] > 5 ? (real)NAN : 8 - position[2];
}

/* What is neither free nor hit, and what is no ray. */
static void occluded_without_end(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field sound = surface_body_field(&ball), hollow = {wall_of_nan, NULL, 1};
    const spt_ray towards = {{0, 0, 0}, 0, {0, 0, 1}, 100}, past = {{3, 0, 0}, 0, {0, 0, 1}, 100},
                  inside = {{0, 0, 10}, 0, {0, 0, 1}, 0.5f}, empty = {{0, 0, 0}, 5, {0, 0, 1}, 1},
                  bad = {{NAN, 0, 0}, 0, {0, 0, 1}, 100}, ends = {{0, 0, 0}, 0, {0, 0, 1}, 8.9f},
                  grazing = {{1.00005f, 0, 0}, 0, {0, 0, 1}, 100};
    const spt_ray rays[] = {towards, past, inside, empty, bad, ends, grazing};
    static const int expected[] = {1, 0, 1, 0, 0, 0};
    enum { count = sizeof rays / sizeof rays[0] };
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_field field = surface_field(&run, &sound, 0),
                        broken = surface_field(&run, &hollow, 0);
        spt_settings given = spt_settings_default();
        int32_t answers[count];
        occluded(&run, &field, &given, count, rays, answers);
        for (int i = 0; i < 6; ++i) CHECK_SAY(answers[i] == expected[i], "ray %d", i);
        given.budget = 2; /* too few for any rule to come past the ball */
        occluded(&run, &field, &given, count, rays, answers);
        CHECK_SAY(answers[6] == 1, "out of budget: %d", answers[6]);
        given.budget = 0;
        occluded(&run, &field, &given, count, rays, answers);
        CHECK(answers[1] == 1 && answers[3] == 0 && answers[4] == 0);
        given.budget = 128;
        occluded(&run, &broken, &given, 1, &towards, answers);
        CHECK_SAY(answers[0] == 1, "NaN: %d", answers[0]);
    }
}

/* A ray that begins on the ball that it leaves: free, if its start is skipped. */
static void occluded_from_surfaces(void) {
    const surface_body bodies[2] = {surface_sphere(0, 0, 0, 1), surface_sphere(0, 4, 0, 1)};
    const surface_group group = {bodies, 2};
    const reference_field reference = surface_group_field(&group);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_field field = surface_field(&run, &reference, 0);
        const spt_ray rays[2] = {{{0, 1, 0}, 0, {1, 1, 0}, 100}, {{0, 1, 0}, 0, {0, 1, 0}, 100}};
        spt_settings given = spt_settings_default();
        int32_t answers[2];
        given.flags = SPT_SKIP_START;
        occluded(&run, &field, &given, 2, rays, answers);
        CHECK_SAY(answers[0] == 0 && answers[1] == 1, "%d %d", answers[0], answers[1]);
        given.flags = 0;
        occluded(&run, &field, &given, 2, rays, answers);
        CHECK_SAY(answers[0] == 1 && answers[1] == 1, "%d %d", answers[0], answers[1]);
    }
}

static void occluded_refuses(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    spt_settings settings = spt_settings_default();
    const spt_ray rays[3] = {{{0, 0, 0}, 0, {0, 0, 1}, 100},
                             {{0, 0, 0}, 0, {0, 0, 1}, 100},
                             {{0, 0, 0}, 0, {0, 0, 1}, 100}};
    static const int32_t active[3] = {-1, 0, 1};
    spt_rays view = spt_rays_of(rays);
    int32_t answers[3] = {77, 77, 77};
    spt_sink sink = {NULL, sizeof answers[0]};
    CHECK(spt_occluded(&field, &settings, 3, &view, &sink, NULL) == SPT_BAD_ARGUMENT);
    CHECK(spt_occluded(&field, &settings, 3, &view, NULL, NULL) == SPT_BAD_ARGUMENT);
    sink.first = answers;
    CHECK(spt_occluded(NULL, &settings, 3, &view, &sink, NULL) == SPT_BAD_ARGUMENT);
    settings.epsilon = 0;
    CHECK(spt_occluded(&field, &settings, 3, &view, &sink, NULL) == SPT_BAD_ARGUMENT);
    CHECK(answers[0] == 77);
    settings.epsilon = 1e-4f;
    view.active.first = active;
    view.active.stride = sizeof active[0];
    CHECK(spt_occluded(&field, &settings, 3, &view, &sink, NULL) == SPT_OK);
    CHECK(answers[0] == 1 && answers[1] == 77 && answers[2] == 1);
}

/* ---- Soft shadows -------------------------------------------------------------------------- */

static void penumbra_of_a_ratio(void) {
    CHECK(check_same_bits(spt_penumbra(SPT_MISS, 0.25f, 0.5f), 0.5f));
    CHECK(check_same_bits(spt_penumbra(SPT_LIMIT, 0.25f, 0.5f), 0.5f));
    CHECK(check_same_bits(spt_penumbra(SPT_MISS, 0.5f, 0.25f), 1));
    CHECK(check_same_bits(spt_penumbra(SPT_MISS, INFINITY, 0.25f), 1));
    CHECK(check_same_bits(spt_penumbra(SPT_HIT, 0.25f, 0.5f), 0));
    CHECK(check_same_bits(spt_penumbra(SPT_NONFINITE, 0.25f, 0.5f), 0));
    CHECK(check_same_bits(spt_penumbra(SPT_BAD_RAY, INFINITY, 0.5f), 0));
}

static float shadow_of(const surface_run *run, const reference_field *reference, const spt_ray *ray,
                       float tangent, int smooth) {
    const spt_field field = surface_field(run, reference, SPT_FIELD_CONVEX);
    spt_settings given = spt_settings_default(), settings;
    const spt_rays rays = spt_rays_of(ray);
    const spt_column tangents = {&tangent, 0};
    float visibility = -1;
    spt_sink sink = {NULL, sizeof visibility};
    sink.first = &visibility;
    given.budget = 2000;
    settings = surface_settings(run, &given);
    CHECK(spt_soft_shadow(&field, &settings, &tangents, smooth, 1, &rays, &sink, NULL) == SPT_OK);
    return visibility;
}

/* Past bodies by a known angle, whose sine is known: visibility is at most its tangent over that of
 * the light, and for plain steps at least sqrt(3/4) sine / (1 + sine) over it (see
 * test_surface_closest.c). */
static void soft_shadows_past_bodies(void) {
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        for (int i = 0; i < 24; ++i) {
            const passing what = passing_draw((passing_kind)(i % passing_kinds));
            const reference_field reference = surface_body_field(&what.body);
            const float tangent = (float)pow(2, check_uniform(-4, 2));
            const float v = shadow_of(&run, &reference, &what.ray, tangent, 0);
            const float smoothed = shadow_of(&run, &reference, &what.ray, tangent, 1);
            const double true_tangent = what.sine / sqrt(1 - what.sine * what.sine);
            const double seen = (double)v * (double)tangent, exact = (double)v;
            const double rounding =
                seen * (passing_rounding(&what, what.closest) / what.closest + 0x1p-20);
            CHECK_SAY(v >= 0 && v <= 1, "%g", (double)v);
            CHECK_SAY(seen <= true_tangent + rounding, "%g, true tangent %g", seen, true_tangent);
            if (run.method == spt_basic()) {
                const double least = sqrt(0.75) * what.sine / (1 + what.sine);
                CHECK_SAY(v >= 1 || seen >= least - rounding, "%g, at least %g", seen, least);
            }
            CHECK_SAY(fabs((double)smoothed - exact * exact * (3 - 2 * exact)) <= 0x1p-22,
                      "%g of %g", (double)smoothed, exact);
        }
    }
}

/* Dark behind a body and inside it, light where nothing is. */
static void soft_shadows_plain(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_ray dark = {{0, 0, 0}, 0, {0, 0, 2}, 100}, light = {{0, 0, 0}, 0, {0, 0, -1}, 100},
                  inside = {{0, 0, 10}, 0, {0, 0, 1}, 100}, bad = {{0, 0, 0}, 0, {0, 0, 0}, 100},
                  empty = {{0, 0, 0}, 5, {0, 0, 1}, 1};
    const float bad_tangents[] = {0, -1, NAN, INFINITY, -INFINITY};
    for (surface_run run = surface_runs(SURFACE_ALL_RULES | SURFACE_CONVEX); surface_next(&run);) {
        CHECK(check_same_bits(shadow_of(&run, &reference, &dark, 0.1f, 0), 0));
        CHECK(check_same_bits(shadow_of(&run, &reference, &light, 0.1f, 0), 1));
        CHECK(check_same_bits(shadow_of(&run, &reference, &light, 0.1f, 1), 1));
        CHECK(check_same_bits(shadow_of(&run, &reference, &inside, 0.1f, 0), 0));
        CHECK(check_same_bits(shadow_of(&run, &reference, &bad, 0.1f, 0), 0));
        CHECK(check_same_bits(shadow_of(&run, &reference, &empty, 0.1f, 0), 1));
        for (int i = 0; i < 5; ++i) {
            CHECK_SAY(check_same_bits(shadow_of(&run, &reference, &light, bad_tangents[i], 0), 0),
                      "tangent %g", (double)bad_tangents[i]);
        }
    }
}

static void soft_shadows_refuse(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field reference = surface_body_field(&ball);
    const spt_field field = oracle_field(&reference, 0);
    const spt_settings settings = spt_settings_default();
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    const spt_rays rays = spt_rays_of(&ray);
    const float tangent = 0.1f;
    const spt_column tangents = {&tangent, 0}, absent = {NULL, 0};
    float visibility = 0.75f;
    spt_sink sink = {NULL, sizeof visibility};
    CHECK(spt_soft_shadow(&field, &settings, &tangents, 0, 1, &rays, &sink, NULL) ==
          SPT_BAD_ARGUMENT);
    sink.first = &visibility;
    CHECK(spt_soft_shadow(&field, &settings, &absent, 0, 1, &rays, &sink, NULL) ==
          SPT_BAD_ARGUMENT);
    CHECK(spt_soft_shadow(&field, &settings, NULL, 0, 1, &rays, &sink, NULL) == SPT_BAD_ARGUMENT);
    CHECK(check_same_bits(visibility, 0.75f));
}

void suite_surface_shadow(void) {
    RUN(occluded_in_worlds);
    RUN(occluded_without_end);
    RUN(occluded_from_surfaces);
    RUN(occluded_refuses);
    RUN(penumbra_of_a_ratio);
    RUN(soft_shadows_past_bodies);
    RUN(soft_shadows_plain);
    RUN(soft_shadows_refuse);
}
