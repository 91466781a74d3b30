/* SPDX-License-Identifier: MIT
 *
 * A reef: eight components in one lazy union (Szécsi et al. 2016, section 5.1): the bed, two rocks,
 * two corals, a sponge and two schools of fish. */
#include "model_nature.h"

/* Tints a component; 0 where it was refused. */
static int tinted(model_component *component, double red, double green, double blue) {
    if (component == NULL) return 0;
    component->tint[0] = (float)red;
    component->tint[1] = (float)green;
    component->tint[2] = (float)blue;
    return 1;
}

static int build(model_world *world, int variant) {
    const model_place bed = {{0, 0, 0}, 1, 2.5};
    const model_place cliff = {{-2.6, 0.5, -2.2}, 2.0, 0.4}, boulder = {{2.9, 0.1, -2.0}, 1.2, 2};
    const model_place stag = {{1.6, -0.1, 0.2}, 0.62, 1}, thicket = {{-1.9, -0.14, 0.7}, 0.45, 0};
    const model_place sponge = {{-0.2, 0.3, -0.4}, 0.5, 0};
    (void)variant;
    model_begin(world);
    if (model_add_seabed(world, &bed) == NULL ||
        !tinted(model_add_rock(world, &cliff, 117, 0.05), 0.9, 0.85, 0.8) ||
        !tinted(model_add_rock(world, &boulder, 60, 0.04), 0.8, 0.9, 0.95) ||
        !tinted(model_add_coral(world, &stag, 1), 1, 1, 1) ||
        !tinted(model_add_coral(world, &thicket, 8), 0.9, 0.7, 1.2) ||
        !tinted(model_add_sponge(world, &sponge, 2), 1, 1, 1) ||
        model_add_fish(world, MODEL_SCHOOL_SMALL) == NULL ||
        model_add_fish(world, MODEL_SCHOOL_LARGE) == NULL) {
        return 0;
    }
    return model_finish(world);
}

const model model_reef = {.name = "reef",
                          .description = "a reef of eight components",
                          .eye = {0.2, 1.7, 6.2},
                          .target = {0, 1.1, 0},
                          .field_of_view = 58,
                          .t_max = 40,
                          .haze = 18,
                          .under_water = 1,
                          .build = build};
