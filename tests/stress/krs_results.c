/* SPDX-License-Identifier: MIT
 *
 * What every result must satisfy: the table of outcomes in trace.h with what mobius.h says of it,
 * and the places of krs.h. */
#include "krs_results.h"

#include <float.h>
#include <math.h>
#include <string.h>

uint32_t krs_read(const spt_column *column, size_t index, uint32_t absent) {
    if (column->first == NULL) return absent;
    memcpy(&absent, (const char *)column->first + (ptrdiff_t)index * column->stride, 4);
    return absent;
}

uint32_t krs_written(const spt_sink *sink, size_t index, uint32_t absent) {
    const spt_column column = {sink->first, sink->stride};
    return krs_read(&column, index, absent);
}

static float number_in(const krs_call *call, int column, size_t index, float absent) {
    return krs_float(krs_read(&call->in[column], index, krs_bits(absent)));
}

static uint32_t word_out(const krs_call *call, int column, size_t index) {
    return krs_written(&call->out[column], index, 0);
}

static float number_out(const krs_call *call, int column, size_t index) {
    return krs_float(word_out(call, column, index));
}

static int is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

static int is_infinite(float a) {
    return a > FLT_MAX;
}

static int untouched(const krs_call *call, unsigned char before, size_t index) {
    for (int column = 0; column < krs_table[call->door].outputs; ++column) {
        const spt_sink *const sink = &call->out[column];
        const unsigned char *const at =
            (const unsigned char *)sink->first + (ptrdiff_t)index * sink->stride;
        for (size_t i = 0; sink->first != NULL && i < krs_width(call->door, column); ++i) {
            if (at[i] != before) return 0;
        }
    }
    return 1;
}

/* ---- Rays ------------------------------------------------------------------------------------ */

int krs_ray_is_bad(const krs_call *call, size_t index) {
    const float t_min = number_in(call, KRS_IN_T_MIN, index, 0.0f);
    const float t_max = number_in(call, KRS_IN_T_MAX, index, INFINITY);
    const float path = number_in(call, KRS_IN_PATH, index, 0.0f);
    int all = is_finite(t_min) && is_finite(path) && t_min >= 0.0f && path >= 0.0f, some = 0;
    all = all && t_max <= INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const float along = number_in(call, 3 + axis, index, 0.0f);
        all = all && is_finite(number_in(call, axis, index, 0.0f)) && is_finite(along);
        some = some || fabsf(along) >= FLT_MIN;
    }
    return !(all && some);
}

static const spt_bound *bound_of(const krs_call *call) {
    if (call->door == KRS_DOOR_EXITS) {
        return call->conformal->bound.struct_size != 0 ? &call->conformal->bound : NULL;
    }
    if (call->door == KRS_DOOR_PROBES || call->door == KRS_DOOR_FIELD_PROBES) {
        return call->probe->bound;
    }
    return call->field->bound;
}

/* tolerance(t) of trace.h, with the rounding of fewer than ten operations in float, each within
 * 2^-24 on either side, or, where its numbers are denormal, within 2^-149. */
static double most_tolerance(const krs_call *call, size_t index, float t) {
    float low[3], high[3];
    double square = 0, reach = 0, size = (double)call->settings->size;
    const spt_bound *const bound = bound_of(call);
    for (int axis = 0; axis < 3; ++axis) {
        const double along = (double)number_in(call, 3 + axis, index, 0.0f);
        square += along * along;
        reach = fmax(reach, fabs((double)number_in(call, axis, index, 0.0f)));
    }
    if (bound != NULL && spt_bound_extent(bound, low, high) == SPT_OK) {
        for (int axis = 0; axis < 3; ++axis) {
            size = fmax(size, fmax(fabs((double)low[axis]), fabs((double)high[axis])));
        }
    }
    const double world = (double)t * sqrt(square);
    const double path = (double)number_in(call, KRS_IN_PATH, index, 0.0f);
    const double cone = (double)call->settings->pixel_radius * (path + world);
    const double floor_of_t = 0x1p-22 * (reach + world + size);
    const double exact = fmax((double)call->settings->epsilon, fmax(cone, floor_of_t));
    return exact * (1 + 0x1p-20) + 20 * 0x1p-149;
}

/* krs.h and mobius.h: coordinates of points are below 1e18. Beyond, what is near is not told. */
static int is_far(const krs_call *call, size_t index, float t) {
    int far = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = (double)number_in(call, 3 + axis, index, 0.0f);
        const double from = (double)number_in(call, axis, index, 0.0f);
        far |= !(fabs(from + (double)t * along) < 1e18);
    }
    return far;
}

static const char *wrong_hit(const krs_call *call, size_t index) {
    const float t = number_out(call, KRS_OUT_T, index);
    const float residual = number_out(call, KRS_OUT_RESIDUAL, index);
    const uint32_t flags = word_out(call, KRS_OUT_FLAGS, index);
    const int feels = call->door == KRS_DOOR_PROBES || call->door == KRS_DOOR_FIELD_PROBES;
    if (feels) {
        /* Where the tolerance is wider than space, there is nothing that was not free. */
        if (is_infinite(residual) && most_tolerance(call, index, t) > 1e18) return NULL;
        return residual >= 0.0f && is_finite(residual) ? NULL : "a probe of no radius";
    }
    if (call->door == KRS_DOOR_EXITS) {
        if (!(residual >= -FLT_MAX)) return "a hit where f is no number";
        return (double)residual < most_tolerance(call, index, t) ? NULL
                                                                 : "a hit beyond the tolerance";
    }
    if ((flags & SPT_FLAG_STEEP) != 0) return NULL;
    if ((flags & SPT_FLAG_INSIDE) != 0 && (call->settings->flags & SPT_STOP_INSIDE) != 0) {
        return NULL;
    }
    const double radius = fabs((double)residual) / (double)call->field->lipschitz;
    return radius < most_tolerance(call, index, t) ? NULL : "a hit beyond the tolerance";
}

static const char *wrong_trace(const krs_call *call, uint32_t promises, size_t index) {
    const float t = number_out(call, KRS_OUT_T, index);
    const float residual = number_out(call, KRS_OUT_RESIDUAL, index);
    const uint32_t outcome = word_out(call, KRS_OUT_OUTCOME, index);
    const uint32_t evaluations = word_out(call, KRS_OUT_EVALUATIONS, index);
    const int own = krs_table[call->door].own_pass, bad = krs_ray_is_bad(call, index);
    const int within = t >= number_in(call, KRS_IN_T_MIN, index, 0.0f) && is_finite(t) &&
                       t <= number_in(call, KRS_IN_T_MAX, index, INFINITY);
    const int32_t component = (int32_t)word_out(call, KRS_OUT_COMPONENT, index);
    if (outcome > SPT_BAD_RAY) return "an outcome that there is not";
    if (bad != (outcome == SPT_BAD_RAY)) return "bad or not";
    if (evaluations > call->settings->budget) return "more evaluations than the budget";
    if (word_out(call, KRS_OUT_FALLBACKS, index) > evaluations) return "more fallbacks";
    if (component != (outcome == SPT_HIT ? 0 : -1)) return "component";
    if ((word_out(call, KRS_OUT_FLAGS, index) & ~(own ? 2u : 3u)) != 0) return "unknown flags";
    if (own && call->out[6].first != NULL && !is_infinite(number_out(call, 6, index)))
        return "a candidate that is not looked for";
    switch (outcome) {
    case SPT_BAD_RAY:
        if (evaluations != 0) return "evaluations of a bad ray";
        /* fall through */
    case SPT_MISS:
        return is_infinite(t) && is_infinite(residual) ? NULL : "a miss that is somewhere";
    case SPT_HIT:
        if (!within || evaluations == 0) return "a hit outside of the ray, or of nothing";
        return wrong_hit(call, index);
    case SPT_LIMIT:
        if (!within) return "a limit outside of the ray";
        if (!own && evaluations != call->settings->budget) return "a limit before the budget";
        return residual > -INFINITY ? NULL : "a limit where f is no number";
    default:
        if ((promises & KRS_TAME) != 0 && (isnan(residual) || !is_far(call, index, t))) {
            return "nonfinite without a reason";
        }
        if (!within || evaluations == 0) return "nonfinite outside of the ray, or of nothing";
        return residual > -INFINITY ? "nonfinite where f is a number" : NULL;
    }
}

/* ---- Places ---------------------------------------------------------------------------------- */

/* The components of a double of unit length, each rounded once: |n|^2 is off by 2^-23 at most. */
static int is_unit_or_zero(const krs_call *call, int first, size_t index, int zero) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double component = (double)number_out(call, first + axis, index);
        square += component * component;
    }
    if (!(square > 0)) return zero && square >= 0;
    return fabs(square - 1) <= 0x1p-22;
}

static uint64_t mirrors_of(const krs_call *call, size_t index) {
    const spt_sink *const sink = &call->out[KRS_OUT_MIRRORS];
    uint64_t mirrors;
    memcpy(&mirrors, (const char *)sink->first + (ptrdiff_t)index * sink->stride, 8);
    return mirrors;
}

static const char *wrong_place(const krs_call *call, uint32_t promises, size_t index) {
    const int mapped = call->door == KRS_DOOR_MAPPED_PLACES;
    const int32_t kernel = (int32_t)word_out(call, KRS_OUT_KERNEL, index);
    const uint32_t levels = mapped ? call->moekrs->levels : call->krs->levels;
    const float scale = number_out(call, KRS_OUT_SCALE, index);
    const float u = number_out(call, KRS_OUT_U, index), v = number_out(call, KRS_OUT_V, index);
    uint64_t possible = levels < 64 ? (UINT64_C(1) << levels) - 1 : UINT64_MAX;
    if (kernel < -1 || kernel > (int32_t)levels) return "a kernel that there is not";
    if (mapped) possible &= ~call->moekrs->unmirrored;
    if (kernel > 0 && kernel < 64) possible &= UINT64_MAX << kernel;
    if (kernel == 64) possible = 0;
    if ((mirrors_of(call, index) & ~possible) != 0) return "mirrors that were not on the way";
    const spt_built_kernel *const built = mapped ? call->moekrs->kernels : call->krs->kernels;
    const uint32_t kind = kernel < 0 ? SPT_KERNEL_EMPTY : built[kernel].kind;
    if (kernel >= 0 && kind == SPT_KERNEL_EMPTY) return "an empty kernel";
    if (!is_unit_or_zero(call, KRS_OUT_NORMAL, index, 1)) return "a normal of no length";
    if (!is_unit_or_zero(call, KRS_OUT_KERNEL_NORMAL, index, 1)) return "a kernel normal";
    if (is_far(call, index, krs_float(krs_written(&call->found[KRS_OUT_T], index, 0)))) return NULL;
    if (kind == SPT_KERNEL_SPHERE || kind == SPT_KERNEL_CAPSULE || kind == SPT_KERNEL_LEAF) {
        if (!(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)) return "parameters";
    }
    if (kind == SPT_KERNEL_FIELD && (krs_bits(u) != 0 || krs_bits(v) != 0)) return "parameters";
    if (isnan(u) || isnan(v)) return "parameters that are no numbers";
    if (!mapped && krs_bits(scale) != krs_bits(1.0f)) return "a scale";
    if (!(scale >= 0.0f)) return "a scale that is no number";
    if ((promises & KRS_TAME) == 0) return NULL;
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_finite(number_out(call, KRS_OUT_POINT + axis, index))) return "a point nowhere";
    }
    return scale > 0.0f && is_finite(scale) ? NULL : "a scale";
}

/* Hits at finite places of good rays, of the component that is meant. */
static int is_looked_at(const krs_call *call, size_t index) {
    const float t = krs_float(krs_written(&call->found[KRS_OUT_T], index, 0));
    const uint32_t meant = (uint32_t)call->component;
    if (krs_written(&call->found[KRS_OUT_OUTCOME], index, SPT_HIT) != SPT_HIT) return 0;
    if (krs_written(&call->found[KRS_OUT_COMPONENT], index, meant) != meant) return 0;
    return is_finite(t);
}

const char *krs_wrong(const krs_call *call, unsigned char before, uint32_t promises, size_t index) {
    const int same = untouched(call, before, index);
    if (krs_moves(call->door)) {
        for (int axis = 0; axis < 3; ++axis) {
            if (fabsf(number_out(call, axis, index)) >= INFINITY) return "a point at infinity";
        }
        return NULL;
    }
    if (krs_read(&call->in[KRS_IN_ACTIVE], index, 1) == 0) return same ? NULL : "not left alone";
    if (!krs_locates(call->door)) return wrong_trace(call, promises, index);
    if (!is_looked_at(call, index)) return same ? NULL : "located, though not meant";
    if (same) {
        const float t = krs_float(krs_written(&call->found[KRS_OUT_T], index, 0));
        const int excused = (promises & KRS_TAME) == 0 || krs_ray_is_bad(call, index);
        return excused || is_far(call, index, t) ? NULL : "not located";
    }
    return wrong_place(call, promises, index);
}
