/* SPDX-License-Identifier: MIT
 *
 * The fields, models and scenes. */
#include "test_glsl_world.h"

#include "check.h"

#include <math.h>
#include <string.h>

const char *const glsl_subject_names[glsl_subjects] = {
    "ball",      "body",      "shapes",    "steep",   "krs_0", "krs_1",       "krs_64",
    "krs_field", "moekrs",    "conformal", "twist",   "bend",  "taper",       "sway",
    "map",       "level_set", "nested",    "scene_1", "scene", "convex_scene"};

/* ---- Callers' fields ------------------------------------------------------------------------- */

static float ball(void *user, float x, float y, float z) {
    (void)user;
    x -= 0.25f;
    y += 0.5f;
    return sqrtf(x * x + y * y + z * z) - 1.0f;
}

static float shapes(void *user, float x, float y, float z) {
    (void)user;
    const float box = spt_box(spt_point_of(x, y, z), spt_point_of(0.75f, 0.75f, 0.75f));
    return spt_smooth_union(sqrtf(x * x + y * y + z * z) - 1.0f, box, 0.1f);
}

static void halve(void *user, size_t n, float *x, float *y, float *z) {
    (void)user;
    for (size_t i = 0; i < n; ++i) {
        x[i] *= 0.5f;
        y[i] *= 0.5f;
        z[i] *= 0.5f;
    }
}

static const char map_glsl[] = "return my_half(p);";
static const char map_prelude[] = "vec3 my_half(vec3 p) {\n    return 0.5 * p;\n}\n";

static void make_callers(glsl_world *world) {
    world->bound = spt_bound_sphere(0.25f, -0.5f, 0.0f, 1.25f);
    world->ball = spt_field_default();
    world->ball.point = ball;
    world->ball.glsl = "return length(p - vec3(0.25, -0.5, 0.0)) - 1.0;";
    world->body = world->ball;
    world->body.flags = SPT_FIELD_CONVEX;
    world->body.bound = &world->bound;
    world->shapes = spt_field_default();
    world->shapes.point = shapes;
    world->shapes.glsl_prelude = "float my_box(vec3 p) {\n"
                                 "    return spt_box(p, vec3(0.75));\n"
                                 "}\n";
    world->shapes.glsl = "return spt_smooth_union(spt_sphere(p, 1.0), my_box(p), 0.1);";
    world->callers[0] = world->ball.glsl;
    world->callers[1] = world->shapes.glsl;
    world->callers[2] = world->shapes.glsl_prelude;
    world->callers[3] = map_glsl;
    world->callers[4] = map_prelude;
}

/* ---- Models ---------------------------------------------------------------------------------- */

static int make_krs(glsl_world *world, uint32_t levels, int with_field, spt_krs *krs) {
    static const float tip[3] = {0, 1, 0}, other_tip[3] = {0, 2, 0}, across[3] = {0, 0, 1};
    static const float from[3] = {0, 0, 0}, to[3] = {0, 1, 0}, through[3] = {0.125f, 0.5f, 0};
    spt_krs_model model = spt_krs_model_default();
    for (uint32_t i = 0; i <= levels; ++i) {
        spt_kernel *const kernel = &world->kernels[i];
        switch (i % 6) {
        case 1:
            *kernel = spt_kernel_capsule(from, to, through, 0.0625f);
            break;
        case 2:
            *kernel = spt_kernel_leaf(tip, other_tip, across, 0.25f, 0.015625f);
            break;
        case 3:
            *kernel = spt_kernel_empty();
            break;
        case 4:
            *kernel = spt_kernel_half_space(0, 1, 0, -4.0f);
            break;
        case 5:
            *kernel = spt_kernel_capsule(from, tip, tip, 0.125f);
            break;
        default:
            *kernel = spt_kernel_sphere(0.25f, 0.125f, 0, 0.5f + (float)i);
            break;
        }
        if (with_field && i == 0) *kernel = spt_kernel_field(&world->ball);
    }
    for (uint32_t i = 0; i < levels; ++i) {
        static const float normals[3][3] = {{1, 0, 0}, {0.6f, 0.8f, 0}, {0, -0.6f, 0.8f}};
        memcpy(world->mirrors[i].normal, normals[i % 3], sizeof normals[0]);
        world->mirrors[i].offset = 1.5f + (float)i / 3.0f;
    }
    model.levels = levels;
    model.kernels = world->kernels;
    model.mirrors = world->mirrors;
    return spt_krs_build(&model, krs) == SPT_OK;
}

static int make_moekrs(glsl_world *world) {
    static const double by[3] = {-1.5, 0.25, 0}, axis[3] = {0, 0, 1}, center[3] = {3, 1, 0.5};
    spt_mobius part;
    spt_moekrs_model model = spt_moekrs_model_default();
    int made = 1;
    for (int i = 0; i < 4; ++i) world->kernels[i] = spt_kernel_sphere(-0.75f, 0, 0, 0.5f);
    world->kernels[2] = spt_kernel_empty();
    made &= spt_mobius_translation(by, &world->maps[0]) == SPT_OK;
    made &= spt_mobius_rotation(axis, 0.5, &part) == SPT_OK;
    made &= spt_mobius_compose(&world->maps[0], &part, &world->maps[1]) == SPT_OK;
    made &= spt_mobius_inversion(center, 2.0, &world->maps[2]) == SPT_OK;
    model.levels = 3;
    model.kernels = world->kernels;
    model.maps = world->maps;
    model.unmirrored = 2;
    return made && spt_moekrs_build(&model, &world->moekrs) == SPT_OK;
}

static int make_conformal(glsl_world *world, const spt_field *inner, spt_field *field) {
    static const double center[3] = {4, 3, 0.5};
    return spt_mobius_inversion(center, 3.0, &world->maps[0]) == SPT_OK &&
           spt_conformal_field(inner, &world->maps[0], &world->conformal, field) == SPT_OK;
}

static int make_distorted(glsl_world *world, const spt_field *inner, spt_distortion_kind kind,
                          spt_field *field) {
    spt_distortion distortion = spt_distortion_default();
    distortion.kind = (uint32_t)kind;
    distortion.rate = 0.125f;
    distortion.wave = 0.5f;
    distortion.phase = 0.25f;
    if (kind == SPT_DISTORTION_MAP) {
        world->box = spt_bound_box(-3, -3, -3, 3, 3, 3);
        distortion.unmap = halve;
        distortion.lipschitz = 0.5f;
        distortion.bound = &world->box;
        distortion.glsl = map_glsl;
        distortion.glsl_prelude = map_prelude;
    }
    return spt_distorted_field(inner, &distortion, &world->distorted, field) == SPT_OK;
}

static int make_level_set(glsl_world *world, const spt_field *inner, spt_field *field) {
    static const float eye[3] = {0, 0, -5};
    world->settings.pixel_radius = 1e-3f;
    return spt_level_set_field(inner, eye, 0, 0.5f, &world->settings, &world->level_set, field) ==
           SPT_OK;
}

static int make_nested(glsl_world *world) {
    spt_field krs, conformal, twist;
    if (!make_krs(world, 0, 1, &world->krs)) return 0;
    krs = spt_krs_field(&world->krs);
    krs.bound = &world->bound;
    return make_conformal(world, &krs, &conformal) &&
           make_distorted(world, &conformal, SPT_DISTORTION_TWIST, &twist) &&
           make_level_set(world, &twist, &world->field);
}

/* ---- Scenes ---------------------------------------------------------------------------------- */

/* One field for each kind of volume; the bodies need not be inside of them. */
static int make_scene(glsl_world *world, int convex) {
    static const float low[3] = {-1, 0, 0}, high[3] = {1, 0.5f, 0}, normal[3] = {0, 2, 1};
    static const float half[3] = {1, 2, 3}, center[3] = {0.5f, 0, 0};
    static float axis[3][3] = {{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}};
    static const spt_bound_plane planes[3] = {
        {{1, 0, 0}, 1}, {{0, 2, 0}, 1.5f}, {{-1, -1, 0.5f}, 2}};
    spt_bound *const bounds = world->bounds;
    size_t count = 0;
    memcpy(world->planes, planes, sizeof planes);
    bounds[0] = spt_bound_sphere(0.25f, -0.5f, 0, 1.25f);
    bounds[1] = spt_bound_box(-1, -2, -3, 1, 2, 3);
    bounds[2] = spt_bound_oriented_box(center, axis, half);
    bounds[3] = spt_bound_capsule(low, high, 0.75f);
    bounds[4] = spt_bound_cylinder(low, high, 0.75f);
    bounds[5] = spt_bound_ellipsoid(center, axis, half);
    bounds[6] = spt_bound_slab(normal, -1, 2);
    bounds[7] = spt_bound_polytope(world->planes, 3);
    for (; count < 8; ++count) {
        world->fields[count] = count % 2 == 0 || convex ? world->body : world->shapes;
        world->fields[count].bound = &bounds[count];
    }
    world->fields[count++] = convex ? world->body : world->ball;
    if (!convex) {
        if (!make_krs(world, 3, 0, &world->krs) || !make_krs(world, 2, 1, &world->krs_other))
            return 0;
        world->fields[count++] = spt_krs_field(&world->krs);
        world->fields[count] = spt_krs_field(&world->krs_other);
        world->fields[count++].lipschitz = 1.5f;
    }
    for (size_t i = 0; i < count; ++i) world->materials[i] = (int32_t)(7 * i) - 3;
    world->scene.count = count;
    world->scene.materials = world->materials;
    return 1;
}

static int make_subject(glsl_world *world) {
    switch (world->subject) {
    case GLSL_BALL:
        world->field = world->ball;
        return 1;
    case GLSL_BODY:
        world->field = world->body;
        return 1;
    case GLSL_SHAPES:
        world->field = world->shapes;
        return 1;
    case GLSL_STEEP:
        world->field = world->shapes;
        world->field.lipschitz = 3.0f;
        return 1;
    case GLSL_KRS_0:
    case GLSL_KRS_1:
    case GLSL_KRS_64: {
        const uint32_t levels = world->subject == GLSL_KRS_0   ? 0
                                : world->subject == GLSL_KRS_1 ? 1
                                                               : SPT_KRS_LEVELS;
        if (!make_krs(world, levels, 0, &world->krs)) return 0;
        world->field = spt_krs_field(&world->krs);
        return 1;
    }
    case GLSL_KRS_FIELD:
        if (!make_krs(world, 5, 1, &world->krs)) return 0;
        world->field = spt_krs_field(&world->krs);
        return 1;
    case GLSL_MOEKRS:
        if (!make_moekrs(world)) return 0;
        world->field = spt_moekrs_field(&world->moekrs);
        return 1;
    case GLSL_CONFORMAL:
        return make_conformal(world, &world->body, &world->field);
    case GLSL_TWIST:
    case GLSL_BEND:
    case GLSL_TAPER:
    case GLSL_SWAY:
    case GLSL_MAP: {
        const int kind = SPT_DISTORTION_TWIST + (int)world->subject - GLSL_TWIST;
        return make_distorted(world, &world->body, (spt_distortion_kind)kind, &world->field);
    }
    case GLSL_LEVEL_SET:
        return make_level_set(world, &world->body, &world->field);
    case GLSL_NESTED:
        return make_nested(world);
    case GLSL_SCENE_1:
        world->fields[0] = world->body;
        world->scene.count = 1;
        return 1;
    default:
        return make_scene(world, world->subject == GLSL_CONVEX_SCENE);
    }
}

int glsl_world_make(glsl_world *world, glsl_subject subject) {
    static const float eye[3] = {0, 1, -5}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    memset(world, 0, sizeof *world);
    check_context("%s", glsl_subject_names[subject]);
    world->subject = subject;
    world->settings = spt_settings_default();
    world->settings.method = spt_basic();
    world->scene = spt_scene_default();
    world->scene.fields = world->fields;
    make_callers(world);
    int made = make_subject(world);
    made &= spt_camera_pinhole(&world->camera, eye, target, up, 0.5f, 320, 200) == SPT_OK;
    CHECK(made);
    world->options = spt_glsl_options_default();
    world->options.settings = &world->settings;
    world->options.camera = &world->camera;
    if (subject >= GLSL_SCENE_1) {
        world->options.scene = &world->scene;
    } else {
        world->options.field = &world->field;
    }
    return made;
}

const spt_field *glsl_world_field(const glsl_world *world) {
    return world->options.scene != NULL ? &world->fields[0] : &world->field;
}
