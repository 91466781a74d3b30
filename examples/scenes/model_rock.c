/* SPDX-License-Identifier: MIT
 *
 * A boulder of planar and spherical kernels in many mirrors, all of which straddle (Szécsi et al.
 * 2016, section 9.1 and Fig. 8). Variant 1: flat-shaded. */
#include "model_nature.h"

#include <math.h>

/* A face of the rock, folded all around by planes that pass near the middle: had they met there,
 * all faces would touch one ball; as they do not, some stand out and leave clefts and edges. Before
 * that the face itself is folded, as terrain is. `middle` and `out`: the rock's middle and one of
 * its directions as a face sees them, at that depth and with a normal between all mirrors. */
static void rock_sketch(model_sketch *sketch, uint32_t seed) {
    enum { folds = 9, around = 11 };
    const spt_kernel nothing = spt_kernel_empty();
    model_sketch outer;
    uint32_t state = seed;
    double normal[3], point[3], middle[3] = {0, 0, 0}, out[3];
    sketch_begin(&outer, &nothing);
    for (int i = 0; i < around; ++i) {
        sketch_direction(&state, normal);
        const double far = (0.06 + 0.1 * (double)i / around) * model_random(&state, -1, 1);
        for (int k = 0; k < 3; ++k) point[k] = far * normal[k];
        sketch_double(&outer, point, normal, NULL);
    }
    sketch_direction(&state, out);
    sketch_fold(&outer, 1, out);
    sketch_fold(&outer, 0, middle);

    const double depth = 0.8;
    const spt_kernel face = spt_kernel_half_space((float)out[0], (float)out[1], (float)out[2],
                                                  (float)(model_dot(out, middle) + depth));
    sketch_begin(sketch, &face);
    double span = 0.03, turn = 0;
    for (int i = 0; i < folds; ++i) {
        turn += model_random(&state, 1.2, 2.6);
        sketch_lean(out, 1.5707963267948966 + model_random(&state, -0.14, 0.14), turn, normal);
        for (int k = 0; k < 3; ++k) point[k] = middle[k] + depth * out[k] + span * normal[k];
        sketch_double(sketch, point, normal, NULL);
        span *= 1.35;
    }
    for (int k = 0; k < 3; ++k) point[k] = middle[k] + 0.25 * out[k];
    sketch->kernels[folds] =
        spt_kernel_sphere((float)point[0], (float)point[1], (float)point[2], 0.58f);
    for (int i = 0; i < around; ++i) {
        for (int k = 0; k < 3; ++k) {
            normal[k] = (double)outer.mirrors[i].normal[k];
            point[k] = normal[k] * (double)outer.mirrors[i].offset;
        }
        sketch_double(sketch, point, normal, NULL);
    }
    sketch->kernels[sketch->levels] = spt_kernel_sphere(0, 0, 0, 0.6f);
}

model_component *model_add_rock(model_world *world, const model_place *place, uint32_t seed,
                                double smooth) {
    model_sketch sketch;
    rock_sketch(&sketch, seed);
    sketch_place(&sketch, place->scale, place->turn, place->position);
    const spt_bound bound = spt_bound_sphere((float)place->position[0], (float)place->position[1],
                                             (float)place->position[2], (float)(3 * place->scale));
    return sketch_add(world, &sketch, smooth, &bound, MODEL_ROCK);
}

static int build(model_world *world, int variant) {
    const model_place bed = {{0, 0, 0}, 1, 2.5};
    const model_place places[3] = {
        {{0, 0.55, 0}, 1, 0.4}, {{2.1, 0.1, 0.7}, 0.35, 2}, {{-1.5, 0.05, 1.2}, 0.22, 1}};
    const uint32_t seeds[3] = {117, 8, 9};
    model_begin(world);
    if (model_add_seabed(world, &bed) == NULL) return 0;
    for (int i = 0; i < 3; ++i) {
        const double smooth = variant == 1 ? 0 : 0.05 * places[i].scale;
        if (model_add_rock(world, &places[i], seeds[i], smooth) == NULL) return 0;
    }
    return model_finish(world);
}

const model model_rock = {.name = "rock",
                          .description = "a boulder of planes and spheres in many mirrors",
                          .eye = {1.6, 1.9, 5.6},
                          .target = {0.15, 0.6, 0},
                          .field_of_view = 45,
                          .t_max = 30,
                          .haze = 40,
                          .under_water = 0,
                          .build = build};
