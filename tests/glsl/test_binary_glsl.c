/* SPDX-License-Identifier: MIT
 *
 * Binary tracing as GLSL: what spt_binary_trace() answers, bit for bit, by a model's own probes and
 * by fields. */
#include "glsl_check.h"
#include "krs_glsl_world.h"

#include <math.h>
#include <string.h>

static char said[512];

static const uint32_t features_of_hits[] = {
    0, SPT_GLSL_FLAGS | SPT_GLSL_FALLBACKS, SPT_GLSL_PATH | SPT_GLSL_GUARDS | SPT_GLSL_COMPONENT,
    SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS | SPT_GLSL_PATH};
enum { feature_count = sizeof features_of_hits / sizeof features_of_hits[0] };

/* Where guards are, every seventh ray is none. */
static void spoil_rays(world_trace *trace) {
    if (!(trace->features & SPT_GLSL_GUARDS)) return;
    for (int i = 0; i < WORLD_RAYS; i += 7) {
        if (i % 2) trace->rays[i].direction[0] = NAN;
        if (!(i % 2)) trace->rays[i].t_min = -1;
    }
}

/* Counts the outcomes. */
static void check_binary(const spt_field *field, const spt_probe *probe, uint32_t features,
                         const spt_settings *settings, int ends[SPT_OUTCOMES]) {
    static world_trace trace;
    static spt_hit expected[WORLD_RAYS];
    trace.field = field;
    trace.settings = settings;
    trace.features = SPT_GLSL_BINARY | features;
    world_rays(field, trace.rays, trace.paths);
    spoil_rays(&trace);
    spt_rays rays = spt_rays_of(trace.rays);
    const spt_hits hits = spt_hits_of(expected);
    if (features & SPT_GLSL_PATH) {
        rays.path.first = trace.paths;
        rays.path.stride = sizeof trace.paths[0];
    }
    CHECK(spt_binary_trace(probe, NULL, settings, WORLD_RAYS, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(world_run(&trace, said), "%s", said);
    const int wrong = world_wrong_hits(&trace, expected, said);
    CHECK_SAY(wrong == 0, "%d rays; %s", wrong, said);
    for (int i = 0; i < WORLD_RAYS; ++i) ++ends[expected[i].outcome];
}

static void check_settings(const spt_field *field, const spt_probe *probe, int turn,
                           int ends[SPT_OUTCOMES]) {
    spt_settings settings = spt_settings_default();
    settings.budget = turn % 3 == 2 ? 20 : 256;
    settings.pixel_radius = turn % 2 ? 1e-3f : turn % 8 == 4 ? 0.25f : 0.0f;
    settings.size = turn % 4 == 3 ? 2.0f : 0.0f;
    if (turn % 4 == 2) settings.epsilon = 1e-30f; /* then what float resolves ends rays */
    check_context("turn %d", turn);
    check_binary(field, probe, features_of_hits[turn % feature_count], &settings, ends);
}

/* Rays must have ended in every way but by NaN. */
static void check_ends(const int ends[SPT_OUTCOMES]) {
    CHECK_SAY(ends[SPT_HIT] > WORLD_RAYS && ends[SPT_MISS] > WORLD_RAYS && ends[SPT_LIMIT] > 20 &&
                  ends[SPT_BAD_RAY] > 20,
              "%d hits, %d misses, %d limits, %d bad", ends[SPT_HIT], ends[SPT_MISS],
              ends[SPT_LIMIT], ends[SPT_BAD_RAY]);
}

/* By a model's own probe, with a bound and without. */
static void B1_own_probes(void) {
    static spt_moekrs moekrs;
    int ends[SPT_OUTCOMES] = {0};
    for (int i = 0; i < 12; ++i) {
        world_moekrs((uint32_t)i % 3, i & 1 ? WORLD_FIELD | WORLD_CAPSULE : WORLD_SPHERE, 0,
                     &moekrs);
        spt_field field = spt_moekrs_field(&moekrs);
        spt_probe probe = spt_moekrs_probe(&moekrs);
        if (i % 4 == 3) {
            field.bound = NULL;
            probe.bound = NULL;
        }
        check_settings(&field, &probe, i, ends);
    }
    check_ends(ends);
}

/* By f / lipschitz, of models and of a caller's field. */
static void B2_fields(void) {
    static spt_krs krs;
    int ends[SPT_OUTCOMES] = {0};
    for (int i = 0; i < 12; ++i) {
        world_krs(3, WORLD_ANY & ~(uint32_t)WORLD_HALF_SPACE, &krs);
        spt_field field = i & 1 ? *world_field(i / 2 % WORLD_FIELDS) : spt_krs_field(&krs);
        if (i % 4 >= 2) field.bound = NULL;
        const spt_probe probe = spt_probe_of_field(&field);
        check_settings(&field, &probe, i, ends);
    }
    check_ends(ends);
}

/* A probe that is no number is not free; where it was the last one, that is how the ray ends. */
static void B3_not_a_number(void) {
    static spt_moekrs moekrs;
    const uint32_t features = SPT_GLSL_GUARDS | SPT_GLSL_FALLBACKS | SPT_GLSL_FLAGS;
    const spt_settings settings = spt_settings_default();
    const spt_kernel kernels[2] = {spt_kernel_field(world_field_with_nan()),
                                   spt_kernel_sphere(0, 0, 0, 0.125f)};
    const double by[3] = {-0.25, 0, 0};
    spt_mobius map;
    spt_moekrs_model model = spt_moekrs_model_default();
    spt_probe probe = spt_probe_of_field(world_field_with_nan());
    int ends[SPT_OUTCOMES] = {0};
    check_binary(world_field_with_nan(), &probe, features, &settings, ends);
    CHECK(spt_mobius_translation(by, &map) == SPT_OK);
    model.levels = 1;
    model.kernels = kernels;
    model.maps = &map;
    CHECK(spt_moekrs_build(&model, &moekrs) == SPT_OK);
    const spt_field field = spt_moekrs_field(&moekrs);
    probe = spt_moekrs_probe(&moekrs);
    check_binary(&field, &probe, features, &settings, ends);
    CHECK_SAY(ends[SPT_NONFINITE] > WORLD_RAYS / 32, "%d rays", ends[SPT_NONFINITE]);
}

/* Traces the rays as they are. */
static void check_binary_rays(world_trace *trace) {
    static spt_hit expected[WORLD_RAYS];
    const spt_probe probe = spt_probe_of_field(trace->field);
    const spt_rays rays = spt_rays_of(trace->rays);
    const spt_hits hits = spt_hits_of(expected);
    trace->features = SPT_GLSL_BINARY | SPT_GLSL_FLAGS;
    CHECK(spt_binary_trace(&probe, NULL, trace->settings, WORLD_RAYS, &rays, &hits, NULL) ==
          SPT_OK);
    CHECK_SAY(world_run(trace, said), "%s", said);
    const int wrong = world_wrong_hits(trace, expected, said);
    CHECK_SAY(wrong == 0, "%d rays; %s", wrong, said);
}

/* Onto a plane: from it, where the first probe is a point, but with a radius; from far away with
 * no tolerance but what t resolves; and with ends within a large tolerance of it. */
static void B4_onto_a_plane(void) {
    static world_trace trace;
    static spt_krs krs;
    for (int turn = 0; turn < 3; ++turn) {
        const float height = turn == 0 ? 0.0f : 5.0f;
        const spt_kernel kernel = spt_kernel_half_space(0, 0, 1, -height);
        spt_settings settings = spt_settings_default();
        spt_krs_model model = spt_krs_model_default();
        model.kernels = &kernel;
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        const spt_field field = spt_krs_field(&krs);
        trace.field = &field;
        trace.settings = &settings;
        if (turn == 1) settings.epsilon = 1e-30f;
        if (turn == 2) settings.pixel_radius = 0.25f;
        check_context("turn %d", turn);
        world_rays(&field, trace.rays, trace.paths);
        for (int i = 0; i < WORLD_RAYS; ++i) {
            spt_ray *const ray = &trace.rays[i];
            const float down = (float)check_uniform(-8, -0.5);
            ray->t_min = 0;
            ray->direction[2] = down;
            for (int axis = 0; axis < 3; ++axis) ray->origin[axis] *= 1e-3f;
            if (turn == 0) ray->origin[2] = i % 2 ? 0.0f : 1e-6f;
            ray->t_max = turn == 2 ? -height / down * (float)check_uniform(0.8, 1.1) : 1e3f;
        }
        check_binary_rays(&trace);
    }
}

void suite_binary_glsl(void) {
    RUN(B1_own_probes);
    RUN(B2_fields);
    RUN(B3_not_a_number);
    RUN(B4_onto_a_plane);
}
