/* SPDX-License-Identifier: MIT
 *
 * Land from folded planes: hills, and the bed of the sea (Szécsi et al. 2016, section 9.1). */
#include "model_nature.h"

#include <math.h>

#define TERRAIN_TURN 6.283185307179586 /* a whole turn */

/* Doubles the land `count` times by steep mirrors in all directions. They stand at the edge of what
 * there is, `span` from the middle at first and each about `growth` times farther (sqrt(2) fills
 * the plane), and lean by a slope of up to `lean`: what is behind a mirror that leans by an angle is
 * tilted by twice that angle, which gives the land its form at the mirror's scale. The kernel is a
 * plane without end, so that nothing gapes where it is cut. */
static void terrain_fold(model_sketch *sketch, int count, double span, double growth, double lean,
                         uint32_t *state) {
    double turn = model_random(state, 0, TERRAIN_TURN);
    for (int i = 0; i < count; ++i) {
        const double point[3] = {span * cos(turn), 0, span * sin(turn)};
        const double slope = lean * model_random(state, 0.35, 1) * ((i & 1) != 0 ? 1 : -1);
        const double normal[3] = {cos(turn), slope, sin(turn)};
        sketch_double(sketch, point, normal, NULL);
        span *= growth * model_random(state, 0.85, 1.15);
        turn += model_random(state, 1.2, 2.6);
    }
}

model_component *model_add_seabed(model_world *world, const model_place *place) {
    model_sketch sketch;
    uint32_t state = 5;
    const spt_kernel slope = spt_kernel_half_space(0.05f, 1, 0.02f, 0);
    sketch_begin(&sketch, &slope);
    terrain_fold(&sketch, 12, 0.12, 1.35, 0.05, &state);
    sketch_place(&sketch, place->scale, place->turn, place->position);
    return sketch_add(world, &sketch, 0.1 * place->scale, NULL, MODEL_SAND);
}

/* Fine folds of its own, from `span` on, in a plane of that slope and height, and the coarse ones
 * that turf and rock share. */
static model_component *terrain_layer(model_world *world, double slope, double height, double span,
                                      int fine, double lean, uint32_t seed, uint32_t coarse,
                                      model_material material) {
    model_sketch sketch;
    const spt_kernel plane =
        spt_kernel_half_space((float)slope, 1, (float)(0.4 * slope), (float)height);
    sketch_begin(&sketch, &plane);
    terrain_fold(&sketch, fine, span, 1.4, lean, &seed);
    terrain_fold(&sketch, 10, 1.2, 1.4, 0.14, &coarse);
    return sketch_add(world, &sketch, 0.3 * span, NULL, material);
}

static int build(model_world *world, int variant) {
    const uint32_t seed = 5; /* of the coarse folds; chosen by looking, as the fine ones' are */
    (void)variant;
    model_begin(world);
    if (terrain_layer(world, 0.12, 0, 0.1, 9, 0.06, 3, seed, MODEL_GRASS) == NULL ||
        terrain_layer(world, 0.55, -0.28, 0.04, 12, 0.15, 12, seed, MODEL_ROCK) == NULL) {
        return 0;
    }
    return model_finish(world);
}

const model model_terrain = {.name = "terrain",
                             .description = "hills of folded planes",
                             .eye = {0, 6, 12},
                             .target = {0, 2.5, 0},
                             .field_of_view = 55,
                             .t_max = 150,
                             .haze = 100,
                             .under_water = 0,
                             .build = build};
