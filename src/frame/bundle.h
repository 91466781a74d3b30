/* SPDX-License-Identifier: MIT
 *
 * Bundles of rays, as cones: 16 at a time are sent ahead through what is empty (Bálint & Valasek
 * 2018, section 4). */
#ifndef SPTI_BUNDLE_H
#define SPTI_BUNDLE_H

#include <spheretrace/frame.h>

#include "../trace/driver.h"

enum { SPTI_BUNDLES = SPTI_GROUP };

/* A camera made ready: the ray through the point (x, y) of the image, in pixels, runs along
 * forward + u right + v up, u = u_0 + x u_step, v = v_0 + y v_step. */
typedef struct spti_view {
    uint32_t kind;
    float eye[3], right[3], up[3], forward[3];
    float u_0, u_step, v_0, v_step;
    float t_min, t_max;
} spti_view;

/* Rays in arrays; for pinhole cameras all origins are the eye. */
typedef struct spti_ray_arrays {
    SPTI_ALIGNED(64) float origin[3][SPT_BATCH];
    SPTI_ALIGNED(64) float direction[3][SPT_BATCH];
} spti_ray_arrays;

/* Every ray of bundle i passes within beta + alpha t of the point at t of its middle ray, for all
 * t; directions are of length 1. Slots that stand for no bundle repeat one and are not usable. */
typedef struct spti_bundles {
    SPTI_ALIGNED(64) float origin[3][SPTI_BUNDLES];
    SPTI_ALIGNED(64) float direction[3][SPTI_BUNDLES];
    SPTI_ALIGNED(64) float alpha[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float beta[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float t_min[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float t_max[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float floor_at_0[SPTI_BUNDLES]; /* SPTI_FLOOR |origin|_inf */
    float widest_alpha, widest_beta;                 /* of the usable ones */
    float origin_low[3], origin_high[3];
    float longest_path; /* that their rays have travelled before */
    unsigned present;   /* slots that stand for a bundle, and */
    unsigned usable;    /* those narrow enough to be sent ahead */
} spti_bundles;

/* A walk of bundles along one component. */
typedef struct spti_walk {
    SPTI_ALIGNED(64) float x[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float y[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float z[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float distance[SPTI_BUNDLES];
    SPTI_ALIGNED(64) float walks[SPTI_BUNDLES]; /* 1: is on its way; 0: has stopped */
    SPTI_ALIGNED(64) float gap[SPTI_BUNDLES];   /* square of the point's distance to the bound */
    SPTI_ALIGNED(64) float t[SPTI_BUNDLES];     /* empty up to here; +infinity: all along */
    SPTI_ALIGNED(64) float t_out[SPTI_BUNDLES]; /* where the bundle has left the bound */
    SPTI_ALIGNED(64) float t_old[SPTI_BUNDLES]; /* the sample before, and the */
    SPTI_ALIGNED(64) float old[SPTI_BUNDLES];   /* empty length there; for secants */
    float epsilon, pixel_radius, inverse_lipschitz, floor_of_size;
    const spt_bound *bound; /* of the component, or NULL */
    int convex;
} spti_walk;

typedef struct spti_cone_kernels {
    /* Rays through points of the image. count <= SPT_BATCH, arrays filled up to whole groups. */
    void (*rays)(const spti_view *view, size_t count, const float *x, const float *y,
                 spti_ray_arrays *rays);
    /* Moves each t to where its bundle can first meet the bound, already grown; sets t_out. */
    void (*enter)(const spti_bundles *bundles, const spt_bound *grown, spti_walk *walk);
    /* The points at t of those that walk, of which there are some, or the nearest ones of the
     * bound; others repeat one. Distances are set to NaN. */
    void (*points)(const spti_bundles *bundles, unsigned walking, spti_walk *walk);
    /* Takes a step with those that walk; returns which ones still do. */
    unsigned (*advance)(const spti_bundles *bundles, spti_walk *walk);
} spti_cone_kernels;
extern const spti_cone_kernels *const spti_cone_kernels_of[];

/* The bundles of 16 rectangles of the image, each {x_0, y_0, x_1, y_1}; those that are not present
 * repeat one that is. */
void spti_bundles_of(const spti_view *view, spti_isa isa, unsigned present,
                     const float (*rectangles)[4], spti_bundles *bundles);

/* Those of a caller's rays: bundle i holds the active ones of rays 16 i .. 16 i + 15, of which
 * there are 256. */
void spti_bundles_of_rays(const spt_camera_ray *rays, spti_bundles *bundles);

/* Sends the usable bundles ahead along a component, by at most so many steps: t[i] is where its
 * rays are free of it up to, at least what it was; +infinity: it cannot be met. Returns the
 * evaluations spent; *more: whether some bundles could go on. */
uint64_t spti_bundles_walk(const spti_bundles *bundles, const spti_call *call, uint32_t steps,
                           float t[SPTI_BUNDLES], int *more);

/* The same by the component's bound alone, without evaluations. */
void spti_bundles_enter(const spti_bundles *bundles, const spti_call *call, float t[SPTI_BUNDLES]);

#endif
