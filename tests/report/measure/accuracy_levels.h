/* SPDX-License-Identifier: MIT
 *
 * Random models of Möbius levels as deep as a chain may be, with all their instances in long
 * double. Few levels have a mirror, so that the instances of deep models can be counted. */
#ifndef TESTS_REPORT_ACCURACY_LEVELS_H
#define TESTS_REPORT_ACCURACY_LEVELS_H

#include "accuracy.h"

enum { level_most = 28, level_mirrors = 5, level_instances = 1024 };

/* A kernel where it stands, and how it came there: level i had its mirror where bit i is set. */
typedef struct level_instance {
    solid ball;
    int kernel;
    uint64_t mirrors;
} level_instance;

typedef struct level_model {
    int levels;
    uint64_t unmirrored;
    chain map[level_most];
    spt_mobius maps[level_most];
    spt_kernel kernels[level_most + 1];
    int count;
    level_instance instance[level_instances];
    extended middle[3], reach; /* a ball around all of them */
} level_model;

/* Spheres, all of a mirrored level on x < 0. only_first: K_0 alone, the others empty. */
void level_draw(report_random *random, level_model *model, int levels, int only_first);

void level_build(const level_model *model, spt_moekrs *built);

/* A point as kernel 0 sees it, and what it was on the way.
 *   scale    how many times longer lengths are in the world than there
 *   seen     the largest coordinate that a level saw, as a length in the world
 *   mirrors  bit i: the mirror of level i was crossed
 *   nearest  the least distance from a mirror, in its level */
typedef struct level_way {
    place at[level_most + 1]; /* at[i]: in the space of L_i, at[levels]: in the world */
    extended scale, seen, nearest;
    uint64_t mirrors;
} level_way;
void level_follow(const level_model *model, place p, level_way *way);

/* The distance from the nearest instance, negative inside. */
extended level_distance(const level_model *model, const place *p);

/* A float point: anywhere within 1.5 times the reach, or near a random instance's surface. */
void level_somewhere(report_random *random, const level_model *model, float p[3]);
void level_near(report_random *random, const level_model *model, float p[3]);
place level_place(const float p[3]);

#endif
