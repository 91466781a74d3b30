/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences: building them, and the field that they are. */
#include <math.h>

#include "../base/arguments.h"
#include "../base/marks.h"
#include "../bound/bound_check.h"
#include "../trace/driver.h"
#include "locate.h"

/* A mirror of unit normal, or 0. One that is unit up to rounding keeps its bits. */
static int build_mirror(spt_mirror *mirror) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(mirror->normal[axis])) return 0;
        square += (double)mirror->normal[axis] * (double)mirror->normal[axis];
    }
    if (!spti_finite(mirror->offset) || !(square > 0)) return 0;
    if (fabs(square - 1) <= 0x1p-22) return fabsf(mirror->offset) <= SPTI_FARTHEST;
    const double factor = 1 / sqrt(square), offset = (double)mirror->offset * factor;
    for (int axis = 0; axis < 3; ++axis) {
        mirror->normal[axis] = (float)((double)mirror->normal[axis] * factor);
    }
    mirror->offset = (float)offset;
    return fabsf(mirror->offset) <= SPTI_FARTHEST;
}

static int build_levels(const spt_krs_model *model, spt_krs *krs) {
    spti_ball whole, kernel;
    if (!spti_build_kernel(&model->kernels[0], &krs->kernels[0], &whole)) return 0;
    for (uint32_t level = 0; level < model->levels; ++level) {
        int straddles;
        krs->mirrors[level] = model->mirrors[level];
        if (!build_mirror(&krs->mirrors[level])) return 0;
        if (!spti_build_kernel(&model->kernels[level + 1], &krs->kernels[level + 1], &kernel)) {
            return 0;
        }
        whole = spti_mirror_ball(&whole, &krs->mirrors[level], &straddles);
        if (straddles) krs->straddles |= UINT64_C(1) << level;
        whole = spti_ball_around(&whole, &kernel);
    }
    krs->bounded = spti_bound_of_ball(&whole, &krs->bound);
    return 1;
}

spt_status spt_krs_build(const spt_krs_model *model, spt_krs *krs) {
    spt_krs_model copy = spt_krs_model_default();
    spt_krs built;
    if (model == NULL || krs == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_copy_sized(&copy, model, sizeof copy)) return SPT_BAD_ARGUMENT;
    if (!spti_model_is_good(copy.levels, copy.kernels, copy.mirrors, copy.smooth, copy.max_lanes)) {
        return SPT_BAD_ARGUMENT;
    }
    memset(&built, 0, sizeof built);
    built.levels = copy.levels;
    built.max_lanes = copy.max_lanes;
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
    *krs = built;
    return SPT_OK;
}

/* As the kernels take it. */
static spti_stretch stretch_of(const spt_krs *krs) {
    const spti_stretch model = {krs->levels,  krs->levels,  0,    1, 0,
                                krs->kernels, krs->mirrors, NULL, 0};
    return model;
}

/* Where a caller's field is asked in between. */
static SPTI_NOINLINE void distance_with_fields(const spt_krs *krs, size_t n, const float *x,
                                               const float *y, const float *z, float *distance) {
    const spti_stretch model = stretch_of(krs);
    SPTI_ALIGNED(64) float folded[3][SPT_BATCH];
    const spti_way way = {.x = folded[0], .y = folded[1], .z = folded[2], .distance = distance};
    memcpy(folded[0], x, n * sizeof *x);
    memcpy(folded[1], y, n * sizeof *y);
    memcpy(folded[2], z, n * sizeof *z);
    spti_walk(&model, SPTI_WALK_FOLD, krs->max_lanes, n, &way);
}

static void krs_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    const spt_krs *const krs = user;
    if (krs->field_kernels != 0) {
        distance_with_fields(krs, n, x, y, z, distance);
    } else { /* in one stretch, where points stay in registers */
        const spti_stretch model = stretch_of(krs);
        const spti_way way = {.x = spti_unwritten(x),
                              .y = spti_unwritten(y),
                              .z = spti_unwritten(z),
                              .distance = distance};
        spti_walk(&model, SPTI_WALK_FOLD, krs->max_lanes, n, &way);
    }
    spti_settle_far(n, x, y, z, distance);
}

static float krs_point(void *user, float x, float y, float z) {
    const spti_stretch model = stretch_of(user);
    SPTI_ALIGNED(64) float distance[SPTI_GROUP];
    float folded[3] = {x, y, z};
    const spti_way way = {.x = &folded[0], .y = &folded[1], .z = &folded[2], .distance = distance};
    spti_walk(&model, SPTI_WALK_FOLD, 1, 1, &way);
    spti_settle_far(1, &x, &y, &z, distance);
    return distance[0];
}

static void krs_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *gradient_x, float *gradient_y, float *gradient_z) {
    const spt_krs *const krs = user;
    const spti_stretch model = stretch_of(krs);
    spti_place_gradients(&model, krs->smooth, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

spt_field spt_krs_field(const spt_krs *krs) {
    spt_field field = spt_field_default();
    if (krs == NULL) return field;
    field.batch = krs_distance;
    field.point = krs_point;
    field.user = (void *)(uintptr_t)krs; /* only read */
    field.bound = krs->bounded ? &krs->bound : NULL;
    field.glsl = spti_mark_krs;
    field.gradient = spti_have_gradients(krs->kernels, krs->levels) ? krs_gradient : NULL;
    return field;
}

double spt_krs_instances(uint32_t levels) {
    double twice = 2;
    for (uint32_t level = 0; level < levels; ++level) twice *= 2;
    return twice - 1;
}

spt_status spt_krs_locate(const spt_krs *krs, int32_t component, const spt_settings *settings,
                          size_t count, const spt_rays *rays, const spt_hits *hits,
                          const spt_krs_places *places) {
    if (krs == NULL) return SPT_BAD_ARGUMENT;
    const spti_stretch model = stretch_of(krs);
    return spti_locate(&model, krs->smooth, component, settings, count, rays, hits, places);
}
