/* SPDX-License-Identifier: MIT
 *
 * What one evaluation of a field costs, by the caller's clock. */
#include "../base/arguments.h"
#include "driver.h"

/* A round lasts at least a millisecond and so many ticks of the clock; the limits are on what is
 * done with a clock that does not move, or hardly. */
enum { rounds = 3, ticks = 16, most_reads = 1 << 22, most_evaluations = 1 << 26 };

typedef struct measure_points {
    SPTI_ALIGNED(64) float at[3][SPT_BATCH];
    SPTI_ALIGNED(64) float work[3][SPT_BATCH]; /* the callback may use its points as scratch */
    SPTI_ALIGNED(64) float distance[SPT_BATCH];
} measure_points;

/* Points spread evenly over a box: an additive recurrence with irrational steps (the powers of the
 * inverse of the plastic number's generalisation to three dimensions; Roberts 2018). */
static void spread(measure_points *points, const spt_bound *bound) {
    static const double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    if (bound != NULL) spt_bound_extent(bound, low, high);
    for (int axis = 0; axis < 3; ++axis) {
        double part = 0.5;
        /* A volume may have no end on one side, or on both. */
        if (!spti_finite(low[axis])) low[axis] = spti_finite(high[axis]) ? high[axis] - 2 : -1;
        if (!spti_finite(high[axis])) high[axis] = low[axis] + 2;
        for (int i = 0; i < SPT_BATCH; ++i) {
            part += step[axis];
            if (part >= 1) part -= 1;
            points->at[axis][i] = low[axis] * (float)(1 - part) + high[axis] * (float)part;
        }
    }
}

static void ask(const spt_field *field, measure_points *points, size_t n) {
    for (int axis = 0; axis < 3; ++axis) {
        memcpy(points->work[axis], points->at[axis], n * sizeof(float));
    }
    if (field->batch != NULL) {
        field->batch(field->user, n, points->work[0], points->work[1], points->work[2],
                     points->distance);
        return;
    }
    for (size_t i = 0; i < n; ++i) {
        points->distance[i] =
            field->point(field->user, points->work[0][i], points->work[1][i], points->work[2][i]);
    }
}

/* The clock's step, as far as it shows; 0 where it stands still. */
static double tick_of(spt_clock_fn *clock, void *clock_user) {
    double start = clock(clock_user), now = start;
    for (int edge = 0; edge < 2; ++edge) { /* the first one begins a whole step */
        start = now;
        for (int read = 0; read < most_reads && !(now > start); ++read) now = clock(clock_user);
    }
    return now > start ? now - start : 0;
}

/* The least time per evaluation over a few rounds, or negative where the clock is too slow. */
static double nanoseconds(const spt_field *field, measure_points *points, size_t n, double tick,
                          spt_clock_fn *clock, void *clock_user) {
    const double shortest = ticks * tick > 1e-3 ? ticks * tick : 1e-3;
    double least = -1;
    for (int round = 0; round < rounds; ++round) {
        for (size_t calls = 1; calls * n <= most_evaluations; calls *= 2) {
            const double start = clock(clock_user);
            for (size_t call = 0; call < calls; ++call) ask(field, points, n);
            const double seconds = clock(clock_user) - start;
            if (!(seconds >= shortest)) continue;
            const double each = seconds * 1e9 / ((double)calls * (double)n);
            if (least < 0 || each < least) least = each;
            break;
        }
        if (least < 0) break;
    }
    return least;
}

spt_status spt_field_measure(const spt_field *field, spt_clock_fn *clock, void *clock_user,
                             spt_field_cost *cost) {
    spt_field copy;
    spt_bound bound;
    measure_points points;
    if (clock == NULL || cost == NULL || !spti_field_copy(&copy, &bound, field)) {
        return SPT_BAD_ARGUMENT;
    }
    spread(&points, copy.bound != NULL ? &bound : NULL);
    const double tick = tick_of(clock, clock_user);
    if (!(tick > 0)) return SPT_UNSUPPORTED;
    const double narrow = nanoseconds(&copy, &points, SPTI_GROUP, tick, clock, clock_user);
    if (narrow < 0) return SPT_UNSUPPORTED;
    const double wide = nanoseconds(&copy, &points, SPT_BATCH, tick, clock, clock_user);
    if (wide < 0) return SPT_UNSUPPORTED;
    cost->nanoseconds_16 = narrow;
    cost->nanoseconds_256 = wide;
    return SPT_OK;
}
