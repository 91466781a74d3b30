/* SPDX-License-Identifier: MIT
 *
 * Row F10 for the fields and scenes that spt_glsl_emit() is given: what it must refuse, what it
 * cannot write, how many there may be and how deep one in another. */
#include "test_glsl_refused.h"

#include <math.h>
#include <string.h>

static void F10gg_glsl_fields(void) {
    REFUSE((world.field.batch = NULL, world.field.point = NULL), SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = -1.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = NAN, SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = INFINITY, SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = 0x1p101f, SPT_BAD_ARGUMENT);
    REFUSE(world.field.lipschitz = 0x1p-101f, SPT_BAD_ARGUMENT);
    REFUSE(world.field.flags = 2, SPT_BAD_ARGUMENT);
    REFUSE(world.bound.radius = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE(world.bound.kind = 0, SPT_BAD_ARGUMENT);
    REFUSE(world.field.glsl = NULL, SPT_UNSUPPORTED);
    REFUSE((world.field.glsl = NULL, world.field.glsl_prelude = "float my_f;"), SPT_UNSUPPORTED);
    REFUSE(world.bound = spt_bound_callback(NULL, NULL, NULL), SPT_BAD_ARGUMENT);
    ACCEPT(world.field.lipschitz = 0x1p100f);
    ACCEPT(world.field.lipschitz = 0x1p-100f);
    ACCEPT(world.field.bound = NULL);
    REFUSE_SCENE(world.fields[3].glsl = NULL, SPT_UNSUPPORTED);
    REFUSE_SCENE(world.fields[3].lipschitz = 0.0f, SPT_BAD_ARGUMENT);
    REFUSE_SCENE(world.scene.count = 0, SPT_BAD_ARGUMENT);
    REFUSE_SCENE(world.scene.fields = NULL, SPT_BAD_ARGUMENT);
    REFUSE_SCENE(world.settings.method = spt_convex(), SPT_BAD_ARGUMENT);
    ACCEPT_SCENE(world.scene.materials = NULL);
}

static int called;

static void volume(void *user, const float origin[3], const float direction[3], float *t_in,
                   float *t_out) {
    (void)user;
    (void)origin;
    (void)direction;
    (void)t_in;
    (void)t_out;
    ++called;
}

static void F10gh_glsl_what_cannot_be_written(void) {
    static const spt_zone zone = {{0, 0, 0}, 1, -1};
    spt_zone bad = zone;
    REFUSE(world.bound = spt_bound_callback(NULL, volume, NULL), SPT_UNSUPPORTED);
    REFUSE_SCENE(world.bounds[4] = spt_bound_callback(NULL, volume, NULL), SPT_UNSUPPORTED);
    CHECK(called == 0);
    REFUSE_SCENE((world.scene.zones = &zone, world.scene.zone_count = 1), SPT_UNSUPPORTED);
    bad.radius = 0;
    REFUSE_SCENE((world.scene.zones = &bad, world.scene.zone_count = 1), SPT_OK);
    REFUSE_SCENE(world.scene.zone_count = 1, SPT_OK); /* of no zones */
    /* kernels and inner fields without text */
    prepare(GLSL_KRS_FIELD);
    spt_kernel kernel;
    world.ball.glsl = NULL;
    kernel = spt_kernel_field(&world.ball);
    spt_krs_model model = spt_krs_model_default();
    model.kernels = &kernel;
    CHECK(spt_krs_build(&model, &world.krs) == SPT_OK);
    world.field = spt_krs_field(&world.krs);
    refuse("a kernel without text", SPT_UNSUPPORTED);
    prepare(GLSL_LEVEL_SET);
    world.level_set.inner.glsl = NULL;
    refuse("a level set of a field without text", SPT_UNSUPPORTED);
    prepare(GLSL_TWIST);
    world.distorted.inner.glsl = NULL;
    refuse("a twist of a field without text", SPT_UNSUPPORTED);
    prepare(GLSL_MAP);
    world.distorted.distortion.glsl = NULL;
    refuse("a map without text", SPT_UNSUPPORTED);
    prepare(GLSL_CONFORMAL);
    world.conformal.kernels[0].glsl = NULL;
    world.conformal.kernels[1].glsl = NULL;
    refuse("a conformal field of one without text", SPT_UNSUPPORTED);
}

/* ---- How many and how deep ------------------------------------------------------------------- */

static void F10gj_glsl_number_of_fields(void) {
    static spt_field many[SPT_GLSL_FIELDS + 2];
    glsl_world_make(&world, GLSL_SCENE_1);
    for (size_t i = 0; i < SPT_GLSL_FIELDS + 2; ++i) many[i] = world.ball;
    world.scene.fields = many;
    world.scene.count = SPT_GLSL_FIELDS;
    accept("as many fields as there may be");
    world.scene.count = SPT_GLSL_FIELDS + 1;
    refuse("a field too many", SPT_OK);
    /* inner ones count */
    CHECK(glsl_world_make(&world, GLSL_LEVEL_SET));
    many[7] = world.field;
    world.scene.fields = many;
    world.scene.count = SPT_GLSL_FIELDS - 1;
    world.options.field = NULL;
    world.options.scene = &world.scene;
    accept("one of them within another");
    world.scene.count = SPT_GLSL_FIELDS;
    refuse("an inner field too many", SPT_OK);
}

static void F10gk_glsl_depth_of_fields(void) {
    enum { deep = SPT_GLSL_DEPTH + 3 };
    static spt_level_set sets[deep];
    static spt_field fields[deep];
    static const float eye[3] = {0, 0, -5};
    int refused = 0, last = 0;
    glsl_world_make(&world, GLSL_BALL);
    world.settings.pixel_radius = 1e-3f;
    for (int depth = 0; depth < deep; ++depth) {
        const spt_field *const inner = depth == 0 ? &world.ball : &fields[depth - 1];
        CHECK(spt_level_set_field(inner, eye, 0, 0.125f, &world.settings, &sets[depth],
                                  &fields[depth]) == SPT_OK);
        world.options.field = &fields[depth];
        check_context("%d level sets", depth + 1);
        const spt_status status = glsl_world_emit(&world);
        /* whether the outermost one counts is left open */
        if (depth + 1 < SPT_GLSL_DEPTH) CHECK(status == SPT_OK);
        if (depth > SPT_GLSL_DEPTH) CHECK(status != SPT_OK);
        CHECK(status == SPT_OK || last == depth || refused); /* and none after a refused one */
        if (status == SPT_OK) {
            CHECK(!refused);
            last = depth + 1;
            glsl_world_audit(&world, &text);
        } else {
            refused = 1;
        }
    }
    CHECK(refused);
    /* a field within itself has no end */
    sets[0].inner = fields[0];
    world.options.field = &fields[0];
    refuse("a level set of itself", SPT_OK);
}

void suite_glsl_fields(void) {
    RUN(F10gg_glsl_fields);
    RUN(F10gh_glsl_what_cannot_be_written);
    RUN(F10gj_glsl_number_of_fields);
    RUN(F10gk_glsl_depth_of_fields);
}
