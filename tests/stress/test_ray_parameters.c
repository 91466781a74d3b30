/* SPDX-License-Identifier: MIT
 *
 * Rows R1 to R11: rays of any length, reach and badness. What a ray brings is data: a bad one ends
 * with SPT_BAD_RAY and is never evaluated. */
#include "stress.h"

#include <float.h>
#include <math.h>

static void expect_bad(stress_way *way, const stress_case *what) {
    const spt_hit hit = stress_run(way, what, NULL);
    stress_expect(&hit, SPT_BAD_RAY, 0.0, 0.0);
}

static void R1_zero_direction(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int signs = 0; signs < 8; ++signs) {
            stress_case what = stress_base();
            for (int axis = 0; axis < 3; ++axis) {
                what.ray.direction[axis] = (signs >> axis & 1) != 0 ? -0.0f : 0.0f;
            }
            expect_bad(&way, &what);
        }
    }
}

static void R2_component_not_finite(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity()};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 9; ++i) {
            stress_case what = stress_base();
            what.ray.origin[i / 3] = bad[i % 3];
            expect_bad(&way, &what);
            what = stress_base();
            what.ray.direction[i / 3] = bad[i % 3];
            expect_bad(&way, &what);
        }
    }
}

/* The surface point is that of the unit direction, after as many evaluations but one. */
static void expect_same_point(stress_way *way, float length, float t_max) {
    stress_case what = stress_base();
    const spt_hit unit = stress_run(way, &what, NULL);
    what.ray.direction[2] = length;
    what.ray.t_max = t_max;
    const spt_hit hit = stress_run(way, &what, NULL);
    CHECK(hit.outcome == SPT_HIT);
    CHECK_SAY(stress_within((double)hit.t * (double)length, 9.0,
                            stress_tolerance(&what, hit.t) + 4.0 * stress_ulp(9.0)),
              "direction %.9g, t %.9g", (double)length, (double)hit.t);
    stress_expect_evaluations(&hit, unit.evaluations - 1, unit.evaluations + 1);
}

static void R3_long_directions(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        expect_same_point(&way, 2.0f, 100.0f);
        expect_same_point(&way, 3.0f, 100.0f);
        expect_same_point(&way, 20.0f, 100.0f);
    }
}

static void R4_short_direction(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        expect_same_point(&way, 1e-3f, 1e5f);
    }
}

static void R5_empty_interval(void) {
    const float limits[][2] = {{5.0f, 1.0f}, {0.0f, -1.0f}, {0.0f, -stress_infinity()}};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 3; ++i) {
            stress_case what = stress_base();
            what.ray.t_min = limits[i][0];
            what.ray.t_max = limits[i][1];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 0, 0);
        }
    }
}

static void R6_interval_of_one_point(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_base();
        what.ray.t_min = what.ray.t_max = 5.0f;
        spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 1);
        what.ray.t_min = what.ray.t_max = 9.0f;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 9.0, 0.0);
        stress_expect_evaluations(&hit, 1, 1);
    }
}

static void R7a_limits_not_numbers(void) {
    const float infinity = stress_infinity();
    const float starts[] = {stress_nan(), -5.0f, infinity, -infinity};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_base();
            what.ray.t_min = starts[i];
            expect_bad(&way, &what);
            what.ray.t_max = infinity;
            expect_bad(&way, &what);
        }
        stress_case what = stress_base();
        what.ray.t_max = stress_nan();
        expect_bad(&way, &what);
    }
}

static void R7b_path_not_a_number(void) {
    const float paths[] = {stress_nan(), -1.0f, stress_infinity(), -stress_infinity()};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_base();
            what.path = paths[i];
            expect_bad(&way, &what);
        }
    }
}

static void R8_rays_without_end(void) {
    const float ends[] = {stress_infinity(), FLT_MAX};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_base();
            what.settings.budget = 1000;
            if (i < 2) {
                what.ray.direction[2] = -1.0f;
            } else {
                what.ray.origin[0] = 3e38f;
                what.ray.origin[1] = what.ray.origin[2] = i == 2 ? 0.0f : 3e38f;
                what.ray.direction[0] = 1.0f;
                what.ray.direction[2] = 0.0f;
            }
            what.ray.t_max = ends[i < 2 ? i : 0];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 1, 66);
        }
    }
}

/* The same without the help of a distance that overflows: f keeps finite values up to the end. */
static void R8b_endless_ray_from_a_floor(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_case_of(stress_floor_distance, NULL);
        what.ray.origin[1] = 1.0f;
        what.ray.direction[1] = 1.0f;
        what.ray.direction[2] = 0.0f;
        what.ray.t_max = stress_infinity();
        const spt_hit hit = stress_run(&way, &what, NULL); /* positions audited by the callback */
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
    }
}

static float wall_at_50(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return 50.0f - z;
}

static void R9_surface_at_t_max(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_case_of(wall_at_50, NULL);
        what.ray.t_max = 50.0f;
        stress_probe probe;
        const spt_hit hit = stress_run(&way, &what, &probe);
        stress_expect(&hit, SPT_HIT, 50.0, 0.0); /* every step is exact */
        CHECK(check_same_bits(probe.position[probe.recorded - 1][2], 50.0f));
    }
}

static void R10_start_on_the_surface(void) {
    static const stress_sphere behind = {{0.0f, 0.0f, -1.0f}, 1.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_case_of(stress_sphere_distance, &behind);
        spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 0.0, 0.0);
        stress_expect_evaluations(&hit, 1, 1);
        what.settings.flags = SPT_SKIP_START;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_MISS, 0.0, 0.0);
        CHECK(hit.evaluations >= 2); /* one in the band, one to know that it is left */
    }
}

/* ---- R11: scaled directions ---------------------------------------------------------------- */

static const stress_sphere off_axis = {{0.3f, 0.2f, 10.0f}, 1.0f};

static stress_case slanted(void) {
    stress_case what = stress_case_of(stress_sphere_distance, &off_axis);
    what.ray.direction[0] = 0.02f;
    what.ray.direction[1] = 0.01f;
    what.ray.direction[2] = 0.9997f;
    return what;
}

static void R11a_direction_times_power_of_two(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const stress_case unit = slanted();
        const spt_hit expected = stress_run(&way, &unit, NULL);
        CHECK(expected.outcome == SPT_HIT);
        for (int k = -90; k <= 90; ++k) {
            stress_case what = unit;
            for (int axis = 0; axis < 3; ++axis) {
                what.ray.direction[axis] = stress_scaled(what.ray.direction[axis], k);
            }
            what.ray.t_max = stress_scaled(what.ray.t_max, -k);
            spt_hit hit = stress_run(&way, &what, NULL);
            hit.t = stress_scaled(hit.t, k);
            hit.candidate_t = stress_scaled(hit.candidate_t, k);
            CHECK_SAY(stress_same_hit(&hit, &expected), "2^%d: t %.9g, %u evaluations", k,
                      (double)hit.t, (unsigned)hit.evaluations);
        }
    }
}

static void R11b_direction_times_other_factors(void) {
    static const float factors[] = {3.0f, 1e-30f, 1e30f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const stress_case unit = slanted();
        const spt_hit expected = stress_run(&way, &unit, NULL);
        const double world = (double)expected.t * stress_length(unit.ray.direction);
        for (int i = 0; i < 3; ++i) {
            stress_case what = unit;
            for (int axis = 0; axis < 3; ++axis) what.ray.direction[axis] *= factors[i];
            what.ray.t_max /= factors[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            const double seen = (double)hit.t * stress_length(what.ray.direction);
            CHECK(hit.outcome == SPT_HIT);
            CHECK_SAY(stress_within(seen, world, 4.0 * stress_ulp(world)),
                      "factor %.9g: %.9g, expected %.9g", (double)factors[i], seen, world);
        }
    }
}

static void R11c_denormal_direction(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = slanted();
        for (int axis = 0; axis < 3; ++axis) {
            what.ray.direction[axis] = (float)((double)what.ray.direction[axis] * 1e-40);
        }
        what.ray.t_max = stress_infinity();
        expect_bad(&way, &what);
        what = stress_base(); /* FLT_MIN itself is a direction, the float below it is not */
        what.ray.t_max = stress_infinity();
        what.ray.direction[2] = stress_from_bits(check_bits(FLT_MIN) - 1);
        expect_bad(&way, &what);
        what.ray.direction[2] = FLT_MIN;
        const spt_hit hit = stress_run(&way, &what, NULL);
        CHECK(hit.outcome != SPT_BAD_RAY);
    }
}

void suite_ray_parameters(void) {
    RUN(R1_zero_direction);
    RUN(R2_component_not_finite);
    RUN(R3_long_directions);
    RUN(R4_short_direction);
    RUN(R5_empty_interval);
    RUN(R6_interval_of_one_point);
    RUN(R7a_limits_not_numbers);
    RUN(R7b_path_not_a_number);
    RUN(R8_rays_without_end);
    RUN(R8b_endless_ray_from_a_floor);
    RUN(R9_surface_at_t_max);
    RUN(R10_start_on_the_surface);
    RUN(R11a_direction_times_power_of_two);
    RUN(R11b_direction_times_other_factors);
    RUN(R11c_denormal_direction);
}
