/* SPDX-License-Identifier: MIT
 *
 * The engines themselves: that what goes in comes out where it should, that + - * / sqrt round as
 * they do in C, and that an error in a shader is seen. All other tests of shaders rest on this. */
#include "glsl_check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { count = 4096 };

static float random_float(void) {
    const float mantissa = (float)check_uniform(-2, 2);
    return ldexpf(mantissa, (int)check_uniform(-30, 30));
}

/* Four results of each: a value of one operation, and a chain that contraction would change. */
static void E1_rounds_like_c(void) {
    static float in[4 * count], out[4 * count];
    for (int i = 0; i < 4 * count; ++i) in[i] = random_float();
    CHECK(engine_values("",
                        "    precise float d = q[0].x * q[0].y;\n"
                        "    precise float s = d + q[0].z;\n"
                        "    r[0] = vec4(q[0].x / q[0].y, sqrt(abs(q[0].z)), s, q[0].x - q[0].w);",
                        count, 1, in, 1, out) == ENGINE_OK);
    for (int i = 0; i < count; ++i) {
        const float *q = &in[4 * i], product = q[0] * q[1];
        const float expected[4] = {q[0] / q[1], sqrtf(fabsf(q[2])), product + q[2], q[0] - q[3]};
        for (int k = 0; k < 4; ++k) {
            CHECK_SAY(check_same_bits(out[4 * i + k], expected[k]), "%d: %.9g for %.9g", k,
                      (double)out[4 * i + k], (double)expected[k]);
        }
    }
}

static void E2_points(void) {
    static float in[4 * count], out[count];
    for (int i = 0; i < 4 * count; ++i) in[i] = random_float();
    CHECK(engine_points("float twice(vec3 p) { return 2.0 * p.y; }", "twice(q.xyz) + q.w", count,
                        in, out) == ENGINE_OK);
    for (int i = 0; i < count; ++i) {
        CHECK(check_same_bits(out[i], 2.0f * in[4 * i + 1] + in[4 * i + 3]));
    }
}

/* ---- Fragments ------------------------------------------------------------------------------ */

enum { width = 13, height = 7, size = 4 * width * height };

static const char es_head[] = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                              "precision highp sampler2D;\n";

static const char fragment_body[] =
    "uniform sampler2D first, second;\n"
    "uniform int a; uniform ivec2 b; uniform float c; uniform vec2 d; uniform vec3 e;\n"
    "uniform vec4 f;\n"
    "layout(location = 0) out vec4 one;\n"
    "layout(location = 1) out vec4 two;\n"
    "layout(location = 2) out vec4 three;\n"
    "void main() {\n"
    "    ivec2 pixel = ivec2(gl_FragCoord.xy);\n"
    "    one = texelFetch(first, pixel, 0);\n"
    "    two = texelFetch(second, pixel, 0) * f;\n"
    "    three = vec4(float(a + b.x + b.y), c + d.x + d.y, e.x + e.y + e.z, 1.0);\n"
    "    gl_FragDepth = (gl_FragCoord.x + gl_FragCoord.y) / 64.0;\n"
    "}\n";

static const engine_uniform fragment_uniforms[] = {
    {"a", ENGINE_INT, {1, 0, 0, 0}},       {"b", ENGINE_IVEC2, {10, 100, 0, 0}},
    {"c", ENGINE_FLOAT, {0.5f, 0, 0, 0}},  {"d", ENGINE_VEC2, {0.25f, 2, 0, 0}},
    {"e", ENGINE_VEC3, {3, 0.125f, 4, 0}}, {"f", ENGINE_VEC4, {1, 2, 4, 8}},
    {"absent", ENGINE_FLOAT, {1, 0, 0, 0}}};

static float first[size], second[size], outs[3][size], depth[width * height];

/* New inputs for fragment_body, and NaN where results will be. */
static engine_fragment draw_fragment(engine_context context, const char *shader) {
    static const engine_texture textures[] = {{"first", width, height, first},
                                              {"second", width, height, second}};
    const engine_fragment run = {.context = context,
                                 .shader = shader,
                                 .width = width,
                                 .height = height,
                                 .textures = textures,
                                 .texture_count = 2,
                                 .uniforms = fragment_uniforms,
                                 .uniform_count = 7,
                                 .out = {outs[0], outs[1], outs[2]},
                                 .depth = depth};
    for (int i = 0; i < size; ++i) {
        first[i] = random_float();
        second[i] = random_float();
        for (int k = 0; k < 3; ++k) outs[k][i] = NAN;
    }
    return run;
}

/* Rows and columns, both textures, every type of uniform and all attachments are where they
 * belong. */
static void check_fragment(void) {
    for (int i = 0; i < width * height; ++i) {
        for (int k = 0; k < 4; ++k) {
            CHECK(check_same_bits(outs[0][4 * i + k], first[4 * i + k]));
            CHECK(check_same_bits(outs[1][4 * i + k], second[4 * i + k] * (float)(1 << k)));
        }
        CHECK(outs[2][4 * i] == 111 && outs[2][4 * i + 1] == 2.75f && outs[2][4 * i + 2] == 7.125f);
    }
}

static void E3_fragments(void) {
    static const char *const heads[] = {"#version 330 core\n", es_head};
    for (int i = 0; i < 2; ++i) {
        char shader[2048];
        strcpy(shader, heads[i]);
        strcat(shader, fragment_body);
        const engine_fragment run = draw_fragment(i == 0 ? ENGINE_GL_45 : ENGINE_ES_32, shader);
        check_context("%.14s", heads[i]);
        CHECK(engine_gl_fragment(&run) == ENGINE_OK);
        check_fragment();
        for (int k = 0; k < width * height; ++k) {
            CHECK(depth[k] == (float)(k % width + k / width + 1) / 64);
        }
    }
}

/* ---- Compute -------------------------------------------------------------------------------- */

static const char compute_body[] =
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(std430, binding = 0) readonly buffer In { vec4 a[]; };\n"
    "layout(std430, binding = 1) writeonly buffer Out { vec4 b[]; };\n"
    "uniform ivec2 size; uniform vec3 scale;\n"
    "void main() {\n"
    "    ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
    "    if (at.x >= size.x || at.y >= size.y) return;\n"
    "    int i = at.x + at.y * size.x;\n"
    "    b[i] = vec4(a[2 * i].xyz * scale, a[2 * i + 1].w);\n"
    "}\n";

static void check_compute(engine_context context, const char *head) {
    enum { columns = 19, rows = 11, all = columns * rows };
    static float in[8 * all], out[4 * all + 4];
    char shader[2048];
    for (int i = 0; i < 8 * all; ++i) in[i] = random_float();
    const engine_uniform uniforms[] = {{"size", ENGINE_IVEC2, {columns, rows, 0, 0}},
                                       {"scale", ENGINE_VEC3, {2, 4, 8, 0}}};
    strcpy(shader, head);
    strcat(shader, compute_body);
    const engine_compute run = {context, shader, columns,     rows,     in,
                                8 * all, out,    4 * all + 4, uniforms, 2};
    CHECK(engine_gl_compute(&run) == ENGINE_OK);
    for (int i = 0; i < all; ++i) {
        for (int k = 0; k < 3; ++k) {
            CHECK(check_same_bits(out[4 * i + k], in[8 * i + k] * (float)(2 << k)));
        }
        CHECK(check_same_bits(out[4 * i + 3], in[8 * i + 7]));
    }
    for (int k = 0; k < 4; ++k) CHECK(isnan(out[4 * all + k])); /* nothing was written behind */
}

static void E4_compute(void) {
    check_context("430");
    check_compute(ENGINE_GL_45, "#version 430 core\n");
    check_context("450");
    check_compute(ENGINE_GL_45, "#version 450 core\n");
    check_context("310 es");
    check_compute(ENGINE_ES_32, "#version 310 es\n#extension GL_EXT_gpu_shader5 : require\n"
                                "precision highp float;\nprecision highp int;\n");
}

static const char vulkan_shader[] =
    "#version 450\n"
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(std430, set = 0, binding = 0) readonly buffer In { vec4 a[]; };\n"
    "layout(std430, set = 0, binding = 1) writeonly buffer Out { vec4 b[]; };\n"
    "layout(push_constant) uniform Push { ivec2 size; int one; float two; vec3 scale; vec2 more;\n"
    "    vec4 last; };\n"
    "void main() {\n"
    "    ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
    "    if (at.x >= size.x || at.y >= size.y) return;\n"
    "    int i = at.x + at.y * size.x;\n"
    "    b[i] = vec4(a[i].xyz * scale, two + float(one) + more.x * more.y * last.w);\n"
    "}\n";

/* Push constants are where the layout has them. */
static void E5_errors_are_seen(void) {
    static const char good[] = "#version 330 core\nout vec4 o;\nvoid main() { o = vec4(1.0); }\n";
    static const char bad[] =
        "#version 330 core\nout vec4 o;\nvoid main() { o = spt_gone(1.0); }\n";
    static const char undefined[] =
        "#version 330 core\nout vec4 o;\nfloat f(float x);\nvoid main() { o = vec4(f(1.0)); }\n";
    CHECK(engine_gl_compiles(ENGINE_GL_45, 0, good) == ENGINE_OK);
    CHECK(engine_gl_compiles(ENGINE_GL_45, 0, bad) == ENGINE_FAILED);
    CHECK(engine_gl_compiles(ENGINE_GL_45, 0, undefined) == ENGINE_FAILED);
    CHECK(engine_gl_compiles(ENGINE_ES_32, 0, good) == ENGINE_FAILED);
}

static void check_vulkan(void) {
    enum { columns = 19, rows = 11, all = columns * rows };
    static float in[4 * all], out[4 * all];
    const engine_uniform uniforms[] = {
        {"size", ENGINE_IVEC2, {columns, rows, 0, 0}}, {"one", ENGINE_INT, {3, 0, 0, 0}},
        {"two", ENGINE_FLOAT, {0.5f, 0, 0, 0}},        {"scale", ENGINE_VEC3, {2, 4, 8, 0}},
        {"more", ENGINE_VEC2, {16, 4, 0, 0}},          {"last", ENGINE_VEC4, {0, 0, 0, 2}}};
    for (int compiler = 0; compiler < ENGINE_COMPILERS; ++compiler) {
        const engine_compute run = {ENGINE_GL_45, vulkan_shader, columns, rows,     in,
                                    4 * all,      out,           4 * all, uniforms, 6};
        for (int i = 0; i < 4 * all; ++i) in[i] = random_float();
        const int status = engine_vulkan_compute(&run, (engine_compiler)compiler);
        if (!engine_here(status, compiler == 0 ? "no glslangValidator" : "no glslc")) continue;
        CHECK(status == ENGINE_OK);
        for (int i = 0; i < all; ++i) {
            for (int k = 0; k < 3; ++k) {
                CHECK(check_same_bits(out[4 * i + k], in[4 * i + k] * (float)(2 << k)));
            }
            CHECK(out[4 * i + 3] == 131.5f);
        }
    }
}

static void E6_vulkan(void) {
    static const char *const missing[ENGINE_DEVICES] = {"no lavapipe (mesa-vulkan-drivers)",
                                                        "no SwiftShader (chromium)"};
    for (int device = 0; device < ENGINE_DEVICES; ++device) {
        if (!engine_here(engine_vulkan_use((engine_device)device), missing[device])) continue;
        check_context("%s", engine_vulkan_name());
        check_vulkan();
    }
}

/* In one page: both textures and a shader that is wrong, which takes nothing from the others. */
static void check_browser(engine_browser browser) {
    char shader[2048], wrong[2048];
    int statuses[3];
    strcpy(shader, es_head);
    strcat(shader, fragment_body);
    strcpy(wrong, es_head);
    strcat(wrong, "out vec4 o;\nvoid main() { o = vec4(spt_gone(1 < 2), \"\\\"); }\n");
    engine_fragment runs[3];
    runs[0] = runs[1] = runs[2] = draw_fragment(ENGINE_ES_32, shader);
    runs[1].shader = wrong;
    runs[1].quiet = 1;
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k) runs[i].out[k] = NULL;
    }
    static float other[size];
    runs[0].out[0] = other;
    const int status = engine_browser_fragments(browser, 3, runs, statuses);
    if (!engine_here(status, "no Chromium with WebGL 2 on the processor")) return;
    CHECK(status == ENGINE_OK);
    CHECK(statuses[0] == ENGINE_OK && statuses[1] == ENGINE_FAILED && statuses[2] == ENGINE_OK);
    CHECK(memcmp(other, first, sizeof other) == 0);
    check_fragment();
    printf("browser: %s\n", engine_browser_name());
}

static void E7_browser(void) {
    check_browser(ENGINE_SWIFTSHADER);
    check_browser(ENGINE_ANGLE_LLVMPIPE);
}

void suite_engines(void) {
    RUN(E1_rounds_like_c);
    RUN(E2_points);
    RUN(E3_fragments);
    RUN(E4_compute);
    RUN(E5_errors_are_seen);
    RUN(E6_vulkan);
    RUN(E7_browser);
}
