/* SPDX-License-Identifier: MIT
 *
 * Which cases of fuzz_surface.h keep the rules of the headers, and the largest coordinate of their
 * volumes. */
#include "fuzz_surface.h"

#include <float.h>
#include <math.h>

static int is_finite(float a) {
    return fabsf(a) <= FLT_MAX;
}

static int within(float a, float low, float high) {
    return a >= low && a <= high;
}

static int are_finite(const float *numbers, int count) {
    for (int i = 0; i < count; ++i) {
        if (!is_finite(numbers[i])) return 0;
    }
    return 1;
}

/* bound.h promises for coordinates below 1e19 and radii above 1e-18. */
static int are_usual(const float *numbers, int count) {
    for (int i = 0; i < count; ++i) {
        const float size = fabsf(numbers[i]);
        if (size > 1e18f || (size > 0.0f && size < 1e-17f)) return 0;
    }
    return 1;
}

static double dot(const float a[3], const float b[3]) {
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

/* ---- Volumes --------------------------------------------------------------------------------- */

/* No axis here is off by something like the 1e-3 that bound.h allows. */
static int are_axes(const spt_bound *bound) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double right = i == j ? 1.0 : 0.0;
            if (!(fabs(dot(bound->axis[i], bound->axis[j]) - right) < 1e-3)) return 0;
        }
    }
    return 1;
}

/* What bounds every coordinate of the volume but those of low and high. */
static double numbers_of(const spt_bound *bound, int *usual) {
    double sum = 0.0;
    *usual = are_usual(bound->center, 3) && are_usual(&bound->radius, 1) &&
             are_usual(bound->half, 3) && are_usual(bound->end, 3) && are_usual(bound->range, 2) &&
             are_usual(bound->axis[0], 3);
    for (int i = 0; i < 3; ++i) {
        sum += fabs((double)bound->center[i]) + fabs((double)bound->end[i]);
        sum += fabs((double)bound->half[i]);
    }
    return sum + fabs((double)bound->radius);
}

static fuzz_legal cut_legal(const spt_bound *bound) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(bound->low[axis] <= bound->high[axis])) return FUZZ_REFUSED;
        if (bound->low[axis] > FLT_MAX || bound->high[axis] < -FLT_MAX) return FUZZ_EITHER;
    }
    return FUZZ_LEGAL;
}

static int planes_legal(const spt_bound *bound, int *usual) {
    for (size_t i = 0; i < bound->plane_count; ++i) {
        const spt_bound_plane *const plane = &bound->planes[i];
        if (!are_finite(plane->normal, 3) || !is_finite(plane->offset)) return 0;
        if (!(dot(plane->normal, plane->normal) > 0.0)) return 0;
        *usual = *usual && are_usual(plane->normal, 3) && are_usual(&plane->offset, 1);
    }
    return 1;
}

static int round_legal(const spt_bound *bound) {
    const float length[] = {bound->end[0] - bound->center[0], bound->end[1] - bound->center[1],
                            bound->end[2] - bound->center[2]};
    if (!are_finite(bound->center, 3) || !is_finite(bound->radius)) return 0;
    if (!(bound->radius > 0.0f)) return 0;
    if (bound->kind == SPT_BOUND_SPHERE) return 1;
    return are_finite(bound->end, 3) &&
           (bound->kind == SPT_BOUND_CAPSULE || !(dot(length, length) <= 0.0));
}

static int turned_legal(const spt_bound *bound) {
    if (!are_finite(bound->center, 3) || !are_finite(bound->half, 3) || !are_axes(bound)) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(bound->half[axis] >= 0.0f)) return 0;
        if (bound->kind == SPT_BOUND_ELLIPSOID && !(bound->half[axis] > 0.0f)) return 0;
    }
    return 1;
}

fuzz_legal fuzz_bound_legal(const spt_bound *bound) {
    int usual, legal = 1;
    (void)numbers_of(bound, &usual);
    switch (bound->kind) {
    case SPT_BOUND_SPHERE:
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        legal = round_legal(bound);
        break;
    case SPT_BOUND_ORIENTED_BOX:
    case SPT_BOUND_ELLIPSOID:
        legal = turned_legal(bound);
        break;
    case SPT_BOUND_BOX:
        legal = are_finite(bound->low, 3) && are_finite(bound->high, 3);
        usual = usual && are_usual(bound->low, 3) && are_usual(bound->high, 3);
        break;
    case SPT_BOUND_SLAB:
        legal = are_finite(bound->axis[0], 3) && are_finite(bound->range, 2) &&
                bound->range[0] <= bound->range[1] && dot(bound->axis[0], bound->axis[0]) > 0.0;
        break;
    case SPT_BOUND_POLYTOPE:
        legal = planes_legal(bound, &usual);
        break;
    default:
        legal = bound->batch != NULL || bound->point != NULL;
    }
    if (!legal) return FUZZ_REFUSED;
    const fuzz_legal cut = bound->kind >= SPT_BOUND_SLAB || bound->kind == SPT_BOUND_BOX
                               ? cut_legal(bound)
                               : FUZZ_LEGAL;
    return cut == FUZZ_LEGAL && !usual ? FUZZ_EITHER : cut;
}

double fuzz_surface_size(const fuzz_surface_case *what) {
    double size = 0.0;
    for (int i = 0; i < surface_most_fields; ++i) {
        const spt_bound *const bound = what->fields[i].bound;
        int usual;
        if (bound == NULL) continue;
        size = fmax(size, numbers_of(bound, &usual));
        for (int axis = 0; axis < 3 && bound->kind != SPT_BOUND_SPHERE; ++axis) {
            const int cut = bound->kind >= SPT_BOUND_SLAB || bound->kind == SPT_BOUND_BOX;
            if (cut) size = fmax(size, fabs((double)bound->low[axis]));
            if (cut) size = fmax(size, fabs((double)bound->high[axis]));
        }
    }
    return size;
}

/* ---- Calls ----------------------------------------------------------------------------------- */

fuzz_legal fuzz_field_legal(const spt_field *field) {
    if (!within(field->lipschitz, 0x1p-100f, 0x1p100f)) return FUZZ_REFUSED;
    return field->bound != NULL ? fuzz_bound_legal(field->bound) : FUZZ_LEGAL;
}

int fuzz_settings_legal(const spt_settings *s) {
    const uint32_t both = SPT_CANDIDATE_PENUMBRA | SPT_CANDIDATE_CLOSEST;
    return (s->flags & both) != both && is_finite(s->epsilon) && s->epsilon > 0.0f &&
           within(s->pixel_radius, 0.0f, FLT_MAX) && within(s->size, 0.0f, FLT_MAX) &&
           s->relaxation >= 1.0f && s->relaxation < 2.0f && within(s->extrapolation, 0.0f, 1.0f) &&
           s->slope_blend > 0.0f && s->slope_blend <= 1.0f && within(s->step_cap, 1.0f, 100.0f);
}

/* What one call alone demands. */
static fuzz_legal own_legal(const fuzz_surface_case *what) {
    const surface_call *const call = &what->call;
    const uint32_t flags = what->settings.flags;
    const int convex = (what->fields[0].flags & SPT_FIELD_CONVEX) != 0;
    const int licensed = what->settings.method != spt_convex() || convex;
    switch (call->door) {
    case DOOR_NORMALS:
        return is_finite(call->detail) ? FUZZ_LEGAL : FUZZ_REFUSED;
    case DOOR_AMBIENT:
        return call->distance > 0.0f && is_finite(call->distance) ? FUZZ_LEGAL : FUZZ_REFUSED;
    case DOOR_CONVEX:
        if (what->fields[0].bound == NULL) return FUZZ_REFUSED;
        return licensed && (flags & SPT_STOP_INSIDE) == 0 ? FUZZ_LEGAL : FUZZ_REFUSED;
    case DOOR_CROSSINGS:
        return licensed && (flags & SPT_STOP_INSIDE) == 0 ? FUZZ_LEGAL : FUZZ_REFUSED;
    case DOOR_SHADOW: /* has a candidate of its own */
        if (licensed && (flags & SPT_CANDIDATE_CLOSEST) != 0) return FUZZ_EITHER;
        return licensed ? FUZZ_LEGAL : FUZZ_REFUSED;
    case DOOR_OCCLUDED:
        return licensed ? FUZZ_LEGAL : FUZZ_REFUSED;
    default:
        return FUZZ_LEGAL;
    }
}

fuzz_legal fuzz_surface_legal(const fuzz_surface_case *what) {
    const int marches = (surface_table[what->call.door].takes & TAKES_STATISTICS) != 0;
    fuzz_legal legal = own_legal(what);
    if ((surface_table[what->call.door].takes & TAKES_SETTINGS) != 0) {
        if (!fuzz_settings_legal(&what->settings)) return FUZZ_REFUSED;
        /* Whether a rule that is not used needs its licence is not said. */
        if (!marches && what->settings.method == spt_convex()) legal = FUZZ_EITHER;
    }
    for (size_t i = 0; i < what->call.field_count; ++i) {
        const fuzz_legal one = fuzz_field_legal(&what->fields[i]);
        if (one == FUZZ_REFUSED) return FUZZ_REFUSED;
        if (one == FUZZ_EITHER && legal == FUZZ_LEGAL) legal = FUZZ_EITHER;
    }
    return legal;
}
