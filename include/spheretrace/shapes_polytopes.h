/* SPDX-License-Identifier: MIT
 *
 * Convex bodies made of planes: the maximum of plane distances, and the generalised distances of
 * Akleman and Chen that round it off. The rules that hold for all are in shapes.h. Left out: exact
 * distances to edges and corners.
 *
 * Planes are given as an array. A loop over points vectorises if count is a constant, at most 16,
 * and with clang, for general exponents, if the array is a constant, too. */
#ifndef SPHERETRACE_SHAPES_POLYTOPES_H
#define SPHERETRACE_SHAPES_POLYTOPES_H

#include "shapes_math.h"

/* normal.p <= offset, normal a unit vector; or a slab, |normal.p| <= offset with offset >= 0. */
typedef struct spt_half_space {
    spt_point normal;
    spt_real offset;
} spt_half_space;

/* The intersection of count >= 1 half-spaces: max(normal.p - offset). A lower bound: exact inside,
 * and outside wherever the nearest point lies on a face; near a corner seen under the angle a from
 * a face's normal it is cos(a) times the distance. L = 1, convex. 6 flop a half-space. */
SPT_SHAPE spt_real spt_polytope(spt_point p, int count, const spt_half_space *half_spaces) {
    spt_real distance = spt_dot(half_spaces[0].normal, p) - half_spaces[0].offset;
    SPT_UNROLL
    for (int i = 1; i < count; ++i) {
        distance =
            spt_greatest(spt_dot(half_spaces[i].normal, p) - half_spaces[i].offset, distance);
    }
    return distance;
}

/* The intersection of count >= 1 slabs |normal.p| <= offset, so of a centrally symmetric body at
 * half the cost of its half-spaces. As spt_polytope(). 7 flop a slab. */
SPT_SHAPE spt_real spt_slabs(spt_point p, int count, const spt_half_space *slabs) {
    spt_real distance = spt_magnitude(spt_dot(slabs[0].normal, p)) - slabs[0].offset;
    SPT_UNROLL
    for (int i = 1; i < count; ++i) {
        distance =
            spt_greatest(spt_magnitude(spt_dot(slabs[i].normal, p)) - slabs[i].offset, distance);
    }
    return distance;
}

/* GENERALISED DISTANCES (Akleman and Chen 1999), a polytope rounded off: with w the least of the
 * offsets and t = max(0, normal.p - offset + w),
 *     f = (sum of t^exponent)^(1/exponent) - w
 * or, where all offsets are equal, (sum of max(0, normal.p)^exponent)^(1/exponent) - w. For slabs,
 * |normal.p| in place of normal.p.
 *   offset > 0, so that the origin is inside; exponent from 2 to 512
 *   shape    lies in the polytope and tends to it as the exponent grows; the smaller the exponent,
 *            the rounder edges, corners and faces. f >= max(spt_polytope(), -w), and f + w is at
 *            most count^(1/exponent) times that plus w
 *   quality  a lower bound of the distance to the rounded body, after division by L. Constant, -w,
 *            where all t are 0
 *   convex   since a norm of t grows with each t, and each t is convex
 *   L        the largest norm of the max(0, normal.u) over unit vectors u, as two norms differ by
 *            at most the norm of the difference: spt_generalised_lipschitz() bounds it. 1 or little
 *            above if the normals are far apart for the exponent; at most sqrt(count)
 *   numbers  terms are divided by about the largest, so that no power overflows */

/* t before the maximum with 0. slab is a constant: |normal.p| in place of normal.p. */
SPT_SHAPE spt_real spti_shape_term(spt_point p, const spt_half_space *plane, spt_real width,
                                   int slab) {
    const spt_real height = spt_dot(plane->normal, p);
    return (slab ? spt_magnitude(height) : height) - (plane->offset - width);
}

SPT_SHAPE spt_real spti_shape_width(int count, const spt_half_space *planes) {
    spt_real width = planes[0].offset;
    SPT_UNROLL
    for (int i = 1; i < count; ++i) width = spt_least(planes[i].offset, width);
    return width;
}

SPT_SHAPE spt_real spti_shape_largest(spt_point p, int count, const spt_half_space *planes,
                                      spt_real width, int slab) {
    spt_real largest = spti_shape_term(p, &planes[0], width, slab);
    SPT_UNROLL
    for (int i = 1; i < count; ++i) {
        largest = spt_greatest(spti_shape_term(p, &planes[i], width, slab), largest);
    }
    return spt_greatest(largest, spti_shape_zero(p.x));
}

SPT_SHAPE spt_real spti_shape_powers(spt_point p, int count, const spt_half_space *planes,
                                     spt_real exponent, int slab) {
    const spt_real width = spti_shape_width(count, planes);
    const spt_real largest = spti_shape_largest(p, count, planes, width, slab);
    const spt_real inverse = 1 / (largest + SPT_REAL_MIN);
    /* the logarithm asks for a positive number, and e^-32 and less change nothing beside the
     * largest term, 1 */
    const spt_real zero = spti_shape_zero(p.x);
    const spt_real tiny = (spt_real)1e-12 + zero;
    const spt_real lowest = -32 + zero;
    spt_real sum = 0;
    SPT_UNROLL
    for (int i = 0; i < count; ++i) {
        const spt_real scaled = spti_shape_term(p, &planes[i], width, slab) * inverse;
        const spt_real power = exponent * spti_shape_log(spt_greatest(scaled, tiny), 0);
        sum += spti_shape_exp(spt_greatest(power, lowest));
    }
    /* the sum is positive, so infinity if the largest is */
    return largest * spti_shape_exp(spti_shape_log(sum, 0) / exponent) - width;
}

SPT_SHAPE spt_real spti_shape_squares(spt_point p, int count, const spt_half_space *planes,
                                      int squarings, int slab) {
    const spt_real width = spti_shape_width(count, planes);
    const spt_real largest = spti_shape_largest(p, count, planes, width, slab);
    /* scaled by a power of two, exactly, so that the largest term is in [1, 2) */
    const spt_bits scale = spt_bits_of(largest) & SPT_EXPONENT_MASK;
    const spt_bits twice_one = 2 * (spt_bits_of(1) & SPT_EXPONENT_MASK);
    const spt_real inverse = spt_real_of(twice_one - scale);
    /* A term raised to this becomes 2^-64, which changes nothing beside 1, while a smaller one
     * would be squared into the denormals: on them the loop took 3.5 times as long. */
    const spt_real power_of_two = (spt_real)((uint64_t)1 << (64 >> squarings));
    const spt_real least = 1 / power_of_two + spti_shape_zero(p.x);
    spt_real sum = 0;
    SPT_UNROLL
    for (int i = 0; i < count; ++i) {
        const spt_real scaled = spti_shape_term(p, &planes[i], width, slab) * inverse;
        spt_real term = spt_greatest(scaled, least);
        SPT_UNROLL
        for (int k = 0; k < squarings; ++k) term = term * term;
        sum += term;
    }
    SPT_UNROLL
    for (int k = 0; k < squarings; ++k) sum = spt_root(sum);
    return spt_real_of(scale) * sum - width; /* infinity if the largest is, as above */
}

/* The generalised distance of count half-spaces, any real exponent. 50 flop and 1 division a
 * half-space: with 6 of them 11 ns with AVX2, against 2 ns by squaring. */
SPT_SHAPE spt_real spt_generalised_distance(spt_point p, int count,
                                            const spt_half_space *half_spaces, spt_real exponent) {
    return spti_shape_powers(p, count, half_spaces, exponent, 0);
}

/* The same for count slabs. */
SPT_SHAPE spt_real spt_generalised_slabs(spt_point p, int count, const spt_half_space *slabs,
                                         spt_real exponent) {
    return spti_shape_powers(p, count, slabs, exponent, 1);
}

/* The cheap way to exponents 2, 4, 8 ... 64: exponent = 2^squarings, squarings from 1 to 6 and a
 * constant. The power by repeated squaring, the root by as many square roots. 11 + squarings flop a
 * half-space, `squarings` roots. */
SPT_SHAPE spt_real spt_generalised_distance_by_squaring(spt_point p, int count,
                                                        const spt_half_space *half_spaces,
                                                        int squarings) {
    return spti_shape_squares(p, count, half_spaces, squarings, 0);
}

/* The same for count slabs. Exponent 32: 17 flop a slab, 5 roots. */
SPT_SHAPE spt_real spt_generalised_slabs_by_squaring(spt_point p, int count,
                                                     const spt_half_space *slabs, int squarings) {
    return spti_shape_squares(p, count, slabs, squarings, 1);
}

/* The largest eigenvalue of the sum of normal normal^T, from above: at most trace(M^64)^(1/64), by
 * six squarings, the trace kept at 1; too large by 1.7 % at most. */
static inline double spti_shape_eigenvalue(int count, const spt_half_space *planes) {
    double matrix[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < count; ++i) {
        const spt_point n = planes[i].normal;
        const double a[3] = {(double)n.x, (double)n.y, (double)n.z};
        for (int k = 0; k < 9; ++k) matrix[k / 3][k % 3] += a[k / 3] * a[k % 3];
    }
    double logarithm = 0, weight = 1;
    for (int round = 0; round <= 6; ++round) {
        const double trace = matrix[0][0] + matrix[1][1] + matrix[2][2];
        double square[3][3];
        logarithm += weight * log(trace);
        weight *= 0.5;
        for (int k = 0; k < 9; ++k) matrix[k / 3][k % 3] /= trace;
        for (int k = 0; k < 9; ++k) {
            const double *row = matrix[k / 3];
            square[k / 3][k % 3] =
                row[0] * matrix[0][k % 3] + row[1] * matrix[1][k % 3] + row[2] * matrix[2][k % 3];
        }
        memcpy(matrix, square, sizeof matrix);
    }
    return exp(logarithm);
}

/* A bound, from above, of L of a generalised distance with exponent >= 2: of count half-spaces, or
 * with slabs = 1 of as many slabs. The six slabs of a dodecahedron: 1.43 for exponent 2, 1.10 for
 * 4, 1.001 for 8, 1 + 2e-6 from 16 on. For half-spaces up to sqrt(2) too large with exponent 2, as
 * it reckons with all of them at once. Takes about 35 microseconds, so before any loop; computed in
 * double with libm, the last bit may differ between C libraries.
 * Why: of the terms for a unit vector u the largest is cos(a)^e, at the normal nearest to u, at the
 * angle a. All others are at least t - a from u, t the least angle between two normals, so at most
 * c = cos(max(a, t - a)); and the squares of all have a sum of at most the eigenvalue E above. So
 * the sum is at most cos(a)^e + (E - cos(a)^2) c^(e-2). */
static inline spt_real spt_generalised_lipschitz(int count, const spt_half_space *planes,
                                                 spt_real exponent, int slabs) {
    double nearest = -1; /* cosine of t */
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < i; ++j) {
            const spt_point a = planes[i].normal, b = planes[j].normal;
            const double product =
                (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
            const double cosine = slabs ? fabs(product) : product;
            nearest = cosine > nearest ? cosine : nearest;
        }
    }
    nearest = nearest < 1 ? nearest : 1;
    const double eigenvalue = spti_shape_eigenvalue(count, planes);
    /* the largest bound over small intervals of a; beyond a right angle all terms are 0 */
    const int intervals = 1024;
    const double least_angle = acos(nearest), e = (double)exponent;
    double largest = 0;
    for (int k = 0; k < intervals; ++k) {
        const double from = 1.5707963267948966 * k / intervals;
        const double to = 1.5707963267948966 * (k + 1) / intervals;
        const double apart = least_angle - to;
        const double others = cos(from > apart ? from : apart);
        const double rest = eigenvalue - cos(to) * cos(to);
        const double sum =
            pow(cos(from), e) + (rest > 0 && others > 0 ? rest * pow(others, e - 2) : 0);
        largest = sum > largest ? sum : largest;
    }
    return (spt_real)(pow(largest, 1 / e) * (1 + 1e-6)); /* rounded up */
}

#endif
