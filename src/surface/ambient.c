/* SPDX-License-Identifier: MIT
 *
 * Ambient occlusion from samples of the distance along the normal (Evans 2006). */
#include <float.h>

#include "../base/arguments.h"
#include "landing.h"

enum { MOST_SAMPLES = 16 };

typedef struct ambient_call {
    const spt_field *fields;
    size_t field_count;
    uint32_t samples;
    float distance;
    const spt_vectors *points, *normals;
    const spt_sink *openness;
} ambient_call;

/* The whole points of a window side by side. */
typedef struct ambient_batch {
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
    float point[3][SPT_BATCH], normal[3][SPT_BATCH];
    float open[SPT_BATCH]; /* of one sample: from 0, closed, to 1 */
    float sum[SPT_BATCH];  /* of the samples, weighed */
    uint16_t place[SPT_BATCH];
    size_t count;
} ambient_batch;

static float along(const ambient_batch *batch, int axis, size_t slot, float t) {
    return batch->point[axis][slot] + t * batch->normal[axis][slot];
}

/* Whether the samples of the point in a slot are finite: all lie between it and the farthest. */
static int is_whole(const ambient_batch *batch, size_t slot, float farthest) {
    int whole = 1;
    for (int axis = 0; axis < 3; ++axis) {
        whole &= spti_finite(batch->point[axis][slot]);
        whole &= spti_finite(along(batch, axis, slot, farthest));
    }
    return whole;
}

static void load(const ambient_call *call, size_t first, size_t window, ambient_batch *batch) {
    const float farthest = (float)call->samples * call->distance;
    batch->count = 0;
    for (size_t i = 0; i < window; ++i) {
        const size_t slot = batch->count;
        for (int axis = 0; axis < 3; ++axis) {
            batch->point[axis][slot] = spti_read(&call->points->axis[axis], first + i, 0.0f);
            batch->normal[axis][slot] = spti_read(&call->normals->axis[axis], first + i, 0.0f);
        }
        batch->place[slot] = (uint16_t)i;
        batch->sum[slot] = 0.0f;
        batch->count += (size_t)is_whole(batch, slot, farthest);
    }
}

/* How open all points are at t along their normals, through every field. A value that is NaN or
 * -infinity closes. */
static void sample(const ambient_call *call, float t, ambient_batch *batch) {
    for (size_t slot = 0; slot < batch->count; ++slot) batch->open[slot] = 1.0f;
    for (size_t index = 0; index < call->field_count; ++index) {
        spti_target target;
        spti_target_of(&target, call->fields, index, NULL);
        for (size_t slot = 0; slot < batch->count; ++slot) {
            batch->x[slot] = along(batch, 0, slot, t);
            batch->y[slot] = along(batch, 1, slot, t);
            batch->z[slot] = along(batch, 2, slot, t);
        }
        spti_ask(&target.field, batch->count, batch->x, batch->y, batch->z, batch->distance);
        const float inverse_lipschitz = 1.0f / target.field.lipschitz;
        for (size_t slot = 0; slot < batch->count; ++slot) {
            const float ratio = batch->distance[slot] * inverse_lipschitz / t;
            const float open = ratio > 0.0f ? ratio : 0.0f;
            batch->open[slot] = open < batch->open[slot] ? open : batch->open[slot];
        }
    }
}

/* The formula of the header, divided by D: 1 - sum of w_i (1 - open_i) over sum of w_i is sum of
 * w_i open_i over sum of w_i, w_i = i 2^-i. All w_i are exact, so that above a plane both sums are
 * the same. */
static void window_openness(const ambient_call *call, size_t first, size_t window) {
    ambient_batch batch;
    float weight = 1.0f, weights = 0.0f;
    load(call, first, window, &batch);
    for (uint32_t i = 1; i <= call->samples; ++i) {
        weight *= 0.5f;
        const float share = (float)i * weight;
        sample(call, (float)i * call->distance, &batch);
        for (size_t slot = 0; slot < batch.count; ++slot) {
            batch.sum[slot] += share * batch.open[slot];
        }
        weights += share;
    }
    for (size_t i = 0, slot = 0; i < window; ++i) {
        const int whole = slot < batch.count && batch.place[slot] == i;
        spti_write(call->openness, first + i, whole ? batch.sum[slot] / weights : 0.0f);
        slot += (size_t)whole;
    }
}

spt_status spt_ambient_occlusion(const spt_field *fields, size_t field_count, uint32_t samples,
                                 float distance, size_t count, const spt_vectors *points,
                                 const spt_vectors *normals, const spt_sink *openness) {
    const ambient_call call = {fields, field_count, samples, distance, points, normals, openness};
    if (!spti_fields_are_good(fields, field_count)) return SPT_BAD_ARGUMENT;
    if (samples < 1 || samples > MOST_SAMPLES) return SPT_BAD_ARGUMENT;
    if (!(distance > 0.0f) || !spti_finite(distance)) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (points == NULL || normals == NULL || openness == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_vectors_fit(points, count) || !spti_vectors_fit(normals, count)) {
        return SPT_BAD_ARGUMENT;
    }
    if (openness->first == NULL || !spti_sink_fits(openness, count)) return SPT_BAD_ARGUMENT;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        window_openness(&call, first, spti_window(first, count));
    }
    return SPT_OK;
}
