/* SPDX-License-Identifier: MIT
 *
 * Rows C8 and F2c: what measuring a field says with clocks that stand still or take long steps, and
 * where it asks. The clocks count what is asked of the callback, so that no real time is involved. */
#include <spheretrace/bound.h>
#include <spheretrace/trace.h>

#include "check.h"

#include <float.h>
#include <math.h>

/* Seconds pass by evaluations, by calls of the callback and by reads of the clock. */
typedef struct fake_clock {
    uint64_t points, calls, reads;
    double step;      /* of what it shows; 0: none */
    double phase;     /* what it began with */
    double direction; /* 1; -1: backward; 0: stands still */
    uint64_t outside; /* points that were not finite */
} fake_clock;

static const double of_point = 1e-6, of_call = 8e-6, of_read = 2e-6;

static double read_clock(void *user) {
    fake_clock *self = user;
    ++self->reads;
    const double passed = (double)self->points * of_point + (double)self->calls * of_call +
                          (double)self->reads * of_read;
    const double now = self->direction * (self->phase + passed);
    return self->step > 0 ? floor(now / self->step) * self->step : now;
}

static void take_points(fake_clock *self, size_t n, const float *x, const float *y,
                        const float *z) {
    ++self->calls;
    self->points += n;
    for (size_t i = 0; i < n; ++i) {
        const int finite =
            fabsf(x[i]) <= FLT_MAX && fabsf(y[i]) <= FLT_MAX && fabsf(z[i]) <= FLT_MAX;
        self->outside += !finite;
    }
}

static void batch_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                           float *distance) {
    take_points(user, n, x, y, z);
    for (size_t i = 0; i < n; ++i) distance[i] = 1;
}

static float point_distance(void *user, float x, float y, float z) {
    take_points(user, 1, &x, &y, &z);
    return 1;
}

static spt_status measure(fake_clock *self, const spt_bound *bound, int point,
                          spt_field_cost *cost) {
    spt_field field = spt_field_default();
    if (point) {
        field.point = point_distance;
    } else {
        field.batch = batch_distance;
    }
    field.user = self;
    field.bound = bound;
    return spt_field_measure(&field, read_clock, self, cost);
}

static fake_clock clock_of(double step) {
    const fake_clock made = {0, 0, 0, step, 0, 1, 0};
    return made;
}

/* What evaluations cost by the clock above; what the reads of the clock add to a round of a
 * millisecond is below one part in 200. */
static void check_cost(const spt_field_cost *cost, int point, double factor) {
    const double wide = (of_point + (point ? of_call : of_call / SPT_BATCH)) * 1e9;
    const double narrow = (of_point + (point ? of_call : of_call / 16)) * 1e9;
    CHECK_SAY(cost->nanoseconds_16 < narrow * factor && cost->nanoseconds_16 > narrow / factor,
              "%g for %g", cost->nanoseconds_16, narrow);
    CHECK_SAY(cost->nanoseconds_256 < wide * factor && cost->nanoseconds_256 > wide / factor,
              "%g for %g", cost->nanoseconds_256, wide);
}

static void C8_a_fine_clock(void) {
    for (int point = 0; point < 2; ++point) {
        fake_clock self = clock_of(0);
        spt_field_cost cost = {-1, -1};
        CHECK(measure(&self, NULL, point, &cost) == SPT_OK);
        check_cost(&cost, point, 1.01);
    }
}

/* field.h: a round lasts 16 ticks. It may begin and end anywhere between two of them, so that it is
 * seen as 16 where it is less than 17 or more than 15. */
static void C8_coarse_clocks(void) {
    static const double steps[] = {1e-3, 4e-3, 15.6e-3};
    enum { phases = 16 };
    for (int i = 0; i < 3 * phases; ++i) {
        const double step = steps[i / phases];
        fake_clock self = clock_of(step);
        spt_field_cost cost = {-1, -1};
        self.phase = step * (i % phases) / phases;
        check_context("steps of %g s, phase %d", step, i % phases);
        CHECK(measure(&self, NULL, 0, &cost) == SPT_OK);
        check_cost(&cost, 0, 1.005 * 16 / 15);
    }
}

static void C8_clocks_that_do_not_advance(void) {
    for (int direction = -1; direction <= 0; ++direction) {
        fake_clock self = clock_of(0);
        spt_field_cost cost = {-1, -2};
        self.direction = direction;
        CHECK(measure(&self, NULL, 0, &cost) == SPT_UNSUPPORTED);
        CHECK(cost.nanoseconds_16 == -1 && cost.nanoseconds_256 == -2);
        CHECK(self.points <= 3u << 26);
    }
}

static void F2c_measured_points_stay_finite(void) {
    const spt_bound bounds[] = {spt_bound_sphere(2e38f, 0, 0, 2e38f),
                                spt_bound_sphere(FLT_MAX, 0, -FLT_MAX, FLT_MAX),
                                spt_bound_box(-3e38f, -1, -1, 3e38f, 1, 1),
                                spt_bound_box(-FLT_MAX, -1, -FLT_MAX, FLT_MAX, 1, 0)};
    for (int i = 0; i < 4; ++i) {
        fake_clock self = clock_of(0);
        spt_field_cost cost;
        check_context("bound %d", i);
        CHECK(measure(&self, &bounds[i], 0, &cost) == SPT_OK);
        CHECK_SAY(self.points > 0 && self.outside == 0, "%u points are not finite",
                  (unsigned)self.outside);
    }
}

/* A callback for one point runs no padding. */
static void C8_a_point_callback_has_no_padding(void) {
    enum { rays = 37 };
    spt_ray array[rays];
    spt_hit found[rays];
    for (int i = 0; i < rays; ++i) {
        const spt_ray ray = {{0, 0, 0}, 0, {0, 0, 1}, (float)(i % 7)};
        array[i] = ray;
    }
    for (int point = 0; point < 2; ++point) {
        fake_clock self = clock_of(0);
        spt_field field = spt_field_default();
        const spt_settings settings = spt_settings_default();
        spt_statistics statistics = spt_statistics_default();
        const spt_rays view = spt_rays_of(array);
        const spt_hits hits = spt_hits_of(found);
        if (point) {
            field.point = point_distance;
        } else {
            field.batch = batch_distance;
        }
        field.user = &self;
        CHECK(spt_trace(&field, &settings, rays, &view, &hits, &statistics) == SPT_OK);
        CHECK(statistics.slots == self.points);
        CHECK(point ? statistics.slots == statistics.evaluations
                    : statistics.slots > statistics.evaluations);
    }
}

void suite_measure(void) {
    RUN(C8_a_fine_clock);
    RUN(C8_coarse_clocks);
    RUN(C8_clocks_that_do_not_advance);
    RUN(F2c_measured_points_stay_finite);
    RUN(C8_a_point_callback_has_no_padding);
}
