/* SPDX-License-Identifier: MIT
 *
 * A broad-leaved tree of 17 levels on a meadow, and the same under a twist (Szécsi et al. 2016,
 * section 9.2 and Figure 6). */
#include "model_grow.h"

#include <math.h>

static const model_place home = {{0, -0.1, 0}, 1, 0};

/* Land of folded planes that hardly slope; flat at the tree, where nothing is folded yet. */
static model_component *add_meadow(model_world *world) {
    static const model_plot clearing = {0, 0, 7};
    const spt_kernel slope = spt_kernel_half_space(0.014f, 1, 0.009f, 0);
    model_sketch sketch;
    model_wood folds;
    model_plant(&folds, &clearing, 1, 6, 3);
    sketch_begin(&sketch, &slope);
    model_multiply(&sketch, &folds);
    return sketch_add(world, &sketch, 2.5, NULL, MODEL_GRASS);
}

static model_component *add_roots(model_world *world, const model_place *place) {
    model_sketch sketch;
    model_grow_roots(&sketch, model_oak.half_width, place);
    return sketch_add(world, &sketch, 0.05, NULL, MODEL_BARK);
}

static model_component *add_oak(model_world *world, const model_place *place) {
    static const float green[3] = {1, 1, 1};
    model_sketch sketch;
    model_grow(&sketch, &model_oak, place);
    return model_add_tree(world, &sketch, green);
}

/* variant: 0 in still air; other numbers in the wind, at that many tenths of a second. */
static int build(model_world *world, int variant) {
    model_begin(world);
    if (add_oak(world, &home) == NULL) return 0;
    if (variant != 0) {
        spt_distortion wind = spt_distortion_default();
        wind.kind = SPT_DISTORTION_SWAY;
        wind.side[0] = 0.8f;
        wind.side[2] = 0.6f;
        wind.rate = 0.006f;
        wind.wave = 0.25f;
        wind.phase = 0.22f * (float)variant;
        if (model_distort(world, &wind) == NULL) return 0;
    }
    if (add_roots(world, &home) == NULL || add_meadow(world) == NULL) return 0;
    return model_finish(world);
}

/* variant: 1 for the tree as it grew. */
static int build_twisted(model_world *world, int variant) {
    model_begin(world);
    if (add_oak(world, &home) == NULL) return 0;
    if (variant != 1) {
        spt_distortion twist = spt_distortion_default();
        twist.kind = SPT_DISTORTION_TWIST;
        twist.rate = 0.2f;
        if (model_distort(world, &twist) == NULL) return 0;
    }
    if (add_roots(world, &home) == NULL || add_meadow(world) == NULL) return 0;
    return model_finish(world);
}

const model model_tree = {.name = "tree",
                          .description = "an oak of 17 levels, 196 608 leaves",
                          .eye = {9.4, 1.7, 11.8},
                          .target = {0, 4.45, 0},
                          .field_of_view = 64,
                          .t_max = 300,
                          .haze = 200,
                          .under_water = 0,
                          .build = build};

const model model_twisted_tree = {.name = "twisted_tree",
                                  .description = "the oak, twisted by a Lipschitz distortion",
                                  .eye = {9.4, 1.7, 11.8},
                                  .target = {0, 4.45, 0},
                                  .field_of_view = 64,
                                  .t_max = 300,
                                  .haze = 200,
                                  .under_water = 0,
                                  .build = build_twisted};
