/* SPDX-License-Identifier: MIT
 *
 * A staghorn coral: capsules that fork through unaligned mirrors, beset with cups (Szécsi et al.
 * 2016, section 9.1). Branches that meet a mirror grow into their images, as those of corals do. */
#include "model_nature.h"

#include <math.h>

enum { CORAL_FORKS = 8 };

#define CORAL_QUARTER 1.5707963267948966 /* a quarter turn */

/* A cup that leans outwards from a twig. */
static spt_kernel coral_cup(const double foot[3], const double axis[3], double height, double turn,
                            double radius) {
    const double still[3] = {0, 0, 0};
    double out[3], from[3], to[3];
    sketch_lean(axis, 0.85, turn, out);
    for (int i = 0; i < 3; ++i) {
        from[i] = foot[i] + height * axis[i];
        to[i] = from[i] + 1.85 * radius * out[i];
    }
    return sketch_capsule(from, to, still, 0.32 * radius);
}

/* Cups all over the last twig, which begins at `foot` and has the unit direction `axis`: mirrored
 * about the axis, by planes through it, and then along it. Those planes hardly lean: a mirror turns
 * the twig by twice what it does. A second cup stands in the gaps between the first. */
static void coral_cups(model_sketch *sketch, const double foot[3], const double axis[3],
                       double length, double radius, uint32_t *state) {
    double normal[3], point[3];
    const spt_kernel cup = coral_cup(foot, axis, 0.01 * length, 0, radius);
    const spt_kernel other = coral_cup(foot, axis, 0.07 * length, CORAL_QUARTER / 4, radius);
    sketch_begin(sketch, &cup);
    for (int i = 0; i < 3; ++i) { /* 8 around, each plane at the end of what there is */
        const double turn = CORAL_QUARTER / 4 * (double)((2 << i) - 1);
        sketch_lean(axis, CORAL_QUARTER, CORAL_QUARTER + turn, normal);
        sketch_double(sketch, foot, normal, i == 0 ? &other : NULL);
    }
    for (int i = 0; i < 3; ++i) { /* 8 along */
        const double height = length * 0.125 * (double)(1 << i);
        for (int k = 0; k < 3; ++k) point[k] = foot[k] + height * axis[k];
        sketch_lean(axis, 0.04, model_random(state, 0, 4 * CORAL_QUARTER), normal);
        sketch_double(sketch, point, normal, NULL);
    }
}

/* The way from the foot of the coral to the tip of one of its twigs. */
typedef struct coral_route {
    double fork[CORAL_FORKS + 2][3]; /* the foot, the forks, the tip */
    double axis[CORAL_FORKS + 1][3]; /* directions from each to the next */
    double away[CORAL_FORKS + 1][3]; /* normals of the mirrors at the forks */
} coral_route;

#define CORAL_RADIUS 0.08 /* of the stem */
#define CORAL_THIN 0.032  /* of a twig */
#define CORAL_TWIG 0.26   /* its length */

/* At each fork the mirror holds the direction of the branch below, but for a little, so that the
 * two branches lean away from it to both sides. */
static void coral_grow(coral_route *route, uint32_t *state) {
    const double up[3] = {0, 1, 0}, foot[3] = {0, -0.1, 0};
    double turn = model_random(state, 0, 4 * CORAL_QUARTER);
    double lengths = 0.36;
    for (int k = 0; k < 3; ++k) route->fork[0][k] = foot[k];
    sketch_lean(up, 0.62, turn, route->axis[0]);
    for (int i = 0; i <= CORAL_FORKS; ++i) {
        const double *const axis = route->axis[i];
        const double length =
            i < CORAL_FORKS ? lengths * model_random(state, 0.8, 1.2) : CORAL_TWIG;
        for (int k = 0; k < 3; ++k) {
            route->fork[i + 1][k] = route->fork[i][k] + length * axis[k];
        }
        if (i == CORAL_FORKS) break;
        const double tilt = model_random(state, 0.32, 0.6);
        turn += model_random(state, 1.2, 2.2);
        sketch_lean(axis, tilt, turn, route->axis[i + 1]);
        sketch_lean(axis, -CORAL_QUARTER + model_random(state, -0.12, 0.12), turn,
                    route->away[i + 1]);
        route->axis[i + 1][1] += 0.18; /* towards the light */
        model_unit(route->axis[i + 1]);
        lengths *= 0.93;
    }
}

/* The branches along the route, from the twig down: each added where two of the next one start. */
static void coral_branches(model_sketch *sketch, const coral_route *route, uint32_t *state) {
    for (int i = CORAL_FORKS; i >= 0; --i) {
        const double radius =
            CORAL_THIN + (CORAL_RADIUS - CORAL_THIN) * (CORAL_FORKS - i) / CORAL_FORKS;
        double by[3];
        sketch_lean(route->axis[i], CORAL_QUARTER, model_random(state, 0, 4 * CORAL_QUARTER), by);
        for (int k = 0; k < 3; ++k) by[k] *= i == CORAL_FORKS ? 0.006 : 0.03;
        const spt_kernel branch = sketch_capsule(route->fork[i], route->fork[i + 1], by, radius);
        if (i == CORAL_FORKS) {
            sketch->kernels[sketch->levels] = branch;
        } else {
            sketch_double(sketch, route->fork[i + 1], route->away[i + 1], &branch);
        }
    }
}

/* Stems that lean to all sides, the first away from the mirror it is doubled in. */
static void coral_colony(model_sketch *sketch, const coral_route *route, uint32_t *state) {
    double turn = atan2(route->axis[0][2], route->axis[0][0]) + 2 * CORAL_QUARTER;
    for (int i = 0; i < 3; ++i) {
        const double normal[3] = {cos(turn), model_random(state, -0.15, 0.15), sin(turn)};
        const double point[3] = {0.05 * normal[0], 0, 0.05 * normal[2]};
        sketch_double(sketch, point, normal, NULL);
        turn += model_random(state, 0.7, 1.3);
    }
}

model_component *model_add_coral(model_world *world, const model_place *place, uint32_t seed) {
    model_sketch sketch;
    coral_route route;
    uint32_t state = seed;
    coral_grow(&route, &state);
    coral_cups(&sketch, route.fork[CORAL_FORKS], route.axis[CORAL_FORKS], CORAL_TWIG, CORAL_THIN,
               &state);
    coral_branches(&sketch, &route, &state);
    coral_colony(&sketch, &route, &state);
    sketch_place(&sketch, place->scale, place->turn, place->position);
    return sketch_add(world, &sketch, 0, NULL, MODEL_CORAL);
}

static int build(model_world *world, int variant) {
    const model_place place = {{0, 0, 0}, 1, 0}, bed = {{0, 0, 0}, 1, 2.5};
    (void)variant;
    model_begin(world);
    if (model_add_coral(world, &place, 1) == NULL || model_add_seabed(world, &bed) == NULL) {
        return 0;
    }
    return model_finish(world);
}

const model model_coral = {.name = "coral",
                           .description = "a colony of staghorn coral",
                           .eye = {1.4, 2.3, 6.2},
                           .target = {0, 0.95, 0},
                           .field_of_view = 50,
                           .t_max = 30,
                           .haze = 18,
                           .under_water = 1,
                           .build = build};
