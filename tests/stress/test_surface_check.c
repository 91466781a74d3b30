/* SPDX-License-Identifier: MIT
 *
 * The contract of spt_field_check(): what it refuses, that it asks for no more than it says and for
 * the same points by the same seed, and that each promise that a field breaks is reported as that
 * one and as no other. */
#include "stress.h"

#include <spheretrace/field.h>

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Fields ---------------------------------------------------------------------------------- */

typedef struct subject {
    stress_distance_fn *distance;
    const void *data;
    size_t calls, points, faults; /* of either callback; points with padding */
    uint64_t hash;                /* of all points, in order, padding left out */
    int scribble;
} subject;

static subject subject_of(stress_distance_fn *distance, const void *data) {
    const subject self = {distance, data, 0, 0, 0, 0xcbf29ce484222325u, 0};
    return self;
}

static float ask(subject *self, float x, float y, float z) {
    self->faults += !(fabsf(x) <= FLT_MAX && fabsf(y) <= FLT_MAX && fabsf(z) <= FLT_MAX);
    self->hash = (self->hash ^ check_bits(x)) * 0x100000001b3u;
    self->hash = (self->hash ^ check_bits(y)) * 0x100000001b3u;
    self->hash = (self->hash ^ check_bits(z)) * 0x100000001b3u;
    return self->distance(self->data, x, y, z);
}

static void subject_batch(void *user, size_t n, const float *x, const float *y, const float *z,
                          float *distance) {
    subject *const self = user;
    float *const scratch[] = {(float *)(uintptr_t)x, (float *)(uintptr_t)y, (float *)(uintptr_t)z};
    const uintptr_t all = (uintptr_t)x | (uintptr_t)y | (uintptr_t)z | (uintptr_t)distance;
    ++self->calls;
    self->points += n;
    self->faults += n == 0 || n % 16 != 0 || n > SPT_BATCH || (all & 63u) != 0;
    for (size_t i = 0; i < n; ++i) distance[i] = ask(self, x[i], y[i], z[i]);
    for (size_t i = 0; self->scribble && i < 3 * n; ++i) scratch[i % 3][i / 3] = stress_nan();
}

static float subject_point(void *user, float x, float y, float z) {
    subject *const self = user;
    ++self->calls;
    ++self->points;
    return ask(self, x, y, z);
}

static spt_field field_of(subject *self, int point, const spt_bound *bound) {
    spt_field field = spt_field_default();
    field.batch = point ? NULL : subject_batch;
    field.point = point ? subject_point : NULL;
    field.user = self;
    field.bound = bound;
    return field;
}

static const stress_sphere ball = {{0.2f, -0.1f, 10.0f}, 1.0f};

static float flat_ball(const void *data, float x, float y, float z) {
    return 0.25f * stress_sphere_distance(data, x, y, z);
}

static float steep_ball(const void *data, float x, float y, float z) {
    return 3.0f * stress_sphere_distance(data, x, y, z);
}

/* Two balls: an exact distance outside, but no convex body. */
static float two_balls(const void *data, float x, float y, float z) {
    const float left = stress_sphere_distance(data, x + 0.5f, y, z) + 0.6f;
    const float right = stress_sphere_distance(data, x - 0.5f, y, z) + 0.6f;
    (void)data;
    return left < right ? left : right;
}

/* A convex body by a function that is none: the square root of the distance outside. */
static float bent_ball(const void *data, float x, float y, float z) {
    const float distance = stress_sphere_distance(data, x, y, z);
    return distance > 0.0f ? 0.5f * distance / (1.0f + 4.0f * distance) : 0.5f * distance;
}

static float holey_ball(const void *data, float x, float y, float z) {
    return z > 10.5f ? stress_nan() : stress_sphere_distance(data, x, y, z);
}

static float bottomless(const void *data, float x, float y, float z) {
    return x > 0.5f ? -stress_infinity() : stress_sphere_distance(data, x, y, z);
}

static float no_surface(const void *data, float x, float y, float z) {
    (void)data, (void)x, (void)y, (void)z;
    return stress_infinity();
}

enum { samples = 2048, seed = 7 };

static spt_field_faults check_of(const spt_field *field) {
    spt_field_faults faults;
    memset(&faults, 0xa5, sizeof faults);
    CHECK(spt_field_check(field, samples, seed, &faults) == SPT_OK);
    return faults;
}

/* ---- Arguments ------------------------------------------------------------------------------- */

static void refuse(const spt_field *field, uint32_t number, spt_field_faults *faults,
                   const subject *self, spt_status expected, const char *why) {
    spt_field_faults before;
    if (faults != NULL) memset(faults, 0x5a, sizeof *faults);
    memset(&before, 0x5a, sizeof before);
    const spt_status status = spt_field_check(field, number, seed, faults);
    CHECK_SAY(status == expected, "%s: %s", why, spt_status_name(status));
    CHECK(faults == NULL || memcmp(faults, &before, sizeof before) == 0);
    CHECK(self->calls == 0);
}

#define REFUSE(spoil) \
    (field = field_of(&self, 0, &bound), bound = whole, (void)(spoil), \
     refuse(&field, 16, &faults, &self, SPT_BAD_ARGUMENT, #spoil))
#define UNSUPPORTED(spoil) \
    (field = field_of(&self, 0, &bound), bound = whole, (void)(spoil), \
     refuse(&field, 16, &faults, &self, SPT_UNSUPPORTED, #spoil))

static void F10sr_check_arguments(void) {
    static const float axis[] = {0.0f, 1.0f, 0.0f};
    const spt_bound whole = spt_bound_sphere(0.2f, -0.1f, 10.0f, 1.5f);
    subject self = subject_of(stress_sphere_distance, &ball);
    spt_bound bound = whole;
    spt_field_faults faults;
    spt_field field = field_of(&self, 0, &bound);
    refuse(NULL, 16, &faults, &self, SPT_BAD_ARGUMENT, "no field");
    refuse(&field, 16, NULL, &self, SPT_BAD_ARGUMENT, "nothing to write");
    refuse(&field, 0, &faults, &self, SPT_BAD_ARGUMENT, "no samples");
    refuse(&field, (1u << 20) + 1, &faults, &self, SPT_BAD_ARGUMENT, "too many samples");
    refuse(&field, UINT32_MAX, &faults, &self, SPT_BAD_ARGUMENT, "too many samples");
    REFUSE(field.batch = NULL);
    REFUSE(field.struct_size = 0);
    REFUSE(field.struct_size -= 1);
    REFUSE(field.lipschitz = 0.0f);
    REFUSE(field.lipschitz = stress_nan());
    REFUSE(field.flags = 2);
    REFUSE(bound.radius = 0.0f);
    REFUSE(bound.struct_size = 0);
    UNSUPPORTED(field.bound = NULL);
    UNSUPPORTED(bound = spt_bound_slab(axis, -1.0f, 1.0f));
    for (int i = 0; i < 3; ++i) { /* one side is still infinite */
        UNSUPPORTED((bound = spt_bound_slab(axis, -1.0f, 1.0f), bound.low[0] = bound.low[1] = -1.0f,
                     bound.low[2] = 8.0f, bound.high[0] = bound.high[1] = 1.0f,
                     bound.high[2] = 12.0f, bound.high[i] = stress_infinity()));
    }
}

/* ---- Calls ----------------------------------------------------------------------------------- */

static void A8sa_check_calls(void) {
    static const uint32_t numbers[] = {1, 2, 15, 16, 17, 255, 256, 257, 1000};
    const spt_bound bound = spt_bound_sphere(0.2f, -0.1f, 10.0f, 1.5f);
    for (int i = 0; i < 9; ++i) {
        spt_field_faults by_form[4];
        uint64_t hashes[4];
        check_context("%u samples", (unsigned)numbers[i]);
        memset(by_form, 0, sizeof by_form);
        for (int form = 0; form < 4; ++form) { /* batch, twice, points, as scratch space */
            subject self = subject_of(steep_ball, &ball);
            const spt_field field = field_of(&self, form == 2, &bound);
            self.scribble = form == 3;
            CHECK(spt_field_check(&field, numbers[i], seed, &by_form[form]) == SPT_OK);
            CHECK(self.faults == 0 && self.calls > 0);
            /* About five evaluations a sample: six are too many to be that. */
            if (form == 2) CHECK(self.points <= 6 * (size_t)numbers[i]);
            CHECK(memcmp(&by_form[form], &by_form[0], sizeof by_form[0]) == 0);
            hashes[form] = self.hash;
        }
        CHECK(hashes[0] == hashes[1] && hashes[0] == hashes[3]);
        subject self = subject_of(steep_ball, &ball);
        const spt_field field = field_of(&self, 0, &bound);
        CHECK(spt_field_check(&field, numbers[i], seed + 1, &by_form[0]) == SPT_OK);
        CHECK(self.hash != hashes[0]);
    }
}

/* ---- Reports --------------------------------------------------------------------------------- */

typedef struct report {
    const char *name;
    stress_distance_fn *distance;
    float bound_radius;
    uint32_t flags;
    int outside_bound, not_convex, body_not_convex, steep, nonfinite;
} report;

static const report reports[] = {
    {"exact", stress_sphere_distance, 1.5f, SPT_FIELD_CONVEX, 0, 0, 0, 0, 0},
    {"underestimate", flat_ball, 1.5f, SPT_FIELD_CONVEX, 0, 0, 0, 0, 0},
    {"exact, tight", stress_sphere_distance, 1.0001f, SPT_FIELD_CONVEX, 0, 0, 0, 0, 0},
    {"sticks out", stress_sphere_distance, 0.8f, SPT_FIELD_CONVEX, 1, 0, 0, 0, 0},
    {"steep", steep_ball, 1.5f, SPT_FIELD_CONVEX, 0, 0, 0, 1, 0},
    {"two balls", two_balls, 1.5f, 0, 0, 0, 1, 0, 0},
    {"two balls declared convex", two_balls, 1.5f, SPT_FIELD_CONVEX, 0, 1, 1, 0, 0},
    {"convex body, bent function", bent_ball, 1.5f, SPT_FIELD_CONVEX, 0, 1, 0, 0, 0},
    {"the same, not declared", bent_ball, 1.5f, 0, 0, 0, 0, 0, 0},
    {"NaN", holey_ball, 1.5f, 0, 0, 0, 0, 0, 1},
    {"minus infinity", bottomless, 1.5f, 0, 0, 0, 0, 0, 1},
    {"nothing there", no_surface, 1.5f, SPT_FIELD_CONVEX, 0, 0, 0, 0, 0}};

/* Where there was none of a kind its place is zero; else it is near the bound, where the samples
 * are. */
static void check_place(uint32_t number, int expected, const float worst[3], const char *what) {
    const float offset[] = {worst[0] - 0.2f, worst[1] + 0.1f, worst[2] - 10.0f};
    const int is_zero = check_same_bits(worst[0], 0.0f) && check_same_bits(worst[1], 0.0f) &&
                        check_same_bits(worst[2], 0.0f);
    CHECK_SAY((number != 0) == expected, "%s: %u", what, (unsigned)number);
    CHECK_SAY(is_zero == (number == 0), "%s: %u at %g %g %g", what, (unsigned)number,
              (double)worst[0], (double)worst[1], (double)worst[2]);
    if (number == 0) return;
    CHECK(stress_length(offset) <= 1.5 * sqrt(3.0)); /* the corners of the box around it */
}

static void E1sa_check_reports(void) {
    for (size_t i = 0; i < sizeof reports / sizeof *reports; ++i) {
        const report *const one = &reports[i];
        const spt_bound bound = spt_bound_sphere(0.2f, -0.1f, 10.0f, one->bound_radius);
        subject self = subject_of(one->distance, &ball);
        spt_field field = field_of(&self, 0, &bound);
        field.flags = one->flags;
        check_context("%s", one->name);
        const spt_field_faults faults = check_of(&field);
        check_place(faults.outside_bound, one->outside_bound, faults.worst[0], "outside");
        check_place(faults.not_convex, one->not_convex, faults.worst[1], "not convex");
        check_place(faults.body_not_convex, one->body_not_convex, faults.worst[2], "body");
        check_place(faults.steep, one->steep, faults.worst[3], "steep");
        check_place(faults.nonfinite, one->nonfinite, faults.worst[4], "not finite");
        CHECK(self.faults == 0);
        field.lipschitz = 4.0f; /* nothing here is as steep as that */
        CHECK(check_of(&field).steep == 0);
    }
}

/* The same ball through bounds of other kinds: nothing is found wrong. */
static void E1sb_check_bounds_of_all_kinds(void) {
    static const float center[] = {0.2f, -0.1f, 10.0f}, end[] = {0.4f, 0.1f, 10.1f};
    static const float half[] = {1.3f, 1.2f, 1.4f}, up[] = {0.0f, 1.0f, 0.0f};
    static const float low[] = {-1.2f, -1.3f, 8.7f}, high[] = {1.6f, 1.4f, 11.4f};
    static const spt_bound_plane planes[] = {{{1.0f, 1.0f, 0.0f}, 1.8f},
                                             {{0.0f, 0.0f, -2.0f}, -17.8f}};
    float axes[3][3] = {{0.6f, 0.8f, 0.0f}, {-0.8f, 0.6f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    spt_bound bounds[] = {spt_bound_box(low[0], low[1], low[2], high[0], high[1], high[2]),
                          spt_bound_oriented_box(center, axes, half),
                          spt_bound_capsule(center, end, 1.2f),
                          spt_bound_cylinder(low, high, 5.0f),
                          spt_bound_ellipsoid(center, axes, half),
                          spt_bound_slab(up, -1.2f, 1.0f),
                          spt_bound_polytope(planes, 2)};
    for (int i = 0; i < 7; ++i) {
        subject self = subject_of(stress_sphere_distance, &ball);
        for (int axis = 0; axis < 3 && i >= 5; ++axis) {
            bounds[i].low[axis] = low[axis];
            bounds[i].high[axis] = high[axis];
        }
        spt_field field = field_of(&self, i % 2, &bounds[i]);
        field.flags = SPT_FIELD_CONVEX;
        check_context("bound of kind %u", (unsigned)bounds[i].kind);
        const spt_field_faults faults = check_of(&field);
        CHECK(self.faults == 0 && self.points > 0);
        CHECK_SAY(faults.outside_bound == 0 && faults.not_convex == 0 && faults.steep == 0 &&
                      faults.body_not_convex == 0 && faults.nonfinite == 0,
                  "%u outside, %u not convex, %u steep", (unsigned)faults.outside_bound,
                  (unsigned)faults.not_convex, (unsigned)faults.steep);
    }
}

void suite_surface_check(void) {
    RUN(F10sr_check_arguments);
    RUN(A8sa_check_calls);
    RUN(E1sa_check_reports);
    RUN(E1sb_check_bounds_of_all_kinds);
}
