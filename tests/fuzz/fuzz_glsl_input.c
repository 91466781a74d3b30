/* SPDX-License-Identifier: MIT
 *
 * Reads bytes as a case of fuzz_glsl.h. Any bytes are a case, and most are refused for one reason
 * or another only if they want to be hostile. */
#include "fuzz_glsl.h"

#include "fuzz_reader.h"
#include "stress/test_glsl_words.h"

#include <string.h>

static void read_triple(reader *from, float to[3], float low, float high) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = read_number(from, low, high);
}

/* ---- Texts ----------------------------------------------------------------------------------- */

/* Adds a part of a text, if there is room. */
static void add(char *text, size_t room, const char *part, size_t size) {
    const size_t length = strlen(text);
    if (length + size + 1 > room) return;
    memcpy(text + length, part, size);
    text[length + size] = 0;
}

/* Statements, or pieces of such: no letters beside those of whole words, so that what looks like a
 * number in words can only come from the library. */
static void read_text(reader *from, char text[fuzz_glsl_text], int hostile) {
    static const char *const parts[] = {"return p.x;",
                                        "(",
                                        ")",
                                        "{",
                                        "}",
                                        "[",
                                        "]",
                                        "/*",
                                        "*/",
                                        "//",
                                        "\n",
                                        "\t",
                                        " ",
                                        "#",
                                        "\\",
                                        ";",
                                        "spt_sphere(p, 1.0)",
                                        "spt_box(p, vec3(0.5))",
                                        "float my_f = ",
                                        "/",
                                        "*",
                                        "\"",
                                        "spt_smooth_union(p.x, p.y, 0.5)",
                                        "spt_map(p)",
                                        "SPT_PRECISE float d = p.x;",
                                        "return d;"};
    const uint32_t count = read_byte(from) % 12;
    text[0] = 0;
    if (!hostile) {
        add(text, fuzz_glsl_text, "return p.x;", 11);
        return;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t choice = read_byte(from);
        const char *const part = parts[choice % (sizeof parts / sizeof *parts)];
        char byte = (char)read_byte(from);
        if ((byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == 0) byte = '1';
        if (choice < 240) add(text, fuzz_glsl_text, part, strlen(part));
        if (choice >= 240) add(text, fuzz_glsl_text, &byte, 1);
    }
}

static void read_name(reader *from, char name[fuzz_glsl_name]) {
    const uint32_t choice = read_byte(from), index = read_byte(from) + 7u * choice;
    const char *word = "u_name";
    name[0] = 0;
    if (choice < 40) word = glsl_reserved[index % glsl_reserved_count];
    if (choice >= 40 && choice < 80) word = glsl_functions[index % glsl_function_count];
    if (choice >= 80 && choice < 110) word = spt_glsl_default_name(index % SPT_GLSL_NAMES);
    add(name, fuzz_glsl_name, word, strlen(word));
    for (uint32_t i = 0; i < choice % 5; ++i) {
        char byte = (char)read_byte(from);
        if (choice > 128) byte = "_09azAZx"[byte & 7];
        if (byte != 0) add(name, fuzz_glsl_name, &byte, 1);
    }
    for (uint32_t i = 0; choice > 250 && i < 70; ++i) add(name, fuzz_glsl_name, "y", 1);
}

/* ---- Fields ---------------------------------------------------------------------------------- */

static float distance(void *user, float x, float y, float z) {
    (void)user;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

static void read_bound(reader *from, spt_bound *bound) {
    static float axes[3][3] = {{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}};
    float a[3], b[3];
    const uint32_t kind = read_byte(from) % (from->hostile ? 10u : 7u);
    read_triple(from, a, -2.0f, -1.0f);
    read_triple(from, b, 1.0f, 2.0f);
    const float radius = read_number(from, 0.25f, 3.0f);
    switch (kind) {
    case 0:
        *bound = spt_bound_sphere(a[0], a[1], a[2], radius);
        break;
    case 1:
        *bound = spt_bound_box(a[0], a[1], a[2], b[0], b[1], b[2]);
        break;
    case 2:
        *bound = spt_bound_oriented_box(a, axes, b);
        break;
    case 3:
        *bound = spt_bound_capsule(a, b, radius);
        break;
    case 4:
        *bound = spt_bound_cylinder(a, b, radius);
        break;
    case 5:
        *bound = spt_bound_ellipsoid(a, axes, b);
        break;
    case 6:
        *bound = spt_bound_slab(a, -radius, radius);
        break;
    case 7:
        *bound = spt_bound_polytope(NULL, 1);
        break;
    case 8:
        *bound = spt_bound_callback(NULL, NULL, NULL);
        break;
    default:
        *bound = spt_bound_of_kind((spt_bound_kind)12);
        break;
    }
}

static void read_field(reader *from, fuzz_glsl_case *what, int i) {
    const uint32_t choice = read_byte(from);
    spt_field *const field = &what->fields[i];
    const int hostile = from->hostile && (choice & 48) == 0;
    *field = spt_field_default();
    field->point = distance;
    field->flags = choice & 1 ? SPT_FIELD_CONVEX : 0;
    read_text(from, what->texts[i], hostile);
    field->glsl = what->texts[i];
    if ((choice & 2) != 0) {
        read_text(from, what->preludes[i], hostile);
        if (!hostile) strcpy(what->preludes[i], "float my_f(float f) { return f; }");
        field->glsl_prelude = what->preludes[i];
    }
    if ((choice & 4) != 0) field->lipschitz = read_number(from, 0.5f, 4.0f);
    if ((choice & 8) != 0) {
        read_bound(from, &what->bounds[i]);
        field->bound = &what->bounds[i];
    }
    if (hostile && (choice & 192) == 0) field->glsl = NULL;
}

/* ---- Models ---------------------------------------------------------------------------------- */

static void read_kernel(reader *from, fuzz_glsl_case *what, spt_kernel *kernel) {
    const uint32_t choice = read_byte(from);
    float a[3], b[3], control[3];
    read_triple(from, a, -2.0f, 0.0f);
    read_triple(from, b, 0.5f, 2.0f);
    read_triple(from, control, -2.0f, 2.0f);
    const float radius = read_number(from, 0.0f, 1.0f);
    *kernel = spt_kernel_empty();
    if (choice % 6 == 1) *kernel = spt_kernel_sphere(a[0], a[1], a[2], radius);
    if (choice % 6 == 2) *kernel = spt_kernel_half_space(a[0] - 0.125f, a[1], a[2], radius);
    if (choice % 6 == 3) *kernel = spt_kernel_capsule(a, b, control, radius);
    if (choice % 6 == 4) *kernel = spt_kernel_leaf(a, b, control, 0.125f, radius);
    if (choice % 6 == 5) *kernel = spt_kernel_field(&what->fields[choice / 6 % fuzz_glsl_fields]);
}

static int make_krs(reader *from, fuzz_glsl_case *what) {
    spt_krs_model model = spt_krs_model_default();
    model.levels = read_byte(from) % (fuzz_glsl_levels + 1);
    for (uint32_t i = 0; i <= model.levels; ++i) read_kernel(from, what, &what->kernels[i]);
    for (uint32_t i = 0; i < model.levels; ++i) {
        read_triple(from, what->mirrors[i].normal, 0.125f, 1.0f);
        what->mirrors[i].offset = read_number(from, -1.0f, 3.0f);
    }
    model.kernels = what->kernels;
    model.mirrors = what->mirrors;
    if (spt_krs_build(&model, &what->krs) != SPT_OK) return 0;
    what->made = spt_krs_field(&what->krs);
    return 1;
}

static void read_map(reader *from, spt_mobius *map) {
    float vector[3];
    double v[3];
    read_triple(from, vector, 1.0f, 3.0f);
    for (int axis = 0; axis < 3; ++axis) v[axis] = (double)vector[axis];
    *map = spt_mobius_identity();
    if ((read_byte(from) & 1) != 0) {
        (void)spt_mobius_inversion(v, (double)read_number(from, 0.5f, 3.0f), map);
    } else {
        (void)spt_mobius_translation(v, map);
    }
}

static int make_moekrs(reader *from, fuzz_glsl_case *what) {
    spt_moekrs_model model = spt_moekrs_model_default();
    model.levels = read_byte(from) % (fuzz_glsl_levels + 1);
    for (uint32_t i = 0; i <= model.levels; ++i) read_kernel(from, what, &what->kernels[i]);
    for (uint32_t i = 0; i < model.levels; ++i) read_map(from, &what->maps[i]);
    model.kernels = what->kernels;
    model.maps = what->maps;
    model.unmirrored = read_byte(from);
    if (spt_moekrs_build(&model, &what->moekrs) != SPT_OK) return 0;
    what->made = spt_moekrs_field(&what->moekrs);
    return 1;
}

static int make_distorted(reader *from, fuzz_glsl_case *what) {
    spt_distortion distortion = spt_distortion_default();
    distortion.kind = 1 + read_byte(from) % 4;
    distortion.rate = read_number(from, -0.125f, 0.125f);
    distortion.wave = read_number(from, 0.0f, 2.0f);
    distortion.phase = read_number(from, -3.0f, 3.0f);
    return spt_distorted_field(&what->fields[0], &distortion, &what->distorted, &what->made) ==
           SPT_OK;
}

/* The field that is traced: one of the caller's, or one made of it. */
static void make_field(reader *from, fuzz_glsl_case *what) {
    const uint32_t kind = read_byte(from) % 7;
    int made = 0;
    if (kind == 1) made = make_krs(from, what);
    if (kind == 2) made = make_moekrs(from, what);
    if (kind == 3) {
        read_map(from, &what->maps[0]);
        made = spt_conformal_field(&what->fields[0], &what->maps[0], &what->conformal,
                                   &what->made) == SPT_OK;
    }
    if (kind == 4) made = make_distorted(from, what);
    if (kind == 5) {
        float eye[3];
        read_triple(from, eye, -4.0f, 4.0f);
        made = spt_level_set_field(&what->fields[0], eye, 0, 0.5f, &what->settings,
                                   &what->level_set, &what->made) == SPT_OK;
    }
    if (!made) what->made = what->fields[0];
}

/* ---- Options --------------------------------------------------------------------------------- */

static void read_settings(reader *from, spt_settings *settings) {
    static const spt_method *(*const methods[])(void) = {
        spt_basic, spt_relaxed, spt_enhanced, spt_auto_relaxed, spt_adaptive, spt_convex};
    const uint32_t choice = read_byte(from);
    *settings = spt_settings_default();
    settings->method = methods[choice % 6]();
    settings->budget = read_byte(from);
    settings->epsilon = read_number(from, 1e-6f, 1e-2f);
    if ((choice & 64) != 0) settings->pixel_radius = read_number(from, 0.0f, 1e-2f);
    if ((choice & 128) != 0) settings->size = read_number(from, 0.0f, 100.0f);
    settings->relaxation = read_number(from, 1.0f, 1.99f);
    settings->extrapolation = read_number(from, 0.0f, 1.0f);
    settings->slope_blend = read_number(from, 0.01f, 1.0f);
    settings->step_cap = read_number(from, 1.0f, 99.0f);
    if ((read_byte(from) & 7) == 0)
        settings->flags = 1u << read_byte(from) % (from->hostile ? 6 : 4);
}

static void read_camera(reader *from, spt_camera *camera) {
    static const float target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    float eye[3];
    const uint32_t choice = read_byte(from);
    for (int axis = 0; axis < 3; ++axis) eye[axis] = 1.0f + (float)read_byte(from) / 64.0f;
    if ((choice & 1) != 0) {
        (void)spt_camera_pinhole(camera, eye, target, up, 0.5f, 160, 90);
    } else {
        (void)spt_camera_orthographic(camera, eye, target, up, 2.0f, 160, 90);
    }
    if (from->hostile && (choice & 2) != 0) {
        camera->eye[0] = read_number(from, -1.0f, 1.0f);
        camera->right[1] = read_number(from, -1.0f, 1.0f);
        camera->x_low = read_number(from, -1.0f, 0.0f);
        camera->t_max = read_number(from, 1.0f, 100.0f);
    }
}

/* What goes together, without which most texts would be refused. */
static void make_fitting(spt_glsl_options *options) {
    static const uint32_t everywhere = SPT_GLSL_GUARDS | SPT_GLSL_FLAGS | SPT_GLSL_CANDIDATE |
                                       SPT_GLSL_FALLBACKS | SPT_GLSL_PATH | SPT_GLSL_REFINE |
                                       SPT_GLSL_ARRAYS;
    static const uint32_t pictures =
        everywhere | SPT_GLSL_NORMAL | SPT_GLSL_SHADOW | SPT_GLSL_OCCLUSION | SPT_GLSL_DEPTH_WRITE;
    static const uint32_t others[] = {SPT_GLSL_CONVEX, SPT_GLSL_BINARY, SPT_GLSL_MERGED,
                                      SPT_GLSL_STARTS, SPT_GLSL_PLACE,  SPT_GLSL_OFFSET};
    const uint32_t other = options->features & others[options->uniforms % 6];
    if (options->target == SPT_GLSL_SHADERTOY) options->program = SPT_GLSL_PICTURE;
    if (options->target >= SPT_GLSL_COMPUTE_310_ES && options->program != SPT_GLSL_POINTS)
        options->program = SPT_GLSL_HITS;
    if (options->target == SPT_GLSL_LIBRARY) {
        options->features &= (pictures & ~(uint32_t)SPT_GLSL_DEPTH_WRITE) | other;
    } else if (options->program == SPT_GLSL_PICTURE) {
        options->features &= pictures | other;
    } else if (options->program == SPT_GLSL_HITS) {
        options->features &= everywhere | SPT_GLSL_NORMAL | SPT_GLSL_COMPONENT | other;
    } else {
        options->features &= SPT_GLSL_ARRAYS;
    }
}

static void read_options(reader *from, fuzz_glsl_case *what) {
    spt_glsl_options *const options = &what->options;
    const uint32_t choice = read_byte(from), more = read_byte(from);
    *options = spt_glsl_options_default();
    options->settings = &what->settings;
    options->camera = &what->camera;
    options->target = read_byte(from) % (from->hostile ? 9 : SPT_GLSL_TARGETS);
    options->program = read_byte(from) % (from->hostile ? 5 : SPT_GLSL_PROGRAMS);
    for (uint32_t i = 0; i < choice % 5; ++i) {
        options->features |= 1u << read_byte(from) % (from->hostile ? 20 : 18);
    }
    options->uniforms = read_byte(from) << 16 | read_byte(from) << 8 | read_byte(from);
    if (!from->hostile) make_fitting(options);
    if ((more & 7) == 0) {
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t parameter = read_byte(from) % SPT_GLSL_NAMES;
            read_name(from, what->name_texts[parameter]);
            what->names[parameter] = what->name_texts[parameter];
        }
        options->names = what->names;
    }
    if ((more & 8) != 0) {
        options->iterations = read_byte(from) % (from->hostile ? 20 : 17);
        options->samples = 1 + read_byte(from) % (from->hostile ? 20 : 16);
        options->cone_size = 2 + read_byte(from) % (from->hostile ? 70 : 63);
        options->field_number = from->hostile ? read_byte(from) % 3 : 0;
    }
    options->detail = read_number(from, 0.0f, 1.0f);
    read_triple(from, options->light, 0.125f, 1.0f);
    options->light_tangent = read_number(from, 0.01f, 1.0f);
    options->occlusion = read_number(from, 0.01f, 1.0f);
    options->depth[0] = read_number(from, -1.0f, 2.0f);
    options->depth[1] = read_number(from, -1.0f, 2.0f);
}

void fuzz_glsl_read(fuzz_glsl_case *what, const uint8_t *data, size_t size) {
    reader from = {data, size, 0, 0};
    memset(what, 0, sizeof *what);
    const uint32_t choice = read_byte(&from);
    what->hostile = (choice & 3) == 0;
    from.hostile = what->hostile;
    read_settings(&from, &what->settings);
    read_camera(&from, &what->camera);
    for (int i = 0; i < fuzz_glsl_fields; ++i) read_field(&from, what, i);
    read_options(&from, what);
    make_field(&from, what);
    what->scene = spt_scene_default();
    what->scene.fields = what->fields;
    what->scene.count = 1 + read_byte(&from) % fuzz_glsl_fields;
    if ((choice & 8) != 0) what->scene.materials = what->materials;
    if ((choice & 16) != 0) {
        what->fields[0] = what->made;
        what->options.scene = &what->scene;
    } else {
        what->options.field = &what->made;
    }
    if (what->settings.method == spt_convex() && !what->hostile &&
        ((what->made.flags & SPT_FIELD_CONVEX) == 0 || what->options.scene != NULL))
        what->settings.method = spt_adaptive();
    what->seed = read_byte(&from);
    what->capacity = read_byte(&from) << 8 | read_byte(&from);
}
