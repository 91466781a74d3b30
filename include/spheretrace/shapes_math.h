/* SPDX-License-Identifier: MIT
 *
 * The arithmetic under the shapes: the number type, points, and sine, cosine, exponential and
 * logarithm that vectorise and give the same bits everywhere. Left out: anything about surfaces,
 * see shapes.h, which includes this and states the rules that hold for all of it. */
#ifndef SPHERETRACE_SHAPES_MATH_H
#define SPHERETRACE_SHAPES_MATH_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* The number type of all shapes: float, or double in a file that defines SPT_SHAPES_DOUBLE before
 * it includes any of these headers (a reference to test against). One type a file. */
#ifdef SPT_SHAPES_DOUBLE
typedef double spt_real;
typedef uint64_t spt_bits;
typedef int64_t spt_signed_bits;
#define SPT_EXPONENT_MASK 0x7ff0000000000000u /* of the bits of a number */
#define SPT_REAL_MAX DBL_MAX
#define SPT_REAL_MIN DBL_MIN
#else
typedef float spt_real;
typedef uint32_t spt_bits;
typedef int32_t spt_signed_bits;
#define SPT_EXPONENT_MASK 0x7f800000u /* of the bits of a number */
#define SPT_REAL_MAX FLT_MAX
#define SPT_REAL_MIN FLT_MIN
#endif

/* A loop over points vectorises only if all it calls is inlined into it. */
#if defined(__GNUC__)
#define SPT_SHAPE static inline __attribute__((always_inline, unused))
#else
#define SPT_SHAPE static inline
#endif

/* Before an inner loop over the planes of a body: unroll it if its count is a constant up to 16,
 * which leaves the loop over the points as the innermost one, the only one that vectorises. */
#if defined(__clang__)
#define SPT_UNROLL _Pragma("clang loop unroll_count(16)")
#elif defined(__GNUC__)
#define SPT_UNROLL _Pragma("GCC unroll 16")
#else
#define SPT_UNROLL
#endif

/* A point or a vector. */
typedef struct spt_point {
    spt_real x, y, z;
} spt_point;

SPT_SHAPE spt_point spt_point_of(spt_real x, spt_real y, spt_real z) {
    spt_point p;
    p.x = x;
    p.y = y;
    p.z = z;
    return p;
}

/* a < b ? a : b and a > b ? a : b, hence b if either is NaN or both are zeros: one instruction,
 * unlike fmin and fmax. Where one side is a constant use spt_positive(), spt_negative() or
 * spt_clamp(). */
SPT_SHAPE spt_real spt_least(spt_real a, spt_real b) {
    return a < b ? a : b;
}

SPT_SHAPE spt_real spt_greatest(spt_real a, spt_real b) {
    return a > b ? a : b;
}

/* The bits of a number, and back. By memcpy, which compilers see through: a union is no C++. */
SPT_SHAPE spt_bits spt_bits_of(spt_real x) {
    spt_bits bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

SPT_SHAPE spt_real spt_real_of(spt_bits bits) {
    spt_real x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The sign bit of x, all others 0. */
SPT_SHAPE spt_bits spt_sign_bit(spt_real x) {
    return spt_bits_of(x) & ((spt_bits)1 << (8 * sizeof(spt_bits) - 1));
}

/* Zero as a side of spt_least() and spt_greatest(); added to a constant, it makes that one fit to
 * be a side. gcc computes what follows a selection once for each side if that spares work, as it
 * does for a constant side (0 * 0 is 0): the selection becomes a branch and the loop does not
 * vectorise. So gcc gets a zero that it does not know, with the sign of x, any variable; clang is
 * better off with 0. The result must not depend on the sign of the zero. */
SPT_SHAPE spt_real spti_shape_zero(spt_real x) {
#if defined(__clang__)
    (void)x;
    return 0;
#else
    return spt_real_of(spt_sign_bit(x));
#endif
}

/* max(x, 0) and min(x, 0), and 0 if x is NaN: the place where an infinity minus itself ends. */
SPT_SHAPE spt_real spt_positive(spt_real x) {
    return spt_greatest(x, 0 + spti_shape_zero(x)); /* 0 + -0 is 0 */
}

SPT_SHAPE spt_real spt_negative(spt_real x) {
    return spt_least(x, 0 + spti_shape_zero(x));
}

/* x brought into [low, high]; low if x is NaN. */
SPT_SHAPE spt_real spt_clamp(spt_real x, spt_real low, spt_real high) {
    const spt_real zero = spti_shape_zero(x);
    return spt_least(spt_greatest(x, low + zero), high + zero);
}

/* condition ? a : b; condition must be 0 or 1, so a comparison. Both sides are computed, where gcc
 * would make of a ternary a branch with the work of each side in it, and not vectorise the loop.
 * For one point at a time it costs about 1 ns more than a branch that is predicted. */
SPT_SHAPE spt_real spt_choose(int condition, spt_real a, spt_real b) {
    const spt_bits mask = 0 - (spt_bits)condition;
    return spt_real_of((spt_bits_of(a) & mask) | (spt_bits_of(b) & ~mask));
}

/* |x| */
SPT_SHAPE spt_real spt_magnitude(spt_real x) {
#ifdef SPT_SHAPES_DOUBLE
    return fabs(x);
#else
    return fabsf(x);
#endif
}

/* The square root, correctly rounded; NaN below zero. */
SPT_SHAPE spt_real spt_root(spt_real x) {
#ifdef SPT_SHAPES_DOUBLE
    return sqrt(x);
#else
    return sqrtf(x);
#endif
}

/* a.b, the products added from left to right. */
SPT_SHAPE spt_real spt_dot(spt_point a, spt_point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The length of a vector in the plane, and in space. Squares overflow from 1.8e19 on (in float):
 * the length is then +infinity; below 1e-23 they vanish and it is 0. */
SPT_SHAPE spt_real spt_length_2(spt_real x, spt_real y) {
    return spt_root(x * x + y * y);
}

SPT_SHAPE spt_real spt_length_3(spt_real x, spt_real y, spt_real z) {
    return spt_root(x * x + y * y + z * z);
}

/* x brought into [-limit, limit], limit > 0; the limit of its sign for NaN. By bits, as positive
 * numbers are ordered as their bits are. */
SPT_SHAPE spt_real spt_limit(spt_real x, spt_real limit) {
    const spt_bits sign = spt_sign_bit(x);
    const spt_signed_bits magnitude = (spt_signed_bits)(spt_bits_of(x) ^ sign);
    const spt_signed_bits most = (spt_signed_bits)spt_bits_of(limit);
    return spt_real_of((spt_bits)(magnitude < most ? magnitude : most) | sign);
}

/* The nearest integer, halves away from zero; |x| must be below 2^31. A conversion and no floor:
 * SSE2 has no rounding instruction. */
SPT_SHAPE int32_t spt_nearest(spt_real x) {
    const spt_real half = (spt_real)0.5;
    return (int32_t)(x + spt_real_of(spt_bits_of(half) | spt_sign_bit(x)));
}

/* Sine on [-pi/2, pi/2] in double: r + r^3 P(r^2), P minimax of degree 7, error below 3e-19. */
SPT_SHAPE double spti_shape_sine_double(double r) {
    const double z = r * r;
    double p = 2.7211304646654157e-15;
    p = p * z - 7.6429873535279671e-13;
    p = p * z + 1.6058939550560079e-10;
    p = p * z - 2.5052106869785376e-08;
    p = p * z + 2.7557319211105139e-06;
    p = p * z - 1.9841269841209036e-04;
    p = p * z + 8.3333333333331944e-03;
    p = p * z - 1.6666666666666666e-01;
    return r + r * z * p;
}

/* x - turns * pi, pi in three parts (Cody and Waite 1980) of which the first two have 33 bits, so
 * that their products with up to 20 bits of turns are exact. */
SPT_SHAPE double spti_shape_reduce_double(double x, double turns) {
    return ((x - turns * 3.1415926534682512) - turns * 1.2154201012607932e-10) -
           turns * 4.0445324975919013e-21;
}

/* sin(angle) and cos(angle) in double, angle in radians, |angle| <= 1e5: error below 3e-16. What
 * the builders use, so that they give the same bits with every C library. */
SPT_SHAPE double spti_shape_sin_double(double angle) {
    const int32_t n = (int32_t)(angle * 0.31830988618379067 + (angle < 0 ? -0.5 : 0.5));
    const double sine = spti_shape_sine_double(spti_shape_reduce_double(angle, n));
    return (n & 1) != 0 ? -sine : sine;
}

SPT_SHAPE double spti_shape_cos_double(double angle) {
    const double turns = angle * 0.31830988618379067 - 0.5;
    const int32_t n = (int32_t)(turns + (turns < 0 ? -0.5 : 0.5));
    const double sine = spti_shape_sine_double(spti_shape_reduce_double(angle, n + 0.5));
    return (n & 1) != 0 ? sine : -sine;
}

#ifndef SPT_SHAPES_DOUBLE
/* Sine on [-pi/2, pi/2]: r + r^3 P(r^2), P minimax of degree 3, relative error below 6.1e-9. */
SPT_SHAPE float spti_shape_sine(float r) {
    const float z = r * r;
    float p = 2.6057055e-06f;
    p = p * z - 1.98095702e-04f;
    p = p * z + 8.33306555e-03f;
    p = p * z - 1.66666597e-01f;
    return r + r * z * p;
}

/* x - turns * pi, pi in three parts of 8, 11 and 24 bits: exact products up to 13 bits of turns. */
SPT_SHAPE float spti_shape_reduce(float x, float turns) {
    return ((x - turns * 3.140625f) - turns * 9.67502594e-04f) - turns * 1.50995803e-07f;
}
#endif

/* sin(angle), angle in radians. Absolute error below 1.5e-7 for |angle| <= 1e4, relative error
 * likewise for |angle| <= 1.6; absolute error below 2.2e-6 up to 1e5 (the second product of the
 * reduction, up to 31, is then rounded). Beyond, the value is that of +-1e5. 20 flop; 0.5 ns with
 * AVX2. In the double build below 3e-16 up to 1e5. */
SPT_SHAPE spt_real spt_sin(spt_real angle) {
    const spt_real x = spt_limit(angle, 100000);
#ifdef SPT_SHAPES_DOUBLE
    return spti_shape_sin_double(x);
#else
    const int32_t n = spt_nearest(x * 0.318309873f);
    const float sine = spti_shape_sine(spti_shape_reduce(x, (float)n));
    return spt_real_of(spt_bits_of(sine) ^ ((uint32_t)n << 31)); /* -sine if n is odd */
#endif
}

/* cos(angle), as spt_sin(), but for the relative error: -sin(angle - pi/2) with the quarter turn
 * inside the reduction. So cos(0) is 1 - 2^-24. */
SPT_SHAPE spt_real spt_cos(spt_real angle) {
    const spt_real x = spt_limit(angle, 100000);
#ifdef SPT_SHAPES_DOUBLE
    return spti_shape_cos_double(x);
#else
    const int32_t n = spt_nearest(x * 0.318309873f - 0.5f);
    const float sine = spti_shape_sine(spti_shape_reduce(x, (float)n + 0.5f));
    return spt_real_of(spt_bits_of(sine) ^ ((uint32_t)(n + 1) << 31)); /* -sine if n is even */
#endif
}

/* exp(x) for -86.5 < x < 89; anything for others. */
SPT_SHAPE spt_real spti_shape_exp(spt_real x) {
#ifdef SPT_SHAPES_DOUBLE
    return exp(x);
#else
    const int32_t n = spt_nearest(x * 1.44269502f);
    /* ln 2 in two parts of 15 and 24 bits: the first product is exact */
    const float r = (x - (float)n * 0.693145752f) - (float)n * 1.42860677e-06f;
    /* exp(r) = 1 + r + r^2 P(r), P minimax of degree 4, relative error below 3.2e-9 */
    float p = 1.38138863e-03f;
    p = p * r + 8.36906303e-03f;
    p = p * r + 4.16684225e-02f;
    p = p * r + 1.66665182e-01f;
    p = p * r + 4.9999994e-01f;
    const float mantissa = 1 + (r + r * r * p);
    /* 2^(n-1), since 2^128 is no float but 2 * mantissa * 2^127 may be one */
    const float scale = spt_real_of((uint32_t)(n + 126) << 23);
    return (mantissa + mantissa) * scale;
#endif
}

/* log(x / 2^doublings) for normal positive x; anything for others. */
SPT_SHAPE spt_real spti_shape_log(spt_real x, spt_real doublings) {
#ifdef SPT_SHAPES_DOUBLE
    return log(x) - doublings * 0.69314718055994531;
#else
    /* x = 2^n m with m in [sqrt(1/2), sqrt(2)); 0x3f3504f3 is sqrt(1/2) */
    const uint32_t bits = spt_bits_of(x) + (0x3f800000u - 0x3f3504f3u);
    const float n = (float)((int32_t)(bits >> 23) - 127) - doublings;
    const float f = spt_real_of((bits & 0x007fffffu) + 0x3f3504f3u) - 1;
    /* log(1 + f) = f - f^2/2 + s (f^2/2 + z P(z)), s = f/(2 + f), z = s^2: from the series of 2
     * artanh(s), arranged so that the leading term is exact; P minimax of degree 2, relative error
     * below 8.2e-10 */
    const float s = f / (2 + f);
    const float z = s * s;
    const float tail = z * (6.66667759e-01f + z * (3.99774939e-01f + z * 2.9873082e-01f));
    const float half_square = 0.5f * f * f;
    return (s * (half_square + tail) + n * 1.42860677e-06f) - half_square + f + n * 0.693145752f;
#endif
}

/* exp(x): relative error below 1.5e-7. Above 88.72 +infinity, from -86.5 (2.7e-38) down zero. About
 * 25 flop. The double build calls libm. */
SPT_SHAPE spt_real spt_exp(spt_real x) {
#ifdef SPT_SHAPES_DOUBLE
    return exp(x);
#else
    return spt_choose(x > -86.5f, spti_shape_exp(spt_limit(x, 89)), 0);
#endif
}

/* log(x), natural: error below 1 unit in the last place. -infinity for x <= 0. About 25 flop and a
 * division. The double build calls libm. */
SPT_SHAPE spt_real spt_log(spt_real x) {
#ifdef SPT_SHAPES_DOUBLE
    const double value = log(x > 0 ? x : 1);
#else
    const int denormal = x < FLT_MIN;
    const float value =
        spti_shape_log(x * spt_choose(denormal, 16777216.0f, 1), spt_choose(denormal, 24, 0));
#endif
    return spt_choose(x > 0, spt_choose(x <= SPT_REAL_MAX, value, x), -(spt_real)HUGE_VAL);
}

#endif
