/* SPDX-License-Identifier: MIT
 *
 * Where a distorted body is, and how far its inverse deformation stretches lengths there. In
 * double, and rounded outwards. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "distort.h"

/* ---- What a volume reaches ------------------------------------------------------------------ */

/* The convex hull of corners plus, at each, the image of the unit ball under three arms: holds
 * every volume that has an end. */
typedef struct region_hull {
    int corners;
    double corner[8][3];
    double arm[3][3];
} region_hull;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

static void cross(const double a[3], const double b[3], double to[3]) {
    for (int i = 0; i < 3; ++i) {
        to[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static void normalise(double vector[3]) {
    const double length = sqrt(dot(vector, vector));
    for (int i = 0; i < 3; ++i) vector[i] /= length;
}

/* A unit vector at right angles to one. */
static void across(const double unit[3], double to[3]) {
    double least[3] = {0, 0, 0};
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (fabs(unit[i]) < fabs(unit[axis])) axis = i;
    }
    least[axis] = 1;
    for (int i = 0; i < 3; ++i) to[i] = least[i] - unit[axis] * unit[i];
    normalise(to);
}

static void add_corner(region_hull *hull, const float point[3]) {
    for (int i = 0; i < 3; ++i) hull->corner[hull->corners][i] = (double)point[i];
    ++hull->corners;
}

/* From the volume's middle to those of its sides, which are at right angles only as far as its axes
 * are: columns of the inverse of the matrix of which these are rows, times half. */
static void sides_of(const spt_bound *bound, double side[3][3]) {
    double axis[3][3], determinant;
    for (int i = 0; i < 9; ++i) axis[i / 3][i % 3] = (double)bound->axis[i / 3][i % 3];
    for (int i = 0; i < 3; ++i) cross(axis[(i + 1) % 3], axis[(i + 2) % 3], side[i]);
    determinant = dot(axis[0], side[0]);
    for (int i = 0; i < 9; ++i) side[i / 3][i % 3] *= (double)bound->half[i / 3] / determinant;
}

static void hull_of_box(region_hull *hull, const double middle[3], double side[3][3]) {
    for (hull->corners = 0; hull->corners < 8; ++hull->corners) {
        for (int i = 0; i < 3; ++i) {
            double at = middle[i];
            for (int j = 0; j < 3; ++j) at += (hull->corners >> j & 1 ? 1 : -1) * side[j][i];
            hull->corner[hull->corners][i] = at;
        }
    }
}

/* Of a copy that spti_bound_copy() made. Returns 0 where the volume has no end. */
static int hull_of(const spt_bound *bound, region_hull *hull) {
    double side[3][3] = {{0}}, middle[3], *const along = hull->arm[2];
    const double radius = (double)bound->radius;
    memset(hull, 0, sizeof *hull);
    switch (bound->kind) {
    case SPT_BOUND_CAPSULE:
        add_corner(hull, bound->end); /* fall through */
    case SPT_BOUND_SPHERE:
        add_corner(hull, bound->center);
        for (int i = 0; i < 3; ++i) hull->arm[i][i] = radius;
        return 1;
    case SPT_BOUND_CYLINDER: /* two discs */
        add_corner(hull, bound->end);
        add_corner(hull, bound->center);
        for (int i = 0; i < 3; ++i) along[i] = hull->corner[0][i] - hull->corner[1][i];
        normalise(along);
        across(along, hull->arm[0]);
        cross(along, hull->arm[0], hull->arm[1]);
        for (int i = 0; i < 3; ++i) {
            hull->arm[0][i] *= radius;
            hull->arm[1][i] *= radius;
            along[i] = 0;
        }
        return 1;
    case SPT_BOUND_ELLIPSOID:
        add_corner(hull, bound->center);
        sides_of(bound, hull->arm);
        return 1;
    case SPT_BOUND_ORIENTED_BOX:
        sides_of(bound, side);
        for (int i = 0; i < 3; ++i) middle[i] = (double)bound->center[i];
        hull_of_box(hull, middle, side);
        return 1;
    default:
        for (int i = 0; i < 3; ++i) {
            const double low = (double)bound->low[i], high = (double)bound->high[i];
            if (!spti_finite(bound->low[i]) || !spti_finite(bound->high[i])) return 0;
            middle[i] = 0.5 * (low + high);
            side[i][i] = 0.5 * (high - low);
        }
        hull_of_box(hull, middle, side);
        return 1;
    }
}

/* The largest coordinate, or more. */
static double hull_size(const region_hull *hull) {
    double size = 0, arms = 0;
    for (int i = 0; i < 3; ++i) arms += sqrt(dot(hull->arm[i], hull->arm[i]));
    for (int i = 0; i < hull->corners; ++i) {
        for (int axis = 0; axis < 3; ++axis) size = larger(fabs(hull->corner[i][axis]), size);
    }
    return size + arms;
}

/* Where it is along a unit vector, from a point. */
static void hull_extent(const region_hull *hull, const double from[3], const double along[3],
                        double extent[2]) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double part = dot(hull->arm[i], along);
        square += part * part;
    }
    extent[0] = DBL_MAX;
    extent[1] = -DBL_MAX;
    for (int i = 0; i < hull->corners; ++i) {
        const double at = dot(hull->corner[i], along) - dot(from, along);
        extent[0] = -larger(-extent[0], sqrt(square) - at);
        extent[1] = larger(extent[1], at + sqrt(square));
    }
}

/* How far it reaches from the line through a point at right angles to two unit vectors, at most:
 * the length of the corner's way plus the longest image of a unit vector across the line. */
static double hull_reach(const region_hull *hull, const double from[3], const double a[3],
                         const double b[3]) {
    double square_a = 0, square_b = 0, mixed = 0, farthest = 0;
    for (int i = 0; i < 3; ++i) {
        const double part_a = dot(hull->arm[i], a), part_b = dot(hull->arm[i], b);
        square_a += part_a * part_a;
        square_b += part_b * part_b;
        mixed += part_a * part_b;
    }
    const double mean = 0.5 * (square_a + square_b), apart = 0.5 * (square_a - square_b);
    const double longest = sqrt(mean + sqrt(apart * apart + mixed * mixed));
    for (int i = 0; i < hull->corners; ++i) {
        const double way_a = dot(hull->corner[i], a) - dot(from, a);
        const double way_b = dot(hull->corner[i], b) - dot(from, b);
        farthest = larger(sqrt(way_a * way_a + way_b * way_b), farthest);
    }
    return farthest + longest;
}

/* ---- Constants ------------------------------------------------------------------------------ */

/* The largest singular value of a shear, [[1, a], [0, 1]]: of W for twist (a turn by rate dh moves
 * what is r from the axis by rate r dh) and sway. */
static double shear_norm(double a) {
    return 0.5 * (a + sqrt(a * a + 4));
}

/* That of [[i, -a i], [0, 1]], i = 1 / s: of W for taper, r / s = u being the distance from the
 * axis before, where d(r / s) = dr / s - (r rate / s^2) dh = i dr - i u rate dh; a = u rate. Across
 * the paper it stretches by i, which is less. A matrix linear in i has a convex norm, which is
 * least, 1, for i = 0: so it grows with i, and with a, and is greatest at the narrow end, on the
 * outside. */
static double taper_norm(double inverse, double a) {
    const double squares = inverse * inverse * (1 + a * a) + 1;
    return sqrt(0.5 * (squares + sqrt(larger(squares * squares - 4 * inverse * inverse, 0))));
}

/* ---- Regions -------------------------------------------------------------------------------- */

/* Angles beyond this are too coarse in float. */
#define MOST_TURN 1e4
#define MOST_REACH 0x1p60

/* What a deformation needs to know, from the origin: */
typedef struct region_parts {
    double frame[3][3], origin[3];
    double extent[3][2]; /* of the inner bound along each vector of the frame, */
    double slack;        /* what rounding in float may add to any length, and a little */
    double constant;
} region_parts;

/* A box along the frame. */
static int set_box(spt_distorted *made, const region_parts *parts, double extent[3][2]) {
    float center[3], half[3], frame[3][3];
    for (int i = 0; i < 3; ++i) {
        half[i] = (float)(0.5 * (extent[i][1] - extent[i][0]));
        if (!(larger(-extent[i][0], extent[i][1]) <= MOST_REACH)) return 0;
    }
    for (int axis = 0; axis < 3; ++axis) {
        double at = parts->origin[axis];
        for (int i = 0; i < 3; ++i) {
            at += 0.5 * (extent[i][0] + extent[i][1]) * parts->frame[i][axis];
            frame[i][axis] = made->frame[i][axis];
        }
        center[axis] = (float)at;
    }
    made->bound = spt_bound_oriented_box(center, frame, half);
    for (int i = 0; i < 3; ++i) {
        made->bound.low[i] = (float)extent[i][0];
        made->bound.high[i] = (float)extent[i][1];
    }
    return 1;
}

/* A cylinder between two heights along a vector of the frame; or the box around it where it is
 * flat: the direction of a short axis is not well known from two points in float. */
static int set_cylinder(spt_distorted *made, region_parts *parts, int along, double radius_low,
                        double radius_high) {
    const double low = parts->extent[along][0] - parts->slack;
    const double high = parts->extent[along][1] + parts->slack;
    const double radius = larger(radius_low, radius_high);
    double extent[3][2];
    float from[3], to[3];
    for (int i = 0; i < 3; ++i) {
        extent[i][0] = i == along ? low : -radius;
        extent[i][1] = i == along ? high : radius;
    }
    if (!set_box(made, parts, extent)) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = (float)(parts->origin[axis] + low * parts->frame[along][axis]);
        to[axis] = (float)(parts->origin[axis] + high * parts->frame[along][axis]);
    }
    if (high - low >= radius) made->bound = spt_bound_cylinder(from, to, (float)radius);
    made->bound.low[0] = (float)radius_low;
    made->bound.high[0] = (float)radius_high;
    made->bound.low[1] = (float)low;
    made->bound.high[1] = (float)high;
    return 1;
}

/* Heights and distances from the axis do not change. */
static int set_twist(spt_distorted *made, region_parts *parts, const region_hull *hull) {
    const double rate = fabs((double)made->distortion.rate);
    const double radius =
        hull_reach(hull, parts->origin, parts->frame[0], parts->frame[2]) + parts->slack;
    const double farthest = larger(-parts->extent[1][0], parts->extent[1][1]) + parts->slack;
    if (!(rate * farthest <= MOST_TURN)) return 0;
    parts->constant = shear_norm(rate * radius);
    return set_cylinder(made, parts, 1, radius, radius);
}

/* Nor do distances along `side` and from the line along it. W turns back by rate h, h the height
 * where the point is: its derivative is a rotation times I + rate (w, -h)^T (1, 0) in height and
 * distance across, whose norm is at most 1 + |rate| |(h, w)|, attained where h = 0. */
static int set_bend(spt_distorted *made, region_parts *parts, const region_hull *hull) {
    const double rate = fabs((double)made->distortion.rate);
    const double radius =
        hull_reach(hull, parts->origin, parts->frame[1], parts->frame[2]) + parts->slack;
    if (!(rate * radius <= MOST_TURN)) return 0;
    parts->constant = 1 + rate * radius;
    return set_cylinder(made, parts, 0, radius, radius);
}

/* What is within radius of the axis is within s radius. */
static int set_taper(spt_distorted *made, region_parts *parts, const region_hull *hull) {
    const double rate = (double)made->distortion.rate;
    const double radius =
        hull_reach(hull, parts->origin, parts->frame[0], parts->frame[2]) + parts->slack;
    const double *const extent = parts->extent[1];
    if (!(1 + rate * extent[0] >= 0.125 && 1 + rate * extent[1] >= 0.125)) return 0;
    const double scale_low = 1 + rate * (extent[0] - parts->slack);
    const double scale_high = 1 + rate * (extent[1] + parts->slack);
    const double least = scale_low < scale_high ? scale_low : scale_high;
    if (!(least >= 0.0625)) return 0; /* slack is not small: the bound is far off */
    parts->constant = taper_norm(1 / least, rate * radius);
    return set_cylinder(made, parts, 1, radius * scale_low, radius * scale_high);
}

/* A shear of at most |d(rate h^2 sin(phase + wave h)) / dh| = |rate| h |2 sin + wave h cos|, which
 * is at most |rate| h sqrt(4 + (wave h)^2), attained in some phase. */
static int set_sway(spt_distorted *made, region_parts *parts) {
    const double rate = fabs((double)made->distortion.rate);
    const double height = larger(parts->extent[1][1] + parts->slack, 0);
    const double wave = fabs((double)made->distortion.wave) * height;
    const double offset = rate * height * height;
    if (!(wave <= MOST_TURN && offset <= MOST_REACH)) return 0;
    for (int i = 0; i < 3; ++i) {
        const double more = parts->slack + (i == 0 ? offset * (1 + 0x1p-19) : 0);
        parts->extent[i][0] -= more;
        parts->extent[i][1] += more;
    }
    parts->constant = shear_norm(rate * height * sqrt(4 + wave * wave));
    return set_box(made, parts, parts->extent);
}

/* Orthonormal, and the axis along the caller's. Returns 0 where axis or side are no directions. */
static int set_frame(spt_distorted *made) {
    const spt_distortion *const distortion = &made->distortion;
    const int sided =
        distortion->kind == SPT_DISTORTION_BEND || distortion->kind == SPT_DISTORTION_SWAY;
    double frame[3][3];
    for (int i = 0; i < 3; ++i) {
        frame[0][i] = (double)distortion->side[i];
        frame[1][i] = (double)distortion->axis[i];
    }
    if (!(dot(frame[1], frame[1]) > 0)) return 0;
    normalise(frame[1]);
    if (sided) {
        if (!(dot(frame[0], frame[0]) > 0)) return 0;
        normalise(frame[0]);
        const double slant = dot(frame[0], frame[1]);
        if (!(fabs(slant) <= 1e-3)) return 0;
        for (int i = 0; i < 3; ++i) frame[0][i] -= slant * frame[1][i];
        normalise(frame[0]);
    } else {
        across(frame[1], frame[0]);
    }
    cross(frame[0], frame[1], frame[2]);
    for (int i = 0; i < 9; ++i) made->frame[i / 3][i % 3] = (float)frame[i / 3][i % 3];
    return 1;
}

spt_status spti_distort_settle(spt_distorted *made) {
    region_hull hull;
    region_parts parts;
    int good;
    if (!set_frame(made)) return SPT_BAD_ARGUMENT;
    if (made->inner.bound == NULL || !hull_of(&made->inner_bound, &hull)) return SPT_UNSUPPORTED;
    double size = hull_size(&hull);
    for (int i = 0; i < 3; ++i) {
        parts.origin[i] = (double)made->distortion.origin[i];
        size = larger(fabs(parts.origin[i]), size);
        for (int j = 0; j < 3; ++j) parts.frame[i][j] = (double)made->frame[i][j];
    }
    for (int i = 0; i < 3; ++i) hull_extent(&hull, parts.origin, parts.frame[i], parts.extent[i]);
    /* Ways from the origin are below 4 sizes; they are off by less than 8u of themselves after a
     * turn into the frame, its own rounding included, and the way back. At least something. */
    parts.slack = size * 0x1p-19 + 1e-15;
    switch (made->distortion.kind) {
    case SPT_DISTORTION_TWIST:
        good = set_twist(made, &parts, &hull);
        break;
    case SPT_DISTORTION_BEND:
        good = set_bend(made, &parts, &hull);
        break;
    case SPT_DISTORTION_TAPER:
        good = set_taper(made, &parts, &hull);
        break;
    default:
        good = set_sway(made, &parts);
    }
    /* Frame, sine and cosine are off by up to 4u together, either way through the frame. */
    parts.constant *= 1 + 0x1p-20;
    if (!good || !(parts.constant <= 0x1p100)) return SPT_BAD_ARGUMENT;
    made->distortion.lipschitz = (float)parts.constant;
    return SPT_OK;
}
