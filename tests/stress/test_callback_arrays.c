/* SPDX-License-Identifier: MIT
 *
 * Rows A8 and A9: batch callbacks that leave results out, spoil those of the padding or write over
 * the points. */
#include "stress.h"

enum mischief { keep_quiet, leave_result_3, spoil_padding, write_nothing, overwrite_points };

typedef struct culprit {
    enum mischief mischief;
    int at_call; /* the call in which to leave the result, from 0 */
    int call;
    size_t live;    /* rays; spoil_padding spoils the results behind them */
    float victim_x; /* of the ray whose result was left */
} culprit;

static float sphere_distance(float x, float y, float z) {
    return stress_sphere_distance(stress_base().data, x, y, z);
}

static void hostile_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    culprit *self = user;
    const int call = self->call++;
    if (self->mischief == write_nothing) return;
    for (size_t i = 0; i < n; ++i) {
        if (self->mischief == leave_result_3 && i == 3 && call == self->at_call) {
            self->victim_x = x[i];
            continue;
        }
        const int spoiled = self->mischief == spoil_padding && i >= self->live;
        distance[i] = spoiled ? stress_nan() : sphere_distance(x[i], y[i], z[i]);
    }
    if (self->mischief == overwrite_points) {
        for (size_t i = 0; i < n; ++i) { /* field.h: they may be used as scratch space */
            ((float *)(uintptr_t)x)[i] = ((float *)(uintptr_t)y)[i] = stress_nan();
            ((float *)(uintptr_t)z)[i] = stress_nan();
        }
    }
}

static void run_culprit(const stress_way *way, culprit *self, size_t count, spt_hit *hits) {
    const stress_case what = stress_base();
    const spt_settings settings = stress_settings(way, &what);
    spt_statistics statistics = spt_statistics_default();
    spt_field field = spt_field_default();
    spt_ray ray[16];
    self->live = count;
    self->call = 0;
    self->victim_x = -1.0f;
    for (size_t i = 0; i < count; ++i) {
        ray[i] = what.ray;
        ray[i].origin[0] = 0.1f * (float)i; /* the last six of 16 pass the sphere by */
    }
    field.batch = hostile_batch;
    field.user = self;
    field.flags = SPT_FIELD_CONVEX;
    const spt_rays rays = spt_rays_of(ray);
    const spt_hits sinks = spt_hits_of(hits);
    CHECK(spt_trace(&field, &settings, count, &rays, &sinks, &statistics) == SPT_OK);
    CHECK(statistics.lanes == way->lanes);
}

/* A result left out ends the ray that it was for, and that alone. At a speculative probe it is
 * merely rejected; the second probe of basic and convex is none. */
static void A8a_result_left_unwritten(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_BATCH); stress_next(&way);) {
        culprit none = {keep_quiet, 0, 0, 0, 0.0f};
        spt_hit clean[16], hits[16];
        run_culprit(&way, &none, 16, clean);
        for (int at = 0; at < 2; ++at) {
            culprit self = {leave_result_3, at, 0, 0, 0.0f};
            run_culprit(&way, &self, 16, hits);
            int nonfinite = 0;
            for (int i = 0; i < 16; ++i) {
                if (check_same_bits(0.1f * (float)i, self.victim_x)) {
                    nonfinite += hits[i].outcome == SPT_NONFINITE;
                    CHECK(at == 0 || hits[i].outcome == SPT_NONFINITE ||
                          hits[i].outcome == clean[i].outcome);
                } else {
                    CHECK(stress_same_hit(&hits[i], &clean[i]));
                }
            }
            CHECK(self.victim_x >= 0.0f);
            if (at == 0 || way.method == spt_basic() || way.method == spt_convex()) {
                CHECK_SAY(nonfinite == 1, "%d rays nonfinite, call %d", nonfinite, at);
            }
        }
    }
}

static void A8b_padded_results_spoiled(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_BATCH); stress_next(&way);) {
        culprit none = {keep_quiet, 0, 0, 0, 0.0f}, self = {spoil_padding, 0, 0, 0, 0.0f};
        spt_hit clean, hit;
        run_culprit(&way, &none, 1, &clean);
        run_culprit(&way, &self, 1, &hit);
        CHECK(clean.outcome == SPT_HIT);
        CHECK(stress_same_hit(&hit, &clean));
    }
}

static void A8c_nothing_written(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_BATCH); stress_next(&way);) {
        culprit self = {write_nothing, 0, 0, 0, 0.0f};
        spt_hit hits[16];
        run_culprit(&way, &self, 16, hits);
        for (int i = 0; i < 16; ++i) {
            stress_expect(&hits[i], SPT_NONFINITE, 0.0, 0.0);
            stress_expect_evaluations(&hits[i], 1, 1);
            CHECK(stress_is_nan(hits[i].residual));
        }
    }
}

static void A9_points_overwritten(void) {
    for (stress_way way = stress_ways(STRESS_CONVEX | STRESS_BATCH); stress_next(&way);) {
        culprit none = {keep_quiet, 0, 0, 0, 0.0f}, self = {overwrite_points, 0, 0, 0, 0.0f};
        spt_hit clean[16], hits[16];
        run_culprit(&way, &none, 16, clean);
        run_culprit(&way, &self, 16, hits);
        for (int i = 0; i < 16; ++i) CHECK(stress_same_hit(&hits[i], &clean[i]));
    }
}

void suite_callback_arrays(void) {
    RUN(A8a_result_left_unwritten);
    RUN(A8b_padded_results_spoiled);
    RUN(A8c_nothing_written);
    RUN(A9_points_overwritten);
}
