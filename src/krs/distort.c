/* SPDX-License-Identifier: MIT
 *
 * Distorted fields: the door, and the callbacks of the fields that it makes. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "../base/columns.h"
#include "../base/marks.h"
#include "../bound/bound_check.h"
#include "../trace/driver.h"
#include "distort.h"

/* Where the inner field is asked. */
typedef struct distort_points {
    SPTI_ALIGNED(64) float x[SPT_BATCH];
    SPTI_ALIGNED(64) float y[SPT_BATCH];
    SPTI_ALIGNED(64) float z[SPT_BATCH];
    SPTI_ALIGNED(64) float apart[SPT_BATCH]; /* of a map: 0, or NaN where it leads nowhere */
} distort_points;

static const spti_distort_kernels *kernels(void) {
    return spti_distort_kernels_of[spti_isa_choose(0)];
}

/* ---- A caller's map ------------------------------------------------------------------------- */

/* What is infinite becomes finite, and what is no number 0, and is noted. */
static void mend(size_t n, float *value, float *fault) {
    for (size_t i = 0; i < n; ++i) {
        const float a = value[i];
        if (isunordered(a, a)) fault[i] = NAN;
        value[i] = isunordered(a, a) ? 0.0f : a < -FLT_MAX ? -FLT_MAX : a > FLT_MAX ? FLT_MAX : a;
    }
}

static void ask_map(const spt_distorted *distorted, size_t n, distort_points *points) {
    const spt_distortion *const map = &distorted->distortion;
    map->unmap(map->user, n, points->x, points->y, points->z);
}

static void move_by_map(const spt_distorted *distorted, size_t n, const float *x, const float *y,
                        const float *z, distort_points *points) {
    memcpy(points->x, x, n * sizeof *x);
    memcpy(points->y, y, n * sizeof *y);
    memcpy(points->z, z, n * sizeof *z);
    ask_map(distorted, n, points);
    for (size_t i = 0; i < n; ++i) points->apart[i] = 0.0f;
    mend(n, points->x, points->apart);
    mend(n, points->y, points->apart);
    mend(n, points->z, points->apart);
}

/* The step of differences, world length: a thousandth of the bound, as maps seldom have finer
 * details, and no less than loses half of the digits. */
static float map_step(const spt_bound *bound) {
    float low[3], high[3], largest = 0.0f, coordinate = 0.0f;
    if (spt_bound_extent(bound, low, high) != SPT_OK) return 0x1p-10f;
    for (int axis = 0; axis < 3; ++axis) {
        const float half = 0.5f * high[axis] - 0.5f * low[axis];
        if (half > largest) largest = half;
        if (fabsf(low[axis]) > coordinate) coordinate = fabsf(low[axis]);
        if (fabsf(high[axis]) > coordinate) coordinate = fabsf(high[axis]);
    }
    if (!spti_finite(largest)) return 0x1p-10f;
    const float step = largest * 0x1p-10f, least = coordinate * 0x1p-14f;
    return step > least ? step : least;
}

/* J^T g from central differences of the map along one axis of the world. */
static void pull_along(const spt_distorted *distorted, size_t n, const float *const at[3], int axis,
                       float step, float given[3][SPT_BATCH], float *gradient) {
    distort_points ahead, behind;
    memcpy(ahead.x, at[0], n * sizeof(float));
    memcpy(ahead.y, at[1], n * sizeof(float));
    memcpy(ahead.z, at[2], n * sizeof(float));
    memcpy(&behind, &ahead, offsetof(distort_points, apart));
    float *const forth = axis == 0 ? ahead.x : axis == 1 ? ahead.y : ahead.z;
    float *const back = axis == 0 ? behind.x : axis == 1 ? behind.y : behind.z;
    for (size_t i = 0; i < n; ++i) {
        const float here = at[axis][i];
        forth[i] = here + step < FLT_MAX ? here + step : FLT_MAX;
        back[i] = here - step > -FLT_MAX ? here - step : -FLT_MAX;
        gradient[i] = forth[i] - back[i];
    }
    ask_map(distorted, n, &ahead);
    ask_map(distorted, n, &behind);
    for (size_t i = 0; i < n; ++i) {
        const float sum = given[0][i] * (ahead.x[i] - behind.x[i]) +
                          given[1][i] * (ahead.y[i] - behind.y[i]) +
                          given[2][i] * (ahead.z[i] - behind.z[i]);
        gradient[i] = gradient[i] > 0.0f ? sum / gradient[i] : 0.0f;
    }
}

/* ---- Callbacks ------------------------------------------------------------------------------ */

/* The point may be overwritten once the inner field was asked: what is needed of it later is kept
 * in apart. */
static void distorted_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *distance) {
    const spt_distorted *const distorted = user;
    const spti_distort_kernels *const run = kernels();
    distort_points points;
    run->move(distorted, n, x, y, z, points.x, points.y, points.z, points.apart);
    spti_ask_groups(&distorted->inner, n, points.x, points.y, points.z, distance);
    run->settle(distorted->inner.lipschitz * distorted->distortion.lipschitz, n, points.apart,
                distance);
}

static void mapped_distance(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *distance) {
    const spt_distorted *const distorted = user;
    distort_points points;
    move_by_map(distorted, n, x, y, z, &points);
    spti_ask_groups(&distorted->inner, n, points.x, points.y, points.z, distance);
    for (size_t i = 0; i < n; ++i) distance[i] += points.apart[i];
}

/* Outside of the region that of its nearest point. */
static void distorted_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                               float *gradient_x, float *gradient_y, float *gradient_z) {
    const spt_distorted *const distorted = user;
    const spt_field *const inner = &distorted->inner;
    const spti_distort_kernels *const run = kernels();
    distort_points points;
    run->move(distorted, n, x, y, z, points.x, points.y, points.z, points.apart);
    inner->gradient(inner->user, n, points.x, points.y, points.z, gradient_x, gradient_y,
                    gradient_z);
    run->pull(distorted, n, x, y, z, gradient_x, gradient_y, gradient_z);
}

static void mapped_gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                            float *gradient_x, float *gradient_y, float *gradient_z) {
    const spt_distorted *const distorted = user;
    const spt_field *const inner = &distorted->inner;
    const float *const at[3] = {x, y, z};
    const float step = map_step(&distorted->bound);
    SPTI_ALIGNED(64) float given[3][SPT_BATCH];
    distort_points points;
    move_by_map(distorted, n, x, y, z, &points);
    inner->gradient(inner->user, n, points.x, points.y, points.z, given[0], given[1], given[2]);
    for (size_t i = 0; i < n; ++i) given[0][i] += points.apart[i];
    pull_along(distorted, n, at, 0, step, given, gradient_x);
    pull_along(distorted, n, at, 1, step, given, gradient_y);
    pull_along(distorted, n, at, 2, step, given, gradient_z);
}

/* ---- The door ------------------------------------------------------------------------------- */

static int numbers_are_good(const spt_distortion *distortion) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_within(distortion->origin[axis], -1e18f, 1e18f)) return 0;
        if (!spti_finite(distortion->axis[axis]) || !spti_finite(distortion->side[axis])) return 0;
    }
    return spti_finite(distortion->rate) && spti_finite(distortion->wave) &&
           spti_within(distortion->phase, -1e4f, 1e4f);
}

/* What a caller says of a map. */
static spt_status take_map(spt_distorted *made) {
    const spt_distortion *const map = &made->distortion;
    if (map->unmap == NULL || map->bound == NULL) return SPT_BAD_ARGUMENT;
    if (!(map->lipschitz > 0.0f) || !spti_finite(map->lipschitz)) return SPT_BAD_ARGUMENT;
    if (!spti_bound_copy(&made->bound, map->bound)) return SPT_BAD_ARGUMENT;
    memset(made->frame, 0, sizeof made->frame);
    return SPT_OK;
}

/* A phase has no whole turns to lose digits by. */
static float without_turns(float phase) {
    const double turn = 6.283185307179586;
    return (float)((double)phase - turn * floor((double)phase / turn + 0.5));
}

spt_status spt_distorted_field(const spt_field *field, const spt_distortion *distortion,
                               spt_distorted *memory, spt_field *result) {
    spt_distorted made;
    spt_status status;
    if (distortion == NULL || memory == NULL || result == NULL) return SPT_BAD_ARGUMENT;
    made.inner_bound = spt_bound_sphere(0, 0, 0, 1);
    if (!spti_field_copy(&made.inner, &made.inner_bound, field)) return SPT_BAD_ARGUMENT;
    made.distortion = spt_distortion_default();
    if (!spti_copy_sized(&made.distortion, distortion, sizeof made.distortion)) {
        return SPT_BAD_ARGUMENT;
    }
    const uint32_t kind = made.distortion.kind;
    if (kind < SPT_DISTORTION_TWIST || kind > SPT_DISTORTION_MAP) return SPT_BAD_ARGUMENT;
    if (!numbers_are_good(&made.distortion)) return SPT_BAD_ARGUMENT;
    const int mapped = kind == SPT_DISTORTION_MAP;
    made.distortion.phase = without_turns(made.distortion.phase);
    status = mapped ? take_map(&made) : spti_distort_settle(&made);
    if (status != SPT_OK) return status;
    spt_field deformed = spt_field_default();
    deformed.batch = mapped ? mapped_distance : distorted_distance;
    if (made.inner.gradient != NULL) {
        deformed.gradient = mapped ? mapped_gradient : distorted_gradient;
    }
    deformed.user = memory;
    deformed.glsl = spti_mark_distorted;
    deformed.lipschitz = made.inner.lipschitz * made.distortion.lipschitz;
    if (!spti_within(deformed.lipschitz, 0x1p-100f, 0x1p100f)) return SPT_BAD_ARGUMENT;
    deformed.bound = made.distortion.bound = &memory->bound;
    if (made.inner.bound != NULL) made.inner.bound = &memory->inner_bound;
    *memory = made;
    *result = deformed;
    return SPT_OK;
}

/* ---- Points --------------------------------------------------------------------------------- */

/* A window of points, filled up to whole groups; what is not finite is 0. */
static size_t read_window(const spt_vectors *points, size_t first, size_t window,
                          float at[3][SPT_BATCH], float fault[SPT_BATCH]) {
    const size_t whole = (window + SPTI_GROUP - 1) / SPTI_GROUP * SPTI_GROUP;
    for (size_t i = 0; i < whole; ++i) {
        const size_t index = first + (i < window ? i : window - 1);
        float value[3];
        int good = 1;
        for (int axis = 0; axis < 3; ++axis) {
            value[axis] = spti_read(&points->axis[axis], index, 0.0f);
            good &= spti_finite(value[axis]);
        }
        for (int axis = 0; axis < 3; ++axis) at[axis][i] = good ? value[axis] : 0.0f;
        fault[i] = good ? 0.0f : NAN;
    }
    return whole;
}

spt_status spt_distorted_points(const spt_distorted *distorted, size_t count,
                                const spt_vectors *points, const spt_vector_sinks *undistorted) {
    if (distorted == NULL || points == NULL || undistorted == NULL) return SPT_BAD_ARGUMENT;
    for (int axis = 0; axis < 3; ++axis) {
        const spt_column *const column = &points->axis[axis];
        const spt_sink *const sink = &undistorted->axis[axis];
        if (column->first == NULL || !spti_column_fits(column, count)) return SPT_BAD_ARGUMENT;
        if (sink->first == NULL || !spti_sink_fits(sink, count)) return SPT_BAD_ARGUMENT;
    }
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t window = count - first < SPT_BATCH ? count - first : SPT_BATCH;
        SPTI_ALIGNED(64) float at[3][SPT_BATCH];
        SPTI_ALIGNED(64) float fault[SPT_BATCH];
        distort_points moved;
        const size_t whole = read_window(points, first, window, at, fault);
        if (distorted->distortion.kind == SPT_DISTORTION_MAP) {
            move_by_map(distorted, whole, at[0], at[1], at[2], &moved);
            for (size_t i = 0; i < window; ++i) fault[i] += moved.apart[i];
        } else {
            kernels()->move(distorted, whole, at[0], at[1], at[2], moved.x, moved.y, moved.z,
                            moved.apart);
        }
        for (size_t i = 0; i < window; ++i) {
            spti_write(&undistorted->axis[0], first + i, moved.x[i] + fault[i]);
            spti_write(&undistorted->axis[1], first + i, moved.y[i] + fault[i]);
            spti_write(&undistorted->axis[2], first + i, moved.z[i] + fault[i]);
        }
    }
    return SPT_OK;
}
