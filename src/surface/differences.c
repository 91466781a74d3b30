/* SPDX-License-Identifier: MIT
 *
 * Differences of f over four points at the corners of a tetrahedron, or over six along the axes.
 *
 * The step h. A value of f is off by about u C, with u = 2^-24 and C the largest coordinate in the
 * callback's arithmetic, so a difference turns the gradient by u C / h; curvature 1 / R turns it by
 * h / R over four points, whose offsets do not balance, and by (h / R)^2 over six, which do. Both
 * are least together at h = sqrt(u C R) and h = (u C R^2)^(1/3). */
#include "differences.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "../base/arguments.h"
#include "../trace/driver.h"
#include "landing.h"

#define HALF_ULP 0x1p-24f

/* Where the values are taken, and how they are weighed; in units of the step. */
static const signed char corners[4][3] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
static const signed char axes[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                       {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};

/* The cube root of a number from 2^-40 to 2^20, to 1e-3 or better: from a third of the exponent,
 * then Newton's rule. */
static float cube_root(float a) {
    uint32_t bits;
    float root;
    memcpy(&bits, &a, sizeof bits);
    bits = bits / 3 + 0x2a5137a0u; /* two thirds of the exponent's bias */
    memcpy(&root, &bits, sizeof root);
    for (int i = 0; i < 2; ++i) root = (2.0f * root + a / (root * root)) * (1.0f / 3.0f);
    return root;
}

/* The power of two at or below a number, which may be 0. */
static float power_below(float a) {
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    bits &= 0x7f800000u;
    memcpy(&a, &bits, sizeof a);
    return a;
}

/* In units of R first, so that nothing over- or underflows. A power of two, and at least the last
 * place of the largest coordinate: then the points lie where they are said to lie, without the
 * rounding of p + h. */
static float step_of(spt_normal_rule rule, float detail, float reach, float least) {
    float ratio = reach / detail + 1.0f, step;
    const float last_place = power_below(reach) * 0x1p-23f;
    if (!(ratio < 0x1p40f)) ratio = 0x1p40f;
    step = rule == SPT_NORMAL_CENTRAL ? cube_root(HALF_ULP * ratio) : sqrtf(HALF_ULP * ratio);
    step *= detail;
    if (least > step) step = least;
    step = power_below(step < 0x1p126f ? step * 1.4142135f : 0x1p126f);
    if (step < least && step < 0x1p126f) step *= 2.0f;
    if (step < last_place) step = last_place;
    return step > FLT_MIN ? step : FLT_MIN;
}

static float reach_of(const spti_differences *differences, size_t slot) {
    float reach = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float magnitude = fabsf(differences->point[axis][slot]);
        if (magnitude > reach) reach = magnitude;
    }
    return reach;
}

/* A coordinate that stays finite. */
static float moved(float coordinate, float by) {
    const float sum = coordinate + by;
    if (sum > FLT_MAX) return FLT_MAX;
    return sum < -FLT_MAX ? -FLT_MAX : sum;
}

static void by_callback(const spt_field *field, spti_differences *differences, float *x, float *y,
                        float *z) {
    SPTI_ALIGNED(64) float gradient[3][SPT_BATCH];
    const size_t count = differences->count;
    const size_t whole = (count + SPTI_GROUP - 1) / SPTI_GROUP * SPTI_GROUP;
    if (count == 0) return;
    for (size_t slot = 0; slot < whole; ++slot) {
        const size_t from = slot < count ? slot : count - 1;
        x[slot] = differences->point[0][from];
        y[slot] = differences->point[1][from];
        z[slot] = differences->point[2][from];
        gradient[0][slot] = gradient[1][slot] = gradient[2][slot] = NAN;
    }
    field->gradient(field->user, whole, x, y, z, gradient[0], gradient[1], gradient[2]);
    for (int axis = 0; axis < 3; ++axis) {
        memcpy(differences->gradient[axis], gradient[axis], count * sizeof gradient[axis][0]);
    }
}

static void by_values(const spt_field *field, spt_normal_rule rule, float detail,
                      spti_differences *differences, float *x, float *y, float *z,
                      float *distance) {
    const signed char(*const offsets)[3] = rule == SPT_NORMAL_CENTRAL ? axes : corners;
    const int values = rule == SPT_NORMAL_CENTRAL ? 6 : 4;
    const size_t count = differences->count;
    float step[SPT_BATCH];
    memset(differences->gradient, 0, sizeof differences->gradient);
    for (size_t slot = 0; slot < count; ++slot) {
        const float reach = reach_of(differences, slot);
        step[slot] = step_of(rule, detail, reach, differences->least[slot]);
    }
    for (int value = 0; value < values; ++value) {
        const signed char *const offset = offsets[value];
        for (size_t slot = 0; slot < count; ++slot) {
            x[slot] = moved(differences->point[0][slot], (float)offset[0] * step[slot]);
            y[slot] = moved(differences->point[1][slot], (float)offset[1] * step[slot]);
            z[slot] = moved(differences->point[2][slot], (float)offset[2] * step[slot]);
        }
        spti_ask(field, count, x, y, z, distance);
        for (int axis = 0; axis < 3; ++axis) {
            if (offset[axis] == 0) continue;
            for (size_t slot = 0; slot < count; ++slot) {
                differences->gradient[axis][slot] += (float)offset[axis] * distance[slot];
            }
        }
    }
}

/* To unit length, or to zero. */
static void normalise(spti_differences *differences, size_t slot) {
    float gradient[3], largest = 0.0f;
    int finite = 1;
    for (int axis = 0; axis < 3; ++axis) {
        gradient[axis] = differences->gradient[axis][slot];
        finite &= spti_finite(gradient[axis]);
        if (fabsf(gradient[axis]) > largest) largest = fabsf(gradient[axis]);
    }
    /* So that the length is a normal number. */
    const float scale = largest >= 0x1p60f ? 0x1p-64f : largest <= 0x1p-60f ? 0x1p64f : 1.0f;
    for (int axis = 0; axis < 3; ++axis) gradient[axis] *= scale;
    const float length = spti_length(gradient[0], gradient[1], gradient[2]);
    for (int axis = 0; axis < 3; ++axis) {
        differences->gradient[axis][slot] =
            finite && length > 0.0f ? gradient[axis] / length : 0.0f;
    }
}

void spti_differ(const spt_field *field, spt_normal_rule rule, float detail,
                 spti_differences *differences, float *x, float *y, float *z, float *distance) {
    if (field->gradient != NULL) {
        by_callback(field, differences, x, y, z);
    } else {
        by_values(field, rule, detail, differences, x, y, z, distance);
    }
    for (size_t slot = 0; slot < differences->count; ++slot) normalise(differences, slot);
}
