/* SPDX-License-Identifier: MIT
 *
 * What the stress tests of scenes and frames share: components whose callbacks are audited, a base
 * scene, calls that check all that holds for every result of a union, and the same rays traced
 * component by component with spt_trace(), which is what scene.h promises to return. */
#ifndef TESTS_SCENE_CASES_H
#define TESTS_SCENE_CASES_H

#include <spheretrace/scene.h>

#include "stress.h"

/* ---- Components ---------------------------------------------------------------------------- */

/* A component and what its callbacks saw. */
typedef struct union_part {
    stress_distance_fn *distance;
    const void *data;
    size_t calls, points, faults; /* points with padding; faults: broken promises of field.h */
} union_part;

union_part union_part_of(stress_distance_fn *distance, const void *data);

/* The field of a part for a way, declared convex where the way's method needs that. */
spt_field union_field(const stress_way *way, union_part *part);

/* Twice the distance to a stress_sphere: for lipschitz 2. */
stress_distance_fn union_steep_sphere;

/* ---- The base scene ------------------------------------------------------------------------ */

enum { union_parts = 5, union_rays = 272 };

/* Five components: a unit sphere at (0, 0, 10) with a bound; a sphere before it with a box around
 * it, always declared convex; a floor without end at y = -2; a sphere with lipschitz 2; and the
 * first one again without a bound, which must never be reported. Not to be copied: it points into
 * itself. */
typedef struct union_scene {
    union_part parts[union_parts];
    spt_field fields[union_parts];
    spt_bound bounds[2];
    int32_t materials[union_parts];
    spt_scene scene;
} union_scene;

void union_base(union_scene *self, const stress_way *way);

/* Rays of different lengths over all of it; any index. */
spt_ray union_ray(size_t index);

spt_settings union_settings(const stress_way *way);

/* ---- Calls --------------------------------------------------------------------------------- */

/* At least size bytes, filled with a byte, valid until the next call; NULL where there are none. */
unsigned char *union_memory(size_t size, int fill);

/* Traces in a workspace of exactly the size that is asked for and checks status, statistics, how
 * the callbacks were called and every hit; parts are those of scene->fields. The results are added
 * to those of the way. */
void union_trace(stress_way *way, const spt_scene *scene, union_part *parts,
                 const spt_settings *settings, size_t count, const spt_ray *rays, spt_hit *hits);

/* The checks of every hit. */
void union_check_hits(const spt_scene *scene, const union_part *parts, const spt_settings *settings,
                      size_t count, const spt_ray *rays, const spt_hit *hits);

/* Adds results to those of the way, which must be the same bits at all widths and in both forms. */
void union_record(stress_way *way, const spt_hit *hits, size_t count);

/* ---- Component by component ---------------------------------------------------------------- */

/* What is known of a ray's result when each component was traced by itself. */
typedef struct union_expected {
    int decided;          /* the budget suffices for all of them, and there is no tie of a hit
                               * with a value that is not finite: t, residual, outcome and component
                               * of hit are those of the union */
    spt_hit hit;          /* of the component that is reached first */
    uint64_t evaluations; /* of all: the union takes at most as many, at least those of hit */
    uint64_t fallbacks;   /* likewise */
    uint32_t flags;       /* of any */
    float ratio;          /* least candidate_ratio of any */
} union_expected;

void union_separately(const spt_scene *scene, const spt_settings *settings, size_t count,
                      const spt_ray *rays, union_expected *expected);

/* Returns how many rays were decided. */
size_t union_compare(const union_expected *expected, size_t count, const spt_hit *hits);

#endif
