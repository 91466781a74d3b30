/* SPDX-License-Identifier: MIT
 *
 * Moebius kernel-reflection sequences, conformal and distorted fields and level sets as GLSL: the
 * same bits as in C. */
#include "glsl_check.h"
#include "krs_glsl_world.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static char said[512];

static const uint32_t targets[] = {SPT_GLSL_COMPUTE_450, SPT_GLSL_FRAGMENT_330,
                                   SPT_GLSL_COMPUTE_310_ES, SPT_GLSL_FRAGMENT_300_ES,
                                   SPT_GLSL_COMPUTE_430};
enum { target_count = sizeof targets / sizeof targets[0] };

static void check_field(const spt_field *field, uint32_t target, uint32_t features) {
    const int different = world_differences(field, target, features, said);
    CHECK_SAY(different == 0, "%d of %d points differ; %s", different, WORLD_POINTS, said);
}

/* Also at the pole of the first map, where that has one. */
static void check_around_pole(const spt_field *field, const spt_built_map *map, uint32_t target,
                              uint32_t features) {
    float places[2][3] = {{0, 0, 0}, {0, 0, 0}};
    const int has_pole = map != NULL && map->pole[0] <= FLT_MAX;
    if (has_pole) memcpy(places[1], map->pole, sizeof places[1]);
    const int different = world_differences_at(field, target, features, places, 1 + has_pole, said);
    CHECK_SAY(different == 0, "%d of %d points differ; %s", different, WORLD_POINTS, said);
}

/* A model for every length, with callers' fields or without, all mirrored or not. */
static void draw_moekrs(int i, spt_moekrs *moekrs) {
    static const uint32_t lengths[] = {0, 1, 5, 28, 64};
    const uint32_t kinds = i & 1 ? WORLD_ANY : WORLD_OWN;
    const uint64_t unmirrored =
        i & 2 ? (uint64_t)check_random() << 32 | check_random() : UINT64_C(0);
    world_moekrs(lengths[i / 4 % 5], kinds, unmirrored, moekrs);
}

static void M1_moekrs_distances(void) {
    static spt_moekrs moekrs;
    int ways[2] = {0, 0};
    for (int i = 0; i < 40; ++i) {
        draw_moekrs(i, &moekrs);
        const uint32_t target = targets[i % target_count];
        const spt_field field = spt_moekrs_field(&moekrs);
        check_context("%u levels, model %d, target %u", (unsigned)moekrs.levels, i,
                      (unsigned)target);
        check_around_pole(&field, moekrs.levels > 0 ? &moekrs.maps[moekrs.levels - 1] : NULL,
                          target, i >= 20 ? SPT_GLSL_ARRAYS : 0);
        for (uint32_t level = 0; level < moekrs.levels; ++level) {
            ++ways[moekrs.maps[level].inverts != 0];
        }
    }
    CHECK_SAY(ways[0] > 40 && ways[1] > 40, "%d maps by quaternions, %d by inversions", ways[0],
              ways[1]);
}

static void M9_vulkan(void) {
    static spt_moekrs moekrs;
    if (!engine_here(engine_vulkan_open(), "no Vulkan, or no compiler for it")) return;
    for (int i = 4; i < 12; ++i) {
        draw_moekrs(i, &moekrs);
        const spt_field field = spt_moekrs_field(&moekrs);
        check_context("%u levels, model %d", (unsigned)moekrs.levels, i);
        check_field(&field, SPT_GLSL_VULKAN_450, i & 1 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* Where lengths shrink or grow beyond all bounds. Without callers' fields, before which points
 * beyond 1e18 are held to that. */
static void M3_long_scales(void) {
    static spt_moekrs moekrs;
    for (int i = 0; i < 4; ++i) {
        spt_kernel kernels[33];
        spt_mobius maps[32];
        spt_moekrs_model model = spt_moekrs_model_default();
        for (int level = 0; level <= 32; ++level) kernels[level] = world_kernel(WORLD_OWN);
        for (int level = 0; level < 32; ++level) {
            const double scale = i % 2 ? 30 : 1.0 / 30, center[3] = {0.25, 0.5, 0.125};
            spt_mobius turn;
            CHECK(spt_mobius_dilation(scale, &maps[level]) == SPT_OK);
            if (level % 8 != 3) continue;
            CHECK(spt_mobius_inversion(center, 1, &turn) == SPT_OK);
            CHECK(spt_mobius_compose(&turn, &maps[level], &maps[level]) == SPT_OK);
        }
        model.levels = 32;
        model.kernels = kernels;
        model.maps = maps;
        CHECK(spt_moekrs_build(&model, &moekrs) == SPT_OK);
        const spt_field field = spt_moekrs_field(&moekrs);
        check_context("scales %d", i);
        check_field(&field, targets[i], i / 2 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* Balls of all sizes, from a library's text. Returns how many are free. */
static int check_probes(const spt_moekrs *moekrs, uint32_t features) {
    enum { count = 2048 };
    static float in[4 * count], out[4 * count];
    const spt_field field = spt_moekrs_field(moekrs);
    const spt_probe probe = spt_moekrs_probe(moekrs);
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    spt_status status;
    int frees = 0;
    options.field = &field;
    options.settings = &settings;
    options.features = SPT_GLSL_BINARY | features;
    char *const text = world_emit(&options, &status);
    CHECK_SAY(text != NULL, "status %d", (int)status);
    if (text == NULL) return 0;
    for (int i = 0; i < count; ++i) {
        const double reach = i % 8 == 7 ? 1e6 : 4;
        for (int axis = 0; axis < 3; ++axis) {
            in[4 * i + axis] = (float)check_uniform(-reach, reach);
        }
        in[4 * i + 3] = exp2f((float)check_uniform(-20, i % 16 == 0 ? 100 : 2));
    }
    CHECK(engine_values(text, "    r[0] = vec4(spt_probe(q[0].xyz, q[0].w));", count, 1, in, 1,
                        out) == ENGINE_OK);
    free(text);
    for (int i = 0; i < count; ++i) {
        const float *const ball = &in[4 * i];
        const float expected = probe.point(probe.user, ball[0], ball[1], ball[2], ball[3]);
        const int same =
            out[4 * i] >= 3.0e38f ? expected >= 3.0e38f : check_same_bits(out[4 * i], expected);
        CHECK_SAY(same, "ball %d, %.9g %.9g %.9g, %.9g: %.9g for %.9g", i, (double)ball[0],
                  (double)ball[1], (double)ball[2], (double)ball[3], (double)out[4 * i],
                  (double)expected);
        frees += expected >= 0.0f;
    }
    return frees;
}

static void M2_probes(void) {
    static spt_moekrs moekrs;
    int frees = 0;
    for (int i = 0; i < 20; ++i) {
        draw_moekrs(i, &moekrs);
        check_context("%u levels, model %d", (unsigned)moekrs.levels, i);
        frees += check_probes(&moekrs,
                              (i & 1 ? SPT_GLSL_ARRAYS : 0u) | (i / 2 & 1 ? SPT_GLSL_GUARDS : 0u));
    }
    CHECK_SAY(frees > 4096 && frees < 38912, "%d of 40960 are free", frees);
}

/* ---- Fields of fields ------------------------------------------------------------------------ */

static void M4_conformal(void) {
    static spt_krs krs;
    for (int i = 0; i < 20; ++i) {
        spt_conformal memory;
        spt_field field;
        const spt_mobius map = world_map();
        world_krs(2, WORLD_ANY & ~(uint32_t)WORLD_HALF_SPACE, &krs);
        const spt_field inner = i & 1 ? *world_field(i / 2 % WORLD_FIELDS) : spt_krs_field(&krs);
        CHECK(spt_conformal_field(&inner, &map, &memory, &field) == SPT_OK);
        check_context("map %d", i);
        check_around_pole(&field, &memory.map, targets[i % target_count],
                          i & 4 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* What is infinitely far is so seen through maps, and beside a region. */
static void M5_nothing(void) {
    static spt_krs krs;
    for (int i = 0; i < 6; ++i) {
        const spt_mobius map = world_map();
        const float lipschitz = i % 2 ? 0x1p99f : 1.0f;
        spt_distortion twist = spt_distortion_default();
        spt_conformal conformal;
        spt_distorted distorted;
        spt_field field, twisted;
        spt_krs_model model = spt_krs_model_default();
        twist.kind = SPT_DISTORTION_TWIST;
        twist.rate = 0.25f;
        const spt_field *const inner = world_field_of_nothing(lipschitz);
        check_context("map %d", i);
        CHECK(spt_conformal_field(inner, &map, &conformal, &field) == SPT_OK);
        check_field(&field, targets[i % target_count], 0);
        CHECK(spt_distorted_field(inner, &twist, &distorted, &twisted) == SPT_OK);
        const spt_kernel kernel = spt_kernel_field(&twisted);
        model.kernels = &kernel;
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        field = spt_krs_field(&krs);
        check_field(&field, targets[i % target_count], 0);
    }
}

static void unmap(void *user, size_t n, float *x, float *y, float *z) {
    (void)user;
    for (size_t i = 0; i < n; ++i) { /* stays within 1e18, wherever a point is */
        const float shear = y[i] / (1.0f + y[i] * y[i]);
        x[i] = x[i] - 0.5f * shear;
        z[i] = 1.25f * z[i];
    }
}
static const char unmap_text[] = "return sheared(p);";
static const char unmap_prelude[] = "vec3 sheared(vec3 p) {\n"
                                    "    SPT_PRECISE float shear = p.y / (1.0 + p.y * p.y);\n"
                                    "    SPT_PRECISE float x = p.x - 0.5 * shear;\n"
                                    "    SPT_PRECISE float z = 1.25 * p.z;\n"
                                    "    return vec3(x, p.y, z);\n"
                                    "}\n";

/* The same, but what was in y > 0.5 is nowhere. */
static void unmap_some(void *user, size_t n, float *x, float *y, float *z) {
    unmap(user, n, x, y, z);
    for (size_t i = 0; i < n; ++i) {
        if (y[i] > 0.5f) z[i] = NAN;
    }
}
static const char unmap_some_text[] =
    "vec3 q = sheared(p);\n"
    "return p.y > 0.5 ? vec3(q.xy, uintBitsToFloat(0x7fc00000u)) : q;\n";

/* A deformation that the field's bound allows. */
static spt_distortion draw_distortion(uint32_t kind) {
    static const spt_bound ball = {
        .struct_size = sizeof ball, .kind = SPT_BOUND_SPHERE, .radius = 3};
    spt_distortion distortion = spt_distortion_default();
    distortion.kind = kind;
    for (int axis = 0; axis < 3; ++axis) {
        distortion.origin[axis] = (float)check_uniform(-0.25, 0.25);
        distortion.axis[axis] = (float)check_uniform(-1, 1);
    }
    distortion.axis[1] = 1;
    if (check_random() % 4 == 0) { /* then there are points on the axis */
        distortion.axis[0] = distortion.axis[2] = 0;
        memset(distortion.origin, 0, sizeof distortion.origin);
    }
    distortion.side[0] = 1; /* at right angles to the axis */
    distortion.side[1] = -distortion.axis[0];
    distortion.side[2] = 0;
    distortion.rate = (float)check_uniform(-0.3, 0.3);
    distortion.wave = (float)check_uniform(-3, 3);
    distortion.phase = (float)check_uniform(-100, 100);
    if (kind == SPT_DISTORTION_MAP) {
        distortion.unmap = unmap;
        distortion.lipschitz = 2.5f;
        distortion.bound = &ball;
        distortion.glsl = unmap_text;
        distortion.glsl_prelude = unmap_prelude;
    }
    return distortion;
}

static void M6_distorted(void) {
    static spt_krs krs;
    for (int i = 0; i < 60; ++i) {
        spt_distorted memory;
        spt_field field;
        const uint32_t kind = SPT_DISTORTION_TWIST + (uint32_t)(i / 12);
        const spt_distortion distortion = draw_distortion(kind);
        world_krs(2, WORLD_SPHERE | WORLD_CAPSULE | WORLD_FIELD, &krs);
        spt_field inner = i & 1 ? *world_field(i / 2 % WORLD_FIELDS) : spt_krs_field(&krs);
        const spt_bound ball = spt_bound_sphere(0, 0, 0, 2);
        inner.bound = &ball;
        check_context("kind %u, field %d", (unsigned)kind, i);
        const spt_status status = spt_distorted_field(&inner, &distortion, &memory, &field);
        CHECK_SAY(status == SPT_OK, "status %d", (int)status);
        if (status != SPT_OK) continue;
        float axis[5][3] = {{0, 0, 0}, {0, 0.25f, 0}, {0, -0.5f, 0}, {0, 2.5f, 0}, {0, -3, 0}};
        const int different =
            world_differences_at(&field, targets[i % target_count], 0, axis, 5, said);
        CHECK_SAY(different == 0, "%d of %d points differ; %s", different, WORLD_POINTS, said);
    }
}

/* What a map leads nowhere has no distance. */
static void M7_maps_with_nan(void) {
    static world_trace trace;
    static spt_hit expected[WORLD_RAYS];
    static spt_krs krs;
    const spt_settings settings = spt_settings_default();
    spt_distortion distortion = draw_distortion(SPT_DISTORTION_MAP);
    spt_distorted memory;
    spt_field field;
    int lost = 0;
    distortion.unmap = unmap_some;
    distortion.glsl = unmap_some_text;
    world_krs(2, WORLD_SPHERE, &krs); /* in whose folds NaN might be lost */
    const spt_field inner = spt_krs_field(&krs);
    CHECK(spt_distorted_field(&inner, &distortion, &memory, &field) == SPT_OK);
    trace.field = &field;
    trace.settings = &settings;
    trace.features = SPT_GLSL_GUARDS;
    world_rays(&field, trace.rays, trace.paths);
    const spt_rays rays = spt_rays_of(trace.rays);
    const spt_hits hits = spt_hits_of(expected);
    CHECK(spt_trace(&field, &settings, WORLD_RAYS, &rays, &hits, NULL) == SPT_OK);
    CHECK_SAY(world_run(&trace, said), "%s", said);
    const int wrong = world_wrong_hits(&trace, expected, said);
    CHECK_SAY(wrong == 0, "%d rays; %s", wrong, said);
    for (int i = 0; i < WORLD_RAYS; ++i) lost += expected[i].outcome == SPT_NONFINITE;
    CHECK_SAY(lost > WORLD_RAYS / 32, "%d rays meet NaN", lost);
}

/* A distorted sequence under a map, and its level set. */
static void M8_level_sets(void) {
    static spt_krs krs;
    for (int i = 0; i < 10; ++i) {
        spt_settings settings = spt_settings_default();
        spt_distorted distorted;
        spt_conformal conformal;
        spt_level_set set;
        spt_field inner, mapped, field;
        const float eye[3] = {(float)check_uniform(-5, 5), 1, i % 2 ? 0.0f : -4.0f};
        const spt_distortion distortion = draw_distortion(SPT_DISTORTION_TWIST + (uint32_t)(i % 5));
        const spt_mobius map = world_map();
        world_krs(2, WORLD_SPHERE | WORLD_LEAF | WORLD_FIELD, &krs);
        spt_field sequence = spt_krs_field(&krs);
        const spt_bound ball = spt_bound_sphere(0, 0, 0, 2);
        sequence.bound = &ball;
        settings.pixel_radius = 1e-3f;
        check_context("set %d", i);
        CHECK(spt_distorted_field(&sequence, &distortion, &distorted, &inner) == SPT_OK);
        CHECK(spt_conformal_field(&inner, &map, &conformal, &mapped) == SPT_OK);
        CHECK(spt_level_set_field(i & 1 ? &mapped : &inner, eye, (float)check_uniform(0, 2), 0.75f,
                                  &settings, &set, &field) == SPT_OK);
        check_field(&field, targets[i / 2], 0);
    }
}

void suite_mobius_glsl(void) {
    RUN(M1_moekrs_distances);
    RUN(M2_probes);
    RUN(M3_long_scales);
    RUN(M4_conformal);
    RUN(M5_nothing);
    RUN(M6_distorted);
    RUN(M7_maps_with_nan);
    RUN(M8_level_sets);
    RUN(M9_vulkan);
}
