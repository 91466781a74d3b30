/* SPDX-License-Identifier: MIT
 *
 * Pinned texts of the emitter: a hash of each, the same for every compiler and architecture. A
 * changed line of golden_glsl_hashes.h is explained in the change that makes it; `build/check
 * golden_glsl` prints the lines that differ. */
#include "check.h"
#include "rules.h"
#include "stress/test_glsl_world.h"

#include <stdio.h>
#include <string.h>

typedef struct golden {
    const char *name;
    uint32_t hash;
} golden;

static const golden pinned[] = {
#define GOLDEN_GLSL(name, hash) {#name, hash},
#include "golden_glsl_hashes.h"
#undef GOLDEN_GLSL
};
enum { pinned_count = sizeof pinned / sizeof pinned[0] };

typedef struct shader {
    const char *name;
    glsl_subject subject;
    uint32_t target, program, features, uniforms;
    const spt_method *(*method)(void);
} shader;

static const shader shaders[] = {
    {"smallest", GLSL_BALL, SPT_GLSL_LIBRARY, SPT_GLSL_HITS, 0, 0, spt_basic},
    {"shapes", GLSL_SHAPES, SPT_GLSL_FRAGMENT_330, SPT_GLSL_PICTURE,
     SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION, 0xffffff, spt_adaptive},
    {"body", GLSL_BODY, SPT_GLSL_COMPUTE_430, SPT_GLSL_HITS, SPT_GLSL_CONVEX, 0, spt_convex},
    {"guarded", GLSL_STEEP, SPT_GLSL_COMPUTE_450, SPT_GLSL_HITS,
     SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_FALLBACKS | SPT_GLSL_PATH, 0,
     spt_auto_relaxed},
    {"model", GLSL_KRS_64, SPT_GLSL_FRAGMENT_300_ES, SPT_GLSL_PICTURE,
     SPT_GLSL_NORMAL | SPT_GLSL_REFINE, 1u << SPT_GLSL_NAME_PIXEL_RADIUS, spt_relaxed},
    {"model_in_arrays", GLSL_KRS_64, SPT_GLSL_VULKAN_450, SPT_GLSL_HITS, SPT_GLSL_ARRAYS, 0,
     spt_relaxed},
    {"model_places", GLSL_KRS_FIELD, SPT_GLSL_LIBRARY, SPT_GLSL_HITS, SPT_GLSL_PLACE, 0,
     spt_enhanced},
    {"mapped", GLSL_MOEKRS, SPT_GLSL_COMPUTE_310_ES, SPT_GLSL_HITS, SPT_GLSL_BINARY, 0, spt_basic},
    {"nested", GLSL_NESTED, SPT_GLSL_SHADERTOY, SPT_GLSL_PICTURE, SPT_GLSL_NORMAL, 0, spt_adaptive},
    {"distances", GLSL_SWAY, SPT_GLSL_FRAGMENT_330, SPT_GLSL_POINTS, 0, 0, spt_basic},
    {"cones", GLSL_TWIST, SPT_GLSL_FRAGMENT_330, SPT_GLSL_CONES, 0, 0, spt_basic},
    {"scene", GLSL_SCENE, SPT_GLSL_VULKAN_450, SPT_GLSL_HITS, SPT_GLSL_COMPONENT | SPT_GLSL_NORMAL,
     0, spt_adaptive},
    {"scene_library", GLSL_SCENE, SPT_GLSL_LIBRARY, SPT_GLSL_HITS,
     SPT_GLSL_COMPONENT | SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_OFFSET | SPT_GLSL_SHADOW |
         SPT_GLSL_OCCLUSION,
     0, spt_enhanced},
    {"merged", GLSL_SCENE, SPT_GLSL_FRAGMENT_300_ES, SPT_GLSL_PICTURE,
     SPT_GLSL_MERGED | SPT_GLSL_DEPTH_WRITE, 0, spt_relaxed}};

static glsl_world world;

static uint32_t hash_of(const char *text, size_t length) {
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < length; ++i) hash = (hash ^ (unsigned char)text[i]) * 16777619u;
    return hash;
}

static void golden_glsl_texts(void) {
    for (size_t i = 0; i < sizeof shaders / sizeof *shaders; ++i) {
        const shader *const one = &shaders[i];
        int same = 0;
        if (!glsl_world_make(&world, one->subject)) continue;
        world.settings.method = one->method();
        world.options.target = one->target;
        world.options.program = one->program;
        world.options.features = one->features;
        world.options.uniforms = one->uniforms;
        check_context("%s", one->name);
        const spt_status status = glsl_world_emit(&world);
        CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
        if (status != SPT_OK) continue;
        const uint32_t hash = hash_of(world.text, world.length);
        for (int k = 0; k < pinned_count && !same; ++k) {
            same = strcmp(pinned[k].name, one->name) == 0 && pinned[k].hash == hash;
        }
        CHECK(same);
        if (!same) printf("GOLDEN_GLSL(%s, 0x%08xu)\n", one->name, (unsigned)hash);
    }
}

void suite_golden_glsl(void) {
    RUN(golden_glsl_texts);
}
