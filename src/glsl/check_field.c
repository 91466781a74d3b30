/* SPDX-License-Identifier: MIT
 *
 * Places at which a field's callback and its text can be compared. */
#include <math.h>

#include "../base/arguments.h"
#include "../base/random.h"
#include "../bound/bound_check.h"
#include "../trace/driver.h"

#include <spheretrace/glsl.h>

enum {
    POINTS = 32,   /* at a time: each second one is moved, */
    APPROACHES = 3 /* so often, */
};

/* Where points are drawn. */
typedef struct place {
    const spt_bound *bound; /* a copy, or NULL */
    float low[3], high[3];
    uint32_t random;
} place;

static void settle_box(place *in) {
    int finite = in->bound != NULL;
    for (int axis = 0; axis < 3 && finite; ++axis) {
        finite = spti_finite(in->bound->low[axis]) && spti_finite(in->bound->high[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
        in->low[axis] = finite ? in->bound->low[axis] : -1.0f;
        in->high[axis] = finite ? in->bound->high[axis] : 1.0f;
    }
}

static int is_inside(const place *in, const float point[3]) {
    static const float direction[3] = {1, 0, 0};
    float t_in, t_out;
    if (in->bound == NULL || spti_bound_asks(in->bound)) return 1;
    spti_bound_interval(in->bound, point, direction, 0.0f, 0.0f, &t_in, &t_out);
    return t_in <= t_out;
}

/* A point of the bound; of its box where that is almost empty. */
static void draw_point(place *in, float point[3]) {
    for (int attempt = 0; attempt < 64; ++attempt) {
        for (int axis = 0; axis < 3; ++axis) {
            const float share = spti_draw_share(&in->random);
            point[axis] = in->low[axis] * (1.0f - share) + in->high[axis] * share;
        }
        if (is_inside(in, point)) return;
    }
}

typedef struct samples {
    SPTI_ALIGNED(64) float point[3][8 * POINTS];
    SPTI_ALIGNED(64) float distance[8 * POINTS];
} samples;

/* Moves every second point by f along the gradient, as six differences see it. */
static void approach(const spt_field *field, const place *in, float points[POINTS][4]) {
    samples near;
    const float step[3] = {0x1p-10f * (in->high[0] - in->low[0]),
                           0x1p-10f * (in->high[1] - in->low[1]),
                           0x1p-10f * (in->high[2] - in->low[2])};
    for (int i = 0; i < POINTS; ++i) {
        for (int k = 0; k < 8; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                const float side = k / 2 != axis ? 0.0f : k % 2 == 0 ? step[axis] : -step[axis];
                near.point[axis][8 * i + k] = points[i][axis] + side;
            }
        }
    }
    spti_ask(field, 8 * POINTS, near.point[0], near.point[1], near.point[2], near.distance);
    for (int i = 1; i < POINTS; i += 2) {
        const float *const f = &near.distance[8 * i];
        float gradient[3], moved[3], square = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            gradient[axis] = (f[2 * axis] - f[2 * axis + 1]) / (2.0f * step[axis] + FLT_MIN);
            square += gradient[axis] * gradient[axis];
        }
        for (int axis = 0; axis < 3; ++axis) {
            moved[axis] = points[i][axis] - f[7] * gradient[axis] / square;
        }
        if (spti_finite(moved[0]) && spti_finite(moved[1]) && spti_finite(moved[2]) &&
            is_inside(in, moved)) {
            memcpy(points[i], moved, sizeof moved);
        }
    }
}

spt_status spt_glsl_check_field(const spt_field *field, uint32_t count, uint32_t seed,
                                float *points) {
    spt_field copy;
    spt_bound bound;
    if (points == NULL || count == 0 || count > 1u << 20) return SPT_BAD_ARGUMENT;
    if (!spti_field_copy(&copy, &bound, field)) return SPT_BAD_ARGUMENT;
    place in = {copy.bound != NULL ? &bound : NULL, {0}, {0}, seed};
    settle_box(&in);
    for (uint32_t first = 0; first < count; first += POINTS) {
        const uint32_t window = count - first < POINTS ? count - first : POINTS;
        float drawn[POINTS][4];
        samples asked;
        for (int i = 0; i < POINTS; ++i) draw_point(&in, drawn[i]);
        for (int round = 0; round < APPROACHES; ++round) approach(&copy, &in, drawn);
        for (int i = 0; i < POINTS; ++i) {
            for (int axis = 0; axis < 3; ++axis) asked.point[axis][i] = drawn[i][axis];
        }
        spti_ask(&copy, POINTS, asked.point[0], asked.point[1], asked.point[2], asked.distance);
        for (int i = 0; i < POINTS; ++i) drawn[i][3] = asked.distance[i];
        memcpy(points + 4 * (size_t)first, drawn, window * sizeof drawn[0]);
    }
    return SPT_OK;
}
