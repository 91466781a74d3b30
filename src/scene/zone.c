/* SPDX-License-Identifier: MIT
 *
 * Empty zones (Szécsi et al. 2016, section 8.4): where a ray is in none of the balls that it is to
 * jump over. */
#include <float.h>
#include <math.h>

#include "union.h"

/* Where a ray is inside a zone, rounded to the precision of t: the very numbers that t is compared
 * with, since an exit that rounds below t would be found again for ever. Empty: begin > end. In
 * double, whose range squares any float. */
static spti_clearing covered(const spt_zone *zone, const double origin[3],
                             const double direction[3]) {
    const spti_clearing nowhere = {INFINITY, -INFINITY};
    double square = 0, along = 0, apart = 0;
    for (int axis = 0; axis < 3; ++axis) {
        square += direction[axis] * direction[axis];
        along += direction[axis] * ((double)zone->center[axis] - origin[axis]);
    }
    const double closest = along / square;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = origin[axis] + closest * direction[axis] - (double)zone->center[axis];
        apart += side * side;
    }
    const double room = (double)zone->radius * (double)zone->radius - apart;
    if (!(room > 0)) return nowhere;
    const double half = sqrt(room / square), most = (double)FLT_MAX;
    const double begin = closest - half, end = closest + half;
    if (!(end > 0) || !(begin < most)) return nowhere;
    const spti_clearing inside = {(float)(begin > 0 ? begin : 0), (float)(end < most ? end : most)};
    return inside;
}

static int concerns(const spt_zone *zone, int32_t component) {
    return zone->component < 0 || zone->component == component;
}

spti_clearing spti_zone_clearing(const spt_zone *zones, size_t count, int32_t component,
                                 const double origin[3], const double direction[3], float t) {
    spti_clearing clear = {t, INFINITY};
    /* Behind each zone another one may cover the exit, so at most as many times as there are. */
    int covers = 1;
    for (size_t round = 0; covers && round < count; ++round) {
        covers = 0;
        for (size_t i = 0; i < count; ++i) {
            if (!concerns(&zones[i], component)) continue;
            const spti_clearing inside = covered(&zones[i], origin, direction);
            if (inside.begin <= clear.begin && clear.begin < inside.end) {
                clear.begin = inside.end;
                covers = 1;
            }
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const spti_clearing inside = covered(&zones[i], origin, direction);
        if (concerns(&zones[i], component) && inside.begin > clear.begin &&
            inside.begin < inside.end && inside.begin < clear.end) {
            clear.end = inside.begin;
        }
    }
    return clear;
}
