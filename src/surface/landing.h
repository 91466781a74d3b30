/* SPDX-License-Identifier: MIT
 *
 * What the files of this room share: the fields that were hit, and hits of one field side by side
 * as arrays, a batch at a time. */
#ifndef SPTI_LANDING_H
#define SPTI_LANDING_H

#include <spheretrace/surface.h>

#include "../base/columns.h"
#include "../base/compiler.h"
#include "../trace/driver.h"

/* A caller's field, checked and copied, and what follows from it. */
typedef struct spti_target {
    spt_field field;
    spt_bound bound;
    float size;              /* for the rounding floor */
    float inverse_lipschitz; /* as tracing multiplies by it */
} spti_target;

/* Whether these are fields as a call takes them. */
int spti_fields_are_good(const spt_field *fields, size_t field_count);

/* Takes in one of them. settings may be NULL. */
void spti_target_of(spti_target *target, const spt_field *fields, size_t index,
                    const spt_settings *settings);

/* What is known of hits; all that a call that takes rays and hits reads of them. */
typedef struct spti_landing {
    size_t count;
    uint16_t place[SPT_BATCH]; /* in the window of rays that was read */
    SPTI_ALIGNED(64) float x[SPT_BATCH], y[SPT_BATCH], z[SPT_BATCH], distance[SPT_BATCH];
    float origin[3][SPT_BATCH], direction[3][SPT_BATCH];
    float length[SPT_BATCH];                 /* of the direction */
    float path[SPT_BATCH], reach[SPT_BATCH]; /* reach: largest magnitude in the origin */
    float t[SPT_BATCH];
} spti_landing;

/* A window of rays, of whose hits those of one field after the other are looked at. */
typedef struct spti_wish {
    const spt_rays *rays;
    const spt_hits *hits;
    size_t first, window;            /* rays first .. first + window - 1, window <= SPT_BATCH */
    int32_t component_of[SPT_BATCH]; /* of each active hit; -1: none. One field is component 0
                                      * whatever the hits say */
    int32_t component;               /* whose hits are meant now; -1: no more */
} spti_wish;

/* How many rays the window from `first` on has. */
static inline size_t spti_window(size_t first, size_t count) {
    return count - first < SPT_BATCH ? count - first : SPT_BATCH;
}

/* The window from `first` on, at the first of its components. Where no outcome is given, every ray
 * has hit; */
void spti_wish_begin(spti_wish *wish, const spt_rays *rays, const spt_hits *hits, size_t first,
                     size_t count, size_t field_count);

/* and at the next, in ascending order. */
void spti_wish_next(spti_wish *wish);

/* Reads the hits that are meant; bad rays and numbers that are not finite are left out. */
void spti_land(const spti_wish *wish, spti_landing *landing);

/* Whether all three of a vector's columns, or sinks, are there and fit count values. */
static inline int spti_vectors_fit(const spt_vectors *vectors, size_t count) {
    for (int axis = 0; axis < 3; ++axis) {
        if (vectors->axis[axis].first == NULL) return 0;
        if (!spti_column_fits(&vectors->axis[axis], count)) return 0;
    }
    return 1;
}

static inline int spti_sinks_fit(const spt_vector_sinks *sinks, size_t count) {
    for (int axis = 0; axis < 3; ++axis) {
        if (sinks->axis[axis].first == NULL) return 0;
        if (!spti_sink_fits(&sinks->axis[axis], count)) return 0;
    }
    return 1;
}

/* Whether ray i is to be looked at. */
static inline int spti_is_active(const spt_rays *rays, size_t index) {
    return spti_read_integer(&rays->active, index, -1) != 0;
}

/* The tolerance, world length (trace.h): travelled is path + t |direction|, magnitude the largest
 * of the origin + t |direction|. */
float spti_tolerance(const spti_target *target, const spt_settings *settings, float travelled,
                     float magnitude);

/* That of a landing at its t. */
static inline float spti_landing_tolerance(const spti_target *target, const spt_settings *settings,
                                           const spti_landing *landing, size_t slot) {
    const float way = landing->length[slot] * landing->t[slot];
    return spti_tolerance(target, settings, landing->path[slot] + way, landing->reach[slot] + way);
}

/* Whether a hit is one that tracing converged to, or a refined one: rounding left aside,
 * within the tolerance. */
static inline int spti_converged(const spti_target *target, const spt_settings *settings,
                                 const spti_landing *landing, size_t slot, float residual) {
    const float distance = residual * target->inverse_lipschitz;
    const float tolerance = spti_landing_tolerance(target, settings, landing, slot);
    return distance <= 4.0f * tolerance && distance >= -4.0f * tolerance;
}

/* The permitted error of the pixel cone at t, world length. */
static inline float spti_allowance(const spt_settings *settings, const spti_landing *landing,
                                   size_t slot, float t) {
    return settings->pixel_radius * (landing->path[slot] + landing->length[slot] * t);
}

/* A coordinate of the point at t. */
static inline float spti_point(const spti_landing *landing, int axis, size_t slot, float t) {
    return landing->origin[axis][slot] + t * landing->direction[axis][slot];
}

/* The length of a vector, without over- and underflow; infinite beyond FLT_MAX, 0 where no
 * component reaches FLT_MIN. */
float spti_length(float x, float y, float z);

/* Rays from one on. */
spt_rays spti_rays_from(const spt_rays *rays, size_t first);

/* Adds the work that several calls counted, and the rays and outcomes that came of it, to a
 * caller's statistics. */
void spti_add_statistics(spt_statistics *statistics, const spt_statistics *work,
                         const spt_statistics *rays);

/* Whether field, settings, rays and hits are what spt_trace() takes, with one or more fields. */
int spti_door(const spt_field *fields, size_t field_count, const spt_settings *settings,
              spt_settings *copy, size_t count, const spt_rays *rays, const spt_hits *hits);

#endif
