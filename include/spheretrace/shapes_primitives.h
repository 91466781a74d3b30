/* SPDX-License-Identifier: MIT
 *
 * Signed distances to single bodies. The rules that hold for all of them are in shapes.h. Left out:
 * bodies made of planes (shapes_polytopes.h) and what combines or moves bodies
 * (shapes_operators.h). */
#ifndef SPHERETRACE_SHAPES_PRIMITIVES_H
#define SPHERETRACE_SHAPES_PRIMITIVES_H

#include "shapes_math.h"

/* Ball around the origin. radius >= 0. Exact, L = 1, convex. 7 flop, 1 root. */
SPT_SHAPE spt_real spt_sphere(spt_point p, spt_real radius) {
    return spt_length_3(p.x, p.y, p.z) - radius;
}

/* The half-space normal.p <= offset. normal must be a unit vector (else L = |normal| and the value
 * is scaled by it); offset is the plane's distance from the origin along it. Exact, L = 1, convex.
 * 6 flop. */
SPT_SHAPE spt_real spt_plane(spt_point p, spt_point normal, spt_real offset) {
    return spt_dot(normal, p) - offset;
}

/* Box around the origin, |x| <= half.x and so on. half >= 0: half the edge lengths. Exact, L = 1,
 * convex. 18 flop, 1 root. */
SPT_SHAPE spt_real spt_box(spt_point p, spt_point half) {
    const spt_real x = spt_magnitude(p.x) - half.x;
    const spt_real y = spt_magnitude(p.y) - half.y;
    const spt_real z = spt_magnitude(p.z) - half.z;
    const spt_real inside = spt_greatest(x, spt_greatest(y, z));
    const spt_real zero = spti_shape_zero(p.x);
    const spt_real outside =
        spt_length_3(spt_greatest(x, zero), spt_greatest(y, zero), spt_greatest(z, zero));
    return outside + spt_least(inside, zero);
}

/* Box with edges and corners rounded off. half: half the outer edge lengths, rounding included;
 * 0 <= rounding <= the least of them. Exact, L = 1, convex. 22 flop, 1 root. */
SPT_SHAPE spt_real spt_rounded_box(spt_point p, spt_point half, spt_real rounding) {
    return spt_box(p, spt_point_of(half.x - rounding, half.y - rounding, half.z - rounding)) -
           rounding;
}

/* Torus around the y axis: all within minor of the circle of radius major in the plane y = 0.
 * 0 <= minor <= major. Exact, L = 1. 8 flop, 2 roots. */
SPT_SHAPE spt_real spt_torus(spt_point p, spt_real major, spt_real minor) {
    return spt_length_2(spt_length_2(p.x, p.z) - major, p.y) - minor;
}

/* The part of that torus within an angle of the z axis, with round ends: all within minor of the
 * arc major (sin s, 0, cos s), |s| <= angle. sine, cosine: of the angle, which is in [0, pi].
 * Exact, L = 1. 21 flop, 2 roots. */
SPT_SHAPE spt_real spt_capped_torus(spt_point p, spt_real sine, spt_real cosine, spt_real major,
                                    spt_real minor) {
    const spt_real x = spt_magnitude(p.x);
    const spt_real ring = spt_length_2(x, p.z) - major;
    const spt_real end_x = x - major * sine;
    const spt_real end_z = p.z - major * cosine;
    const spt_real plane_squared =
        spt_choose(cosine * x > sine * p.z, end_x * end_x + end_z * end_z, ring * ring);
    return spt_root(plane_squared + p.y * p.y) - minor;
}

/* All within radius of the segment from a to b (a = b: a ball). radius >= 0. Exact, L = 1, convex.
 * 27 flop, 1 root, 1 division that depends on a and b only. */
SPT_SHAPE spt_real spt_capsule(spt_point p, spt_point a, spt_point b, spt_real radius) {
    const spt_point axis = spt_point_of(b.x - a.x, b.y - a.y, b.z - a.z);
    const spt_point q = spt_point_of(p.x - a.x, p.y - a.y, p.z - a.z);
    const spt_real inverse = 1 / (spt_dot(axis, axis) + SPT_REAL_MIN); /* finite if a = b */
    const spt_real zero = spti_shape_zero(p.x);
    const spt_real h = spt_least(spt_greatest(spt_dot(q, axis) * inverse, zero), 1 + zero);
    return spt_length_3(q.x - axis.x * h, q.y - axis.y * h, q.z - axis.z * h) - radius;
}

/* Closed cylinder around the y axis, |y| <= half_height. Both >= 0. Exact, L = 1, convex. 14 flop,
 * 2 roots. */
SPT_SHAPE spt_real spt_cylinder(spt_point p, spt_real half_height, spt_real radius) {
    const spt_real x = spt_length_2(p.x, p.z) - radius;
    const spt_real y = spt_magnitude(p.y) - half_height;
    const spt_real zero = spti_shape_zero(p.x);
    const spt_real outside = spt_length_2(spt_greatest(x, zero), spt_greatest(y, zero));
    return outside + spt_least(spt_greatest(x, y), zero);
}

/* Closed cone: apex at the origin, opening downwards along -y, flat base at y = -height. height >
 * 0; sine, cosine: of the angle between axis and side, both > 0. Exact, L = 1, convex. 30 flop, 2
 * roots. */
SPT_SHAPE spt_real spt_cone(spt_point p, spt_real height, spt_real sine, spt_real cosine) {
    const spt_real r = spt_length_2(p.x, p.z);
    const spt_real v = -p.y;
    /* distances above the side and below the base: inside, the larger is the answer */
    const spt_real side = cosine * r - sine * v;
    const spt_real base = v - height;
    const spt_real inside = spt_greatest(side, base);
    /* nearest points of the side and of the base in the half plane (r, v) */
    const spt_real zero = spti_shape_zero(p.x);
    const spt_real along =
        spt_least(spt_greatest(sine * r + cosine * v, zero), height / cosine + zero);
    const spt_real side_r = r - sine * along;
    const spt_real side_v = v - cosine * along;
    const spt_real base_r = spt_greatest(r - height * sine / cosine, zero);
    const spt_real outside =
        spt_root(spt_least(side_r * side_r + side_v * side_v, base_r * base_r + base * base));
    return spt_choose(inside > 0, outside, inside);
}

/* Ellipsoid around the origin. radii > 0, the half axes. A LOWER BOUND, L = 1, convex: the largest
 * of three functions that are each convex, of slope at most 1 and at most the distance. With g = |p
 * / radii| they are (least radius) (g - 1) (Hart 1996), the distance to the ball around it and the
 * distance to the box around it. Exact on the axes outside, and tending to the true distance far
 * away; never less of it than (least radius)/(largest radius), since the way to the surface along p
 * is at most (largest radius) (g - 1). (The usual g (g - 1)/|p / radii^2| is a closer bound
 * outside, but no bound inside, and has slopes of a third of the square of the ratio of the radii.)
 * 40 flop, 3 roots. */
SPT_SHAPE spt_real spt_ellipsoid(spt_point p, spt_point radii) {
    const spt_real least = spt_least(radii.x, spt_least(radii.y, radii.z));
    const spt_real largest = spt_greatest(radii.x, spt_greatest(radii.y, radii.z));
    const spt_real gauge =
        spt_length_3(p.x * (1 / radii.x), p.y * (1 / radii.y), p.z * (1 / radii.z));
    const spt_real bounds = spt_greatest(spt_sphere(p, largest), spt_box(p, radii));
    return spt_greatest(least * (gauge - 1), bounds);
}

/* Small vector arithmetic for the builder below. */
static inline double spti_shape_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void spti_shape_cross(const double a[3], const double b[3], double cross[3]) {
    cross[0] = a[1] * b[2] - a[2] * b[1];
    cross[1] = a[2] * b[0] - a[0] * b[2];
    cross[2] = a[0] * b[1] - a[1] * b[0];
}

static inline spt_point spti_shape_point(const double a[3]) {
    return spt_point_of((spt_real)a[0], (spt_real)a[1], (spt_real)a[2]);
}

/* A circular arc with a thickness, made by spt_arc_of(). Opaque. */
typedef struct spt_arc {
    spt_point middle;   /* of the arc */
    spt_point outward;  /* unit, from the centre of the circle to the middle */
    spt_point along;    /* unit, parallel to the chord */
    spt_point normal;   /* unit, of the arc's plane */
    spt_real curvature; /* 1 / radius of the circle; 0: straight */
    spt_real half_chord;
    spt_real cosine;  /* of half the angle under which the arc is seen from the centre */
    spt_real sagitta; /* height of the arc over its chord */
    spt_real radius;  /* of the tube */
} spt_arc;

/* The arc from a through control to b, or straight from a to b if the three are on a line (the sine
 * of the angle at control is at most 1e-9, wherever control then lies); a = b gives a ball. radius:
 * of the tube, >= 0, and below the radius of the circle, else the inside is only a lower bound.
 * Computed in double, by square roots alone. */
static inline spt_arc spt_arc_of(spt_point a, spt_point b, spt_point control, spt_real radius) {
    /* vectors in double: from control to a and to b, along the chord */
    const double ca[3] = {(double)a.x - (double)control.x, (double)a.y - (double)control.y,
                          (double)a.z - (double)control.z};
    const double cb[3] = {(double)b.x - (double)control.x, (double)b.y - (double)control.y,
                          (double)b.z - (double)control.z};
    const double chord[3] = {cb[0] - ca[0], cb[1] - ca[1], cb[2] - ca[2]};
    double cross[3], outward[3], along[3], normal[3];
    spti_shape_cross(ca, cb, cross);
    const double ca_square = spti_shape_dot(ca, ca), cb_square = spti_shape_dot(cb, cb);
    const double cross_length = sqrt(spti_shape_dot(cross, cross));
    const double chord_length = sqrt(spti_shape_dot(chord, chord));
    double curvature = 0, cosine = 1, sagitta = 0;

    for (int i = 0; i < 3; ++i) {
        along[i] = chord_length > 0 ? chord[i] / chord_length : (i == 0 ? 1.0 : 0.0);
    }
    if (chord_length > 0 && cross_length > 1e-9 * sqrt(ca_square) * sqrt(cb_square)) {
        /* Angle at control between ca and cb, which sees the chord: half the arc beyond the chord,
         * so that half the arc through control has the angle pi minus it. Its sine is
         * chord/(2 R), and the arc bulges towards control. */
        const double lengths = sqrt(ca_square) * sqrt(cb_square);
        const double sine = cross_length / lengths;
        cosine = -spti_shape_dot(ca, cb) / lengths;
        curvature = 2 * sine / chord_length;
        /* R (1 - cos), without cancellation for flat arcs */
        sagitta = cosine > 0 ? 0.5 * chord_length * sine / (1 + cosine) : (1 - cosine) / curvature;
        for (int i = 0; i < 3; ++i) normal[i] = cross[i] / cross_length;
        spti_shape_cross(along, normal, outward);
        if (spti_shape_dot(outward, ca) > 0) {
            for (int i = 0; i < 3; ++i) outward[i] = -outward[i];
        }
    } else {
        /* straight: any two directions across */
        const double x = fabs(along[0]), y = fabs(along[1]), z = fabs(along[2]);
        const double axis[3] = {x <= y && x <= z ? 1.0 : 0.0, y < x && y <= z ? 1.0 : 0.0,
                                z < x && z < y ? 1.0 : 0.0};
        spti_shape_cross(along, axis, normal);
        const double length = sqrt(spti_shape_dot(normal, normal));
        for (int i = 0; i < 3; ++i) normal[i] /= length;
        spti_shape_cross(along, normal, outward);
    }
    const double middle[3] = {0.5 * ((double)a.x + (double)b.x) + sagitta * outward[0],
                              0.5 * ((double)a.y + (double)b.y) + sagitta * outward[1],
                              0.5 * ((double)a.z + (double)b.z) + sagitta * outward[2]};
    spt_arc arc;
    arc.middle = spti_shape_point(middle);
    arc.outward = spti_shape_point(outward);
    arc.along = spti_shape_point(along);
    arc.normal = spti_shape_point(normal);
    arc.curvature = (spt_real)curvature;
    arc.half_chord = (spt_real)(0.5 * chord_length);
    arc.cosine = (spt_real)cosine;
    arc.sagitta = (spt_real)sagitta;
    arc.radius = radius;
    return arc;
}

/* All within the tube's radius of the arc: a branch of a tree (Szecsi et al. 2016, 9). Exact, L =
 * 1; convex if straight. In float off by at most 1.5e-6 times the size of the arc at every
 * flatness, since all is counted from the middle of the arc and with the curvature, which becomes
 * 0; around the centre of the circle, all digits are lost on flat arcs. 45 flop, 2 roots, 1
 * division. */
SPT_SHAPE spt_real spt_toroidal_capsule(spt_point p, const spt_arc *arc) {
    const spt_point q = spt_point_of(p.x - arc->middle.x, p.y - arc->middle.y, p.z - arc->middle.z);
    const spt_real x = spt_dot(q, arc->outward);
    const spt_real y = spt_magnitude(spt_dot(q, arc->along));
    const spt_real z = spt_dot(q, arc->normal);
    const spt_real k = arc->curvature;
    /* In units of the circle's radius and seen from its centre: the point is (from_centre, turned)
     * and stands over the arc if its direction is within the half angle. */
    const spt_real from_centre = 1 + k * x;
    const spt_real turned = k * y;
    /* sqrt(X^2 + y^2) - R with X = R + x, multiplied out so that R cancels before it is computed */
    const spt_real below = spt_length_2(from_centre, turned) + 1;
    const spt_real over = (x * (k * x + 2) + y * (k * y)) / below;
    const spt_real end_x = x + arc->sagitta;
    const spt_real end_y = y - arc->half_chord;
    /* not where the circle is infinitely far in units of its radius: the ends are as near then */
    const int stands_over =
        (arc->half_chord * from_centre >= arc->cosine * y) & (below <= SPT_REAL_MAX);
    const spt_real plane_squared =
        spt_choose(stands_over, over * over, end_x * end_x + end_y * end_y);
    return spt_root(plane_squared + z * z) - arc->radius;
}

#endif
