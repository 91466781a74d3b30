/* SPDX-License-Identifier: MIT
 *
 * Scenes whose callbacks are listened to: how often each component is asked, where, and whether as
 * field.h and bound.h promise. */
#ifndef TESTS_ORACLE_SCENE_AUDIT_H
#define TESTS_ORACLE_SCENE_AUDIT_H

#include "scene_run.h"

enum { audited_components = 128 };

/* One component. */
typedef struct scene_listener {
    spt_field inner;
    struct scene_audit *audit;
    uint64_t calls, points; /* of the callback, with padding */
    uint64_t distinct;      /* points without repetitions in a batch */
    float last[3];          /* the first point of the last call */
} scene_listener;

/* Not to be copied. The faults count broken promises:
 *   bad_count   n not a multiple of 16 from 16 to SPT_BATCH
 *   unaligned   an array not at 64 bytes
 *   infinite    a coordinate that is not finite
 *   outside     a point outside the component's bound, widened as bound.h says */
typedef struct scene_audit {
    spt_scene scene; /* the scene to trace */
    spt_field fields[audited_components];
    scene_listener listeners[audited_components];
    double reach, longest; /* of the rays: the largest coordinate of an origin, and how far a point
                            * of a ray may be from its origin */
    int bad_count, unaligned, infinite, outside;
} scene_audit;

/* Listens to a scene, for rays whose origins have coordinates up to reach and whose points are up
 * to longest away from them. */
void scene_audit_of(scene_audit *self, const spt_scene *listened, double reach, double longest);

/* All counts zero again. */
void scene_audit_restart(scene_audit *self);

/* No fault so far. */
void scene_audit_check(const scene_audit *self);

/* The sums over the components. */
uint64_t scene_audit_calls(const scene_audit *self);
uint64_t scene_audit_points(const scene_audit *self);
uint64_t scene_audit_distinct(const scene_audit *self);

#endif
