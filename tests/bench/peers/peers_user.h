/* SPDX-License-Identifier: MIT
 *
 * The village for Embree's user geometry: the objects, and the callback that traces them. Without
 * any part of this library but the sources of the distances. */
#ifndef TESTS_BENCH_PEERS_USER_H
#define TESTS_BENCH_PEERS_USER_H

#include <embree3/rtcore.h>
#include <scenes/parts.h>
#include <scenes/scene_village.h>

/* How rays are stepped: the basic or the adaptive rule, and the stop of a pinhole's picture (the
 * rounding floor of these coordinates lies below epsilon). */
typedef struct peers_step {
    int adaptive;
    uint32_t budget;
    float epsilon, pixel_radius;
    float extrapolation, step_cap;
    float reach; /* largest coordinates of origin and scene, for the margin of the adaptive rule */
} peers_step;

typedef struct peers_object {
    const village_house *house; /* NULL: the ground */
    float low[3], high[3];      /* the box around it */
} peers_object;

/* One geometry whose primitives are the objects. (A geometry for each object takes the same time
 * within 2 %.) */
typedef struct peers_village {
    peers_step step;
    int ray_by_ray; /* packets, too: the callback is written for one ray. Else it has packets of 16
                     * in vectors by hand */
    unsigned count;
    peers_object objects[SCENE_PARTS_MOST];
} peers_village;

/* Callbacks; user data is a peers_village. */
void peers_user_bounds(const struct RTCBoundsFunctionArguments *arguments);
void peers_user_intersect(const struct RTCIntersectFunctionNArguments *arguments);

#endif
