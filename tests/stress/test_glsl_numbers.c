/* SPDX-License-Identifier: MIT
 *
 * Rows H2 and H3: every number of a scene, of settings and of options stands in the text so that it
 * reads back to the same bits; negative ones in brackets, always with a point or exponent (which
 * the reader of every text looks at), subnormal ones as 0.0, and none that is not finite. */
#include "check.h"
#include "test_glsl_world.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static glsl_world world;
static glsl_text text;

enum { most_numbers = 1 << 14 };
static float read_back[most_numbers];
static size_t read_count;

static int compare(const void *a, const void *b) {
    const uint32_t left = check_bits(*(const float *)a), right = check_bits(*(const float *)b);
    return (left > right) - (left < right);
}

static int read_numbers(void) {
    const spt_status status = glsl_world_emit(&world);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    if (status != SPT_OK) return 0;
    glsl_world_allow(&world, &text);
    CHECK_SAY(glsl_text_read(&text, world.text), "%s", text.fault);
    read_count = glsl_text_numbers(&text, read_back, most_numbers);
    CHECK(read_count < most_numbers);
    qsort(read_back, read_count, sizeof *read_back, compare);
    return 1;
}

static int is_there(float number) {
    return bsearch(&number, read_back, read_count, sizeof *read_back, compare) != NULL;
}

/* A number of any magnitude from FLT_MIN to `most`, each bit of its mantissa at random. */
static float any_number(float most) {
    for (;;) {
        const uint32_t bits = check_random() ^ check_random() << 16;
        float number;
        memcpy(&number, &bits, sizeof number);
        if (fabsf(number) >= FLT_MIN && fabsf(number) <= most) return number;
    }
}

/* Models of 65 balls whose coordinates are any numbers, and mirrors at any offset. */
static void H2a_numbers_of_models_read_back(void) {
    enum { rounds = 60, kernels = SPT_KRS_LEVELS + 1 };
    float numbers[kernels][4], offsets[SPT_KRS_LEVELS];
    for (int round = 0; round < rounds; ++round) {
        glsl_world_make(&world, GLSL_KRS_0);
        for (int i = 0; i < kernels; ++i) {
            for (int axis = 0; axis < 3; ++axis) numbers[i][axis] = any_number(1e18f);
            do {
                numbers[i][3] = fabsf(any_number(1e18f));
            } while (numbers[i][3] < 1e-15f);
            world.kernels[i] =
                spt_kernel_sphere(numbers[i][0], numbers[i][1], numbers[i][2], numbers[i][3]);
        }
        for (int i = 0; i < SPT_KRS_LEVELS; ++i) {
            static const float normal[3] = {0.6f, -0.8f, 0};
            memcpy(world.mirrors[i].normal, normal, sizeof normal);
            world.mirrors[i].offset = offsets[i] = any_number(1e18f);
        }
        spt_krs_model model = spt_krs_model_default();
        model.levels = SPT_KRS_LEVELS;
        model.kernels = world.kernels;
        model.mirrors = world.mirrors;
        CHECK(spt_krs_build(&model, &world.krs) == SPT_OK);
        world.field = spt_krs_field(&world.krs);
        world.options.features = round % 2 == 0 ? 0 : SPT_GLSL_ARRAYS;
        check_context("round %d", round);
        if (!read_numbers()) continue;
        for (int i = 0; i < kernels; ++i) {
            for (int k = 0; k < 4; ++k) {
                CHECK_SAY(is_there(numbers[i][k]), "kernel %d, number %d: %.9g", i, k,
                          (double)numbers[i][k]);
            }
        }
        for (int i = 0; i < SPT_KRS_LEVELS; ++i) {
            CHECK_SAY(is_there(offsets[i]), "mirror %d: %.9g", i, (double)offsets[i]);
        }
        CHECK(is_there(0.6f) && is_there(-0.8f));
    }
}

/* The numbers of the row, and the ends of every decade and power of two. */
static void H2b_numbers_of_settings_read_back(void) {
    static const float list[] = {
        1e-7f, 273758.5453123f, 1.0f / 3.0f, FLT_MIN, FLT_MAX,      1.0f,        2.0f,
        0.1f,  1e-5f,           9.99999e-5f, 1e9f,    999999999.0f, 123456789.f, 16777216,
        3e38f, 1.5e-38f,        0.00390625f, 1e18f,   9.9999998e9f};
    enum { listed = sizeof list / sizeof *list };
    float number[2] = {1.0f, 1.0f};
    for (int i = 0; i < 500; ++i) {
        float next = i < listed ? list[i] : fabsf(any_number(FLT_MAX));
        if (i >= listed && i < listed + 256) {
            const int power = (i - listed) / 2 - 126;
            next = i % 2 == 0 ? ldexpf(1.0f, power) : nextafterf(ldexpf(1.0f, power + 1), 0.0f);
        } else if (i >= listed + 256 && i < listed + 256 + 76) {
            next = (float)pow(10.0, i - listed - 256 - 37);
        }
        if (next >= FLT_MIN && next <= FLT_MAX) number[i % 2] = next;
        if (i % 2 == 0) continue;
        glsl_world_make(&world, GLSL_BALL);
        world.settings.epsilon = number[0];
        world.settings.pixel_radius = number[1];
        check_context("epsilon %.9g, pixel radius %.9g", (double)number[0], (double)number[1]);
        if (read_numbers()) CHECK(is_there(number[0]) && is_there(number[1]));
    }
}

/* What else a picture has numbers of. */
static void H2c_numbers_of_options_read_back(void) {
    for (int i = 0; i < 60; ++i) {
        glsl_world_make(&world, GLSL_BODY);
        world.options.target = i % 2 == 0 ? SPT_GLSL_FRAGMENT_330 : SPT_GLSL_LIBRARY;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
        if (i % 2 == 0) world.options.features |= SPT_GLSL_DEPTH_WRITE;
        world.settings.method = i % 3 == 0   ? spt_relaxed()
                                : i % 3 == 1 ? spt_enhanced()
                                             : spt_auto_relaxed();
        const float unit = (float)check_uniform(0.01, 1.0);
        world.settings.relaxation = 1.0f + 0.9f * unit;
        world.settings.extrapolation = unit;
        world.settings.slope_blend = unit;
        world.settings.epsilon = fabsf(any_number(1.0f));
        world.settings.pixel_radius = fabsf(any_number(1.0f));
        world.options.detail = fabsf(any_number(1e6f));
        world.options.light_tangent = fabsf(any_number(10.0f));
        world.options.occlusion = fabsf(any_number(10.0f));
        world.options.depth[0] = any_number(1e18f);
        world.options.depth[1] = any_number(1e18f);
        for (int axis = 0; axis < 3; ++axis) world.camera.eye[axis] = any_number(1e9f);
        world.camera.x_low = -fabsf(any_number(2.0f));
        check_context("options %d", i);
        if (!read_numbers()) continue;
        CHECK(is_there(world.settings.epsilon));
        CHECK(is_there(world.settings.pixel_radius));
        CHECK(is_there(i % 3 == 0   ? world.settings.relaxation
                       : i % 3 == 1 ? world.settings.extrapolation
                                    : world.settings.slope_blend));
        if (i % 2 != 0) continue; /* the rest is told to the functions of a library */
        CHECK(is_there(world.options.light_tangent) && is_there(world.options.occlusion));
        CHECK(is_there(world.options.depth[0]) && is_there(world.options.depth[1]));
        CHECK(is_there(world.options.detail) && is_there(world.camera.x_low));
        for (int axis = 0; axis < 3; ++axis) CHECK(is_there(world.camera.eye[axis]));
    }
}

/* -0, and numbers too small to be normal, become zero; both signs of the rest are kept. */
static void H3a_zeros_and_subnormal_numbers(void) {
    static const float zeros[] = {0.0f, -0.0f, 1e-45f, -1e-42f, 1.17549421e-38f};
    for (int i = 0; i < 5; ++i) {
        glsl_world_make(&world, GLSL_BODY);
        world.options.target = SPT_GLSL_FRAGMENT_330;
        world.options.program = SPT_GLSL_PICTURE;
        world.options.features = SPT_GLSL_DEPTH_WRITE;
        world.options.depth[0] = zeros[i];
        world.options.depth[1] = -7.25f;
        world.camera.eye[1] = zeros[i];
        world.camera.eye[2] = 7.75f;
        check_context("%.9g", (double)zeros[i]);
        if (!read_numbers()) continue;
        CHECK(is_there(-7.25f) && !is_there(7.25f));
        CHECK(is_there(7.75f) && !is_there(-7.75f));
        CHECK(is_there(0.0f));
        for (size_t k = 0; k < read_count; ++k) {
            CHECK(read_back[k] == 0.0f || fabsf(read_back[k]) >= FLT_MIN);
        }
    }
}

/* Words that stand for numbers that no literal can be. */
static int has_word(const char *word) {
    return glsl_text_find(&text, word) >= 0;
}

static void H3b_no_words_for_numbers(void) {
    static const char *const words[] = {"nan", "NaN", "NAN", "inf", "Inf", "INFINITY", "infinity"};
    for (int subject = 0; subject < glsl_subjects; ++subject) {
        if (!glsl_world_make(&world, (glsl_subject)subject)) continue;
        world.settings.pixel_radius = 0;
        if (!read_numbers()) continue;
        for (size_t i = 0; i < sizeof words / sizeof *words; ++i) CHECK(!has_word(words[i]));
        for (size_t i = 0; i < read_count; ++i) CHECK(fabsf(read_back[i]) <= FLT_MAX);
    }
}

/* Exact scalings: what the bound of a field adds to the rounding floor, and 1 / lipschitz. */
static void H2d_lipschitz_constants(void) {
    for (int i = 0; i < 60; ++i) {
        glsl_world_make(&world, GLSL_BALL);
        world.field.lipschitz = fabsf(any_number(1e6f));
        if (world.field.lipschitz < 1e-6f) world.field.lipschitz = 1e-6f;
        check_context("lipschitz %.9g", (double)world.field.lipschitz);
        if (!read_numbers()) continue;
        CHECK(is_there(1.0f / world.field.lipschitz) || is_there(world.field.lipschitz));
    }
}

void suite_glsl_numbers(void) {
    RUN(H2a_numbers_of_models_read_back);
    RUN(H2b_numbers_of_settings_read_back);
    RUN(H2c_numbers_of_options_read_back);
    RUN(H2d_lipschitz_constants);
    RUN(H3a_zeros_and_subnormal_numbers);
    RUN(H3b_no_words_for_numbers);
}
