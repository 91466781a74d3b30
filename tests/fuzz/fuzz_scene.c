/* SPDX-License-Identifier: MIT
 *
 * One harness for libFuzzer and for the unit run: spt_scene_trace() and frames on scenes, rays,
 * zones, cameras and schedules made of bytes, and what scene.h and frame.h say of every result,
 * whatever the fields. Frames are in fuzz_scene_frame.c.
 *     clang -std=c99 -g -O1 -DFUZZ_SCENE_ALONE -fsanitize=fuzzer,address,undefined -Iinclude \
 *         tests/fuzz/fuzz_scene*.c tests/fuzz/fuzz_input.c build/libspheretrace.a -lm */
#include "fuzz_scene.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef FUZZ_SCENE_ALONE /* without fuzz_trace.c, which has these for the unit run */
fuzz_failed_fn *fuzz_failed;

void fuzz_fail(const char *condition, const char *file, int line) {
    if (fuzz_failed == NULL) abort();
    fuzz_failed(condition, file, line);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    return fuzz_scene_input(data, size);
}
#endif

enum { untouched = 0xa5 };

static int is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

static int within(float a, float low, float high) {
    return a >= low && a <= high;
}

/* ---- A hit ----------------------------------------------------------------------------------- */

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

static double largest(const float v[3]) {
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

/* tolerance(t) of a component, with the rounding of the formula in float: fewer than ten
 * operations, each within 2^-24 on either side, or, where its numbers are denormal, within
 * 2^-149. */
static double most_tolerance(const spt_field *field, const spt_settings *settings,
                             const fuzz_ray *ray, double t) {
    const double x = (double)ray->direction[0], y = (double)ray->direction[1],
                 z = (double)ray->direction[2], world = t * sqrt(x * x + y * y + z * z);
    const spt_bound *const bound = field->bound;
    double size = (double)settings->size;
    if (bound != NULL && bound->kind == SPT_BOUND_SPHERE) {
        size = fmax(size, largest(bound->center) + (double)bound->radius);
    } else if (bound != NULL) {
        size = fmax(size, fmax(largest(bound->low), largest(bound->high)));
    }
    const double floor_of_t = 0x1p-22 * (largest(ray->origin) + world + size);
    const double cone = (double)settings->pixel_radius * ((double)ray->path + world);
    const double exact = fmax((double)settings->epsilon, fmax(cone, floor_of_t));
    return exact * (1 + 0x1p-20) + 20 * 0x1p-149;
}

static void check_surface(const fuzz_scene_case *what, const spt_settings *settings,
                          const fuzz_ray *ray, const spt_hit *hit) {
    const int known = hit->component >= 0 && (size_t)hit->component < what->scene.count;
    FUZZ_CHECK(known && hit->evaluations >= 1);
    if (!known) return;
    const spt_field *const field = &what->fields[hit->component];
    const int stopped =
        (settings->flags & SPT_STOP_INSIDE) != 0 && (hit->flags & SPT_FLAG_INSIDE) != 0;
    const int cut = what->scene.zone_count != 0 && hit->residual < 0.0f;
    if ((hit->flags & SPT_FLAG_STEEP) == 0 && !stopped && !cut) {
        FUZZ_CHECK(fabs((double)hit->residual) / (double)field->lipschitz <
                   most_tolerance(field, settings, ray, (double)hit->t));
    }
    if (largest(ray->direction) < 1e-10 || largest(ray->direction) > 1e10) return;
    if (largest(ray->origin) > 1e10) return;
    float p[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float along = hit->t * ray->direction[axis];
        p[axis] = ray->origin[axis] + along;
    }
    const float value = fuzz_part_value(&what->parts[hit->component], p[0], p[1], p[2]);
    if (!what->rest.hostile) FUZZ_CHECK(memcmp(&value, &hit->residual, sizeof value) == 0);
}

void fuzz_scene_check_hit(const fuzz_scene_case *what, const spt_settings *settings,
                          const fuzz_ray *ray, const spt_hit *hit) {
    const int somewhere =
        hit->outcome == SPT_HIT || hit->outcome == SPT_LIMIT || hit->outcome == SPT_NONFINITE;
    FUZZ_CHECK(hit->outcome >= 0 && hit->outcome < SPT_OUTCOMES);
    FUZZ_CHECK(hit->evaluations <= settings->budget && hit->fallbacks <= hit->evaluations);
    FUZZ_CHECK((hit->flags & ~(uint32_t)(SPT_FLAG_STEEP | SPT_FLAG_INSIDE)) == 0);
    FUZZ_CHECK((hit->outcome == SPT_BAD_RAY) == ray_is_bad(ray));
    FUZZ_CHECK(hit->outcome == SPT_HIT || hit->component == -1);
    if (somewhere) {
        FUZZ_CHECK(within(hit->t, ray->t_min, ray->t_max));
    } else {
        FUZZ_CHECK(hit->t >= INFINITY && hit->residual >= INFINITY);
    }
    if (hit->outcome == SPT_BAD_RAY) FUZZ_CHECK(hit->evaluations == 0 && hit->flags == 0);
    if (hit->outcome == SPT_HIT) check_surface(what, settings, ray, hit);
    if (hit->outcome == SPT_LIMIT) FUZZ_CHECK(hit->evaluations == settings->budget);
    if (hit->outcome == SPT_NONFINITE) {
        FUZZ_CHECK(hit->evaluations >= 1 && !(hit->residual >= -FLT_MAX));
    } else {
        FUZZ_CHECK(hit->residual >= -FLT_MAX);
    }
    FUZZ_CHECK(hit->candidate_ratio >= 0.0f);
    if (is_finite(hit->candidate_t)) {
        FUZZ_CHECK(within(hit->candidate_t, ray->t_min, ray->t_max));
    } else {
        FUZZ_CHECK(hit->candidate_t >= INFINITY && hit->candidate_ratio >= INFINITY);
    }
}

/* ---- Calls ----------------------------------------------------------------------------------- */

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

static int is_active(const fuzz_scene_case *what, size_t ray) {
    return !what->rest.masked || what->rest.rays[ray].active != 0;
}

static spt_status trace(fuzz_scene_case *what, const spt_settings *settings, int reversed,
                        spt_hit *found, spt_statistics *statistics) {
    const size_t count = what->rest.count, last = count - 1;
    const ptrdiff_t stride = (ptrdiff_t)sizeof *what->rest.rays;
    const spt_rays rays =
        reversed ? view_of(&what->rest, last, -stride) : view_of(&what->rest, 0, stride);
    spt_hits hits = spt_hits_of(reversed ? found + last : found);
    const size_t size = spt_scene_workspace(&what->scene, settings);
    char *const workspace = fuzz_memory(0, size + 8, reversed ? 0xff : 0x11);
    if (reversed) backward(&hits);
    memset(found, untouched, count * sizeof *found);
    fuzz_scene_clear(what);
    const spt_status status = spt_scene_trace(&what->scene, settings, count, &rays, &hits,
                                              workspace + 8 * reversed, size, statistics);
    FUZZ_CHECK(fuzz_memory_kept(0, size + 8) && fuzz_scene_faults(what) == 0);
    return status;
}

static void check_statistics(const fuzz_scene_case *what, const spt_hit *found,
                             const spt_statistics *statistics) {
    uint64_t rays = 0, evaluations = 0, fallbacks = 0, outcomes[SPT_OUTCOMES] = {0, 0, 0, 0, 0};
    for (size_t i = 0; i < what->rest.count; ++i) {
        if (!is_active(what, i)) continue;
        ++rays;
        evaluations += found[i].evaluations;
        fallbacks += found[i].fallbacks;
        ++outcomes[(uint32_t)found[i].outcome % SPT_OUTCOMES];
    }
    FUZZ_CHECK(statistics->rays == rays && statistics->evaluations == evaluations);
    FUZZ_CHECK(statistics->fallbacks == fallbacks);
    FUZZ_CHECK(memcmp(outcomes, statistics->outcomes, sizeof outcomes) == 0);
    FUZZ_CHECK(statistics->slots == fuzz_scene_points(what) && statistics->slots >= evaluations);
    FUZZ_CHECK(within(statistics->largest_slope, 0.0f, FLT_MAX));
}

/* ---- Component by component ------------------------------------------------------------------ */

/* scene.h: what comes back is what each component by itself gives, nearest first. Where the budget
 * is enough for all of them, no hit is as near as a value that is not finite, and the fields are
 * distances: behind a jump a bracket may find a root before the point up to which the ray was free,
 * and nobody would have asked for that. */
static void check_against_components(const fuzz_scene_case *what, size_t index,
                                     const spt_hit *found) {
    const spt_rays rays = view_of(&what->rest, index, 0);
    float t = INFINITY, residual = INFINITY;
    int32_t component = -1, outcome = SPT_MISS;
    uint64_t evaluations = 0;
    for (size_t i = 0; i < what->scene.count; ++i) {
        spt_settings settings = what->rest.settings;
        spt_hit hit;
        const spt_hits hits = spt_hits_of(&hit);
        if ((what->fields[i].flags & SPT_FIELD_CONVEX) != 0) settings.method = spt_convex();
        FUZZ_CHECK(spt_trace(&what->fields[i], &settings, 1, &rays, &hits, NULL) == SPT_OK);
        evaluations += hit.evaluations;
        if (hit.outcome == SPT_LIMIT || (hit.flags & SPT_FLAG_STEEP) != 0) return;
        if (hit.outcome == SPT_BAD_RAY) outcome = SPT_BAD_RAY;
        if (hit.outcome != SPT_HIT && hit.outcome != SPT_NONFINITE) continue;
        if (!(hit.t < t) && !(hit.t > t) && hit.outcome != outcome) return;
        if (!(hit.t < t)) continue;
        t = hit.t;
        residual = hit.residual;
        outcome = hit.outcome;
        component = hit.outcome == SPT_HIT ? (int32_t)i : -1;
    }
    if (evaluations > what->rest.settings.budget) return;
    FUZZ_CHECK(found->outcome == outcome && found->component == component);
    FUZZ_CHECK(memcmp(&found->t, &t, sizeof t) == 0);
    FUZZ_CHECK(memcmp(&found->residual, &residual, sizeof residual) == 0);
    FUZZ_CHECK(found->evaluations <= evaluations);
}

/* A union of one is spt_trace(). */
static void check_one(const fuzz_scene_case *what, size_t index, const spt_hit *found) {
    const spt_rays rays = view_of(&what->rest, index, 0);
    spt_settings settings = what->rest.settings;
    spt_hit hit;
    const spt_hits hits = spt_hits_of(&hit);
    if ((what->fields[0].flags & SPT_FIELD_CONVEX) != 0) settings.method = spt_convex();
    FUZZ_CHECK(spt_trace(&what->fields[0], &settings, 1, &rays, &hits, NULL) == SPT_OK);
    FUZZ_CHECK(memcmp(found, &hit, sizeof hit) == 0);
}

int fuzz_scene_input(const uint8_t *data, size_t size) {
    static fuzz_scene_case what;
    static spt_hit first[fuzz_most_rays], other[fuzz_most_rays], none[fuzz_most_rays];
    static const uint32_t widths[] = {0, 4, 8, 16};
    spt_statistics statistics = spt_statistics_default();
    fuzz_scene_read(&what, data, size);
    memset(none, untouched, sizeof none);
    spt_settings settings = what.rest.settings;
    const size_t count = what.rest.count, bytes = count * sizeof *first;
    const int legal = fuzz_scene_is_legal(&what);
    FUZZ_CHECK((spt_scene_workspace(&what.scene, &settings) != 0) == legal);
    settings.max_lanes = 1;
    const spt_status status = trace(&what, &settings, 0, first, &statistics);
    FUZZ_CHECK(status == (legal ? SPT_OK : SPT_BAD_ARGUMENT));
    if (status != SPT_OK) {
        FUZZ_CHECK(fuzz_scene_points(&what) == 0 && memcmp(first, none, bytes) == 0);
    } else {
        check_statistics(&what, first, &statistics);
        for (size_t i = 0; i < count; ++i) {
            if (is_active(&what, i)) {
                fuzz_scene_check_hit(&what, &settings, &what.rest.rays[i], &first[i]);
            } else {
                FUZZ_CHECK(memcmp(&first[i], none, sizeof *first) == 0);
            }
        }
        settings.max_lanes = widths[size % 4];
        FUZZ_CHECK(trace(&what, &settings, (int)(size / 4 % 2), other, NULL) == SPT_OK);
        FUZZ_CHECK(memcmp(first, other, bytes) == 0);
        for (size_t i = size % 5; i < count && what.scene.zone_count == 0; i += 1 + count / 8) {
            if (!is_active(&what, i)) continue;
            check_against_components(&what, i, &first[i]);
            if (what.scene.count == 1) check_one(&what, i, &first[i]);
        }
    }
    if (what.has_frame) fuzz_scene_frame(&what);
    return 0;
}
