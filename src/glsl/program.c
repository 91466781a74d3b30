/* SPDX-License-Identifier: MIT
 *
 * What stands before and behind the functions: the version, where data comes from, and main(). */
#include "program.h"

#include "../base/arguments.h"
#include "parameters.h"

/* ---- Before --------------------------------------------------------------------------------- */

static int is_compute(const spti_glsl *out) {
    return out->options->target >= SPT_GLSL_COMPUTE_310_ES;
}

static const char es_precision[] = "precision highp float;\n"
                                   "precision highp int;\n"
                                   "precision highp sampler2D;\n";

static void write_version(spti_glsl *out) {
    switch (out->options->target) {
    case SPT_GLSL_FRAGMENT_330:
        spti_glsl_put(out, "#version 330 core\n");
        break;
    case SPT_GLSL_FRAGMENT_300_ES:
        spti_glsl_put(out, "#version 300 es\n");
        break;
    case SPT_GLSL_COMPUTE_310_ES:
        spti_glsl_put(out, "#version 310 es\n#extension GL_EXT_gpu_shader5 : require\n");
        break;
    case SPT_GLSL_COMPUTE_430:
        spti_glsl_put(out, "#version 430 core\n");
        break;
    case SPT_GLSL_COMPUTE_450:
    case SPT_GLSL_VULKAN_450:
        spti_glsl_put(out, "#version 450\n");
        break;
    default:
        break;
    }
    spti_glsl_put(out, "// libspheretrace " SPTI_TEXT(SPT_VERSION_MAJOR) "." SPTI_TEXT(
                           SPT_VERSION_MINOR) "." SPTI_TEXT(SPT_VERSION_PATCH) "\n");
    if (out->options->target == SPT_GLSL_FRAGMENT_300_ES ||
        out->options->target == SPT_GLSL_COMPUTE_310_ES) {
        spti_glsl_put(out, es_precision);
    }
}

/* How many vec4 a hit is: the second holds component, flags and candidate, the third normal and
 * fallbacks; without the second there is no third in its place. */
static int has_second(const spti_glsl *out) {
    return (out->conditions & (SPTI_GLSL_BIT(component) | SPTI_GLSL_BIT(flags) |
                               SPTI_GLSL_BIT(candidate) | SPTI_GLSL_BIT(place))) != 0;
}

static int has_third(const spti_glsl *out) {
    return (out->conditions & (SPTI_GLSL_BIT(normal) | SPTI_GLSL_BIT(fallbacks))) != 0;
}

static int words_of_hit(const spti_glsl *out) {
    if (out->options->program != SPT_GLSL_HITS) return 1;
    return 1 + has_second(out) + has_third(out);
}

/* Attachments are invariant: so versions without `precise` keep operations as they are written. */
static void write_outputs(spti_glsl *out) {
    static const char *const names[] = {"spt_out_0", "spt_out_1", "spt_out_2"};
    const int colour = out->options->program == SPT_GLSL_PICTURE;
    if (out->options->program == SPT_GLSL_CONES) {
        spti_glsl_put(out, "layout(location = 0) out vec4 spt_out_0;\ninvariant spt_out_0;\n");
        return;
    }
    for (int i = 0; i < (colour ? 1 : words_of_hit(out)); ++i) {
        spti_glsl_format(out, "layout(location = %d) out vec4 %s;\ninvariant %s;\n", i, names[i],
                         names[i]);
    }
}

static void write_buffers(spti_glsl *out) {
    const char *const set = out->options->target == SPT_GLSL_VULKAN_450 ? "set = 0, " : "";
    spti_glsl_put(out, "layout(local_size_x = 8, local_size_y = 8) in;\n");
    if (out->options->program != SPT_GLSL_CONES) {
        spti_glsl_format(out,
                         "layout(std430, %sbinding = 0) readonly buffer SptInput {\n"
                         "    vec4 spt_input[];\n};\n",
                         set);
    }
    spti_glsl_format(out,
                     "layout(std430, %sbinding = 1) writeonly buffer SptOutput {\n"
                     "    vec4 spt_output[];\n};\n",
                     set);
}

void spti_glsl_begin(spti_glsl *out) {
    const uint32_t target = out->options->target;
    write_version(out);
    if (target == SPT_GLSL_LIBRARY || target == SPT_GLSL_SHADERTOY) {
        spti_glsl_declare(out);
        return;
    }
    if (is_compute(out)) write_buffers(out);
    spti_glsl_declare(out);
    if (!is_compute(out)) write_outputs(out);
}

/* ---- Behind --------------------------------------------------------------------------------- */

/* The ray of this pixel, or invocation. */
static const char read_textures[] = "    ivec2 pixel = ivec2(gl_FragCoord.xy);\n"
                                    "    vec4 first = texelFetch($ray_origin, pixel, 0);\n"
                                    "    vec4 second = texelFetch($ray_direction, pixel, 0);\n";

static const char read_buffer[] = "    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);\n"
                                  "    if (pixel.x >= $size.x || pixel.y >= $size.y) return;\n"
                                  "    int place = pixel.y * $size.x + pixel.x;\n";

static const char read_ray_of_buffer[] =
    "[!path]    vec4 first = spt_input[2 * place], second = spt_input[2 * place + 1];\n"
    "[path]    vec4 first = spt_input[3 * place], second = spt_input[3 * place + 1];\n"
    "[path]    vec4 third = spt_input[3 * place + 2];\n";

static const char make_ray[] = "    SptRay ray;\n"
                               "    ray.origin = first.xyz;\n"
                               "    ray.t_min = first.w;\n"
                               "    ray.direction = second.xyz;\n"
                               "    ray.t_max = second.w;\n"
                               "[path]    ray.path = third.x;\n"
                               "[starts]    ray.t_min = max(ray.t_min, spt_start(pixel));\n"
                               "    SptHit hit = $trace(ray, $budget);\n"
                               "[refine]    spt_refine(ray, hit, $iterations);\n"
                               "[normal]    vec3 normal = spt_hit_normal(ray, hit, $detail);\n"
                               "[place]    int kernel = -1;\n"
                               "[place]    if (hit.outcome == $hit) {\n"
                               "[place]        kernel = spt_kernel_at(ray.origin + hit.t * "
                               "ray.direction);\n"
                               "[place]    }\n";

/* The vec4 of a hit: what is not wanted is 0. */
static void write_hit(spti_glsl *out, const char *const to[3]) {
    const int flags = spti_glsl_has(out, SPTI_GLSL_BIT(flags));
    const int candidate = spti_glsl_has(out, SPTI_GLSL_BIT(candidate));
    const int normal = spti_glsl_has(out, SPTI_GLSL_BIT(normal));
    const int fallbacks = spti_glsl_has(out, SPTI_GLSL_BIT(fallbacks));
    const char *const number = spti_glsl_has(out, SPTI_GLSL_BIT(place)) ? "float(kernel)"
                               : spti_glsl_has(out, SPTI_GLSL_BIT(component))
                                   ? "float(hit.component)"
                                   : "0.0";
    int next = 0;
    spti_glsl_format(out,
                     "    %s = vec4(hit.t, hit.residual, float(hit.evaluations), "
                     "float(hit.outcome));\n",
                     to[next++]);
    if (has_second(out)) {
        spti_glsl_format(out, "    %s = vec4(%s, %s, %s);\n", to[next++], number,
                         flags ? "float(hit.flags)" : "0.0",
                         candidate ? "hit.candidate_t, hit.candidate_ratio" : "0.0, 0.0");
    }
    if (has_third(out)) {
        spti_glsl_format(out, "    %s = vec4(%s, %s);\n", to[next],
                         normal ? "normal" : "0.0, 0.0, 0.0",
                         fallbacks ? "float(hit.fallbacks)" : "0.0");
    }
}

static void write_hits(spti_glsl *out) {
    static const char *const attachments[3] = {"spt_out_0", "spt_out_1", "spt_out_2"};
    static const char *const places[3][3] = {
        {"spt_output[place]", NULL, NULL},
        {"spt_output[2 * place]", "spt_output[2 * place + 1]", NULL},
        {"spt_output[3 * place]", "spt_output[3 * place + 1]", "spt_output[3 * place + 2]"}};
    spti_glsl_put(out, "\nvoid main() {\n");
    if (is_compute(out)) {
        spti_glsl_expand(out, read_buffer, NULL);
        spti_glsl_expand(out, read_ray_of_buffer, NULL);
    } else {
        spti_glsl_expand(out, read_textures, NULL);
        spti_glsl_expand(out, "[path]    vec4 third = texelFetch($ray_path, pixel, 0);\n", NULL);
    }
    spti_glsl_expand(out, make_ray, NULL);
    write_hit(out, is_compute(out) ? places[words_of_hit(out) - 1] : attachments);
    spti_glsl_put(out, "}\n");
}

static void write_points(spti_glsl *out) {
    spti_glsl_put(out, "\nvoid main() {\n");
    if (is_compute(out)) {
        spti_glsl_expand(out, read_buffer, NULL);
        spti_glsl_put(out, "    spt_output[place] = vec4(spt_map(spt_input[place].xyz), 0.0, 0.0, "
                           "0.0);\n}\n");
    } else {
        spti_glsl_expand(out,
                         "    vec4 point = texelFetch($ray_origin, ivec2(gl_FragCoord.xy), 0);\n"
                         "    spt_out_0 = vec4(spt_map(point.xyz), 0.0, 0.0, 0.0);\n}\n",
                         NULL);
    }
}

/* Pixels of the pass answer for blocks of the picture, rows counted from the top in buffers and
 * from the bottom in textures. */
static void write_cones(spti_glsl *out) {
    spti_glsl_put(out, "\nvoid main() {\n");
    if (is_compute(out)) {
        spti_glsl_expand(out,
                         "    ivec2 block = ivec2(gl_GlobalInvocationID.xy);\n"
                         "    ivec2 blocks = ($size + $cone_size - 1) / $cone_size;\n"
                         "    if (block.x >= blocks.x || block.y >= blocks.y) return;\n"
                         "    float t = spt_cone_over(block, $budget);\n"
                         "    spt_output[block.y * blocks.x + block.x] = vec4(t, 0.0, 0.0, 0.0);\n"
                         "}\n",
                         NULL);
    } else {
        spti_glsl_expand(out,
                         "    float t = spt_cone_over(ivec2(gl_FragCoord.xy), $budget);\n"
                         "    spt_out_0 = vec4(t, 0.0, 0.0, 0.0);\n"
                         "}\n",
                         NULL);
    }
}

static const char picture[] =
    "    SptRay ray = spt_camera_ray(pixel);\n"
    "[starts]    ray.t_min = max(ray.t_min, spt_start(ivec2($0)));\n"
    "    SptHit hit = $trace(ray, $budget);\n"
    "[refine]    spt_refine(ray, hit, $iterations);\n"
    "[depth]    if (hit.t > 1.0e38) discard; // a miss\n"
    "[depth]    vec2 coefficients = $depth;\n"
    "[depth]    float z = hit.t * dot(ray.direction, $forward);\n"
    "[depth]    gl_FragDepth = coefficients.x + coefficients.y / z;\n"
    "[views]    vec3 colour = spt_view_of(ray, hit, $view);\n"
    "[!views]    vec3 colour = sqrt(clamp(spt_shade(ray, hit), 0.0, 1.0));\n";

/* The square root stands for the curve of a screen, as the examples have it. */
static void write_picture(spti_glsl *out) {
    if (out->options->target == SPT_GLSL_SHADERTOY) {
        static const char *const arguments[10] = {"place", "", "", "", "", "", "", "", "", ""};
        spti_glsl_expand(out,
                         "\nvoid mainImage(out vec4 spt_out_0, in vec2 place) {\n"
                         "    vec2 pixel = vec2(place.x, float($size.y) - place.y);\n",
                         NULL);
        spti_glsl_expand(out, picture, arguments);
    } else {
        static const char *const arguments[10] = {
            "gl_FragCoord.xy", "", "", "", "", "", "", "", "", ""};
        spti_glsl_expand(
            out,
            "\nvoid main() {\n"
            "    vec2 pixel = vec2(gl_FragCoord.x, float($size.y) - gl_FragCoord.y);\n",
            NULL);
        spti_glsl_expand(out, picture, arguments);
    }
    spti_glsl_put(out, "    spt_out_0 = vec4(colour, 1.0);\n}\n");
}

/* A library has no main(): the names of what was asked for are all that the scanner needs. */
static void name_functions(spti_glsl *out) {
    if (!out->scanning) return;
    spti_glsl_expand(out,
                     "$trace\n"
                     "[normal]spt_hit_normal\n"
                     "[refine]spt_refine\n"
                     "[offset]spt_offset spt_offset_checked\n"
                     "[shadow]spt_soft_shadow\n"
                     "[occlusion]spt_ambient_occlusion\n"
                     "[place]spt_kernel_at\n",
                     NULL);
    if (out->options->features & SPT_GLSL_COMPONENT) {
        spti_glsl_expand(out, "[materials]spt_material\n", NULL);
    }
}

void spti_glsl_end(spti_glsl *out) {
    if (out->options->target == SPT_GLSL_LIBRARY) {
        name_functions(out);
        return;
    }
    switch (out->options->program) {
    case SPT_GLSL_PICTURE:
        write_picture(out);
        break;
    case SPT_GLSL_HITS:
        write_hits(out);
        break;
    case SPT_GLSL_POINTS:
        write_points(out);
        break;
    default:
        write_cones(out);
        break;
    }
}
