/* SPDX-License-Identifier: MIT
 *
 * What public doors take in: copies of fields and settings that are checked. Apart from the driver,
 * so that who only writes shaders does not link it. */
#include "../base/arguments.h"
#include "../bound/bound_check.h"
#include "driver.h"

enum {
    FIELD_FLAGS = SPT_FIELD_CONVEX,
    BETWEEN = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST, /* one of them at most */
    SETTINGS_FLAGS = SPT_SKIP_START | SPT_STOP_INSIDE | BETWEEN | SPT_CHECK_CONVEX
};

int spti_field_copy(spt_field *to, spt_bound *bound, const spt_field *from) {
    *to = spt_field_default();
    if (from == NULL || !spti_copy_sized(to, from, sizeof *to)) return 0;
    if (to->batch == NULL && to->point == NULL) return 0;
    if (!spti_within(to->lipschitz, 0x1p-100f, 0x1p100f)) return 0;
    if ((to->flags & ~(uint32_t)FIELD_FLAGS) != 0) return 0;
    return to->bound == NULL || spti_bound_copy(bound, to->bound);
}

int spti_settings_copy(spt_settings *to, const spt_settings *from) {
    memset(to, 0, sizeof *to); /* not the defaults: those would link their method */
    to->struct_size = sizeof *to;
    if (from == NULL || !spti_copy_sized(to, from, sizeof *to)) return 0;
    if (to->method == NULL || (to->flags & ~(uint32_t)SETTINGS_FLAGS) != 0) return 0;
    if ((to->flags & BETWEEN) == BETWEEN) return 0;
    if (to->max_lanes != 0 && to->max_lanes != 1 && to->max_lanes != 4 && to->max_lanes != 8 &&
        to->max_lanes != 16) {
        return 0;
    }
    return to->epsilon > 0.0f && spti_finite(to->epsilon) &&
           spti_within(to->pixel_radius, 0.0f, FLT_MAX) && spti_within(to->size, 0.0f, FLT_MAX) &&
           to->relaxation < 2.0f && spti_within(to->relaxation, 1.0f, 2.0f) &&
           spti_within(to->extrapolation, 0.0f, 1.0f) && to->slope_blend > 0.0f &&
           spti_within(to->slope_blend, 0.0f, 1.0f) && spti_within(to->step_cap, 1.0f, 100.0f);
}

int spti_method_allowed(const spt_method *method, const spt_field *field) {
    return !method->needs_convex || (field->flags & SPT_FIELD_CONVEX) != 0;
}
