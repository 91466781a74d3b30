/* SPDX-License-Identifier: MIT
 *
 * Rows F1, F2, F4 and F10: bounding volumes at their edges, and wrong arguments, which must change
 * nothing: outputs are compared byte by byte and no callback may run. Views and counts are in
 * test_views.c. F9 is about frames. */
#include "stress.h"
#include "stress_guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- F1: rays in a face -------------------------------------------------------------------- */

enum { face_rays = 12 };

/* Axis, side and sign of zero of the ray that runs along axis + 1 in (distance 1) or beside
 * (distance 1.5) the face of the box [-1, 1]^3. */
static spt_ray face_ray(int index, float distance) {
    const int axis = index / 4, next = (axis + 1) % 3;
    const float zero = index % 2 != 0 ? -0.0f : 0.0f;
    spt_ray ray = {{0.0f, 0.0f, 0.0f}, 0.0f, {zero, zero, zero}, 100.0f};
    ray.origin[next] = -5.0f;
    ray.origin[axis] = index / 2 % 2 != 0 ? -distance : distance;
    ray.direction[next] = 1.0f;
    return ray;
}

/* bound.h: widened at both ends by 2^-22 (|origin|_inf + |direction| t + extent), never narrower. */
static void expect_interval(const spt_bound *bound, const spt_ray *ray, double low, double high) {
    float entry = -1.0f, exit = -1.0f;
    const double floor_of_exit = ldexp(5.0 + high + 2.0, -22);
    CHECK(spt_bound_interval(bound, ray->origin, ray->direction, ray->t_min, ray->t_max, &entry,
                             &exit) == SPT_OK);
    CHECK_SAY((double)entry <= low && (double)entry >= low - 2.0 * floor_of_exit &&
                  (double)exit >= high && (double)exit <= high + 2.0 * floor_of_exit,
              "%.9g .. %.9g, expected %g .. %g", (double)entry, (double)exit, low, high);
}

static void expect_outside(const spt_bound *bound, const spt_ray *ray) {
    float entry = -1.0f, exit = -1.0f;
    CHECK(spt_bound_interval(bound, ray->origin, ray->direction, ray->t_min, ray->t_max, &entry,
                             &exit) == SPT_OK);
    CHECK(check_same_bits(entry, stress_infinity()) && check_same_bits(exit, -stress_infinity()));
}

static void F1_rays_in_a_face(void) {
    const spt_bound box = spt_bound_box(-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f);
    for (int i = 0; i < face_rays; ++i) {
        const spt_ray in = face_ray(i, 1.0f), beside = face_ray(i, 1.5f);
        expect_interval(&box, &in, 4.0, 6.0);
        expect_outside(&box, &beside);
    }
    static const float near_enough = 0.25f; /* four steps to the end, unless a rule is faster */
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        static stress_probe probe;
        stress_case what = stress_case_of(stress_constant_distance, &near_enough);
        what.bound = &box;
        for (int i = 0; i < face_rays; ++i) {
            what.ray = face_ray(i, 1.0f);
            spt_hit hit = stress_run(&way, &what, &probe);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            CHECK(hit.evaluations >= 2);
            const double first = (double)probe.position[0][(i / 4 + 1) % 3];
            CHECK_SAY(stress_within(first, -1.0, ldexp(16.0, -22)), "first sample at %.9g", first);
            what.ray = face_ray(i, 1.5f);
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 0, 0);
        }
    }
}

/* A sphere that is only touched is met, at one point; one beyond the widening is not. */
static void F1b_ray_that_touches_a_sphere(void) {
    const spt_bound sphere = spt_bound_sphere(0.0f, 0.0f, 0.0f, 1.0f);
    for (int i = 0; i < face_rays; ++i) {
        const spt_ray touching = face_ray(i, 1.0f), beside = face_ray(i, 1.5f);
        float entry = -1.0f, exit = -1.0f;
        CHECK(spt_bound_interval(&sphere, touching.origin, touching.direction, 0.0f, 100.0f, &entry,
                                 &exit) == SPT_OK);
        /* Closed and never narrower; a discriminant off by 2^-22 is an interval of 2^-11. */
        CHECK_SAY(entry <= 5.0f && entry >= 4.99f && exit >= 5.0f && exit <= 5.01f, "%.9g .. %.9g",
                  (double)entry, (double)exit);
        expect_outside(&sphere, &beside);
    }
}

/* ---- F2: volumes that are none ------------------------------------------------------------- */

static void refuse_bound(const spt_bound *bound) {
    const spt_ray ray = stress_base().ray;
    float entry = 7.0f, exit = 8.0f, low[3] = {1.0f, 2.0f, 3.0f}, high[3] = {4.0f, 5.0f, 6.0f};
    CHECK(spt_bound_interval(bound, ray.origin, ray.direction, 0.0f, 1.0f, &entry, &exit) ==
          SPT_BAD_ARGUMENT);
    CHECK(check_same_bits(entry, 7.0f) && check_same_bits(exit, 8.0f));
    CHECK(spt_bound_extent(bound, low, high) == SPT_BAD_ARGUMENT);
    CHECK(check_same_bits(low[0], 1.0f) && check_same_bits(high[2], 6.0f));
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_base();
        what.bound = bound;
        stress_refused(&way, &what);
    }
}

static void F2_bad_volumes(void) {
    const float bad[] = {stress_nan(), stress_infinity(), -stress_infinity()};
    const float radii[] = {0.0f, -0.0f, -1.0f, stress_nan(), stress_infinity()};
    const spt_bound sphere = spt_bound_sphere(0.0f, 0.0f, 10.0f, 2.0f);
    const spt_bound box = spt_bound_box(-2.0f, -2.0f, 8.0f, 2.0f, 2.0f, 12.0f);
    spt_bound bound;
    for (int i = 0; i < 9; ++i) {
        bound = sphere;
        bound.center[i / 3] = bad[i % 3];
        refuse_bound(&bound);
        bound = box;
        bound.low[i / 3] = bad[i % 3];
        refuse_bound(&bound);
        bound = box;
        bound.high[i / 3] = bad[i % 3];
        refuse_bound(&bound);
    }
    for (int i = 0; i < 5; ++i) {
        bound = sphere;
        bound.radius = radii[i];
        refuse_bound(&bound);
    }
    for (int axis = 0; axis < 3; ++axis) {
        bound = box;
        bound.low[axis] = nextafterf(bound.high[axis], FLT_MAX);
        refuse_bound(&bound);
    }
    static const uint32_t kinds[] = {0, 10, 0xffffffffu};
    for (int i = 0; i < 3; ++i) {
        bound = box;
        bound.kind = kinds[i];
        refuse_bound(&bound);
    }
    bound = sphere;
    bound.struct_size = 0;
    refuse_bound(&bound);
    bound.struct_size = sizeof bound - 1;
    refuse_bound(&bound);
}

static void F2b_flat_box(void) {
    const spt_bound flat = spt_bound_box(-1.0f, -1.0f, 9.0f, 1.0f, 1.0f, 9.0f);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        stress_case what = stress_base();
        what.bound = &flat;
        const spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, 9.0, stress_tolerance(&what, 9.0f));
    }
}

/* ---- F4: starts on and in a bound, bounds that cut and that are missed ---------------------- */

static const stress_sphere unit_sphere = {{0.0f, 0.0f, 0.0f}, 1.0f};

static void F4a_start_on_the_bound(void) {
    const spt_bound bounds[] = {spt_bound_sphere(0.0f, 0.0f, 0.0f, 1.5f),
                                spt_bound_box(-1.5f, -1.5f, -1.5f, 1.5f, 1.5f, 1.5f)};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 2; ++i) {
            stress_case what = stress_case_of(stress_sphere_distance, &unit_sphere);
            what.bound = &bounds[i];
            what.ray.origin[2] = -1.5f;
            spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 0.5, stress_tolerance(&what, 0.5f));
            what.ray.direction[2] = -1.0f;
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 0, 1);
        }
    }
}

static void F4b_bound_cuts_the_object(void) {
    const spt_bound bounds[] = {spt_bound_sphere(0.0f, 0.0f, 0.0f, 0.8f),
                                spt_bound_box(-0.8f, -0.8f, -0.8f, 0.8f, 0.8f, 0.8f)};
    /* The widening of bound.h at the entry: 2^-22 of 5 + 4.2 + 0.8, and for the sphere's radius of
     * 5 + 5 more; and the rounding of a float of that size. */
    const double slack = ldexp(10.0 + 10.0 + 2.0, -22);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 2; ++i) {
            stress_case what = stress_case_of(stress_sphere_distance, &unit_sphere);
            static stress_probe probe;
            what.bound = &bounds[i];
            what.ray.origin[2] = -5.0f;
            spt_hit hit = stress_run(&way, &what, &probe);
            CHECK((hit.flags & SPT_FLAG_INSIDE) != 0);
            CHECK(stress_within((double)probe.position[0][2], -0.8, slack));
            CHECK(hit.outcome == SPT_MISS || stress_within((double)hit.t, 5.0, 0.8 + slack));
            what.settings.flags = SPT_STOP_INSIDE;
            hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, 4.2, slack);
            CHECK(hit.flags == SPT_FLAG_INSIDE);
        }
    }
}

static void F4c_bound_is_missed(void) {
    static const stress_sphere sphere = {{0.0f, 0.0f, 0.0f}, 2.0f};
    const spt_bound bounds[] = {spt_bound_sphere(0.0f, 5.0f, 0.0f, 0.5f),
                                spt_bound_box(-0.5f, 4.5f, -0.5f, 0.5f, 5.5f, 0.5f)};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 2; ++i) {
            stress_case what = stress_case_of(stress_sphere_distance, &sphere);
            what.bound = &bounds[i];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_MISS, 0.0, 0.0);
            stress_expect_evaluations(&hit, 0, 0);
            CHECK(hit.flags == 0);
        }
    }
}

void suite_calls(void) {
    RUN(F1_rays_in_a_face);
    RUN(F1b_ray_that_touches_a_sphere);
    RUN(F2_bad_volumes);
    RUN(F2b_flat_box);
    RUN(F4a_start_on_the_bound);
    RUN(F4b_bound_cuts_the_object);
    RUN(F4c_bound_is_missed);
}
