/* SPDX-License-Identifier: MIT
 *
 * Faults of names in emitted shaders that were found and mended: the time of callers' texts in each
 * target, long names, and where Vulkan's parameters are. Left out: tracing (test_found_glsl.c). */
#include "glsl_check.h"
#include "glsl_written.h"

#include <spheretrace/spheretrace.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 40 };

static float plane(void *user, float x, float y, float z) {
    (void)user, (void)y, (void)z;
    return x;
}

static spt_field plane_field(const char *text) {
    spt_field field = spt_field_default();
    field.point = plane;
    field.glsl = text;
    return field;
}

static spt_camera some_camera(void) {
    static const float eye[3] = {2, 1.5f, -4}, middle[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    spt_camera camera;
    CHECK(spt_camera_pinhole(&camera, eye, middle, up, 0.5f, WIDTH, HEIGHT) == SPT_OK);
    return camera;
}

/* ---- Asking for distances ------------------------------------------------------------------ */

static const char *const target_names[SPT_GLSL_TARGETS] = {"library", "330", "300 es", "Shadertoy",
                                                           "310 es",  "430", "450",    "Vulkan"};

/* Where fields are asked. */
enum { PLACE_COUNT = 4 };
static const float places[PLACE_COUNT][4] = {
    {0.5f, 0, 0, 0}, {-2, 1, 1, 0}, {3.25f, 0, 2, 0}, {0, 0, 0, 0}};

/* A library in the shader of a host that defines what stands in `host`. */
static int ask_library(const char *text, const char *host, float out[PLACE_COUNT]) {
    char *const all = joined(host, text, "");
    const int status = engine_points(all, "spt_map(q.xyz)", PLACE_COUNT, places[0], out);
    free(all);
    return status;
}

/* Within Shadertoy's prologue; the main of this one shows distances. */
static int ask_shadertoy(const char *text, float time, float out[PLACE_COUNT]) {
    static const char before[] = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                                 "uniform vec3 iResolution;\nuniform float iTime;\n"
                                 "uniform int iFrame;\nout vec4 siteColour;\n";
    static const char after[] = "void main() {\n    vec4 colour;\n"
                                "    mainImage(colour, gl_FragCoord.xy);\n"
                                "    float x = iResolution.x > 0.0 ? colour.a : 1.0;\n"
                                "    siteColour = x * vec4(spt_map(vec3(0.5, 0.0, 0.0)), "
                                "spt_map(vec3(-2.0, 1.0, 1.0)),\n"
                                "        spt_map(vec3(3.25, 0.0, 2.0)), spt_map(vec3(0.0)));\n}\n";
    char *const all = joined(before, text, after);
    const engine_uniform uniforms[] = {{"iResolution", ENGINE_VEC3, {1, 1, 1, 0}},
                                       {"iTime", ENGINE_FLOAT, {time, 0, 0, 0}}};
    const engine_fragment run = {.context = ENGINE_ES_32,
                                 .shader = all,
                                 .width = 1,
                                 .height = 1,
                                 .uniforms = uniforms,
                                 .uniform_count = 2,
                                 .out = {out}};
    const int status = engine_gl_fragment(&run);
    free(all);
    return status;
}

/* A program of POINTS. */
static int ask_points(const spt_glsl_options *options, const char *text, const char *name,
                      float time, float out[PLACE_COUNT]) {
    static float found[4 * PLACE_COUNT];
    const uint32_t target = options->target;
    const engine_context context =
        target == SPT_GLSL_FRAGMENT_300_ES || target == SPT_GLSL_COMPUTE_310_ES ? ENGINE_ES_32
                                                                                : ENGINE_GL_45;
    /* Vulkan has what is asked for, in this order. */
    const engine_uniform uniforms[] = {{"spt_size", ENGINE_IVEC2, {PLACE_COUNT, 1, 0, 0}},
                                       {"spt_budget", ENGINE_INT, {1, 0, 0, 0}},
                                       {name, ENGINE_FLOAT, {time, 0, 0, 0}}};
    const int count = (options->uniforms >> SPT_GLSL_NAME_TIME & 1) ? 3 : 2;
    int status;
    if (target == SPT_GLSL_FRAGMENT_330 || target == SPT_GLSL_FRAGMENT_300_ES) {
        const engine_texture texture = {"spt_ray_origin", PLACE_COUNT, 1, places[0]};
        const engine_fragment run = {.context = context,
                                     .shader = text,
                                     .width = PLACE_COUNT,
                                     .height = 1,
                                     .textures = &texture,
                                     .texture_count = 1,
                                     .uniforms = uniforms,
                                     .uniform_count = count,
                                     .out = {found}};
        status = engine_gl_fragment(&run);
    } else {
        const engine_compute run = {context,           text,  PLACE_COUNT,     1,        places[0],
                                    sizeof places / 4, found, 4 * PLACE_COUNT, uniforms, count};
        status = target == SPT_GLSL_VULKAN_450 ? engine_vulkan_compute(&run, ENGINE_GLSLANG)
                                               : engine_gl_compute(&run);
    }
    for (int i = 0; i < PLACE_COUNT; ++i) out[i] = found[4 * i];
    return status;
}

/* A caller's text that adds the time by its name: distances are x + time. */
static void check_time(uint32_t target, const char *own_name, uint32_t uniforms) {
    const char *names[SPT_GLSL_NAMES] = {NULL};
    const char *const name = own_name != NULL ? own_name : "spt_time";
    char body[128], host[128];
    float out[PLACE_COUNT] = {0};
    spt_settings settings = spt_settings_default();
    const spt_camera camera = some_camera();
    snprintf(body, sizeof body, "return p.x + %s;", name);
    snprintf(host, sizeof host, uniforms ? "#define %s 0.25\n" : "// %s\n", name);
    const spt_field field = plane_field(body);
    spt_glsl_options options = spt_glsl_options_default();
    options.field = &field;
    options.settings = &settings;
    names[SPT_GLSL_NAME_TIME] = own_name;
    options.names = names;
    options.camera = &camera;
    options.target = target;
    options.program = target == SPT_GLSL_SHADERTOY ? SPT_GLSL_PICTURE : SPT_GLSL_POINTS;
    options.uniforms = uniforms;
    check_context("%s, %s, %s", target_names[target], name, uniforms ? "uniform" : "no uniform");
    char *const text = written(&options);
    if (text == NULL) return;
    const int status = target == SPT_GLSL_LIBRARY ? ask_library(text, host, out)
                       : target == SPT_GLSL_SHADERTOY
                           ? ask_shadertoy(text, 0.25f, out)
                           : ask_points(&options, text, name, 0.25f, out);
    free(text);
    if (!engine_here(status, "no lavapipe or glslangValidator")) return;
    CHECK(status == ENGINE_OK);
    const float time = uniforms || target == SPT_GLSL_SHADERTOY ? 0.25f : 0.0f;
    for (int i = 0; i < PLACE_COUNT; ++i) {
        CHECK_SAY(out[i] == places[i][0] + time, "at %g: %g", (double)places[i][0], (double)out[i]);
    }
}

static void T0_time(void) {
    const uint32_t bit = 1u << SPT_GLSL_NAME_TIME;
    const int vulkan = engine_here(engine_vulkan_open(), "no lavapipe (mesa-vulkan-drivers)");
    for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
        if (target == SPT_GLSL_VULKAN_450 && !vulkan) continue;
        check_time(target, NULL, 0);
        check_time(target, NULL, bit);
    }
}

/* The longest name that glsl.h allows, and one more. */
static void T1_long_name(void) {
    const char *names[SPT_GLSL_NAMES] = {NULL};
    char name[66];
    memset(name, 'q', sizeof name);
    for (int length = 63; length <= 64; ++length) {
        name[length] = '\0';
        check_time(SPT_GLSL_COMPUTE_450, name, 1u << SPT_GLSL_NAME_TIME);
        check_time(SPT_GLSL_FRAGMENT_330, name, 1u << SPT_GLSL_NAME_TIME);
        name[length] = 'q';
    }
    name[65] = '\0';
    const spt_field field = plane_field("return p.x;");
    const spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    options.field = &field;
    options.settings = &settings;
    names[SPT_GLSL_NAME_TIME] = name;
    options.names = names;
    options.uniforms = 1u << SPT_GLSL_NAME_TIME;
    CHECK(spt_glsl_emit(&options, NULL, 0, NULL) == SPT_BAD_ARGUMENT);
}

/* ---- Vulkan's block ------------------------------------------------------------------------- */

/* The members of the block of push constants, as declared. */
static void block_of(uint32_t program, const spt_method *method, uint32_t uniforms, char *block,
                     size_t size) {
    const spt_camera camera = some_camera();
    const spt_field field = plane_field("return p.x;");
    spt_settings settings = spt_settings_default();
    settings.method = method;
    spt_glsl_options options = spt_glsl_options_default();
    options.field = &field;
    options.settings = &settings;
    options.camera = &camera;
    options.target = SPT_GLSL_VULKAN_450;
    options.program = program;
    options.uniforms = uniforms;
    char *const text = written(&options);
    const char *const begin = text == NULL ? NULL : strstr(text, "layout(push_constant)");
    const char *const end = begin == NULL ? NULL : strstr(begin, "};");
    CHECK(end != NULL);
    snprintf(block, size, "%.*s", end == NULL ? 0 : (int)(end - begin), end == NULL ? "" : begin);
    free(text);
}

/* Bytes of such a block by the rules of std430; -1 with a type that is not known here. */
static int bytes_of(const char *block) {
    static const struct {
        const char *name;
        int align, size;
    } types[] = {{"int", 4, 4},  {"float", 4, 4},  {"ivec2", 8, 8},
                 {"vec2", 8, 8}, {"vec3", 16, 12}, {"vec4", 16, 16}};
    int bytes = 0;
    for (const char *line = strstr(block, "\n    "); line != NULL;
         line = strstr(line + 1, "\n    ")) {
        size_t k = 0;
        const size_t length = strcspn(line + 5, " ");
        while (k < sizeof types / sizeof types[0] &&
               (strlen(types[k].name) != length || memcmp(types[k].name, line + 5, length) != 0)) {
            ++k;
        }
        if (k == sizeof types / sizeof types[0]) return -1;
        bytes = (bytes + types[k].align - 1) / types[k].align * types[k].align + types[k].size;
    }
    return bytes;
}

/* Where a member is depends on what was asked for, not on what the step rule reads; and all of them
 * fit into what each implementation of Vulkan has. */
static void T2_block(void) {
    static const uint32_t programs[] = {SPT_GLSL_HITS, SPT_GLSL_POINTS, SPT_GLSL_CONES};
    static const uint32_t sets[] = {0, 1u << SPT_GLSL_NAME_STEP_CAP | 1u << SPT_GLSL_NAME_TIME,
                                    (1u << SPT_GLSL_NAMES) - 1};
    static char basic[2048], adaptive[2048];
    for (int i = 0; i < 9; ++i) {
        check_context("program %u, uniforms %x", (unsigned)programs[i / 3], (unsigned)sets[i % 3]);
        block_of(programs[i / 3], spt_basic(), sets[i % 3], basic, sizeof basic);
        block_of(programs[i / 3], spt_adaptive(), sets[i % 3], adaptive, sizeof adaptive);
        CHECK_SAY(strcmp(basic, adaptive) == 0, "\n%s\n%s", basic, adaptive);
        const int bytes = bytes_of(basic);
        CHECK_SAY(bytes >= 12 && bytes <= 128, "%d bytes", bytes);
    }
    CHECK(strstr(basic, "vec4 spt_window;") != NULL && strstr(basic, "float spt_epsilon;") != NULL);
    block_of(SPT_GLSL_HITS, spt_basic(), sets[1], basic, sizeof basic);
    CHECK(strstr(basic, "float spt_step_cap;\n    float spt_time;") != NULL);
}

void suite_found_names_glsl(void) {
    RUN(T0_time);
    RUN(T1_long_name);
    RUN(T2_block);
}
