/* SPDX-License-Identifier: MIT
 *
 * Volumes with flat faces are solved face by face, the round ones by search: the excess along a ray
 * is a convex function, whose least value and roots are found by splitting. */
#include "bounds_volume.h"
#include "../check.h"

#include <math.h>

/* As bound.h has it. */
static const double e = 0x1p-22;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length_of(const double a[3]) {
    return sqrt(dot(a, a));
}

static void widen(const float from[3], double to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = (double)from[axis];
}

static void subtract(const double a[3], const double b[3], double to[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = a[axis] - b[axis];
}

static double largest(const double a[3]) {
    return fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
}

double volume_magnitude(double decades) {
    return pow(10, check_uniform(-decades, decades));
}

/* ---- Faces ---------------------------------------------------------------------------------- */

/* unit normal . (p - from) <= offset */
typedef struct face {
    double normal[3], offset;
} face;

enum { most_faces = volume_planes + 6 };

/* The faces of a volume but those of a box along the axes, and the point they are counted from. */
static int faces_of(const spt_bound *bound, face *faces, double from[3]) {
    int count = 0;
    double end[3];
    for (int axis = 0; axis < 3; ++axis) from[axis] = 0;
    if (bound->kind == SPT_BOUND_POLYTOPE) {
        for (size_t i = 0; i < bound->plane_count; ++i) {
            widen(bound->planes[i].normal, faces[count].normal);
            faces[count++].offset = (double)bound->planes[i].offset;
        }
    }
    if (bound->kind == SPT_BOUND_ORIENTED_BOX || bound->kind == SPT_BOUND_CYLINDER) {
        widen(bound->center, from);
    }
    if (bound->kind == SPT_BOUND_SLAB || bound->kind == SPT_BOUND_ORIENTED_BOX) {
        const int slab = bound->kind == SPT_BOUND_SLAB;
        for (int i = 0; i < (slab ? 1 : 3); ++i) {
            for (int side = -1; side <= 1; side += 2) {
                const float *range = bound->range;
                widen(bound->axis[i], faces[count].normal);
                for (int k = 0; k < 3; ++k) faces[count].normal[k] *= side;
                faces[count++].offset =
                    slab ? side * (double)range[side > 0] : (double)bound->half[i];
            }
        }
    }
    if (bound->kind == SPT_BOUND_CYLINDER) {
        widen(bound->end, end);
        subtract(end, from, faces[0].normal);
        faces[0].offset = dot(faces[0].normal, faces[0].normal);
        subtract(from, end, faces[1].normal);
        faces[1].offset = 0;
        count = 2;
    }
    for (int i = 0; i < count; ++i) {
        const double length = length_of(faces[i].normal);
        for (int axis = 0; axis < 3; ++axis) faces[i].normal[axis] /= length;
        faces[i].offset /= length;
    }
    return count;
}

static int has_box(const spt_bound *bound) {
    return bound->kind == SPT_BOUND_BOX || bound->kind == SPT_BOUND_SLAB ||
           bound->kind == SPT_BOUND_POLYTOPE;
}

/* The largest coordinate: of the box as far as it has ends, else of the farthest face. */
static double extent_of(const spt_bound *bound) {
    face faces[most_faces];
    double size = 0, endless = 0, from[3];
    const int count = faces_of(bound, faces, from);
    for (int i = 0; i < count; ++i) endless = fmax(endless, fabs(faces[i].offset));
    for (int axis = 0; axis < 3; ++axis) {
        const double low = fabs((double)bound->low[axis]), high = fabs((double)bound->high[axis]);
        size = fmax(size, fmax(low < HUGE_VAL ? low : endless, high < HUGE_VAL ? high : endless));
    }
    return size;
}

/* ---- How far outside ------------------------------------------------------------------------ */

/* From the segment of a capsule, or from the line of a cylinder. */
static double from_axis(const spt_bound *bound, const double p[3]) {
    double a[3], b[3], along[3], arm[3];
    widen(bound->center, a);
    widen(bound->end, b);
    subtract(b, a, along);
    subtract(p, a, arm);
    const double square = dot(along, along);
    double part = square > 0 ? dot(arm, along) / square : 0;
    if (bound->kind == SPT_BOUND_CAPSULE) part = fmin(fmax(part, 0), 1);
    for (int axis = 0; axis < 3; ++axis) arm[axis] -= part * along[axis];
    return length_of(arm);
}

static double longest(const spt_bound *bound) {
    double half[3];
    widen(bound->half, half);
    return largest(half);
}

/* The largest of the amounts by which inequalities are broken: those of round sides, and those of
 * faces. -HUGE_VAL where there are none. */
static double round_excess(const spt_bound *bound, const double p[3]) {
    double center[3], arm[3], axis[3], square = 0;
    widen(bound->center, center);
    subtract(p, center, arm);
    switch (bound->kind) {
    case SPT_BOUND_SPHERE:
        return length_of(arm) - (double)bound->radius;
    case SPT_BOUND_CAPSULE:
    case SPT_BOUND_CYLINDER:
        return from_axis(bound, p) - (double)bound->radius;
    case SPT_BOUND_ELLIPSOID:
        for (int i = 0; i < 3; ++i) {
            widen(bound->axis[i], axis);
            square += pow(dot(axis, arm) / (double)bound->half[i], 2);
        }
        return (sqrt(square) - 1) * longest(bound);
    default:
        return -HUGE_VAL;
    }
}

static double face_excess(const spt_bound *bound, const double p[3]) {
    face faces[most_faces];
    double from[3], arm[3], excess = -HUGE_VAL;
    const int count = faces_of(bound, faces, from);
    subtract(p, from, arm);
    for (int i = 0; i < count; ++i) {
        excess = fmax(excess, dot(faces[i].normal, arm) - faces[i].offset);
    }
    for (int axis = 0; axis < 3 && has_box(bound); ++axis) {
        excess = fmax(excess, (double)bound->low[axis] - p[axis]);
        excess = fmax(excess, p[axis] - (double)bound->high[axis]);
    }
    return excess;
}

double volume_excess(const spt_bound *bound, const double p[3]) {
    return fmax(round_excess(bound, p), face_excess(bound, p));
}

static double determinant(double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* How far along an axis the point is for which axis[i] . q = half[i] and the other two are 0, by
 * Cramer's rule. */
static double arm_along(const spt_bound *bound, int i, int axis) {
    double matrix[3][3], changed[3][3];
    for (int k = 0; k < 3; ++k) {
        widen(bound->axis[k], matrix[k]);
        widen(bound->axis[k], changed[k]);
        changed[k][axis] = k == i ? (double)bound->half[i] : 0;
    }
    return determinant(changed) / determinant(matrix);
}

double volume_support(const spt_bound *bound, int axis, int sign) {
    const double center = (double)bound->center[axis], radius = (double)bound->radius;
    double a[3], b[3], sum = 0, square = 0;
    widen(bound->center, a);
    widen(bound->end, b);
    switch (bound->kind) {
    case SPT_BOUND_BOX:
        return (double)(sign > 0 ? bound->high[axis] : bound->low[axis]);
    case SPT_BOUND_SPHERE:
        return center + sign * radius;
    case SPT_BOUND_CAPSULE:
        return sign * (fmax(sign * a[axis], sign * b[axis]) + radius);
    case SPT_BOUND_CYLINDER:
        subtract(b, a, b);
        square = dot(b, b) - b[axis] * b[axis];
        return sign * (fmax(sign * center, sign * (double)bound->end[axis]) +
                       radius * sqrt(fmax(square, 0) / dot(b, b)));
    default:
        for (int i = 0; i < 3; ++i) {
            const double arm = arm_along(bound, i, axis);
            sum += fabs(arm);
            square += arm * arm;
        }
        return center + sign * (bound->kind == SPT_BOUND_ELLIPSOID ? sqrt(square) : sum);
    }
}

/* ---- Rays ----------------------------------------------------------------------------------- */

typedef struct line {
    double origin[3], direction[3], speed, apart; /* apart: of the origin from the center */
} line;

static line line_of(const spt_bound *bound, const float origin[3], const float direction[3]) {
    line self;
    face faces[most_faces];
    double from[3], arm[3];
    widen(origin, self.origin);
    widen(direction, self.direction);
    faces_of(bound, faces, from);
    if (!has_box(bound)) widen(bound->center, from);
    subtract(self.origin, from, arm);
    self.speed = length_of(self.direction);
    self.apart = length_of(arm);
    return self;
}

static void point_at(const line *self, double t, double p[3]) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = self->origin[axis] + t * self->direction[axis];
}

/* Behind a face that is moved out by out + turn t. */
static void cut(volume_interval *inside, double room, double rate) {
    if (rate > 0) inside->exit = fmin(inside->exit, room / rate);
    if (rate < 0) inside->entry = fmax(inside->entry, room / rate);
    if (!(rate > 0) && !(rate < 0) && room < 0) inside->exit = -HUGE_VAL;
}

static void cut_with_faces(const spt_bound *bound, const line *self, double wider,
                           volume_interval *inside) {
    face faces[most_faces];
    double from[3], arm[3];
    const int count = faces_of(bound, faces, from);
    subtract(self->origin, from, arm);
    for (int i = 0; i < count; ++i) {
        const double out = 4 * e * wider * (self->apart + fabs(faces[i].offset));
        cut(inside, faces[i].offset - dot(faces[i].normal, arm) + out,
            dot(faces[i].normal, self->direction) - 4 * e * wider * self->speed);
    }
}

/* With the box along the axes, where the library's own rounding is allowed as much as it says. */
static void cut_with_box(const spt_bound *bound, const line *self, double wider,
                         volume_interval *inside) {
    const double out = 2 * e * wider * (largest(self->origin) + extent_of(bound));
    for (int axis = 0; axis < 3 && has_box(bound); ++axis) {
        const double o = self->origin[axis], d = self->direction[axis];
        if ((double)bound->high[axis] < HUGE_VAL) {
            cut(inside, (double)bound->high[axis] - o + out, d);
        }
        if ((double)bound->low[axis] > -HUGE_VAL) {
            cut(inside, o - (double)bound->low[axis] + out, -d);
        }
    }
}

/* By how much round sides may grow at most. */
static double growth_of(const spt_bound *bound, const line *self) {
    double a[3], b[3], square = 0;
    switch (bound->kind) {
    case SPT_BOUND_SPHERE:
        return 2 * e * (largest(self->origin) + self->apart);
    case SPT_BOUND_ELLIPSOID:
        for (int i = 0; i < 3; ++i) square += pow(longest(bound) / (double)bound->half[i], 2);
        return 13 * e * sqrt(square) * (self->apart + longest(bound));
    default:
        widen(bound->center, a);
        widen(bound->end, b);
        subtract(b, a, b);
        return 10 * e * (self->apart + length_of(b) + (double)bound->radius);
    }
}

static double excess_at(const spt_bound *bound, const line *self, double t, double grown) {
    double p[3];
    point_at(self, t, p);
    return round_excess(bound, p) - grown;
}

/* Between t that is outside and t that is inside. */
static double boundary(const spt_bound *bound, const line *self, double outside, double inside,
                       double grown) {
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (outside + inside);
        if (excess_at(bound, self, middle, grown) > 0) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    return inside;
}

static void cut_with_sides(const spt_bound *bound, const line *self, double grown,
                           volume_interval *inside) {
    const double golden = 0.6180339887498949;
    double a[3], b[3], low = 0, high;
    widen(bound->center, a);
    widen(bound->end, b);
    high = 4 *
           (self->apart + length_of(a) + length_of(b) + (double)bound->radius + grown +
            longest(bound)) /
           self->speed;
    const double last = high;
    for (int step = 0; step < 110; ++step) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        if (excess_at(bound, self, left, grown) <= excess_at(bound, self, right, grown)) {
            high = right;
        } else {
            low = left;
        }
    }
    const double least = excess_at(bound, self, 0, grown) <= 0 ? 0 : 0.5 * (low + high);
    if (excess_at(bound, self, least, grown) > 0) {
        inside->exit = -HUGE_VAL;
        return;
    }
    if (least > 0) inside->entry = fmax(inside->entry, boundary(bound, self, 0, least, grown));
    inside->exit = fmin(inside->exit, boundary(bound, self, last, least, grown));
}

static int is_round(const spt_bound *bound) {
    return bound->kind != SPT_BOUND_ORIENTED_BOX && !has_box(bound);
}

volume_interval volume_truth(const spt_bound *bound, const float origin[3],
                             const float direction[3]) {
    const line self = line_of(bound, origin, direction);
    volume_interval inside = {0, HUGE_VAL};
    cut_with_faces(bound, &self, 0, &inside);
    cut_with_box(bound, &self, 0, &inside);
    if (is_round(bound)) cut_with_sides(bound, &self, 0, &inside);
    return inside;
}

volume_interval volume_widest(const spt_bound *bound, const float origin[3],
                              const float direction[3]) {
    const line self = line_of(bound, origin, direction);
    volume_interval inside = {0, HUGE_VAL};
    cut_with_faces(bound, &self, 1, &inside);
    cut_with_box(bound, &self, 1, &inside);
    if (is_round(bound)) cut_with_sides(bound, &self, growth_of(bound, &self), &inside);
    double center[3], still = 0;
    widen(bound->center, center);
    if (bound->kind == SPT_BOUND_SPHERE) {
        still = 2 * e * (largest(self.origin) + largest(center) + (double)bound->radius);
    }
    inside.entry -= 2 * e * fabs(inside.entry) + still / self.speed;
    inside.exit += 2 * e * fabs(inside.exit) + still / self.speed;
    return inside;
}
