/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences as GLSL: the same bits as their callbacks, unrolled and as a loop
 * over arrays, on every target; and the kernels at hits. */
#include "glsl_check.h"
#include "krs_glsl_world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char said[512];

/* Those that have `precise`, or an invariant output. */
static const uint32_t targets[] = {SPT_GLSL_COMPUTE_450, SPT_GLSL_FRAGMENT_330,
                                   SPT_GLSL_COMPUTE_310_ES, SPT_GLSL_FRAGMENT_300_ES,
                                   SPT_GLSL_COMPUTE_430};
enum { target_count = sizeof targets / sizeof targets[0] };

static void check_field(const spt_field *field, uint32_t target, uint32_t features) {
    const int different = world_differences(field, target, features, said);
    CHECK_SAY(different == 0, "%d of %d points differ; %s", different, WORLD_POINTS, said);
}

static void check_krs(uint32_t levels, uint32_t kinds, uint32_t target, uint32_t features) {
    static spt_krs krs;
    world_krs(levels, kinds, &krs);
    const spt_field field = spt_krs_field(&krs);
    check_context("%u levels, kinds %x, target %u, features %x", (unsigned)levels, (unsigned)kinds,
                  (unsigned)target, (unsigned)features);
    check_field(&field, target, features);
}

static const uint32_t lengths[] = {0, 1, 5, 28, 64};
enum { length_count = sizeof lengths / sizeof lengths[0] };

/* Every length with every kind, unrolled and in arrays; targets in turn. */
static void K1_distances(void) {
    static const uint32_t kinds[] = {WORLD_EMPTY,   WORLD_SPHERE, WORLD_HALF_SPACE,
                                     WORLD_CAPSULE, WORLD_LEAF,   WORLD_OWN};
    int turn = 0;
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; ++kind) {
        for (int i = 0; i < length_count; ++i) {
            check_krs(lengths[i], kinds[kind], targets[turn % target_count], 0);
            ++turn;
            check_krs(lengths[i], kinds[kind], targets[turn % target_count], SPT_GLSL_ARRAYS);
        }
    }
}

/* Callers' fields, whose prelude stands once, divided by their Lipschitz constants. */
static void K2_fields(void) {
    for (int i = 0; i < 16; ++i) {
        const uint32_t kinds = i % 2 ? WORLD_ANY : WORLD_FIELD;
        check_krs(lengths[i / 4], kinds, targets[i % target_count], i & 2 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* Arcs of radii that are nothing beside the way to them. */
static void K6_tight_arcs(void) {
    static spt_krs krs;
    for (int i = 0; i < 8; ++i) {
        const float size = exp2f((float)check_uniform(-20, -6));
        const float a[3] = {-size, 0, 0}, b[3] = {size, 0, 0}, middle[3] = {0, size, 0.5f * size};
        const spt_kernel kernel = i % 2 ? spt_kernel_capsule(a, b, middle, 0.25f * size)
                                        : spt_kernel_leaf(a, b, middle, 0.5f * size, 0);
        spt_krs_model model = spt_krs_model_default();
        model.kernels = &kernel;
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        const spt_field field = spt_krs_field(&krs);
        check_context("arc of %g", (double)size);
        check_field(&field, targets[i % target_count], 0);
    }
}

/* Another compiler, and another engine. */
static void K8_vulkan(void) {
    if (!engine_here(engine_vulkan_open(), "no Vulkan, or no compiler for it")) return;
    for (int i = 0; i < 4; ++i) {
        check_krs(lengths[i / 2 + 1], WORLD_ANY, SPT_GLSL_VULKAN_450, i % 2 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* A model as the kernel of another. */
static void K3_nested(void) {
    static spt_krs inner, outer;
    spt_kernel kernels[4];
    spt_mirror mirrors[3];
    spt_krs_model model = spt_krs_model_default();
    world_krs(5, WORLD_ANY, &inner);
    const spt_field field = spt_krs_field(&inner);
    for (int i = 0; i < 4; ++i) {
        kernels[i] = i % 2 ? spt_kernel_field(&field) : world_kernel(WORLD_ANY);
    }
    for (int i = 0; i < 3; ++i) {
        const spt_mirror mirror = {{0.6f, i == 1 ? 0.8f : 0.0f, i == 1 ? 0.0f : 0.8f}, 0.5f};
        mirrors[i] = mirror;
    }
    model.levels = 3;
    model.kernels = kernels;
    model.mirrors = mirrors;
    CHECK(spt_krs_build(&model, &outer) == SPT_OK);
    const spt_field whole = spt_krs_field(&outer);
    for (int i = 0; i < target_count; ++i) {
        check_context("target %u", (unsigned)targets[i]);
        check_field(&whole, targets[i], i % 2 ? SPT_GLSL_ARRAYS : 0);
    }
}

/* ---- Rays ------------------------------------------------------------------------------------ */

/* A settled world: rays about a field. */
static world_trace *begin_trace(const spt_field *field, const spt_settings *settings,
                                uint32_t features) {
    static world_trace trace;
    trace.field = field;
    trace.settings = settings;
    trace.features = features;
    world_rays(field, trace.rays, trace.paths);
    return &trace;
}

/* What is no number goes through where that is asked for, from a kernel of any level. */
static void K4_guards(void) {
    static spt_krs krs;
    static spt_hit expected[WORLD_RAYS];
    const spt_settings settings = spt_settings_default();
    const spt_kernel ball = spt_kernel_sphere(0, 0, 0, 0.25f);
    for (int i = 0; i < 6; ++i) {
        const spt_kernel bad = spt_kernel_field(world_field_with_nan());
        const spt_kernel kernels[3] = {i / 2 == 0 ? bad : ball, i / 2 == 1 ? bad : ball,
                                       i / 2 == 2 ? bad : ball};
        const spt_mirror mirrors[2] = {{{0, 0.6f, 0.8f}, 0.5f}, {{0.8f, 0, 0.6f}, 0.75f}};
        spt_krs_model model = spt_krs_model_default();
        int lost = 0;
        model.levels = 2;
        model.kernels = kernels;
        model.mirrors = mirrors;
        CHECK(spt_krs_build(&model, &krs) == SPT_OK);
        const spt_field field = spt_krs_field(&krs);
        world_trace *const trace =
            begin_trace(&field, &settings, SPT_GLSL_GUARDS | (i % 2 ? SPT_GLSL_ARRAYS : 0));
        const spt_rays rays = spt_rays_of(trace->rays);
        const spt_hits hits = spt_hits_of(expected);
        check_context("NaN in kernel %d, features %x", i / 2, (unsigned)trace->features);
        CHECK(spt_trace(&field, &settings, WORLD_RAYS, &rays, &hits, NULL) == SPT_OK);
        CHECK_SAY(world_run(trace, said), "%s", said);
        const int wrong = world_wrong_hits(trace, expected, said);
        CHECK_SAY(wrong == 0, "%d rays; %s", wrong, said);
        for (int k = 0; k < WORLD_RAYS; ++k) lost += expected[k].outcome == SPT_NONFINITE;
        CHECK_SAY(lost > WORLD_RAYS / 32, "%d rays meet NaN", lost);
    }
}

/* The kernel that the library finds at a hit of the shader. */
static int32_t locate(const void *model, int has_maps, const spt_ray *ray, float t) {
    const spt_settings settings = spt_settings_default();
    const spt_rays view = spt_rays_of(ray);
    spt_hit hit = {t, 0, SPT_HIT, 1, 0, 0, 0, 0, 0};
    const spt_hits hits = spt_hits_of(&hit);
    int32_t kernel = -2;
    spt_krs_places places;
    memset(&places, 0, sizeof places);
    places.kernel.first = &kernel;
    places.kernel.stride = sizeof kernel;
    CHECK((has_maps ? spt_moekrs_locate(model, 0, &settings, 1, &view, &hits, &places)
                    : spt_krs_locate(model, 0, &settings, 1, &view, &hits, &places)) == SPT_OK);
    return kernel;
}

/* Returns how many hits there were. */
static int check_kernels(const spt_field *field, const void *model, int has_maps,
                         uint32_t features) {
    const spt_settings settings = spt_settings_default();
    const world_trace *const trace = begin_trace(field, &settings, SPT_GLSL_PLACE | features);
    int hits = 0;
    CHECK_SAY(world_run((world_trace *)trace, said), "%s", said);
    for (int i = 0; i < WORLD_RAYS; ++i) {
        const spt_hit *const hit = &trace->hits[i];
        const int is_hit = hit->outcome == SPT_HIT;
        const int32_t expected = is_hit ? locate(model, has_maps, &trace->rays[i], hit->t) : -1;
        CHECK_SAY(hit->component == expected, "ray %d, t %.9g: %d for %d", i, (double)hit->t,
                  (int)hit->component, (int)expected);
        hits += is_hit;
    }
    return hits;
}

/* By sphere tracing and by probes, where the functions of kernels that are fields are not there
 * already. */
static void K5_kernels_at_hits(void) {
    static spt_krs krs;
    static spt_moekrs moekrs;
    int hits = 0;
    for (int i = 0; i < 16; ++i) {
        const uint32_t features = (i & 1 ? SPT_GLSL_ARRAYS : 0u) | (i & 8 ? SPT_GLSL_BINARY : 0u);
        const uint32_t kinds = i & 2 ? WORLD_ANY & ~(uint32_t)WORLD_HALF_SPACE : WORLD_SPHERE;
        check_context("model %d", i);
        if (i & 4) {
            world_moekrs(3, kinds, 0, &moekrs);
            const spt_field field = spt_moekrs_field(&moekrs);
            hits += check_kernels(&field, &moekrs, 1, features);
        } else {
            world_krs(4, kinds, &krs);
            const spt_field field = spt_krs_field(&krs);
            hits += check_kernels(&field, &krs, 0, features);
        }
    }
    CHECK_SAY(hits > WORLD_RAYS, "%d hits", hits);
}

/* Anywhere, also where nothing is near. */
static void check_places(const spt_field *field, const void *model, int has_maps) {
    enum { count = 256 };
    static float points[4 * count], out[count];
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    spt_status status;
    options.field = field;
    options.settings = &settings;
    options.features = SPT_GLSL_PLACE;
    char *const text = world_emit(&options, &status);
    CHECK_SAY(text != NULL, "status %d", (int)status);
    if (text == NULL) return;
    for (int i = 0; i < 4 * count; ++i) points[i] = (float)check_uniform(-2, 2);
    CHECK(engine_points(text, "float(spt_kernel_at(q.xyz))", count, points, out) == ENGINE_OK);
    free(text);
    for (int i = 0; i < count; ++i) {
        const spt_ray ray = {
            {points[4 * i], points[4 * i + 1], points[4 * i + 2]}, 0, {1, 0, 0}, 1};
        const int32_t expected = locate(model, has_maps, &ray, 0);
        CHECK_SAY(out[i] == (float)expected, "point %d: %g for %d", i, (double)out[i],
                  (int)expected);
    }
}

static void K7_kernels_anywhere(void) {
    static spt_krs krs;
    static spt_moekrs moekrs;
    spt_krs_model model = spt_krs_model_default();
    const spt_kernel kernels[2] = {spt_kernel_field(world_field_of_nothing(1)), spt_kernel_empty()};
    const spt_mirror mirror = {{1, 0, 0}, 0};
    for (int i = 0; i < 4; ++i) {
        check_context("models %d", i);
        world_krs(6, i & 1 ? WORLD_ANY : WORLD_EMPTY, &krs);
        const spt_field field = spt_krs_field(&krs);
        check_places(&field, &krs, 0);
        world_moekrs(4, i & 1 ? WORLD_ANY : WORLD_SPHERE, (uint64_t)i, &moekrs);
        const spt_field mapped = spt_moekrs_field(&moekrs);
        check_places(&mapped, &moekrs, 1);
    }
    check_context("infinitely far");
    model.levels = 1;
    model.kernels = kernels;
    model.mirrors = &mirror;
    CHECK(spt_krs_build(&model, &krs) == SPT_OK);
    const spt_field field = spt_krs_field(&krs);
    check_places(&field, &krs, 0);
}

void suite_krs_glsl(void) {
    RUN(K1_distances);
    RUN(K2_fields);
    RUN(K3_nested);
    RUN(K4_guards);
    RUN(K5_kernels_at_hits);
    RUN(K6_tight_arcs);
    RUN(K7_kernels_anywhere);
    RUN(K8_vulkan);
}
