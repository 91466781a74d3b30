/* SPDX-License-Identifier: MIT
 *
 * Writes every combination of step rule, feature, target and program as a shader of its own into a
 * folder, for validators to read, and a table of how long each is: usage: glsl_matrix FOLDER.
 * Fails where a combination that glsl.h allows is refused, where a function is written that main()
 * does not reach, or where a name is not the library's. */
#include "glsl_graph.h"
#include "glsl_scenes.h"
#include "rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- What is legal, by glsl.h --------------------------------------------------------------- */

/* Features of the traced path, of any target and of programs that trace. */
#define TRACED \
    (SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE | SPT_GLSL_COMPONENT | SPT_GLSL_PATH | \
     SPT_GLSL_NORMAL | SPT_GLSL_REFINE)

static const struct {
    const char *name, *ending;
    uint32_t programs; /* bits */
    int starts;        /* whether it reads what CONES wrote */
} targets[SPT_GLSL_TARGETS] = {
    {"library", "frag", 1u << SPT_GLSL_HITS, 0},
    {"330", "frag", 15, 1},
    {"300es", "frag", 15, 1},
    {"shadertoy", "frag", 1u << SPT_GLSL_PICTURE, 0},
    {"310es", "comp", 14, 1},
    {"430", "comp", 14, 1},
    {"450", "comp", 14, 1},
    {"vulkan", "vulkan.comp", 14, 0},
};
static const char *const program_names[SPT_GLSL_PROGRAMS] = {"picture", "hits", "points", "cones"};
static const char *const feature_names[] = {
    "guards", "flags",  "candidate", "fallbacks", "component", "path",
    "normal", "refine", "offset",    "shadow",    "occlusion", "convex",
    "binary", "starts", "depth",     "arrays",    "merged",    "place"};
enum { feature_count = sizeof feature_names / sizeof feature_names[0] };

/* All that can be asked for together, of a subject by a target and a program. */
static uint32_t features_of(const glsl_subject *subject, uint32_t target, uint32_t program) {
    const uint32_t scene = subject->scene != NULL ? SPT_GLSL_MERGED : 0;
    const uint32_t model = (subject->traits & GLSL_MODEL) != 0 ? SPT_GLSL_ARRAYS : 0;
    const uint32_t light = SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION;
    const uint32_t place = model != 0 ? SPT_GLSL_PLACE : 0;
    const uint32_t starts = targets[target].starts ? SPT_GLSL_STARTS : 0;
    if (target == SPT_GLSL_LIBRARY) {
        return TRACED | SPT_GLSL_FALLBACKS | SPT_GLSL_OFFSET | light | model | place | scene;
    }
    switch (program) {
    case SPT_GLSL_PICTURE:
        return TRACED | light | SPT_GLSL_DEPTH_WRITE | starts | model | scene;
    case SPT_GLSL_HITS:
        return TRACED | SPT_GLSL_FALLBACKS | starts | model | place | scene;
    case SPT_GLSL_POINTS:
        return model | scene;
    default:
        return SPT_GLSL_GUARDS | model | scene;
    }
}

/* ---- One shader ----------------------------------------------------------------------------- */

static struct {
    const char *folder;
    FILE *table;
    int shaders, failures;
} work;

static spt_camera camera;

static void fail(const char *name, const char *why, const char *detail) {
    printf("%s: %s%s\n", name, why, detail);
    ++work.failures;
}

static void write_file(const char *name, const char *ending, const char *before, const char *text,
                       const char *after) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.%s", work.folder, name, ending);
    FILE *file = fopen(path, "wb");
    if (file == NULL || fprintf(file, "%s%s%s", before, text, after) < 0 || fclose(file) != 0) {
        fail(name, "cannot be written", "");
    }
}

/* A library in the shaders of hosts: what it is asked for is called from main(). */
static void write_library(const char *name, const char *text) {
    static const char main_text[] = "void main() {\n"
                                    "    SptRay ray;\n"
                                    "    ray.origin = vec3(gl_FragCoord.xy, -3.0);\n"
                                    "    ray.t_min = 0.0;\n"
                                    "    ray.direction = vec3(0.0, 0.0, 1.0);\n"
                                    "    ray.t_max = 10.0;\n"
                                    "    host_out = vec4(%s(ray, host_budget).t);\n"
                                    "}\n";
    static const char desktop[] =
        "#version 330 core\nuniform int host_budget;\nout vec4 host_out;\n";
    static const char es[] = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                             "uniform int host_budget;\nout vec4 host_out;\n";
    static const char newer[] =
        "#version 450\nuniform int host_budget;\nlayout(location = 0) out vec4 host_out;\n";
    static const char *const versions[] = {desktop, es, newer};
    static const char *const names[] = {"330", "300es", "450"};
    const char *trace = strstr(text, "spt_trace_convex(SptRay") != NULL   ? "spt_trace_convex"
                        : strstr(text, "spt_binary_trace(SptRay") != NULL ? "spt_binary_trace"
                                                                          : "spt_trace";
    for (int i = 0; i < 3; ++i) {
        char file[512], after[1024];
        snprintf(file, sizeof file, "%s_in_%s", name, names[i]);
        snprintf(after, sizeof after, main_text, trace);
        write_file(file, "frag", versions[i], text, after);
    }
}

static const char shadertoy_prologue[] =
    "#version 300 es\n"
    "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
    "uniform vec3 iResolution;\nuniform float iTime;\nuniform float iTimeDelta;\n"
    "uniform float iFrameRate;\nuniform int iFrame;\nuniform float iChannelTime[4];\n"
    "uniform vec3 iChannelResolution[4];\nuniform vec4 iMouse;\nuniform vec4 iDate;\n"
    "uniform sampler2D iChannel0;\nuniform sampler2D iChannel1;\nuniform sampler2D iChannel2;\n"
    "uniform sampler2D iChannel3;\nout vec4 siteColour;\n";
static const char shadertoy_main[] =
    "void main() {\n    vec4 colour = vec4(0.0);\n    mainImage(colour, gl_FragCoord.xy);\n"
    "    siteColour = colour;\n}\n";

static void check_text(const char *name, const char *text, uint32_t target) {
    static const char library[] =
        "spt_map spt_trace spt_trace_convex spt_binary_trace spt_normal spt_hit_normal spt_refine "
        "spt_offset spt_offset_checked spt_soft_shadow spt_ambient_occlusion spt_material "
        "spt_kernel_at";
    static glsl_graph graph;
    const char *const roots = target == SPT_GLSL_LIBRARY     ? library
                              : target == SPT_GLSL_SHADERTOY ? "mainImage"
                                                             : "main";
    char unwanted[128];
    glsl_graph_read(&graph, text);
    fprintf(work.table, "%-60s %5d lines %4d functions\n", name, graph.lines, graph.count);
    if (glsl_graph_dead(&graph, roots, unwanted)) fail(name, "nothing calls ", unwanted);
    if (glsl_graph_stranger(&graph, unwanted)) fail(name, "the name of others: ", unwanted);
}

static void emit(const char *name, const spt_glsl_options *options) {
    size_t length = 0;
    spt_status status = spt_glsl_emit(options, NULL, 0, &length);
    char *text = status == SPT_BUFFER_TOO_SMALL ? malloc(length + 1) : NULL;
    if (text != NULL) status = spt_glsl_emit(options, text, length + 1, NULL);
    if (status != SPT_OK || text == NULL) {
        fail(name, "is refused", "");
    } else {
        ++work.shaders;
        check_text(name, text, options->target);
        if (options->target == SPT_GLSL_LIBRARY) {
            write_library(name, text);
        } else if (options->target == SPT_GLSL_SHADERTOY) {
            write_file(name, "frag", shadertoy_prologue, text, shadertoy_main);
        } else {
            write_file(name, targets[options->target].ending, "", text, "");
        }
    }
    free(text);
}

/* ---- All of them ---------------------------------------------------------------------------- */

/* What varies beside the features. */
typedef struct variant {
    const glsl_subject *subject;
    const spt_method *method;
    uint32_t target, program, flags;
    int uniforms; /* everything that can be one is */
} variant;

static void emit_features(const variant *one, uint32_t features, const char *label) {
    spt_settings settings = spt_settings_default();
    spt_glsl_options options = spt_glsl_options_default();
    char name[256];
    settings.method = one->method;
    settings.pixel_radius = 1e-3f;
    settings.flags = one->flags;
    options.field = one->subject->field;
    options.scene = one->subject->scene;
    options.settings = &settings;
    options.camera = &camera;
    options.target = one->target;
    options.program = one->program;
    options.features = features;
    options.uniforms = one->uniforms ? (1u << SPT_GLSL_NAMES) - 1 : 0;
    snprintf(name, sizeof name, "%s_%s_%s_%s_%s%s", one->subject->name,
             spt_method_name(one->method), targets[one->target].name, program_names[one->program],
             label, one->uniforms ? "_uniforms" : "");
    for (char *at = name; *at != '\0'; ++at) *at = *at == ' ' ? '-' : *at;
    emit(name, &options);
}

/* None, each alone, all; and those that go with few others. */
static void emit_sets(const variant *one, int each) {
    const uint32_t all = features_of(one->subject, one->target, one->program);
    const spt_field *field = one->subject->field;
    const int brief = !each && one->target == SPT_GLSL_VULKAN_450; /* its validators are slow */
    const int traces = one->target == SPT_GLSL_LIBRARY || one->program == SPT_GLSL_HITS ||
                       one->program == SPT_GLSL_PICTURE;
    if (!brief || all == 0) emit_features(one, 0, "none");
    for (int feature = 0; each && feature < feature_count; ++feature) {
        if ((all >> feature & 1) == 0) continue;
        emit_features(one, 1u << feature, feature_names[feature]);
    }
    if (all != 0) emit_features(one, all, "all");
    if (traces && field != NULL && one->flags == 0 && !brief) {
        emit_features(one, SPT_GLSL_BINARY | (all & (SPT_GLSL_GUARDS | SPT_GLSL_NORMAL)), "binary");
        if (field->bound != NULL) {
            emit_features(one, SPT_GLSL_CONVEX | (all & (SPT_GLSL_GUARDS | SPT_GLSL_NORMAL)),
                          "convex");
        }
    }
}

/* Every step rule with every feature, target and program; of one subject. */
static void emit_rules(const char *subject) {
    for (int method = 0; method < rule_count; ++method) {
        for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
            for (uint32_t program = 0; program < SPT_GLSL_PROGRAMS; ++program) {
                const variant one = {
                    glsl_subject_named(subject), rules[method].method(), target, program, 0, 0};
                if ((targets[target].programs >> program & 1) != 0) emit_sets(&one, 1);
            }
        }
    }
}

/* Every subject with one step rule, every target and program. */
static void emit_subjects(void) {
    int count;
    const glsl_subject *all = glsl_subjects(&count);
    for (int i = 0; i < count; ++i) {
        for (uint32_t target = 0; target < SPT_GLSL_TARGETS; ++target) {
            for (uint32_t program = 0; program < SPT_GLSL_PROGRAMS; ++program) {
                const variant one = {&all[i], rules[(i + (int)target) % 5].method(),
                                     target,  program,
                                     0,       (i + (int)program) % 2};
                if ((targets[target].programs >> program & 1) != 0) emit_sets(&one, 0);
            }
        }
    }
}

/* What settings.flags change, with everything else and with nothing. */
static void emit_flags(const char *subject) {
    static const uint32_t flags[] = {SPT_SKIP_START, SPT_STOP_INSIDE, SPT_CANDIDATE_PENUMBRA,
                                     SPT_SKIP_START | SPT_STOP_INSIDE | SPT_CANDIDATE_PENUMBRA};
    static const char *const names[] = {"skip", "stop", "penumbra", "all-flags"};
    for (int method = 0; method < rule_count; ++method) {
        for (int i = 0; i < 4; ++i) {
            for (uint32_t target = SPT_GLSL_FRAGMENT_330; target < SPT_GLSL_TARGETS; ++target) {
                const variant one = {glsl_subject_named(subject),
                                     rules[method].method(),
                                     target,
                                     SPT_GLSL_HITS,
                                     flags[i],
                                     0};
                char label[64];
                if (target == SPT_GLSL_SHADERTOY) continue;
                snprintf(label, sizeof label, "%s", names[i]);
                if (target != SPT_GLSL_VULKAN_450) emit_features(&one, 0, label);
                snprintf(label, sizeof label, "%s_all", names[i]);
                emit_features(&one, features_of(one.subject, target, SPT_GLSL_HITS), label);
            }
        }
    }
}

int main(int count, char **arguments) {
    static const float eye[3] = {2, 1.5f, -4}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    char path[1024];
    if (count != 2) {
        fprintf(stderr, "usage: glsl_matrix FOLDER\n");
        return 2;
    }
    work.folder = arguments[1];
    snprintf(path, sizeof path, "%s/table.txt", work.folder);
    work.table = fopen(path, "w");
    if (work.table == NULL ||
        spt_camera_pinhole(&camera, eye, target, up, 0.5f, 640, 400) != SPT_OK) {
        printf("%s cannot be written\n", path);
        return 1;
    }
    emit_rules("sphere");
    emit_flags("in a sphere");
    emit_subjects();
    fclose(work.table);
    printf("%d shaders, %d failures\n", work.shaders, work.failures);
    return work.failures != 0;
}
