/* SPDX-License-Identifier: MIT
 *
 * Bounding volumes taken in: checked, and what depends on nothing else worked out once, in double.
 */
#include "bound_check.h"

#include <float.h>
#include <math.h>

#include "../base/arguments.h"

/* ---- Rules ---------------------------------------------------------------------------------- */

/* How far axes may be from unit length and from right angles. */
static const double axes_slack = 1e-3;

static int all_finite(const float numbers[3]) {
    return spti_finite(numbers[0]) && spti_finite(numbers[1]) && spti_finite(numbers[2]);
}

static double dot(const float a[3], const float b[3]) {
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

static int is_normal(const float normal[3]) {
    return all_finite(normal) &&
           (fabsf(normal[0]) > 0.0f || fabsf(normal[1]) > 0.0f || fabsf(normal[2]) > 0.0f);
}

/* A box whose ends may be at infinity. */
static int box_is_good(const spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        const float low = bound->low[axis], high = bound->high[axis];
        if (!(low <= high) || !(low <= FLT_MAX) || !(high >= -FLT_MAX)) return 0;
    }
    return 1;
}

static int axes_are_good(const spt_bound *bound) {
    for (int i = 0; i < 3; ++i) {
        const float *const axis = bound->axis[i], *const next = bound->axis[(i + 1) % 3];
        if (!all_finite(axis) || !all_finite(next)) return 0;
        if (!(fabs(sqrt(dot(axis, axis)) - 1.0) <= axes_slack)) return 0;
        if (!(fabs(dot(axis, next)) <= axes_slack)) return 0;
    }
    return 1;
}

static int halves_are_good(const spt_bound *bound) {
    for (int i = 0; i < 3; ++i) {
        if (!spti_within(bound->half[i], 0.0f, FLT_MAX)) return 0;
        if (bound->kind == SPT_BOUND_ELLIPSOID && !(bound->half[i] > 0.0f)) return 0;
    }
    return 1;
}

static int radius_is_good(const spt_bound *bound) {
    return bound->radius > 0.0f && spti_finite(bound->radius);
}

/* Whether the ends of an axis are two points. */
static int has_length(const spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        if (bound->center[axis] < bound->end[axis] || bound->center[axis] > bound->end[axis]) {
            return 1;
        }
    }
    return 0;
}

static int planes_are_good(const spt_bound *bound) {
    if (bound->planes == NULL || bound->plane_count < 1) return 0;
    if (bound->plane_count > SPT_BOUND_PLANES) return 0;
    for (size_t i = 0; i < bound->plane_count; ++i) {
        if (!is_normal(bound->planes[i].normal) || !spti_finite(bound->planes[i].offset)) return 0;
    }
    return 1;
}

static int is_good(const spt_bound *bound) {
    switch (bound->kind) {
    case SPT_BOUND_SPHERE:
        return all_finite(bound->center) && radius_is_good(bound);
    case SPT_BOUND_BOX:
        return box_is_good(bound) && all_finite(bound->low) && all_finite(bound->high);
    case SPT_BOUND_ORIENTED_BOX:
    case SPT_BOUND_ELLIPSOID:
        return all_finite(bound->center) && axes_are_good(bound) && halves_are_good(bound);
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        return all_finite(bound->center) && all_finite(bound->end) && radius_is_good(bound) &&
               (bound->kind == SPT_BOUND_CAPSULE || has_length(bound));
    case SPT_BOUND_SLAB:
        return is_normal(bound->axis[0]) && spti_finite(bound->range[0]) &&
               spti_finite(bound->range[1]) && bound->range[0] <= bound->range[1] &&
               box_is_good(bound);
    case SPT_BOUND_POLYTOPE:
        return planes_are_good(bound) && box_is_good(bound);
    case SPT_BOUND_CALLBACK:
        return (bound->batch != NULL || bound->point != NULL) && box_is_good(bound);
    default:
        return 0;
    }
}

/* ---- What follows from a volume ------------------------------------------------------------- */

static float to_float(double value) {
    const double most = (double)FLT_MAX;
    return (float)(value < -most ? -most : value > most ? most : value);
}

/* The ends of the box along an axis, rounded outwards: by an ulp of a float, and by more than the
 * few doubles were rounded from which they were made, of this size at most. */
static void set_ends(spt_bound *bound, int axis, double low, double high, double size) {
    const double lost = size * 0x1p-46;
    bound->low[axis] = to_float(low - fabs(low) * 0x1p-23 - lost);
    bound->high[axis] = to_float(high + fabs(high) * 0x1p-23 + lost);
}

static void box_of_sphere(spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        const float low = bound->center[axis] - bound->radius;
        const float high = bound->center[axis] + bound->radius;
        bound->low[axis] = low > -FLT_MAX ? low : -FLT_MAX;
        bound->high[axis] = high < FLT_MAX ? high : FLT_MAX;
    }
}

/* Element (row, column) of the inverse of the matrix whose rows are the axes. It is the transposed
 * only as far as they are at right angles. */
static double inverse(float axis[3][3], int row, int column) {
    double cross[3][3];
    for (int i = 0; i < 3; ++i) {
        const float *const a = axis[(i + 1) % 3], *const b = axis[(i + 2) % 3];
        for (int j = 0; j < 3; ++j) {
            cross[i][j] = (double)a[(j + 1) % 3] * (double)b[(j + 2) % 3] -
                          (double)a[(j + 2) % 3] * (double)b[(j + 1) % 3];
        }
    }
    const double determinant = cross[0][0] * (double)axis[0][0] + cross[0][1] * (double)axis[0][1] +
                               cross[0][2] * (double)axis[0][2];
    return cross[column][row] / determinant;
}

/* The images of a cube and of a ball under the inverse. */
static void box_of_axes(spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        double sum = 0, square = 0;
        for (int i = 0; i < 3; ++i) {
            const double arm = inverse(bound->axis, axis, i) * (double)bound->half[i];
            sum += fabs(arm);
            square += arm * arm;
        }
        const double reach = bound->kind == SPT_BOUND_ELLIPSOID ? sqrt(square) : sum;
        const double center = (double)bound->center[axis];
        set_ends(bound, axis, center - reach, center + reach, fabs(center) + reach);
    }
}

static void prepare_tube(spt_bound *bound) {
    const int flat = bound->kind == SPT_BOUND_CYLINDER;
    double along[3], square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = (double)bound->end[axis] - (double)bound->center[axis];
        square += along[axis] * along[axis];
    }
    const double length = sqrt(square);
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = length > 0.0 ? along[axis] / length : (double)(axis == 0);
        bound->axis[0][axis] = (float)along[axis];
    }
    bound->half[0] = to_float(length);
    for (int axis = 0; axis < 3; ++axis) {
        const double from = (double)bound->center[axis], to = (double)bound->end[axis];
        const double a = along[(axis + 1) % 3], b = along[(axis + 2) % 3];
        const double reach = (double)bound->radius * (flat ? sqrt(a * a + b * b) : 1.0);
        set_ends(bound, axis, (from < to ? from : to) - reach, (from < to ? to : from) + reach,
                 fabs(from) + fabs(to) + reach);
    }
}

static void prepare_ellipsoid(spt_bound *bound) {
    double longest = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
        longest = (double)bound->half[i] > longest ? (double)bound->half[i] : longest;
    }
    for (int i = 0; i < 3; ++i) {
        const double share = (double)bound->half[i] / longest;
        bound->end[i] = (float)share;
        square += 1.0 / (share * share);
    }
    bound->radius = (float)longest;
    bound->range[0] = to_float(sqrt(square));
}

static double plane_distance(const float normal[3], float offset) {
    return fabs((double)offset) / sqrt(dot(normal, normal));
}

static void prepare_planes(spt_bound *bound) {
    double farthest = 0;
    const size_t count = bound->kind == SPT_BOUND_SLAB ? 2 : bound->plane_count;
    for (size_t i = 0; i < count; ++i) {
        const double distance =
            bound->kind == SPT_BOUND_SLAB
                ? plane_distance(bound->axis[0], bound->range[i])
                : plane_distance(bound->planes[i].normal, bound->planes[i].offset);
        farthest = distance > farthest ? distance : farthest;
    }
    bound->radius = to_float(farthest);
}

int spti_bound_copy(spt_bound *to, const spt_bound *from) {
    memset(to, 0, sizeof *to);
    to->struct_size = sizeof *to;
    if (!spti_copy_sized(to, from, sizeof *to) || !is_good(to)) return 0;
    switch (to->kind) {
    case SPT_BOUND_SPHERE:
        box_of_sphere(to);
        break;
    case SPT_BOUND_ELLIPSOID:
        prepare_ellipsoid(to);
        box_of_axes(to);
        break;
    case SPT_BOUND_ORIENTED_BOX:
        box_of_axes(to);
        break;
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        prepare_tube(to);
        break;
    case SPT_BOUND_SLAB:
    case SPT_BOUND_POLYTOPE:
        prepare_planes(to);
        break;
    default: /* a box, as it is */
        break;
    }
    return 1;
}

float spti_bound_size(const spt_bound *bound) {
    const int ball = bound->kind == SPT_BOUND_SPHERE;
    const int planes = bound->kind == SPT_BOUND_SLAB || bound->kind == SPT_BOUND_POLYTOPE;
    float size = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        if (ball) {
            const float far = fabsf(bound->center[axis]) + bound->radius;
            size = far > size ? far : size;
        } else {
            const float low = fabsf(bound->low[axis]), high = fabsf(bound->high[axis]);
            const float endless = planes ? bound->radius : 0.0f;
            const float far_low = low <= FLT_MAX ? low : endless;
            const float far_high = high <= FLT_MAX ? high : endless;
            size = far_low > size ? far_low : size;
            size = far_high > size ? far_high : size;
        }
    }
    return size < FLT_MAX ? size : FLT_MAX;
}

void spti_bound_ask(const spt_bound *bound, size_t n, const float *const origin[3],
                    const float *const direction[3], float *t_in, float *t_out) {
    const size_t whole = (n + SPTI_BOUND_GROUP - 1) / SPTI_BOUND_GROUP * SPTI_BOUND_GROUP;
    for (size_t i = 0; i < whole; ++i) t_in[i] = t_out[i] = NAN;
    if (bound->batch != NULL) {
        bound->batch(bound->user, whole, origin, direction, t_in, t_out);
        return;
    }
    for (size_t i = 0; i < n; ++i) {
        const float from[3] = {origin[0][i], origin[1][i], origin[2][i]};
        const float along[3] = {direction[0][i], direction[1][i], direction[2][i]};
        bound->point(bound->user, from, along, &t_in[i], &t_out[i]);
    }
}
