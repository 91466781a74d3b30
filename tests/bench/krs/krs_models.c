/* SPDX-License-Identifier: MIT
 *
 * A tree whose forks turn by the golden angle (Szécsi et al. 2016, section 9.2), eight of them in
 * two ways, and a leaf of a palm. */
#include "krs_models.h"

#include <math.h>
#include <scenes/model_grow.h>

#include "../frame/frame_picture.h"

enum { TREE = 0, GROVE = 1, COPIES = 2, KINDS = COPIES + KRS_TREES, PALM = KINDS + KRS_TREES };

/* What makes one kind of tree different from another. */
typedef struct tree_kind {
    double turn;      /* from fork to fork, radians; the golden angle, or nearly so */
    double rise;      /* of the direction to which forks lean */
    double on, aside; /* how the route goes on after a fork */
    double shrink;    /* of lengths from branch to branch */
} tree_kind;

static const tree_kind kinds[KRS_TREES] = {
    {2.40, 0.30, 0.85, 0.45, 0.80}, {2.44, 0.20, 0.80, 0.50, 0.79}, {2.36, 0.40, 0.85, 0.50, 0.80},
    {2.48, 0.25, 0.90, 0.45, 0.79}, {2.32, 0.35, 0.80, 0.45, 0.80}, {2.52, 0.30, 0.85, 0.55, 0.78},
    {2.28, 0.20, 0.90, 0.50, 0.79}, {2.42, 0.45, 0.80, 0.55, 0.79}};

static void to_float(const double from[3], float to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = (float)from[axis];
}

/* From the trunk, which is the last kernel, to the twig. */
static void grow(model_sketch *sketch, uint32_t levels, const tree_kind *kind) {
    double fork[3] = {0, 0, 0}, ahead[3] = {0.06, 1, 0}, length = 1.3, radius = 0.09;
    sketch->levels = levels;
    model_unit(ahead);
    for (uint32_t branch = 0; branch <= levels; ++branch) {
        const uint32_t level = levels - branch;
        const double turn = kind->turn * branch;
        const double side[3] = {cos(turn), kind->rise, sin(turn)};
        const double along = model_dot(side, ahead);
        double away[3], end[3], next[3], bulge[3];
        for (int axis = 0; axis < 3; ++axis) away[axis] = along * ahead[axis] - side[axis];
        for (int axis = 0; axis < 3; ++axis) {
            next[axis] =
                branch > 0 ? kind->on * ahead[axis] - kind->aside * away[axis] : ahead[axis];
        }
        model_unit(next);
        const double turned = model_dot(ahead, next);
        for (int axis = 0; axis < 3; ++axis) {
            end[axis] = fork[axis] + length * next[axis];
            bulge[axis] = 0.12 * length * (ahead[axis] - turned * next[axis]);
        }
        sketch->kernels[level] = sketch_capsule(fork, end, bulge, radius);
        if (branch > 0) {
            model_unit(away);
            to_float(away, sketch->mirrors[level].normal);
            sketch->mirrors[level].offset = (float)model_dot(away, fork);
        }
        for (int axis = 0; axis < 3; ++axis) {
            fork[axis] = end[axis];
            ahead[axis] = next[axis];
        }
        length *= kind->shrink;
        radius *= 0.74;
    }
}

/* The walls of the cell that every kind of tree has room in, at any number of levels, since a tree
 * of fewer is a part of one with more. */
static void find_walls(spt_mirror walls[KRS_DOUBLINGS]) {
    static const double gap = 0.05;
    static float low_x, high_x, high_z; /* found once */
    static int known;
    for (int i = 0; i < KRS_TREES && !known; ++i) {
        model_sketch sketch;
        grow(&sketch, KRS_MOST_LEVELS, &kinds[i]);
        const spt_bound box = model_box(&sketch);
        low_x = fminf(low_x, box.low[0]);
        high_x = fmaxf(high_x, box.high[0]);
        high_z = fmaxf(high_z, box.high[2]);
    }
    known = 1;
    const double right = (double)high_x + gap, back = (double)high_z + gap;
    const spt_mirror found[KRS_DOUBLINGS] = {{{1, 0, 0}, (float)right},
                                             {{0, 0, 1}, (float)back},
                                             /* where the first mirror's image ends */
                                             {{1, 0, 0}, (float)(2 * right - (double)low_x + gap)}};
    for (int i = 0; i < KRS_DOUBLINGS; ++i) walls[i] = found[i];
}

static void mirror_point(const spt_mirror *wall, float point[3], float offset) {
    double beyond = -(double)offset;
    for (int axis = 0; axis < 3; ++axis) {
        beyond += (double)wall->normal[axis] * (double)point[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = (float)((double)point[axis] - 2 * beyond * (double)wall->normal[axis]);
    }
}

/* The image of a sketch of capsules. */
static void mirror_sketch(model_sketch *sketch, const spt_mirror *wall) {
    for (uint32_t i = 0; i <= sketch->levels; ++i) {
        spt_kernel *const kernel = &sketch->kernels[i];
        mirror_point(wall, kernel->a, wall->offset);
        mirror_point(wall, kernel->b, wall->offset);
        mirror_point(wall, kernel->control, wall->offset);
    }
    for (uint32_t i = 0; i < sketch->levels; ++i) {
        spt_mirror *const mirror = &sketch->mirrors[i];
        double along = 0;
        for (int axis = 0; axis < 3; ++axis) {
            along += (double)wall->normal[axis] * (double)mirror->normal[axis];
        }
        mirror->offset = (float)((double)mirror->offset - 2 * along * (double)wall->offset);
        mirror_point(wall, mirror->normal, 0.0f);
    }
}

static void build(krs_models *built, int place, const model_sketch *sketch, int lanes) {
    spt_krs_model described = spt_krs_model_default();
    const spt_bound box = model_box(sketch);
    described.levels = sketch->levels;
    described.kernels = sketch->kernels;
    described.mirrors = sketch->mirrors;
    described.bound = &box;
    described.max_lanes = (uint32_t)lanes;
    frame_expect(spt_krs_build(&described, &built->krs[place]), "spt_krs_build");
    built->fields[place] = spt_krs_field(&built->krs[place]);
}

static void build_trees(krs_models *built, int lanes) {
    spt_mirror walls[KRS_DOUBLINGS];
    model_sketch sketch;
    find_walls(walls);
    grow(&sketch, built->levels, &kinds[0]);
    build(built, TREE, &sketch, lanes);
    for (int i = 0; i < KRS_DOUBLINGS; ++i) {
        sketch.mirrors[sketch.levels] = walls[i];
        sketch.kernels[++sketch.levels] = spt_kernel_empty();
    }
    build(built, GROVE, &sketch, lanes);
    for (int i = 0; i < 2 * KRS_TREES; ++i) {
        grow(&sketch, built->levels, &kinds[i < KRS_TREES ? 0 : i - KRS_TREES]);
        for (int wall = 0; wall < KRS_DOUBLINGS; ++wall) {
            if (i >> wall & 1) mirror_sketch(&sketch, &walls[wall]);
        }
        build(built, COPIES + i, &sketch, lanes);
    }
}

/* ---- The palm -------------------------------------------------------------------------------- */

static void then(spt_mobius *map, const spt_mobius *next) {
    frame_expect(spt_mobius_compose(next, map, map), "spt_mobius_compose");
}

/* To where a branch has its end, from where its own branch stands on the origin: leaning to x < 0,
 * smaller, and bent by a translation between two inversions, which leaves the origin as it is. */
static spt_mobius palm_map(uint32_t branch) {
    static const double origin[3] = {0, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    static const double bend[3] = {0.01, 0.02, 0.03}, end[3] = {0, 1, 0};
    spt_mobius map, step;
    frame_expect(spt_mobius_inversion(origin, 1, &map), "spt_mobius_inversion");
    const spt_mobius inversion = map;
    frame_expect(spt_mobius_translation(bend, &step), "spt_mobius_translation");
    then(&map, &step);
    then(&map, &inversion);
    frame_expect(spt_mobius_rotation(y, 0.5 * sin(2.4 * branch), &step), "spt_mobius_rotation");
    then(&map, &step);
    frame_expect(spt_mobius_rotation(z, 0.5, &step), "spt_mobius_rotation");
    then(&map, &step);
    frame_expect(spt_mobius_dilation(0.8, &step), "spt_mobius_dilation");
    then(&map, &step);
    frame_expect(spt_mobius_translation(end, &step), "spt_mobius_translation");
    then(&map, &step);
    return map;
}

static void build_palm(krs_models *built, int lanes) {
    static const double from[3] = {0, 0, 0}, to[3] = {0, 1, 0}, bulge[3] = {0, 0, -0.04};
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mobius maps[SPT_KRS_LEVELS];
    spt_moekrs_model described = spt_moekrs_model_default();
    for (uint32_t i = 0; i <= built->levels; ++i) {
        kernels[i] = sketch_capsule(from, to, bulge, 0.06);
        /* the outermost map is that to the world */
        const uint32_t branch = built->levels - i;
        if (branch > 0) maps[i] = branch > 1 ? palm_map(branch) : spt_mobius_identity();
    }
    described.levels = built->levels;
    described.kernels = kernels;
    described.maps = maps;
    described.max_lanes = (uint32_t)lanes;
    frame_expect(spt_moekrs_build(&described, &built->palm), "spt_moekrs_build");
    built->fields[PALM] = spt_moekrs_field(&built->palm);
}

/* ---- All ------------------------------------------------------------------------------------- */

static spt_scene scene_of(const spt_field *fields, size_t count) {
    spt_scene made = spt_scene_default();
    made.fields = fields;
    made.count = count;
    return made;
}

void krs_models_build(krs_models *built, uint32_t levels, int lanes) {
    built->levels = levels;
    build_trees(built, lanes);
    build_palm(built, lanes);
    built->scenes[KRS_TREE] = scene_of(&built->fields[TREE], 1);
    built->scenes[KRS_GROVE] = scene_of(&built->fields[GROVE], 1);
    built->scenes[KRS_COPIES] = scene_of(&built->fields[COPIES], KRS_TREES);
    built->scenes[KRS_KINDS] = scene_of(&built->fields[KINDS], KRS_TREES);
    built->scenes[KRS_PALM] = scene_of(&built->fields[PALM], 1);
    built->probes[KRS_TREE] = spt_probe_of_field(&built->fields[TREE]);
    built->probes[KRS_PALM] = spt_moekrs_probe(&built->palm);
}

const spt_field *krs_models_field(const krs_models *built, krs_body body) {
    return built->scenes[body].fields;
}

double krs_models_instances(uint32_t levels, krs_body body) {
    const int many = body != KRS_TREE && body != KRS_PALM;
    return spt_krs_instances(levels) * (many ? KRS_TREES : 1);
}

/* A picture wants a scene with a field. */
static void nowhere(void *user, size_t n, const float *x, const float *y, const float *z,
                    float *distance) {
    (void)user, (void)x, (void)y, (void)z;
    for (size_t i = 0; i < n; ++i) distance[i] = 1.0f;
}

#define VIEW(...) \
    { \
        .lipschitz = 1, .batch = {nowhere, nowhere, nowhere, nowhere}, .field_of_view = 48, \
        __VA_ARGS__ \
    }

const scene *krs_view(krs_body body) {
    static const scene tree =
        VIEW(.name = "tree", .eye = {4, 2.8, 11}, .target = {0.4, 2.9, 0}, .t_max = 60);
    static const scene grove =
        VIEW(.name = "grove", .eye = {14, 7, -19}, .target = {9, 2, 3}, .t_max = 120);
    static const scene palm =
        VIEW(.name = "palm", .eye = {1.5, 2.2, -7}, .target = {0, 2.1, 0}, .t_max = 30);
    return body == KRS_TREE ? &tree : body == KRS_PALM ? &palm : &grove;
}
