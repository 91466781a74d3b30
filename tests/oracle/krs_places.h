/* SPDX-License-Identifier: MIT
 *
 * What the tests of spt_krs_locate() share: a place as one structure, and asking for many. */
#ifndef TESTS_ORACLE_KRS_PLACES_H
#define TESTS_ORACLE_KRS_PLACES_H

#include "krs_draw.h"

typedef struct krs_place {
    float point[3], normal[3], kernel_normal[3], u, v, scale;
    uint64_t mirrors;
    int32_t kernel;
} krs_place;

enum { krs_most_points = 512 };

/* The view of an array of places, everything wanted. */
spt_krs_places krs_places_of(krs_place *array);

/* Locates at most krs_most_points points: rays from them with t = 0 and the given path and pixel radius. */
void krs_locate_points(const spt_krs *krs, float pixel_radius, float path, size_t count,
                       const float (*points)[3], krs_place *places);

#endif
