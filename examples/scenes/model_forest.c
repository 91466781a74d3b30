/* SPDX-License-Identifier: MIT
 *
 * A grove of 32 trees with bushes, and a forest of 1792: different trees stand together, and mirrors, which are
 * those of the land, too, multiply them (Szécsi et al. 2016, sections 5.1 and 9.2). */
#include "model_grow.h"

#include <math.h>

/* A tree of a wood, and the colour of its leaves. */
typedef struct planted {
    const model_kind *kind;
    double x, z, scale, turn;
    float tint[3];
} planted;

/* The slope of the land among the trees that are planted. */
#define SLOPE_X 0.05
#define SLOPE_Z (-0.03)

static model_component *add_land(model_world *world, const model_wood *wood) {
    const spt_kernel slope = spt_kernel_half_space((float)SLOPE_X, 1, (float)SLOPE_Z, 0);
    model_sketch sketch;
    sketch_begin(&sketch, &slope);
    model_multiply(&sketch, wood);
    return sketch_add(world, &sketch, 2, NULL, MODEL_GRASS);
}

/* Bushes between the trees: one, scattered by mirrors of their own before the wood's. */
static model_component *add_bushes(model_world *world, const model_wood *wood) {
    static const model_plot first = {1.5, 3.0, 2.35};
    static const float tint[3] = {0.9f, 1, 0.75f};
    const model_place place = {{first.x, -0.5, first.z}, 0.19, 1};
    model_sketch sketch;
    model_wood scattered;
    model_plant(&scattered, &first, 1, 3, 18);
    model_grow(&sketch, &model_elm, &place);
    model_multiply(&sketch, &scattered);
    model_multiply(&sketch, wood);
    return model_add_tree(world, &sketch, tint);
}

static int plant_wood(model_world *world, const planted *trees, int count, int doublings,
                      double crown, uint32_t seed) {
    model_plot plots[MODEL_PLOTS] = {{0, 0, 0}};
    model_wood wood;
    for (int i = 0; i < count; ++i) {
        const model_plot plot = {trees[i].x, trees[i].z, crown * trees[i].scale};
        plots[i] = plot;
    }
    model_plant(&wood, plots, count, doublings, seed);
    model_begin(world);
    for (int i = 0; i < count; ++i) {
        const planted *const tree = &trees[i];
        const double height = -SLOPE_X * tree->x - SLOPE_Z * tree->z;
        const model_place place = {
            {tree->x, height - 0.15 * tree->scale, tree->z}, tree->scale, tree->turn};
        model_sketch sketch;
        model_grow(&sketch, tree->kind, &place);
        model_multiply(&sketch, &wood);
        if (model_add_tree(world, &sketch, tree->tint) == NULL) return 0;
    }
    if (add_bushes(world, &wood) == NULL) return 0;
    return add_land(world, &wood) != NULL && model_finish(world);
}

static int build_forest(model_world *world, int variant) {
    static const planted trees[] = {{&model_oak, 0, 0, 1.15, 0.3, {1, 1, 1}},
                                    {&model_maple, 7.5, 1.5, 1.0, 2.1, {1.1f, 1.02f, 0.8f}},
                                    {&model_elm, 3.0, 7.5, 1.2, 4.0, {0.85f, 0.95f, 0.9f}},
                                    {&model_linden, -4.5, 7.0, 0.95, 5.2, {1.15f, 1.1f, 0.7f}},
                                    {&model_oak, 9.5, -6.5, 0.9, 1.2, {0.9f, 1, 1}},
                                    {&model_elm, -7.0, 0.5, 0.85, 2.9, {1, 1, 0.85f}},
                                    {&model_maple, 1.5, -7.5, 1.1, 0.8, {0.95f, 0.9f, 0.9f}}};
    (void)variant;
    return plant_wood(world, trees, sizeof trees / sizeof trees[0], 8, 5.2, 11);
}

static int build_grove(model_world *world, int variant) {
    static const planted trees[] = {{&model_oak, 0, 0, 1, 0.3, {1, 1, 1}},
                                    {&model_linden, 9, 4, 0.85, 2.1, {1.15f, 1.1f, 0.75f}},
                                    {&model_elm, 2.0, 11.0, 1.1, 4.0, {0.85f, 0.95f, 0.9f}},
                                    {&model_maple, -9.0, 7.0, 0.75, 5.2, {1.1f, 1, 0.8f}}};
    (void)variant;
    return plant_wood(world, trees, sizeof trees / sizeof trees[0], 3, 5.2, 4);
}

const model model_grove = {.name = "grove",
                           .description = "32 trees of four kinds in a meadow",
                           .eye = {-40, 4, 50},
                           .target = {0, 3.4, 0},
                           .field_of_view = 46,
                           .t_max = 400,
                           .haze = 250,
                           .under_water = 0,
                           .build = build_grove};

const model model_forest = {.name = "forest",
                            .description = "1792 trees and 2048 bushes, 755 million leaves",
                            .eye = {-14.5, 1.8, -15},
                            .target = {10, 3.4, 6},
                            .field_of_view = 68,
                            .t_max = 300,
                            .haze = 110,
                            .under_water = 0,
                            .build = build_forest};
