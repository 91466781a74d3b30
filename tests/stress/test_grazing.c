/* SPDX-License-Identifier: MIT
 *
 * Rows D1 to D7: rays along and away from surfaces, budgets, and every real setting at and beyond
 * the ends of its range. */
#include "stress.h"

#include <float.h>
#include <math.h>

static stress_case above_floor(float height) {
    stress_case what = stress_case_of(stress_floor_distance, NULL);
    what.ray.origin[1] = height;
    return what;
}

/* ---- D1, D2: along a floor ----------------------------------------------------------------- */

static void D1_along_a_floor(void) {
    static const float heights[] = {1e-1f, 1e-2f, 1e-3f, 1e-4f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            const stress_case what = above_floor(heights[i]);
            const spt_hit hit = stress_run(&way, &what, NULL);
            if (way.method == spt_convex()) {
                stress_expect(&hit, SPT_MISS, 0.0, 0.0);
                stress_expect_evaluations(&hit, 1, 3);
            } else {
                CHECK_SAY(hit.outcome == SPT_LIMIT, "outcome %d", (int)hit.outcome);
                stress_expect_evaluations(&hit, 128, 128);
                CHECK(check_same_bits(stress_value(&what, hit.candidate_t), heights[i]));
                CHECK(hit.candidate_ratio < FLT_MAX);
            }
        }
    }
}

static void D1b_along_a_floor_to_its_end(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = above_floor(0.1f);
        what.settings.budget = 10000;
        const spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
    }
}

static void D2_on_a_floor(void) {
    static const float heights[] = {1e-5f, 1e-6f, 1e-7f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 3; ++i) {
            const stress_case what = above_floor(heights[i]);
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 0.0, 0.0);
            stress_expect_evaluations(&hit, 1, 1);
        }
    }
}

/* ---- D3: budgets --------------------------------------------------------------------------- */

static void D3_budgets(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_base();
        what.settings.budget = 0;
        spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_LIMIT, 0.0, 0.0);
        stress_expect_evaluations(&hit, 0, 0);
        CHECK(check_same_bits(hit.candidate_ratio, stress_infinity()));
        what.ray.t_min = 2.0f;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_LIMIT, 2.0, 0.0);
        what.ray.t_min = 0.0f;

        what.settings.budget = 1;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_LIMIT, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 1);
        CHECK(check_same_bits(hit.residual, 9.0f));

        what.settings.budget = 2; /* the plain step to 9 is exact, a relaxed one must come back */
        hit = stress_run(&way, &what, NULL);
        stress_expect_evaluations(&hit, 2, 2);
        if (way.method == spt_basic()) stress_expect(&hit, SPT_HIT, 9.0, 0.0);
        if (way.method == spt_relaxed()) stress_expect(&hit, SPT_LIMIT, 0.0, 0.0);

        what.settings.budget = 1000000;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 9.0, 1e-4);
    }
}

/* The budget that a ray used suffices, and one less does not. */
static void D3b_budget_used_is_budget_needed(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = above_floor(1.0f);
        what.ray.direction[1] = -0.25f;
        const spt_hit hit = stress_run(&way, &what, NULL);
        CHECK(hit.outcome == SPT_HIT && hit.evaluations >= 2);
        what.settings.budget = hit.evaluations;
        const spt_hit exact = stress_run(&way, &what, NULL);
        CHECK(stress_same_hit(&exact, &hit));
        what.settings.budget = hit.evaluations - 1;
        const spt_hit less = stress_run(&way, &what, NULL);
        CHECK(less.outcome == SPT_LIMIT);
    }
}

/* ---- D4: real settings --------------------------------------------------------------------- */

/* A setting with its legal range, and whether the ends belong to it. */
typedef struct real_setting {
    const char *name;
    size_t offset;
    float low, high;
    int with_low, with_high;
} real_setting;

#define REAL(name, low, high, with_low, with_high) \
    { #name, offsetof(spt_settings, name), low, high, with_low, with_high }

static const real_setting real_settings[] = {
    REAL(relaxation, 1.0f, 2.0f, 1, 0),  REAL(extrapolation, 0.0f, 1.0f, 1, 1),
    REAL(slope_blend, 0.0f, 1.0f, 0, 1), REAL(step_cap, 1.0f, 100.0f, 1, 1),
    REAL(epsilon, 0.0f, FLT_MAX, 0, 1),  REAL(pixel_radius, 0.0f, FLT_MAX, 1, 1),
    REAL(size, 0.0f, FLT_MAX, 1, 1),
};
enum { real_count = sizeof real_settings / sizeof real_settings[0] };

static float *real_of(stress_case *what, const real_setting *setting) {
    return (float *)(void *)((char *)&what->settings + setting->offset);
}

static int legal(const real_setting *setting, float value) {
    if (stress_is_nan(value) || value < setting->low || value > setting->high) return 0;
    if (!(value > setting->low) && !setting->with_low) return 0;
    return value < setting->high || setting->with_high;
}

static void D4_settings_out_of_range(void) {
    const float values[] = {-1.0f,       0.0f,
                            0.5f,        2.0f,
                            2.5f,        10.0f,
                            101.0f,      1e30f,
                            -1e30f,      stress_infinity(),
                            -1e-45f,     -stress_infinity(),
                            stress_nan()};
    const int count = (int)(sizeof values / sizeof values[0]);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        int refused = 0;
        for (int i = 0; i < real_count; ++i) {
            for (int j = 0; j < count; ++j) {
                if (legal(&real_settings[i], values[j])) continue;
                stress_case what = stress_base();
                *real_of(&what, &real_settings[i]) = values[j];
                stress_refused(&way, &what);
                ++refused;
            }
        }
        CHECK(refused > 40);
    }
}

static void D4b_just_beyond_the_ends(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < real_count; ++i) {
            const real_setting *setting = &real_settings[i];
            for (int high = 0; high < 2; ++high) {
                const float end = high ? setting->high : setting->low;
                const float outer = nextafterf(end, high ? stress_infinity() : -stress_infinity());
                stress_case what = stress_base();
                *real_of(&what, setting) =
                    (high ? setting->with_high : setting->with_low) ? outer : end;
                stress_refused(&way, &what);
            }
        }
    }
}

/* The values that are least and most legal, where the base scene still has its hit. */
static void D4c_ends_of_the_ranges(void) {
    static const float ends[][3] = {
        {1.0f, 1.99999988f, 1.5f}, {0.0f, 1.0f, 0.5f},   {1e-45f, 1.0f, 0.5f}, {1.0f, 100.0f, 2.0f},
        {1e-45f, 1e-3f, 1e-12f},   {0.0f, 1e-5f, 1e-4f}, {0.0f, 100.0f, 1.0f}};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < real_count; ++i) {
            for (int j = 0; j < 3; ++j) {
                stress_case what = stress_base();
                CHECK(legal(&real_settings[i], ends[i][j]));
                *real_of(&what, &real_settings[i]) = ends[i][j];
                const spt_hit hit = stress_run(&way, &what, NULL);
                stress_expect(&hit, SPT_HIT, 9.0,
                              stress_tolerance(&what, hit.t) + 4.0 * stress_ulp(9.0));
            }
        }
    }
}

static void D4d_lipschitz(void) {
    const float bad[] = {0.0f,
                         -0.0f,
                         -1.0f,
                         stress_nan(),
                         stress_infinity(),
                         -stress_infinity(),
                         stress_scaled(1.0f, -101),
                         stress_scaled(1.0f, 101),
                         nextafterf(stress_scaled(1.0f, -100), 0.0f),
                         nextafterf(stress_scaled(1.0f, 100), FLT_MAX)};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 10; ++i) {
            stress_case what = stress_base();
            what.lipschitz = bad[i];
            stress_refused(&way, &what);
        }
    }
}

/* ---- D5, D6: past and away ----------------------------------------------------------------- */

static void D5_past_a_sphere(void) {
    static const stress_sphere beside = {{0.0f, 5.0f, 10.0f}, 1.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const stress_case what = stress_case_of(stress_sphere_distance, &beside);
        const spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        CHECK_SAY(hit.candidate_ratio >= 0.365f && hit.candidate_ratio <= 0.5f, "ratio %.9g",
                  (double)hit.candidate_ratio);
        const double ratio = (double)stress_value(&what, hit.candidate_t) / (double)hit.candidate_t;
        CHECK(stress_within((double)hit.candidate_ratio, ratio, 4.0 * stress_ulp(ratio)));
    }
}

/* The longest step over r that a rule may take: for enhanced, m is clamped at -0.98, so
 * 1 + k (1 - m) / (1 + m) with k the weight of the extrapolation; auto_relaxed: 2 / (1 - 0.98). */
static double longest_step(const spt_method *method) {
    const spt_settings settings = spt_settings_default();
    if (method == spt_relaxed()) return (double)settings.relaxation;
    if (method == spt_enhanced()) return 1.0 + (double)settings.extrapolation * 99.0;
    if (method == spt_auto_relaxed()) return 100.0;
    if (method == spt_adaptive()) return (double)settings.step_cap;
    return 1.0;
}

static void D6_straight_away_from_a_floor(void) {
    static stress_probe probe;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int endless = 0; endless < 2; ++endless) {
            stress_case what = above_floor(1.0f);
            what.ray.direction[1] = 1.0f;
            what.ray.direction[2] = 0.0f;
            what.ray.t_max = endless ? stress_infinity() : 100.0f;
            const spt_hit hit = stress_run(&way, &what, &probe);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            const double limit = longest_step(way.method);
            for (size_t i = 1; i < probe.recorded; ++i) { /* r = y, the position itself */
                const double r = (double)probe.position[i - 1][1];
                const double step = (double)probe.position[i][1] - r;
                const int last = i + 1 == probe.recorded; /* may be cut by the end of the ray */
                CHECK_SAY(step <= limit * r * (1.0 + 1e-5) && (last || step >= r * (1.0 - 1e-5)),
                          "step %.9g from r %.9g", step, r);
            }
        }
    }
}

/* ---- D7: towards and away from a floor at a small angle ------------------------------------- */

static stress_case sloping(double slope) {
    stress_case what = above_floor(1.0f);
    const double length = sqrt(1.0 + slope * slope);
    what.ray.direction[1] = (float)(slope / length);
    what.ray.direction[2] = (float)(1.0 / length);
    what.ray.t_max = 1e4f;
    return what;
}

/* The rules whose step is r + 0.88 r (1 - m)/(1 + m), with m the sine of the angle. */
static int extrapolates(const spt_method *method) {
    return method == spt_enhanced() || method == spt_adaptive();
}

/* Counts of basic and of the extrapolating rules. With sine c a plain step leaves 1 - c of the
 * residual: 1 + ceil(ln 1e-4 / ln(1 - c)) = 89 and 918 evaluations. Extrapolated steps leave 0.829
 * and 0.98137: 51 and 492. But at t = 100 a probe must overlap by floor(t) = 2.4e-5 more than
 * touch, and it overlaps by (2 - 1.8626 (1 + c)) r = 0.119 r only; below r = 2.03e-4 it fails, and
 * every plain step costs two evaluations: ln(2.03) / c = 71 steps, 142 evaluations instead
 * of 38. (At 1 / c = 1000 floor(t) itself, 2.4e-4, is the tolerance.) */
static void check_counts(const stress_way *way, int place, const spt_hit *hit) {
    if (way->method == spt_basic()) {
        if (place == 0) stress_expect_evaluations(hit, 89, 89);
        if (place == 1) stress_expect_evaluations(hit, 918, 918);
    } else if (extrapolates(way->method)) {
        if (place == 0) stress_expect_evaluations(hit, 51, 51);
        if (place == 1) stress_expect_evaluations(hit, 492, 492 + 104);
    }
}

static void D7_sinking_to_a_floor(void) {
    static const double slopes[] = {0.1, 0.01, 0.001};
    static const uint32_t budgets[] = {128, 1000, 10000};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 3; ++i) {
            stress_case what = sloping(-slopes[i]);
            spt_hit hit = {0.0f, 0.0f, 0, 0, 0, 0, 0.0f, 0.0f, 0};
            for (int less = 0; less <= i; ++less) {
                what.settings.budget = budgets[less];
                hit = stress_run(&way, &what, NULL);
                CHECK_SAY(hit.outcome == SPT_HIT || hit.outcome == SPT_LIMIT, "outcome %d",
                          (int)hit.outcome);
                if (way.method != spt_convex() && less == 0 && i > 0) {
                    CHECK(hit.outcome == SPT_LIMIT);
                }
            }
            CHECK_SAY(hit.outcome == SPT_HIT, "slope %g: outcome %d", slopes[i], (int)hit.outcome);
            check_counts(&way, i, &hit);
        }
    }
}

static void D7b_rising_from_a_floor(void) {
    static const double slopes[] = {0.1, 0.01, 0.001};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 3; ++i) {
            stress_case what = sloping(slopes[i]);
            what.ray.t_max = 1e3f;
            spt_hit hit = stress_run(&way, &what, NULL);
            CHECK_SAY(hit.outcome == SPT_MISS || hit.outcome == SPT_LIMIT, "outcome %d",
                      (int)hit.outcome);
            what.settings.budget = 1000;
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        }
    }
}

void suite_grazing(void) {
    RUN(D1_along_a_floor);
    RUN(D1b_along_a_floor_to_its_end);
    RUN(D2_on_a_floor);
    RUN(D3_budgets);
    RUN(D3b_budget_used_is_budget_needed);
    RUN(D4_settings_out_of_range);
    RUN(D4b_just_beyond_the_ends);
    RUN(D4c_ends_of_the_ranges);
    RUN(D4d_lipschitz);
    RUN(D5_past_a_sphere);
    RUN(D6_straight_away_from_a_floor);
    RUN(D7_sinking_to_a_floor);
    RUN(D7b_rising_from_a_floor);
}
