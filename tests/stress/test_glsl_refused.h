/* SPDX-License-Identifier: MIT
 *
 * What is changed about options that are right, and whether spt_glsl_emit() then refuses them. For
 * the files of row F10. */
#ifndef TESTS_GLSL_REFUSED_H
#define TESTS_GLSL_REFUSED_H

#include "check.h"
#include "test_glsl_world.h"

static glsl_world world;
static glsl_text text;

/* A picture of a field, with all that it can have. */
static void prepare(glsl_subject subject) {
    glsl_world_make(&world, subject);
    world.options.target = SPT_GLSL_FRAGMENT_330;
    world.options.program = SPT_GLSL_PICTURE;
    world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_REFINE | SPT_GLSL_SHADOW |
                             SPT_GLSL_OCCLUSION | SPT_GLSL_DEPTH_WRITE;
}

static void refuse(const char *why, spt_status expected) {
    const spt_status status = glsl_world_emit(&world);
    const int right = expected == SPT_OK ? status != SPT_OK : status == expected;
    CHECK_SAY(right, "%s: %s", why, spt_status_name(status));
}

static void accept(const char *why) {
    const spt_status status = glsl_world_emit(&world);
    CHECK_SAY(status == SPT_OK, "%s: %s", why, spt_status_name(status));
    if (status == SPT_OK) {
        check_context("%s", why);
        glsl_world_audit(&world, &text);
    }
}

/* expected SPT_OK: refused with either status, of which glsl.h does not say which. */
#define REFUSE(spoil, expected) (prepare(GLSL_BODY), (void)(spoil), refuse(#spoil, expected))
#define REFUSE_SCENE(spoil, expected) (prepare(GLSL_SCENE), (void)(spoil), refuse(#spoil, expected))
#define ACCEPT(change) (prepare(GLSL_BODY), (void)(change), accept(#change))
#define ACCEPT_SCENE(change) (prepare(GLSL_SCENE), (void)(change), accept(#change))

#endif
