/* SPDX-License-Identifier: MIT
 *
 * Misprints and gaps of the papers' step rules: each test shows what the
 * listing as printed does, and that the library, with every rule at every width, does not. */
#include "trail.h"
#include "../check.h"

#include <math.h>

static void check_hit(const spt_hit *hit, double t) {
    CHECK_SAY(hit->outcome == SPT_HIT, "%d", hit->outcome);
    CHECK_SAY(fabs((double)hit->t - t) <= 1e-4, "%.9g for %g", (double)hit->t, t);
}

/* Algorithm 3 starts with r = r(-1) = d = 0: 0 * (0 / 0). */
static void P1_enhanced_starts_plain(void) {
    trail t = trail_of(trail_ball, 10, 1);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    CHECK(isnan(balint_algorithm_3(&in, 1e-4f, 0.88f)));
    CHECK(in.evaluations == 1);
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 100);
        const spt_hit hit = trail_trace(&t, &settings, &ray);
        check_hit(&hit, 9);
        if (run.rule == REFERENCE_ENHANCED || run.rule == REFERENCE_ADAPTIVE) {
            CHECK(t.count >= 2 && check_same_bits(t.z[1], 9));
        }
    }
}

/* Equation 1 divides by d + r(i-1) - r(i), which is 0 when the ray leaves head-on. */
static void P2_leaving_head_on(void) {
    trail t = trail_of(trail_above, 20, 0);
    oracle_run run = oracle_first_run;
    const double behind_zero = balint_printed_step(1, 1, 2.0000001, 0.88);
    CHECK(isinf(balint_printed_step(1, 1, 2, 0.88)));
    CHECK_SAY(behind_zero < -3.4e7 && behind_zero > -3.6e7, "%g", behind_zero);
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 1e6f);
        /* Adaptive goes no further than its cap; the clamped slope of the others at -0.98 gives at
         * most (1 + 1.98 / 0.02) r. */
        const double most = run.rule == REFERENCE_ADAPTIVE ? (double)settings.step_cap : 100;
        spt_hit hit;
        t.b = 0; /* the floor alone */
        hit = trail_trace(&t, &settings, &ray);
        CHECK_SAY(hit.outcome == SPT_MISS, "%d", hit.outcome);
        for (int i = 1; i < t.count; ++i) {
            const double step = (double)t.z[i] - (double)t.z[i - 1], r = (double)t.z[i - 1] + 1;
            CHECK_SAY(step <= most * r * (1 + 1e-6), "step %g at r %g", step, r);
            CHECK_SAY(step >= r * (1 - 1e-6), "step %g at r %g", step, r);
        }
        t.b = 1; /* and the ball above it */
        hit = trail_trace(&t, &settings, &ray);
        check_hit(&hit, 19);
    }
}

/* Algorithms 2 and 3 evaluate twice in an iteration that falls back. On this wall every iteration
 * does: (1 + w)(1 + cosine) > 2. */
static void P3_fallbacks_count(void) {
    trail t = trail_of(trail_wall, 10, 0.5f);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    in.max_iterations = 20;
    (void)balint_algorithm_2(&in, 1e-30f, 0.9f);
    CHECK_SAY(in.evaluations == 39, "%u", in.evaluations);
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 100);
        settings.relaxation = 1.9f;
        for (settings.budget = 1; settings.budget <= 20; ++settings.budget) {
            const spt_hit hit = trail_trace(&t, &settings, &ray);
            CHECK_SAY(hit.evaluations <= settings.budget, "%u of %u", hit.evaluations,
                      settings.budget);
            CHECK_SAY((int)hit.evaluations == t.count, "%u, calls %d", hit.evaluations, t.count);
        }
    }
}

/* Three parameters called omega: Keinert steps w r, Algorithm 2 r + w r, Algorithm 3 weights the
 * inferred second radius. */
static void P7_three_omegas(void) {
    trail t = trail_of(trail_ball, 10, 1);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    (void)keinert_listing_2(&in, 0, 100, 1.2f, 1e-4f, 0);
    CHECK(fabs((double)t.z[1] - 1.2 * 9) < 1e-5);
    t.count = 0;
    (void)balint_algorithm_2(&in, 1e-4f, 1.2f);
    CHECK(fabs((double)t.z[1] - 2.2 * 9) < 1e-5);
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 100);
        t = trail_of(trail_ball, 10, 1);
        settings.relaxation = 1.2f;
        (void)trail_trace(&t, &settings, &ray);
        if (run.rule == REFERENCE_RELAXED) CHECK(fabs((double)t.z[1] - 1.2 * 9) < 1e-5);
        /* r = 5, then 2.5 with descent m = 1/2: the second radius is 2.5 (1-m)/(1+m) = 5/6 */
        t = trail_of(trail_wall, 10, 0.5f);
        (void)trail_trace(&t, &settings, &ray);
        if (run.rule == REFERENCE_ENHANCED || run.rule == REFERENCE_ADAPTIVE) {
            CHECK(fabs((double)t.z[2] - (5 + 2.5 + 0.88 * 5 / 6)) < 1e-5);
        }
    }
}

static spt_status status_of(const spt_settings *settings) {
    trail t = trail_of(trail_ball, 10, 1);
    spt_field field = spt_field_default();
    const spt_ray ray = trail_ray(0, 100);
    const spt_rays rays = spt_rays_of(&ray);
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    spt_status status;
    field.point = trail_listen;
    field.user = &t;
    status = spt_trace(&field, settings, 1, &rays, &hits, NULL);
    CHECK(status == SPT_OK || t.count == 0);
    return status;
}

static void P7_three_ranges(void) {
    spt_settings settings = spt_settings_default();
    settings.relaxation = 0.2f; /* Algorithm 2's sense of 1.2 */
    CHECK(status_of(&settings) == SPT_BAD_ARGUMENT);
    settings.relaxation = 2.0f;
    CHECK(status_of(&settings) == SPT_BAD_ARGUMENT);
    settings = spt_settings_default();
    settings.extrapolation = 1.2f; /* Keinert's sense of 0.2 */
    CHECK(status_of(&settings) == SPT_BAD_ARGUMENT);
    settings.extrapolation = 1.0f;
    CHECK(status_of(&settings) == SPT_OK);
    settings.relaxation = 1.0f;
    CHECK(status_of(&settings) == SPT_OK);
}

/* Listing 2 takes the sign at o, not at t_min. */
static void P8_sign_of_first_sample(void) {
    trail around = trail_of(trail_ball, 0, 2), ahead = trail_of(trail_ball, 10, 3);
    listing in = trail_listing(&around);
    oracle_run run = oracle_first_run;
    float t = keinert_listing_2(&in, 3, 100, 1.2f, 1e-4f, 0);
    CHECK_SAY(fabs((double)t - 2) < 1e-3, "%g", (double)t); /* before t_min */
    in = trail_listing(&ahead);
    t = keinert_listing_2(&in, 10, 100, 1.2f, 1e-4f, 0);
    CHECK_SAY(fabs((double)t - 7) < 2e-3, "%g", (double)t); /* before t_min, the way in */
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray after = trail_ray(3, 100), within = trail_ray(10, 100);
        spt_hit hit = trail_trace(&around, &settings, &after);
        CHECK(hit.outcome == SPT_MISS && (hit.flags & SPT_FLAG_INSIDE) == 0);
        hit = trail_trace(&ahead, &settings, &within);
        check_hit(&hit, 13);
        CHECK((hit.flags & SPT_FLAG_INSIDE) != 0);
    }
}

/* Listing 2 divides by t. */
static void P9_no_division_by_t(void) {
    trail behind = trail_of(trail_ball, -1, 1), ahead = trail_of(trail_ball, 10, 1);
    listing in = trail_listing(&behind);
    oracle_run run = oracle_first_run;
    CHECK(isinf(keinert_listing_2(&in, 0, 100, 1.2f, 1e-4f, 0))); /* 0 / 0 at the start */
    CHECK_SAY(in.evaluations == 129, "%u", in.evaluations);
    in = trail_listing(&ahead);
    CHECK(check_same_bits(keinert_listing_2(&in, -1, 100, 1.2f, 1e-4f, 0), -1)); /* ratio < 0 */
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray start = trail_ray(0, 100), negative = trail_ray(-1, 100);
        spt_hit hit = trail_trace(&behind, &settings, &start);
        CHECK(hit.outcome == SPT_HIT && check_same_bits(hit.t, 0) && hit.evaluations == 1);
        hit = trail_trace(&ahead, &settings, &negative);
        CHECK(hit.outcome == SPT_BAD_RAY && hit.evaluations == 0);
    }
}

/* Listing 1 loops while t < t_max and rejects t > t_max; t == t_max is neither. */
static void P10_end_of_the_ray(void) {
    trail sphere = trail_of(trail_ball, 10, 1), far = trail_of(trail_wall, 50, 1);
    listing in = trail_listing(&sphere);
    oracle_run run = oracle_first_run;
    CHECK(check_same_bits(keinert_listing_1(&in, 5, 5, 1e-4f), 5) && in.evaluations == 0);
    CHECK(check_same_bits(keinert_listing_1(&in, 0, NAN, 1e-4f), 0) && in.evaluations == 0);
    in = trail_listing(&far);
    CHECK(check_same_bits(keinert_listing_1(&in, 0, 50, 1e-4f), 50) && in.evaluations == 1);
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray point = trail_ray(5, 5), on_surface = trail_ray(9, 9),
                      none = trail_ray(0, NAN), to_wall = trail_ray(0, 50);
        spt_hit hit = trail_trace(&sphere, &settings, &point);
        CHECK(hit.outcome == SPT_MISS && hit.evaluations == 1);
        hit = trail_trace(&sphere, &settings, &on_surface);
        CHECK(hit.outcome == SPT_HIT && check_same_bits(hit.t, 9) && hit.evaluations == 1);
        hit = trail_trace(&sphere, &settings, &none);
        CHECK(hit.outcome == SPT_BAD_RAY && hit.evaluations == 0);
        hit = trail_trace(&far, &settings, &to_wall);
        CHECK(hit.outcome == SPT_HIT && check_same_bits(hit.t, 50));
        CHECK(check_same_bits(far.z[far.count - 1], 50));
    }
}

/* Listing 2 tests t > t_max on a rejected probe, too. */
static void P11_probe_past_the_end(void) {
    static const float cases[][2] = {{1.5f, 1.9f}, {1.15f, 1.2f}}; /* t_max, relaxation */
    trail t = trail_of(trail_slab, 1, 1.01f);
    for (int i = 0; i < 2; ++i) {
        listing in = trail_listing(&t);
        oracle_run run = oracle_first_run;
        CHECK(isinf(keinert_listing_2(&in, 0, cases[i][0], cases[i][1], 1e-4f, 0)));
        while (oracle_next(&run, 0)) {
            spt_settings settings = oracle_settings(&run);
            const spt_ray ray = trail_ray(0, cases[i][0]);
            spt_hit hit;
            settings.relaxation = cases[i][1];
            hit = trail_trace(&t, &settings, &ray);
            check_hit(&hit, 1);
        }
    }
}

/* Listing 2 falls back by step (1 - omega): to omega (2 - omega) r instead of r. */
static void P12_fallback_lands_on_r(void) {
    static const float omegas[] = {1.2f, 1.6f, 2.0f};
    for (int i = 0; i < 3; ++i) {
        const double omega = (double)omegas[i];
        trail t = trail_of(trail_slab, 1, 1.01f);
        listing in = trail_listing(&t);
        oracle_run run = oracle_first_run;
        (void)keinert_listing_2(&in, 0, 100, omegas[i], 1e-4f, 0);
        /* f(o) and the start are one place, then the probe, then the fallback */
        CHECK_SAY(fabs((double)t.z[2] - omega * (2 - omega)) < 1e-6, "%g", (double)t.z[2]);
        while (omega < 2 && oracle_next(&run, 0)) {
            spt_settings settings = oracle_settings(&run);
            const spt_ray ray = trail_ray(0, 100);
            settings.relaxation = omegas[i];
            (void)trail_trace(&t, &settings, &ray);
            if (run.rule == REFERENCE_RELAXED) CHECK(t.count == 3 && check_same_bits(t.z[2], 1));
        }
    }
}

/* Listing 2 tests |f|: head-on a probe behind a wall passes at equality, and so does one behind a
 * sheet, in float as rounding has it. */
static void P13_head_on(void) {
    enum { sheets = 400 };
    trail t = trail_of(trail_wall, 1, 1);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    const spt_ray ray = trail_ray(0, INFINITY);
    float places[sheets];
    int missed = 0;
    (void)keinert_listing_2(&in, 0, 100, 1.6f, 1e-4f, 0);
    CHECK_SAY(in.evaluations == 9, "%u", in.evaluations);
    for (int i = 0; i < sheets; ++i) {
        trail behind = trail_of(trail_sheet, 0, 0);
        float found;
        places[i] = behind.a = (float)(pow(10, check_uniform(0, 6)) + check_uniform(0, 1));
        in = trail_listing(&behind);
        found = keinert_listing_2(&in, 0, 1e7f, 1.6f, 1e-4f, 0);
        missed += !(found <= 1.01f * places[i]);
    }
    CHECK_SAY(missed * 2 > sheets, "%d of %d sheets missed", missed, sheets);
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        spt_hit hit;
        settings.relaxation = 1.6f;
        t = trail_of(trail_wall, 1, 1);
        hit = trail_trace(&t, &settings, &ray);
        check_hit(&hit, 1);
        CHECK_SAY(hit.evaluations <= 3, "%u", hit.evaluations);
        for (int i = 0; i < sheets; ++i) {
            t = trail_of(trail_sheet, places[i], 0);
            hit = trail_trace(&t, &settings, &ray);
            CHECK_SAY(hit.outcome == SPT_HIT, "sheet at %.9g: %d", (double)places[i], hit.outcome);
            CHECK(fabs((double)hit.t - (double)places[i]) <=
                  oracle_tolerance(&settings, &ray, (double)places[i]));
        }
    }
}

/* Listing 2 gives relaxation up for good after the first failure. */
static void P14_rearms(void) {
    trail t = trail_of(trail_passed, 100, 0);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    uint32_t latched;
    int failed = 0;
    (void)keinert_listing_2(&in, 0, 200, 1.9f, 1e-6f, 0);
    latched = in.evaluations - 1; /* without f(o) */
    for (int i = 1; i + 1 < t.count; ++i) {
        const double step = (double)t.z[i + 1] - (double)t.z[i];
        const double r = (double)trail_passed(&t, 0, 0, t.z[i]);
        if (failed) CHECK_SAY(step < r * (1 + 1e-6) + 1e-5, "step %g at r %g", step, r);
        if (step < 0) failed = 1;
    }
    CHECK(failed);
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 200);
        spt_hit hit;
        settings.relaxation = 1.9f;
        hit = trail_trace(&t, &settings, &ray);
        check_hit(&hit, 100);
        if (run.rule != REFERENCE_RELAXED) continue;
        CHECK(hit.fallbacks > 0);
        CHECK_SAY(hit.evaluations < latched, "%u, latched %u", hit.evaluations, latched);
    }
}

/* The text of Keinert 3.2 returns the best candidate, Listing 2 infinity unless it is forced. */
static void P15_candidate_stands_beside(void) {
    trail t = trail_of(trail_grazed, 0.1f, 0);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    float forced;
    CHECK(isinf(keinert_listing_2(&in, 0, 1000, 1.2f, 1e-4f, 0)));
    forced = keinert_listing_2(&in, 0, 1000, 1.2f, 1e-4f, 1);
    CHECK(forced > 1 && forced < 1000);
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 1000);
        const spt_hit hit = trail_trace(&t, &settings, &ray);
        CHECK_SAY(hit.outcome == SPT_LIMIT, "%d", hit.outcome);
        CHECK_SAY(hit.evaluations == settings.budget, "%u", hit.evaluations);
        CHECK(check_same_bits(hit.residual, 0.1f));
        /* f is constant: the least ratio is the last one; one division in float */
        CHECK(check_same_bits(hit.candidate_t, hit.t));
        CHECK(fabs((double)hit.candidate_ratio * (double)hit.t / (double)0.1f - 1) < 0x1p-22);
    }
}

/* Of equal ratios the earlier counts. */
static void P15_first_of_equals(void) {
    trail t = trail_of(trail_wall, 0, -0.5f); /* f = z / 2 */
    oracle_run run = oracle_first_run;
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(1, 1000);
        const spt_hit hit = trail_trace(&t, &settings, &ray);
        CHECK(hit.outcome == SPT_MISS && hit.evaluations > 1);
        CHECK(check_same_bits(hit.candidate_t, 1) && check_same_bits(hit.candidate_ratio, 0.5f));
    }
}

/* Listing 2 measures pixels from the ray's own origin: at the start of a secondary ray they have no
 * size. Here the path is 100 long and a pixel's radius there 0.1. */
static void P16_secondary_rays_inherit_the_cone(void) {
    trail t = trail_of(trail_wall, 0.01f, 0.5f);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    static const float path = 100;
    CHECK(keinert_listing_2(&in, 0, 100, 1.2f, 1e-3f, 0) > 0.009f);
    CHECK_SAY(in.evaluations > 5, "%u", in.evaluations);
    while (oracle_next(&run, 0)) {
        spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 100);
        spt_rays rays = spt_rays_of(&ray);
        spt_field field = spt_field_default();
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        settings.pixel_radius = 1e-3f;
        settings.epsilon = 1e-6f;
        field.point = trail_listen;
        field.user = &t;
        CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
        CHECK(hit.evaluations > 1 && hit.t > 0.009f);
        rays.path.first = &path;
        CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
        CHECK(hit.outcome == SPT_HIT && hit.evaluations == 1 && check_same_bits(hit.t, 0));
    }
}

static float reversed(void *user, float x, float y, float z) {
    return -trail_steep(user, x, y, z);
}

/* Keinert Equation 1 inside, f <= -dist, lets |f| exceed the distance: traced on -f by Listing 1
 * the exit at 1.5 is found at 3. */
static void P17_bound_inside(void) {
    trail t = trail_of(reversed, -0.6f, 1.5f);
    listing in = trail_listing(&t);
    oracle_run run = oracle_first_run;
    CHECK(fabs((double)keinert_listing_1(&in, 0, 100, 1e-4f) - 3) < 1e-6);
    t.distance = trail_steep;
    while (oracle_next(&run, 0)) {
        const spt_settings settings = oracle_settings(&run);
        const spt_ray ray = trail_ray(0, 100);
        spt_field field = spt_field_default();
        spt_hit hit = trail_trace(&t, &settings, &ray);
        check_hit(&hit, 1.5); /* the bracket found it, and says that f is no bound */
        CHECK(hit.flags == (SPT_FLAG_STEEP | SPT_FLAG_INSIDE));
        field.point = trail_listen;
        field.user = &t;
        field.lipschitz = 5;
        hit = oracle_trace_one(&field, &settings, &ray);
        check_hit(&hit, 1.5);
        CHECK(hit.flags == SPT_FLAG_INSIDE);
    }
}

void suite_papers(void) {
    RUN(P1_enhanced_starts_plain);
    RUN(P2_leaving_head_on);
    RUN(P3_fallbacks_count);
    RUN(P7_three_omegas);
    RUN(P7_three_ranges);
    RUN(P8_sign_of_first_sample);
    RUN(P9_no_division_by_t);
    RUN(P10_end_of_the_ray);
    RUN(P11_probe_past_the_end);
    RUN(P12_fallback_lands_on_r);
    RUN(P13_head_on);
    RUN(P14_rearms);
    RUN(P15_candidate_stands_beside);
    RUN(P15_first_of_equals);
    RUN(P16_secondary_rays_inherit_the_cone);
    RUN(P17_bound_inside);
}
