/* SPDX-License-Identifier: MIT
 *
 * Callbacks that look at what they are handed before they pass it on. */
#include "scene_audit.h"
#include "../check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct place {
    float p[3];
} place;

static int compare_places(const void *a, const void *b) {
    return memcmp(a, b, sizeof(place));
}

static double largest(const float v[3]) {
    return fmax(fabs((double)v[0]), fmax(fabs((double)v[1]), fabs((double)v[2])));
}

/* How far a point may be outside: what bound.h adds to the volume and to the ends of the interval,
 * and 2^-22 of the coordinates again for the rounding of the point itself. */
static double widened(const scene_audit *audit, const spt_bound *bound) {
    const double extent = bound->kind == SPT_BOUND_BOX
                              ? fmax(largest(bound->low), largest(bound->high))
                              : largest(bound->center) + (double)bound->radius;
    const double around = 2 * (audit->reach + extent); /* above |origin - center| */
    const double ends = audit->longest + audit->reach + extent;
    return 0x1p-22 * (audit->reach + around + ends + audit->reach + audit->longest);
}

static int is_outside(const scene_audit *audit, const spt_bound *bound, const float p[3]) {
    const double margin = widened(audit, bound);
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = (double)p[axis];
        const double offset = x - (double)bound->center[axis];
        square += offset * offset;
        if (bound->kind == SPT_BOUND_BOX &&
            (x < (double)bound->low[axis] - margin || x > (double)bound->high[axis] + margin)) {
            return 1;
        }
    }
    return bound->kind == SPT_BOUND_SPHERE && sqrt(square) > (double)bound->radius + margin;
}

static void look(scene_listener *self, size_t n, const float *x, const float *y, const float *z) {
    place places[SPT_BATCH];
    scene_audit *audit = self->audit;
    for (size_t i = 0; i < n; ++i) {
        places[i].p[0] = x[i];
        places[i].p[1] = y[i];
        places[i].p[2] = z[i];
        audit->infinite += !isfinite(x[i]) || !isfinite(y[i]) || !isfinite(z[i]);
        if (self->inner.bound != NULL) {
            audit->outside += is_outside(audit, self->inner.bound, places[i].p);
        }
    }
    memcpy(self->last, places[0].p, sizeof self->last);
    qsort(places, n, sizeof *places, compare_places);
    for (size_t i = 0; i < n; ++i) {
        self->distinct += i == 0 || compare_places(&places[i - 1], &places[i]) != 0;
    }
    self->points += n;
    ++self->calls;
}

static void listen_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                         float *distance) {
    scene_listener *self = user;
    const uintptr_t all = (uintptr_t)x | (uintptr_t)y | (uintptr_t)z | (uintptr_t)distance;
    self->audit->unaligned += all % 64 != 0;
    if (n % 16 != 0 || n < 16 || n > SPT_BATCH) {
        ++self->audit->bad_count;
        return;
    }
    look(self, n, x, y, z);
    self->inner.batch(self->inner.user, n, x, y, z, distance);
}

static float listen_point(void *user, float x, float y, float z) {
    scene_listener *self = user;
    look(self, 1, &x, &y, &z);
    return self->inner.point(self->inner.user, x, y, z);
}

void scene_audit_of(scene_audit *self, const spt_scene *listened, double reach, double longest) {
    CHECK(listened->count <= audited_components);
    self->scene = *listened;
    self->scene.fields = self->fields;
    self->reach = reach;
    self->longest = longest;
    for (size_t i = 0; i < listened->count && i < audited_components; ++i) {
        self->listeners[i].inner = listened->fields[i];
        self->listeners[i].audit = self;
        self->fields[i] = listened->fields[i];
        self->fields[i].user = &self->listeners[i];
        if (listened->fields[i].batch != NULL) {
            self->fields[i].batch = listen_batch;
        } else {
            self->fields[i].point = listen_point;
        }
    }
    scene_audit_restart(self);
}

void scene_audit_restart(scene_audit *self) {
    for (size_t i = 0; i < self->scene.count; ++i) {
        self->listeners[i].calls = self->listeners[i].points = self->listeners[i].distinct = 0;
    }
    self->bad_count = self->unaligned = self->infinite = self->outside = 0;
}

void scene_audit_check(const scene_audit *self) {
    CHECK_SAY(self->bad_count == 0 && self->unaligned == 0 && self->infinite == 0,
              "%d bad counts, %d unaligned, %d infinite", self->bad_count, self->unaligned,
              self->infinite);
    CHECK_SAY(self->outside == 0, "%d outside their bound", self->outside);
}

uint64_t scene_audit_calls(const scene_audit *self) {
    uint64_t sum = 0;
    for (size_t i = 0; i < self->scene.count; ++i) sum += self->listeners[i].calls;
    return sum;
}

uint64_t scene_audit_points(const scene_audit *self) {
    uint64_t sum = 0;
    for (size_t i = 0; i < self->scene.count; ++i) sum += self->listeners[i].points;
    return sum;
}

uint64_t scene_audit_distinct(const scene_audit *self) {
    uint64_t sum = 0;
    for (size_t i = 0; i < self->scene.count; ++i) sum += self->listeners[i].distinct;
    return sum;
}
