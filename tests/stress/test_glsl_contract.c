/* SPDX-License-Identifier: MIT
 *
 * Row F10 for spt_glsl_emit(): each wrong option in turn is refused with nothing written, what is
 * right at the ends of its range is not. Fields are in test_glsl_fields.c, names in
 * test_glsl_names.c, callers' texts in test_glsl_texts.c, and combinations of features in
 * test_glsl_shape.c. */
#include "test_glsl_refused.h"

#include <float.h>
#include <math.h>
#include <string.h>

static void F10ga_glsl_pointers(void) {
    size_t length = 77;
    char bytes[8] = "unused";
    prepare(GLSL_BODY);
    CHECK(spt_glsl_emit(NULL, bytes, sizeof bytes, &length) == SPT_BAD_ARGUMENT);
    CHECK(spt_glsl_emit(&world.options, NULL, 1, &length) == SPT_BAD_ARGUMENT);
    CHECK(spt_glsl_emit(&world.options, NULL, 1, NULL) == SPT_BAD_ARGUMENT);
    CHECK(length == 77 && strcmp(bytes, "unused") == 0);
    ACCEPT(0);
    ACCEPT_SCENE(0);
    REFUSE(world.options.field = NULL, SPT_BAD_ARGUMENT);
    REFUSE(
        (world.options.scene = &world.scene, world.scene.count = 1, world.fields[0] = world.ball),
        SPT_BAD_ARGUMENT);
    REFUSE(world.options.settings = NULL, SPT_BAD_ARGUMENT);
    REFUSE(world.options.camera = NULL, SPT_BAD_ARGUMENT);
    REFUSE((world.options.camera = NULL, world.options.features = 0,
            world.options.program = SPT_GLSL_CONES),
           SPT_BAD_ARGUMENT);
    /* neither of these looks at a camera */
    ACCEPT((world.options.camera = NULL, world.options.features = 0,
            world.options.program = SPT_GLSL_HITS));
    ACCEPT((world.options.camera = NULL, world.options.features = 0,
            world.options.program = SPT_GLSL_POINTS));
    ACCEPT((world.options.camera = NULL, world.options.features = 0,
            world.options.target = SPT_GLSL_LIBRARY));
}

static void F10gb_glsl_enumerations(void) {
    REFUSE(world.options.target = SPT_GLSL_TARGETS, SPT_OK);
    REFUSE(world.options.target = 0xffffffffu, SPT_OK);
    REFUSE(world.options.program = SPT_GLSL_PROGRAMS, SPT_OK);
    REFUSE(world.options.program = 0xffffffffu, SPT_OK);
    for (uint32_t bit = 18; bit < 32; ++bit) REFUSE(world.options.features |= 1u << bit, SPT_OK);
    for (uint32_t bit = SPT_GLSL_NAMES; bit < 32; ++bit) {
        REFUSE(world.options.uniforms = 1u << bit, SPT_OK);
    }
    ACCEPT(world.options.uniforms = (1u << SPT_GLSL_NAMES) - 1);
    for (uint32_t bit = 0; bit < SPT_GLSL_NAMES; ++bit) {
        ACCEPT(world.options.uniforms = 1u << bit);
        if (bit % 4 == 0) ACCEPT_SCENE(world.options.uniforms = 15u << bit);
    }
}

static void F10gc_glsl_combinations(void) {
    static const uint32_t programs[] = {SPT_GLSL_HITS, SPT_GLSL_POINTS, SPT_GLSL_CONES};
    for (int i = 0; i < 3; ++i) {
        REFUSE((world.options.features = 0, world.options.target = SPT_GLSL_SHADERTOY,
                world.options.program = programs[i]),
               SPT_UNSUPPORTED);
    }
    for (uint32_t target = SPT_GLSL_COMPUTE_310_ES; target < SPT_GLSL_TARGETS; ++target) {
        REFUSE((world.options.features = 0, world.options.target = target), SPT_UNSUPPORTED);
    }
    REFUSE_SCENE((world.options.features = SPT_GLSL_CONVEX, world.options.program = SPT_GLSL_HITS),
                 SPT_OK);
    REFUSE_SCENE((world.options.features = SPT_GLSL_BINARY, world.options.program = SPT_GLSL_HITS),
                 SPT_OK);
    REFUSE((world.options.features = SPT_GLSL_BINARY | SPT_GLSL_CONVEX,
            world.options.program = SPT_GLSL_HITS),
           SPT_OK);
    REFUSE((world.options.features = SPT_GLSL_BINARY, world.options.program = SPT_GLSL_HITS,
            world.settings.flags = SPT_SKIP_START),
           SPT_OK);
    REFUSE((world.options.features = SPT_GLSL_CONVEX, world.options.program = SPT_GLSL_HITS,
            world.settings.flags = SPT_STOP_INSIDE),
           SPT_OK);
    REFUSE((world.options.features = SPT_GLSL_CONVEX, world.options.program = SPT_GLSL_HITS,
            world.field.bound = NULL),
           SPT_OK);
    REFUSE((world.options.features = SPT_GLSL_PLACE, world.options.program = SPT_GLSL_HITS),
           SPT_OK);
}

#define OVER(member, low, high) \
    do { \
        REFUSE(world.options.member = (high) + 1, SPT_BAD_ARGUMENT); \
        REFUSE(world.options.member = 0xffffffffu, SPT_BAD_ARGUMENT); \
        if ((low) > 0) REFUSE(world.options.member = (low)-1, SPT_BAD_ARGUMENT); \
        ACCEPT(world.options.member = (low)); \
        ACCEPT(world.options.member = (high)); \
    } while (0)

static void F10gd_glsl_counts(void) {
    OVER(iterations, 0u, 16u);
    OVER(samples, 1u, 16u);
    for (int i = 0; i < 2; ++i) {
        static const uint32_t bad[] = {0, 1, 65, 0xffffffffu}, good[] = {2, 8, 64};
        const uint32_t program = i == 0 ? SPT_GLSL_CONES : SPT_GLSL_PICTURE;
        const uint32_t features = i == 0 ? 0 : SPT_GLSL_STARTS;
        for (int k = 0; k < 4; ++k) {
            REFUSE((world.options.features = features, world.options.program = program,
                    world.options.cone_size = bad[k]),
                   SPT_BAD_ARGUMENT);
        }
        for (int k = 0; k < 3; ++k) {
            ACCEPT((world.options.features = features, world.options.program = program,
                    world.options.cone_size = good[k]));
        }
    }
    ACCEPT((world.options.features = 0, world.options.program = SPT_GLSL_POINTS));
    REFUSE((world.options.features = 0, world.options.program = SPT_GLSL_POINTS,
            world.options.field_number = 1),
           SPT_BAD_ARGUMENT);
    for (uint32_t i = 0; i < 11; ++i) {
        ACCEPT_SCENE((world.options.features = 0, world.options.program = SPT_GLSL_POINTS,
                      world.options.field_number = i));
    }
    REFUSE_SCENE((world.options.features = 0, world.options.program = SPT_GLSL_POINTS,
                  world.options.field_number = (uint32_t)world.scene.count),
                 SPT_BAD_ARGUMENT);
}

static void F10ge_glsl_numbers(void) {
    const float bad[] = {NAN, INFINITY, -INFINITY, -1.0f};
    for (int i = 0; i < 4; ++i) {
        REFUSE(world.options.detail = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.options.light_tangent = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.options.occlusion = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.epsilon = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.pixel_radius = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.size = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.relaxation = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.extrapolation = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.slope_blend = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.settings.step_cap = bad[i], SPT_BAD_ARGUMENT);
        for (int axis = 0; axis < 3; ++axis) {
            if (i < 3) REFUSE(world.options.light[axis] = bad[i], SPT_BAD_ARGUMENT);
            if (i < 3 && axis < 2) REFUSE(world.options.depth[axis] = bad[i], SPT_BAD_ARGUMENT);
        }
    }
    REFUSE(world.options.light_tangent = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.options.occlusion = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE((world.options.light[0] = 0, world.options.light[1] = 0, world.options.light[2] = 0),
           SPT_BAD_ARGUMENT);
    ACCEPT((world.options.light[0] = 0, world.options.light[1] = 0, world.options.light[2] = -3));
    ACCEPT(
        (world.options.light[0] = 1e-30f, world.options.light[1] = 0, world.options.light[2] = 0));
    ACCEPT((world.options.light[0] = 3e38f, world.options.light[1] = 3e38f,
            world.options.light[2] = -3e38f));
    ACCEPT((world.options.depth[0] = -2.5f, world.options.depth[1] = 1e-3f));
    ACCEPT(world.options.detail = 0.5f);
    REFUSE(world.settings.epsilon = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.relaxation = 2.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.relaxation = 0.999f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.slope_blend = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.extrapolation = 1.001f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.step_cap = 0.5f, SPT_BAD_ARGUMENT);
    REFUSE(world.settings.step_cap = 101.0f, SPT_BAD_ARGUMENT);
    ACCEPT(world.settings.epsilon = FLT_MIN);
    ACCEPT(world.settings.epsilon = 1e-45f); /* a subnormal number is written as 0.0 */
    ACCEPT(world.settings.size = 1e18f);
    ACCEPT((world.settings.relaxation = 1.0f, world.settings.method = spt_relaxed()));
    ACCEPT(world.settings.budget = 0);
    ACCEPT(world.settings.budget = 1000000);
}

static void F10gf_glsl_settings(void) {
    REFUSE(world.settings.method = NULL, SPT_BAD_ARGUMENT);
    REFUSE((world.field.flags = 0, world.settings.method = spt_convex()), SPT_BAD_ARGUMENT);
    ACCEPT(world.settings.method = spt_convex());
    REFUSE(world.settings.flags = SPT_CHECK_CONVEX, SPT_OK);
    REFUSE((world.settings.flags = SPT_CHECK_CONVEX, world.options.features = SPT_GLSL_CONVEX,
            world.options.target = SPT_GLSL_LIBRARY),
           SPT_OK);
    REFUSE(world.settings.flags = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST, SPT_BAD_ARGUMENT);
    for (uint32_t bit = 5; bit < 32; ++bit) {
        REFUSE(world.settings.flags = 1u << bit, SPT_BAD_ARGUMENT);
    }
    /* max_lanes is not used; that it must be 0, 1, 4, 8 or 16 is said of it all the same */
    for (uint32_t lanes = 0; lanes <= 16; lanes = lanes == 0 ? 1 : lanes == 1 ? 4 : 2 * lanes) {
        ACCEPT(world.settings.max_lanes = lanes);
    }
}

static int called;

static void camera_rays(void *user, size_t count, const float *x, const float *y,
                        spt_camera_ray *rays) {
    (void)user;
    (void)count;
    (void)x;
    (void)y;
    (void)rays;
    ++called;
}

static void F10gi_glsl_cameras(void) {
    const float bad[] = {NAN, INFINITY, -INFINITY};
    static const float target[3] = {0, 0, 0}, up[3] = {0, 1, 0}, eye[3] = {1, 2, 3};
    REFUSE(world.camera = spt_camera_of_rays(camera_rays, NULL), SPT_UNSUPPORTED);
    CHECK(called == 0);
    REFUSE(world.camera.kind = 0, SPT_BAD_ARGUMENT);
    REFUSE(world.camera.kind = 4, SPT_BAD_ARGUMENT);
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            REFUSE(world.camera.eye[axis] = bad[i], SPT_BAD_ARGUMENT);
            REFUSE(world.camera.right[axis] = bad[i], SPT_BAD_ARGUMENT);
            REFUSE(world.camera.up[axis] = bad[i], SPT_BAD_ARGUMENT);
            REFUSE(world.camera.forward[axis] = bad[i], SPT_BAD_ARGUMENT);
        }
        REFUSE(world.camera.x_low = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.camera.x_high = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.camera.y_low = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.camera.y_high = bad[i], SPT_BAD_ARGUMENT);
        REFUSE(world.camera.t_min = bad[i], SPT_BAD_ARGUMENT);
    }
    REFUSE(world.camera.t_min = -1.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.camera.t_max = NAN, SPT_BAD_ARGUMENT);
    REFUSE((world.camera.forward[0] = 0, world.camera.forward[1] = 0, world.camera.forward[2] = 0),
           SPT_BAD_ARGUMENT);
    REFUSE(world.camera.t_max = 1.0001e18f, SPT_UNSUPPORTED);
    REFUSE(world.camera.t_max = FLT_MAX, SPT_UNSUPPORTED);
    ACCEPT(world.camera.t_max = 1e18f);
    ACCEPT(world.camera.t_max = 25.0f);
    ACCEPT((world.camera.x_low = 1.0f, world.camera.x_high = -1.0f));
    prepare(GLSL_BODY);
    world.options.features &= ~(uint32_t)SPT_GLSL_DEPTH_WRITE;
    CHECK(spt_camera_orthographic(&world.camera, eye, target, up, 2.0f, 300, 200) == SPT_OK);
    accept("orthographic");
    /* +infinity becomes 1e18: the same text */
    static char first[glsl_room];
    prepare(GLSL_BODY);
    world.camera.t_max = INFINITY;
    accept("t_max = infinity");
    memcpy(first, world.text, world.length + 1);
    world.camera.t_max = 1e18f;
    accept("t_max = 1e18");
    CHECK(strcmp(first, world.text) == 0);
}

void suite_glsl_contract(void) {
    RUN(F10ga_glsl_pointers);
    RUN(F10gb_glsl_enumerations);
    RUN(F10gc_glsl_combinations);
    RUN(F10gd_glsl_counts);
    RUN(F10ge_glsl_numbers);
    RUN(F10gf_glsl_settings);
    RUN(F10gi_glsl_cameras);
}
