/* SPDX-License-Identifier: MIT
 *
 * Parameters as uniforms, macros or literals. */
#include "parameters.h"

#include "../base/arguments.h"
#include "pieces.h"

typedef struct parameter {
    const char *name; /* with "spt_" before it, the default name */
    const char *type;
    const char *macro; /* in a library; NULL: none has it */
} parameter;

static const parameter parameters[SPT_GLSL_NAMES] = {
    {"spt_size", "ivec2", NULL},
    {"spt_budget", "int", NULL},
    {"spt_epsilon", "float", "SPT_EPSILON"},
    {"spt_pixel_radius", "float", "SPT_PIXEL_RADIUS"},
    {"spt_relaxation", "float", "SPT_RELAXATION"},
    {"spt_extrapolation", "float", "SPT_EXTRAPOLATION"},
    {"spt_slope_blend", "float", "SPT_SLOPE_BLEND"},
    {"spt_step_cap", "float", "SPT_STEP_CAP"},
    {"spt_eye", "vec3", NULL},
    {"spt_right", "vec3", NULL},
    {"spt_up", "vec3", NULL},
    {"spt_forward", "vec3", NULL},
    {"spt_window", "vec4", NULL},
    {"spt_range", "vec2", NULL},
    {"spt_light", "vec3", "SPT_LIGHT"},
    {"spt_light_tangent", "float", "SPT_LIGHT_TANGENT"},
    {"spt_occlusion", "float", "SPT_OCCLUSION"},
    {"spt_depth", "vec2", NULL},
    {"spt_time", "float", NULL},
    {"spt_view", "int", NULL},
    {"spt_ray_origin", "sampler2D", NULL},
    {"spt_ray_direction", "sampler2D", NULL},
    {"spt_ray_path", "sampler2D", NULL},
    {"spt_starts", "sampler2D", NULL},
};

const char *spt_glsl_default_name(uint32_t name) {
    return name < SPT_GLSL_NAMES ? parameters[name].name : NULL;
}

/* ---- Values --------------------------------------------------------------------------------- */

static void put_vector(spti_glsl *out, const char *type, const float *numbers, int count) {
    spti_glsl_format(out, "%s(", type);
    for (int i = 0; i < count; ++i) {
        spti_glsl_format(out, i == 0 ? "%F" : ", %F", (double)numbers[i]);
    }
    spti_glsl_put(out, ")");
}

static void put_float(spti_glsl *out, float number) {
    spti_glsl_format(out, "%f", (double)number);
}

static void put_camera(spti_glsl *out, uint32_t name, const spt_camera *camera) {
    const float window[4] = {camera->x_low, camera->x_high, camera->y_low, camera->y_high};
    const float range[2] = {camera->t_min, camera->t_max < 1e18f ? camera->t_max : 1e18f};
    switch (name) {
    case SPT_GLSL_NAME_EYE:
        put_vector(out, "vec3", camera->eye, 3);
        break;
    case SPT_GLSL_NAME_RIGHT:
        put_vector(out, "vec3", camera->right, 3);
        break;
    case SPT_GLSL_NAME_UP:
        put_vector(out, "vec3", camera->up, 3);
        break;
    case SPT_GLSL_NAME_FORWARD:
        put_vector(out, "vec3", camera->forward, 3);
        break;
    case SPT_GLSL_NAME_WINDOW:
        put_vector(out, "vec4", window, 4);
        break;
    default:
        put_vector(out, "vec2", range, 2);
        break;
    }
}

/* A parameter that is no uniform. */
static void put_constant(spti_glsl *out, uint32_t name) {
    const spt_settings *const settings = &out->settings;
    switch (name) {
    case SPT_GLSL_NAME_EPSILON:
        put_float(out, settings->epsilon);
        break;
    case SPT_GLSL_NAME_PIXEL_RADIUS:
        put_float(out, settings->pixel_radius);
        break;
    case SPT_GLSL_NAME_RELAXATION:
        put_float(out, settings->relaxation);
        break;
    case SPT_GLSL_NAME_EXTRAPOLATION:
        put_float(out, settings->extrapolation);
        break;
    case SPT_GLSL_NAME_SLOPE_BLEND:
        put_float(out, settings->slope_blend);
        break;
    case SPT_GLSL_NAME_STEP_CAP:
        put_float(out, settings->step_cap);
        break;
    case SPT_GLSL_NAME_LIGHT:
        put_vector(out, "vec3", out->light, 3);
        break;
    case SPT_GLSL_NAME_LIGHT_TANGENT:
        put_float(out, out->options->light_tangent);
        break;
    case SPT_GLSL_NAME_OCCLUSION:
        put_float(out, out->options->occlusion);
        break;
    case SPT_GLSL_NAME_DEPTH:
        put_vector(out, "vec2", out->options->depth, 2);
        break;
    case SPT_GLSL_NAME_TIME:
        spti_glsl_put(out, "0.0");
        break;
    case SPT_GLSL_NAME_VIEW:
        spti_glsl_put(out, "0");
        break;
    default:
        if (out->options->camera != NULL) put_camera(out, name, out->options->camera);
        break;
    }
}

/* What the site of Shadertoy has in the place of our uniforms. */
static const char *shadertoy(uint32_t name) {
    switch (name) {
    case SPT_GLSL_NAME_SIZE:
        return "ivec2(iResolution.xy)";
    case SPT_GLSL_NAME_TIME:
        return "iTime";
    default:
        return NULL;
    }
}

static void put_parameter(spti_glsl *out, uint32_t name) {
    const int library = out->options->target == SPT_GLSL_LIBRARY;
    if (out->scanning) out->used |= 1u << name;
    if (out->options->target == SPT_GLSL_SHADERTOY && shadertoy(name) != NULL) {
        spti_glsl_put(out, shadertoy(name));
    } else if (out->options->target == SPT_GLSL_SHADERTOY && name == SPT_GLSL_NAME_BUDGET) {
        spti_glsl_put(out, "(");
        spti_glsl_integer(
            out, (int)(out->settings.budget < 0x7fffffffu ? out->settings.budget : 0x7fffffffu));
        spti_glsl_put(out, " + SPT_ZERO)");
    } else if (out->uniforms >> name & 1) {
        out->naming = 1;
        spti_glsl_put(out, out->names[name]);
        out->naming = 0;
    } else if (library && parameters[name].macro != NULL) {
        spti_glsl_put(out, parameters[name].macro);
    } else {
        put_constant(out, name);
    }
}

/* ---- Words ---------------------------------------------------------------------------------- */

const char *spti_glsl_precise(const spti_glsl *out) {
    switch (out->options->target) {
    case SPT_GLSL_LIBRARY:
        return "SPT_PRECISE";
    case SPT_GLSL_COMPUTE_310_ES:
    case SPT_GLSL_COMPUTE_430:
    case SPT_GLSL_COMPUTE_450:
    case SPT_GLSL_VULKAN_450:
        return "precise";
    default:
        return "";
    }
}

/* Whether all components have the same constant, which then stands for all. */
static int are_equal(const spti_glsl *out, int of_size) {
    int equal = 1;
    for (uint32_t i = 1; i < out->component_count; ++i) {
        const spti_glsl_component *const a = &out->components[0], *const b = a + i;
        equal = equal && !(of_size ? a->floor_of_size < b->floor_of_size ||
                                         a->floor_of_size > b->floor_of_size
                                   : a->inverse_lipschitz < b->inverse_lipschitz ||
                                         a->inverse_lipschitz > b->inverse_lipschitz);
    }
    return equal;
}

/* The words of glsl_piece.h that are no parameters. Returns 0 where it is none of them. */
static int put_word(spti_glsl *out, const char *word, size_t length) {
    const spt_glsl_options *const options = out->options;
    const int many = spti_glsl_has(out, SPTI_GLSL_BIT(many));
    const struct {
        const char *name;
        int number;
    } numbers[] = {
        {"miss", SPT_MISS},
        {"hit", SPT_HIT},
        {"limit", SPT_LIMIT},
        {"nonfinite", SPT_NONFINITE},
        {"bad", SPT_BAD_RAY},
        {"steep", SPT_FLAG_STEEP},
        {"inside", SPT_FLAG_INSIDE},
        {"notconvex", SPT_FLAG_NOT_CONVEX},
        {"n", (int)out->component_count},
        {"iterations", (int)options->iterations},
        {"samples", (int)options->samples},
        {"cone_size", (int)options->cone_size},
    };
    const struct {
        const char *name, *text;
    } words[] = {
        {"precise", spti_glsl_precise(out)},
        {"zero", "SPT_ZERO"},
        {"C", many ? "component, " : ""},
        {"P", many ? "int component, " : ""},
        {"trace", spti_glsl_has(out, SPTI_GLSL_BIT(binary))    ? "spt_binary_trace"
                  : spti_glsl_has(out, SPTI_GLSL_BIT(reverse)) ? "spt_trace_convex"
                                                               : "spt_trace"},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        if (strlen(numbers[i].name) != length || memcmp(numbers[i].name, word, length)) continue;
        spti_glsl_integer(out, numbers[i].number);
        return 1;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        if (strlen(words[i].name) != length || memcmp(words[i].name, word, length)) continue;
        spti_glsl_put(out, words[i].text);
        return 1;
    }
    if (length == strlen("detail") && memcmp(word, "detail", length) == 0) {
        if (many)
            spti_glsl_put(out, "spt_detail(hit.component)");
        else
            put_float(out, out->detail);
        return 1;
    }
    if (length != 1 || (word[0] != 'L' && word[0] != 'S')) return 0;
    if (many && !are_equal(out, word[0] == 'S')) {
        spti_glsl_put(out, word[0] == 'L' ? "spt_inverse_lipschitz(component)"
                                          : "spt_floor_of_size(component)");
    } else {
        put_float(out, word[0] == 'L' ? out->inverse_lipschitz : out->floor_of_size);
    }
    return 1;
}

void spti_glsl_parameter(spti_glsl *out, const char *word, size_t length) {
    if (put_word(out, word, length)) return;
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        const char *const name = parameters[i].name + strlen("spt_");
        if (strlen(name) != length || memcmp(name, word, length)) continue;
        put_parameter(out, i);
        return;
    }
}

void spti_glsl_use_name(spti_glsl *out, const char *word, int own) {
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        /* Callers' texts may ask for the time whatever it is in this target. */
        if (!(out->uniforms >> i & 1) && i != SPT_GLSL_NAME_TIME) continue;
        if (strcmp(out->names[i], word) != 0) continue;
        if (own)
            out->clashes |= 1u << i;
        else
            out->used |= 1u << i;
    }
}

/* ---- Declarations --------------------------------------------------------------------------- */

static void declare_macros(spti_glsl *out) {
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        if (!(out->used >> i & 1) || parameters[i].macro == NULL) continue;
        spti_glsl_format(out, "#ifndef %s\n#define %s ", parameters[i].macro, parameters[i].macro);
        put_constant(out, i);
        spti_glsl_put(out, "\n#endif\n");
    }
}

/* The time of callers' texts, where it is no uniform. */
static void declare_time(spti_glsl *out) {
    const uint32_t bit = 1u << SPT_GLSL_NAME_TIME;
    const char *const name = out->names[SPT_GLSL_NAME_TIME];
    if (!(out->used & bit) || (out->uniforms & bit)) return;
    if (out->options->target == SPT_GLSL_LIBRARY) {
        if (out->options->uniforms & bit) return; /* the host has it */
        spti_glsl_format(out, "#ifndef %s\n#define %s 0.0\n#endif\n", name, name);
    } else if (out->options->target == SPT_GLSL_SHADERTOY) {
        spti_glsl_format(out, "#define %s iTime\n", name);
    } else {
        spti_glsl_format(out, "const float %s = 0.0;\n", name);
    }
}

enum {
    SAMPLERS = 1 << SPT_GLSL_NAME_RAY_ORIGIN | 1 << SPT_GLSL_NAME_RAY_DIRECTION |
               1 << SPT_GLSL_NAME_RAY_PATH | 1 << SPT_GLSL_NAME_STARTS,
    CAMERA = 1 << SPT_GLSL_NAME_EYE | 1 << SPT_GLSL_NAME_RIGHT | 1 << SPT_GLSL_NAME_UP |
             1 << SPT_GLSL_NAME_FORWARD | 1 << SPT_GLSL_NAME_WINDOW | 1 << SPT_GLSL_NAME_RANGE,
    RULE = 1 << SPT_GLSL_NAME_RELAXATION | 1 << SPT_GLSL_NAME_EXTRAPOLATION |
           1 << SPT_GLSL_NAME_SLOPE_BLEND | 1 << SPT_GLSL_NAME_STEP_CAP,
    PICTURE = 1 << SPT_GLSL_NAME_LIGHT | 1 << SPT_GLSL_NAME_LIGHT_TANGENT |
              1 << SPT_GLSL_NAME_OCCLUSION | 1 << SPT_GLSL_NAME_DEPTH | 1 << SPT_GLSL_NAME_VIEW
};

/* What a program may make use of; the least that implementations have room for is 128 bytes. */
static uint32_t parameters_of_program(const spti_glsl *out) {
    const uint32_t all = (1u << SPT_GLSL_NAMES) - 1;
    switch (out->options->program) {
    case SPT_GLSL_HITS:
    case SPT_GLSL_POINTS:
        return all & ~(uint32_t)(CAMERA | PICTURE);
    case SPT_GLSL_CONES:
        return all & ~(uint32_t)(PICTURE | RULE);
    default:
        return all;
    }
}

/* Vulkan has no single uniforms. All that was asked for is there, so that where a member is does not
 * depend on what a step rule or a text uses. */
static void declare_block(spti_glsl *out, uint32_t declared) {
    spti_glsl_put(out, "layout(push_constant) uniform SptParameters {\n");
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        if (!(declared >> i & 1)) continue;
        spti_glsl_format(out, "    %s %s;\n", parameters[i].type, out->names[i]);
    }
    spti_glsl_put(out, "};\n");
}

void spti_glsl_declare(spti_glsl *out) {
    const uint32_t declared = out->used & out->uniforms;
    if (out->options->target == SPT_GLSL_LIBRARY) {
        declare_macros(out);
    } else if (out->options->target == SPT_GLSL_VULKAN_450) {
        declare_block(out, out->uniforms & ~(uint32_t)SAMPLERS & parameters_of_program(out));
    } else {
        for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
            if (!(declared >> i & 1)) continue;
            spti_glsl_format(out, "uniform %s %s;\n", parameters[i].type, out->names[i]);
        }
    }
    declare_time(out);
}
