/* SPDX-License-Identifier: MIT
 *
 * Normals at hits: the caller's gradient, or differences of f over four or six points. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "differences.h"
#include "landing.h"

/* A quarter of the bound's least side, or 1: details are seldom larger. */
static float usual_detail(const spti_target *target) {
    float detail = 1.0f, low[3], high[3];
    if (target->field.bound == NULL) return detail;
    if (spt_bound_extent(&target->bound, low, high) != SPT_OK) return detail;
    for (int axis = 0; axis < 3; ++axis) {
        const float quarter = 0.25f * high[axis] - 0.25f * low[axis];
        if (quarter > 0.0f && quarter < detail) detail = quarter;
    }
    return detail;
}

static void normals_of_window(const spti_target *target, const spt_settings *settings,
                              spt_normal_rule rule, float detail, const spti_wish *wish,
                              float normals[3][SPT_BATCH]) {
    spti_landing landing;
    spti_differences differences;
    spti_land(wish, &landing);
    differences.count = landing.count;
    for (size_t slot = 0; slot < landing.count; ++slot) {
        const float t = landing.t[slot];
        for (int axis = 0; axis < 3; ++axis) {
            differences.point[axis][slot] = spti_point(&landing, axis, slot, t);
        }
        differences.least[slot] = 0.25f * spti_allowance(settings, &landing, slot, t);
    }
    spti_differ(&target->field, rule, detail, &differences, landing.x, landing.y, landing.z,
                landing.distance);
    for (size_t slot = 0; slot < landing.count; ++slot) {
        for (int axis = 0; axis < 3; ++axis) {
            normals[axis][landing.place[slot]] = differences.gradient[axis][slot];
        }
    }
}

spt_status spt_normals(const spt_field *fields, size_t field_count, const spt_settings *settings,
                       spt_normal_rule rule, float detail, size_t count, const spt_rays *rays,
                       const spt_hits *hits, const spt_vector_sinks *normals) {
    spt_settings copy;
    if (!spti_door(fields, field_count, settings, &copy, count, rays, hits)) {
        return SPT_BAD_ARGUMENT;
    }
    if (rule != SPT_NORMAL_TETRAHEDRON && rule != SPT_NORMAL_CENTRAL) return SPT_BAD_ARGUMENT;
    if (!spti_within(detail, 0.0f, FLT_MAX)) return SPT_BAD_ARGUMENT;
    if (count == 0) return SPT_OK;
    if (hits->t.first == NULL || normals == NULL) return SPT_BAD_ARGUMENT;
    if (!spti_sinks_fit(normals, count)) return SPT_BAD_ARGUMENT;
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        float unit[3][SPT_BATCH] = {{0}};
        spti_wish wish;
        spti_wish_begin(&wish, rays, hits, first, count, field_count);
        for (; wish.component >= 0; spti_wish_next(&wish)) {
            spti_target target;
            spti_target_of(&target, fields, (size_t)wish.component, &copy);
            normals_of_window(&target, &copy, rule, detail > 0.0f ? detail : usual_detail(&target),
                              &wish, unit);
        }
        for (size_t place = 0; place < wish.window; ++place) {
            if (!spti_is_active(rays, first + place)) continue;
            for (int axis = 0; axis < 3; ++axis) {
                spti_write(&normals->axis[axis], first + place, unit[axis][place]);
            }
        }
    }
    return SPT_OK;
}
