/* SPDX-License-Identifier: MIT
 *
 * What the files of this room share: points on their way through the levels of a model, and the
 * kernels that take them there. */
#ifndef SPTI_SEQUENCE_H
#define SPTI_SEQUENCE_H

#include <spheretrace/mobius.h>

#include <float.h>
#include <math.h>

#include "../backend/isa.h"
#include "../base/compiler.h"

/* Coordinates of what models are built from. A point beyond stands for the nearest one within, whose
 * distances are joined with the way to it: they go on growing, and no square overflows. */
#define SPTI_FARTHEST 1e18f

/* Levels of a model that follow each other without a caller's field between them: those numbered
 * first down to last. Level i is the fold or map i, if i < levels, and kernel i. */
typedef struct spti_stretch {
    uint32_t levels; /* of the whole model */
    uint32_t first, last;
    int begins;  /* nothing was asked before: distance holds nothing yet */
    int goes_on; /* points are needed afterwards */
    const spt_built_kernel *kernels;
    const spt_mirror *mirrors; /* of a KRS, or else: */
    const spt_built_map *maps;
    uint64_t unmirrored;
} spti_stretch;

/* Points on their way, at most SPT_BATCH, aligned. */
typedef struct spti_way {
    float *x, *y, *z;
    float *distance; /* the least so far, of the world */
    /* of maps, for the bound of the distance: */
    float *shrink; /* lengths where the points are now are so many times those of the world, */
    float *reach;  /* no empty ball of the world is larger than one over this, */
    float *clear;  /* and one of this radius holds nothing of what is still to come */
    /* or for probes: */
    float *radius; /* of the ball where the points are now; below 0: decided */
} spti_way;

/* A callback's points, for a way that does not write them. */
static inline float *spti_unwritten(const float *points) {
    return (float *)(uintptr_t)points;
}

/* A coordinate for a caller's callback: finite, wherever maps and folds have taken a point. */
static inline float spti_in_range(float coordinate) {
    if (!(coordinate >= -FLT_MAX)) return coordinate < 0.0f ? -FLT_MAX : 0.0f;
    return coordinate <= FLT_MAX ? coordinate : FLT_MAX;
}

/* Takes n points through a stretch. */
typedef void spti_stretch_fn(const spti_stretch *stretch, size_t n, const spti_way *way);

typedef struct spti_krs_kernels {
    spti_stretch_fn *fold;  /* through mirrors */
    spti_stretch_fn *pull;  /* through maps, for the bound of the distance */
    spti_stretch_fn *probe; /* through maps, for balls */
} spti_krs_kernels;

/* By instruction set. */
extern const spti_krs_kernels *const spti_krs_kernels_of[];

/* Takes points through all levels, caller's fields included. n: a multiple of 16, or one point with
 * max_lanes 1. */
typedef enum spti_walk_kind { SPTI_WALK_FOLD, SPTI_WALK_PULL, SPTI_WALK_PROBE } spti_walk_kind;
void spti_walk(const spti_stretch *model, spti_walk_kind kind, uint32_t max_lanes, size_t n,
               const spti_way *way);

/* Joins the distances of n points with their ways to the nearest one within SPTI_FARTHEST; */
void spti_settle_far(size_t n, const float *x, const float *y, const float *z, float *distance);

/* or the clearances of balls. */
void spti_settle_far_balls(size_t n, const float *x, const float *y, const float *z,
                           const float *radius, float *clearance);

/* What a free ball of radius k at the end of a way through maps leaves free in the world, as in
 * pull_kernel.h. */
static inline float spti_free_radius(float k, float shrink, float reach) {
    if (k > 0x1p64f) k = 0x1p64f;
    return k / (shrink + reach * fabsf(k));
}

/* Asks the caller's field of a kernel for n points, which are kept. lipschitz is divided by. */
void spti_ask_kernel(const spt_built_kernel *kernel, size_t n, const spti_way *way,
                     float *distance);

/* Builds a kernel. Returns 0 where it breaks its rules. ball: receives a ball around it, of radius
 * +infinity where it has no end, and -1 where it is empty. */
typedef struct spti_ball {
    double center[3], radius;
} spti_ball;
int spti_build_kernel(const spt_kernel *kernel, spt_built_kernel *built, spti_ball *ball);

/* The smallest ball around two. */
spti_ball spti_ball_around(const spti_ball *a, const spti_ball *b);

/* What a ball becomes that is cut at a plane and joined by the mirror image of what is left.
 * *straddles: whether it reaches beyond. */
spti_ball spti_mirror_ball(const spti_ball *ball, const spt_mirror *mirror, int *straddles);

/* The image of a ball; one that holds the pole has no end. */
spti_ball spti_map_ball(const spti_ball *ball, const spt_mobius *map);

/* Notes the ball, after the map, with it. */
void spti_map_whole(const spti_ball *ball, spt_built_map *map);

/* As a bound, grown by what rounding may have cut; 0 where it has no end or is empty. */
int spti_bound_of_ball(const spti_ball *ball, spt_bound *bound);

/* Whether what all models are described by is as it should be; between: their mirrors or maps. */
int spti_model_is_good(uint32_t levels, const spt_kernel *kernels, const void *between,
                       float smooth, uint32_t max_lanes);

/* How many kernels are fields. */
uint32_t spti_count_fields(const spt_built_kernel *kernels, uint32_t levels);

/* Whether all field kernels have gradients. */
int spti_have_gradients(const spt_built_kernel *kernels, uint32_t levels);

#endif
