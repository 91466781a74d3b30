/* SPDX-License-Identifier: MIT
 *
 * Row H5: buffers of every size, against pages that no one may touch; and structures of other
 * versions (F10), which lie against such pages, too. */
#include "check.h"
#include "stress_guard.h"
#include "test_glsl_world.h"

#include <string.h>

static glsl_world world;
static char whole[1 << 17];
static size_t needed;
static stress_guard guard;

enum { fill = 0x5a };

/* The whole text of the world, once and for all. */
static int write_whole(glsl_subject subject, uint32_t target) {
    glsl_world_make(&world, subject);
    world.options.target = target;
    const spt_status status = spt_glsl_emit(&world.options, whole, sizeof whole, &needed);
    CHECK_SAY(status == SPT_OK, "%s", spt_status_name(status));
    return status == SPT_OK;
}

/* One call with a buffer whose end is the end of what may be touched. */
static void fit(size_t capacity, int with_length) {
    const size_t unset = (size_t)-5;
    size_t length = unset;
    char *const buffer = stress_guard_top(&guard, capacity);
    memset(guard.first, fill, guard.size);
    const spt_status status =
        spt_glsl_emit(&world.options, buffer, capacity, with_length ? &length : NULL);
    const size_t written = capacity > needed ? needed + 1 : capacity;
    CHECK(status == (capacity > needed ? SPT_OK : SPT_BUFFER_TOO_SMALL));
    CHECK(length == (with_length ? needed : unset));
    CHECK(capacity == 0 || buffer[written - 1] == 0);
    CHECK(capacity == 0 || memcmp(buffer, whole, written - 1) == 0);
    CHECK(stress_guard_is_filled(&guard, buffer, written, fill));
}

static void H5a_every_capacity_of_a_small_text(void) {
    if (!write_whole(GLSL_BALL, SPT_GLSL_LIBRARY)) return;
    if (!stress_guard_make(&guard, needed + 64)) {
        check_skip("no guard pages here");
        return;
    }
    for (size_t capacity = 0; capacity <= needed + 2; ++capacity) {
        check_context("capacity %u of %u", (unsigned)capacity, (unsigned)needed);
        fit(capacity, capacity % 3 != 0);
    }
    stress_guard_free(&guard);
}

/* Texts in which each way of writing takes part, at every 61st capacity and around the end. */
static void H5b_many_capacities_of_larger_texts(void) {
    static const glsl_subject some[] = {GLSL_NESTED, GLSL_MOEKRS, GLSL_SCENE};
    for (int i = 0; i < 3; ++i) {
        if (!write_whole(some[i], i == 0 ? SPT_GLSL_COMPUTE_430 : SPT_GLSL_LIBRARY)) continue;
        if (!stress_guard_make(&guard, needed + 64)) {
            check_skip("no guard pages here");
            return;
        }
        for (size_t capacity = 0; capacity <= needed + 61; capacity += 997) fit(capacity, 1);
        for (size_t capacity = needed - 2; capacity <= needed + 2; ++capacity) fit(capacity, 0);
        stress_guard_free(&guard);
    }
}

static void H5c_null_buffers(void) {
    size_t length = 0;
    if (!write_whole(GLSL_KRS_1, SPT_GLSL_FRAGMENT_300_ES)) return;
    CHECK(spt_glsl_emit(&world.options, NULL, 0, &length) == SPT_BUFFER_TOO_SMALL);
    CHECK(length == needed);
    CHECK(spt_glsl_emit(&world.options, NULL, 0, NULL) == SPT_BUFFER_TOO_SMALL);
    char one = fill;
    CHECK(spt_glsl_emit(&world.options, &one, 0, &length) == SPT_BUFFER_TOO_SMALL && one == fill);
    CHECK(spt_glsl_emit(&world.options, &one, 1, &length) == SPT_BUFFER_TOO_SMALL && one == 0);
    CHECK(length == needed);
    CHECK(spt_glsl_emit(&world.options, whole, (size_t)-1, NULL) == SPT_OK);
    CHECK(strlen(whole) == needed);
}

/* ---- Versions -------------------------------------------------------------------------------- */

static void refuse(const char *why) {
    const spt_status status = glsl_world_emit(&world);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "%s: %s", why, spt_status_name(status));
}

#define REFUSE(subject, spoil) \
    (glsl_world_make(&world, subject), picture(), (void)(spoil), refuse(#spoil))

static void picture(void) {
    world.options.target = SPT_GLSL_FRAGMENT_330;
    world.options.program = SPT_GLSL_PICTURE;
}

static void F10gl_glsl_shorter_structures(void) {
    REFUSE(GLSL_BODY, world.options.struct_size = 0);
    REFUSE(GLSL_BODY, world.options.struct_size -= 1);
    REFUSE(GLSL_BODY, world.settings.struct_size = 0);
    REFUSE(GLSL_BODY, world.settings.struct_size -= 1);
    REFUSE(GLSL_BODY, world.field.struct_size = 0);
    REFUSE(GLSL_BODY, world.field.struct_size -= sizeof(void *) + 1);
    REFUSE(GLSL_BODY, world.bound.struct_size = 0);
    REFUSE(GLSL_BODY, world.bound.struct_size -= 1);
    REFUSE(GLSL_BODY, world.camera.struct_size = 0);
    REFUSE(GLSL_BODY, world.camera.struct_size -= 1);
    REFUSE(GLSL_SCENE, world.scene.struct_size = 0);
    REFUSE(GLSL_SCENE, world.scene.struct_size -= 1);
    REFUSE(GLSL_SCENE, world.fields[2].struct_size = 0);
    REFUSE(GLSL_SCENE, world.bounds[2].struct_size = 0);
}

enum { future = 4096, structures = 5 };
static stress_guard guards[structures];

/* A structure of a later version, whose known part lies against a guard page: who reads the rest
 * that struct_size claims ends the program. */
static void *later(int place, const void *known, size_t size) {
    const size_t claimed = size + future;
    unsigned char *const at = stress_guard_top(&guards[place], size);
    memcpy(at, known, size);
    memcpy(at, &claimed, sizeof claimed);
    return at;
}

static void F10gm_glsl_longer_structures(void) {
    int made = 1;
    for (int i = 0; i < structures; ++i) made &= stress_guard_make(&guards[i], 1024);
    if (!made) {
        check_skip("no guard pages here");
        return;
    }
    for (int i = 0; i < 2; ++i) {
        size_t length = 0;
        static char now[1 << 17], then[1 << 17];
        glsl_world_make(&world, i == 0 ? GLSL_BODY : GLSL_SCENE_1);
        picture();
        CHECK(spt_glsl_emit(&world.options, now, sizeof now, &length) == SPT_OK);
        spt_field *const field = i == 0 ? &world.field : &world.fields[0];
        field->bound = later(0, &world.bound, sizeof world.bound);
        const spt_field *const later_field = later(1, field, sizeof *field);
        if (i == 0) {
            world.options.field = later_field;
        } else {
            world.scene.fields = later_field;
            world.options.scene = later(2, &world.scene, sizeof world.scene);
        }
        world.options.settings = later(3, &world.settings, sizeof world.settings);
        world.options.camera = later(4, &world.camera, sizeof world.camera);
        CHECK(spt_glsl_emit(&world.options, then, sizeof then, &needed) == SPT_OK);
        CHECK(length == needed && strcmp(now, then) == 0);
        const spt_glsl_options *const options = later(2, &world.options, sizeof world.options);
        if (i == 1) continue; /* the scene lies there */
        CHECK(spt_glsl_emit(options, then, sizeof then, &needed) == SPT_OK);
        CHECK(length == needed && strcmp(now, then) == 0);
    }
    for (int i = 0; i < structures; ++i) stress_guard_free(&guards[i]);
}

/* Names are read as far as they are told to be there, and no farther; so are callers' texts. */
static void H5d_names_and_texts_against_the_guard(void) {
    static const char name[] = "u_eps", body[] = "return p.x;";
    if (!stress_guard_make(&guard, 1024)) {
        check_skip("no guard pages here");
        return;
    }
    stress_guard texts;
    CHECK(stress_guard_make(&texts, 1024));
    glsl_world_make(&world, GLSL_BALL);
    world.options.target = SPT_GLSL_FRAGMENT_330;
    world.options.uniforms = 1u << SPT_GLSL_NAME_EPSILON;
    const char **const names = stress_guard_top(&guard, SPT_GLSL_NAMES * sizeof *names);
    char *const own = stress_guard_top(&texts, sizeof name + sizeof body);
    memcpy(own, name, sizeof name);
    memcpy(own + sizeof name, body, sizeof body);
    for (int i = 0; i < SPT_GLSL_NAMES; ++i) names[i] = NULL;
    names[SPT_GLSL_NAME_EPSILON] = own;
    world.options.names = names;
    world.field.glsl = own + sizeof name;
    CHECK(glsl_world_emit(&world) == SPT_OK);
    CHECK(strstr(world.text, "uniform float u_eps;") != NULL);
    stress_guard_free(&texts);
    stress_guard_free(&guard);
}

void suite_glsl_buffers(void) {
    RUN(H5a_every_capacity_of_a_small_text);
    RUN(H5b_many_capacities_of_larger_texts);
    RUN(H5c_null_buffers);
    RUN(H5d_names_and_texts_against_the_guard);
    RUN(F10gl_glsl_shorter_structures);
    RUN(F10gm_glsl_longer_structures);
}
