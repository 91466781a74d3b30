/* SPDX-License-Identifier: MIT
 *
 * The batch callbacks that scenes_lanes.c was built into, by width. The build defines
 * SCENE_NO_AVX2, SCENE_NO_AVX512 or SCENE_ONLY_SCALAR for those that it leaves out; the widest that
 * was built then stands in. */
#ifndef EXAMPLES_SCENES_WIDTHS_H
#define EXAMPLES_SCENES_WIDTHS_H

#include <spheretrace/field.h>

#ifdef SCENE_ONLY_SCALAR
#define SCENE_NO_AVX2
#define SCENE_NO_AVX512
#define BATCH_4(name) scene_##name##_batch_1
#else
#define BATCH_4(name) scene_##name##_batch_4
#endif
#ifdef SCENE_NO_AVX2
#define BATCH_8(name) BATCH_4(name)
#else
#define BATCH_8(name) scene_##name##_batch_8
#endif
#ifdef SCENE_NO_AVX512
#define BATCH_16(name) BATCH_8(name)
#else
#define BATCH_16(name) scene_##name##_batch_16
#endif

#define DECLARE_BATCHES(name) \
    spt_distance_batch_fn scene_##name##_batch_1, BATCH_4(name), BATCH_8(name), BATCH_16(name);

#define BATCHES(name) \
    { scene_##name##_batch_1, BATCH_4(name), BATCH_8(name), BATCH_16(name) }

/* The place of a width in such a list. */
static inline int batch_index(int lanes) {
    return lanes >= 16 ? 3 : lanes >= 8 ? 2 : lanes >= 4 ? 1 : 0;
}

#endif
