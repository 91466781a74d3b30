/* SPDX-License-Identifier: MIT
 *
 * Looks for geometry that mirrors cut off, at random points of its surface. */
#include <math.h>
#include <string.h>

#include "../base/arguments.h"
#include "../base/random.h"
#define SPT_LANES 1
#include "locate.h"
#include "shape_kernel.h"

enum { MOST_SAMPLES = 1 << 20, ROUNDS = 16, ATTEMPTS = 16 };

static float magnitude_of(const float point[3]) {
    float largest = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        if (fabsf(point[axis]) > largest) largest = fabsf(point[axis]);
    }
    return largest;
}

/* The gradient of a kernel's distance: for callers' fields with its length, which may be anything
 * up to 1, from values around. */
static void slope_at(const spt_built_kernel *kernel, const float point[3], double slope[3]) {
    const float step = kernel->number[SHAPE_EXTENT] * 0x1p-10f;
    if (kernel->kind != SPT_KERNEL_FIELD) {
        spti_kernel_gradient(kernel, point, slope);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        float beside[3] = {point[0], point[1], point[2]};
        beside[axis] = point[axis] + step;
        const float after = spti_kernel_distance(kernel, beside);
        beside[axis] = point[axis] - step;
        const float before = spti_kernel_distance(kernel, beside);
        slope[axis] = ((double)after - (double)before) / (2 * (double)step);
    }
}

/* A point of a kernel's surface, from a random one of the ball around it along the gradient.
 * Returns 0 where that does not lead there. */
static int draw_surface(const spt_built_kernel *kernel, uint32_t *state, float point[3]) {
    const float extent = kernel->number[SHAPE_EXTENT];
    float inside[3] = {0, 0, 0};
    for (int attempt = 0; attempt < ATTEMPTS; ++attempt) {
        float square = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            inside[axis] = 2.0f * spti_draw_share(state) - 1.0f;
            square += inside[axis] * inside[axis];
        }
        if (square <= 1.0f) break;
    }
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = kernel->number[SHAPE_CENTER + axis] + extent * inside[axis];
    }
    for (int round = 0; round < ROUNDS; ++round) {
        double slope[3];
        const float distance = spti_kernel_distance(kernel, point);
        if (!spti_finite(distance)) return 0;
        if (fabsf(distance) <= 0x1p-20f * (magnitude_of(point) + extent)) return 1;
        /* Newton's rule, by no more than the extent. */
        slope_at(kernel, point, slope);
        const double square = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
        double share = (double)distance / (square > 1e-12 ? square : 1e-12);
        const double most = (double)extent / sqrt(square > 1e-12 ? square : 1e-12);
        share = share > most ? most : share < -most ? -most : share;
        for (int axis = 0; axis < 3; ++axis) point[axis] -= (float)(share * slope[axis]);
    }
    return 0;
}

/* How far a point is beyond a mirror, beyond rounding. */
static float beyond_by(const spt_mirror *mirror, const float point[3]) {
    const float noise = 0x1p-18f * (magnitude_of(point) + fabsf(mirror->offset));
    float beyond = -mirror->offset;
    for (int axis = 0; axis < 3; ++axis) beyond += mirror->normal[axis] * point[axis];
    return beyond > noise ? beyond : 0.0f;
}

static void reflect(const spt_mirror *mirror, float point[3]) {
    double beyond = -(double)mirror->offset;
    for (int axis = 0; axis < 3; ++axis) {
        beyond += (double)mirror->normal[axis] * (double)point[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] -= (float)(2 * beyond * (double)mirror->normal[axis]);
    }
}

/* A point of kernel `from` as one of its images that L_level has. Returns 0 where a mirror before
 * has cut that off. */
static int carry(const spt_krs *krs, uint32_t from, uint32_t level, uint32_t *state,
                 float point[3]) {
    for (uint32_t i = from; i < level; ++i) {
        if (beyond_by(&krs->mirrors[i], point) > 0.0f) return 0;
        if (spti_draw(state) >> 31) reflect(&krs->mirrors[i], point);
    }
    return 1;
}

static void note(spt_krs_faults *faults, uint32_t level, const float point[3], float beyond) {
    faults->samples[level] += 1;
    if (!(beyond > 0.0f)) return;
    faults->discarded[level] += 1;
    if (!(beyond > faults->depth[level])) return;
    faults->depth[level] = beyond;
    memcpy(faults->worst[level], point, sizeof faults->worst[level]);
}

spt_status spt_krs_check(const spt_krs *krs, uint32_t samples, uint32_t seed,
                         spt_krs_faults *faults) {
    uint32_t finite[SPT_KRS_LEVELS + 1], count = 0, state = seed;
    spt_krs_faults found;
    if (krs == NULL || faults == NULL || samples == 0 || samples > MOST_SAMPLES) {
        return SPT_BAD_ARGUMENT;
    }
    for (uint32_t level = 0; level <= krs->levels; ++level) {
        const spt_built_kernel *const kernel = &krs->kernels[level];
        const int has_end = spti_finite(kernel->number[SHAPE_EXTENT]);
        if (kernel->kind != SPT_KERNEL_EMPTY && has_end) finite[count++] = level;
    }
    if (count == 0) return SPT_UNSUPPORTED;
    memset(&found, 0, sizeof found);
    for (uint32_t level = 0; level < krs->levels; ++level) {
        uint32_t lower = 0;
        for (uint32_t i = 0; i < count; ++i) lower += finite[i] <= level;
        for (uint32_t sample = 0; sample < samples && lower > 0; ++sample) {
            const uint32_t from = finite[spti_draw(&state) % lower];
            float point[3];
            if (!draw_surface(&krs->kernels[from], &state, point)) continue;
            if (!carry(krs, from, level, &state, point)) continue;
            note(&found, level, point, beyond_by(&krs->mirrors[level], point));
        }
    }
    *faults = found;
    return SPT_OK;
}
