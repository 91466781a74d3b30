/* SPDX-License-Identifier: MIT
 *
 * The library's own fields: kernel-reflection sequences, maps, deformations, level sets. */
#include "glsl_models.h"

#include <math.h>
#include <string.h>

#include <spheretrace/shapes.h>

enum { tree_levels = 6, bush_levels = 12 };

static spt_krs tree, bush;
static spt_moekrs shells;
static spt_conformal drop;
static spt_distorted screw;
static spt_level_set smaller;

/* A trunk that forks six times, ending in leaves and berries. */
static void build_tree(void) {
    spt_kernel kernels[tree_levels + 1];
    spt_mirror mirrors[tree_levels];
    spt_krs_model model = spt_krs_model_default();
    float from[3] = {0, -1, 0}, to[3] = {0.1f, -0.3f, 0.05f}, size = 0.5f;
    for (int level = tree_levels; level >= 0; --level) {
        const float control[3] = {0.5f * (from[0] + to[0]) + 0.1f * size, 0.5f * (from[1] + to[1]),
                                  0.5f * (from[2] + to[2]) - 0.05f * size};
        kernels[level] = spt_kernel_capsule(from, to, control, 0.1f * size);
        if (level == 3) kernels[level] = spt_kernel_empty();
        if (level == 1) kernels[level] = spt_kernel_sphere(to[0], to[1], to[2], 0.3f * size);
        if (level == 0) kernels[level] = spt_kernel_leaf(from, to, control, 0.2f * size, 0.01f);
        if (level > 0) {
            const float turn = (level & 1) != 0 ? 1.0f : -0.6f;
            const float normal[3] = {-0.9f * turn, -0.1f, 0.4f + 0.2f * turn};
            mirrors[level - 1] = spt_mirror_at(to, normal);
            memcpy(from, to, sizeof from);
            to[0] += 0.6f * turn * size;
            to[1] += 0.7f * size;
            to[2] -= 0.3f * size * (0.4f + turn);
            size *= 0.7f;
        }
    }
    model.levels = tree_levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    spt_krs_build(&model, &tree);
}

/* Kernels of all kinds, callers' fields among them, and mirrors that cut. */
static void build_bush(const spt_field *inner) {
    spt_kernel kernels[bush_levels + 1];
    spt_mirror mirrors[bush_levels];
    spt_krs_model model = spt_krs_model_default();
    for (int level = 0; level <= bush_levels; ++level) {
        const float at = 0.8f - 0.12f * (float)level, low[3] = {0, at, 0},
                    high[3] = {0.3f, at, 0.2f};
        kernels[level] = level % 3 == 0 ? spt_kernel_sphere(0.2f, at, 0.1f, 0.06f)
                                        : spt_kernel_capsule(low, high, high, 0.03f);
        if (level == 4) kernels[level] = spt_kernel_field(inner);
        if (level == bush_levels) kernels[level] = spt_kernel_half_space(0.1f, 1, 0, -0.9f);
        if (level < bush_levels) {
            const float normal[3] = {level % 2 == 0 ? -1.0f : 0.3f, 0.2f,
                                     level % 2 == 0 ? 0.1f : -1.0f};
            mirrors[level] = spt_mirror_at(low, normal);
        }
    }
    model.levels = bush_levels;
    model.kernels = kernels;
    model.mirrors = mirrors;
    spt_krs_build(&model, &bush);
}

/* Bodies that shrink towards the end of a spiral, each with its image. */
static void build_shells(void) {
    enum { levels = 4 };
    static const double axis[3] = {0.2, 1, 0.1}, by[3] = {0.35, 0.3, 0.2}, centre[3] = {2, 0.5, -1};
    spt_kernel kernels[levels + 1];
    spt_mobius maps[levels], shrink, turn, move, invert;
    spt_moekrs_model model = spt_moekrs_model_default();
    spt_mobius_dilation(0.7, &shrink);
    spt_mobius_rotation(axis, 0.8, &turn);
    spt_mobius_translation(by, &move);
    spt_mobius_inversion(centre, 2.5, &invert);
    for (int level = 0; level <= levels; ++level) {
        const float low[3] = {0.1f, -0.4f, 0}, high[3] = {0.5f, 0.5f, 0.1f}, bend[3] = {0.7f, 0, 0};
        kernels[level] = level % 2 == 0 ? spt_kernel_sphere(0.4f, 0, 0.1f, 0.4f)
                                        : spt_kernel_capsule(low, high, bend, 0.15f);
        if (level == levels) continue;
        spt_mobius_compose(&turn, &shrink, &maps[level]);
        spt_mobius_compose(&move, &maps[level], &maps[level]);
        if (level == 1) spt_mobius_compose(&invert, &maps[level], &maps[level]);
    }
    model.levels = levels;
    model.kernels = kernels;
    model.maps = maps;
    model.unmirrored = 4;
    spt_moekrs_build(&model, &shells);
}

static float ring(void *user, float x, float y, float z) {
    (void)user;
    return spt_torus(spt_point_of(x, y, z), 0.7f, 0.2f);
}

static spt_field ring_field(void) {
    static spt_bound around;
    spt_field field = spt_field_default();
    around = spt_bound_sphere(0, 0, 0, 1);
    field.point = ring;
    field.glsl = "return spt_torus(p, 0.7, 0.2);";
    field.bound = &around;
    return field;
}

static float bar(void *user, float x, float y, float z) {
    (void)user;
    return spt_box(spt_point_of(x, y, z), spt_point_of(0.4f, 0.9f, 0.2f));
}

static spt_field bar_field(void) {
    static spt_bound around;
    spt_field field = spt_field_default();
    around = spt_bound_box(-0.4f, -0.9f, -0.2f, 0.4f, 0.9f, 0.2f);
    field.point = bar;
    field.glsl = "return spt_box(p, vec3(0.4, 0.9, 0.2));";
    field.bound = &around;
    return field;
}

enum { most_models = 6 };
static glsl_model models[most_models];
static int model_count;

static spt_field *add(const char *name, int is_sequence) {
    glsl_model *const model = &models[model_count++];
    model->name = name;
    model->is_sequence = is_sequence;
    return &model->field;
}

static void add_changed(void) {
    static const double centre[3] = {0.3, 1.6, -0.4};
    static const float eye[3] = {0, 0, -4};
    spt_mobius invert;
    spt_distortion twist = spt_distortion_default();
    spt_settings settings = spt_settings_default();
    const spt_field torus = ring_field(), box = bar_field();
    spt_mobius_inversion(centre, 1.7, &invert);
    spt_conformal_field(&torus, &invert, &drop, add("drop", 0));
    twist.kind = SPT_DISTORTION_TWIST;
    twist.rate = 1.2f;
    spt_distorted_field(&box, &twist, &screw, add("screw", 0));
    settings.pixel_radius = 5e-3f;
    spt_level_set_field(&torus, eye, 0, 0.5f, &settings, &smaller, add("level set", 0));
}

const glsl_model *glsl_models(int *count) {
    static spt_field berry;
    if (model_count == 0) {
        berry = ring_field();
        build_tree();
        build_bush(&berry);
        build_shells();
        *add("tree", 1) = spt_krs_field(&tree);
        *add("bush", 1) = spt_krs_field(&bush);
        *add("shells", 1) = spt_moekrs_field(&shells);
        add_changed();
    }
    *count = model_count;
    return models;
}
