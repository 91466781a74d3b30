/* SPDX-License-Identifier: MIT
 *
 * Rows E1 to E4: fields that are no distance bounds, or hardly one. Nothing is promised of the
 * surface then, but every ray ends, and a ray whose samples betray the field says so. E5,
 * discontinuity reduction, belongs to the tests of surfaces. */
#include "stress.h"

#include <math.h>
#include <string.h>

/* ---- E1: a distance too long by a factor --------------------------------------------------- */

static float stretched_sphere(const void *data, float x, float y, float z) {
    const float dz = z - 10.0f;
    return *(const float *)data * (sqrtf(x * x + y * y + dz * dz) - 1.0f);
}

static void E1a_jump_over_the_sphere(void) {
    static const float factor = 1.5f;
    const stress_case what = stress_case_of(stretched_sphere, &factor);
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, NULL);
        CHECK_SAY(hit.outcome == SPT_MISS || hit.outcome == SPT_HIT, "outcome %d",
                  (int)hit.outcome);
        CHECK(hit.flags == SPT_FLAG_STEEP);
        CHECK_SAY(stress_within((double)stress_slope, 1.5, 0.01), "slope %.9g",
                  (double)stress_slope);
    }
}

static void E1b_step_into_the_sphere(void) {
    static const float factor = 2.0f;
    stress_case what = stress_case_of(stretched_sphere, &factor);
    what.ray.origin[2] = 8.1f;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, NULL);
        const double root = 9.0 - (double)8.1f;
        stress_expect(&hit, SPT_HIT, root, stress_tolerance(&what, hit.t));
        CHECK(hit.flags == SPT_FLAG_STEEP);
        CHECK_SAY(stress_within((double)stress_slope, 2.0, 0.01), "slope %.9g",
                  (double)stress_slope);
    }
}

static void E1c_lipschitz_constant_given(void) {
    static const float factors[] = {1.5f, 2.0f};
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        for (int i = 0; i < 4; ++i) {
            stress_case what = stress_case_of(stretched_sphere, &factors[i / 2]);
            what.lipschitz = factors[i / 2];
            what.ray.origin[2] = i % 2 != 0 ? 8.1f : 0.0f;
            const double root = 9.0 - (double)what.ray.origin[2];
            const spt_hit hit = stress_run(&way, &what, NULL);
            stress_expect(&hit, SPT_HIT, root,
                          stress_tolerance(&what, hit.t) + 4.0 * stress_ulp(9.0));
            CHECK(hit.flags == 0);
            CHECK(stress_slope <= what.lipschitz * 1.001f);
        }
    }
}

/* ---- Brackets: a plain step that crossed ---------------------------------------------------- */

/* Catalogue, section 2: closed in at most 40 evaluations, and within the budget. */
static void E1d_bracket_within_the_budget(void) {
    static const float factor = 2.0f;
    stress_case what = stress_case_of(stretched_sphere, &factor);
    what.ray.origin[2] = 8.1f;
    what.settings.epsilon = 1e-6f;
    for (stress_way way = stress_ways(STRESS_CONVEX); stress_next(&way);) {
        what.settings.budget = 128;
        const spt_hit closed = stress_run(&way, &what, NULL);
        stress_expect_evaluations(&closed, 3, 3 + 40);
        for (uint32_t budget = 1; budget <= closed.evaluations; ++budget) {
            what.settings.budget = budget;
            const spt_hit hit = stress_run(&way, &what, NULL);
            if (budget == closed.evaluations) {
                CHECK(stress_same_hit(&hit, &closed));
            } else {
                CHECK_SAY(hit.outcome == SPT_LIMIT, "budget %u: outcome %d", (unsigned)budget,
                          (int)hit.outcome);
            }
        }
    }
}

/* 1 before z = 7.3, -1 after 7.9, and in between -1 or what data holds: no root, a jump. */
static float jumping_distance(const void *data, float x, float y, float z) {
    (void)x, (void)y;
    if (z < 7.3f) return 1.0f;
    return z < 7.9f ? *(const float *)data : -1.0f;
}

static void E1e_jump_through_zero(void) {
    static const float behind = -1.0f;
    const stress_case what = stress_case_of(jumping_distance, &behind);
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, NULL);
        stress_expect(&hit, SPT_HIT, (double)7.3f, stress_tolerance(&what, 7.3f));
        CHECK(hit.flags == SPT_FLAG_STEEP);
        CHECK(fabsf(hit.residual) >= 1.0f);
        stress_expect_evaluations(&hit, 8, 2 * 8 + 40);
    }
}

static void E1f_nan_in_a_bracket(void) {
    const float between = stress_nan();
    const stress_case what = stress_case_of(jumping_distance, &between);
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, NULL);
        /* Basic steps from 7 to 8, crosses and finds NaN halfway; others may land on it before. */
        CHECK_SAY(hit.outcome == SPT_NONFINITE, "outcome %d", (int)hit.outcome);
        CHECK(way.method != spt_basic() || (hit.flags & SPT_FLAG_STEEP) != 0);
        CHECK((double)hit.t >= (double)7.3f && (double)hit.t < (double)7.9f);
    }
}

/* ---- E2: a displaced sphere ---------------------------------------------------------------- */

enum { half = 40, side = 2 * half + 1, grid = side * side, stride = 23 };

static float displaced_sphere(const void *data, float x, float y, float z) {
    const float dz = z - 10.0f;
    return sqrtf(x * x + y * y + dz * dz) - 1.0f +
           *(const float *)data * sinf(20.0f * x) * sinf(20.0f * y) * sinf(20.0f * z);
}

static double displaced_sphere_exact(double amplitude, double x, double y, double z) {
    const double dz = z - 10.0;
    return sqrt(x * x + y * y + dz * dz) - 1.0 +
           amplitude * sin(20.0 * x) * sin(20.0 * y) * sin(20.0 * z);
}

static spt_ray grid_ray(int index) {
    const double x = 0.0026 * (index % side - half), y = 0.0026 * (index / side - half);
    const double length = sqrt(x * x + y * y + 1.0);
    spt_ray ray = stress_base().ray;
    ray.direction[0] = (float)(x / length);
    ray.direction[1] = (float)(y / length);
    ray.direction[2] = (float)(1.0 / length);
    return ray;
}

/* The first of the samples 7.5, 7.502 ... 12 that is inside, or +infinity. Samples outside the
 * sphere that holds all displacements are passed over. */
static double first_inside(double amplitude, const spt_ray *ray) {
    const double x = (double)ray->direction[0], y = (double)ray->direction[1];
    const double z = (double)ray->direction[2], outer = 1.0 + amplitude;
    const double squared = x * x + y * y + z * z, nearest = 10.0 * z / squared;
    const double apart = 100.0 - nearest * nearest * squared; /* of ray and centre, squared */
    if (apart > outer * outer) return HUGE_VAL;
    const double reach = sqrt((outer * outer - apart) / squared);
    const int first = (int)ceil((fmax(nearest - reach, 7.5) - 7.5) / 0.002);
    for (int k = first; k <= 2250; ++k) {
        const double t = 7.5 + 0.002 * k;
        if (t > nearest + reach) break;
        if (displaced_sphere_exact(amplitude, t * x, t * y, t * z) < 0.0) return t;
    }
    return HUGE_VAL;
}

static spt_ray grid_rays[grid];
static spt_hit grid_hits[grid], sparse_hits[grid];
static double truth[grid];

/* All rays for each method; every stride-th, the same bits, for each width and form as well. */
static void trace_sparse_grid(const stress_case *what, const spt_method *method) {
    static spt_ray rays[grid];
    int count = 0;
    for (int i = 0; i < grid; i += stride) rays[count++] = grid_rays[i];
    for (stress_way way = stress_ways(STRESS_OWN_RAYS); stress_next(&way);) {
        if (way.method != method) continue;
        stress_run_many(&way, what, (size_t)count, rays, sparse_hits);
        for (int i = 0; i < count; ++i) {
            CHECK(stress_same_hit(&sparse_hits[i], &grid_hits[i * stride]));
        }
    }
}

static const float amplitudes[] = {0.05f, 0.15f, 0.25f};
enum { amplitude_count = 3 };

static void E2a_lipschitz_constant_given(void) {
    for (int i = 0; i < grid; ++i) grid_rays[i] = grid_ray(i);
    for (int a = 0; a < amplitude_count; ++a) {
        stress_case what = stress_case_of(displaced_sphere, &amplitudes[a]);
        /* |grad (sin sin sin)| <= 20: the three squares sum to at most 1. */
        what.lipschitz = 1.0f + 20.0f * amplitudes[a];
        what.settings.budget = 1000;
        for (int i = 0; i < grid; ++i)
            truth[i] = first_inside((double)amplitudes[a], &grid_rays[i]);
        for (stress_way way = stress_ways(STRESS_ONCE); stress_next(&way);) {
            int late = 0, missed = 0, steep = 0, real = 0;
            stress_run_many(&way, &what, grid, grid_rays, grid_hits);
            for (int i = 0; i < grid; ++i) {
                what.ray = grid_rays[i];
                stress_check_hit(&what, &grid_hits[i]);
                steep += (grid_hits[i].flags & SPT_FLAG_STEEP) != 0;
                if (truth[i] > 12.0) continue;
                ++real;
                missed += grid_hits[i].outcome != SPT_HIT;
                late += grid_hits[i].outcome == SPT_HIT && (double)grid_hits[i].t > truth[i] + 1e-4;
            }
            CHECK_SAY(late == 0 && missed == 0 && steep == 0 && real > 3000,
                      "amplitude %g: %d late, %d missed, %d steep of %d", (double)amplitudes[a],
                      late, missed, steep, real);
            trace_sparse_grid(&what, way.method);
        }
    }
}

static void E2b_lipschitz_constant_too_small(void) {
    for (int i = 0; i < grid; ++i) grid_rays[i] = grid_ray(i);
    for (int a = 0; a < amplitude_count; ++a) {
        stress_case what = stress_case_of(displaced_sphere, &amplitudes[a]);
        for (stress_way way = stress_ways(STRESS_ONCE); stress_next(&way);) {
            int steep = 0;
            stress_run_many(&way, &what, grid, grid_rays, grid_hits);
            for (int i = 0; i < grid; ++i) {
                what.ray = grid_rays[i];
                stress_check_hit(&what, &grid_hits[i]);
                steep += (grid_hits[i].flags & SPT_FLAG_STEEP) != 0;
            }
            CHECK_SAY(steep * 10 >= grid, "amplitude %g: %d of %d rays steep",
                      (double)amplitudes[a], steep, (int)grid);
            trace_sparse_grid(&what, way.method);
        }
    }
}

/* Batches that are full while some of their rays close brackets. */
static void E2c_full_batches_with_brackets(void) {
    static const size_t counts[] = {255, 256, 257, 512};
    static spt_ray rays[512];
    static spt_hit hits[512], alone[512];
    stress_case what = stress_case_of(displaced_sphere, &amplitudes[0]);
    for (int i = 0; i < 512; ++i) rays[i] = grid_ray(i % 16 * 5 + i / 16 % 16 * 5 * side + i / 256);
    for (stress_way way = stress_ways(STRESS_OWN_RAYS); stress_next(&way);) {
        for (int i = 0; i < 512; ++i) {
            what.ray = rays[i];
            alone[i] = stress_run(&way, &what, NULL);
        }
        for (int i = 0; i < 4; ++i) {
            memset(hits, 0xa5, sizeof hits);
            stress_run_many(&way, &what, counts[i], rays, hits);
            for (size_t k = 0; k < counts[i]; ++k) {
                CHECK_SAY(stress_same_hit(&hits[k], &alone[k]), "ray %u of %u: t %.9g, alone %.9g",
                          (unsigned)k, (unsigned)counts[i], (double)hits[k].t, (double)alone[k].t);
            }
        }
    }
}

/* ---- E3: repeated cells that do not look at their neighbours -------------------------------- */

static float late_in_each_cell(const void *data, float x, float y, float z) {
    const float q = z - 4.0f * floorf(z / 4.0f) - 3.9f;
    (void)data;
    return sqrtf(x * x + y * y + q * q) - 0.5f;
}

static float alternating_cells(const void *data, float x, float y, float z) {
    const float cell = floorf(z / 4.0f), q = z - 4.0f * cell - 2.0f;
    const int odd = cell - 2.0f * floorf(cell / 2.0f) > 0.5f;
    (void)data;
    return sqrtf(x * x + y * y + q * q) - (odd ? 1.8f : 0.2f);
}

/* Whether two successive samples of a ray along z lie further apart in value than in place, by
 * more than rounding explains (the audit of section 2 of the catalogue, with twice its slack). */
static int samples_jump(const stress_probe *probe) {
    for (size_t i = 1; i < probe->recorded; ++i) {
        const double step = fabs((double)probe->position[i][2] - (double)probe->position[i - 1][2]);
        const double change = fabs((double)probe->value[i] - (double)probe->value[i - 1]);
        const double rounding = ldexp((double)probe->position[i][2] + 2.0, -22);
        if (change > (1.0 + 2e-3) * step + 4.0 * rounding) return 1;
    }
    return 0;
}

static void E3_cells(void) {
    static stress_probe probe;
    stress_distance_fn *const cells[] = {late_in_each_cell, alternating_cells};
    int jumps = 0;
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        for (int kind = 0; kind < 2; ++kind) {
            for (int i = 0; i < 40; ++i) {
                stress_case what = stress_case_of(cells[kind], NULL);
                what.ray.origin[0] = 0.06f * (float)i;
                const spt_hit hit = stress_run(&way, &what, &probe);
                /* Of basic every sample is accepted; other rules reject some unseen. */
                if (way.method == spt_basic() && samples_jump(&probe)) {
                    CHECK_SAY((hit.flags & SPT_FLAG_STEEP) != 0, "kind %d, ray %d", kind, i);
                    ++jumps;
                }
            }
        }
    }
    CHECK(jumps > 0);
}

/* ---- E4: never reached --------------------------------------------------------------------- */

static float ripple(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y;
    return 0.01f + 0.005f * sinf(40.0f * z);
}

static void E4_never_reached(void) {
    static stress_probe probe;
    const stress_case what = stress_case_of(ripple, NULL);
    for (stress_way way = stress_ways(0); stress_next(&way);) {
        const spt_hit hit = stress_run(&way, &what, &probe);
        CHECK_SAY(hit.outcome == SPT_LIMIT, "outcome %d", (int)hit.outcome);
        stress_expect_evaluations(&hit, 128, 128);
        CHECK(hit.flags == 0);
        double least = HUGE_VAL;
        int among_samples = 0;
        for (size_t i = 0; i < probe.recorded; ++i) { /* the position is t */
            const double t = (double)probe.position[i][2];
            const double ratio = (double)probe.value[i] / fmax(t, (double)what.settings.epsilon);
            least = fmin(least, ratio);
            among_samples |= check_same_bits(hit.candidate_t, probe.position[i][2]);
        }
        CHECK(among_samples);
        CHECK((double)hit.candidate_ratio >= least * (1.0 - 1e-6));
        if (way.method == spt_basic()) { /* no sample is rejected: the least of all */
            CHECK(stress_within((double)hit.candidate_ratio, least, 1e-6 * least));
        }
    }
}

void suite_no_bound(void) {
    RUN(E1a_jump_over_the_sphere);
    RUN(E1b_step_into_the_sphere);
    RUN(E1c_lipschitz_constant_given);
    RUN(E1d_bracket_within_the_budget);
    RUN(E1e_jump_through_zero);
    RUN(E1f_nan_in_a_bracket);
    RUN(E2a_lipschitz_constant_given);
    RUN(E2b_lipschitz_constant_too_small);
    RUN(E2c_full_batches_with_brackets);
    RUN(E3_cells);
    RUN(E4_never_reached);
}
