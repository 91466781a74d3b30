/* SPDX-License-Identifier: MIT
 *
 * Points and balls through the Möbius maps of a sequence, from the world to kernel space. A template
 * over SPT_LANES.
 *
 * With u = a - x c and U = |u|^2 the preimage of x is (d* x + b*) u / U, lengths shrink by U, and a
 * ball around x of radius r, taken through the map, is free of what is farther than s from the
 * preimage as long as r <= s U / (1 + s U |c| / |u|). Through all levels together r = k / (A + B |k|),
 * k the distance there: A is divided by U at each, and B grows by A |c| / |u| before. (Szécsi et al.
 * 2016, section 6, for one level; in one pass over all, and with centered balls, ours.) */
#ifndef SPTI_PULL_KERNEL_H
#define SPTI_PULL_KERNEL_H

#include <math.h>

#include "shape_kernel.h"

typedef struct pull_quaternion {
    spt_wide real;
    shape_points pure;
} pull_quaternion;

/* x times the pure part of a constant quaternion, crosswise. */
SPTI_INLINE shape_points pull_cross(shape_points x, const float q[4]) {
    const spt_wide a = spt_splat(q[1]), b = spt_splat(q[2]), c = spt_splat(q[3]);
    const shape_points product = {spt_sub(spt_mul(x.y, c), spt_mul(x.z, b)),
                                  spt_sub(spt_mul(x.z, a), spt_mul(x.x, c)),
                                  spt_sub(spt_mul(x.x, b), spt_mul(x.y, a))};
    return product;
}

SPTI_INLINE spt_wide pull_dot(shape_points x, const float q[4]) {
    return spt_add(spt_add(spt_mul(x.x, spt_splat(q[1])), spt_mul(x.y, spt_splat(q[2]))),
                   spt_mul(x.z, spt_splat(q[3])));
}

/* Where a map takes a point to. */
typedef struct pull_image {
    shape_points point, from_center; /* from the preimage of infinity */
    spt_wide inverse;                /* 1 / |u|^2 */
    spt_wide bend;                   /* |c| / |u| */
} pull_image;

/* What |u|^2 counts as at most, so that the products of a preimage do not overflow: far from the
 * pole; or, of a map without one, what its entries allow. */
SPTI_INLINE spt_wide pull_most(const spt_built_map *map) {
    return spt_splat(map->c_length > 0.0f ? 0x1p80f : 0x1.8p126f);
}

/* u = a - x c, nowhere shorter than rounding makes it: at the pole of the map itself, whose preimage
 * is infinity, that of a point beside it. square: |u|^2, inverse: one over it. */
SPTI_INLINE pull_quaternion pull_denominator(const spt_built_map *map, shape_points x,
                                             spt_wide *square, spt_wide *inverse) {
    const shape_points cross = pull_cross(x, map->c);
    const spt_wide real = spt_splat(map->c[0]), zero = spt_splat(0.0f);
    const spt_wide least = spt_splat(map->least);
    pull_quaternion u;
    u.real = spt_add(spt_splat(map->a[0]), pull_dot(x, map->c));
    u.pure.x = spt_sub(spt_splat(map->a[1]), spt_add(spt_mul(x.x, real), cross.x));
    u.pure.y = spt_sub(spt_splat(map->a[2]), spt_add(spt_mul(x.y, real), cross.y));
    u.pure.z = spt_sub(spt_splat(map->a[3]), spt_add(spt_mul(x.z, real), cross.z));
    const spt_wide pure = spt_add(spt_add(spt_mul(u.pure.x, u.pure.x), spt_mul(u.pure.y, u.pure.y)),
                                  spt_mul(u.pure.z, u.pure.z));
    const spt_wide whole = spt_add(spt_mul(u.real, u.real), pure);
    const spt_wide floor = spt_mul(least, least);
    const spt_mask small = spt_less(whole, floor);
    u.real = spt_select(small, least, u.real);
    u.pure.x = spt_select(small, zero, u.pure.x);
    u.pure.y = spt_select(small, zero, u.pure.y);
    u.pure.z = spt_select(small, zero, u.pure.z);
    /* In this order NaN, of infinities that cancel, counts as far away. */
    *square = spt_min(spt_select(small, floor, whole), pull_most(map));
    *inverse = spt_div(spt_splat(1.0f), *square);
    return u;
}

/* By quaternions; from far away that of infinity. */
SPTI_INLINE pull_image pull_by_quaternions(const spt_built_map *map, shape_points x) {
    spt_wide square, inverse;
    const pull_quaternion u = pull_denominator(map, x, &square, &inverse);
    const shape_points cross = pull_cross(x, map->d); /* -d x, as d* has it */
    const spt_wide real = spt_splat(map->d[0]);
    const spt_wide w = spt_add(pull_dot(x, map->d), spt_splat(map->b[0]));
    const shape_points v = {spt_sub(spt_add(spt_mul(x.x, real), cross.x), spt_splat(map->b[1])),
                            spt_sub(spt_add(spt_mul(x.y, real), cross.y), spt_splat(map->b[2])),
                            spt_sub(spt_add(spt_mul(x.z, real), cross.z), spt_splat(map->b[3]))};
    const spt_wide cross_x = spt_sub(spt_mul(v.y, u.pure.z), spt_mul(v.z, u.pure.y));
    const spt_wide cross_y = spt_sub(spt_mul(v.z, u.pure.x), spt_mul(v.x, u.pure.z));
    const spt_wide cross_z = spt_sub(spt_mul(v.x, u.pure.y), spt_mul(v.y, u.pure.x));
    shape_points q = {
        spt_mul(spt_add(spt_add(spt_mul(w, u.pure.x), spt_mul(v.x, u.real)), cross_x), inverse),
        spt_mul(spt_add(spt_add(spt_mul(w, u.pure.y), spt_mul(v.y, u.real)), cross_y), inverse),
        spt_mul(spt_add(spt_add(spt_mul(w, u.pure.z), spt_mul(v.z, u.real)), cross_z), inverse)};
    const spt_mask near = spt_less(square, pull_most(map));
    q.x = spt_select(near, q.x, spt_splat(map->center[0]));
    q.y = spt_select(near, q.y, spt_splat(map->center[1]));
    q.z = spt_select(near, q.z, spt_splat(map->center[2]));
    const pull_image image = {q,
                              {spt_sub(q.x, spt_splat(map->center[0])),
                               spt_sub(q.y, spt_splat(map->center[1])),
                               spt_sub(q.z, spt_splat(map->center[2]))},
                              inverse,
                              spt_mul(spt_splat(map->c_length), spt_sqrt(inverse))};
    return image;
}

SPTI_INLINE spt_wide pull_row(const float row[3], shape_points y) {
    return spt_add(spt_add(spt_mul(y.x, spt_splat(row[0])), spt_mul(y.y, spt_splat(row[1]))),
                   spt_mul(y.z, spt_splat(row[2])));
}

/* By an inversion. */
SPTI_INLINE pull_image pull_by_inversion(const spt_built_map *map, shape_points x) {
    const spt_wide zero = spt_splat(0.0f), near = spt_splat(map->least / map->c_length);
    shape_points y = {spt_sub(x.x, spt_splat(map->pole[0])), spt_sub(x.y, spt_splat(map->pole[1])),
                      spt_sub(x.z, spt_splat(map->pole[2]))};
    const spt_wide whole =
        spt_add(spt_add(spt_mul(y.x, y.x), spt_mul(y.y, y.y)), spt_mul(y.z, y.z));
    const spt_wide floor = spt_mul(near, near);
    const spt_mask small = spt_less(whole, floor);
    y.x = spt_select(small, near, y.x);
    y.y = spt_select(small, zero, y.y);
    y.z = spt_select(small, zero, y.z);
    const spt_wide inverse = spt_div(spt_splat(1.0f), spt_select(small, floor, whole));
    const shape_points v = {spt_mul(y.x, inverse), spt_mul(y.y, inverse), spt_mul(y.z, inverse)};
    const shape_points from_center = {pull_row(&map->matrix[0], v), pull_row(&map->matrix[3], v),
                                      pull_row(&map->matrix[6], v)};
    const pull_image image = {{spt_add(from_center.x, spt_splat(map->center[0])),
                               spt_add(from_center.y, spt_splat(map->center[1])),
                               spt_add(from_center.z, spt_splat(map->center[2]))},
                              from_center,
                              spt_mul(inverse, spt_splat(map->c_inverse)),
                              spt_sqrt(inverse)};
    return image;
}

/* The choice is one a level, not one a point. */
SPTI_INLINE pull_image pull_through(const spt_built_map *map, shape_points x) {
    return map->inverts ? pull_by_inversion(map, x) : pull_by_quaternions(map, x);
}

/* What is joined at each level: a bound of the distance in the world, */
typedef struct pull_scale {
    spt_wide shrink, reach;
    spt_wide clear; /* the radius of a ball in the world that holds nothing of what is to come */
} pull_scale;

/* The radius of the ball in the world that a distance at the end of the way leaves free. Beyond 2^64
 * it counts as that, so that infinity, which is legal, is not divided by infinity. */
SPTI_INLINE spt_wide pull_radius(const pull_scale *scale, spt_wide distance) {
    const spt_wide k = spt_min(spt_splat(0x1p64f), distance);
    return spt_div(k, spt_add(scale->shrink, spt_mul(scale->reach, spt_abs(k))));
}

/* How far a point is from the ball around all that a map has mapped. */
SPTI_INLINE spt_wide pull_from_whole(const spt_built_map *map, shape_points x) {
    const spt_wide dx = spt_sub(x.x, spt_splat(map->whole[0]));
    const spt_wide dy = spt_sub(x.y, spt_splat(map->whole[1]));
    const spt_wide dz = spt_sub(x.z, spt_splat(map->whole[2]));
    const spt_wide square = spt_add(spt_add(spt_mul(dx, dx), spt_mul(dy, dy)), spt_mul(dz, dz));
    return spt_sub(spt_sqrt(square), spt_splat(map->whole[3]));
}

/* Near the map's pole a preimage is far from everything, and yet the ball around it that is free
 * does not hold infinity, which is what is near: there the ball around all that was mapped tells
 * more. So it does where lengths have shrunk so far that no float32 distance is left of them. */
SPTI_INLINE shape_points pull_level(const spt_built_map *map, shape_points x, pull_scale *scale) {
    const pull_image image = pull_through(map, x);
    scale->clear = spt_max(pull_radius(scale, pull_from_whole(map, x)), scale->clear);
    scale->reach = spt_add(scale->reach, spt_mul(scale->shrink, image.bend));
    scale->shrink = spt_mul(scale->shrink, image.inverse);
    /* Neither infinity nor 0, which no distance may be divided by; 2^64 / 2^100 is nothing. */
    scale->reach = spt_min(scale->reach, spt_splat(0x1p100f));
    scale->shrink = spt_max(spt_min(scale->shrink, spt_splat(0x1p100f)), spt_splat(FLT_MIN));
    return image.point;
}

/* A kernel's part of the bound. */
SPTI_INLINE spt_wide pull_bound(const pull_scale *scale, spt_wide distance) {
    const spt_wide radius = pull_radius(scale, distance);
    const spt_mask outside = spt_less(spt_splat(0.0f), scale->clear);
    return spt_select(outside, spt_max(radius, scale->clear), radius);
}

/* or the clearance of a ball, -1 where it came out inside-out. */
typedef struct pull_ball {
    spt_wide radius;
    spt_mask inside_out;
    spt_mask clear; /* it meets nothing of what is still to come */
} pull_ball;

SPTI_INLINE shape_points pull_ball_level(const spt_built_map *map, shape_points x,
                                         pull_ball *ball) {
    const spt_wide one = spt_splat(1.0f), largest = spt_splat(0x1p60f);
    const pull_image image = pull_through(map, x);
    const spt_mask away = spt_less(ball->radius, pull_from_whole(map, x));
    ball->clear = spt_mask_or(ball->clear, spt_mask_and_not(away, ball->inside_out));
    /* m < 1: the ball does not reach the pole. One that is larger than anything counts as one that
     * does; either number is held to where no product is infinity by 0. */
    const spt_wide held = spt_min(ball->radius, largest), share_of_way = spt_mul(held, image.bend);
    const spt_wide m = spt_min(spt_mul(share_of_way, share_of_way), largest);
    const spt_mask short_of_it = spt_mask_and(spt_less(m, one), spt_less(ball->radius, largest));
    ball->inside_out = spt_mask_or(ball->inside_out, spti_mask_not(short_of_it));
    const spt_wide growth = spt_div(one, spt_select(short_of_it, spt_sub(one, m), one));
    /* What means nothing any more must not shrink to where processors are slow. */
    const spt_wide share = spt_select(ball->inside_out, spt_splat(0.0f), spt_mul(m, growth));
    const spt_wide radius = spt_mul(spt_mul(held, image.inverse), growth);
    const shape_points shift = {spt_mul(image.from_center.x, share),
                                spt_mul(image.from_center.y, share),
                                spt_mul(image.from_center.z, share)};
    /* What rounding of m does to both is growth times larger: so much the ball is made larger. */
    const spt_wide far = spt_add(spt_add(spt_abs(shift.x), spt_abs(shift.y)), spt_abs(shift.z));
    const spt_wide noise = spt_mul(spt_mul(growth, spt_splat(0x1p-21f)), spt_add(far, radius));
    ball->radius = spt_select(ball->inside_out, one, spt_add(radius, noise));
    const shape_points moved = {spt_add(image.point.x, shift.x), spt_add(image.point.y, shift.y),
                                spt_add(image.point.z, shift.z)};
    return moved;
}

/* The mirror x = 0 of a level, of points that are to be on x <= 0. */
SPTI_INLINE shape_points pull_mirror(const spti_stretch *stretch, uint32_t level, shape_points x) {
    if (!(stretch->unmirrored >> level & 1)) x.x = spt_sub(spt_splat(0.0f), spt_abs(x.x));
    return x;
}

SPTI_INLINE void pull_store(const spti_way *way, size_t at, shape_points x) {
    spt_store(&way->x[at], x.x);
    spt_store(&way->y[at], x.y);
    spt_store(&way->z[at], x.z);
}

/* One level: mirror i is between kernel i + 1 and what level i holds, in whose space map i - 1 and
 * kernel i follow; the topmost has no mirror, the lowest no map (Algorithm 3, which asks kernel i
 * behind mirror i and kernel n never). */
SPTI_INLINE void pull_vectors(const spti_stretch *stretch, int vectors, size_t at,
                              const spti_way *way) {
    shape_points points[2];
    pull_scale scales[2];
    spt_wide least[2], distances[2];
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        points[v] = shape_load(way, place);
        scales[v].shrink = stretch->begins ? spt_splat(1.0f) : spt_load(&way->shrink[place]);
        scales[v].reach = stretch->begins ? spt_splat(0.0f) : spt_load(&way->reach[place]);
        scales[v].clear = stretch->begins ? spt_splat(0.0f) : spt_load(&way->clear[place]);
        least[v] = stretch->begins ? spt_splat(INFINITY) : spt_load(&way->distance[place]);
    }
    for (uint32_t level = stretch->first + 1; level-- > stretch->last;) {
        for (int v = 0; v < vectors; ++v) {
            if (level < stretch->levels) points[v] = pull_mirror(stretch, level, points[v]);
            if (level == 0) continue;
            points[v] = pull_level(&stretch->maps[level - 1], points[v], &scales[v]);
        }
        if (!shape_distances(&stretch->kernels[level], vectors, points, distances)) continue;
        for (int v = 0; v < vectors; ++v) {
            least[v] = spt_min(pull_bound(&scales[v], distances[v]), least[v]);
        }
    }
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        spt_store(&way->distance[place], least[v]);
        if (!stretch->goes_on) continue;
        pull_store(way, place, points[v]);
        spt_store(&way->shrink[place], scales[v].shrink);
        spt_store(&way->reach[place], scales[v].reach);
        spt_store(&way->clear[place], scales[v].clear);
    }
}

SPTI_INLINE void pull_stretch(const spti_stretch *stretch, size_t n, const spti_way *way) {
    size_t at = 0;
    for (; at + 2 * SPT_LANES <= n; at += 2 * SPT_LANES) pull_vectors(stretch, 2, at, way);
    if (at < n) pull_vectors(stretch, 1, at, way);
}

/* What the radius of a ball says from one stretch to the next, if it is no radius any more. */
#define PULL_INSIDE_OUT (-1.0f)
#define PULL_CLEAR (-2.0f)

SPTI_INLINE pull_ball pull_load_ball(const spti_way *way, size_t place) {
    const spt_wide radius = spt_load(&way->radius[place]), zero = spt_splat(0.0f);
    const spt_mask clear = spt_less(radius, spt_splat(PULL_INSIDE_OUT));
    const pull_ball ball = {spt_abs(radius), spt_mask_and_not(spt_less(radius, zero), clear),
                            clear};
    return ball;
}

SPTI_INLINE spt_wide pull_ball_radius(const pull_ball *ball) {
    const spt_wide radius = spt_select(ball->inside_out, spt_splat(PULL_INSIDE_OUT), ball->radius);
    return spt_select(ball->clear, spt_splat(PULL_CLEAR), radius);
}

/* The same for balls: clearance instead of distance. One that came out inside-out has none, whatever
 * its numbers are afterwards, and one that is clear keeps what it had. */
SPTI_INLINE void pull_balls(const spti_stretch *stretch, int vectors, size_t at,
                            const spti_way *way) {
    const spt_wide none = spt_splat(-1.0f);
    shape_points points[2];
    pull_ball balls[2];
    spt_wide least[2], distances[2];
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        points[v] = shape_load(way, place);
        balls[v] = pull_load_ball(way, place);
        least[v] = stretch->begins ? spt_splat(INFINITY) : spt_load(&way->distance[place]);
    }
    for (uint32_t level = stretch->first + 1; level-- > stretch->last;) {
        for (int v = 0; v < vectors; ++v) {
            if (level < stretch->levels) points[v] = pull_mirror(stretch, level, points[v]);
            if (level == 0) continue;
            points[v] = pull_ball_level(&stretch->maps[level - 1], points[v], &balls[v]);
        }
        if (!shape_distances(&stretch->kernels[level], vectors, points, distances)) continue;
        for (int v = 0; v < vectors; ++v) {
            const spt_wide clearance = spt_min(spt_sub(distances[v], balls[v].radius), least[v]);
            least[v] = spt_select(balls[v].clear, least[v], clearance);
        }
    }
    for (int v = 0; v < vectors; ++v) {
        const size_t place = at + (size_t)v * SPT_LANES;
        const spt_mask fails = spt_mask_and_not(balls[v].inside_out, balls[v].clear);
        spt_store(&way->distance[place], spt_select(fails, none, least[v]));
        if (!stretch->goes_on) continue;
        pull_store(way, place, points[v]);
        spt_store(&way->radius[place], pull_ball_radius(&balls[v]));
    }
}

SPTI_INLINE void probe_stretch(const spti_stretch *stretch, size_t n, const spti_way *way) {
    size_t at = 0;
    for (; at + 2 * SPT_LANES <= n; at += 2 * SPT_LANES) pull_balls(stretch, 2, at, way);
    if (at < n) pull_balls(stretch, 1, at, way);
}

#endif
