/* SPDX-License-Identifier: MIT
 *
 * Deformations in double and bodies to deform. */
#include "distort_world.h"
#include "../check.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Vectors -------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double distort_length(const double vector[3]) {
    return sqrt(dot(vector, vector));
}

void distort_unit(double vector[3]) {
    double square;
    do {
        for (int k = 0; k < 3; ++k) vector[k] = check_uniform(-1, 1);
        square = dot(vector, vector);
    } while (square > 1 || square < 0.01);
    for (int k = 0; k < 3; ++k) vector[k] /= sqrt(square);
}

/* Right-handed, about a unit vector (Rodrigues). */
static void rotate(const double v[3], const double about[3], double angle, double to[3]) {
    const double along = dot(v, about) * (1 - cos(angle));
    double turned[3];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        turned[k] =
            v[k] * cos(angle) + (about[i] * v[j] - about[j] * v[i]) * sin(angle) + about[k] * along;
    }
    memcpy(to, turned, sizeof turned);
}

/* ---- Deformations --------------------------------------------------------------------------- */

/* axis and side as meant: of unit length and at right angles. */
static void directions(const spt_distortion *distortion, double axis[3], double side[3]) {
    double lengths[2], slant;
    for (int k = 0; k < 3; ++k) {
        axis[k] = (double)distortion->axis[k];
        side[k] = (double)distortion->side[k];
    }
    lengths[0] = distort_length(axis);
    lengths[1] = distort_length(side);
    for (int k = 0; k < 3; ++k) {
        axis[k] /= lengths[0];
        side[k] /= lengths[1];
    }
    slant = dot(axis, side);
    for (int k = 0; k < 3; ++k) side[k] -= slant * axis[k];
    lengths[1] = distort_length(side);
    for (int k = 0; k < 3; ++k) side[k] /= lengths[1];
}

static double sway(const spt_distortion *distortion, double height) {
    if (height <= 0) return 0;
    return (double)distortion->rate * height * height *
           sin((double)distortion->phase + (double)distortion->wave * height);
}

void distort_forward(const spt_distortion *distortion, const double q[3], double p[3]) {
    const double rate = (double)distortion->rate;
    double axis[3], side[3], d[3], moved[3], angle = 0;
    directions(distortion, axis, side);
    for (int k = 0; k < 3; ++k) d[k] = q[k] - (double)distortion->origin[k];
    const double height = dot(d, axis);
    switch (distortion->kind) {
    case SPT_DISTORTION_TWIST:
        rotate(d, axis, rate * height, moved);
        break;
    case SPT_DISTORTION_BEND:
        for (int i = 0; i < 400; ++i) {
            rotate(d, side, angle, moved);
            angle = rate * dot(moved, axis);
        }
        break;
    case SPT_DISTORTION_TAPER:
        for (int k = 0; k < 3; ++k) {
            moved[k] = height * axis[k] + (1 + rate * height) * (d[k] - height * axis[k]);
        }
        break;
    default:
        for (int k = 0; k < 3; ++k) moved[k] = d[k] + side[k] * sway(distortion, height);
    }
    for (int k = 0; k < 3; ++k) p[k] = (double)distortion->origin[k] + moved[k];
}

void distort_back(const spt_distortion *distortion, const double p[3], double q[3]) {
    const double rate = (double)distortion->rate;
    double axis[3], side[3], d[3], moved[3];
    directions(distortion, axis, side);
    for (int k = 0; k < 3; ++k) d[k] = p[k] - (double)distortion->origin[k];
    const double height = dot(d, axis);
    switch (distortion->kind) {
    case SPT_DISTORTION_TWIST:
        rotate(d, axis, -rate * height, moved);
        break;
    case SPT_DISTORTION_BEND:
        rotate(d, side, -rate * height, moved);
        break;
    case SPT_DISTORTION_TAPER:
        for (int k = 0; k < 3; ++k) {
            moved[k] = height * axis[k] + (d[k] - height * axis[k]) / (1 + rate * height);
        }
        break;
    default:
        for (int k = 0; k < 3; ++k) moved[k] = d[k] - side[k] * sway(distortion, height);
    }
    for (int k = 0; k < 3; ++k) q[k] = (double)distortion->origin[k] + moved[k];
}

static void derivative(const spt_distortion *distortion, const double p[3], double matrix[3][3]) {
    const double step = 1e-5;
    for (int column = 0; column < 3; ++column) {
        double at[3], ahead[3], behind[3];
        memcpy(at, p, sizeof at);
        at[column] = p[column] + step;
        distort_back(distortion, at, ahead);
        at[column] = p[column] - step;
        distort_back(distortion, at, behind);
        for (int row = 0; row < 3; ++row) {
            matrix[row][column] = (ahead[row] - behind[row]) / (2 * step);
        }
    }
}

void distort_back_transposed(const spt_distortion *distortion, const double p[3],
                             const double vector[3], double to[3]) {
    double matrix[3][3];
    derivative(distortion, p, matrix);
    for (int k = 0; k < 3; ++k) {
        to[k] = matrix[0][k] * vector[0] + matrix[1][k] * vector[1] + matrix[2][k] * vector[2];
    }
}

/* By the power method on J^T J, from three directions. */
double distort_stretch(const spt_distortion *distortion, const double p[3]) {
    double matrix[3][3], largest = 0;
    derivative(distortion, p, matrix);
    for (int start = 0; start < 3; ++start) {
        double v[3] = {0.3, 0.3, 0.3}, length = 0;
        v[start] = 1;
        for (int i = 0; i < 40; ++i) {
            double image[3], next[3] = {0, 0, 0};
            for (int k = 0; k < 3; ++k) image[k] = dot(matrix[k], v);
            for (int k = 0; k < 9; ++k) next[k % 3] += matrix[k / 3][k % 3] * image[k / 3];
            length = distort_length(next);
            for (int k = 0; k < 3; ++k) v[k] = next[k] / length;
        }
        largest = fmax(largest, sqrt(length));
    }
    return largest;
}

spt_distortion distort_draw(uint32_t kind, double size, double turn) {
    spt_distortion distortion = spt_distortion_default();
    double axis[3], side[3];
    const double length = pow(10, check_uniform(-3, 3));
    distort_unit(axis);
    do {
        distort_unit(side);
    } while (fabs(dot(axis, side)) > 0.9);
    const double slant = dot(axis, side);
    distortion.kind = kind;
    for (int k = 0; k < 3; ++k) {
        distortion.origin[k] = (float)(size * check_uniform(-0.5, 0.5));
        distortion.axis[k] = (float)(axis[k] * length);
        distortion.side[k] = (float)((side[k] - slant * axis[k]) / length);
    }
    /* No point of the body is farther from the origin of the deformation than 1.9 sizes. */
    distortion.rate = (float)(turn * check_uniform(0.5, 1) / (1.9 * size));
    if (check_random() % 2 != 0) distortion.rate = -distortion.rate;
    if (kind == SPT_DISTORTION_SWAY) {
        distortion.wave = (float)(check_uniform(-3, 3) / size);
        distortion.phase = (float)check_uniform(-1e4, 1e4);
    }
    return distortion;
}

/* ---- Bodies --------------------------------------------------------------------------------- */

distort_body distort_body_of(analytic_kind kind, double size) {
    distort_body body;
    body.shape = analytic_sample(kind, size);
    body.bound = spt_bound_sphere(0, 0, 0, (float)(analytic_size(&body.shape) * 1.001));
    body.calls = body.faults = 0;
    return body;
}

static float value_at(const distort_body *body, float x, float y, float z) {
    const double p[3] = {(double)x, (double)y, (double)z};
    return (float)analytic_distance(&body->shape, p);
}

static int is_finite(float a) {
    return a >= -FLT_MAX && a <= FLT_MAX;
}

static void audit(distort_body *body, size_t n, const float *x, const float *y, const float *z,
                  const float *to) {
    const float *const arrays[] = {x, y, z, to};
    ++body->calls;
    if (n % 16 != 0 || n < 16 || n > SPT_BATCH) ++body->faults;
    for (int k = 0; k < 4; ++k) {
        if ((uintptr_t)arrays[k] % 64 != 0) ++body->faults;
    }
    for (size_t i = 0; i < n; ++i) {
        if (!is_finite(x[i]) || !is_finite(y[i]) || !is_finite(z[i])) ++body->faults;
    }
}

static void batch(void *user, size_t n, const float *x, const float *y, const float *z,
                  float *distance) {
    audit(user, n, x, y, z, distance);
    for (size_t i = 0; i < n; ++i) distance[i] = value_at(user, x[i], y[i], z[i]);
}

static void scribble(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *distance) {
    batch(user, n, x, y, z, distance);
    memset((float *)(uintptr_t)x, 0xff, n * sizeof *x);
    memset((float *)(uintptr_t)y, 0xff, n * sizeof *y);
    memset((float *)(uintptr_t)z, 0xff, n * sizeof *z);
}

static float point(void *user, float x, float y, float z) {
    distort_body *const body = user;
    ++body->calls;
    if (!is_finite(x) || !is_finite(y) || !is_finite(z)) ++body->faults;
    return value_at(body, x, y, z);
}

static void gradient(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *gradient_x, float *gradient_y, float *gradient_z) {
    const distort_body *const body = user;
    const double step = 1e-5;
    float *const to[3] = {gradient_x, gradient_y, gradient_z};
    audit(user, n, x, y, z, gradient_x);
    for (size_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            double ahead[3] = {(double)x[i], (double)y[i], (double)z[i]}, behind[3];
            memcpy(behind, ahead, sizeof behind);
            ahead[k] += step;
            behind[k] -= step;
            to[k][i] = (float)((analytic_distance(&body->shape, ahead) -
                                analytic_distance(&body->shape, behind)) /
                               (2 * step));
        }
    }
}

spt_field distort_field_of(distort_body *body, distort_form form) {
    spt_field field = spt_field_default();
    field.batch = form == DISTORT_BATCH ? batch : form == DISTORT_SCRIBBLE ? scribble : NULL;
    field.point = form == DISTORT_POINT ? point : NULL;
    field.user = body;
    field.bound = &body->bound;
    field.gradient = gradient;
    return field;
}

double distort_distance(const distort_body *body, const spt_distortion *distortion,
                        const double p[3]) {
    double q[3];
    distort_back(distortion, p, q);
    return analytic_distance(&body->shape, q);
}

float *distort_aligned(float *room) {
    return room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
}

float distort_ask(const spt_field *field, const double p[3]) {
    float room[4 * 16 + 16];
    float *const at = distort_aligned(room);
    for (int i = 0; i < 48; ++i) at[i] = (float)p[i / 16];
    if (field->batch != NULL) {
        field->batch(field->user, 16, at, at + 16, at + 32, at + 48);
        return at[48];
    }
    return field->point(field->user, at[0], at[16], at[32]);
}

void distort_ask_gradient(const spt_field *field, const double p[3], double gradient[3]) {
    float room[6 * 16 + 16];
    float *const at = distort_aligned(room);
    for (int i = 0; i < 48; ++i) at[i] = (float)p[i / 16];
    field->gradient(field->user, 16, at, at + 16, at + 32, at + 48, at + 64, at + 80);
    for (int k = 0; k < 3; ++k) gradient[k] = (double)at[48 + 16 * k];
}

/* ---- Cases ---------------------------------------------------------------------------------- */

double distort_most_turn(uint32_t kind) {
    return kind == SPT_DISTORTION_TAPER ? 0.8 : kind == SPT_DISTORTION_BEND ? 0.85 : 4;
}

void distort_draw_case(distort_case *out, uint32_t kind, double turn) {
    static const analytic_kind bodies[] = {ANALYTIC_BOX, ANALYTIC_CAPSULE, ANALYTIC_TORUS,
                                           ANALYTIC_CYLINDER};
    const analytic_kind shape = bodies[check_random() % 4];
    out->size = pow(10, check_uniform(-2, 2));
    out->body = distort_body_of(shape, out->size);
    out->distortion = distort_draw(kind, out->size, turn);
    const spt_field inner = distort_field_of(&out->body, DISTORT_BATCH);
    check_context("kind %u, body %d of %g", (unsigned)kind, (int)shape, out->size);
    CHECK(spt_distorted_field(&inner, &out->distortion, &out->memory, &out->field) == SPT_OK);
}

void distort_body_point(const distort_case *at, double p[3]) {
    do {
        for (int k = 0; k < 3; ++k) p[k] = at->size * check_uniform(-1, 1);
    } while (analytic_distance(&at->body.shape, p) > 0);
}
