/* SPDX-License-Identifier: MIT
 *
 * A palm: a leaflet is mirrored to both sides of the rib and along it, an inversion in a sphere
 * tapers and bends the straight leaf at once, and more mirrors make a crown of it (Szécsi et al.
 * 2016, section 7 and Fig. 13). Two crowns of eight leaves, one trunk, a beach. */
#include "model_nature.h"

#include <spheretrace/mobius.h>

#include <math.h>

enum {
    PALM_DOUBLINGS = 7, /* along the rib: 128 pairs of leaflets */
    PALM_LEAF = 1 + PALM_DOUBLINGS,
    PALM_CROWN = 3, /* eight leaves */
    PALM_LEVELS = PALM_LEAF + PALM_CROWN
};

#define PALM_QUARTER 1.5707963267948966 /* a quarter turn */

/* What sets one crown apart from the other. */
typedef struct palm_crown {
    double elevation; /* of the leaves where they begin, radians over the horizon */
    double length;    /* of a leaf */
    double turn;      /* of the whole, about y */
    double tilts[PALM_CROWN];
} palm_crown;

/* map followed by a rotation, and by a translation; 0 where the library refused it. */
static int palm_turn(spt_mobius *map, double x, double y, double z, double angle) {
    const double axis[3] = {x, y, z};
    spt_mobius rotation;
    return spt_mobius_rotation(axis, angle, &rotation) == SPT_OK &&
           spt_mobius_compose(&rotation, map, map) == SPT_OK;
}

static int palm_move(spt_mobius *map, double x, double y, double z) {
    const double by[3] = {x, y, z};
    spt_mobius translation;
    return spt_mobius_translation(by, &translation) == SPT_OK &&
           spt_mobius_compose(&translation, map, map) == SPT_OK;
}

/* The straight leaf lies along x: leaflets from -PALM_HALF, the tip, to PALM_HALF, and the rib on
 * to the foot of the stalk at one end and very far at the other. */
#define PALM_HALF 4.0
#define PALM_STALK (PALM_HALF + 0.45)
#define PALM_FAR 400.0

/* Inversion in a sphere around a center beside the stalk. It magnifies what is near and makes hair
 * of what is far: the rib ends close to the center, which is where infinity goes to. What was
 * straight, rib and leaflets, goes to circles through the center, which bend towards it: towards
 * the tip, and down. Then the stalk's foot is brought to the origin, in that direction (up from -x
 * by `elevation`) and size. */
static int palm_bend(const palm_crown *crown, spt_mobius *map) {
    const double center[3] = {PALM_HALF + 0.95, -1.1, 0};
    const double end[3] = {PALM_STALK, 0, 0}, along[3] = {PALM_STALK - 1e-3, 0, 0};
    const double tip[3] = {-PALM_HALF, 0, 0};
    double foot[3], next[3], top[3];
    spt_mobius dilation;
    if (spt_mobius_inversion(center, 1, map) != SPT_OK) return 0;
    spt_mobius_point(map, end, foot);
    spt_mobius_point(map, along, next);
    spt_mobius_point(map, tip, top);
    const double angle = atan2(next[1] - foot[1], next[0] - foot[0]);
    const double chord[3] = {top[0] - foot[0], top[1] - foot[1], top[2] - foot[2]};
    const double size = crown->length / sqrt(model_dot(chord, chord));
    return palm_move(map, -foot[0], -foot[1], -foot[2]) &&
           palm_turn(map, 0, 0, 1, 2 * PALM_QUARTER - crown->elevation - angle) &&
           spt_mobius_dilation(size, &dilation) == SPT_OK &&
           spt_mobius_compose(&dilation, map, map) == SPT_OK;
}

/* The leaf: kernels 0 to PALM_LEAF and as many maps. Its leaflets begin far enough along the stalk
 * to stay in the crown's sectors, but for the ends of the first few. */
static int palm_leaf(const palm_crown *crown, spt_kernel *kernels, spt_mobius *maps) {
    const double step = PALM_HALF / (1 << PALM_DOUBLINGS); /* half of what is between leaflets */
    const float tip[3] = {-0.53f, 0.06f, 0}, foot[3] = {-0.004f, 0, 0};
    const float across[3] = {0.1f, 1, 0.35f};
    const double ends[2][3] = {{PALM_STALK, 0, 0}, {-PALM_FAR, 0, 0}}, still[3] = {0, 0, 0};
    kernels[0] = spt_kernel_leaf(tip, foot, across, 0.021f, 0.001f);
    for (int i = 1; i < PALM_LEAF; ++i) kernels[i] = spt_kernel_empty();
    kernels[PALM_LEAF] = sketch_capsule(ends[0], ends[1], still, 0.012);
    for (int i = 0; i < PALM_LEAF; ++i) maps[i] = spt_mobius_identity();
    /* from the mirror along the rib to those across it, each at the end of what there is */
    if (!palm_turn(&maps[0], 0, 1, 0, PALM_QUARTER) || !palm_move(&maps[0], -step, 0, 0)) return 0;
    for (int i = 1; i < PALM_DOUBLINGS; ++i) {
        if (!palm_move(&maps[i], -step * (double)(1 << i), 0, 0)) return 0;
    }
    return palm_bend(crown, &maps[PALM_DOUBLINGS]);
}

/* The crown: sectors of 45, 90 and 180 degrees, each turned up to the mirror's edge, and tilted so
 * that no two leaves rise alike. */
static int palm_crown_maps(const palm_crown *crown, spt_mobius *maps) {
    static const double turns[PALM_CROWN] = {0.75, -0.5, -1};
    for (int i = 0; i < PALM_CROWN; ++i) {
        spt_mobius *const map = &maps[PALM_LEAF - 1 + i];
        if (i > 0) *map = spt_mobius_identity();
        if (!palm_turn(map, 0, 0, 1, crown->tilts[i]) ||
            !palm_turn(map, 0, 1, 0, turns[i] * PALM_QUARTER)) {
            return 0;
        }
    }
    maps[PALM_LEVELS - 1] = spt_mobius_identity();
    return palm_turn(&maps[PALM_LEVELS - 1], 0, 1, 0, crown->turn);
}

/* A crown around the top of a trunk; which: 0 or 1 of the world's two. */
static model_component *palm_add(model_world *world, size_t which, const palm_crown *crown,
                                 const double top[3]) {
    spt_kernel kernels[PALM_LEVELS + 1];
    spt_mobius maps[PALM_LEVELS];
    spt_moekrs *const moekrs = &world->moekrs[which];
    if (!palm_leaf(crown, kernels, maps) || !palm_crown_maps(crown, maps) ||
        !palm_move(&maps[PALM_LEVELS - 1], top[0], top[1], top[2])) {
        return NULL;
    }
    for (int i = PALM_LEAF + 1; i <= PALM_LEVELS; ++i) kernels[i] = spt_kernel_empty();
    spt_bound *const bound = &world->bounds[world->count];
    *bound =
        spt_bound_sphere((float)top[0], (float)top[1], (float)top[2], (float)(1.6 * crown->length));
    spt_moekrs_model described = spt_moekrs_model_default();
    described.levels = PALM_LEVELS;
    described.kernels = kernels;
    described.maps = maps;
    described.bound = bound;
    if (world->count >= MODEL_COMPONENTS || spt_moekrs_build(&described, moekrs) != SPT_OK) {
        return NULL;
    }
    model_component *const component = &world->components[world->count];
    const model_component leaves = {.moekrs = moekrs, .material = MODEL_LEAF, .tint = {1, 1, 1}};
    *component = leaves;
    world->fields[world->count] = spt_moekrs_field(moekrs);
    ++world->count;
    return component;
}

/* Nuts under the crown, and the trunk. */
static model_component *palm_trunk(model_world *world, const double top[3]) {
    const double foot[3] = {-1.1, -0.3, 0.5}, bulge[3] = {-0.35, -0.05, 0.1};
    const double planes[2][3] = {{1, 0.1, 0.25}, {-0.3, -0.1, 1}};
    const spt_kernel nut = spt_kernel_sphere((float)top[0] - 0.19f, (float)top[1] - 0.24f,
                                             (float)top[2] - 0.13f, 0.12f);
    const spt_kernel trunk = sketch_capsule(foot, top, bulge, 0.13);
    model_sketch sketch;
    sketch_begin(&sketch, &nut);
    sketch_double(&sketch, top, planes[0], NULL);
    sketch_double(&sketch, top, planes[1], &trunk);
    return sketch_add(world, &sketch, 0, NULL, MODEL_BARK);
}

static int build(model_world *world, int variant) {
    static const palm_crown crowns[2] = {{1.0, 2.3, 0.2, {0.1, 0.08, 0.1}},
                                         {0.45, 2.4, 0.6, {0.08, -0.1, 0.06}}};
    const double top[3] = {0, 4, 0};
    const model_place bed = {{0, 0, 0}, 1, 1};
    (void)variant;
    model_begin(world);
    for (size_t i = 0; i < 2; ++i) {
        if (palm_add(world, i, &crowns[i], top) == NULL) return 0;
    }
    if (palm_trunk(world, top) == NULL || model_add_seabed(world, &bed) == NULL) return 0;
    return model_finish(world);
}

const model model_palm = {.name = "palm",
                          .description = "a palm with leaves in Möbius maps",
                          .eye = {0.8, 1.7, 7.6},
                          .target = {-0.3, 2.95, 0},
                          .field_of_view = 55,
                          .t_max = 40,
                          .haze = 60,
                          .under_water = 0,
                          .build = build};
