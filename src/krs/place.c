/* SPDX-License-Identifier: MIT
 *
 * Kernels at single points: distance, gradient and parameters. Once a hit, never while tracing. */
#include <math.h>
#include <string.h>

#include "../base/arguments.h"
#include "../trace/driver.h"
#define SPT_LANES 1
#include "locate.h"
#include "shape_kernel.h"
#include "angle.h"

/* A point as an arc or a leaf sees it, in double. */
typedef struct place_frame {
    double x, y, z; /* outward (of a leaf across), along and across the plane */
    double k, half, cosine, sagitta;
} place_frame;

static double along(const spt_built_kernel *kernel, int place, const double q[3]) {
    return (double)kernel->number[place] * q[0] + (double)kernel->number[place + 1] * q[1] +
           (double)kernel->number[place + 2] * q[2];
}

static void from_center(const spt_built_kernel *kernel, const float point[3], double q[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        q[axis] = (double)point[axis] - (double)kernel->number[SHAPE_CENTER + axis];
    }
}

static place_frame frame_of(const spt_built_kernel *kernel, const float point[3]) {
    double q[3];
    from_center(kernel, point, q);
    const place_frame frame = {
        along(kernel, SHAPE_OUTWARD, q),          along(kernel, SHAPE_ALONG, q),
        along(kernel, SHAPE_NORMAL, q),           (double)kernel->number[SHAPE_CURVATURE],
        (double)kernel->number[SHAPE_HALF_CHORD], (double)kernel->number[SHAPE_COSINE],
        (double)kernel->number[SHAPE_SAGITTA]};
    return frame;
}

/* From the nearest point of an arc to a point in its plane: x outward from the arc's middle, y along
 * the chord, not negative. outside: of a leaf, the inside of the circle counts as 0. */
static void from_arc(const place_frame *frame, double x, double y, int outside, double offset[2]) {
    const double radial = 1 + frame->k * x, turned = frame->k * y;
    const double size = sqrt(radial * radial + turned * turned);
    double over = (x * (frame->k * x + 2) + y * turned) / (size + 1);
    if (frame->half * radial >= frame->cosine * y && size > 0) {
        if (outside && over < 0) over = 0;
        offset[0] = over * (radial / size);
        offset[1] = over * (turned / size);
    } else {
        offset[0] = x + frame->sagitta;
        offset[1] = y - frame->half;
    }
}

static void to_world(const spt_built_kernel *kernel, const double local[3], double vector[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        vector[axis] = local[0] * (double)kernel->number[SHAPE_OUTWARD + axis] +
                       local[1] * (double)kernel->number[SHAPE_ALONG + axis] +
                       local[2] * (double)kernel->number[SHAPE_NORMAL + axis];
    }
}

static void arc_gradient(const spt_built_kernel *kernel, const float point[3], double vector[3]) {
    const place_frame frame = frame_of(kernel, point);
    double local[3];
    if (kernel->kind == SPT_KERNEL_LEAF) {
        from_arc(&frame, fabs(frame.x) - frame.sagitta, fabs(frame.y), 1, local);
        if (frame.x < 0) local[0] = -local[0];
    } else {
        from_arc(&frame, frame.x, fabs(frame.y), 0, local);
    }
    if (frame.y < 0) local[1] = -local[1];
    local[2] = frame.z;
    to_world(kernel, local, vector);
}

static void field_gradient(const spt_built_kernel *kernel, const float point[3], double vector[3]) {
    SPTI_ALIGNED(64) float at[3][SPTI_GROUP], slope[3][SPTI_GROUP];
    memset(vector, 0, 3 * sizeof *vector);
    if (kernel->gradient == NULL) return;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < SPTI_GROUP; ++i) {
            at[axis][i] = spti_in_range(point[axis]);
            slope[axis][i] = 0.0f;
        }
    }
    kernel->gradient(kernel->user, SPTI_GROUP, at[0], at[1], at[2], slope[0], slope[1], slope[2]);
    for (int axis = 0; axis < 3; ++axis) vector[axis] = (double)slope[axis][0];
}

void spti_kernel_gradient(const spt_built_kernel *kernel, const float point[3],
                          double gradient[3]) {
    double square = 0;
    switch (kernel->kind) {
    case SPT_KERNEL_SPHERE:
        from_center(kernel, point, gradient);
        break;
    case SPT_KERNEL_HALF_SPACE:
        for (int axis = 0; axis < 3; ++axis) gradient[axis] = (double)kernel->number[axis];
        break;
    case SPT_KERNEL_FIELD:
        field_gradient(kernel, point, gradient);
        break;
    default:
        arc_gradient(kernel, point, gradient);
        break;
    }
    for (int axis = 0; axis < 3; ++axis) square += gradient[axis] * gradient[axis];
    const int good = square > 0 && square <= DBL_MAX;
    for (int axis = 0; axis < 3; ++axis) gradient[axis] = good ? gradient[axis] / sqrt(square) : 0;
}

float spti_kernel_distance(const spt_built_kernel *kernel, const float point[3]) {
    SPTI_ALIGNED(64) float asked[SPTI_GROUP];
    const shape_points at = {point[0], point[1], point[2]};
    float distance = INFINITY;
    float x = point[0], y = point[1], z = point[2];
    const spti_way way = {.x = &x, .y = &y, .z = &z};
    if (shape_distances(kernel, 1, &at, &distance)) return distance;
    spti_ask_kernel(kernel, 1, &way, asked);
    return asked[0];
}

static float share_of(double a) {
    return a > 0 ? a < 1 ? (float)a : 1.0f : 0.0f;
}

static void plane_parameters(const spt_built_kernel *kernel, const float point[3], float *u,
                             float *v) {
    const double n[3] = {(double)kernel->number[0], (double)kernel->number[1],
                         (double)kernel->number[2]};
    const double x = fabs(n[0]), y = fabs(n[1]), z = fabs(n[2]);
    /* The axis that is least along the normal gives the first direction in the plane. */
    const double axis[3] = {x <= y && x <= z ? 1 : 0, y < x && y <= z ? 1 : 0,
                            z < x && z < y ? 1 : 0};
    const double a[3] = {n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2],
                         n[0] * axis[1] - n[1] * axis[0]};
    const double b[3] = {n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2],
                         n[0] * a[1] - n[1] * a[0]};
    const double size = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double p[3] = {(double)point[0], (double)point[1], (double)point[2]};
    *u = (float)((a[0] * p[0] + a[1] * p[1] + a[2] * p[2]) / size);
    *v = (float)((b[0] * p[0] + b[1] * p[1] + b[2] * p[2]) / size);
}

static void capsule_parameters(const spt_built_kernel *kernel, const float point[3], float *u,
                               float *v) {
    const place_frame frame = frame_of(kernel, point);
    const double k = frame.k, radial = 1 + k * frame.x, turned = k * frame.y;
    /* Angles at the circle's center, or what they tend to for a straight one. */
    const double whole = k > 0 ? spti_turns(k * frame.half, frame.cosine) : frame.half;
    const double part = k > 0 ? spti_turns(turned, radial) : frame.y;
    const double over = (frame.x * (k * frame.x + 2) + frame.y * turned) /
                        (sqrt(radial * radial + turned * turned) + 1);
    const double around = spti_turns(frame.z, over);
    *u = whole > 0 ? share_of(0.5 + 0.5 * (part / whole)) : 0.5f;
    *v = share_of(around < 0 ? around + 1 : around);
}

static void leaf_parameters(const spt_built_kernel *kernel, const float point[3], float *u,
                            float *v) {
    const place_frame frame = frame_of(kernel, point);
    const double turned = frame.k * frame.y, rest = 1 - turned * turned;
    const double drop = frame.k * frame.y * frame.y / (1 + sqrt(rest > 0 ? rest : 0));
    const double width = frame.sagitta - drop;
    *u = share_of(0.5 + 0.5 * (frame.y / frame.half));
    *v = width > 0 ? share_of(0.5 + 0.5 * (frame.x / width)) : 0.5f;
}

void spti_kernel_parameters(const spt_built_kernel *kernel, const float point[3], float *u,
                            float *v) {
    double q[3];
    *u = *v = 0.0f;
    switch (kernel->kind) {
    case SPT_KERNEL_SPHERE:
        from_center(kernel, point, q);
        const double turns = spti_turns(q[2], q[0]);
        *u = share_of(turns < 0 ? turns + 1 : turns);
        *v = share_of(0.5 + 2 * spti_turns(q[1], sqrt(q[0] * q[0] + q[2] * q[2])));
        break;
    case SPT_KERNEL_HALF_SPACE:
        plane_parameters(kernel, point, u, v);
        break;
    case SPT_KERNEL_CAPSULE:
        capsule_parameters(kernel, point, u, v);
        break;
    case SPT_KERNEL_LEAF:
        leaf_parameters(kernel, point, u, v);
        break;
    default:
        break;
    }
}
