/* SPDX-License-Identifier: MIT
 *
 * Models as sets of kernel instances, and how the library is asked. The kernels themselves are in
 * krs_bodies.c. */
#include "krs_oracle.h"
#include "surface_oracle.h"

#include <math.h>

void krs_reflect(const krs_expansion *expansion, uint32_t mirror, double p[3]) {
    const double *const normal = expansion->normal[mirror];
    const double beyond = surface_dot(normal, p) - expansion->offset[mirror];
    for (int axis = 0; axis < 3; ++axis) p[axis] -= 2 * beyond * normal[axis];
}

/* The body's image. A field stays where it is: points are carried to it instead. */
static void reflect_body(const krs_expansion *expansion, uint32_t mirror, krs_body *body) {
    const double *const normal = expansion->normal[mirror];
    if (body->kind == SPT_KERNEL_FIELD) return;
    if (body->kind == SPT_KERNEL_HALF_SPACE) {
        double foot[3];
        for (int axis = 0; axis < 3; ++axis) foot[axis] = body->radius * body->a[axis];
        krs_reflect(expansion, mirror, foot);
        const double turned = surface_dot(normal, body->a);
        for (int axis = 0; axis < 3; ++axis) body->a[axis] -= 2 * turned * normal[axis];
        body->radius = surface_dot(foot, body->a);
        return;
    }
    krs_reflect(expansion, mirror, body->a);
    krs_reflect(expansion, mirror, body->b);
    krs_reflect(expansion, mirror, body->control);
    krs_reflect(expansion, mirror, body->center);
    for (int row = 0; row < 3; ++row) {
        const double turned = surface_dot(normal, body->axis[row]);
        for (int axis = 0; axis < 3; ++axis) body->axis[row][axis] -= 2 * turned * normal[axis];
    }
}

static void append(krs_expansion *expansion, const spt_kernel *kernel, uint32_t number) {
    if (kernel->kind == SPT_KERNEL_EMPTY) return;
    krs_instance *const added = &expansion->instances[expansion->count++];
    added->body = krs_body_of(kernel);
    added->kernel = number;
    added->mirrors = 0;
}

void krs_expansion_begin(krs_expansion *expansion, const spt_kernel *kernel) {
    expansion->levels = 0;
    expansion->count = 0;
    append(expansion, kernel, 0);
}

void krs_expansion_add(krs_expansion *expansion, const spt_mirror *mirror,
                       const spt_kernel *kernel) {
    const uint32_t level = expansion->levels++;
    const size_t count = expansion->count;
    double *const normal = expansion->normal[level];
    krs_widen(mirror->normal, normal);
    const double length = surface_length(normal);
    for (int axis = 0; axis < 3; ++axis) normal[axis] /= length;
    expansion->offset[level] = (double)mirror->offset / length;
    for (size_t i = 0; i < count; ++i) {
        krs_instance *const image = &expansion->instances[expansion->count++];
        *image = expansion->instances[i];
        reflect_body(expansion, level, &image->body);
        image->mirrors |= UINT64_C(1) << level;
    }
    append(expansion, kernel, level + 1);
}

void krs_expand(krs_expansion *expansion, uint32_t levels, const spt_kernel *kernels,
                const spt_mirror *mirrors) {
    krs_expansion_begin(expansion, &kernels[0]);
    for (uint32_t level = 0; level < levels; ++level)
        krs_expansion_add(expansion, &mirrors[level], &kernels[level + 1]);
}

void krs_to_kernel(const krs_expansion *expansion, uint32_t kernel, uint64_t mirrors,
                   const double p[3], double seen[3]) {
    for (int axis = 0; axis < 3; ++axis) seen[axis] = p[axis];
    for (uint32_t i = expansion->levels; i-- > kernel;) {
        if ((mirrors >> i & 1) != 0) krs_reflect(expansion, i, seen);
    }
}

double krs_instance_distance(const krs_expansion *expansion, size_t index, const double p[3]) {
    const krs_instance *const one = &expansion->instances[index];
    double seen[3];
    if (one->body.kind != SPT_KERNEL_FIELD) return krs_body_distance(&one->body, p);
    krs_to_kernel(expansion, one->kernel, one->mirrors, p, seen);
    return krs_body_distance(&one->body, seen);
}

double krs_expansion_distance(const krs_expansion *expansion, const double p[3], size_t *which,
                              double *margin) {
    double least = HUGE_VAL, second = HUGE_VAL;
    size_t nearest = 0;
    for (size_t i = 0; i < expansion->count; ++i) {
        const double distance = krs_instance_distance(expansion, i, p);
        if (distance < least) {
            second = least;
            least = distance;
            nearest = i;
        } else if (distance < second) {
            second = distance;
        }
    }
    if (which != NULL) *which = nearest;
    if (margin != NULL) *margin = second - least;
    return least;
}

void krs_expansion_gradient(const krs_expansion *expansion, size_t which, const double p[3],
                            double gradient[3]) {
    const double step = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
        double there[3] = {p[0], p[1], p[2]};
        there[axis] = p[axis] + step;
        const double above = krs_instance_distance(expansion, which, there);
        there[axis] = p[axis] - step;
        gradient[axis] = (above - krs_instance_distance(expansion, which, there)) / (2 * step);
    }
}

int krs_instance_kept(const krs_expansion *expansion, size_t index, const double p[3],
                      double slack) {
    const krs_instance *const one = &expansion->instances[index];
    double at[3] = {p[0], p[1], p[2]};
    for (uint32_t i = expansion->levels; i-- > one->kernel;) { /* from the world inwards */
        if ((one->mirrors >> i & 1) != 0) krs_reflect(expansion, i, at);
        if (surface_dot(expansion->normal[i], at) > expansion->offset[i] + slack) return 0;
    }
    return 1;
}

double krs_rounding(uint32_t levels, const spt_mirror *mirrors, const double p[3]) {
    double offset = 0;
    for (uint32_t i = 0; i < levels; ++i) offset = fmax(offset, fabs((double)mirrors[i].offset));
    return ldexp(levels + 4, -22) * fmax(surface_length(p) + offset, 1);
}

/* ---- Asking the library ---------------------------------------------------------------------- */

/* Room for a batch's four arrays at 64 bytes. */
static float *aligned(float *room) {
    return room + (64 - (uintptr_t)room % 64) % 64 / sizeof *room;
}

void krs_values(const spt_field *field, size_t count, const float (*points)[3], float *values) {
    float room[4 * SPT_BATCH + 16];
    float *const x = aligned(room), *const y = x + SPT_BATCH, *const z = y + SPT_BATCH,
                 *const distance = z + SPT_BATCH;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t here = count - first < SPT_BATCH ? count - first : SPT_BATCH;
        const size_t n = (here + 15) / 16 * 16;
        for (size_t i = 0; i < n; ++i) {
            const float *const p = points[first + (i < here ? i : here - 1)];
            x[i] = p[0];
            y[i] = p[1];
            z[i] = p[2];
        }
        field->batch(field->user, n, x, y, z, distance);
        for (size_t i = 0; i < here; ++i) values[first + i] = distance[i];
    }
}

void krs_point_values(const spt_field *field, size_t count, const float (*points)[3],
                      float *values) {
    for (size_t i = 0; i < count; ++i)
        values[i] = field->point(field->user, points[i][0], points[i][1], points[i][2]);
}

void krs_widen(const float from[3], double to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = (double)from[axis];
}

void krs_cross(const double a[3], const double b[3], double out[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        out[axis] = a[next] * b[last] - a[last] * b[next];
    }
}
