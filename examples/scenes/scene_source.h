/* SPDX-License-Identifier: MIT
 *
 * What the sources of the scenes are written with: the shapes over spt_real, and constants that
 * are the same numbers in float and in double. Left out: the callbacks, see scenes_lanes.c. */
#ifndef EXAMPLES_SCENE_SOURCE_H
#define EXAMPLES_SCENE_SOURCE_H

#include <spheretrace/field.h>
#include <spheretrace/shapes.h>
#include <spheretrace/simd.h>

/* How many points a scene of many objects takes at a time: for each object one loop over the
 * points, which compilers vectorise, its state in an array that stays in the first cache. A shorter
 * block waits for one minimum after the other, a longer one gains nothing. */
enum { SCENE_BLOCK = 64 };

/* A constant, rounded to float first: the reference in double is then the same scene. */
SPT_SHAPE spt_real real(double value) {
    return (spt_real)(float)value;
}

/* A constant point, likewise. */
SPT_SHAPE spt_point at(double x, double y, double z) {
    return spt_point_of(real(x), real(y), real(z));
}

/* p seen from a constant point: moves the shape there. */
SPT_SHAPE spt_point from(spt_point p, double x, double y, double z) {
    return spt_point_of(p.x - real(x), p.y - real(y), p.z - real(z));
}

#endif
