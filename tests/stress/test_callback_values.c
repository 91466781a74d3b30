/* SPDX-License-Identifier: MIT
 *
 * Rows A1 to A7 and A10: what a callback may return and what comes of it. Values that poison one ray must
 * not reach another, and no comparison may mistake NaN for a hit. A8 and A9 are in
 * test_callback_arrays.c. */
#include "stress.h"

#include <spheretrace/simd.h>

#include <float.h>
#include <math.h>

/* A value that takes the place of the distance in part of space, around the base sphere. */
typedef struct poison {
    float value;
    float from_z; /* where z is greater */
    float at_x;   /* for rays of this x alone, anywhere on them */
    int inside;   /* inside the sphere */
} poison;

static float poisoned_distance(const void *data, float x, float y, float z) {
    const poison *bad = data;
    const float dz = z - 10.0f;
    const float distance = sqrtf(x * x + y * y + dz * dz) - 1.0f;
    if (z > bad->from_z || check_same_bits(x, bad->at_x)) return bad->value;
    if (bad->inside && distance < 0.0f) return bad->value;
    return distance;
}

static const poison harmless = {0.0f, FLT_MAX, FLT_MAX, 0};

/* ---- A1: NaN ------------------------------------------------------------------------------- */

static void A1a_nan_beyond_z5(void) {
    poison bad = harmless;
    bad.value = stress_nan();
    bad.from_z = 5.0f;
    const stress_case what = stress_case_of(poisoned_distance, &bad);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_NONFINITE, 9.0, 0.0);
        stress_expect_evaluations(&hit, 1, 3);
        CHECK(stress_is_nan(hit.residual));
    }
}

static void A1b_nan_everywhere(void) {
    const float nan = stress_nan();
    stress_case what = stress_case_of(stress_constant_distance, &nan);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int start = 0; start < 3; ++start) {
            what.ray.t_min = (float)start;
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_NONFINITE, (double)start, 0.0);
            stress_expect_evaluations(&hit, 1, 1);
            CHECK(check_same_bits(hit.candidate_ratio, stress_infinity()));
        }
    }
}

static void A1c_nan_inside_the_sphere(void) {
    static const float relaxations[] = {1.2f, 1.4f, 1.6f, 1.9f};
    poison bad = harmless;
    bad.value = stress_nan();
    bad.inside = 1;
    stress_case what = stress_case_of(poisoned_distance, &bad);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            what.settings.relaxation = relaxations[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 9.0, 1e-4);
            if (way.method == spt_relaxed()) stress_expect_evaluations(&hit, 3, 3);
        }
    }
}

/* ---- A2: one ray among others -------------------------------------------------------------- */

/* value in place of the distance on one ray: the bits of all others are those of a run without
 * it. The rays are parallel and differ by x. */
static void poison_one(const stress_way *way, float value, int count, int place, float spacing) {
    spt_ray rays[16];
    spt_hit hits[16], without[16];
    poison bad = harmless;
    stress_case what = stress_case_of(poisoned_distance, &bad);
    int others = 0;
    for (int i = 0; i < count; ++i) {
        rays[i] = what.ray;
        rays[i].origin[0] = spacing * (float)i;
    }
    const spt_ray poisoned = rays[place];
    bad.value = value;
    bad.at_x = poisoned.origin[0];
    stress_run_many(way, &what, (size_t)count, rays, hits);
    const spt_hit hit = hits[place];
    for (int i = 0; i < count; ++i) {
        if (i == place) continue;
        rays[others] = rays[i];
        hits[others] = hits[i];
        ++others;
    }
    stress_run_many(way, &what, (size_t)others, rays, without);
    for (int i = 0; i < others; ++i) CHECK(stress_same_hit(&hits[i], &without[i]));

    what.ray = poisoned;
    stress_check_hit(&what, &hit);
    stress_expect_evaluations(&hit, 1, 2);
    if (stress_is_nan(value) || value < 0.0f) {
        stress_expect(&hit, SPT_NONFINITE, 0.0, 0.0);
        CHECK(check_same_bits(hit.residual, value));
    } else if (value > 1.0f) {
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
    } else {
        stress_expect(&hit, SPT_HIT, 0.0, 0.0);
    }
}

static void A2_one_bad_ray_among_others(void) {
    const float values[] = {stress_nan(), stress_infinity(), -stress_infinity(), 1e-42f, 3e38f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int v = 0; v < 5; ++v) {
            poison_one(&way, values[v], 8, 3, 0.1f);
            for (int place = 0; place < 16; ++place) {
                poison_one(&way, values[v], 16, place, 0.05f);
            }
        }
    }
}

/* ---- A3 to A6: infinities, denormals, zeros ------------------------------------------------ */

static void A3_plus_infinity(void) {
    const float infinity = stress_infinity();
    stress_case everywhere = stress_case_of(stress_constant_distance, &infinity);
    poison bad = harmless;
    bad.value = infinity;
    bad.from_z = 5.0f;
    const stress_case beyond = stress_case_of(poisoned_distance, &bad);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        everywhere.ray.t_max = 100.0f;
        spt_hit hit = stress_run(&way, &everywhere, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 2);
        everywhere.ray.t_max = infinity;
        hit = stress_run(&way, &everywhere, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 2);
        hit = stress_run(&way, &beyond, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 3);
    }
}

static void A4_minus_infinity(void) {
    const float infinity = -stress_infinity(), largest = -FLT_MAX;
    stress_case endless = stress_case_of(stress_constant_distance, &infinity);
    stress_case finite = stress_case_of(stress_constant_distance, &largest);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int start = 0; start < 2; ++start) {
            endless.ray.t_min = finite.ray.t_min = 3.0f * (float)start;
            spt_hit hit = stress_run(&way, &endless, NULL);
            stress_expect(&hit, SPT_NONFINITE, 3.0 * start, 0.0);
            stress_expect_evaluations(&hit, 1, 1);
            CHECK(check_same_bits(hit.residual, infinity));
            hit = stress_run(&way, &finite, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 1, 2);
            CHECK(hit.flags == SPT_FLAG_INSIDE);
        }
    }
}

static void A5_denormal_distance(void) {
    const float tiny = 1e-42f;
    stress_case what = stress_case_of(stress_constant_distance, &tiny);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        what.settings.epsilon = 1e-4f;
        spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 1);
        what.settings.epsilon = 1e-45f;
        hit = stress_run(&way, &what, NULL);
        CHECK_SAY(hit.outcome == SPT_LIMIT || hit.outcome == SPT_HIT ||
                      (way.method == spt_convex() && hit.outcome == SPT_MISS),
                  "outcome %d", (int)hit.outcome);
        what.settings.epsilon = 0.0f;
        stress_refused(&way, &what);
    }
}

static void A6_zero_everywhere(void) {
    static const float zeros[] = {0.0f, -0.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_case_of(stress_constant_distance, &zeros[i % 2]);
            what.ray.t_min = (float)(i / 2);
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, (double)what.ray.t_min, 0.0);
            stress_expect_evaluations(&hit, 1, 1);
            CHECK(hit.flags == 0);
            CHECK(check_same_bits(hit.residual, zeros[i % 2]));
        }
    }
}

/* ---- A7: starts inside --------------------------------------------------------------------- */

static void A7_starts_inside(void) {
    static const stress_sphere around = {{0.0f, 0.0f, 0.0f}, 2.0f};
    static const stress_sphere ahead = {{0.0f, 0.0f, 10.0f}, 3.0f};
    stress_case origin_inside = stress_case_of(stress_sphere_distance, &around);
    stress_case origin_inside_start_outside = origin_inside;
    stress_case start_inside = stress_case_of(stress_sphere_distance, &ahead);
    origin_inside_start_outside.ray.t_min = 3.0f;
    start_inside.ray.t_min = 10.0f;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (uint32_t flags = 0; flags <= SPT_STOP_INSIDE; flags += SPT_STOP_INSIDE) {
            const int stop = flags != 0;
            origin_inside.settings.flags = start_inside.settings.flags = flags;
            origin_inside_start_outside.settings.flags = flags;
            spt_hit hit = stress_run(&way, &origin_inside, NULL);
            stress_expect(&hit, SPT_HIT, stop ? 0.0 : 2.0, stop ? 0.0 : 1e-4);
            CHECK(hit.flags == SPT_FLAG_INSIDE);
            if (stop) stress_expect_evaluations(&hit, 1, 1);
            hit = stress_run(&way, &origin_inside_start_outside, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            CHECK(hit.flags == 0);
            hit = stress_run(&way, &start_inside, NULL);
            stress_expect(&hit, SPT_HIT, stop ? 10.0 : 13.0, stop ? 0.0 : 1e-4);
            CHECK(hit.flags == SPT_FLAG_INSIDE);
            if (stop) stress_expect_evaluations(&hit, 1, 1);
        }
    }
}

/* ---- A10: one rule for the lesser and the greater ------------------------------------------ */

static void A10a_lane_minimum_and_maximum(void) {
    const float values[] = {stress_nan(),      -stress_nan(),      0.0f,  -0.0f, 5.0f, -5.0f,
                            stress_infinity(), -stress_infinity(), 1e-42f};
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 9; ++j) {
            const float a = values[i], b = values[j];
            float least[SPT_LANES], greatest[SPT_LANES];
            spt_store(least, spt_min(spt_splat(a), spt_splat(b)));
            spt_store(greatest, spt_max(spt_splat(a), spt_splat(b)));
            for (int lane = 0; lane < SPT_LANES; ++lane) {
                CHECK(check_same_bits(least[lane], a < b ? a : b));
                CHECK(check_same_bits(greatest[lane], a > b ? a : b));
            }
        }
    }
}

/* What a ray brings is never lost in a minimum: NaN in a limit shows as SPT_BAD_RAY, whatever
 * bound and interval it is combined with; zeros of either sign start at the same place. */
static void A10b_nan_in_the_limits_of_a_bounded_ray(void) {
    const spt_bound box = spt_bound_box(-2.0f, -2.0f, 7.0f, 2.0f, 2.0f, 12.0f);
    stress_case what = stress_base();
    what.bound = &box;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int sign = 0; sign < 2; ++sign) {
            const float nan = sign ? -stress_nan() : stress_nan();
            what.ray = stress_base().ray;
            what.ray.t_min = nan;
            spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_BAD_RAY, 0.0, 0.0);
            what.ray = stress_base().ray;
            what.ray.t_max = nan;
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_BAD_RAY, 0.0, 0.0);
            what.ray = stress_base().ray;
            what.ray.t_min = sign ? -0.0f : 0.0f;
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 9.0, 1e-4);
        }
    }
}

void suite_callback_values(void) {
    RUN(A1a_nan_beyond_z5);
    RUN(A1b_nan_everywhere);
    RUN(A1c_nan_inside_the_sphere);
    RUN(A2_one_bad_ray_among_others);
    RUN(A3_plus_infinity);
    RUN(A4_minus_infinity);
    RUN(A5_denormal_distance);
    RUN(A6_zero_everywhere);
    RUN(A7_starts_inside);
    RUN(A10a_lane_minimum_and_maximum);
    RUN(A10b_nan_in_the_limits_of_a_bounded_ray);
}
