/* SPDX-License-Identifier: MIT
 *
 * Row H6: what a text holds, for every kind of field, step rule, feature, target and program: only
 * functions that are reached, no recursion, bounded loops, and the same bytes for the same input. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#define HAVE_THREADS
#include <pthread.h>
#endif

#include "test_glsl_world.h"

#include "check.h"
#include "rules.h"

#include <stdlib.h>
#include <string.h>

static glsl_world world;
static glsl_text text;

static const uint32_t all_features = (1u << 18) - 1;

/* Each subject with each step rule that may trace it, as library and as a program. */
static void H6f_subjects_and_step_rules(void) {
    for (int subject = 0; subject < glsl_subjects; ++subject) {
        if (!glsl_world_make(&world, (glsl_subject)subject)) continue;
        const uint32_t flags = glsl_world_field(&world)->flags;
        for (int r = 0; r < rule_count; ++r) {
            const int convex = rules[r].method() == spt_convex();
            if (convex && subject == GLSL_SCENE) continue;
            if (!rule_allowed(&rules[r], flags)) continue;
            world.settings.method = rules[r].method();
            world.options.target = r % 2 == 0 ? SPT_GLSL_LIBRARY : SPT_GLSL_COMPUTE_450;
            glsl_world_try(&world, &text);
        }
    }
}

/* Each feature alone, in all targets and programs; of one field, a model and a scene in turn. */
static void H6g_features_targets_programs(void) {
    static const glsl_subject some[] = {GLSL_BODY, GLSL_KRS_1, GLSL_SCENE};
    for (int i = 0; i < 3; ++i) {
        if (!glsl_world_make(&world, some[i])) continue;
        for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
            for (uint32_t program = 0; program < SPT_GLSL_PROGRAMS; ++program) {
                if (target == SPT_GLSL_LIBRARY && program > 0) continue;
                for (uint32_t feature = 0; feature <= 18; ++feature) {
                    if ((target + program + feature) % 3 != (uint32_t)i) continue;
                    world.options.target = target;
                    world.options.program = program;
                    world.options.features = feature < 18 ? 1u << feature : 0;
                    world.settings.method =
                        rules[(feature + target + program) % (uint32_t)rule_count].method();
                    if (world.settings.method == spt_convex()) {
                        world.settings.method = spt_adaptive();
                    }
                    glsl_world_try(&world, &text);
                }
            }
        }
    }
}

/* All that go together, with each step rule and each of settings.flags. */
static void H6h_all_features_together(void) {
    static const uint32_t together = SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE |
                                     SPT_GLSL_FALLBACKS | SPT_GLSL_COMPONENT | SPT_GLSL_PATH |
                                     SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_ARRAYS;
    static const uint32_t pictures = SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_SHADOW |
                                     SPT_GLSL_OCCLUSION | SPT_GLSL_DEPTH_WRITE;
    static const uint32_t flags[] = {0, SPT_SKIP_START, SPT_STOP_INSIDE, SPT_CANDIDATE_PENUMBRA,
                                     SPT_CANDIDATE_CLOSEST | SPT_SKIP_START};
    static const glsl_subject some[] = {GLSL_SCENE, GLSL_KRS_64, GLSL_CONVEX_SCENE};
    for (int i = 0; i < 3; ++i) {
        if (!glsl_world_make(&world, some[i])) continue;
        world.settings.pixel_radius = i == 0 ? 1e-3f : 0.0f;
        for (int r = 0; r < rule_count; ++r) {
            if (rules[r].method() == spt_convex() && i != 2) continue;
            world.settings.method = rules[r].method();
            for (int k = 0; k < 5; ++k) {
                if ((k + r + i) % 3 != 0 || (i == 1 && k < 3)) continue;
                world.settings.flags = flags[k];
                world.options.target = k % 2 == 0 ? SPT_GLSL_LIBRARY : SPT_GLSL_FRAGMENT_330;
                world.options.program = SPT_GLSL_HITS;
                world.options.features = together;
                glsl_world_try(&world, &text);
            }
            world.settings.flags = 0;
            world.options.program = SPT_GLSL_PICTURE;
            world.options.target = SPT_GLSL_FRAGMENT_300_ES;
            world.options.features = pictures;
            glsl_world_try(&world, &text);
        }
    }
}

/* Any set of features at all: written and sound, or refused with nothing written. */
static void H6i_any_features(void) {
    for (int i = 0; i < 130; ++i) {
        const glsl_subject subject = (glsl_subject)(check_random() % glsl_subjects);
        if (subject == GLSL_KRS_64 || !glsl_world_make(&world, subject)) continue;
        const uint32_t sparse = check_random() & check_random();
        world.options.features = sparse & (i % 2 == 0 ? check_random() : ~0u) & all_features;
        world.options.target = check_random() % SPT_GLSL_TARGETS;
        world.options.program = check_random() % SPT_GLSL_PROGRAMS;
        world.options.uniforms = check_random() & 0xffffffu;
        world.settings.flags = check_random() % 3 == 0 ? 1u << check_random() % 4 : 0;
        world.settings.method = rules[check_random() % (uint32_t)rule_count].method();
        if (world.settings.method == spt_convex()) world.settings.method = spt_relaxed();
        glsl_world_try(&world, &text);
    }
}

/* A function taken away leaves its name behind, which then no one declares: the rest would not
 * compile. Of overloaded functions one that is left may do. */
static void H6j_no_function_can_be_deleted(void) {
    static const glsl_subject some[] = {GLSL_SHAPES, GLSL_NESTED, GLSL_SCENE_1};
    static char rest[glsl_room];
    static glsl_text without;
    for (int i = 0; i < 3; ++i) {
        if (!glsl_world_make(&world, some[i])) continue;
        world.options.target = SPT_GLSL_FRAGMENT_330;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_SHADOW;
        if (!glsl_world_audit(&world, &text)) continue;
        CHECK(text.function_count > 5);
        for (int32_t f = 0; f < text.function_count; ++f) {
            const glsl_function *const function = &text.functions[f];
            const glsl_name *const name = &text.names[function->name];
            const char *const begin = text.tokens[function->begin].first;
            const char *const end = text.tokens[function->to].first;
            int others = 0;
            for (int32_t k = 0; k < text.function_count; ++k) {
                others += k != f && text.functions[k].name == function->name;
            }
            if (others > 0 || (name->what & GLSL_IS_CALLERS) != 0) continue;
            const size_t before = (size_t)(begin - text.source);
            memcpy(rest, text.source, before);
            strcpy(rest + before, end);
            CHECK(glsl_text_read(&without, rest) || without.fault[0] != 0);
            CHECK_SAY(!glsl_text_parse(&without), "without %.*s", (int)name->size, name->first);
        }
    }
}

/* Features that are off leave nothing behind: a text grows with each, and none is longer than that
 * of a feature more. */
static void H6k_features_cost_text_only_where_asked_for(void) {
    static const glsl_subject some[] = {GLSL_BODY, GLSL_KRS_1, GLSL_MOEKRS, GLSL_SCENE_1};
    for (int i = 0; i < 4; ++i) {
        const glsl_subject subject = some[i];
        if (!glsl_world_make(&world, subject)) continue;
        CHECK(glsl_world_emit(&world) == SPT_OK);
        const size_t plain = world.length;
        for (uint32_t feature = 0; feature < 15; ++feature) {
            world.options.features = 1u << feature;
            if (glsl_world_verdict(&world) <= 0) continue;
            const spt_status status = glsl_world_emit(&world);
            check_context("%s, feature %u", glsl_subject_names[subject], (unsigned)feature);
            CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
            const uint32_t shorter = SPT_GLSL_CONVEX | SPT_GLSL_BINARY | SPT_GLSL_FALLBACKS;
            if ((world.options.features & shorter) == 0)
                CHECK_SAY(world.length > plain, "%u and %u bytes", (unsigned)world.length,
                          (unsigned)plain);
        }
    }
}

/* ---- The same bytes -------------------------------------------------------------------------- */

static void H6l_same_input_same_bytes(void) {
    static char first[glsl_room];
    for (int subject = 0; subject < glsl_subjects; ++subject) {
        static glsl_world other;
        if (!glsl_world_make(&world, (glsl_subject)subject)) continue;
        world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_GUARDS;
        if (glsl_world_emit(&world) != SPT_OK) continue;
        const size_t length = world.length;
        memcpy(first, world.text, length + 1);
        CHECK(glsl_world_emit(&world) == SPT_OK && world.length == length);
        CHECK(memcmp(first, world.text, length + 1) == 0);
        /* at other addresses */
        CHECK(glsl_world_make(&other, (glsl_subject)subject));
        other.options.features = world.options.features;
        CHECK(glsl_world_emit(&other) == SPT_OK && other.length == length);
        CHECK(memcmp(first, other.text, length + 1) == 0);
    }
}

#ifdef HAVE_THREADS
enum { rounds = 3 };

typedef struct worker {
    char text[rounds][1 << 17];
    size_t length[rounds];
    spt_status status[rounds];
} worker;

static glsl_world shared[rounds];

static void *work(void *argument) {
    worker *const own = argument;
    for (int i = 0; i < rounds; ++i) {
        own->status[i] =
            spt_glsl_emit(&shared[i].options, own->text[i], sizeof own->text[i], &own->length[i]);
    }
    return NULL;
}
#endif

static void G11ga_threads_emit_the_same(void) {
#ifdef HAVE_THREADS
    enum { threads = 2 };
    static const glsl_subject some[rounds] = {GLSL_SCENE, GLSL_MOEKRS, GLSL_NESTED};
    static worker workers[threads], alone;
    pthread_t thread[threads];
    for (int i = 0; i < rounds; ++i) {
        CHECK(glsl_world_make(&shared[i], some[i]));
        shared[i].options.features = SPT_GLSL_NORMAL | SPT_GLSL_REFINE;
    }
    for (int i = 0; i < threads; ++i) {
        CHECK(pthread_create(&thread[i], NULL, work, &workers[i]) == 0);
    }
    for (int i = 0; i < threads; ++i) CHECK(pthread_join(thread[i], NULL) == 0);
    work(&alone);
    for (int i = 0; i < threads; ++i) {
        for (int k = 0; k < rounds; ++k) {
            CHECK(workers[i].status[k] == SPT_OK && alone.status[k] == SPT_OK);
            CHECK(workers[i].length[k] == alone.length[k]);
            CHECK(memcmp(workers[i].text[k], alone.text[k], alone.length[k] + 1) == 0);
        }
    }
#else
    check_skip("G11ga: no threads here");
#endif
}

void suite_glsl_shape(void) {
    RUN(H6f_subjects_and_step_rules);
    RUN(H6g_features_targets_programs);
    RUN(H6h_all_features_together);
    RUN(H6i_any_features);
    RUN(H6j_no_function_can_be_deleted);
    RUN(H6k_features_cost_text_only_where_asked_for);
    RUN(H6l_same_input_same_bytes);
    RUN(G11ga_threads_emit_the_same);
}
