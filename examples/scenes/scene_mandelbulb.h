/* SPDX-License-Identifier: MIT
 *
 * The Mandelbulb of power 8: q -> q^8 + p in the spherical coordinates of White and Nylander, with
 * the distance estimate |q| log|q| / (2 |dq/dp|) of Quilez (Mandelbulb, 2009). It is an estimate
 * and no bound: lipschitz 1 is a convention here, near the surface slopes are far larger. */
#ifndef EXAMPLES_SCENE_MANDELBULB_H
#define EXAMPLES_SCENE_MANDELBULB_H

#include "scene_mandelbulb.glsl.h"
#include "scene_source.h"

enum { MANDELBULB_ITERATIONS = 6, MANDELBULB_VECTORS = 2 };

/* |q|^2 beyond which a point has escaped. */
#define MANDELBULB_ESCAPE 256.0f

/* Least x^2 + z^2, so that the axis does not divide zero by zero. The terms that are divided fall
 * with the eighth power of the radius, faster than what this changes. */
#define MANDELBULB_AXIS 1e-5f

/* What is added to |q|^2 for the logarithm: nothing but at the origin, where the estimate is 0. (No
 * maximum: gcc splits a loop's body along a maximum with a constant and then cannot vectorise.) */
#define MANDELBULB_ORIGIN 1e-30f

/* The eighth power without angles: with r the distance from the axis, (y + ir)^8 and (z + ix)^8 by
 * three complex squarings each. Of the first, r is kept out of the imaginary part (odd * r), so
 * that its root waits for nothing; the second is divided by r^8 to be a direction. */
SPT_INLINE spt_point mandelbulb_power(spt_point q, spt_point p) {
    const spt_real axis = (spt_real)MANDELBULB_AXIS;
    const spt_real xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xz = q.x * q.z;
    const spt_real flat = xx + zz;
    const spt_real rr = spt_greatest(flat, axis);
    const spt_real even_2 = yy - rr, odd_2 = q.y + q.y;
    const spt_real product_2 = even_2 * odd_2;
    const spt_real even_4 = even_2 * even_2 - rr * (odd_2 * odd_2), odd_4 = product_2 + product_2;
    const spt_real product_4 = even_4 * odd_4;
    const spt_real even_8 = even_4 * even_4 - rr * (odd_4 * odd_4), odd_8 = product_4 + product_4;
    const spt_real cosine_2 = zz - xx, sine_2 = xz + xz;
    const spt_real turn_2 = cosine_2 * sine_2;
    const spt_real cosine_4 = cosine_2 * cosine_2 - sine_2 * sine_2, sine_4 = turn_2 + turn_2;
    const spt_real turn_4 = cosine_4 * sine_4;
    const spt_real cosine_8 = cosine_4 * cosine_4 - sine_4 * sine_4, sine_8 = turn_4 + turn_4;
    const spt_real scale = odd_8 / (rr * (rr * rr) * spt_root(rr));
    return spt_point_of(scale * sine_8 + p.x, even_8 + p.y, scale * cosine_8 + p.z);
}

SPT_INLINE spt_real mandelbulb_square(spt_point q) {
    return q.x * q.x + q.y * q.y + q.z * q.z;
}

SPT_INLINE spt_real mandelbulb_estimate(spt_real squared, spt_real derivative) {
    const spt_real kept = squared + (spt_real)MANDELBULB_ORIGIN;
    return (spt_real)0.25f * spt_log(kept) * spt_root(kept) / derivative;
}

SPT_INLINE spt_real scene_mandelbulb_distance(spt_point p) {
    spt_point q = p;
    spt_real squared = mandelbulb_square(q), derivative = 1;
    for (int i = 0; i < MANDELBULB_ITERATIONS; ++i) {
        const spt_real cubed = squared * (squared * squared);
        if (!(squared <= (spt_real)MANDELBULB_ESCAPE)) break;
        derivative = 8 * (cubed * spt_root(squared)) * derivative + 1;
        q = mandelbulb_power(q, p);
        squared = mandelbulb_square(q);
    }
    return mandelbulb_estimate(squared, derivative);
}

#ifndef SPT_SHAPES_DOUBLE

/* The same by hand for SPT_LANES points, operation by operation. */
typedef struct mandelbulb_lanes {
    spt_wide x, y, z, squared, derivative;
    spt_wide from_x, from_y, from_z;
} mandelbulb_lanes;

SPT_INLINE spt_wide mandelbulb_lanes_square(const mandelbulb_lanes *q) {
    return spt_add(spt_add(spt_mul(q->x, q->x), spt_mul(q->y, q->y)), spt_mul(q->z, q->z));
}

SPT_INLINE mandelbulb_lanes mandelbulb_lanes_start(const float *x, const float *y, const float *z) {
    mandelbulb_lanes q;
    q.x = q.from_x = spt_load(x);
    q.y = q.from_y = spt_load(y);
    q.z = q.from_z = spt_load(z);
    q.squared = mandelbulb_lanes_square(&q);
    q.derivative = spt_splat(1);
    return q;
}

/* Squares a complex number, of which the imaginary part is a multiple of the root of scale. */
SPT_INLINE void mandelbulb_lanes_turn(spt_wide *real_part, spt_wide *imaginary, spt_wide scale) {
    const spt_wide product = spt_mul(*real_part, *imaginary);
    *real_part =
        spt_sub(spt_mul(*real_part, *real_part), spt_mul(scale, spt_mul(*imaginary, *imaginary)));
    *imaginary = spt_add(product, product);
}

SPT_INLINE void mandelbulb_lanes_power(mandelbulb_lanes *q) {
    const spt_wide one = spt_splat(1);
    const spt_wide xx = spt_mul(q->x, q->x), yy = spt_mul(q->y, q->y), zz = spt_mul(q->z, q->z);
    const spt_wide xz = spt_mul(q->x, q->z);
    const spt_wide rr = spt_max(spt_add(xx, zz), spt_splat(MANDELBULB_AXIS));
    spt_wide even = spt_sub(yy, rr), odd = spt_add(q->y, q->y);
    spt_wide cosine = spt_sub(zz, xx), sine = spt_add(xz, xz), scale;
    mandelbulb_lanes_turn(&even, &odd, rr);
    mandelbulb_lanes_turn(&even, &odd, rr);
    mandelbulb_lanes_turn(&cosine, &sine, one);
    mandelbulb_lanes_turn(&cosine, &sine, one);
    scale = spt_div(odd, spt_mul(spt_mul(rr, spt_mul(rr, rr)), spt_sqrt(rr)));
    q->x = spt_add(spt_mul(scale, sine), q->from_x);
    q->y = spt_add(even, q->from_y);
    q->z = spt_add(spt_mul(scale, cosine), q->from_z);
}

/* One iteration; points that have escaped keep their two results. Returns which go on. */
SPT_INLINE spt_mask mandelbulb_lanes_iterate(mandelbulb_lanes *q) {
    const spt_wide escape = spt_splat(MANDELBULB_ESCAPE);
    const spt_mask inside = spt_less_equal(q->squared, escape);
    const spt_wide cubed = spt_mul(q->squared, spt_mul(q->squared, q->squared));
    const spt_wide seventh = spt_mul(cubed, spt_sqrt(q->squared));
    const spt_wide derivative =
        spt_add(spt_mul(spt_mul(spt_splat(8), seventh), q->derivative), spt_splat(1));
    mandelbulb_lanes_power(q);
    q->derivative = spt_select(inside, derivative, q->derivative);
    q->squared = spt_select(inside, mandelbulb_lanes_square(q), q->squared);
    return spt_less_equal(q->squared, escape);
}

/* count vectors at once: one waits long for its divisions and roots. */
SPT_INLINE void mandelbulb_lanes_run(int count, const float *x, const float *y, const float *z,
                                     float *squared, float *derivative) {
    mandelbulb_lanes q[MANDELBULB_VECTORS];
    spt_mask inside = spt_mask_splat(1);
    for (int v = 0; v < count; ++v) {
        q[v] = mandelbulb_lanes_start(x + v * SPT_LANES, y + v * SPT_LANES, z + v * SPT_LANES);
    }
    for (int i = 0; i < MANDELBULB_ITERATIONS && spt_any(inside); ++i) {
        inside = spt_mask_splat(0);
        for (int v = 0; v < count; ++v) {
            inside = spt_mask_or(inside, mandelbulb_lanes_iterate(&q[v]));
        }
    }
    for (int v = 0; v < count; ++v) {
        spt_store(squared + v * SPT_LANES, q[v].squared);
        spt_store(derivative + v * SPT_LANES, q[v].derivative);
    }
}

SPT_INLINE void scene_mandelbulb_vectors(size_t n, const float *x, const float *y, const float *z,
                                         float *distance) {
    float squared[SPT_BATCH], derivative[SPT_BATCH];
    const size_t step = MANDELBULB_VECTORS * SPT_LANES;
    size_t i = 0;
    for (; i + step <= n; i += step) {
        mandelbulb_lanes_run(MANDELBULB_VECTORS, x + i, y + i, z + i, squared + i, derivative + i);
    }
    for (; i < n; i += SPT_LANES) {
        mandelbulb_lanes_run(1, x + i, y + i, z + i, squared + i, derivative + i);
    }
    for (i = 0; i < n; ++i) distance[i] = mandelbulb_estimate(squared[i], derivative[i]);
}

#endif
#endif

#ifdef SCENE
SCENE_VECTORS(mandelbulb,
              .description = "Mandelbulb of power 8, 6 iterations; an estimate, not a bound",
              .lipschitz = 1, .bound = BALL(0, 0, 0, 1.25f), .eye = {1.85, 1.5, 3},
              .target = {0, 0, 0}, .field_of_view = 50, .t_max = 10,
              .glsl_prelude = MANDELBULB_GLSL_PRELUDE)
#endif
