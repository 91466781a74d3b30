/* SPDX-License-Identifier: MIT
 *
 * All scenes in double precision, from the same source as the callbacks. */
#define SPT_SHAPES_DOUBLE
#include "scene_source.h"
#include "scenes.h"

#define SCENE(name, ...) \
    scene_reference_fn scene_##name##_reference; \
    void scene_##name##_reference(size_t n, const double *x, const double *y, const double *z, \
                                  double *distance) { \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = scene_##name##_distance(spt_point_of(x[i], y[i], z[i])); \
        } \
    }
#include "scenes_list.h"
