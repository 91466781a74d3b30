/* SPDX-License-Identifier: MIT
 *
 * Value noise for the textures of models.c: the same everywhere, with its slope, and without the
 * detail that a pixel could not show. */
#ifndef EXAMPLES_MODELS_NOISE_H
#define EXAMPLES_MODELS_NOISE_H

#include "path_random.h"

static inline float noise_clamp(float value, float low, float high) {
    return value > low ? (value < high ? value : high) : low; /* NaN becomes low */
}

/* 0 up to low, 1 from high on, smooth between. */
static inline float noise_step(float low, float high, float value) {
    const float x = noise_clamp((value - low) / (high - low), 0.0f, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

/* The number of a point of the lattice, in [-1, 1). */
static inline float noise_lattice(int32_t x, int32_t y, int32_t z) {
    const uint32_t mixed =
        (uint32_t)x * 0x8da6b343u ^ (uint32_t)y * 0xd8163841u ^ (uint32_t)z * 0xcb1ab31fu;
    return (float)(path_hash(mixed) >> 8) * 0x1p-23f - 1.0f;
}

/* Noise in [-1, 1) of wavelength about 2, and what to add to slope (may be NULL) for it: `weight`
 * times its gradient. Blends of the fifth degree (Perlin 2002), so that the slope has no edges. */
static inline float noise_wave(const float p[3], float weight, float slope[3]) {
    float part[3], blend[3], rise[3], corner[8];
    int32_t cell[3];
    for (int axis = 0; axis < 3; ++axis) {
        /* Beyond that a float has no part behind the point. */
        const float at = noise_clamp(p[axis], -4e6f, 4e6f), low = floorf(at), x = at - low;
        cell[axis] = (int32_t)low;
        part[axis] = x;
        blend[axis] = x * x * x * (x * (x * 6.0f - 15.0f) + 10.0f);
        rise[axis] = 30.0f * x * x * (part[axis] - 1.0f) * (part[axis] - 1.0f);
    }
    for (int i = 0; i < 8; ++i) {
        corner[i] = noise_lattice(cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2));
    }
    const float x0 = corner[0] + blend[0] * (corner[1] - corner[0]);
    const float x1 = corner[2] + blend[0] * (corner[3] - corner[2]);
    const float x2 = corner[4] + blend[0] * (corner[5] - corner[4]);
    const float x3 = corner[6] + blend[0] * (corner[7] - corner[6]);
    const float y0 = x0 + blend[1] * (x1 - x0), y1 = x2 + blend[1] * (x3 - x2);
    if (slope != NULL) {
        const float along0 = corner[1] - corner[0], along1 = corner[3] - corner[2];
        const float along2 = corner[5] - corner[4], along3 = corner[7] - corner[6];
        const float low = along0 + blend[1] * (along1 - along0);
        const float high = along2 + blend[1] * (along3 - along2);
        slope[0] += weight * rise[0] * (low + blend[2] * (high - low));
        slope[1] += weight * rise[1] * ((x1 - x0) + blend[2] * ((x3 - x2) - (x1 - x0)));
        slope[2] += weight * rise[2] * (y1 - y0);
    }
    return y0 + blend[2] * (y1 - y0);
}

/* A sum of octaves, each half as high and twice as fine as the one before, the first of that
 * wavelength: about in [-1, 1].
 *   footprint  what a pixel sees, in the units of p: octaves that are finer fade out
 *   slope      its gradient, or NULL */
static inline float noise_octaves(const float p[3], float wavelength, int octaves, float footprint,
                                  float slope[3]) {
    float sum = 0.0f, height = 0.55f, frequency = 2.0f / wavelength;
    if (slope != NULL) slope[0] = slope[1] = slope[2] = 0.0f;
    for (int i = 0; i < octaves; ++i) {
        /* Waves of less than two pixels cannot be shown; those of four are shown in full. */
        const float shown = noise_clamp(2.0f - 2.0f * footprint * frequency, 0.0f, 1.0f);
        const float offset = 17.3f * (float)i; /* no two octaves share a corner of the lattice */
        const float at[3] = {p[0] * frequency + offset, p[1] * frequency - offset,
                             p[2] * frequency + 0.5f * offset};
        if (!(shown > 0.0f)) break;
        sum += shown * height * noise_wave(at, shown * height * frequency, slope);
        height *= 0.5f;
        frequency *= 2.0f;
    }
    return sum;
}

#endif
