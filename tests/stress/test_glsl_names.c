/* SPDX-License-Identifier: MIT
 *
 * Row H4: names of uniforms. What is reserved in any target, breaks the grammar or is not unique is
 * refused with nothing written; what is not stands in the text and nowhere hides something else. */
#include "check.h"
#include "test_glsl_words.h"
#include "test_glsl_world.h"

#include <string.h>

static glsl_world world;
static glsl_text text;

/* A picture with every parameter a uniform. */
static void prepare(void) {
    glsl_world_make(&world, GLSL_BODY);
    world.settings.method = spt_relaxed();
    world.settings.pixel_radius = 1e-3f;
    world.options.target = SPT_GLSL_FRAGMENT_330;
    world.options.program = SPT_GLSL_PICTURE;
    world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_DEPTH_WRITE;
    world.options.uniforms = (1u << SPT_GLSL_NAMES) - 1;
    world.options.names = world.names;
}

static spt_status named(uint32_t parameter, const char *name) {
    prepare();
    world.names[parameter] = name;
    return glsl_world_emit(&world);
}

static void refuse(const char *name) {
    static uint32_t parameter;
    parameter = (parameter + 5) % SPT_GLSL_NAMES; /* whichever it is, but for its own default */
    if (strcmp(name, spt_glsl_default_name(parameter)) == 0)
        parameter = (parameter + 5) % SPT_GLSL_NAMES;
    const spt_status status = named(parameter, name);
    CHECK_SAY(status == SPT_BAD_ARGUMENT, "\"%s\": %s", name, spt_status_name(status));
}

static void accept(const char *name) {
    const spt_status status = named(SPT_GLSL_NAME_RELAXATION, name);
    CHECK_SAY(status == SPT_OK, "\"%s\": %s", name, spt_status_name(status));
    if (status != SPT_OK) return;
    check_context("relaxation named %s", name);
    glsl_world_audit(&world, &text);
    CHECK((glsl_text_what(&text, name) & GLSL_IS_UNIFORM) != 0);
    CHECK(glsl_text_find(&text, spt_glsl_default_name(SPT_GLSL_NAME_RELAXATION)) < 0);
}

static void H4a_reserved_words_are_no_names(void) {
    for (size_t i = 0; i < glsl_reserved_count; ++i) refuse(glsl_reserved[i]);
}

/* Names of built-in functions: 3.00 es forbids to declare them (section 4.2.2), and the text could
 * not call them any more. And what the preprocessor or the target's host has given away. */
static void H4b_names_of_the_language_are_no_names(void) {
    static const char *const others[] = {
        "mainImage",          "iResolution", "iTime",    "main",        "gl_x",
        "gl_FragCoord",       "gl_",         "GL_ES",    "VULKAN",      "GL_core_profile",
        "GL_EXT_gpu_shader5", "__LINE__",    "__FILE__", "__VERSION__", "defined"};
    for (size_t i = 0; i < glsl_function_count; ++i) refuse(glsl_functions[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i) refuse(others[i]);
}

static void H4c_names_that_break_the_grammar(void) {
    static const char long_name[] =
        "a2345678901234567890123456789012345678901234567890123456789012345";
    static const char longest[] =
        "a234567890123456789012345678901234567890123456789012345678901234";
    static const char *const bad[] = {
        "",       " ",     "0",        "1a",        "a b",           "a b;", "x; }",
        "a\n",    "a-b",   "a.b",      "a[0]",      "a\tb",          "*/",   "a//",
        "\"a\"",  "a'",    "a$",       "@",         "a\\",           "#a",   "a#",
        "a\x7f",  "a\x01", "\xc3\xa4", "a\xc3\xa4", "\xef\xbb\xbf_", "\xff", "a\r",
        "a,b",    "(a)",   "a=1",      "a__b",      "__a",           "a__",  "__",
        "_a__b_", "a ",    " a"};
    CHECK(strlen(long_name) == 65 && strlen(longest) == 64);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) refuse(bad[i]);
    refuse(long_name);
    static char very_long[1 << 16];
    memset(very_long, 'a', sizeof very_long - 1);
    refuse(very_long);
    very_long[1025] = 0;
    refuse(very_long);
    accept(longest);
}

static void H4d_our_own_prefixes(void) {
    static const char *const bad[] = {"spt_",     "spt_x",       "spt_map", "spt_trace",
                                      "SptHit",   "Spt",         "SptX",    "SPT_",
                                      "SPT_ZERO", "SPT_PRECISE", "spt_eye", "spt_out_0"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) refuse(bad[i]);
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        const char *const name = spt_glsl_default_name(i);
        check_context("%s", name);
        CHECK(named(i, name) == SPT_OK);
        CHECK(named((i + 1) % SPT_GLSL_NAMES, name) == SPT_BAD_ARGUMENT);
    }
}

static void H4e_names_that_are_right(void) {
    static const char *const good[] = {
        "u_resolution", "uTime", "u_mouse", "_x",       "x_",     "_",     "A1_b2_C3",
        "Half",         "FLOAT", "samples", "texture_", "sp",     "sPT_x", "glx",
        "gL_x",         "Gl_x",  "outs",    "vec5",     "maximum"};
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i) accept(good[i]);
}

static void H4f_names_must_differ(void) {
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        prepare();
        world.options.features = 0;
        world.options.program = SPT_GLSL_HITS;
        world.names[i] = "u_same";
        CHECK(glsl_world_emit(&world) == SPT_OK);
        world.names[(i + 5) % SPT_GLSL_NAMES] = "u_same";
        CHECK(glsl_world_emit(&world) == SPT_BAD_ARGUMENT);
        world.names[(i + 5) % SPT_GLSL_NAMES] = "u_samE";
        CHECK(glsl_world_emit(&world) == SPT_OK);
    }
}

/* All parameters under other names: none of the default ones is left, all that the default text
 * declares is declared, and nothing else has changed. */
static void H4g_all_names_replaced(void) {
    static char names[SPT_GLSL_NAMES][24];
    for (uint32_t target = SPT_GLSL_FRAGMENT_330; target < SPT_GLSL_TARGETS; ++target) {
        int32_t functions, uniforms = 0, replaced = 0;
        prepare();
        world.options.target = target;
        world.options.program = target == SPT_GLSL_SHADERTOY ? SPT_GLSL_PICTURE : SPT_GLSL_HITS;
        world.options.features = SPT_GLSL_NORMAL | SPT_GLSL_PATH;
        if (target == SPT_GLSL_SHADERTOY) world.options.features = SPT_GLSL_NORMAL;
        check_context("target %u", (unsigned)target);
        if (!glsl_world_audit(&world, &text)) continue;
        functions = text.function_count;
        for (int32_t i = 0; i < text.name_count; ++i) {
            uniforms += (text.names[i].what & GLSL_IS_UNIFORM) != 0;
        }
        for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
            memcpy(names[i], "u_parameter_", 12);
            names[i][12] = (char)('a' + i);
            world.names[i] = names[i];
        }
        check_context("target %u renamed", (unsigned)target);
        if (!glsl_world_audit(&world, &text)) continue;
        CHECK(text.function_count == functions);
        for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
            CHECK(glsl_text_find(&text, spt_glsl_default_name(i)) < 0);
            replaced += (glsl_text_what(&text, names[i]) & GLSL_IS_UNIFORM) != 0;
        }
        CHECK_SAY(replaced == uniforms, "%d of %d", (int)replaced, (int)uniforms);
    }
}

/* A uniform named as something that the text declares inside would be hidden there, and a wrong
 * value read without a word: it must be refused. */
static void H4h_names_that_the_text_uses_inside(void) {
    static char inside[2048][32];
    size_t count = 0;
    prepare();
    world.options.features |= SPT_GLSL_REFINE | SPT_GLSL_OCCLUSION;
    if (!glsl_world_audit(&world, &text)) return;
    for (int32_t i = 0; i < text.name_count && count < 2048; ++i) {
        const glsl_name *const name = &text.names[i];
        if ((name->what & (GLSL_IS_LOCAL | GLSL_IS_MEMBER)) == 0 || name->size > 31) continue;
        memcpy(inside[count], name->first, name->size);
        inside[count++][name->size] = 0;
    }
    CHECK(count > 40);
    for (size_t i = 0; i < count; ++i) {
        if (strncmp(inside[i], "spt", 3) == 0) continue;
        prepare();
        world.options.features |= SPT_GLSL_REFINE | SPT_GLSL_OCCLUSION;
        world.names[SPT_GLSL_NAME_EPSILON] = inside[i];
        check_context("epsilon named %s", inside[i]);
        CHECK(spt_glsl_emit(&world.options, NULL, 0, NULL) == SPT_BAD_ARGUMENT);
    }
}

/* A name that is not used in this program is looked at all the same. */
static void H4i_names_of_what_is_not_used(void) {
    prepare();
    world.options.uniforms = 0;
    world.names[SPT_GLSL_NAME_TIME] = "sample";
    CHECK(glsl_world_emit(&world) == SPT_BAD_ARGUMENT);
    world.options.target = SPT_GLSL_LIBRARY;
    world.options.features = 0;
    CHECK(glsl_world_emit(&world) == SPT_BAD_ARGUMENT);
    world.names[SPT_GLSL_NAME_TIME] = "seconds";
    CHECK(glsl_world_emit(&world) == SPT_OK);
}

void suite_glsl_names(void) {
    RUN(H4a_reserved_words_are_no_names);
    RUN(H4b_names_of_the_language_are_no_names);
    RUN(H4c_names_that_break_the_grammar);
    RUN(H4d_our_own_prefixes);
    RUN(H4e_names_that_are_right);
    RUN(H4f_names_must_differ);
    RUN(H4g_all_names_replaced);
    RUN(H4h_names_that_the_text_uses_inside);
    RUN(H4i_names_of_what_is_not_used);
}
