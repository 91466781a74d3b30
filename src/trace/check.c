/* SPDX-License-Identifier: MIT
 *
 * Looks for broken promises of a field at random points of its bound. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../base/random.h"
#include "../bound/bound_check.h"
#include "driver.h"

enum { MOST_CHECKS = 1 << 20, PAIRS = 64, ATTEMPTS = 1024 };

/* The points of a sample: two in the bound, one near the first, one on the boundary, all on one
 * line, and the middle of the two. */
enum { ONE, OTHER, NEAR, EDGE, MIDDLE, POINTS };

/* In the order of spt_field_faults.worst. */
enum { OUTSIDE, NOT_CONVEX, BODY, STEEP, NONFINITE, FAULTS };

/* A walk through a convex volume: from each point to a random one of a random chord through it,
 * which visits all of it evenly in the end (hit-and-run; Smith 1984). */
typedef struct check_walk {
    const spt_bound *bound;
    float low[3], high[3];
    float at[3];
    uint32_t state;
} check_walk;

typedef struct check_samples {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
    float point[POINTS][PAIRS][3], value[POINTS][PAIRS];
} check_samples;

typedef struct check_record {
    int convex; /* the function is said to be */
    float lipschitz;
    double noise; /* so much may two values be off together */
    uint32_t count[FAULTS];
    double excess[FAULTS]; /* of the worst */
    float worst[FAULTS][3];
    int seen_inside; /* a point inside the body, the last one found, */
    float inside[3], inside_value;
} check_record;

static void draw_direction(check_walk *walk, float direction[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const float half = 0.5f * walk->high[axis] - 0.5f * walk->low[axis];
        direction[axis] = half * (2.0f * spti_draw_share(&walk->state) - 1.0f);
    }
}

/* Where a ray from the walk's point is inside; 0 where it is nowhere. */
static int interval(const check_walk *walk, const float direction[3], float t_max, float *t_in,
                    float *t_out) {
    return spt_bound_interval(walk->bound, walk->at, direction, 0.0f, t_max, t_in, t_out) ==
               SPT_OK &&
           *t_in <= *t_out && spti_finite(*t_out);
}

/* How far the chord through the walk's point reaches on one side. */
static float reach(const check_walk *walk, const float direction[3]) {
    float t_in, t_out;
    return interval(walk, direction, INFINITY, &t_in, &t_out) ? t_out : 0.0f;
}

static void point_at(const check_walk *walk, const float direction[3], float t, float point[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const float low = walk->low[axis], high = walk->high[axis];
        const float at = walk->at[axis] + t * direction[axis];
        point[axis] = at > low ? (at < high ? at : high) : low;
    }
}

/* Finds a point inside to begin at: the middle of the box, or of a chord. 0 where there is none. */
static int begin_walk(check_walk *walk) {
    static const float ahead[3] = {1, 0, 0};
    float t_in, t_out;
    for (int axis = 0; axis < 3; ++axis) {
        walk->at[axis] = 0.5f * walk->low[axis] + 0.5f * walk->high[axis];
    }
    if (interval(walk, ahead, 0.0f, &t_in, &t_out)) return 1;
    for (int attempt = 0; attempt < ATTEMPTS; ++attempt) {
        float direction[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float share = spti_draw_share(&walk->state);
            walk->at[axis] = walk->low[axis] * (1.0f - share) + walk->high[axis] * share;
        }
        draw_direction(walk, direction);
        if (!interval(walk, direction, INFINITY, &t_in, &t_out)) continue;
        point_at(walk, direction, 0.5f * t_in + 0.5f * t_out, walk->at);
        return 1;
    }
    return 0;
}

/* The points of a sample but for the middle; goes on to the first. */
static void choose_points(check_walk *walk, check_samples *samples, size_t pair) {
    float direction[3], opposite[3];
    draw_direction(walk, direction);
    for (int axis = 0; axis < 3; ++axis) opposite[axis] = -direction[axis];
    const float end = reach(walk, direction), begin = -reach(walk, opposite);
    const float one = begin + (end - begin) * spti_draw_share(&walk->state);
    const float other = begin + (end - begin) * spti_draw_share(&walk->state);
    const float apart =
        (end - one) / (float)(2u << spti_draw(&walk->state) % 12); /* slopes at all scales */
    point_at(walk, direction, one, samples->point[ONE][pair]);
    point_at(walk, direction, other, samples->point[OTHER][pair]);
    point_at(walk, direction, one + apart, samples->point[NEAR][pair]);
    point_at(walk, direction, end, samples->point[EDGE][pair]);
    memcpy(walk->at, samples->point[ONE][pair], sizeof walk->at);
}

/* Asks for `points` points of each sample from `first` on; all together fit a batch. */
static void ask(const spt_field *field, check_samples *samples, int first, int points,
                size_t pairs) {
    size_t slot = 0;
    for (int point = first; point < first + points; ++point) {
        for (size_t pair = 0; pair < pairs; ++pair, ++slot) {
            samples->x[slot] = samples->point[point][pair][0];
            samples->y[slot] = samples->point[point][pair][1];
            samples->z[slot] = samples->point[point][pair][2];
        }
    }
    spti_ask(field, slot, samples->x, samples->y, samples->z, samples->distance);
    for (int point = first; point < first + points; ++point) {
        memcpy(samples->value[point], &samples->distance[(size_t)(point - first) * pairs],
               pairs * sizeof(float));
    }
}

/* Where only one of two points is inside the body, another one inside takes the place of the other:
 * small bodies are seldom met twice. */
static void choose_middle(check_record *record, check_samples *samples, size_t pair) {
    float *const one = samples->point[ONE][pair], *const other = samples->point[OTHER][pair];
    const float value = samples->value[ONE][pair];
    const int inside = value < 0.0f && value >= -FLT_MAX;
    if (inside && record->seen_inside && !(samples->value[OTHER][pair] < 0.0f)) {
        memcpy(other, record->inside, sizeof record->inside);
        samples->value[OTHER][pair] = record->inside_value;
    }
    if (inside) {
        memcpy(record->inside, one, sizeof record->inside);
        record->inside_value = value;
        record->seen_inside = 1;
    }
    for (int axis = 0; axis < 3; ++axis) {
        samples->point[MIDDLE][pair][axis] = 0.5f * one[axis] + 0.5f * other[axis];
    }
}

static void note(check_record *record, int fault, const float point[3], double excess) {
    if (record->count[fault] == 0 || excess > record->excess[fault]) {
        memcpy(record->worst[fault], point, sizeof record->worst[fault]);
        record->excess[fault] = excess;
    }
    record->count[fault] += 1;
}

/* The slope of f / lipschitz between two points of a sample that rounding cannot explain; 0 where
 * one of them has no slope. */
static double slope(const check_record *record, const check_samples *samples, size_t pair, int from,
                    int to) {
    const double a = (double)samples->value[from][pair], b = (double)samples->value[to][pair];
    const double change = fabs(a - b) - record->noise;
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double side =
            (double)samples->point[from][pair][axis] - (double)samples->point[to][pair][axis];
        square += side * side;
    }
    if (!(change > 0) || !(change <= 2 * (double)FLT_MAX) || !(square > 0)) return 0;
    return change / (sqrt(square) * (double)record->lipschitz);
}

static void judge(check_record *record, const check_samples *samples, size_t pair) {
    static const int pairs[][2] = {{ONE, NEAR}, {ONE, OTHER}, {ONE, MIDDLE}, {NEAR, EDGE}};
    double value[POINTS], steepest = 0;
    int from = ONE;
    for (int point = 0; point < POINTS; ++point) {
        value[point] = (double)samples->value[point][pair];
        if (samples->value[point][pair] >= -FLT_MAX) continue;
        note(record, NONFINITE, samples->point[point][pair], 0);
        return; /* the sample shows nothing else */
    }
    if (value[EDGE] < -record->noise) {
        note(record, OUTSIDE, samples->point[EDGE][pair], -value[EDGE]);
    }
    const double above = value[MIDDLE] - 0.5 * (value[ONE] + value[OTHER]);
    if (record->convex && above > record->noise) {
        note(record, NOT_CONVEX, samples->point[MIDDLE][pair], above);
    }
    if (value[ONE] < 0 && value[OTHER] < 0 && value[MIDDLE] > record->noise) {
        note(record, BODY, samples->point[MIDDLE][pair], value[MIDDLE]);
    }
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        const double here = slope(record, samples, pair, pairs[i][0], pairs[i][1]);
        if (!(here > steepest)) continue;
        steepest = here;
        from = pairs[i][0];
    }
    if (spti_is_steep((float)steepest)) note(record, STEEP, samples->point[from][pair], steepest);
}

static void report(const check_record *record, spt_field_faults *faults) {
    faults->outside_bound = record->count[OUTSIDE];
    faults->not_convex = record->count[NOT_CONVEX];
    faults->body_not_convex = record->count[BODY];
    faults->steep = record->count[STEEP];
    faults->nonfinite = record->count[NONFINITE];
    memcpy(faults->worst, record->worst, sizeof faults->worst);
}

spt_status spt_field_check(const spt_field *field, uint32_t samples, uint32_t seed,
                           spt_field_faults *faults) {
    spt_field copy;
    spt_bound bound;
    check_walk walk;
    check_record record;
    check_samples points;
    if (faults == NULL || samples < 1 || samples > MOST_CHECKS) return SPT_BAD_ARGUMENT;
    if (!spti_field_copy(&copy, &bound, field)) return SPT_BAD_ARGUMENT;
    if (copy.bound == NULL) return SPT_UNSUPPORTED;
    walk.bound = &bound;
    walk.state = seed;
    spt_bound_extent(&bound, walk.low, walk.high);
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(walk.low[axis]) || !spti_finite(walk.high[axis])) return SPT_UNSUPPORTED;
    }
    if (!begin_walk(&walk)) return SPT_UNSUPPORTED;
    memset(&record, 0, sizeof record);
    record.convex = (copy.flags & SPT_FIELD_CONVEX) != 0;
    record.lipschitz = copy.lipschitz;
    /* No coordinate exceeds the size of the bound: 2 floors (algorithms of trace.h). */
    record.noise =
        4 * (double)SPTI_FLOOR * (double)spti_bound_size(&bound) * (double)copy.lipschitz;
    for (uint32_t first = 0; first < samples; first += PAIRS) {
        const size_t pairs = samples - first < PAIRS ? samples - first : PAIRS;
        for (size_t pair = 0; pair < pairs; ++pair) {
            /* Every other chord goes through the body, if it was met: it may be small. */
            if (record.seen_inside && pair % 2 != 0) memcpy(walk.at, record.inside, sizeof walk.at);
            choose_points(&walk, &points, pair);
        }
        ask(&copy, &points, ONE, MIDDLE, pairs);
        for (size_t pair = 0; pair < pairs; ++pair) choose_middle(&record, &points, pair);
        ask(&copy, &points, MIDDLE, 1, pairs);
        for (size_t pair = 0; pair < pairs; ++pair) judge(&record, &points, pair);
    }
    report(&record, faults);
    return SPT_OK;
}
