/* SPDX-License-Identifier: MIT
 *
 * Points on their way through a model: in one stretch where all kernels are the library's own, else
 * from one caller's field to the next. */
#include <math.h>

#include "../trace/driver.h"
#include "sequence.h"

/* Where the callback may scribble. */
typedef struct walk_points {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH];
} walk_points;

void spti_ask_kernel(const spt_built_kernel *kernel, size_t n, const spti_way *way,
                     float *distance) {
    walk_points points;
    spt_field field = spt_field_default();
    field.batch = kernel->batch;
    field.point = kernel->point;
    field.user = kernel->user;
    for (size_t i = 0; i < n; ++i) {
        points.x[i] = spti_in_range(way->x[i]);
        points.y[i] = spti_in_range(way->y[i]);
        points.z[i] = spti_in_range(way->z[i]);
    }
    spti_ask(&field, n, points.x, points.y, points.z, distance);
    for (size_t i = 0; i < n; ++i) distance[i] /= kernel->lipschitz;
}

static SPTI_NOINLINE void join_field(const spt_built_kernel *kernel, spti_walk_kind kind, size_t n,
                                     const spti_way *way) {
    SPTI_ALIGNED(64) float asked[SPT_BATCH];
    spti_ask_kernel(kernel, n, way, asked);
    for (size_t i = 0; i < n; ++i) {
        float k = asked[i];
        if (kind == SPTI_WALK_PULL) {
            k = spti_free_radius(k, way->shrink[i], way->reach[i]);
            if (way->clear[i] > 0.0f && k < way->clear[i]) k = way->clear[i];
        }
        if (kind == SPTI_WALK_PROBE) {
            if (way->radius[i] < 0.0f) continue;
            k -= way->radius[i];
        }
        /* NaN is taken, and stays. */
        if (!isnan(way->distance[i]) && !(way->distance[i] <= k)) way->distance[i] = k;
    }
}

void spti_walk(const spti_stretch *model, spti_walk_kind kind, uint32_t max_lanes, size_t n,
               const spti_way *way) {
    const spti_krs_kernels *const kernels = spti_krs_kernels_of[spti_isa_choose(max_lanes)];
    spti_stretch_fn *const through = kind == SPTI_WALK_FOLD   ? kernels->fold
                                     : kind == SPTI_WALK_PULL ? kernels->pull
                                                              : kernels->probe;
    spti_stretch stretch = *model;
    stretch.begins = 1;
    for (uint32_t level = model->levels + 1; level-- > 0;) {
        const int asks = model->kernels[level].kind == SPT_KERNEL_FIELD;
        if (level > 0 && !asks) continue;
        stretch.last = level;
        stretch.goes_on = asks;
        through(&stretch, n, way);
        if (asks) join_field(&model->kernels[level], kind, n, way);
        stretch.first = level - 1;
        stretch.begins = 0;
    }
}

/* How far a coordinate is beyond. */
static double beyond(float coordinate) {
    const double most = (double)SPTI_FARTHEST, magnitude = fabs((double)coordinate);
    return magnitude > most ? magnitude - most : 0;
}

static double way_back(float x, float y, float z) {
    return sqrt(beyond(x) * beyond(x) + beyond(y) * beyond(y) + beyond(z) * beyond(z));
}

/* Whether any point is beyond; without a branch a point. */
static int any_is_far(size_t n, const float *x, const float *y, const float *z) {
    int any = 0;
    for (size_t i = 0; i < n; ++i) {
        any |= fabsf(x[i]) > SPTI_FARTHEST;
        any |= fabsf(y[i]) > SPTI_FARTHEST;
        any |= fabsf(z[i]) > SPTI_FARTHEST;
    }
    return any;
}

void spti_settle_far(size_t n, const float *x, const float *y, const float *z, float *distance) {
    if (!any_is_far(n, x, y, z)) return;
    for (size_t i = 0; i < n; ++i) {
        const double way = way_back(x[i], y[i], z[i]), d = (double)distance[i];
        if (!(way > 0)) continue;
        const double joined = sqrt(d * d + way * way);
        distance[i] = (float)(d < 0 ? -joined : joined);
    }
}

void spti_settle_far_balls(size_t n, const float *x, const float *y, const float *z,
                           const float *radius, float *clearance) {
    if (!any_is_far(n, x, y, z)) return;
    for (size_t i = 0; i < n; ++i) {
        const double way = way_back(x[i], y[i], z[i]) - (double)radius[i];
        if (way >= 0 && !(clearance[i] >= (float)way)) clearance[i] = (float)way;
    }
}
