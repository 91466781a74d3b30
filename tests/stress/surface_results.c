/* SPDX-License-Identifier: MIT
 *
 * The promises of surface.h, one function a call: here those that work on hits, and the choice.
 * Tolerances are worked out in double from the formulas of the headers. */
#include "surface_reading.h"

#include <float.h>
#include <math.h>

/* ---- Hits ------------------------------------------------------------------------------------ */

static uint32_t before(const surface_call *call, const surface_truth *truth, int column,
                       size_t index, uint32_t absent) {
    return call->out[column].first == NULL ? absent : truth->before[column][index];
}

/* Of which field a hit is; -1: none of them. */
static int32_t component_of(const surface_call *call, size_t index) {
    const int32_t component = (int32_t)surface_written(call, OUT_COMPONENT, index, 0);
    if (call->field_count == 1) return 0;
    return component >= 0 && (size_t)component < call->field_count ? component : -1;
}

static int is_hit(const surface_call *call, size_t index) {
    return surface_written(call, OUT_OUTCOME, index, SPT_HIT) == SPT_HIT;
}

/* Such a hit as spt_trace() gives; of others nothing is said but that results are defined. */
static int was_traced(const surface_call *call, const surface_truth *truth, size_t index) {
    const surface_line ray = surface_line_of(call, index);
    const int32_t component = component_of(call, index);
    const float t = surface_float(before(call, truth, OUT_T, index, 0));
    const float residual = surface_float(before(call, truth, OUT_RESIDUAL, index, 0));
    float place[3];
    surface_place_on(&ray, t, place);
    for (int axis = 0; axis < 3; ++axis) {
        if (!surface_is_finite(place[axis])) return 0;
    }
    if (truth->value != NULL && !surface_can_ask(truth, &ray)) return 0;
    return component >= 0 && !surface_ray_is_bad(call, index) && surface_is_finite(residual) &&
           surface_within(t, ray.t_min, ray.t_max) && surface_is_finite(t) &&
           surface_is_value(truth, &ray, component, t, residual);
}

/* By how much f misses what the pixel cone allows, and by how much rounding may blur that. */
static double misses_by(const surface_call *call, const surface_line *ray, int32_t component,
                        int side, double t, double residual, double *blur) {
    const double clear = side * residual / (double)call->fields[component].lipschitz;
    const double allowed =
        (double)call->settings->pixel_radius * ((double)ray->path + t * ray->length);
    *blur = surface_rounding * (fabs(clear) + allowed) + 20 * 0x1p-149;
    return clear - allowed;
}

static const char *wrong_move(const surface_call *call, const surface_truth *truth, size_t index,
                              int side) {
    const surface_line ray = surface_line_of(call, index);
    const int32_t component = component_of(call, index);
    const float t = surface_written_float(call, OUT_T, index, 0.0f);
    const float from = surface_float(before(call, truth, OUT_T, index, 0));
    const float residual = surface_written_float(call, OUT_RESIDUAL, index, 0.0f);
    const float residual_from = surface_float(before(call, truth, OUT_RESIDUAL, index, 0));
    double blur_from, blur;
    const double was =
        misses_by(call, &ray, component, side, (double)from, (double)residual_from, &blur_from);
    const double is = misses_by(call, &ray, component, side, (double)t, (double)residual, &blur);
    MUST(surface_within(t, ray.t_min, ray.t_max) && surface_is_finite(residual));
    MUST(surface_is_value(truth, &ray, component, t, residual));
    MUST(fabs(is) <= fabs(was) + blur + blur_from);
    if (call->iterations == 1) { /* in one round never longer than |f| / lipschitz + allowance */
        const double cap =
            fabs((double)residual_from) / (double)call->fields[component].lipschitz +
            (double)call->settings->pixel_radius * ((double)ray.path + (double)from * ray.length);
        const double ulp = 0x1p-23 * fabs((double)t) * ray.length;
        MUST(fabs((double)t - (double)from) * ray.length <= cap * (1 + surface_rounding) + 2 * ulp);
    }
    return NULL;
}

static const char *wrong_refine(const surface_call *call, const surface_truth *truth,
                                size_t index) {
    const uint32_t flags = surface_written(call, OUT_FLAGS, index, 0);
    const uint32_t t = surface_written(call, OUT_T, index, 0);
    const uint32_t spent = surface_written(call, OUT_EVALUATIONS, index, 0) -
                           before(call, truth, OUT_EVALUATIONS, index, 0);
    if (!is_hit(call, index) || (flags & SPT_FLAG_STEEP) != 0 || component_of(call, index) < 0) {
        MUST(surface_untouched(call, truth, index));
        return NULL;
    }
    MUST(spent <= call->iterations);
    if (t == before(call, truth, OUT_T, index, 0)) {
        MUST(surface_written(call, OUT_RESIDUAL, index, 0) ==
             before(call, truth, OUT_RESIDUAL, index, 0));
        return NULL;
    }
    MUST(surface_is_finite(surface_float(t)));
    if (!was_traced(call, truth, index)) return NULL;
    return wrong_move(call, truth, index, (flags & SPT_FLAG_INSIDE) != 0 ? -1 : 1);
}

/* ---- Vectors --------------------------------------------------------------------------------- */

static const char *wrong_normals(const surface_call *call, size_t index) {
    const float t = surface_written_float(call, OUT_T, index, 0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        MUST(surface_is_finite(surface_written_float(call, OUT_VECTOR + axis, index, 0.0f)));
    }
    MUST(surface_is_normal(call, index));
    if (!is_hit(call, index) || !surface_is_finite(t) || component_of(call, index) < 0) {
        MUST(surface_is_zero(call, index));
    }
    return NULL;
}

/* Where a ray that was traced starts anew. */
static const char *wrong_start(const surface_call *call, const surface_truth *truth, size_t index,
                               const float origin[3], uint32_t start) {
    const surface_line ray = surface_line_of(call, index);
    const int inside = (surface_written(call, OUT_FLAGS, index, 0) & SPT_FLAG_INSIDE) != 0;
    const int across = surface_input_word(call, IN_CROSS, index, 0) != 0;
    const double side = inside != across ? -1.0 : 1.0;
    const int32_t component = component_of(call, index);
    const float t = surface_written_float(call, OUT_T, index, 0.0f);
    const double travelled = (double)ray.path + (double)t * ray.length;
    const double cone = (double)call->settings->pixel_radius * travelled;
    const double floor_there = 0x1p-22 * (surface_largest(origin) + (double)call->settings->size);
    const double tolerance = fmax((double)call->settings->epsilon, fmax(cone, floor_there));
    if (start == SPT_START_AT_HIT) {
        float hit[3];
        surface_place_on(&ray, t, hit);
        for (int axis = 0; axis < 3; ++axis) {
            MUST(surface_bits(hit[axis]) == surface_bits(origin[axis]));
        }
        return NULL;
    }
    if (truth->value == NULL || call->checks == 0) return NULL;
    const double clear = side * (double)surface_value_at(truth, component, origin) /
                         (double)call->fields[component].lipschitz;
    if (start == SPT_START_CLEAR) MUST(clear >= tolerance * (1 - surface_rounding));
    if (start == SPT_START_NEAR) MUST(clear >= 0.0);
    return NULL;
}

static const char *wrong_offset(const surface_call *call, const surface_truth *truth,
                                size_t index) {
    const surface_line ray = surface_line_of(call, index);
    const float t = surface_written_float(call, OUT_T, index, 0.0f);
    const uint32_t start = surface_written(call, OUT_START, index, SPT_START_CLEAR);
    const double travelled = (double)ray.path + (double)t * ray.length;
    float origin[3];
    if (!is_hit(call, index)) {
        MUST(surface_untouched(call, truth, index));
        return NULL;
    }
    if (!was_traced(call, truth, index) && surface_untouched(call, truth, index)) return NULL;
    MUST(start <= SPT_START_AT_HIT);
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = surface_written_float(call, OUT_VECTOR + axis, index, 0.0f);
        MUST(origin[axis] <= INFINITY); /* no NaN */
    }
    if (surface_ray_is_bad(call, index) || !surface_within(t, 0.0f, FLT_MAX)) return NULL;
    if (call->out[OUT_NEW_PATH].first != NULL && fmax(travelled, ray.length) < 0x1p127) {
        const double path = (double)surface_written_float(call, OUT_NEW_PATH, index, 0.0f);
        MUST(fabs(path - travelled) <= surface_rounding * fabs(travelled) + 20 * 0x1p-149);
    }
    if (!was_traced(call, truth, index)) return NULL;
    if (call->out[OUT_START].first == NULL) return NULL;
    return wrong_start(call, truth, index, origin, start);
}

/* ---- All ------------------------------------------------------------------------------------- */

static const char *wrong_answer(const surface_call *call, const surface_truth *truth,
                                size_t index) {
    switch (call->door) {
    case DOOR_REFINE:
        return wrong_refine(call, truth, index);
    case DOOR_NORMALS:
        return wrong_normals(call, index);
    case DOOR_OFFSET:
        return wrong_offset(call, truth, index);
    case DOOR_CONVEX:
        return surface_wrong_convex(call, truth, index);
    case DOOR_OCCLUDED:
        return surface_wrong_occluded(call, index);
    case DOOR_CROSSINGS:
        return surface_wrong_crossings(call, truth, index);
    case DOOR_SHADOW:
        return surface_wrong_shadow(call, index);
    case DOOR_AMBIENT:
        return surface_wrong_ambient(call, index);
    default:
        return surface_wrong_collide(call, index);
    }
}

const char *surface_wrong(const surface_call *call, const surface_truth *truth, size_t index) {
    MUST(surface_same_as_before(call, truth, index, surface_table[call->door].outputs_kept));
    if (surface_is_idle(call, index)) {
        MUST(surface_untouched(call, truth, index));
        return NULL;
    }
    return wrong_answer(call, truth, index);
}

uint64_t surface_most_evaluations(const surface_call *call) {
    const uint64_t budget = call->settings->budget, fields = call->field_count;
    enum { differences = 6 };
    switch (call->door) {
    case DOOR_REFINE:
        return call->iterations;
    case DOOR_NORMALS:
        return differences;
    case DOOR_OFFSET:
        return call->checks;
    case DOOR_CROSSINGS:
        return budget * (2 * (uint64_t)call->most_crossings + 2);
    case DOOR_AMBIENT:
        return call->samples * fields;
    case DOOR_COLLIDE: /* the normal by differences of the nearest field */
        return (budget < 64 ? budget : 64) * fields + differences;
    default:
        return budget;
    }
}
