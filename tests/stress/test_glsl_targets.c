/* SPDX-License-Identifier: MIT
 *
 * What glsl.h says of each target and feature, word for word: versions, layouts, which parameters
 * are uniforms, and what each feature brings; without it no word of it is left. */
#include "check.h"
#include "test_glsl_world.h"

#include <stdio.h>
#include <string.h>

static glsl_world world;
static glsl_text text;

static int has_word(const char *word) {
    return glsl_text_find(&text, word) >= 0;
}

static int has(const char *part) {
    return strstr(world.text, part) != NULL;
}

/* Push constants are in the order of the names; every uniform has the type that is documented. */
static void H6m_uniforms_in_their_order(void) {
    static const char *const types[SPT_GLSL_NAMES] = {
        "ivec2", "int",  "float", "float", "float",     "float",     "float",     "float",
        "vec3",  "vec3", "vec3",  "vec3",  "vec4",      "vec2",      "vec3",      "float",
        "float", "vec2", "float", "int",   "sampler2D", "sampler2D", "sampler2D", "sampler2D"};
    for (uint32_t target = SPT_GLSL_FRAGMENT_330; target < SPT_GLSL_TARGETS; ++target) {
        int found = 0;
        if (target == SPT_GLSL_SHADERTOY) continue;
        glsl_world_make(&world, GLSL_BODY);
        world.settings.method = spt_adaptive();
        world.settings.pixel_radius = 1e-3f;
        world.options.target = target;
        world.options.program = SPT_GLSL_HITS;
        if (target < SPT_GLSL_COMPUTE_310_ES) {
            world.options.program = SPT_GLSL_PICTURE;
            world.options.features = SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION | SPT_GLSL_DEPTH_WRITE;
        }
        world.options.uniforms = (1u << SPT_GLSL_NAMES) - 1;
        check_context("target %u", (unsigned)target);
        if (!glsl_world_audit(&world, &text)) continue;
        const char *last = world.text;
        for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
            char declaration[64];
            const char *const name = spt_glsl_default_name(i);
            if (glsl_text_find(&text, name) < 0) continue;
            snprintf(declaration, sizeof declaration, "%s %s;", types[i], name);
            const char *const at = strstr(world.text, declaration);
            CHECK_SAY(at != NULL, "%s", declaration);
            if (at == NULL) continue;
            if (target == SPT_GLSL_VULKAN_450) CHECK_SAY(at > last, "%s", name);
            last = at;
            ++found;
        }
        CHECK(found >= 3);
        if (target == SPT_GLSL_VULKAN_450) CHECK(strstr(world.text, "push_constant") != NULL);
    }
}

/* ---- Targets --------------------------------------------------------------------------------- */

static void H6o_what_targets_begin_with(void) {
    static const char *const versions[SPT_GLSL_TARGETS] = {
        NULL,           "#version 330", "#version 300 es", NULL, "#version 310 es",
        "#version 430", "#version 450", "#version 450"};
    for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
        const int es = target == SPT_GLSL_FRAGMENT_300_ES || target == SPT_GLSL_COMPUTE_310_ES;
        const int compute = target >= SPT_GLSL_COMPUTE_310_ES;
        glsl_world_make(&world, GLSL_BALL);
        world.options.target = target;
        if (target == SPT_GLSL_SHADERTOY) world.options.program = SPT_GLSL_PICTURE;
        check_context("target %u", (unsigned)target);
        if (!glsl_world_audit(&world, &text)) continue;
        if (versions[target] == NULL) {
            CHECK(!has("#version"));
        } else {
            /* nothing may stand before the version but comments, and some hosts want it first */
            CHECK(strncmp(world.text, versions[target], strlen(versions[target])) == 0);
        }
        CHECK(has("precision highp float;") == es && has("precision highp int;") == es);
        CHECK(has_word("GL_EXT_gpu_shader5") == (target == SPT_GLSL_COMPUTE_310_ES));
        CHECK(has_word("local_size_x") == compute && has_word("std430") == compute);
        CHECK(has_word("gl_GlobalInvocationID") == compute);
        CHECK(has_word("push_constant") == (target == SPT_GLSL_VULKAN_450));
        CHECK(has_word("main") == (versions[target] != NULL));
        CHECK(has_word("mainImage") == (target == SPT_GLSL_SHADERTOY));
        CHECK(has_word("iResolution") == (target == SPT_GLSL_SHADERTOY));
        /* equal bits: `precise` where the target has it, an invariant output where not */
        CHECK(has_word("precise") == (compute || target == SPT_GLSL_LIBRARY));
        CHECK(has_word("invariant") ==
              (target == SPT_GLSL_FRAGMENT_330 || target == SPT_GLSL_FRAGMENT_300_ES));
        if (!compute) continue;
        CHECK(has("local_size_x = 8, local_size_y = 8"));
        CHECK(has("binding = 0") && has("binding = 1") && !has("binding = 2"));
        CHECK(has("set = 0") == (target == SPT_GLSL_VULKAN_450));
    }
}

/* Without a bit only those marked * are uniforms; with a bit that parameter may be one as well, and
 * is, where the program has use for it. */
static void H6p_which_parameters_are_uniforms(void) {
    static const uint32_t always =
        1u << SPT_GLSL_NAME_SIZE | 1u << SPT_GLSL_NAME_BUDGET | 15u << SPT_GLSL_NAME_RAY_ORIGIN;
    static const uint32_t used = 1u << SPT_GLSL_NAME_EPSILON | 1u << SPT_GLSL_NAME_PIXEL_RADIUS |
                                 1u << SPT_GLSL_NAME_RELAXATION | 63u << SPT_GLSL_NAME_EYE |
                                 7u << SPT_GLSL_NAME_LIGHT | 1u << SPT_GLSL_NAME_DEPTH |
                                 1u << SPT_GLSL_NAME_VIEW;
    for (uint32_t bit = 0; bit <= SPT_GLSL_NAMES; ++bit) {
        const uint32_t asked = bit < SPT_GLSL_NAMES ? 1u << bit : 0;
        glsl_world_make(&world, GLSL_BODY);
        world.settings.method = spt_relaxed();
        world.settings.pixel_radius = 1e-3f;
        world.options.target = SPT_GLSL_FRAGMENT_330;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION | SPT_GLSL_DEPTH_WRITE;
        world.options.uniforms = asked;
        check_context("bit %u", (unsigned)bit);
        if (!glsl_world_audit(&world, &text)) continue;
        for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
            const char *const name = spt_glsl_default_name(i);
            const int is_uniform = (glsl_text_what(&text, name) & GLSL_IS_UNIFORM) != 0;
            if (is_uniform) CHECK_SAY(((always | asked) >> i & 1) != 0, "%s", name);
            if ((asked & used) >> i & 1) CHECK_SAY(is_uniform, "%s is none", name);
        }
        CHECK(has_word("spt_size") && has_word("spt_budget"));
    }
    /* HITS of a fragment program reads textures, and starts where they are asked for */
    glsl_world_make(&world, GLSL_BALL);
    world.options.target = SPT_GLSL_FRAGMENT_330;
    for (int i = 0; i < 4; ++i) {
        world.options.features = (i & 1 ? SPT_GLSL_PATH : 0) | (i & 2 ? SPT_GLSL_STARTS : 0);
        check_context("hits with features 0x%x", (unsigned)world.options.features);
        if (!glsl_world_audit(&world, &text)) continue;
        CHECK(has_word("spt_ray_origin") && has_word("spt_ray_direction"));
        CHECK(has_word("spt_ray_path") == (i & 1) && has_word("spt_starts") == i >> 1);
    }
}

/* ---- Features -------------------------------------------------------------------------------- */

typedef struct brings {
    uint32_t feature;
    glsl_subject subject;
    uint32_t program; /* of a fragment shader; SPT_GLSL_PROGRAMS: a library */
    const char *word;
} brings;

static const brings words[] = {
    {SPT_GLSL_FLAGS, GLSL_BALL, SPT_GLSL_HITS, "flags"},
    {SPT_GLSL_CANDIDATE, GLSL_BALL, SPT_GLSL_HITS, "candidate_t"},
    {SPT_GLSL_CANDIDATE, GLSL_SHAPES, SPT_GLSL_PROGRAMS, "candidate_ratio"},
    {SPT_GLSL_FALLBACKS, GLSL_BALL, SPT_GLSL_HITS, "fallbacks"},
    {SPT_GLSL_COMPONENT, GLSL_SCENE, SPT_GLSL_PROGRAMS, "spt_material"},
    {SPT_GLSL_PATH, GLSL_BALL, SPT_GLSL_HITS, "path"},
    {SPT_GLSL_PATH, GLSL_BODY, SPT_GLSL_PROGRAMS, "path"},
    {SPT_GLSL_NORMAL, GLSL_BALL, SPT_GLSL_HITS, "spt_hit_normal"},
    {SPT_GLSL_REFINE, GLSL_BALL, SPT_GLSL_HITS, "spt_refine"},
    {SPT_GLSL_REFINE, GLSL_SCENE, SPT_GLSL_PICTURE, "spt_refine"},
    {SPT_GLSL_OFFSET, GLSL_BALL, SPT_GLSL_PROGRAMS, "spt_offset"},
    {SPT_GLSL_SHADOW, GLSL_BALL, SPT_GLSL_PROGRAMS, "spt_soft_shadow"},
    {SPT_GLSL_SHADOW, GLSL_SCENE, SPT_GLSL_PICTURE, "spt_soft_shadow"},
    {SPT_GLSL_SHADOW, GLSL_BODY, SPT_GLSL_PICTURE, "spt_offset"},
    {SPT_GLSL_OCCLUSION, GLSL_BALL, SPT_GLSL_PICTURE, "spt_ambient_occlusion"},
    {SPT_GLSL_CONVEX, GLSL_BODY, SPT_GLSL_HITS, "spt_trace_convex"},
    {SPT_GLSL_BINARY, GLSL_BODY, SPT_GLSL_HITS, "spt_binary_trace"},
    {SPT_GLSL_STARTS, GLSL_BODY, SPT_GLSL_PICTURE, "spt_starts"},
    {SPT_GLSL_DEPTH_WRITE, GLSL_BODY, SPT_GLSL_PICTURE, "gl_FragDepth"},
    {SPT_GLSL_DEPTH_WRITE, GLSL_BODY, SPT_GLSL_PICTURE, "discard"},
    {SPT_GLSL_PLACE, GLSL_KRS_64, SPT_GLSL_HITS, "spt_kernel_at"},
    {SPT_GLSL_PLACE, GLSL_MOEKRS, SPT_GLSL_PROGRAMS, "spt_kernel_at"}};

static void H6q_features_bring_their_words(void) {
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        const brings *const one = &words[i];
        glsl_world_make(&world, one->subject);
        if (one->program < SPT_GLSL_PROGRAMS) {
            world.options.target = SPT_GLSL_FRAGMENT_330;
            world.options.program = one->program;
        }
        check_context("%s without %s", glsl_subject_names[one->subject], one->word);
        if (glsl_world_audit(&world, &text)) CHECK(!has_word(one->word));
        world.options.features = one->feature;
        check_context("%s with %s", glsl_subject_names[one->subject], one->word);
        if (glsl_world_audit(&world, &text)) CHECK(has_word(one->word));
    }
}

/* Numbers of iterations and samples stand in the text; 0 rounds are legal. */
static void H6r_counts_stand_in_the_text(void) {
    for (uint32_t i = 0; i <= 16; i += 8) {
        static char first[glsl_room];
        glsl_world_make(&world, GLSL_BALL);
        world.options.target = SPT_GLSL_FRAGMENT_330;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_REFINE | SPT_GLSL_OCCLUSION;
        world.options.iterations = i;
        world.options.samples = 3;
        check_context("%u iterations", (unsigned)i);
        CHECK(glsl_world_audit(&world, &text));
        memcpy(first, world.text, world.length + 1);
        world.options.iterations = i == 16 ? 15 : i + 1;
        CHECK(glsl_world_emit(&world) == SPT_OK && strcmp(first, world.text) != 0);
        world.options.iterations = i;
        world.options.samples = 4;
        CHECK(glsl_world_emit(&world) == SPT_OK && strcmp(first, world.text) != 0);
    }
}

/* Materials of a scene are what spt_material() gives; each stands in the text. */
static void H6s_materials(void) {
    glsl_world_make(&world, GLSL_SCENE);
    world.options.features = SPT_GLSL_COMPONENT;
    world.materials[2] = INT32_MIN;
    world.materials[3] = INT32_MAX;
    world.materials[4] = -123456;
    check_context("materials");
    CHECK(glsl_world_audit(&world, &text));
    CHECK(has("2147483647") && has("123456"));
    world.scene.materials = NULL;
    check_context("no materials");
    CHECK(glsl_world_audit(&world, &text));
    CHECK(!has_word("spt_material"));
}

/* Where a budget is no uniform it stands in the text, as an int: as much of it as there is. */
static void H6t_budgets_of_any_size(void) {
    static const uint32_t budgets[] = {0, 1, 0x7fffffff, 0x80000000u, 0xffffffffu};
    for (int i = 0; i < 5; ++i) {
        for (uint32_t target = SPT_GLSL_LIBRARY; target <= SPT_GLSL_SHADERTOY; ++target) {
            glsl_world_make(&world, GLSL_BALL);
            world.settings.budget = budgets[i];
            world.options.target = target;
            world.options.program = SPT_GLSL_PICTURE;
            check_context("budget %u, target %u", (unsigned)budgets[i], (unsigned)target);
            glsl_world_audit(&world, &text);
            if (target == SPT_GLSL_SHADERTOY && budgets[i] > 1) CHECK(has("2147483647"));
        }
    }
}

void suite_glsl_targets(void) {
    RUN(H6m_uniforms_in_their_order);
    RUN(H6o_what_targets_begin_with);
    RUN(H6p_which_parameters_are_uniforms);
    RUN(H6q_features_bring_their_words);
    RUN(H6r_counts_stand_in_the_text);
    RUN(H6s_materials);
    RUN(H6t_budgets_of_any_size);
}
