/* SPDX-License-Identifier: MIT
 *
 * The other functions of glsl.h (points to compare a field and its text at, the numbers of depth
 * buffers, names of parameters), the smallest shader, and texts under the locale of the machine. */
#include "check.h"
#include "test_glsl_world.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SSE2__)
#define HAVE_MXCSR
#include <immintrin.h>
#endif

static glsl_world world;
static glsl_text text;

/* ---- spt_glsl_check_field -------------------------------------------------------------------- */

enum { samples = 1000 };
static float points[4 * samples], again[4 * samples];

static float asked(const spt_field *field, const float *at) {
    static float memory[3 * 16 + 16 + 16];
    if (field->batch == NULL) return field->point(field->user, at[0], at[1], at[2]);
    float *const aligned = memory + (64 - (uintptr_t)memory % 64) % 64 / sizeof *memory;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 16; ++i) aligned[16 * axis + i] = at[axis];
    }
    static float distance[32];
    float *const out = distance + (64 - (uintptr_t)distance % 64) % 64 / sizeof *distance;
    field->batch(field->user, 16, aligned, aligned + 16, aligned + 32, out);
    return out[0];
}

/* Values are those of the callback; points are finite, inside of the extent of the bound (or what
 * stands for it), which those moved to the surface leave by rounding at most; half of them are near
 * the surface. */
static void look_at_points(const spt_field *field) {
    float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1}, extent = 2;
    int near_surface = 0, inside = 0;
    if (field->bound != NULL) {
        float from[3], to[3];
        CHECK(spt_bound_extent(field->bound, from, to) == SPT_OK);
        int finite = 1;
        for (int axis = 0; axis < 3; ++axis) {
            finite &= isfinite(from[axis]) && isfinite(to[axis]);
        }
        if (finite) {
            memcpy(low, from, sizeof low);
            memcpy(high, to, sizeof high);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (high[axis] - low[axis] > extent) extent = high[axis] - low[axis];
    }
    for (int i = 0; i < samples; ++i) {
        const float *const at = &points[4 * i];
        int within = 1;
        CHECK(isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]));
        for (int axis = 0; axis < 3; ++axis) {
            within &= at[axis] >= low[axis] && at[axis] <= high[axis];
        }
        inside += within;
        CHECK_SAY(check_same_bits(at[3], asked(field, at)), "point %d: %.9g", i, (double)at[3]);
        near_surface += fabsf(at[3]) < 0.02f * extent * field->lipschitz;
    }
    CHECK_SAY(inside >= samples / 2, "%d of %d inside of the bound", inside, samples);
    if (field->point == NULL || field->bound == NULL) return;
    CHECK_SAY(near_surface >= samples / 3, "%d of %d near the surface", near_surface, samples);
}

static void F12a_points_to_compare_at(void) {
    for (int subject = 0; subject < GLSL_SCENE_1; ++subject) {
        if (!glsl_world_make(&world, (glsl_subject)subject)) continue;
        memset(points, 0xff, sizeof points);
        CHECK(spt_glsl_check_field(&world.field, samples, 1, points) == SPT_OK);
        look_at_points(&world.field);
    }
}

static void F12b_equal_seeds_equal_points(void) {
    glsl_world_make(&world, GLSL_BODY);
    CHECK(spt_glsl_check_field(&world.field, samples, 7, points) == SPT_OK);
    CHECK(spt_glsl_check_field(&world.field, samples, 7, again) == SPT_OK);
    CHECK(memcmp(points, again, sizeof points) == 0);
    CHECK(spt_glsl_check_field(&world.field, samples, 8, again) == SPT_OK);
    int same = 0;
    for (int i = 0; i < samples; ++i) same += memcmp(&points[4 * i], &again[4 * i], 12) == 0;
    CHECK_SAY(same == 0, "%d points of another seed are equal", same);
    /* and they differ from one another */
    for (int i = 1; i < samples; ++i) same += memcmp(&points[4 * i], &points[4 * i - 4], 12) == 0;
    CHECK(same == 0);
}

static void F12c_points_of_one_sample_and_bad_arguments(void) {
    static const uint32_t bad[] = {0, (1u << 20) + 1, 0xffffffffu};
    spt_field other;
    glsl_world_make(&world, GLSL_BODY);
    memset(points, 0xff, sizeof points);
    memset(again, 0xff, sizeof again);
    CHECK(spt_glsl_check_field(NULL, 1, 0, points) == SPT_BAD_ARGUMENT);
    CHECK(spt_glsl_check_field(&world.field, 1, 0, NULL) == SPT_BAD_ARGUMENT);
    for (int i = 0; i < 3; ++i) {
        CHECK(spt_glsl_check_field(&world.field, bad[i], 0, points) == SPT_BAD_ARGUMENT);
    }
    other = world.field;
    other.point = NULL;
    CHECK(spt_glsl_check_field(&other, 1, 0, points) == SPT_BAD_ARGUMENT);
    other = world.field;
    other.lipschitz = NAN;
    CHECK(spt_glsl_check_field(&other, 1, 0, points) == SPT_BAD_ARGUMENT);
    other = world.field;
    other.struct_size = 3;
    CHECK(spt_glsl_check_field(&other, 1, 0, points) == SPT_BAD_ARGUMENT);
    CHECK(memcmp(points, again, sizeof points) == 0);
    CHECK(spt_glsl_check_field(&world.field, 1, 0, points) == SPT_OK);
    CHECK(memcmp(points + 4, again + 4, sizeof points - 16) == 0);
    CHECK(memcmp(points, again, 16) != 0);
}

/* ---- spt_glsl_depth -------------------------------------------------------------------------- */

/* Against spt_frame_depth(), at depths between the planes, for usual, reversed and infinite ones. */
static void F12d_depth_coefficients(void) {
    static const float planes[][2] = {{0.1f, 100.0f},   {100.0f, 0.1f},   {1.0f, 2.0f},
                                      {0.5f, INFINITY}, {INFINITY, 0.5f}, {1e-3f, 1e6f}};
    enum { most = 64 };
    static float t[most], depth[most];
    glsl_world_make(&world, GLSL_SCENE_1);
    spt_frame frame;
    CHECK(spt_frame_init(&frame, &world.scene, &world.camera, 8, 8) == SPT_OK);
    for (size_t i = 0; i < sizeof planes / sizeof *planes; ++i) {
        spt_depth kind = {SPT_DEPTH_DEVICE, planes[i][0], planes[i][1]};
        const spt_depth linear = {SPT_DEPTH_LINEAR, 0, 0};
        const spt_column from = {t, sizeof *t};
        const spt_sink to = {depth, sizeof *depth};
        static float z[most];
        const spt_sink lengths = {z, sizeof *z};
        float low = planes[i][0] < planes[i][1] ? planes[i][0] : planes[i][1];
        float high = planes[i][0] < planes[i][1] ? planes[i][1] : planes[i][0];
        float numbers[2] = {NAN, NAN};
        if (!(high <= 1e6f)) high = 1e6f;
        check_context("planes %.9g and %.9g", (double)planes[i][0], (double)planes[i][1]);
        CHECK(spt_glsl_depth(planes[i][0], planes[i][1], numbers) == SPT_OK);
        for (int k = 0; k < most; ++k) {
            t[k] = low * powf(high / low, ((float)k + 0.5f) / most);
        }
        CHECK(spt_frame_depth(&frame, &linear, &from, &lengths) == SPT_OK);
        CHECK(spt_frame_depth(&frame, &kind, &from, &to) == SPT_OK);
        for (int k = 0; k < most; ++k) {
            /* z, b / z and the sum are rounded once each, b / z is at most 1 + |a| <= 2 (or, where
             * the planes are close, |b| / low), and so is the buffer's number: eight half units */
            const float size = 1.0f + fabsf(numbers[0]) + fabsf(numbers[1]) / low;
            const float expected = numbers[0] + numbers[1] / z[k];
            if (expected < 0.0f || expected > 1.0f) continue; /* buffers clamp */
            CHECK_SAY(fabsf(expected - depth[k]) <= 8 * 0x1p-24f * size, "z %.9g: %.9g and %.9g",
                      (double)z[k], (double)expected, (double)depth[k]);
        }
        /* the ends of the range */
        const float at_near =
            planes[i][0] <= 1e6f ? numbers[0] + numbers[1] / planes[i][0] : numbers[0];
        const float at_far =
            planes[i][1] <= 1e6f ? numbers[0] + numbers[1] / planes[i][1] : numbers[0];
        CHECK_SAY(fabsf(at_near) <= 4e-7f, "%.9g", (double)at_near);
        CHECK_SAY(fabsf(at_far - 1.0f) <= 4e-7f, "%.9g", (double)at_far);
    }
}

static void F12e_depth_of_bad_planes(void) {
    static const float bad[][2] = {{0, 1},         {1, 0},         {-1, 1},   {1, -1},
                                   {1, 1},         {NAN, 1},       {1, NAN},  {INFINITY, INFINITY},
                                   {-INFINITY, 1}, {1, -INFINITY}, {-0.0f, 1}};
    float numbers[2] = {3, 4};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK_SAY(spt_glsl_depth(bad[i][0], bad[i][1], numbers) == SPT_BAD_ARGUMENT,
                  "planes %.9g and %.9g", (double)bad[i][0], (double)bad[i][1]);
    }
    CHECK(spt_glsl_depth(1, 2, NULL) == SPT_BAD_ARGUMENT);
    CHECK(numbers[0] == 3 && numbers[1] == 4);
}

/* ---- Names ----------------------------------------------------------------------------------- */

static void F12f_default_names(void) {
    CHECK(strcmp(spt_glsl_default_name(SPT_GLSL_NAME_SIZE), "spt_size") == 0);
    CHECK(strcmp(spt_glsl_default_name(SPT_GLSL_NAME_BUDGET), "spt_budget") == 0);
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        const char *const name = spt_glsl_default_name(i);
        CHECK(name != NULL && strncmp(name, "spt_", 4) == 0 && strlen(name) <= 64);
        CHECK(strspn(name, "abcdefghijklmnopqrstuvwxyz_") == strlen(name));
        CHECK(strstr(name, "__") == NULL);
        for (uint32_t k = 0; k < i; ++k) CHECK(strcmp(name, spt_glsl_default_name(k)) != 0);
    }
    CHECK(spt_glsl_default_name(SPT_GLSL_NAMES) == NULL);
    CHECK(spt_glsl_default_name(0xffffffffu) == NULL);
}

/* ---- The smallest shader --------------------------------------------------------------------- */

/* One ball by steps of f, as a library: under 40 lines of code, and none that a feature asks for.
 * The settings that can be replaced and the comments are not counted in. */
static void H6n_smallest_shader(void) {
    static const char *const features[] = {"flags",     "component",  "candidate_t", "fallbacks",
                                           "path",      "normal",     "spt_refine",  "spt_offset",
                                           "pixel",     "relaxation", "spt_clip_0",  "guards",
                                           "materials", "uniform",    "size"};
    glsl_world_make(&world, GLSL_BALL);
    world.options.target = SPT_GLSL_FRAGMENT_330;
    check_context("smallest program");
    CHECK(glsl_world_audit(&world, &text));
    world.options.target = SPT_GLSL_LIBRARY;
    check_context("smallest library");
    if (!glsl_world_audit(&world, &text)) return;
    uint32_t lines = 0, last = 0;
    for (int32_t i = 0; i < text.token_count; ++i) {
        const glsl_token *const token = &text.tokens[i];
        if (token->directive || token->kind == GLSL_END || token->line == last) continue;
        last = token->line;
        ++lines;
    }
    CHECK_SAY(lines < 40, "%u lines of code", (unsigned)lines);
    CHECK_SAY(text.function_count == 2, "%d functions", (int)text.function_count);
    for (size_t i = 0; i < sizeof features / sizeof *features; ++i) {
        CHECK_SAY(glsl_text_find(&text, features[i]) < 0, "%s", features[i]);
    }
}

/* ---- Locales --------------------------------------------------------------------------------- */

/* Hashes (FNV-1a) of texts of every kind of field, in turn for all targets. */
static void hash_texts(uint32_t hashes[glsl_subjects]) {
    for (int subject = 0; subject < glsl_subjects; ++subject) {
        glsl_world_make(&world, (glsl_subject)subject);
        world.options.target = (uint32_t)subject % SPT_GLSL_TARGETS;
        world.options.program = SPT_GLSL_HITS;
        world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_REFINE;
        if (world.options.target <= SPT_GLSL_SHADERTOY) {
            world.options.program = SPT_GLSL_PICTURE;
            world.options.features |= SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
        }
        CHECK(glsl_world_emit(&world) == SPT_OK);
        hashes[subject] = 2166136261u;
        for (size_t i = 0; i < world.length; ++i) {
            hashes[subject] = (hashes[subject] ^ (unsigned char)world.text[i]) * 16777619u;
        }
    }
}

/* In whatever locale with a decimal comma there is here; tests/glsl/locale.sh makes one, and sets
 * SPT_COMMA to see that it was found. */
static void H1a_text_does_not_depend_on_the_locale(void) {
    static const char *const names[] = {"",
                                        "de_DE.UTF-8",
                                        "de_DE.utf8",
                                        "de_DE",
                                        "fr_FR.UTF-8",
                                        "pl_PL.UTF-8",
                                        "ru_RU.UTF-8",
                                        "German_Germany.1252"};
    uint32_t before[glsl_subjects], after[glsl_subjects];
    char number[16] = "";
    hash_texts(before);
    for (size_t i = 0; i < sizeof names / sizeof *names && number[1] != ','; ++i) {
        if (setlocale(LC_ALL, names[i]) != NULL) snprintf(number, sizeof number, "%.1f", 0.5);
    }
    hash_texts(after);
    setlocale(LC_ALL, "C");
    for (int i = 0; i < glsl_subjects; ++i) {
        CHECK_SAY(before[i] == after[i], "%s", glsl_subject_names[i]);
    }
    CHECK(number[1] == ',' || getenv("SPT_COMMA") == NULL);
}

/* ---- Hosts ----------------------------------------------------------------------------------- */

/* Hosts that flush subnormal numbers get the same text, and find their flags as they left them: no
 * operation was invalid or divided by zero, whatever the numbers. */
static void G1ga_glsl_flush_to_zero(void) {
#ifdef HAVE_MXCSR
    const unsigned usual = _mm_getcsr();
    for (int i = 0; i < 2; ++i) {
        static char first[glsl_room];
        glsl_world_make(&world, i == 0 ? GLSL_SCENE : GLSL_NESTED);
        world.options.target = SPT_GLSL_FRAGMENT_330;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
        world.settings.epsilon = FLT_MIN;
        world.options.depth[0] = 1e-45f;
        _mm_setcsr((usual & ~0x3fu) | 0x8040u);
        const spt_status flushed = glsl_world_emit(&world);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(usual);
        CHECK(flushed == SPT_OK);
        CHECK_SAY((after & ~0x3fu) == ((usual & ~0x3fu) | 0x8040u), "0x%x", after);
        CHECK_SAY((after & 5u) == 0, "0x%x", after);
        memcpy(first, world.text, world.length + 1);
        CHECK(glsl_world_emit(&world) == SPT_OK);
        CHECK(strcmp(first, world.text) == 0);
    }
#else
    check_skip("G1ga: no control register here");
#endif
}

void suite_glsl_other(void) {
    RUN(F12a_points_to_compare_at);
    RUN(F12b_equal_seeds_equal_points);
    RUN(F12c_points_of_one_sample_and_bad_arguments);
    RUN(F12d_depth_coefficients);
    RUN(F12e_depth_of_bad_planes);
    RUN(F12f_default_names);
    RUN(H6n_smallest_shader);
    RUN(G1ga_glsl_flush_to_zero);
    RUN(H1a_text_does_not_depend_on_the_locale);
}
