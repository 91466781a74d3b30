/* SPDX-License-Identifier: MIT
 *
 * Calls of distorted fields: what is refused, how callbacks are called, a caller's map, columns of
 * points, and equal bits at every width. */
#include "distort_world.h"
#include "check.h"
#include "rules.h"
#include "../../src/krs/distort.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- Refusals ------------------------------------------------------------------------------- */

static void no_unmap(void *user, size_t n, float *x, float *y, float *z) {
    (void)user, (void)n, (void)x, (void)y, (void)z;
    CHECK(0);
}

/* The call is refused so, with nothing written and no callback called. */
static void refused(const spt_field *field, const spt_distortion *distortion, spt_status status) {
    spt_distorted memory, memory_before;
    spt_field result, result_before;
    memset(&memory, 0x5a, sizeof memory);
    memset(&result, 0x5a, sizeof result);
    memcpy(&memory_before, &memory, sizeof memory);
    memcpy(&result_before, &result, sizeof result);
    const spt_status seen = spt_distorted_field(field, distortion, &memory, &result);
    CHECK_SAY(seen == status, "%s", spt_status_name(seen));
    CHECK(memcmp(&memory, &memory_before, sizeof memory) == 0);
    CHECK(memcmp(&result, &result_before, sizeof result) == 0);
}

static void V1_refused_fields_and_pointers(void) {
    distort_body body = distort_body_of(ANALYTIC_BOX, 1);
    const spt_field good = distort_field_of(&body, DISTORT_BATCH);
    spt_distortion twist = spt_distortion_default();
    spt_distorted memory;
    spt_field bad, result;
    spt_bound bound;
    twist.kind = SPT_DISTORTION_TWIST;
    twist.rate = 1;
    CHECK(spt_distorted_field(&good, &twist, &memory, &result) == SPT_OK);
    CHECK(spt_distorted_field(&good, &twist, NULL, &result) == SPT_BAD_ARGUMENT);
    CHECK(spt_distorted_field(&good, &twist, &memory, NULL) == SPT_BAD_ARGUMENT);
    refused(NULL, &twist, SPT_BAD_ARGUMENT);
    refused(&good, NULL, SPT_BAD_ARGUMENT);
    bad = good;
    bad.batch = NULL;
    refused(&bad, &twist, SPT_BAD_ARGUMENT);
    bad = good;
    bad.lipschitz = NAN;
    refused(&bad, &twist, SPT_BAD_ARGUMENT);
    bad.lipschitz = 0x1p100f; /* times more than 1 */
    refused(&bad, &twist, SPT_BAD_ARGUMENT);
    bad = good;
    bad.struct_size = 8;
    refused(&bad, &twist, SPT_BAD_ARGUMENT);
    bad = good;
    bad.bound = NULL;
    refused(&bad, &twist, SPT_UNSUPPORTED);
    const float up[3] = {0, 1, 0};
    bound = spt_bound_slab(up, -1, 1);
    bad.bound = &bound;
    refused(&bad, &twist, SPT_UNSUPPORTED);
    for (int axis = 0; axis < 3; ++axis) {
        bound.low[axis] = -1;
        bound.high[axis] = 1;
    }
    CHECK(spt_distorted_field(&bad, &twist, &memory, &result) == SPT_OK);
    bound.radius = bound.range[0] = NAN;
    refused(&bad, &twist, SPT_BAD_ARGUMENT);
    CHECK(body.calls == 0);
}

static void V2_refused_numbers(void) {
    static const float worst[] = {NAN, INFINITY, -INFINITY};
    distort_body body = distort_body_of(ANALYTIC_BOX, 1);
    const spt_field field = distort_field_of(&body, DISTORT_BATCH);
    const spt_bound ball = spt_bound_sphere(0, 0, 0, 2);
    for (uint32_t kind = SPT_DISTORTION_TWIST; kind <= SPT_DISTORTION_MAP; ++kind) {
        spt_distortion good = spt_distortion_default();
        spt_distorted memory;
        spt_field result;
        good.kind = kind;
        good.rate = 0.25f;
        good.unmap = no_unmap;
        good.bound = &ball;
        check_context("kind %u", (unsigned)kind);
        CHECK(spt_distorted_field(&field, &good, &memory, &result) == SPT_OK);
        for (int i = 0; i < 3; ++i) {
            spt_distortion bad[9];
            for (int k = 0; k < 9; ++k) bad[k] = good;
            bad[0].origin[i] = worst[i];
            bad[1].axis[i] = worst[i];
            bad[2].side[i] = worst[i];
            bad[3].rate = worst[i];
            bad[4].wave = worst[i];
            bad[5].phase = worst[i];
            bad[6].phase = i == 0 ? 10001 : -10001;
            bad[7].struct_size = sizeof good - 8 - (size_t)i;
            bad[8].kind = i == 0 ? 0 : 5 + (uint32_t)i;
            for (int k = 0; k < 9; ++k) refused(&field, &bad[k], SPT_BAD_ARGUMENT);
        }
        spt_distortion bad = good;
        if (kind == SPT_DISTORTION_MAP) {
            bad.unmap = NULL;
            refused(&field, &bad, SPT_BAD_ARGUMENT);
            bad = good;
            bad.bound = NULL;
            refused(&field, &bad, SPT_BAD_ARGUMENT);
            bad = good;
            bad.lipschitz = 0;
            refused(&field, &bad, SPT_BAD_ARGUMENT);
            bad.lipschitz = 0x1p101f;
            refused(&field, &bad, SPT_BAD_ARGUMENT);
            bad.lipschitz = NAN;
            refused(&field, &bad, SPT_BAD_ARGUMENT);
            continue;
        }
        bad.axis[1] = 0; /* the default has only that */
        refused(&field, &bad, SPT_BAD_ARGUMENT);
        bad = good;
        bad.rate = kind == SPT_DISTORTION_TAPER ? -1 : 1e30f;
        refused(&field, &bad, SPT_BAD_ARGUMENT);
        const int sided = kind == SPT_DISTORTION_BEND || kind == SPT_DISTORTION_SWAY;
        const spt_status status = sided ? SPT_BAD_ARGUMENT : SPT_OK;
        bad = good;
        bad.side[0] = 0;
        CHECK(spt_distorted_field(&field, &bad, &memory, &result) == status);
        bad = good;
        bad.side[1] = 2e-3f;
        CHECK(spt_distorted_field(&field, &bad, &memory, &result) == status);
        bad.side[1] = 0.9e-3f;
        CHECK(spt_distorted_field(&field, &bad, &memory, &result) == SPT_OK);
    }
    CHECK(body.calls == 0);
}

/* A box from height 1 to 2: a taper by -0.4375 leaves it an eighth at the top, one by a little more
 * does not. */
static void V3_tapers_end_at_an_eighth(void) {
    distort_body body = distort_body_of(ANALYTIC_BOX, 1);
    spt_field field = distort_field_of(&body, DISTORT_BATCH), result;
    const spt_bound box = spt_bound_box(-1, 1, -1, 1, 2, 1);
    spt_distortion taper = spt_distortion_default();
    spt_distorted memory;
    field.bound = &box;
    taper.kind = SPT_DISTORTION_TAPER;
    taper.rate = -0.4375f;
    CHECK(spt_distorted_field(&field, &taper, &memory, &result) == SPT_OK);
    taper.rate = nextafterf(-0.4375f, -1);
    refused(&field, &taper, SPT_BAD_ARGUMENT);
}

/* ---- Callbacks ------------------------------------------------------------------------------ */

enum { point_count = 256 };

/* Points in, near and far beyond a body of size 1. */
static void draw_points(float *at) {
    static const float extreme[] = {0.0f, -0.0f, FLT_MAX, -FLT_MAX, 1e-45f, 1e30f, -1e19f, 1.0f};
    for (int i = 0; i < 3 * point_count; ++i) {
        const double reach = pow(10, check_uniform(-3, i % 5 == 0 ? 12 : 0.3));
        at[i] = (float)check_uniform(-reach, reach);
        if (i % point_count % 11 == 0) at[i] = extreme[check_random() % 8];
    }
}

/* A batch callback that writes over its points, and one for single points, give the same bits as
 * one that does neither; all see finite points in arrays as field.h says, whatever is asked. */
static void V4_forms_of_callback(void) {
    for (int i = 0; i < 40; ++i) {
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        const spt_distortion distortion =
            distort_draw(kind, 1, kind == SPT_DISTORTION_TAPER ? 0.8 : 3);
        float room[3 * point_count + 16], answers[3][point_count + 16];
        float *const at = distort_aligned(room);
        draw_points(at);
        check_context("kind %u", (unsigned)kind);
        for (int form = DISTORT_BATCH; form <= DISTORT_SCRIBBLE; ++form) {
            distort_body body = distort_body_of(ANALYTIC_BOX, 1);
            const spt_field inner = distort_field_of(&body, (distort_form)form);
            spt_distorted memory;
            spt_field field;
            float copy_room[3 * point_count + 16], *const copy = distort_aligned(copy_room);
            float *const answer = distort_aligned(answers[form]);
            memcpy(copy, at, 3 * point_count * sizeof *at);
            CHECK(spt_distorted_field(&inner, &distortion, &memory, &field) == SPT_OK);
            field.batch(field.user, point_count, copy, copy + point_count, copy + 2 * point_count,
                        answer);
            CHECK(body.faults == 0 && body.calls == (form == DISTORT_POINT ? point_count : 1));
            for (int k = 0; k < point_count; ++k) {
                CHECK_SAY(check_same_bits(answer[k], distort_aligned(answers[0])[k]),
                          "form %d: %.9g, not %.9g", form, (double)answer[k],
                          (double)distort_aligned(answers[0])[k]);
                CHECK(answer[k] >= -FLT_MAX); /* never NaN */
            }
        }
    }
}

/* Without rate nothing moves, but for rounding: 16u of coordinates up to 3, twice that with the
 * cosine of 0, which is 1 - 2^-24; and the constant is 1. */
static void V5_no_rate_is_the_identity(void) {
    for (int i = 0; i < 40; ++i) {
        spt_distortion distortion = distort_draw(distort_kind_of[i % distort_kinds], 1, 1);
        distort_body body = distort_body_of(ANALYTIC_CAPSULE, 1);
        const spt_field inner = distort_field_of(&body, DISTORT_BATCH);
        spt_distorted memory;
        spt_field field;
        distortion.rate = 0;
        CHECK(spt_distorted_field(&inner, &distortion, &memory, &field) == SPT_OK);
        CHECK(field.lipschitz >= 1 && field.lipschitz <= 1 + 0x1p-19f);
        for (int j = 0; j < 20; ++j) {
            double p[3];
            for (int k = 0; k < 3; ++k) p[k] = check_uniform(-0.5, 0.5);
            const double wanted = analytic_distance(&body.shape, p);
            const double seen = (double)distort_ask(&field, p);
            CHECK_SAY(fabs(seen - wanted) <= 3 * 32 * 0x1p-24, "%.9g, not %.9g", seen, wanted);
        }
    }
}

/* One deformation over another: bodies stay in both bounds, and no promise breaks. */
static void V6_twice_distorted(void) {
    for (int i = 0; i < 12; ++i) {
        distort_body body = distort_body_of(ANALYTIC_CAPSULE, 1);
        const spt_field inner = distort_field_of(&body, DISTORT_BATCH);
        const spt_distortion first = distort_draw(distort_kind_of[i % 4], 1, 0.6);
        const spt_distortion second = distort_draw(distort_kind_of[i / 4], 2, 0.3);
        spt_distorted memories[2];
        spt_field once, twice;
        spt_field_faults faults;
        CHECK(spt_distorted_field(&inner, &first, &memories[0], &once) == SPT_OK);
        CHECK(spt_distorted_field(&once, &second, &memories[1], &twice) == SPT_OK);
        CHECK(twice.lipschitz > once.lipschitz);
        CHECK(spt_field_check(&twice, 500, 7, &faults) == SPT_OK);
        CHECK_SAY(faults.steep == 0 && faults.outside_bound == 0 && faults.nonfinite == 0,
                  "%u steep, %u outside", (unsigned)faults.steep, (unsigned)faults.outside_bound);
        CHECK(body.faults == 0);
    }
}

/* ---- A caller's map ------------------------------------------------------------------------- */

/* y becomes y - sin(2 x) / 2: a shear of 1 at most. Where z > 5 the map leads nowhere, where
 * z < -5 to infinity. */
static void wave_unmap(void *user, size_t n, float *x, float *y, float *z) {
    const float *const arrays[3] = {x, y, z};
    unsigned *const faults = user;
    if (n % 16 != 0 || n < 16 || n > SPT_BATCH) ++*faults;
    for (int k = 0; k < 3; ++k) {
        if ((uintptr_t)arrays[k] % 64 != 0) ++*faults;
    }
    for (size_t i = 0; i < n; ++i) {
        if (!(fabsf(x[i]) <= FLT_MAX && fabsf(y[i]) <= FLT_MAX && fabsf(z[i]) <= FLT_MAX)) {
            ++*faults;
        }
        y[i] -= (float)(0.5 * sin(2 * (double)x[i]));
        if (z[i] > 5) x[i] = NAN;
        if (z[i] < -5) y[i] = -INFINITY;
    }
}

static void V7_maps_of_callers(void) {
    const float golden = 1.61803399f; /* of a shear of 1 */
    unsigned faults = 0;
    distort_body body = distort_body_of(ANALYTIC_CAPSULE, 1);
    spt_field inner = distort_field_of(&body, DISTORT_SCRIBBLE), field;
    const spt_bound around = spt_bound_box(-1, -2, -1, 1, 2, 1);
    spt_distortion map = spt_distortion_default();
    spt_distorted memory;
    inner.lipschitz = 2;
    inner.bound = NULL; /* a map needs none */
    map.kind = SPT_DISTORTION_MAP;
    map.unmap = wave_unmap;
    map.user = &faults;
    map.lipschitz = golden;
    map.bound = &around;
    CHECK(spt_distorted_field(&inner, &map, &memory, &field) == SPT_OK);
    CHECK(check_same_bits(field.lipschitz, 2 * golden));
    CHECK(field.bound->kind == SPT_BOUND_BOX && field.bound != &around);
    for (int i = 0; i < 200; ++i) {
        const double p[3] = {check_uniform(-1, 1), check_uniform(-2, 2), check_uniform(-1, 1)};
        const double at[3] = {(double)(float)p[0], (double)(float)p[1], (double)(float)p[2]};
        const double q[3] = {at[0], at[1] - 0.5 * sin(2 * at[0]), at[2]};
        const double wanted = analytic_distance(&body.shape, q);
        /* y rounds, of up to 2.5, and the distance. */
        CHECK(fabs((double)distort_ask(&field, p) - wanted) <= 3 * 0x1p-23);
        double g[3], dot = 0;
        const double r = hypot(q[0], q[2]), high = fabs(q[1]) - body.shape.extent;
        if (r < 0.05 || fabs(high) < 0.01) continue;
        /* Of the capsule, and pulled back. */
        double n[3] = {q[0], high > 0 ? copysign(high, q[1]) : 0, q[2]};
        n[0] -= cos(2 * at[0]) * n[1];
        distort_ask_gradient(&field, p, g);
        for (int k = 0; k < 3; ++k) dot += n[k] * g[k];
        dot /= distort_length(n) * distort_length(g);
        /* Steps of 2 / 1024 differ by a thousandth of that squared, and lose 2^-14 of y. */
        CHECK_SAY(dot >= 1 - 1e-6, "cosine %.9g", dot);
    }
    static const double nowhere[3] = {0, 0, 6}, infinitely[3] = {0, 0, -6};
    CHECK(isnan(distort_ask(&field, nowhere)));
    CHECK(distort_ask(&field, infinitely) > 1e30f);
    CHECK(faults == 0 && body.faults == 0);
}

/* ---- Columns of points ---------------------------------------------------------------------- */

static void V8_columns_of_points(void) {
    enum { count = 613, stride = 5 };
    float points[count][stride], moved[count][3], in_place[count][stride];
    distort_body body = distort_body_of(ANALYTIC_BOX, 1);
    const spt_field inner = distort_field_of(&body, DISTORT_BATCH);
    const spt_distortion distortion = distort_draw(SPT_DISTORTION_SWAY, 1, 2);
    spt_distorted memory;
    spt_field field;
    CHECK(spt_distorted_field(&inner, &distortion, &memory, &field) == SPT_OK);
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < stride; ++k) points[i][k] = (float)check_uniform(-2, 2);
    }
    points[17][1] = NAN;
    points[300][0] = INFINITY;
    memcpy(in_place, points, sizeof points);
    spt_vectors from = spt_vectors_of(points[0]);
    spt_vector_sinks to = spt_vector_sinks_of(moved[0]), back = spt_vector_sinks_of(in_place[0]);
    spt_vectors given = spt_vectors_of(in_place[0]);
    for (int k = 0; k < 3; ++k) {
        from.axis[k].stride = given.axis[k].stride = back.axis[k].stride = sizeof points[0];
    }
    CHECK(spt_distorted_points(&memory, count, &from, &to) == SPT_OK);
    CHECK(spt_distorted_points(&memory, count, &given, &back) == SPT_OK);
    for (int i = 0; i < count; ++i) {
        const float *const one = points[i];
        float alone[3];
        const spt_vectors single = spt_vectors_of(one);
        const spt_vector_sinks sink = spt_vector_sinks_of(alone);
        CHECK(spt_distorted_points(&memory, 1, &single, &sink) == SPT_OK);
        CHECK(memcmp(&in_place[i][3], &points[i][3], 2 * sizeof(float)) == 0);
        for (int k = 0; k < 3; ++k) {
            CHECK(check_same_bits(moved[i][k], in_place[i][k]));
            CHECK(check_same_bits(moved[i][k], alone[k]));
            CHECK(isnan(moved[i][k]) == (i == 17 || i == 300));
        }
    }
    CHECK(spt_distorted_points(&memory, 0, &from, &to) == SPT_OK);
    CHECK(spt_distorted_points(NULL, count, &from, &to) == SPT_BAD_ARGUMENT);
    CHECK(spt_distorted_points(&memory, count, NULL, &to) == SPT_BAD_ARGUMENT);
    CHECK(spt_distorted_points(&memory, count, &from, NULL) == SPT_BAD_ARGUMENT);
    memset(moved, 0, sizeof moved);
    for (int k = 0; k < 3; ++k) {
        spt_vectors bad = from;
        spt_vector_sinks bad_sink = to;
        bad.axis[k].first = NULL;
        CHECK(spt_distorted_points(&memory, count, &bad, &to) == SPT_BAD_ARGUMENT);
        bad_sink.axis[k].stride = 0;
        CHECK(spt_distorted_points(&memory, count, &from, &bad_sink) == SPT_BAD_ARGUMENT);
        CHECK(spt_distorted_points(&memory, SIZE_MAX, &from, &to) == SPT_BAD_ARGUMENT);
    }
    CHECK(moved[0][0] == 0 && body.calls == 0);
}

/* ---- Parity --------------------------------------------------------------------------------- */

/* All kernels give the same bits at all widths, in batches of any size. */
static void V9_bits_at_every_width(void) {
    enum { arrays = 8 };
    for (int i = 0; i < 60; ++i) {
        const uint32_t kind = distort_kind_of[i % distort_kinds];
        const spt_distortion distortion =
            distort_draw(kind, 1, kind == SPT_DISTORTION_TAPER ? 0.8 : 3);
        distort_body body = distort_body_of(ANALYTIC_BOX, 1);
        const spt_field inner = distort_field_of(&body, DISTORT_BATCH);
        float room[3 * point_count + 16], results[width_count][arrays * point_count + 16];
        float *const at = distort_aligned(room);
        spt_distorted memory;
        spt_field field;
        CHECK(spt_distorted_field(&inner, &distortion, &memory, &field) == SPT_OK);
        draw_points(at);
        for (int width = 0; width < width_count; ++width) {
            const spti_distort_kernels *const run =
                spti_distort_kernels_of[spti_isa_choose(widths[width])];
            float *const to = distort_aligned(results[width]);
            for (int k = 0; k < 4 * point_count; ++k) {
                to[4 * point_count + k] = at[(k + 40) % point_count];
            }
            const size_t group = width == 0 ? point_count : 16u << width;
            for (size_t first = 0; first < point_count; first += group) {
                const float *const x = at + first, *const y = x + point_count;
                float *const r = to + first;
                run->move(&memory, group, x, y, y + point_count, r, r + point_count,
                          r + 2 * point_count, r + 3 * point_count);
                run->settle(field.lipschitz, group, r + 3 * point_count, r + 4 * point_count);
                run->pull(&memory, group, x, y, y + point_count, r + 5 * point_count,
                          r + 6 * point_count, r + 7 * point_count);
            }
            for (int k = 0; k < arrays * point_count; ++k) {
                CHECK_SAY(check_same_bits(to[k], distort_aligned(results[0])[k]),
                          "%u lanes, array %d: %.9g, not %.9g", (unsigned)widths[width],
                          k / point_count, (double)to[k], (double)distort_aligned(results[0])[k]);
            }
        }
    }
}

void suite_distort_calls(void) {
    RUN(V1_refused_fields_and_pointers);
    RUN(V2_refused_numbers);
    RUN(V3_tapers_end_at_an_eighth);
    RUN(V4_forms_of_callback);
    RUN(V5_no_rate_is_the_identity);
    RUN(V6_twice_distorted);
    RUN(V7_maps_of_callers);
    RUN(V8_columns_of_points);
    RUN(V9_bits_at_every_width);
}
