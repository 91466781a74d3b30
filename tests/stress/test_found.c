/* SPDX-License-Identifier: MIT
 *
 * Cases at the ends of the ranges of numbers, budgets and strides that went wrong once, named by
 * the rows they extend: A5, D8, E2, E5, F2, F7, R12, R13. What measuring a field does with bad
 * clocks is in test_measure.c. */
#include "stress.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const float zero = 0.0f;

/* ---- A5c, R12, R13: the ends of the numbers ------------------------------------------------- */

/* epsilon underflows in the units of most of these rays; f = 0 is within any. */
static void A5c_least_epsilon_is_met_by_zero(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int exponent = -120; exponent <= 120; exponent += 20) {
            stress_case what = stress_case_of(stress_constant_distance, &zero);
            what.settings.epsilon = 1e-45f;
            what.ray.t_max = stress_infinity();
            for (int axis = 0; axis < 3; ++axis) {
                what.ray.direction[axis] = stress_scaled(1.9f, exponent);
            }
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 0, 0);
            stress_expect_evaluations(&hit, 1, 1);
            CHECK(hit.flags == 0);
        }
    }
}

/* path + t is beyond FLT_MAX, the pixel cone is not, and f is larger than that: no hit. */
static void R12_path_near_the_largest_number(void) {
    static const float value = 1e36f;
    static const float lengths[] = {1.0f, 1.9f, 0x1p60f, 0x1p-60f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_case_of(stress_constant_distance, &value);
            stress_probe probe;
            spt_hit hit;
            what.path = FLT_MAX;
            what.settings.pixel_radius = 1e-3f; /* a cone of 3.4e35 to 4.3e35 */
            what.ray.direction[2] = lengths[i];
            what.ray.t_min = lengths[i] < 1 ? 0 : 6e37f / lengths[i];
            what.ray.t_max = stress_infinity();
            spt_rays rays = spt_rays_of(&what.ray);
            rays.path.first = &what.path;
            const spt_hits hits = spt_hits_of(&hit);
            const spt_settings settings = stress_settings(&way, &what);
            stress_probe_of(&probe, &what, 1);
            const spt_field field = stress_field(&way, &what, &probe);
            CHECK((double)value > 2 * stress_tolerance(&what, what.ray.t_min));
            CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
            CHECK_SAY(hit.outcome == SPT_MISS || hit.outcome == SPT_LIMIT, "outcome %d at t %.9g",
                      (int)hit.outcome, (double)hit.t);
            CHECK(hit.evaluations >= 1 && probe.faults == 0);
            CHECK(hit.candidate_ratio > 0 && hit.candidate_ratio < stress_infinity());
        }
    }
}

/* Where f = 0 the hit is at the first t, in the ray's own range also where the product of t and the
 * power of two of the direction is denormal, or zero. */
static void R13_the_range_of_t_holds_for_short_directions(void) {
    static const float lengths[] = {1.0f, 0.3f, 1e-3f, 1e-10f, 1e-20f, 1e-30f, FLT_MIN};
    static const float t_mins[] = {1e-45f, 3e-44f, 1e-40f, FLT_MIN, 1e-30f, 1e-20f, 1e-10f};
    static const float spans[] = {1.0f, 1.7f, 1e3f, 1e30f};
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 7 * 7 * 4; ++i) {
            stress_case what = stress_case_of(stress_constant_distance, &zero);
            what.ray.direction[2] = lengths[i % 7];
            what.ray.t_min = t_mins[i / 7 % 7];
            what.ray.t_max = what.ray.t_min * spans[i / 49];
            const spt_hit hit = stress_run(&way, &what, NULL);
            /* Nothing is lost of a product that is normal; else the range may be empty. */
            const int normal =
                (double)what.ray.t_min * (double)lengths[i % 7] >= 2.0 * (double)FLT_MIN;
            CHECK(hit.outcome == SPT_HIT || (hit.outcome == SPT_MISS && !normal));
        }
    }
}

/* A negative t_max makes a miss, also where its product with the power of two is -0. */
static void R13b_t_max_of_short_directions(void) {
    static const float value = 1.0f;
    static const float t_maxs[] = {0.0f, 1e-45f, 1e-40f, 1e-30f, 1e-20f, -1e-45f, -FLT_MIN};
    static const float lengths[] = {1.0f, 0.3f, 1e-10f, 1e-20f, 1e-30f, FLT_MIN};
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 7 * 6 * 2; ++i) {
            const int far = i & 1;
            stress_case what = stress_case_of(stress_constant_distance, far ? &value : &zero);
            what.ray.direction[2] = lengths[i / 2 % 6];
            what.ray.t_max = t_maxs[i / 12];
            const spt_hit hit = stress_run(&way, &what, NULL); /* the range is checked there */
            if (what.ray.t_max < 0.0f) {
                CHECK(hit.outcome == SPT_MISS && hit.evaluations == 0);
            } else {
                CHECK(hit.outcome == (far ? SPT_MISS : SPT_HIT));
            }
        }
    }
}

/* ---- D8: SPT_SKIP_START and budgets --------------------------------------------------------- */

/* Within the tolerance from the start to z = 9e-4, then the sphere of the base scene. */
static float late_distance(const void *data, float x, float y, float z) {
    (void)data;
    return z < 9e-4f ? 0.0f : stress_sphere_distance(stress_base().data, x, y, z);
}

/* Within it, and on the inner side. */
static float inner_distance(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z - 3e-5f;
}

/* Within it, then no number. */
static float broken_distance(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z < 9e-4f ? 0.0f : stress_nan();
}

static void check_budgets(stress_way *way, stress_case what, spt_outcome outcome) {
    what.settings.budget = 128;
    const spt_hit full = stress_run(way, &what, NULL);
    CHECK_SAY(full.outcome == (int32_t)outcome, "outcome %d", (int)full.outcome);
    CHECK(full.evaluations > 1);
    for (uint32_t budget = 0; budget <= full.evaluations; ++budget) {
        what.settings.budget = budget;
        const spt_hit hit = stress_run(way, &what, NULL);
        if (budget == full.evaluations) {
            CHECK_SAY(stress_same_hit(&hit, &full), "outcome %d with the budget %u it takes",
                      (int)hit.outcome, (unsigned)budget);
        } else {
            CHECK_SAY(hit.outcome == SPT_LIMIT && hit.evaluations == budget,
                      "outcome %d after %u of %u", (int)hit.outcome, (unsigned)hit.evaluations,
                      (unsigned)budget);
        }
    }
}

static void D8_skipping_counts_as_evaluations(void) {
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        for (uint32_t flags = 0; flags <= SPT_STOP_INSIDE; flags += SPT_STOP_INSIDE) {
            stress_case late = stress_case_of(late_distance, NULL);
            stress_case never = stress_case_of(stress_constant_distance, &zero);
            stress_case inner = stress_case_of(inner_distance, NULL);
            stress_case broken = stress_case_of(broken_distance, NULL);
            late.settings.flags = never.settings.flags = SPT_SKIP_START | flags;
            inner.settings.flags = broken.settings.flags = SPT_SKIP_START | flags;
            never.ray.t_max = 2.5e-4f;
            check_budgets(&way, late, SPT_HIT);
            check_budgets(&way, never, SPT_MISS);
            check_budgets(&way, inner, SPT_MISS);
            check_budgets(&way, broken, SPT_NONFINITE);
        }
    }
}

/* Never out of the band: each step is an evaluation, and all that are allowed are taken. */
static void D8b_large_budgets_are_used_up(void) {
    static const uint32_t budgets[] = {255, 256, 65535, 65536, 65537, 70000};
    for (stress_way way = stress_ways(STRESS_ONCE); stress_next(&way);) {
        for (int i = 0; i < 6; ++i) {
            if (budgets[i] > 65536 && way.method != spt_adaptive()) continue;
            stress_case what = stress_case_of(stress_constant_distance, &zero);
            what.settings.flags = SPT_SKIP_START;
            what.settings.budget = budgets[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            CHECK_SAY(hit.outcome == SPT_LIMIT && hit.evaluations == budgets[i],
                      "outcome %d after %u of %u", (int)hit.outcome, (unsigned)hit.evaluations,
                      (unsigned)budgets[i]);
        }
    }
}

/* ---- E2, E5: fields that are no distance bounds --------------------------------------------- */

static float leap_distance(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z < 0.4f ? 0.5f : 3e38f;
}

/* In units of the constant the slope is just below FLT_MAX, times the constant it is not. */
static void E5s_a_slope_beyond_the_largest_number(void) {
    static const float constants[] = {1.0f, 1.7f};
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        for (int i = 0; i < 2; ++i) {
            stress_case what = stress_case_of(leap_distance, NULL);
            what.lipschitz = constants[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            CHECK((hit.flags & SPT_FLAG_STEEP) != 0);
            CHECK_SAY(stress_slope > 1e37f && stress_slope <= FLT_MAX, "largest slope %g",
                      (double)stress_slope);
        }
    }
}

static float jump_distance(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return z < 1.003f ? 0.5f : -0.5f;
}

/* All rays of a chunk meet the jump in the same pass or nearly. */
static void E2d_many_brackets_in_one_pass(void) {
    enum { rays = SPT_BATCH };
    for (stress_way way = stress_ways(STRESS_OWN_RAYS); stress_next(&way);) {
        const stress_case what = stress_case_of(jump_distance, NULL);
        spt_ray array[rays];
        spt_hit together[rays], alone;
        for (int i = 0; i < rays; ++i) {
            array[i] = what.ray;
            array[i].origin[2] = (float)i * 1e-3f;
        }
        memset(together, 0xa5, sizeof together);
        stress_run_many(&way, &what, rays, array, together);
        for (int i = 0; i < rays; ++i) {
            stress_case one = what;
            one.ray = array[i];
            alone = stress_run(&way, &one, NULL);
            CHECK_SAY(stress_same_hit(&alone, &together[i]), "ray %d: t %.9g, alone %.9g", i,
                      (double)together[i].t, (double)alone.t);
            CHECK(alone.outcome == SPT_HIT && (alone.flags & SPT_FLAG_STEEP) != 0);
            CHECK(stress_within((double)alone.t + (double)array[i].origin[2], 1.003,
                                2 * stress_tolerance(&one, alone.t)));
        }
    }
}

/* ---- F2, F7: bounds and views --------------------------------------------------------------- */

static void F2c_extents_stay_finite(void) {
    static const float far[] = {1e38f, 3e38f, FLT_MAX, -3e38f, -FLT_MAX};
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 3; ++j) {
            const spt_bound bounds[] = {
                spt_bound_sphere(far[i], 0, far[i], far[j]),
                spt_bound_box(-far[j], -1, -far[j], far[j], fabsf(far[i]), far[j])};
            for (int kind = 0; kind < 2; ++kind) {
                float low[3], high[3];
                CHECK(spt_bound_extent(&bounds[kind], low, high) == SPT_OK);
                for (int axis = 0; axis < 3; ++axis) {
                    CHECK_SAY(low[axis] >= -FLT_MAX && high[axis] <= FLT_MAX, "%g .. %g",
                              (double)low[axis], (double)high[axis]);
                    CHECK(low[axis] <= high[axis]);
                }
            }
        }
    }
}

static void set_strides(spt_rays *rays, spt_hits *hits, ptrdiff_t stride) {
    for (int axis = 0; axis < 3; ++axis) {
        rays->origin[axis].stride = rays->direction[axis].stride = stride;
    }
    rays->t_min.stride = rays->t_max.stride = stride;
    hits->t.stride = hits->residual.stride = hits->outcome.stride = stride;
    hits->evaluations.stride = hits->flags.stride = hits->component.stride = stride;
    hits->candidate_t.stride = hits->candidate_ratio.stride = hits->fallbacks.stride = stride;
}

/* Of one ray no stride is ever taken. */
static void F7b_one_ray_with_any_stride(void) {
    static const ptrdiff_t strides[] = {
        0, 1, -1, PTRDIFF_MAX, -PTRDIFF_MAX, PTRDIFF_MAX / 2 + 1, -(PTRDIFF_MAX / 2) - 1};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_base();
        const spt_hit expected = stress_run(&way, &what, NULL);
        for (int i = 0; i < 7; ++i) {
            spt_hit hit;
            stress_probe probe;
            spt_rays rays = spt_rays_of(&what.ray);
            spt_hits hits = spt_hits_of(&hit);
            stress_probe_of(&probe, &what, 1);
            set_strides(&rays, &hits, strides[i]);
            const spt_field field = stress_field(&way, &what, &probe);
            const spt_settings settings = stress_settings(&way, &what);
            CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
            CHECK(stress_same_hit(&hit, &expected));
        }
    }
}

void suite_found(void) {
    RUN(A5c_least_epsilon_is_met_by_zero);
    RUN(R12_path_near_the_largest_number);
    RUN(R13_the_range_of_t_holds_for_short_directions);
    RUN(R13b_t_max_of_short_directions);
    RUN(D8_skipping_counts_as_evaluations);
    RUN(D8b_large_budgets_are_used_up);
    RUN(E5s_a_slope_beyond_the_largest_number);
    RUN(E2d_many_brackets_in_one_pass);
    RUN(F2c_extents_stay_finite);
    RUN(F7b_one_ray_with_any_stride);
}
