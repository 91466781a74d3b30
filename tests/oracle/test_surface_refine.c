/* SPDX-License-Identifier: MIT
 *
 * Discontinuity reduction (spt_refine): rows E5 and P18 and property Q21. Left out: whole pictures,
 * see test_surface_refine_picture.c, and equal bits, see test_surface_parity.c. */
#include "surface_refining.h"
#include "../check.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <string.h>

/* ---- E5, P18: fields that fall too fast, too slowly or not at all --------------------------- */

/* S0 with k f: the unit sphere at (0, 0, 10), seen along z from the origin. */
static void E5_refine_wrong_slopes(void) {
    static const double slopes[] = {0.5, 1, 1.5, 1.9, 2.1, 2.5, 4};
    static const uint32_t all_rounds[] = {1, 3, 16};
    spt_settings given = spt_settings_default();
    given.pixel_radius = 1e-3f;
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        for (int i = 0; i < 7 * 3; ++i) {
            const uint32_t rounds = all_rounds[i % 3];
            surface_body ball = surface_sphere(0, 0, 10, 1);
            reference_field field;
            refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 1}, 100}, 0, 1};
            spt_hit before, after;
            ball.factor = slopes[i / 3];
            field = surface_body_field(&ball);
            field.lipschitz = 1; /* which is wrong from 1.5 on */
            what.field = &field;
            what.settings = &given;
            before = refining_hit(&what, 8.99f);
            after = refining_run(&run, &what, rounds, &before);
            refining_check(&what, rounds, &before, &after);
            if (i / 3 == 1) {
                CHECK_SAY(fabs((double)after.t - 8.99101) <= 1e-4, "%.9g", (double)after.t);
            }
            before = refining_hit(&what, 12); /* on the leaving side */
            after = refining_run(&run, &what, rounds, &before);
            CHECK_SAY(check_same_bits(after.t, 12) &&
                          check_same_bits(after.residual, before.residual),
                      "%.9g", (double)after.t);
        }
    }
}

static real not_a_number(const void *user, const real position[3]) {
    (void)user;
    (void)position;
    return (real)NAN;
}

static void E5_refine_not_a_number(void) {
    const reference_field field = {not_a_number, NULL, 1};
    spt_settings given = spt_settings_default();
    refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 1}, 100}, 0, 1};
    given.pixel_radius = 1e-3f;
    what.field = &field;
    what.settings = &given;
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        for (int missing = 0; missing < 2; ++missing) {
            spt_hit before = refining_hit(&what, 9), after;
            if (!missing) before.residual = 1e-3f; /* the hit was sound, what is around it not */
            after = refining_run(&run, &what, 3, &before);
            CHECK_SAY(check_same_bits(after.t, 9) &&
                          check_bits(after.residual) == check_bits(before.residual),
                      "%.9g, %.9g", (double)after.t, (double)after.residual);
        }
    }
}

static real slope_along_z(const void *user, const real position[3]) {
    const double slope = *(const double *)user;
    return (real)(slope * ((double)position[2] - 10));
}

/* P18, with a tolerance that lets the hits count as such: without a cone each round multiplies the distance by 1 + slope, and is kept where that
 * is less than 1 in size. */
static void P18_refine_rates(void) {
    static const double slopes[] = {-1, -0.1, 0.5, -1.5, -1.9, -2.1, 0};
    spt_settings given = spt_settings_default();
    given.epsilon = 5e-3f;
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        for (int i = 0; i < 7; ++i) {
            reference_field field = {slope_along_z, NULL, 1};
            refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 1}, 100}, 0, 1};
            const double rate = fabs(1 + slopes[i]);
            const float start = slopes[i] > 0 || slopes[i] < 0 ? (float)(10 + 5e-3 / slopes[i]) : 9;
            spt_hit before, after;
            double expected;
            field.user = &slopes[i];
            what.field = &field;
            what.settings = &given;
            before = refining_hit(&what, start);
            after = refining_run(&run, &what, 3, &before);
            expected = fabs((double)before.residual) * (rate < 1 ? rate * rate * rate : 1);
            /* Each round rounds t once, half an ulp of 10, and f to the next float of 5e-3. */
            CHECK_SAY(fabs(fabs((double)after.residual) - expected) <= 3 * 2.2 * 0x1p-22,
                      "slope %g: %g for %g", slopes[i], (double)after.residual, expected);
            refining_check(&what, 3, &before, &after);
        }
    }
}

/* ---- Q21: random worlds -------------------------------------------------------------------- */

/* Hits of every rule, at a surface, and made-up ones anywhere, from outside and inside. */
static void Q21_refine_never_worse(void) {
    drawn world_drawn;
    oracle_draw(&world_drawn);
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        spt_settings given = world_drawn.settings, settings;
        reference_field scaled = world_drawn.field;
        spt_field field;
        given.pixel_radius = (float)pow(10, check_uniform(-5, -2));
        settings = surface_settings(&run, &given);
        field = surface_field(&run, &scaled, 0);
        for (int i = 0; i < drawn_rays; ++i) {
            const uint32_t rounds = check_random() % 17;
            refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 0}, 0}, 0, 1};
            spt_hit before, after;
            what.field = &scaled;
            what.settings = &given;
            what.ray = world_drawn.rays[i];
            before = oracle_trace_one(&field, &settings, &what.ray);
            if (before.outcome != SPT_HIT || i % 3 == 0) {
                before = refining_hit(&what, (float)check_uniform(0, 20));
            }
            if (before.residual < 0 && i % 2 != 0) before.flags = SPT_FLAG_INSIDE;
            if ((before.flags & SPT_FLAG_INSIDE) != 0) what.side = -1;
            what.path = i % 4 == 0 ? check_uniform(0, 50) : 0;
            what.path = (double)(float)what.path;
            after = refining_run(&run, &what, rounds, &before);
            refining_check(&what, rounds, &before, &after);
        }
    }
}

static void refine_inside_starts(void) {
    surface_body ball = surface_sphere(0.2, -0.1, 0.3, 2);
    spt_settings given = spt_settings_default();
    reference_field field;
    ball.factor = 0.7;
    field = surface_body_field(&ball);
    given.pixel_radius = 2e-3f;
    for (surface_run run = surface_runs(SURFACE_ALL_RULES); surface_next(&run);) {
        const spt_settings settings = surface_settings(&run, &given);
        const spt_field view = surface_field(&run, &field, 0);
        for (int i = 0; i < 12; ++i) {
            refining_task what = {NULL, NULL, {{0, 0, 0}, 0, {0, 0, 0}, 0}, 0, -1};
            const double near[3] = {check_uniform(-1, 1), check_uniform(-1, 1),
                                    check_uniform(-1, 1)};
            double target[3];
            spt_hit before, after;
            surface_random_unit(target);
            for (int axis = 0; axis < 3; ++axis) target[axis] += near[axis];
            what.ray = surface_aim(near, target, pow(2, check_uniform(-2, 2)), 50);
            what.field = &field;
            what.settings = &given;
            before = oracle_trace_one(&view, &settings, &what.ray);
            CHECK(before.outcome == SPT_HIT && (before.flags & SPT_FLAG_INSIDE) != 0);
            after = refining_run(&run, &what, 5, &before);
            refining_check(&what, 5, &before, &after);
            /* From near the middle the ball is left at a cosine of at least 0.5, so five rounds
             * leave at most (1 - 0.5)^5 of what was off, which was no more than the tolerance. */
            CHECK_SAY(fabs(refining_off(&what, (double)after.t, (double)after.residual)) <=
                          refining_allowance(&what, (double)after.t) / 16 +
                              surface_rounding(&what.ray, (double)after.t),
                      "off by %g", refining_off(&what, (double)after.t, (double)after.residual));
        }
    }
}

/* ---- What is left alone -------------------------------------------------------------------- */

static void refine_leaves_others_alone(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field field = surface_body_field(&ball);
    enum { kinds = 8 };
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        spt_settings settings = spt_settings_default();
        const spt_field view = surface_field(&run, &field, 0);
        spt_ray ray[kinds];
        spt_hit before[kinds], after[kinds];
        int32_t active[kinds];
        spt_rays rays = spt_rays_of(ray);
        const spt_hits hits = spt_hits_of(after);
        settings.max_lanes = run.lanes;
        settings.pixel_radius = 1e-3f;
        for (int i = 0; i < kinds; ++i) {
            const spt_ray one = {{0, 0, 0}, 0, {0, 0, 1}, 100};
            const spt_hit hit = {8.99f, 0.01f, SPT_HIT, 5, 0, 0, 8.99f, 1e-3f, 0};
            ray[i] = one;
            before[i] = hit;
            active[i] = -1;
        }
        before[1].outcome = SPT_MISS;
        before[2].outcome = SPT_LIMIT;
        before[3].outcome = SPT_NONFINITE;
        before[3].residual = NAN;
        before[4].outcome = SPT_BAD_RAY;
        before[5].flags = SPT_FLAG_STEEP;
        before[6].flags = SPT_FLAG_STEEP | SPT_FLAG_INSIDE;
        active[7] = 0;
        ray[7].direction[2] = NAN;
        rays.active.first = active;
        rays.active.stride = sizeof active[0];
        memcpy(after, before, sizeof after);
        CHECK(spt_refine(&view, 1, &settings, 3, kinds, &rays, &hits) == SPT_OK);
        CHECK(after[0].t > before[0].t && after[0].evaluations > before[0].evaluations);
        for (int i = 1; i < kinds; ++i) {
            CHECK_SAY(memcmp(&after[i], &before[i], sizeof after[i]) == 0, "kind %d", i);
        }
        memcpy(after, before, sizeof after);
        CHECK(spt_refine(&view, 1, &settings, 0, kinds, &rays, &hits) == SPT_OK);
        CHECK(memcmp(after, before, sizeof after) == 0);
    }
}

/* Each hit by the field that it is of, with that field's own Lipschitz constant. */
static void refine_components(void) {
    surface_body bodies[2] = {surface_sphere(-1, 0, 6, 1), surface_sphere(1, 0, 9, 1)};
    reference_field fields[2];
    spt_settings given = spt_settings_default();
    bodies[1].factor = 3;
    for (int i = 0; i < 2; ++i) fields[i] = surface_body_field(&bodies[i]);
    given.pixel_radius = 3e-3f;
    for (surface_run run = surface_runs(0); surface_next(&run);) {
        const spt_settings settings = surface_settings(&run, &given);
        const spt_field views[2] = {surface_field(&run, &fields[0], 0),
                                    surface_field(&run, &fields[1], 0)};
        for (int i = 0; i < 2; ++i) {
            const spt_ray ray = {{2 * (float)i - 1, 0.3f, 0}, 0, {0, 0, 1}, 100};
            const spt_rays rays = spt_rays_of(&ray);
            const spt_hit before = oracle_trace_one(&views[i], &settings, &ray);
            const spt_hit alone = before;
            spt_hit hit[2] = {alone, alone};
            spt_hits one = spt_hits_of(&hit[0]), of_two = spt_hits_of(&hit[1]);
            hit[1].component = i;
            CHECK(before.outcome == SPT_HIT);
            CHECK(spt_refine(&views[i], 1, &settings, 4, 1, &rays, &one) == SPT_OK);
            CHECK(spt_refine(views, 2, &settings, 4, 1, &rays, &of_two) == SPT_OK);
            CHECK(hit[1].component == i);
            hit[1].component = hit[0].component;
            CHECK(oracle_same_hit(&hit[0], &hit[1]));
            CHECK(hit[0].evaluations > before.evaluations);
        }
    }
}

static void refine_refuses(void) {
    const surface_body ball = surface_sphere(0, 0, 10, 1);
    const reference_field field = surface_body_field(&ball);
    const spt_field view = oracle_field(&field, 0);
    const spt_settings settings = spt_settings_default();
    const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 100};
    const spt_rays rays = spt_rays_of(&ray);
    spt_hit hit = {8.99f, 0.01f, SPT_HIT, 5, 0, 0, 8.99f, 1e-3f, 0};
    const spt_hit kept = hit;
    const spt_hits hits = spt_hits_of(&hit);
    CHECK(spt_refine(&view, 1, &settings, 17, 1, &rays, &hits) == SPT_BAD_ARGUMENT);
    CHECK(spt_refine(NULL, 1, &settings, 3, 1, &rays, &hits) == SPT_BAD_ARGUMENT);
    CHECK(spt_refine(&view, 0, &settings, 3, 1, &rays, &hits) == SPT_BAD_ARGUMENT);
    for (int i = 0; i < 3; ++i) {
        spt_hits absent = hits;
        (i == 0 ? &absent.t : i == 1 ? &absent.residual : &absent.outcome)->first = NULL;
        CHECK(spt_refine(&view, 1, &settings, 3, 1, &rays, &absent) == SPT_BAD_ARGUMENT);
    }
    CHECK(oracle_same_hit(&hit, &kept));
}

void suite_surface_refine(void) {
    RUN(E5_refine_wrong_slopes);
    RUN(E5_refine_not_a_number);
    RUN(P18_refine_rates);
    RUN(Q21_refine_never_worse);
    RUN(refine_inside_starts);
    RUN(refine_leaves_others_alone);
    RUN(refine_components);
    RUN(refine_refuses);
}
