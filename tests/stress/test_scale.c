/* SPDX-License-Identifier: MIT
 *
 * Rows C1 to C7 but C5: scenes from 1e-24 to 1e21, where float positions no longer resolve the
 * tolerance or the callback's squares over- and underflow. C5 is about normals. */
#include "stress.h"

#include <math.h>

/* ---- C1, C6: far surfaces ------------------------------------------------------------------ */

enum { powers = 7, far_draws = 2000, sphere_draws = 300, shares = 8 };

static double drawn[far_draws];

/* K (1 + u/2) + v, K = 10^(2 + power) */
static void draw_depths(int power, int count) {
    const double scale = pow(10.0, 2.0 + power);
    for (int i = 0; i < count; ++i) {
        const double u = check_uniform(0.0, 1.0), v = check_uniform(0.0, 1.0);
        drawn[i] = scale * (1.0 + u / 2.0) + v;
    }
}

static float far_wall(const void *data, float x, float y, float z) {
    (void)x, (void)y;
    return (float)(*(const double *)data - (double)z);
}

/* Each way traces its share of the draws, so that each method sees all of them where the machine
 * has every width. */
static void C1_far_planes(void) {
    for (int power = 0; power < powers; ++power) {
        draw_depths(power, far_draws);
        for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
            for (int i = way.index % shares; i < far_draws; i += shares) {
                stress_case what = stress_case_of(far_wall, &drawn[i]);
                what.settings.budget = 256;
                what.ray.t_max = stress_infinity();
                const spt_hit hit = stress_run(&way, &what, NULL);
                const double tolerance = stress_tolerance(&what, hit.t);
                stress_expect(&hit, SPT_HIT, drawn[i], tolerance + 4.0 * stress_ulp(drawn[i]));
                CHECK((hit.flags & SPT_FLAG_STEEP) == 0);
            }
        }
    }
}

static float far_sphere(const void *data, float x, float y, float z) {
    const double dz = (double)z - *(const double *)data;
    return (float)(sqrt((double)x * (double)x + (double)y * (double)y + dz * dz) - 1.0);
}

static void C6_far_spheres(void) {
    for (int power = 0; power < powers; ++power) {
        draw_depths(power, sphere_draws);
        for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_OWN_RAYS); stress_next(&way);) {
            for (int i = way.index % shares; i < sphere_draws; i += shares) {
                stress_case what = stress_case_of(far_sphere, &drawn[i]);
                what.settings.budget = 256;
                what.settings.relaxation = 1.2f;
                what.ray.t_max = stress_infinity();
                const spt_hit hit = stress_run(&way, &what, NULL);
                const double surface = drawn[i] - 1.0;
                const double tolerance = stress_tolerance(&what, hit.t);
                stress_expect(&hit, SPT_HIT, surface, tolerance + 4.0 * stress_ulp(surface));
                CHECK((hit.flags & SPT_FLAG_STEEP) == 0);
            }
        }
    }
}

/* ---- C2: the base scene scaled ------------------------------------------------------------- */

static stress_case scaled_base(stress_sphere *sphere, double factor) {
    sphere->center[0] = sphere->center[1] = 0.0f;
    sphere->center[2] = (float)(10.0 * factor);
    sphere->radius = (float)factor;
    stress_case what = stress_case_of(stress_sphere_distance, sphere);
    what.ray.t_max = (float)(100.0 * factor);
    return what;
}

static void C2_small_scene(void) {
    stress_sphere sphere;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = scaled_base(&sphere, 1e-6);
        spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 0.0, 0.0); /* nearer than epsilon: that is what it means */
        stress_expect_evaluations(&hit, 1, 1);
        what.settings.epsilon = 1e-10f;
        hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 9e-6, 1e-10 + 4.0 * stress_ulp(9e-6));
    }
}

static void C2c_scene_times_power_of_two(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const stress_case unit = stress_base();
        const spt_hit expected = stress_run(&way, &unit, NULL);
        CHECK(expected.outcome == SPT_HIT);
        for (int k = -60; k <= 60; ++k) {
            stress_sphere sphere;
            stress_case what = scaled_base(&sphere, ldexp(1.0, k));
            what.settings.epsilon = stress_scaled(unit.settings.epsilon, k);
            spt_hit hit = stress_run(&way, &what, NULL);
            hit.t = stress_scaled(hit.t, -k);
            hit.residual = stress_scaled(hit.residual, -k);
            hit.candidate_t = stress_scaled(hit.candidate_t, -k);
            CHECK_SAY(stress_same_hit(&hit, &expected), "2^%d: t %.9g, %u evaluations", k,
                      (double)hit.t, (unsigned)hit.evaluations);
        }
    }
}

/* A box whose distance is computed in double; data is the exponent that its size is scaled by. */
static float scaled_box(const void *data, float x, float y, float z) {
    const double size = ldexp(1.0, *(const int *)data), p[3] = {(double)x, (double)y, (double)z};
    static const double center[3] = {0.75, 0.0, 3.5}, half[3] = {0.5, 0.375, 0.25};
    double outside = 0, inside = -(double)INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const double beyond = fabs(p[axis] / size - center[axis]) - half[axis];
        outside += beyond > 0 ? beyond * beyond : 0;
        inside = beyond > inside ? beyond : inside;
    }
    return (float)((sqrt(outside) + (inside < 0 ? inside : 0)) * size);
}

/* A ray that comes to the box at a small angle: secant steps multiplied two lengths, whose product
 * underflowed in a scene of 2^-60. */
static void C2e_box_times_power_of_two(void) {
    static const spt_ray unit = {{-0.0190317966f, 0.245150536f, 0.0701427385f},
                                 0.00732933683f,
                                 {0.162791595f, -0.0130525772f, 0.986574113f},
                                 8.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        spt_hit expected = {0};
        for (int k = 0; k <= 120; ++k) { /* 0, -1 .. -60, 1 .. 60 */
            const int power = k <= 60 ? -k : k - 60;
            stress_case what = stress_case_of(scaled_box, &power);
            what.settings.epsilon = stress_scaled(what.settings.epsilon, power);
            what.ray = unit;
            what.ray.t_min = stress_scaled(unit.t_min, power);
            what.ray.t_max = stress_scaled(unit.t_max, power);
            for (int axis = 0; axis < 3; ++axis) {
                what.ray.origin[axis] = stress_scaled(unit.origin[axis], power);
            }
            spt_hit hit = stress_run(&way, &what, NULL);
            hit.t = stress_scaled(hit.t, -power);
            hit.residual = stress_scaled(hit.residual, -power);
            hit.candidate_t = stress_scaled(hit.candidate_t, -power);
            if (k == 0) expected = hit;
            CHECK(expected.outcome == SPT_HIT);
            CHECK_SAY(stress_same_hit(&hit, &expected), "2^%d: t %.9g, %u evaluations", power,
                      (double)hit.t, (unsigned)hit.evaluations);
        }
    }
}

static spt_hit passing_hit(const stress_way *way, const stress_case *what) {
    stress_probe probe;
    spt_hit hit;
    const spt_field field = stress_field(way, what, &probe);
    const spt_settings settings = stress_settings(way, what);
    const spt_rays rays = spt_rays_of(&what->ray);
    const spt_hits hits = spt_hits_of(&hit);
    stress_probe_of(&probe, what, 1);
    CHECK(spt_trace(&field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
    return hit;
}

/* What a ray sees between its samples, as it passes the sphere: a length, or a tangent. */
static void C2d_passing_times_power_of_two(void) {
    static const uint32_t flags[] = {SPT_CANDIDATE_CLOSEST, SPT_CANDIDATE_PENUMBRA};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 2; ++i) {
            spt_hit expected;
            for (int k = 0; k <= 9; ++k) {
                stress_sphere sphere;
                stress_case what = scaled_base(&sphere, ldexp(1.0, k));
                what.settings.flags = flags[i];
                what.settings.epsilon = stress_scaled(what.settings.epsilon, k);
                what.ray.origin[0] = stress_scaled(1.3f, k);
                spt_hit hit = passing_hit(&way, &what);
                hit.candidate_t = stress_scaled(hit.candidate_t, -k);
                if (i == 0) hit.candidate_ratio = stress_scaled(hit.candidate_ratio, -k);
                if (k == 0) expected = hit;
                CHECK_SAY(stress_same_hit(&hit, &expected), "2^%d: %.9g at %.9g", k,
                          (double)hit.candidate_ratio, (double)hit.candidate_t);
            }
            CHECK(expected.outcome == SPT_MISS && expected.candidate_ratio > 0.01f);
        }
    }
}

/* ---- C3, C4: beyond the squares of the callback -------------------------------------------- */

static void C3_huge_spheres(void) {
    static const double factors[] = {1e18, 1e19, 1e20, 1e21};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_sphere sphere;
            stress_case what = scaled_base(&sphere, factors[i]);
            what.settings.epsilon = (float)(1e-4 * factors[i]);
            const spt_hit hit = stress_run(&way, &what, NULL);
            if (i == 0) {
                const double tolerance = stress_tolerance(&what, hit.t);
                stress_expect(&hit, SPT_HIT, 9e18, tolerance + 4.0 * stress_ulp(9e18));
            } else { /* the distance overflows to +infinity, which means that nothing is there */
                stress_expect(&hit, SPT_MISS, 0.0, 0.0);
                stress_expect_evaluations(&hit, 1, 2);
            }
        }
    }
}

static void C4_tiny_spheres(void) {
    static const double factors[] = {1e-18, 1e-20, 1e-22, 1e-24};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_sphere sphere;
            stress_case what = scaled_base(&sphere, factors[i]);
            what.settings.epsilon = (float)(1e-4 * factors[i]);
            const spt_hit hit = stress_run(&way, &what, NULL);
            CHECK(hit.outcome != SPT_BAD_RAY && hit.outcome != SPT_NONFINITE);
            if (i == 0) stress_expect(&hit, SPT_HIT, 9e-18, 1e-22 + 4.0 * stress_ulp(9e-18));
        }
    }
}

/* ---- C7: spheres that only touch ----------------------------------------------------------- */

/* From the centre, the spheres of the start and of a relaxed probe beyond the surface add up to
 * the very step: only the change of sign betrays that the surface was crossed. */
static void C7_start_at_the_centre(void) {
    static const float relaxations[] = {1.0f, 1.2f, 1.4f, 1.6f, 1.9f, 1.99f};
    static const stress_sphere sphere = {{0.0f, 0.0f, 0.0f}, 1.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 6; ++i) {
            stress_case what = stress_case_of(stress_sphere_distance, &sphere);
            what.settings.relaxation = relaxations[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 1.0, 1e-4);
            CHECK(hit.flags == SPT_FLAG_INSIDE);
        }
    }
}

void suite_scale(void) {
    RUN(C1_far_planes);
    RUN(C2_small_scene);
    RUN(C2c_scene_times_power_of_two);
    RUN(C2d_passing_times_power_of_two);
    RUN(C2e_box_times_power_of_two);
    RUN(C3_huge_spheres);
    RUN(C4_tiny_spheres);
    RUN(C6_far_spheres);
    RUN(C7_start_at_the_centre);
}
