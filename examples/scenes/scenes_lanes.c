/* SPDX-License-Identifier: MIT
 *
 * The batch callbacks of all scenes and of their components for one instruction set. Compiled once
 * for each, with its flags and SCENE_LANES 1, 4, 8 or 16; that for 1 also has the callbacks for one
 * point. */
#ifndef SCENE_LANES
#define SCENE_LANES 1
#endif
#define SPT_LANES SCENE_LANES
#include "scene_source.h"

#define PASTE_EXPANDED(name, lanes) scene_##name##_batch_##lanes
#define PASTE(name, lanes) PASTE_EXPANDED(name, lanes)
#define BATCH(name) PASTE(name, SCENE_LANES)

#if SCENE_LANES == 1
#define POINT_OF(name, prepare, value) \
    spt_distance_fn scene_##name##_point; \
    float scene_##name##_point(void *user, float x, float y, float z) { \
        prepare; \
        return value; \
    }
#else
#define POINT_OF(name, prepare, value)
#endif
#define POINT_CALLBACK(name) \
    POINT_OF(name, (void)user, scene_##name##_distance(spt_point_of(x, y, z)))

#define BATCH_CALLBACK(name) \
    spt_distance_batch_fn BATCH(name); \
    void BATCH(name)(void *user, size_t n, const float *restrict x, const float *restrict y, \
                     const float *restrict z, float *restrict distance)

#define SCENE(name, ...) \
    BATCH_CALLBACK(name) { \
        (void)user; \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = scene_##name##_distance(spt_point_of(x[i], y[i], z[i])); \
        } \
    } \
    POINT_CALLBACK(name)

/* n is a multiple of 16, so that blocks of two constant sizes do. */
#define SCENE_BLOCKS(name, ...) \
    BATCH_CALLBACK(name) { \
        size_t i = 0; \
        (void)user; \
        for (; i + SCENE_BLOCK <= n; i += SCENE_BLOCK) { \
            scene_##name##_block(SCENE_BLOCK, x + i, y + i, z + i, distance + i); \
        } \
        for (; i < n; i += 16) scene_##name##_block(16, x + i, y + i, z + i, distance + i); \
    } \
    POINT_CALLBACK(name)

#define SCENE_VECTORS(name, ...) \
    BATCH_CALLBACK(name) { \
        (void)user; \
        scene_##name##_vectors(n, x, y, z, distance); \
    } \
    POINT_CALLBACK(name)

/* These come from the library. */
#define SCENE_BUILT(name, ...)

#include "scenes_list.h"

/* The components that scenes are taken apart into. Those of a table share a source; user is the
 * entry. */
#define PART(shown, name, ...) \
    BATCH_CALLBACK(shown##_##name) { \
        (void)user; \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = shown##_##name(spt_point_of(x[i], y[i], z[i])); \
        } \
    } \
    POINT_OF(shown##_##name, (void)user, shown##_##name(spt_point_of(x, y, z)))

#define PART_TABLE(shown, name, distance_of, type, table, count, ...) \
    BATCH_CALLBACK(shown##_##name) { \
        const type entry = *(const type *)user; \
        for (size_t i = 0; i < n; ++i) { \
            distance[i] = distance_of(&entry, spt_point_of(x[i], y[i], z[i])); \
        } \
    } \
    POINT_OF(shown##_##name, const type *const entry = user, \
             distance_of(entry, spt_point_of(x, y, z)))

#define PART_WHOLE(shown, ...)
#include "parts_list.h"
