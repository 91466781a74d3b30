/* SPDX-License-Identifier: MIT
 *
 * Arguments that spt_krs_build() and spt_krs_locate() refuse: each by the header's words, with not a
 * byte written. Mirrors are in test_krs_mirrors.c, spt_krs_check() in test_krs_faults.c. */
#include "krs_places.h"
#include "../check.h"

#include <math.h>
#include <string.h>

/* ---- Building -------------------------------------------------------------------------------- */

static krs_drawn sample;
static spt_krs_model model;
static spt_bound bound;
static spt_field field;
static spt_krs krs, before;

/* A model of all kinds that is right, to be spoiled. */
static void prepare(void) {
    const float a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, control[3] = {0.5f, 0.25f, 0},
                across[3] = {0, 0, 3};
    krs_draw(&sample, 5, KRS_FIELDS, 0);
    field = sample.fields[5];
    sample.kernels[0] = spt_kernel_sphere(0, 0, 0, 1);
    sample.kernels[1] = spt_kernel_capsule(a, b, control, 0.125f);
    sample.kernels[2] = spt_kernel_leaf(a, b, across, 0.25f, 0.125f);
    sample.kernels[3] = spt_kernel_half_space(0, 1, 0, -4);
    sample.kernels[4] = spt_kernel_empty();
    sample.kernels[5] = spt_kernel_field(&field);
    bound = spt_bound_sphere(0, 0, 0, 1000);
    model = krs_model_of(&sample);
    model.bound = &bound;
    model.smooth = 0.5f;
}

static void refuse(const char *why) {
    memset(&krs, 0x5a, sizeof krs);
    memcpy(&before, &krs, sizeof krs);
    CHECK_SAY(spt_krs_build(&model, &krs) == SPT_BAD_ARGUMENT, "%s", why);
    CHECK_SAY(memcmp(&krs, &before, sizeof krs) == 0, "%s: something was written", why);
}

static void accept(const char *why) {
    CHECK_SAY(spt_krs_build(&model, &krs) == SPT_OK, "%s", why);
}

#define REFUSE(spoil) (prepare(), (void)(spoil), refuse(#spoil))
#define ACCEPT(change) (prepare(), (void)(change), accept(#change))

static const float not_finite[] = {NAN, INFINITY, -INFINITY};

static void krs_arguments_of_models(void) {
    ACCEPT(0);
    CHECK(spt_krs_build(NULL, &krs) == SPT_BAD_ARGUMENT);
    CHECK(spt_krs_build(&model, NULL) == SPT_BAD_ARGUMENT);
    REFUSE(model.struct_size = 0);
    REFUSE(model.struct_size = sizeof model - 1);
    REFUSE(model.levels = SPT_KRS_LEVELS + 1);
    REFUSE(model.kernels = NULL);
    REFUSE((model.kernels = NULL, model.levels = 0));
    REFUSE(model.mirrors = NULL);
    ACCEPT((model.mirrors = NULL, model.levels = 0));
    REFUSE(model.smooth = -1);
    for (int i = 0; i < 3; ++i) REFUSE(model.smooth = not_finite[i]);
    ACCEPT(model.smooth = 0);
    for (uint32_t lanes = 0; lanes <= 33; ++lanes) {
        if (lanes == 0 || lanes == 1 || lanes == 4 || lanes == 8 || lanes == 16)
            ACCEPT(model.max_lanes = lanes);
        else
            REFUSE(model.max_lanes = lanes);
    }
    ACCEPT(model.bound = NULL);
    REFUSE(bound.radius = -1);
    REFUSE(bound.radius = NAN);
    REFUSE(bound.kind = 77);
    REFUSE(bound.struct_size = 0);
}

static void krs_arguments_of_shapes(void) {
    for (uint32_t i = 0; i <= 5; ++i) {
        REFUSE(sample.kernels[i].kind = SPT_KERNEL_KINDS);
        REFUSE(sample.kernels[i].kind = UINT32_MAX);
    }
    for (int i = 0; i < 3; ++i) {
        for (int kernel = 0; kernel < 4; ++kernel) {
            for (int axis = 0; axis < 3; ++axis) {
                REFUSE(sample.kernels[kernel].a[axis] = not_finite[i]);
                if (kernel == 0 || kernel == 3) continue;
                REFUSE(sample.kernels[kernel].b[axis] = not_finite[i]);
                REFUSE(sample.kernels[kernel].control[axis] = not_finite[i]);
            }
            REFUSE(sample.kernels[kernel].radius = not_finite[i]);
        }
        REFUSE(sample.kernels[2].width = not_finite[i]);
    }
    for (int kernel = 0; kernel < 3; ++kernel) {
        REFUSE(sample.kernels[kernel].radius = -0.125f);
        ACCEPT(sample.kernels[kernel].radius = 0);
    }
    REFUSE(sample.kernels[2].width = 0);
    REFUSE(sample.kernels[2].width = -0.25f);
    REFUSE(sample.kernels[2].width = 0.5625f); /* more than half of 1 */
    ACCEPT(sample.kernels[2].width = 0.5f);
    REFUSE(sample.kernels[2].b[0] = 0); /* the tips coincide */
    REFUSE(sample.kernels[2].control[2] = 0);
    REFUSE(sample.kernels[3].a[1] = 0);
}

static void krs_arguments_of_fields(void) {
    REFUSE(sample.kernels[5].field = NULL);
    REFUSE(field.struct_size = 0);
    REFUSE((field.batch = NULL, field.point = NULL));
    REFUSE(field.lipschitz = 0);
    REFUSE(field.lipschitz = -1);
    REFUSE(field.lipschitz = ldexpf(1, -101));
    REFUSE(field.lipschitz = ldexpf(1, 101));
    for (int i = 0; i < 3; ++i) REFUSE(field.lipschitz = not_finite[i]);
    REFUSE(field.flags = 1u << 31);
    REFUSE(sample.bounds[5].radius = -1);
    REFUSE(field.gradient = NULL); /* smooth > 0 */
    ACCEPT((field.gradient = NULL, model.smooth = 0));
    ACCEPT(field.bound = NULL);
}

/* A built model holds no pointer to its description, nor into itself. */
static void krs_models_stand_alone(void) {
    static spt_krs copy;
    static float points[128][3], values[128], others[128];
    prepare();
    accept("the model");
    const spt_field original = spt_krs_field(&krs);
    krs_draw_points(&sample, 128, points);
    krs_values(&original, 128, (const float(*)[3])points, values);
    for (int i = 0; i <= 5; ++i) sample.kernels[i] = spt_kernel_sphere(9, 9, 9, 9);
    memset(sample.mirrors, 0x7f, sizeof sample.mirrors);
    memset(&bound, 0x7f, sizeof bound);
    memset(&field, 0x7f, sizeof field);
    memset(&sample.bounds[5], 0x7f, sizeof sample.bounds[5]);
    memcpy(&copy, &krs, sizeof krs);
    memset(&krs, 0x7f, sizeof krs);
    const spt_field copied = spt_krs_field(&copy);
    krs_values(&copied, 128, (const float(*)[3])points, others);
    for (int i = 0; i < 128; ++i) CHECK(check_same_bits(values[i], others[i]));
    CHECK(copied.lipschitz >= 1 && copied.lipschitz <= 1);
    CHECK(copied.bound != NULL && copied.bound->kind == SPT_BOUND_SPHERE);
}

/* ---- Locating -------------------------------------------------------------------------------- */

enum { ray_count = 2 };

typedef struct call {
    spt_ray ray[ray_count];
    spt_hit hit[ray_count];
    krs_place place[ray_count];
} call;

static call data;
static spt_settings settings;
static spt_rays rays;
static spt_hits hits;
static spt_krs_places places;

static void prepare_call(void) {
    static const spt_ray ray = {{1, 2, 3}, 0, {0, 0, 1}, 10};
    memset(&data, 0x5a, sizeof data);
    for (int i = 0; i < ray_count; ++i) {
        data.ray[i] = ray;
        data.hit[i] = (spt_hit){1, 0, SPT_HIT, 1, 0, 0, 1, 0, 0};
    }
    settings = spt_settings_default();
    rays = spt_rays_of(data.ray);
    hits = spt_hits_of(data.hit);
    places = krs_places_of(data.place);
}

static void refuse_call(const char *why, const spt_krs *of, const spt_settings *how,
                        const spt_rays *from, const spt_hits *at, const spt_krs_places *to) {
    static call untouched;
    memcpy(&untouched, &data, sizeof data);
    CHECK_SAY(spt_krs_locate(of, 0, how, ray_count, from, at, to) == SPT_BAD_ARGUMENT, "%s", why);
    CHECK_SAY(memcmp(&untouched, &data, sizeof data) == 0, "%s: something was written", why);
}

#define REFUSE_CALL(spoil) \
    (prepare_call(), (void)(spoil), refuse_call(#spoil, &krs, &settings, &rays, &hits, &places))

static void krs_arguments_of_locate(void) {
    prepare();
    accept("the model");
    prepare_call();
    CHECK(spt_krs_locate(&krs, 0, &settings, ray_count, &rays, &hits, &places) == SPT_OK);
    prepare_call();
    refuse_call("no model", NULL, &settings, &rays, &hits, &places);
    refuse_call("no settings", &krs, NULL, &rays, &hits, &places);
    refuse_call("no rays", &krs, &settings, NULL, &hits, &places);
    refuse_call("no hits", &krs, &settings, &rays, NULL, &places);
    refuse_call("no places", &krs, &settings, &rays, &hits, NULL);
    CHECK(spt_krs_locate(&krs, 0, &settings, 0, NULL, NULL, &places) == SPT_OK);
    REFUSE_CALL(settings.struct_size = 0);
    REFUSE_CALL(settings.method = NULL);
    REFUSE_CALL(settings.pixel_radius = -1);
    REFUSE_CALL(settings.pixel_radius = NAN);
    REFUSE_CALL(settings.epsilon = 0);
    REFUSE_CALL(settings.max_lanes = 3);
    REFUSE_CALL(settings.flags = 1u << 31);
    for (int axis = 0; axis < 3; ++axis) {
        REFUSE_CALL(rays.origin[axis].first = NULL);
        REFUSE_CALL(rays.direction[axis].first = NULL);
        REFUSE_CALL(places.point.axis[axis].stride = 0);
        REFUSE_CALL(places.normal.axis[axis].stride = 0);
        REFUSE_CALL(places.kernel_normal.axis[axis].stride = 0);
    }
    REFUSE_CALL(hits.t.first = NULL);
    REFUSE_CALL(places.kernel.stride = 0);
    REFUSE_CALL(places.mirrors.stride = 0);
    REFUSE_CALL(places.u.stride = 0);
    REFUSE_CALL(places.v.stride = 0);
    REFUSE_CALL(places.scale.stride = 0);
    prepare_call();
    CHECK(spt_krs_locate(&krs, 0, &settings, SIZE_MAX, &rays, &hits, &places) == SPT_BAD_ARGUMENT);
}

void suite_krs_arguments(void) {
    RUN(krs_arguments_of_models);
    RUN(krs_arguments_of_shapes);
    RUN(krs_arguments_of_fields);
    RUN(krs_models_stand_alone);
    RUN(krs_arguments_of_locate);
}
