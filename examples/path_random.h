/* SPDX-License-Identifier: MIT
 *
 * The numbers that paths draw: functions of pixel, dimension and sample alone, so that a picture is
 * the same for any number of threads and any division of its samples. And what is made of them. */
#ifndef EXAMPLES_PATH_RANDOM_H
#define EXAMPLES_PATH_RANDOM_H

#include <spheretrace/shapes_math.h>

/* Two numbers, each in [0, 1). */
typedef struct path_pair {
    float first, second;
} path_pair;

/* A hash of 32 bits without visible bias (Wellons 2018, lowbias32). */
static inline uint32_t path_hash(uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

static inline uint32_t path_reversed_bits(uint32_t x) {
    x = x >> 16 | x << 16;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

/* Owen's scrambling of a number whose first bit is the highest: the permutation of Laine and Karras
 * (2011) with the constants of Burley (2020, Practical Hash-Based Owen Scrambling). */
static inline uint32_t path_scrambled(uint32_t x, uint32_t seed) {
    x = path_reversed_bits(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return path_reversed_bits(x);
}

/* Sample number `sample` of a pair of dimensions of a pixel: the first two coordinates of Sobol's
 * sequence, in an order and with digits scrambled by a hash of pixel and dimension. The first 2^k
 * samples are even in the square, pairs of different dimensions or pixels know nothing of one
 * another, and each single sample is as good as random, which is what makes means unbiased. */
static inline path_pair path_random(uint32_t pixel, uint32_t dimension, uint32_t sample) {
    const uint32_t seed = path_hash(pixel ^ path_hash(dimension + 0x9e3779b9u));
    const uint32_t index = path_scrambled(sample, seed);
    uint32_t second = 0, direction = 0x80000000u;
    for (uint32_t bits = index; bits != 0; bits >>= 1) {
        if (bits & 1) second ^= direction;
        direction ^= direction >> 1;
    }
    const uint32_t first = path_scrambled(path_reversed_bits(index), path_hash(seed + 1));
    second = path_scrambled(second, path_hash(seed + 2));
    const path_pair pair = {(float)(first >> 8) * 0x1p-24f, (float)(second >> 8) * 0x1p-24f};
    return pair;
}

/* Two unit vectors that make a right-handed frame with a unit vector (Duff et al. 2017, Building an
 * Orthonormal Basis, Revisited). Theirs turns over where z changes its sign, which is in the middle
 * of every upright wall; any other height well above -1 will do. */
static inline void path_frame(const float normal[3], float tangent[3], float bitangent[3]) {
    const float sign = normal[2] < -0.6f ? -1.0f : 1.0f, a = -1.0f / (sign + normal[2]);
    const float b = normal[0] * normal[1] * a;
    tangent[0] = 1.0f + sign * normal[0] * normal[0] * a;
    tangent[1] = sign * b;
    tangent[2] = -sign * normal[0];
    bitangent[0] = b;
    bitangent[1] = sign + normal[1] * normal[1] * a;
    bitangent[2] = -normal[1];
}

/* A direction whose sine to the axis is the root of square (0 to 1), turned by turn (0 to 1, a whole
 * turn). An even square makes it likely by its cosine: Lambert's law (Nusselt's disc). */
static inline void path_direction(const float axis[3], float square, float turn,
                                  float direction[3]) {
    float tangent[3], bitangent[3];
    const float angle = 0x1.921fb6p+2f * turn, sine = sqrtf(square);
    const float x = sine * spt_cos(angle), y = sine * spt_sin(angle), z = sqrtf(1.0f - square);
    path_frame(axis, tangent, bitangent);
    for (int c = 0; c < 3; ++c) {
        direction[c] = x * tangent[c] + y * bitangent[c] + z * axis[c];
    }
}

#endif
