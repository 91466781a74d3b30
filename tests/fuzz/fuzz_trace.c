/* SPDX-License-Identifier: MIT
 *
 * One harness for libFuzzer and for the unit run: spt_trace() on rays, settings and fields made of
 * bytes, and what trace.h says of every result, whatever the field.
 *     clang -std=c99 -g -O1 -fsanitize=fuzzer,address,undefined -Iinclude \
 *         tests/fuzz/fuzz_trace.c tests/fuzz/fuzz_input.c build/libspheretrace.a -lm */
#include "fuzz.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

fuzz_failed_fn *fuzz_failed;

void fuzz_fail(const char *condition, const char *file, int line) {
    if (fuzz_failed == NULL) abort();
    fuzz_failed(condition, file, line);
}

enum { untouched = 0xa5 };

static int is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

static int within(float a, float low, float high) {
    return a >= low && a <= high;
}

/* ---- What is expected of a call ------------------------------------------------------------- */

static int bound_is_legal(const spt_bound *bound) {
    if (bound == NULL) return 1;
    if (bound->kind == SPT_BOUND_SPHERE) {
        return is_finite(bound->center[0]) && is_finite(bound->radius) && bound->radius > 0;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_finite(bound->low[axis]) || !is_finite(bound->high[axis])) return 0;
        if (!(bound->low[axis] <= bound->high[axis])) return 0;
    }
    return 1;
}

static spt_status expected_status(const fuzz_case *what) {
    const spt_settings *const s = &what->settings;
    const int convex = s->method == spt_convex() && (what->field.flags & SPT_FIELD_CONVEX) == 0;
    const int legal =
        within(what->field.lipschitz, 0x1p-100f, 0x1p100f) && !convex &&
        bound_is_legal(what->field.bound) && is_finite(s->epsilon) && s->epsilon > 0.0f &&
        within(s->pixel_radius, 0.0f, FLT_MAX) && within(s->size, 0.0f, FLT_MAX) &&
        s->relaxation >= 1.0f && s->relaxation < 2.0f && within(s->extrapolation, 0.0f, 1.0f) &&
        s->slope_blend > 0.0f && s->slope_blend <= 1.0f && within(s->step_cap, 1.0f, 100.0f);
    return legal ? SPT_OK : SPT_BAD_ARGUMENT;
}

static int ray_is_bad(const fuzz_ray *ray) {
    int all =
        is_finite(ray->t_min) && is_finite(ray->path) && ray->t_min >= 0.0f && ray->path >= 0.0f;
    int some = 0;
    all = all && ray->t_max <= INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        all = all && is_finite(ray->origin[axis]) && is_finite(ray->direction[axis]);
        some = some || fabsf(ray->direction[axis]) >= FLT_MIN;
    }
    return !(all && some);
}

/* ---- The table of outcomes ------------------------------------------------------------------ */

static double largest(const float v[3]) {
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

/* tolerance(t), with the rounding of the formula in float: fewer than ten operations, each within
 * 2^-24 on either side, or, where its numbers are denormal, within 2^-149. */
static double most_tolerance(const fuzz_case *what, const fuzz_ray *ray, double t) {
    const double x = (double)ray->direction[0], y = (double)ray->direction[1],
                 z = (double)ray->direction[2], world = t * sqrt(x * x + y * y + z * z);
    const spt_bound *const bound = what->field.bound;
    double size = (double)what->settings.size;
    if (bound != NULL && bound->kind == SPT_BOUND_SPHERE) {
        size = fmax(size, largest(bound->center) + (double)bound->radius);
    } else if (bound != NULL) {
        size = fmax(size, fmax(largest(bound->low), largest(bound->high)));
    }
    const double floor_of_t = 0x1p-22 * (largest(ray->origin) + world + size);
    const double cone = (double)what->settings.pixel_radius * ((double)ray->path + world);
    const double exact = fmax((double)what->settings.epsilon, fmax(cone, floor_of_t));
    return exact * (1 + 0x1p-20) + 20 * 0x1p-149;
}

static void check_surface(const fuzz_case *what, const fuzz_ray *ray, const spt_hit *hit) {
    const int stopped =
        (what->settings.flags & SPT_STOP_INSIDE) != 0 && (hit->flags & SPT_FLAG_INSIDE) != 0;
    const double radius = fabs((double)hit->residual) / (double)what->field.lipschitz;
    FUZZ_CHECK(within(hit->t, ray->t_min, ray->t_max));
    FUZZ_CHECK(hit->evaluations >= 1 && hit->component == 0);
    if ((hit->flags & SPT_FLAG_STEEP) == 0 && !stopped) {
        FUZZ_CHECK(radius < most_tolerance(what, ray, (double)hit->t));
    }
    if (what->hostile || largest(ray->direction) < 1e-10 || largest(ray->direction) > 1e10) return;
    float p[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float along = hit->t * ray->direction[axis];
        p[axis] = ray->origin[axis] + along;
    }
    const float value = fuzz_value(&what->distance, p[0], p[1], p[2]);
    FUZZ_CHECK(memcmp(&value, &hit->residual, sizeof value) == 0);
}

static void check_candidate(const fuzz_ray *ray, const spt_hit *hit) {
    FUZZ_CHECK(hit->candidate_ratio >= 0.0f);
    if (is_finite(hit->candidate_t)) {
        FUZZ_CHECK(within(hit->candidate_t, ray->t_min, ray->t_max));
    } else {
        FUZZ_CHECK(hit->candidate_t >= INFINITY && hit->candidate_ratio >= INFINITY);
    }
}

/* An exact distance with its own constant in numbers of everyday sizes. */
static int is_exact(const fuzz_case *what) {
    return what->distance.kind <= 1 && !what->hostile && what->field.lipschitz >= 1.0f;
}

static void check_hit(const fuzz_case *what, const fuzz_ray *ray, const spt_hit *hit) {
    const uint32_t flags = SPT_FLAG_STEEP | SPT_FLAG_INSIDE;
    FUZZ_CHECK(hit->evaluations <= what->settings.budget);
    FUZZ_CHECK(hit->fallbacks <= hit->evaluations && (hit->flags & ~flags) == 0);
    FUZZ_CHECK((hit->outcome == SPT_BAD_RAY) == ray_is_bad(ray));
    if (is_exact(what)) FUZZ_CHECK((hit->flags & SPT_FLAG_STEEP) == 0);
    check_candidate(ray, hit);
    switch (hit->outcome) {
    case SPT_HIT:
        check_surface(what, ray, hit);
        return;
    case SPT_LIMIT:
        FUZZ_CHECK(within(hit->t, ray->t_min, ray->t_max) && hit->component == -1);
        FUZZ_CHECK(hit->evaluations == what->settings.budget);
        FUZZ_CHECK(hit->residual >= -FLT_MAX);
        return;
    case SPT_NONFINITE:
        FUZZ_CHECK(within(hit->t, ray->t_min, ray->t_max) && hit->evaluations >= 1);
        FUZZ_CHECK(!(hit->residual >= -FLT_MAX) && hit->component == -1);
        return;
    default:
        FUZZ_CHECK(hit->outcome == SPT_MISS || hit->outcome == SPT_BAD_RAY);
        FUZZ_CHECK(hit->t >= INFINITY && hit->residual >= INFINITY && hit->component == -1);
        if (hit->outcome == SPT_BAD_RAY) FUZZ_CHECK(hit->evaluations == 0 && hit->flags == 0);
    }
}

/* ---- Calls ---------------------------------------------------------------------------------- */

static spt_column column_of(const void *first, ptrdiff_t stride) {
    const spt_column column = {first, stride};
    return column;
}

/* The rays from one on, forward or backward. */
static spt_rays view_of(const fuzz_case *what, size_t from, ptrdiff_t stride) {
    const fuzz_ray *const ray = &what->rays[from];
    spt_rays rays;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = column_of(&ray->origin[axis], stride);
        rays.direction[axis] = column_of(&ray->direction[axis], stride);
    }
    rays.t_min = column_of(&ray->t_min, stride);
    rays.t_max = column_of(&ray->t_max, stride);
    rays.path = column_of(&ray->path, stride);
    rays.active = column_of(what->masked ? &ray->active : NULL, stride);
    return rays;
}

static void backward(spt_hits *hits) {
    spt_sink *const sinks[] = {&hits->t,           &hits->residual,        &hits->outcome,
                               &hits->evaluations, &hits->flags,           &hits->component,
                               &hits->candidate_t, &hits->candidate_ratio, &hits->fallbacks};
    for (size_t i = 0; i < sizeof sinks / sizeof *sinks; ++i) sinks[i]->stride *= -1;
}

static int is_active(const fuzz_case *what, size_t ray) {
    return !what->masked || what->rays[ray].active != 0;
}

/* The counts are those of the hits, and of what the callback saw. */
static void check_statistics(const fuzz_case *what, const spt_hit *found,
                             const spt_statistics *statistics) {
    uint64_t rays = 0, evaluations = 0, fallbacks = 0, outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
    for (size_t i = 0; i < what->count; ++i) {
        if (!is_active(what, i)) continue;
        ++rays;
        evaluations += found[i].evaluations;
        fallbacks += found[i].fallbacks;
        ++outcomes[(uint32_t)found[i].outcome % SPT_OUTCOMES];
    }
    FUZZ_CHECK(statistics->rays == rays && statistics->evaluations == evaluations);
    FUZZ_CHECK(statistics->fallbacks == fallbacks);
    FUZZ_CHECK(memcmp(outcomes, statistics->outcomes, sizeof outcomes) == 0);
    FUZZ_CHECK(statistics->slots == what->distance.points);
    FUZZ_CHECK(what->distance.point ? statistics->slots == evaluations
                                    : statistics->slots >= evaluations);
    FUZZ_CHECK(within(statistics->largest_slope, 0.0f, FLT_MAX));
    FUZZ_CHECK(what->distance.faults == 0);
}

static spt_status trace_all(fuzz_case *what, uint32_t lanes, int reversed, spt_hit *found,
                            spt_statistics *statistics) {
    const size_t last = what->count - 1;
    const ptrdiff_t stride = (ptrdiff_t)sizeof *what->rays;
    const spt_rays rays = reversed ? view_of(what, last, -stride) : view_of(what, 0, stride);
    spt_hits hits = spt_hits_of(reversed ? found + last : found);
    if (reversed) backward(&hits);
    memset(found, untouched, what->count * sizeof *found);
    what->settings.max_lanes = lanes;
    what->distance.points = what->distance.faults = 0;
    return spt_trace(&what->field, &what->settings, what->count, &rays, &hits, statistics);
}

/* One ray alone has the same bits, says INSIDE of its first value, and takes the budget it used. */
static void check_alone(fuzz_case *what, size_t ray, const spt_hit *expected) {
    const spt_rays rays = view_of(what, ray, 0);
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    const uint32_t budget = what->settings.budget;
    what->distance.points = 0;
    FUZZ_CHECK(spt_trace(&what->field, &what->settings, 1, &rays, &hits, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(&hit, expected, sizeof hit) == 0);
    if (hit.evaluations == 0) return;
    const float first = what->distance.first_value;
    if ((what->settings.flags & SPT_SKIP_START) == 0 && first >= -FLT_MAX) {
        FUZZ_CHECK(((hit.flags & SPT_FLAG_INSIDE) != 0) == (first < 0.0f));
    }
    if (hit.outcome == SPT_LIMIT) return;
    what->settings.budget = expected->evaluations;
    FUZZ_CHECK(spt_trace(&what->field, &what->settings, 1, &rays, &hits, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(&hit, expected, sizeof hit) == 0);
    what->settings.budget = expected->evaluations - 1;
    FUZZ_CHECK(spt_trace(&what->field, &what->settings, 1, &rays, &hits, NULL) == SPT_OK);
    FUZZ_CHECK(hit.outcome == SPT_LIMIT && hit.evaluations == what->settings.budget);
    what->settings.budget = budget;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static fuzz_case what;
    static spt_hit first[fuzz_most_rays], other[fuzz_most_rays], none[fuzz_most_rays];
    static const uint32_t widths[] = {0, 4, 8, 16};
    spt_statistics statistics = spt_statistics_default();
    fuzz_read(&what, data, size);
    memset(none, untouched, sizeof none);
    const size_t bytes = what.count * sizeof *first;
    const spt_status status = trace_all(&what, 1, 0, first, &statistics);
    FUZZ_CHECK(status == expected_status(&what));
    if (status != SPT_OK) {
        FUZZ_CHECK(what.distance.points == 0 && memcmp(first, none, bytes) == 0);
        return 0;
    }
    check_statistics(&what, first, &statistics);
    for (size_t i = 0; i < what.count; ++i) {
        if (is_active(&what, i)) {
            check_hit(&what, &what.rays[i], &first[i]);
        } else {
            FUZZ_CHECK(memcmp(&first[i], none, sizeof *first) == 0);
        }
    }
    FUZZ_CHECK(trace_all(&what, widths[size % 4], 0, other, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(first, other, bytes) == 0);
    FUZZ_CHECK(trace_all(&what, widths[size / 4 % 4], 1, other, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(first, other, bytes) == 0);
    const size_t one = size % what.count;
    if (is_active(&what, one)) check_alone(&what, one, &first[one]);
    return 0;
}
