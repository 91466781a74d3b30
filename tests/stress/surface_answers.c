/* SPDX-License-Identifier: MIT
 *
 * The promises of surface.h for rays that are traced, for points and for bodies. */
#include "surface_reading.h"

#include <float.h>
#include <math.h>

/* ---- Traces ---------------------------------------------------------------------------------- */

static const char *wrong_end(const surface_call *call, const surface_truth *truth, size_t index) {
    const surface_line ray = surface_line_of(call, index);
    const int32_t outcome = (int32_t)surface_written(call, OUT_OUTCOME, index, 0);
    const float t = surface_written_float(call, OUT_T, index, 0.0f);
    const float residual = surface_written_float(call, OUT_RESIDUAL, index, 0.0f);
    const uint32_t flags = surface_written(call, OUT_FLAGS, index, 0);
    if (outcome == SPT_MISS || outcome == SPT_BAD_RAY) {
        MUST(t >= INFINITY && residual >= INFINITY);
        return NULL;
    }
    MUST(surface_within(t, ray.t_min, ray.t_max));
    if (outcome == SPT_NONFINITE) {
        MUST(!(residual >= -FLT_MAX));
        return NULL;
    }
    MUST(residual >= -FLT_MAX);
    if (outcome != SPT_HIT) return NULL;
    /* From inside, the residual is f at the hit up to rounding. */
    if ((flags & SPT_FLAG_INSIDE) == 0) MUST(surface_is_value(truth, &ray, 0, t, residual));
    if ((flags & SPT_FLAG_STEEP) == 0) {
        MUST(fabs((double)residual) / (double)call->fields[0].lipschitz <
             surface_most_tolerance(call, truth, &ray, (double)t));
    }
    return NULL;
}

/* All nine sinks are there. */
const char *surface_wrong_convex(const surface_call *call, const surface_truth *truth,
                                 size_t index) {
    const surface_line ray = surface_line_of(call, index);
    const int32_t outcome = (int32_t)surface_written(call, OUT_OUTCOME, index, 0);
    const uint32_t evaluations = surface_written(call, OUT_EVALUATIONS, index, 0);
    const uint32_t flags = surface_written(call, OUT_FLAGS, index, 0);
    const float nearest = surface_written_float(call, OUT_CANDIDATE_T, index, 0.0f);
    const float ratio = surface_written_float(call, OUT_CANDIDATE_RATIO, index, 0.0f);
    MUST(outcome >= 0 && outcome < SPT_OUTCOMES);
    MUST((outcome == SPT_BAD_RAY) == surface_ray_is_bad(call, index));
    MUST(evaluations <= call->settings->budget);
    MUST(surface_written(call, OUT_FALLBACKS, index, 0) <= evaluations);
    MUST((flags & ~(uint32_t)(SPT_FLAG_STEEP | SPT_FLAG_INSIDE | SPT_FLAG_NOT_CONVEX)) == 0);
    MUST((int32_t)surface_written(call, OUT_COMPONENT, index, 0) == (outcome == SPT_HIT ? 0 : -1));
    if (outcome == SPT_BAD_RAY) MUST(evaluations == 0 && flags == 0);
    if (outcome == SPT_HIT || outcome == SPT_NONFINITE) MUST(evaluations >= 1);
    MUST(ratio >= 0.0f);
    if (surface_is_finite(nearest)) {
        MUST(surface_within(nearest, ray.t_min, ray.t_max));
    } else {
        MUST(nearest >= INFINITY && ratio >= INFINITY);
    }
    return wrong_end(call, truth, index);
}

const char *surface_wrong_occluded(const surface_call *call, size_t index) {
    const uint32_t occluded = surface_written(call, OUT_ANSWER, index, 0);
    MUST(occluded <= 1);
    if (surface_ray_is_bad(call, index)) MUST(occluded == 0);
    return NULL;
}

const char *surface_wrong_shadow(const surface_call *call, size_t index) {
    const float visibility = surface_written_float(call, OUT_ANSWER, index, 0.0f);
    const float tangent = surface_input_float(call, IN_TANGENT, index, 1.0f);
    MUST(surface_within(visibility, 0.0f, 1.0f));
    if (surface_ray_is_bad(call, index) || !(tangent > 0.0f) || !surface_is_finite(tangent)) {
        MUST(visibility <= 0.0f);
    }
    return NULL;
}

/* ---- Crossings ------------------------------------------------------------------------------- */

static float crossing(const surface_call *call, size_t index, uint32_t which) {
    const spt_column view = {(const char *)call->out[OUT_CROSSING].first +
                                 (ptrdiff_t)which * call->crossing_step,
                             call->out[OUT_CROSSING].stride};
    return surface_float(surface_read(&view, index, 0));
}

/* The length between the crossings that were found, where all were. */
static double inside_length(const surface_call *call, size_t index, uint32_t number,
                            uint32_t inside) {
    const surface_line ray = surface_line_of(call, index);
    double sum = 0.0, from = (double)ray.t_min;
    for (uint32_t i = 0; i < number; ++i) {
        const double t = (double)crossing(call, index, i);
        if ((inside ^ i) & 1u) sum += t - from;
        from = t;
    }
    if ((inside ^ number) & 1u) sum += (double)ray.t_max - from;
    return sum * ray.length;
}

static const char *wrong_thickness(const surface_call *call, size_t index, uint32_t number,
                                   uint32_t inside) {
    const surface_line ray = surface_line_of(call, index);
    const float thickness = surface_written_float(call, OUT_THICKNESS, index, 0.0f);
    const uint32_t ended = surface_written(call, OUT_ENDED, index, SPT_MISS);
    MUST(thickness >= 0.0f);
    if (call->out[OUT_ENDED].first == NULL || call->out[OUT_CROSSING].first == NULL) return NULL;
    if (call->out[OUT_INSIDE].first == NULL || ended != SPT_MISS) return NULL;
    const double expected = inside_length(call, index, number, inside);
    if (expected > (double)FLT_MAX / 2) return NULL; /* the library may have lowered t_max */
    /* Every difference is of t within half an ulp, and there are fewer than ten sums. */
    const double most = (double)(number > 0 ? crossing(call, index, number - 1) : ray.t_min);
    const double last = surface_is_finite(ray.t_max) ? (double)ray.t_max : most;
    MUST(fabs((double)thickness - expected) <=
         surface_rounding * (expected + fmax(most, last) * ray.length) + 20 * 0x1p-149);
    return NULL;
}

const char *surface_wrong_crossings(const surface_call *call, const surface_truth *truth,
                                    size_t index) {
    const surface_line ray = surface_line_of(call, index);
    const int bad = surface_ray_is_bad(call, index);
    const uint32_t number = surface_written(call, OUT_NUMBER, index, 0);
    const uint32_t inside = surface_written(call, OUT_INSIDE, index, 0);
    const uint32_t ended = surface_written(call, OUT_ENDED, index, bad ? SPT_BAD_RAY : SPT_MISS);
    MUST(number <= call->most_crossings && inside <= 1 && ended < SPT_OUTCOMES);
    MUST((ended == SPT_BAD_RAY) == bad);
    if (bad) MUST(number == 0);
    if (ended == SPT_HIT && call->out[OUT_NUMBER].first != NULL) {
        MUST(number == call->most_crossings);
    }
    if (call->out[OUT_CROSSING].first != NULL && call->out[OUT_NUMBER].first != NULL) {
        for (uint32_t i = 0; i < number; ++i) {
            const float t = crossing(call, index, i);
            MUST(surface_within(t, i > 0 ? crossing(call, index, i - 1) : ray.t_min, ray.t_max));
        }
        for (uint32_t i = number; i < call->most_crossings && i < surface_most_crossings; ++i) {
            const size_t word = index * surface_most_crossings + i;
            MUST(surface_bits(crossing(call, index, i)) == truth->before[OUT_CROSSING][word]);
        }
    }
    if (bad || call->out[OUT_NUMBER].first == NULL || call->out[OUT_THICKNESS].first == NULL) {
        return NULL;
    }
    return wrong_thickness(call, index, number, inside);
}

/* ---- Points and bodies ----------------------------------------------------------------------- */

static int are_finite(const surface_call *call, int first, size_t index) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!surface_is_finite(surface_input_float(call, first + axis, index, 0.0f))) return 0;
    }
    return 1;
}

const char *surface_wrong_ambient(const surface_call *call, size_t index) {
    const float openness = surface_written_float(call, OUT_ANSWER, index, 0.0f);
    MUST(surface_within(openness, 0.0f, 1.0f));
    if (!are_finite(call, IN_POINT, index) || !are_finite(call, IN_NORMAL, index)) {
        MUST(openness <= 0.0f);
    }
    return NULL;
}

const char *surface_wrong_collide(const surface_call *call, size_t index) {
    const float distance = surface_written_float(call, OUT_ANSWER, index, 0.0f);
    const float place = surface_written_float(call, OUT_PLACE, index, 0.0f);
    const int32_t which = (int32_t)surface_written(call, OUT_WHICH, index, 0);
    const float radius = surface_input_float(call, IN_RADIUS, index, 0.0f);
    const int sound = are_finite(call, IN_POINT, index) && are_finite(call, IN_TO, index) &&
                      surface_within(radius, 0.0f, FLT_MAX);
    MUST(distance <= INFINITY); /* no NaN */
    MUST(surface_within(place, 0.0f, 1.0f));
    MUST(which >= -1 && which < (int32_t)call->field_count);
    for (int axis = 0; axis < 3; ++axis) {
        MUST(surface_is_finite(surface_written_float(call, OUT_VECTOR + axis, index, 0.0f)));
    }
    if (call->out[OUT_VECTOR].first != NULL) MUST(surface_is_normal(call, index));
    if (sound) return NULL;
    MUST(call->out[OUT_ANSWER].first == NULL || distance >= INFINITY);
    MUST(call->out[OUT_WHICH].first == NULL || which == -1);
    MUST(surface_is_zero(call, index));
    return NULL;
}
