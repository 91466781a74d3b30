/* SPDX-License-Identifier: MIT
 *
 * All scenes and their components in double precision, from the same source as the callbacks. */
#define SPT_SHAPES_DOUBLE
#include "parts_source.h"
#include "scene_source.h"
#include "scenes.h"

#define REFERENCE_OF(name, prepare) \
    scene_reference_fn scene_##name##_reference; \
    void scene_##name##_reference(size_t n, const double *x, const double *y, const double *z, \
                                  double *distance) { \
        prepare; \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = scene_##name##_distance(spt_point_of(x[i], y[i], z[i])); \
        } \
    }
#define SCENE(name, ...) REFERENCE_OF(name, (void)0)
#define SCENE_BUILT(name, ...) REFERENCE_OF(name, scene_##name##_prepare())
#include "scenes_list.h"

#define PART_LOOP(part, value) \
    part_reference_fn part##_reference; \
    void part##_reference(size_t entry, size_t n, const double *x, const double *y, \
                          const double *z, double *distance) { \
        (void)entry; \
        for (size_t i = 0; i < n; ++i) { \
            const spt_point p = spt_point_of(x[i], y[i], z[i]); \
            distance[i] = value; \
        } \
    }
#define PART(shown, name, ...) PART_LOOP(part_##shown##_##name, shown##_##name(p))
#define PART_TABLE(shown, name, distance_of, type, table, count, ...) \
    PART_LOOP(part_##shown##_##name, distance_of(&(table)[entry], p))
#define PART_WHOLE(shown, ...)
#include "parts_list.h"
