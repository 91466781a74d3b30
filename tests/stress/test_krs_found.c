/* SPDX-License-Identifier: MIT
 *
 * Faults of kernel-reflection sequences, maps and binary tracing that reviews have found, each with
 * the smallest case that showed it. */
#include "../check.h"

#include <spheretrace/spheretrace.h>

#include <math.h>

/* A ball, or with a thickness the shell around its boundary; x, y, z, radius, thickness, slope. */
typedef struct body {
    float center[3], radius, thickness, slope;
} body;

static float body_distance(void *user, float x, float y, float z) {
    const body *const b = user;
    const float dx = x - b->center[0], dy = y - b->center[1], dz = z - b->center[2];
    const float d = sqrtf(dx * dx + dy * dy + dz * dz) - b->radius;
    return b->slope * (b->thickness > 0.0f ? fabsf(d) - b->thickness : d);
}

static spt_field field_of(body *b, spt_bound *bound) {
    spt_field field = spt_field_default();
    field.point = body_distance;
    field.user = b;
    field.lipschitz = 1.0f;
    field.bound = bound;
    return field;
}

static spt_hit trace_one(const spt_field *field, const spt_ray *ray, uint32_t budget) {
    spt_settings settings = spt_settings_default();
    spt_hit hit;
    const spt_rays rays = spt_rays_of(ray);
    const spt_hits hits = spt_hits_of(&hit);
    settings.budget = budget;
    CHECK(spt_trace(field, &settings, 1, &rays, &hits, NULL) == SPT_OK);
    return hit;
}

/* The first probe of a ray without end stood where the field knows nothing any more, and was free.
 * */
static void found_binary_without_end(void) {
    static const float ends[] = {100, 1e20f, INFINITY};
    body ball = {{0, 0, 0}, 1, 0, 1};
    const spt_field field = field_of(&ball, NULL);
    const spt_probe probe = spt_probe_of_field(&field);
    const spt_settings settings = spt_settings_default();
    for (int end = 0; end < 3; ++end) {
        const spt_ray ray = {{-5, 0, 0}, 0, {1, 0, 0}, ends[end]};
        spt_hit hit;
        const spt_rays rays = spt_rays_of(&ray);
        const spt_hits hits = spt_hits_of(&hit);
        check_context("t_max %g", (double)ends[end]);
        CHECK(spt_binary_trace(&probe, NULL, &settings, 1, &rays, &hits, NULL) == SPT_OK);
        CHECK(hit.outcome == SPT_HIT && fabsf(hit.t - 4) < 1e-4f);
    }
}

/* A field that no tracer would take made a probe that hits, or sees through, everything. */
static void found_probe_of_bad_field(void) {
    static const float slopes[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; ++i) {
        body ball = {{0, 0, 0}, 1, 0, 1};
        spt_field field = field_of(&ball, NULL);
        field.lipschitz = slopes[i];
        const spt_probe probe = spt_probe_of_field(&field);
        CHECK(probe.batch == NULL && probe.point == NULL);
    }
}

/* Far away distances stopped growing, and rays that miss ran out of budget, or saw NaN. */
static void found_misses_without_end(void) {
    body ball = {{0, 0, 0}, 1, 0, 1};
    const spt_field inner = field_of(&ball, NULL);
    const spt_kernel kernels[2] = {spt_kernel_field(&inner), spt_kernel_empty()};
    const spt_mirror mirror = {{1, 0, 0}, 2};
    const double center[3] = {3, 0, 0};
    static spt_krs krs;
    static spt_moekrs moekrs;
    static spt_conformal conformal;
    spt_krs_model model = spt_krs_model_default();
    spt_moekrs_model mapped = spt_moekrs_model_default();
    spt_mobius inversion;
    spt_field fields[3];
    model.levels = mapped.levels = 1;
    model.kernels = mapped.kernels = kernels;
    model.mirrors = &mirror;
    mapped.maps = &inversion;
    CHECK(spt_mobius_inversion(center, 1.5, &inversion) == SPT_OK);
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    CHECK(spt_moekrs_build(&mapped, &moekrs) == SPT_OK);
    CHECK(spt_conformal_field(&inner, &inversion, &conformal, &fields[0]) == SPT_OK);
    fields[1] = spt_krs_field(&krs);
    fields[2] = spt_moekrs_field(&moekrs);
    for (int i = 0; i < 3; ++i) {
        const spt_ray ray = {{0, 5, 0}, 0, {0, 1, 0.01f}, INFINITY};
        check_context("field %d", i);
        CHECK(fields[i].bound == NULL);
        CHECK(trace_one(&fields[i], &ray, 500).outcome == SPT_MISS);
    }
}

/* Exits near infinity made much of the rounding of little, and passed thin shells. */
static void found_exits_past_shells(void) {
    static const float sizes[] = {100, 1e3f, 1e4f}, parts[] = {5e-6f, 1e-5f, 1e-4f};
    const double origin[3] = {0, 0, 0};
    spt_settings settings = spt_settings_default();
    settings.budget = 1000;
    for (int size = 0; size < 3; ++size) {
        body shell = {{0, 0, 0}, 1 / sizes[size], parts[size] / sizes[size], 1};
        spt_bound around = spt_bound_sphere(0, 0, 0, 1.01f / sizes[size]);
        const spt_field inner = field_of(&shell, &around);
        static spt_conformal conformal;
        spt_mobius inversion;
        spt_field field;
        CHECK(spt_mobius_inversion(origin, 1, &inversion) == SPT_OK);
        CHECK(spt_conformal_field(&inner, &inversion, &conformal, &field) == SPT_OK);
        for (int i = 0; i < 60; ++i) {
            const double x = check_uniform(-1, 1), y = check_uniform(-1, 1),
                         z = check_uniform(0.1, 1);
            const double length = sqrt(x * x + y * y + z * z), start = check_uniform(0.5, 1.5);
            const spt_ray ray = {
                {(float)(start * x / length), (float)(start * y / length),
                 (float)(start * z / length)},
                0,
                {(float)(x / length) + 0.003f, (float)(y / length), (float)(z / length) - 0.003f},
                2 * sizes[size]};
            spt_hit hit;
            const spt_rays rays = spt_rays_of(&ray);
            const spt_hits hits = spt_hits_of(&hit);
            check_context("size %g, ray %d", (double)sizes[size], i);
            CHECK(spt_conformal_trace(&conformal, &settings, 1, &rays, &hits, NULL) == SPT_OK);
            CHECK(hit.outcome == SPT_HIT);
        }
    }
}

/* Preimages by quaternions cancelled: hits of an inversion far from the origin were off by 2e-2.
 * What positions in float32 leave is 2^-20 of the coordinates in kernel space, which lengths in the
 * world are as long as near the unit sphere of inversion. */
static void found_inversions_far_away(void) {
    static const float aways[] = {100, 300, 690};
    for (int away = 0; away < 3; ++away) {
        const float x = aways[away];
        body ball = {{x + 1, 0.25f, 0}, 0.2f, 0, 1};
        spt_bound around = spt_bound_sphere(x + 1, 0.25f, 0, 0.2f);
        const spt_field inner = field_of(&ball, &around);
        const double center[3] = {(double)x, 0, 0};
        const spt_region region = {SPT_REGION_BALL, {(double)x + 1, 0.25, 0}, (double)0.2f};
        spt_region image;
        static spt_conformal conformal;
        spt_mobius inversion;
        spt_field field;
        CHECK(spt_mobius_inversion(center, 1, &inversion) == SPT_OK);
        CHECK(spt_conformal_field(&inner, &inversion, &conformal, &field) == SPT_OK);
        CHECK(spt_mobius_region(&inversion, &region, &image) == SPT_OK);
        for (int i = 0; i < 40; ++i) {
            const double y = image.radius * check_uniform(-0.6, 0.6);
            const double z = image.radius * check_uniform(-0.6, 0.6);
            const spt_ray ray = {
                {x + 3, (float)(image.center[1] + y), (float)z}, 0, {-1, 0, 0}, 10};
            const double dy = (double)ray.origin[1] - image.center[1], dz = (double)ray.origin[2];
            const double depth = sqrt(image.radius * image.radius - dy * dy - dz * dz);
            const double t = (double)ray.origin[0] - image.center[0] - depth;
            const double cosine = depth / image.radius;
            const double most = (1e-4 + 0x1p-20 * 2 * (double)x) / cosine;
            const spt_hit hit = trace_one(&field, &ray, 300);
            check_context("%g away, ray %d", (double)x, i);
            CHECK(hit.outcome == SPT_HIT);
            CHECK_SAY(fabs((double)hit.t - t) <= most, "off by %g", (double)hit.t - t);
        }
    }
}

/* Fields that fall slower than their constant allows were hardly sampled at all. */
static void found_check_of_slow_fields(void) {
    static const float constants[] = {1, 2, 4};
    for (int i = 0; i < 3; ++i) {
        body ball = {{0, 0, 0}, 1, 0, 1};
        spt_bound around = spt_bound_sphere(0, 0, 0, 1);
        spt_field field = field_of(&ball, &around);
        field.lipschitz = constants[i];
        const spt_kernel kernels[2] = {spt_kernel_field(&field), spt_kernel_empty()};
        const spt_mirror mirror = {{1, 0, 0}, 0};
        static spt_krs krs;
        spt_krs_faults faults;
        spt_krs_model model = spt_krs_model_default();
        model.levels = 1;
        model.kernels = kernels;
        model.mirrors = &mirror;
        check_context("lipschitz %g", (double)constants[i]);
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        CHECK(spt_krs_check(&krs, 1000, 7, &faults) == SPT_OK);
        CHECK_SAY(faults.samples[0] > 900, "%u samples", faults.samples[0]);
        /* Half of it, within four standard deviations of a binomial count. */
        const double half = 0.5 * (double)faults.samples[0];
        CHECK(fabs((double)faults.discarded[0] - half) < 4 * sqrt(0.5 * half));
    }
}

/* Empty levels straddled, and identities of one branch differed, and collided with others. */
static void found_empty_levels_and_identities(void) {
    const spt_kernel kernels[2] = {spt_kernel_empty(), spt_kernel_sphere(0, 0, 0, 1)};
    const spt_mirror mirror = {{1, 0, 0}, -5};
    static spt_krs krs;
    spt_krs_model model = spt_krs_model_default();
    model.levels = 1;
    model.kernels = kernels;
    model.mirrors = &mirror;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    CHECK(krs.straddles == 0);
    CHECK(spt_krs_identity(0, 0x1b, 3) == spt_krs_identity(2, 0x18, 3));
    CHECK(spt_krs_identity(0, 0x1b, 3) != spt_krs_identity(4, 0x10, 3));
    CHECK(spt_krs_identity(0, 0x1b, 0) != spt_krs_identity(0, 0x18, 0));
    CHECK(spt_krs_identity(1, 0, 0) != spt_krs_identity(0, UINT64_C(1) << 56, 0));
}

/* A model whose lengths shrink by 10^28 was met where it is not. */
static void found_phantoms_of_small_models(void) {
    static spt_moekrs moekrs;
    spt_kernel kernels[29];
    spt_mobius maps[28];
    const spt_bound around = spt_bound_sphere(0, 0, 0, 50);
    spt_moekrs_model model = spt_moekrs_model_default();
    for (int i = 0; i <= 28; ++i) kernels[i] = spt_kernel_empty();
    kernels[0] = spt_kernel_sphere(-3, 0, 0, 1);
    for (int i = 0; i < 28; ++i) CHECK(spt_mobius_dilation(0.1, &maps[i]) == SPT_OK);
    model.levels = 28;
    model.kernels = kernels;
    model.maps = maps;
    model.bound = &around;
    CHECK(spt_moekrs_build(&model, &moekrs) == SPT_OK);
    const spt_field field = spt_moekrs_field(&moekrs);
    const spt_ray ray = {{-5, 1, 0}, 0, {1, 0, 0}, 100};
    CHECK(trace_one(&field, &ray, 128).outcome == SPT_MISS);
}

/* A circle so far away in units of its radius that its distance overflowed was at distance 0. */
static void found_small_arcs_far_away(void) {
    static const float a[3] = {0, 0, 0}, b[3] = {0.002f, 0, 0}, control[3] = {0.001f, 0.001f, 0};
    const spt_kernel kernel = spt_kernel_capsule(a, b, control, 1e-4f);
    const spt_arc arc = spt_arc_of(spt_point_of(0, 0, 0), spt_point_of(0.002f, 0, 0),
                                   spt_point_of(0.001f, 0.001f, 0), 1e-4f);
    spt_krs_model model = spt_krs_model_default();
    spt_krs krs;
    model.kernels = &kernel;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    const spt_field field = spt_krs_field(&krs);
    for (float y = 1e14f; y < 2e18f; y *= 10) {
        const float d = field.point(field.user, 0, y, 0);
        const float shape = spt_toroidal_capsule(spt_point_of(0, y, 0), &arc);
        CHECK_SAY(fabsf(d - y) <= 1e-6f * y, "%g at %g", (double)d, (double)y);
        CHECK_SAY(fabsf(shape - y) <= 1e-6f * y, "%g at %g", (double)shape, (double)y);
    }
}

static float answers(void *user, float x, float y, float z) {
    (void)x, (void)y, (void)z;
    return *(const float *)user;
}

/* NaN of one caller's field was lost where a later one answered a number. */
static void found_lost_nan(void) {
    static float values[2] = {5, NAN};
    spt_field fields[2];
    spt_kernel kernels[2];
    const spt_mirror mirror = {{1, 0, 0}, 0};
    spt_krs_model model = spt_krs_model_default();
    spt_krs krs;
    for (int i = 0; i < 2; ++i) {
        fields[i] = spt_field_default();
        fields[i].point = answers;
        fields[i].user = &values[i];
        kernels[i] = spt_kernel_field(&fields[i]);
    }
    model.levels = 1;
    model.kernels = kernels;
    model.mirrors = &mirror;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    const spt_field field = spt_krs_field(&krs);
    CHECK(isnan(field.point(field.user, -1, 0, 0)));
    values[1] = 7;
    CHECK(field.point(field.user, -1, 0, 0) <= 5);
}

void suite_krs_found(void) {
    RUN(found_small_arcs_far_away);
    RUN(found_lost_nan);
    RUN(found_binary_without_end);
    RUN(found_probe_of_bad_field);
    RUN(found_misses_without_end);
    RUN(found_exits_past_shells);
    RUN(found_inversions_far_away);
    RUN(found_check_of_slow_fields);
    RUN(found_empty_levels_and_identities);
    RUN(found_phantoms_of_small_models);
}
