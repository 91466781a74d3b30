/* SPDX-License-Identifier: MIT
 *
 * Möbius kernel-reflection sequences: building them, and what they answer. */
#include <math.h>

#include "../base/arguments.h"
#include "../base/marks.h"
#include "../bound/bound_check.h"
#include "../trace/driver.h"
#include "locate.h"
#include "mobius_build.h"

/* What levels are mirrored at. */
static const spt_mirror mirror_at_0 = {{1, 0, 0}, 0};

static int build_levels(const spt_moekrs_model *model, spt_moekrs *moekrs) {
    spti_ball whole, kernel;
    if (!spti_build_kernel(&model->kernels[0], &moekrs->kernels[0], &whole)) return 0;
    for (uint32_t level = 0; level < model->levels; ++level) {
        int straddles = 0;
        spt_built_kernel *const built = &moekrs->kernels[level + 1];
        if (!spti_build_map(&model->maps[level], &moekrs->maps[level])) return 0;
        if (!spti_build_kernel(&model->kernels[level + 1], built, &kernel)) return 0;
        if (!(model->unmirrored >> level & 1)) {
            whole = spti_mirror_ball(&whole, &mirror_at_0, &straddles);
        }
        if (straddles) moekrs->straddles |= UINT64_C(1) << level;
        whole = spti_ball_around(&whole, &kernel);
        whole = spti_map_ball(&whole, &model->maps[level]);
        spti_map_whole(&whole, &moekrs->maps[level]);
    }
    moekrs->bounded = spti_bound_of_ball(&whole, &moekrs->bound);
    return 1;
}

spt_status spt_moekrs_build(const spt_moekrs_model *model, spt_moekrs *moekrs) {
    spt_moekrs_model copy = spt_moekrs_model_default();
    spt_moekrs built;
    if (model == NULL || moekrs == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_copy_sized(&copy, model, sizeof copy)) return SPT_BAD_ARGUMENT;
    if (!spti_model_is_good(copy.levels, copy.kernels, copy.maps, copy.smooth, copy.max_lanes)) {
        return SPT_BAD_ARGUMENT;
    }
    memset(&built, 0, sizeof built);
    built.levels = copy.levels;
    built.max_lanes = copy.max_lanes;
    built.unmirrored = copy.unmirrored;
    built.smooth = copy.smooth;
    if (!build_levels(&copy, &built)) return SPT_BAD_ARGUMENT;
    built.field_kernels = spti_count_fields(built.kernels, built.levels);
    if (built.smooth > 0.0f && !spti_have_gradients(built.kernels, built.levels)) {
        return SPT_BAD_ARGUMENT;
    }
    if (copy.bound != NULL) {
        built.bounded = spti_bound_copy(&built.bound, copy.bound);
        if (!built.bounded) return SPT_BAD_ARGUMENT;
    }
    *moekrs = built;
    return SPT_OK;
}

static spti_stretch stretch_of(const spt_moekrs *moekrs) {
    const spti_stretch model = {moekrs->levels, moekrs->levels,    0, 1, 0, moekrs->kernels, NULL,
                                moekrs->maps,   moekrs->unmirrored};
    return model;
}

/* Points that may be written, and what goes with them. */
typedef struct moekrs_points {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH];
    SPTI_ALIGNED(64) float shrink[SPT_BATCH], reach[SPT_BATCH], clear[SPT_BATCH];
} moekrs_points;

static void copy_points(moekrs_points *points, size_t n, const float *x, const float *y,
                        const float *z) {
    memcpy(points->x, x, n * sizeof *x);
    memcpy(points->y, y, n * sizeof *y);
    memcpy(points->z, z, n * sizeof *z);
}

/* Where a caller's field is asked in between. */
static SPTI_NOINLINE void distance_with_fields(const spt_moekrs *moekrs, size_t n, const float *x,
                                               const float *y, const float *z, float *distance) {
    const spti_stretch model = stretch_of(moekrs);
    moekrs_points points;
    const spti_way way = {.x = points.x,
                          .y = points.y,
                          .z = points.z,
                          .distance = distance,
                          .shrink = points.shrink,
                          .reach = points.reach,
                          .clear = points.clear};
    copy_points(&points, n, x, y, z);
    spti_walk(&model, SPTI_WALK_PULL, moekrs->max_lanes, n, &way);
}

static void moekrs_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *distance) {
    const spt_moekrs *const moekrs = user;
    if (moekrs->field_kernels != 0) {
        distance_with_fields(moekrs, n, x, y, z, distance);
    } else { /* in one stretch, where all stays in registers */
        const spti_stretch model = stretch_of(moekrs);
        const spti_way way = {.x = spti_unwritten(x),
                              .y = spti_unwritten(y),
                              .z = spti_unwritten(z),
                              .distance = distance};
        spti_walk(&model, SPTI_WALK_PULL, moekrs->max_lanes, n, &way);
    }
    spti_settle_far(n, x, y, z, distance);
}

static float moekrs_point(void *user, float x, float y, float z) {
    const spti_stretch model = stretch_of(user);
    float pulled[3] = {x, y, z}, distance, shrink, reach, clear;
    const spti_way way = {.x = &pulled[0],
                          .y = &pulled[1],
                          .z = &pulled[2],
                          .distance = &distance,
                          .shrink = &shrink,
                          .reach = &reach,
                          .clear = &clear};
    spti_walk(&model, SPTI_WALK_PULL, 1, 1, &way);
    spti_settle_far(1, &x, &y, &z, &distance);
    return distance;
}

static void moekrs_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *gradient_x, float *gradient_y, float *gradient_z) {
    const spt_moekrs *const moekrs = user;
    const spti_stretch model = stretch_of(moekrs);
    spti_place_gradients(&model, moekrs->smooth, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

spt_field spt_moekrs_field(const spt_moekrs *moekrs) {
    spt_field field = spt_field_default();
    if (moekrs == NULL) return field;
    field.batch = moekrs_distance;
    field.point = moekrs_point;
    field.user = (void *)(uintptr_t)moekrs; /* only read */
    field.bound = moekrs->bounded ? &moekrs->bound : NULL;
    field.glsl = spti_mark_moekrs;
    if (spti_have_gradients(moekrs->kernels, moekrs->levels)) field.gradient = moekrs_gradient;
    return field;
}

static void moekrs_clearance(void *user, size_t n, const float *x, const float *y, const float *z,
                             const float *radius, float *clearance) {
    const spt_moekrs *const moekrs = user;
    const spti_stretch model = stretch_of(moekrs);
    moekrs_points points;
    const spti_way way = {.x = points.x,
                          .y = points.y,
                          .z = points.z,
                          .distance = clearance,
                          .radius = points.shrink};
    copy_points(&points, n, x, y, z);
    memcpy(points.shrink, radius, n * sizeof *radius);
    spti_walk(&model, SPTI_WALK_PROBE, moekrs->max_lanes, n, &way);
    spti_settle_far_balls(n, x, y, z, radius, clearance);
}

static float moekrs_clearance_at(void *user, float x, float y, float z, float radius) {
    const spti_stretch model = stretch_of(user);
    float pulled[3] = {x, y, z}, pulled_radius = radius, clearance;
    const spti_way way = {.x = &pulled[0],
                          .y = &pulled[1],
                          .z = &pulled[2],
                          .distance = &clearance,
                          .radius = &pulled_radius};
    spti_walk(&model, SPTI_WALK_PROBE, 1, 1, &way);
    spti_settle_far_balls(1, &x, &y, &z, &radius, &clearance);
    return clearance;
}

spt_probe spt_moekrs_probe(const spt_moekrs *moekrs) {
    spt_probe probe = spt_probe_default();
    if (moekrs == NULL) return probe;
    probe.batch = moekrs_clearance;
    probe.point = moekrs_clearance_at;
    probe.user = (void *)(uintptr_t)moekrs;
    probe.bound = moekrs->bounded ? &moekrs->bound : NULL;
    return probe;
}

spt_status spt_moekrs_locate(const spt_moekrs *moekrs, int32_t component,
                             const spt_settings *settings, size_t count, const spt_rays *rays,
                             const spt_hits *hits, const spt_krs_places *places) {
    if (moekrs == NULL) return SPT_BAD_ARGUMENT;
    const spti_stretch model = stretch_of(moekrs);
    return spti_locate(&model, moekrs->smooth, component, settings, count, rays, hits, places);
}
