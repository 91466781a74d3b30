/* SPDX-License-Identifier: MIT
 *
 * Random MöKRS models whose instances are known one by one: every kernel carried through every
 * choice of mirrors by the point maps of moekrs_maps.h. What is true of them, and how far float32
 * may be from it. Left out: the library's answers. */
#ifndef TESTS_ORACLE_MOEKRS_MODEL_H
#define TESTS_ORACLE_MOEKRS_MODEL_H

#include "moekrs_maps.h"

#include <stddef.h>

enum { moekrs_levels = 8, moekrs_room = 511 };

typedef enum moekrs_flavour {
    MOEKRS_PLAIN,      /* spheres; every L_i, images and all, lies on x < 0, and so do those of */
    MOEKRS_INSIDE_OUT, /* the last inversion's centre is in an instance, which becomes all but a
                        * ball */
    MOEKRS_PLANES,     /* K_0 is a half space */
    MOEKRS_SIMILAR,    /* no inversions: maps keep shapes */
    MOEKRS_CUT         /* L_i lies anywhere: instances are not what the field is of */
} moekrs_flavour;
enum { moekrs_flavours = 5 };

typedef struct moekrs_instance {
    moekrs_region region; /* in the world */
    int kernel;
    uint64_t mirrors; /* bit i: the mirror of level i was crossed on the way to the kernel */
    double center[3], radius;
} moekrs_instance;

typedef struct moekrs_model {
    int levels;
    uint64_t unmirrored;
    moekrs_chain chain[moekrs_levels], undone[moekrs_levels];
    spt_mobius maps[moekrs_levels]; /* the library's */
    spt_kernel kernels[moekrs_levels + 1];
    int count;
    moekrs_instance instance[moekrs_room];
    double middle[3], reach; /* a ball around what is worth looking at */
} moekrs_model;

/* A new random model. unmirrored: bits of levels that have no mirror image. */
void moekrs_draw(moekrs_model *model, int levels, moekrs_flavour flavour, uint64_t unmirrored);

/* What the library is told of it: points into the model. */
spt_moekrs_model moekrs_description(const moekrs_model *model);

/* Built; the status is checked. */
void moekrs_built(const moekrs_model *model, uint32_t max_lanes, spt_moekrs *built);

/* Anew from chains and kernels: instances, library's maps and the rest. Returns whether every
 * L_i that is mirrored lies on x < 0. */
int moekrs_expand(moekrs_model *model);

/* The signed distance to the nearest instance, in double, and which it is (or NULL). */
double moekrs_distance(const moekrs_model *model, const float p[3], int *which);

/* Where p is in the space of kernel `kernel` on the way that mirrors tell, and back. */
void moekrs_to_kernel(const moekrs_model *model, int kernel, uint64_t mirrors, const wide p[3],
                      wide q[3]);
void moekrs_to_world(const moekrs_model *model, int kernel, uint64_t mirrors, const wide q[3],
                     wide p[3]);

/* Whether a ball that is carried through the maps comes out inside-out at a level. */
int moekrs_turns(const moekrs_model *model, const float p[3], double rho);

/* The error in world length that float32 may make in comparing the distance at p with rho (0: of
 * the distance alone), and that relative to what is compared. Derived in moekrs_margin.c. */
typedef struct moekrs_error {
    double absolute, relative;
} moekrs_error;
moekrs_error moekrs_margin(const moekrs_model *model, const float p[3], double rho);

/* A random point of 1.5 times the ball around the model; and one of these or, as often, one near a
 * random instance's surface. */
void moekrs_somewhere(const moekrs_model *model, float p[3]);
void moekrs_point(const moekrs_model *model, float p[3]);

#endif
