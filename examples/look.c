/* SPDX-License-Identifier: MIT
 *
 * The table of looks, and the colours of object, ground and sky. */
#include "look.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* clang-format off */
static const look looks[] = {
    {"primitives", {0.40f, 0.30f, 0.26f}, {0.27f, 0.20f, 0.20f}, {1.1f, 0.4f, 0.9f}, 0.7f,
     {0}, {0}, 0.0f, 1, 0.0f},
    {"village", {0.42f, 0.27f, 0.19f}, {0.13f, 0.08f, 0.06f}, {0.5f, 0.0f, 0.4f}, 0.1f,
     {0}, {0}, 0.0f, 1, 0.0f},
    {"mandelbulb", {0.64f, 0.46f, 0.30f}, {0.16f, 0.14f, 0.12f}, {0.4f, 1.6f, 0.3f}, 0.3f,
     {2.6f, 1.7f, 3.9f}, {0.0f, -0.1f, 0.0f}, 48.0f, 0, 0.0f},
    {"dodecahedron", {0.10f, 0.26f, 0.38f}, {0.04f, 0.08f, 0.08f}, {0.4f, 0.8f, 0.3f}, 1.0f,
     {2.1f, 2.3f, 5.2f}, {0.0f, -0.1f, 0.0f}, 45.0f, 0, 0.0f},
    {"dodecahedron_p32", {0.46f, 0.11f, 0.08f}, {0.06f, 0.03f, 0.03f}, {0.4f, 0.8f, 0.3f}, 1.0f,
     {2.1f, 2.3f, 5.2f}, {0.0f, -0.1f, 0.0f}, 45.0f, 0, 0.0f},
    {"twisted", {0.50f, 0.30f, 0.24f}, {0.18f, 0.12f, 0.12f}, {0.0f, 0.9f, 0.0f}, 0.6f,
     {3.6f, 1.9f, 9.4f}, {0.0f, -0.2f, 0.0f}, 46.0f, 0, 0.0f},
    {"bent", {0.42f, 0.25f, 0.13f}, {0.06f, 0.04f, 0.03f}, {0.5f, 0.0f, 0.3f}, 0.5f,
     {2.9f, 1.7f, 6.6f}, {0.1f, -0.55f, 0.0f}, 46.0f, 0, 0.0f},
    {"blended", {0.34f, 0.34f, 0.34f}, {0.18f, 0.12f, 0.16f}, {0.0f, 1.3f, 0.0f}, 0.8f,
     {0.7f, 2.9f, 7.0f}, {0.2f, 0.85f, 0.0f}, 50.0f, 1, -1.0f},
    {"repeated", {0.40f, 0.30f, 0.26f}, {0.22f, 0.18f, 0.18f}, {0.45f, 0.3f, 0.35f}, 0.7f,
     {0}, {0}, 0.0f, 1, 0.0f},
    {"arches", {0.55f, 0.42f, 0.28f}, {0.06f, 0.06f, 0.06f}, {0.3f, 0.8f, 0.6f}, 0.3f,
     {3.4f, 2.3f, 7.8f}, {0.0f, 1.25f, -1.0f}, 50.0f, 1, 0.0f},
    {"smooth_union", {0.12f, 0.36f, 0.30f}, {0.05f, 0.10f, 0.10f}, {0.9f, 0.6f, 0.3f}, 0.9f,
     {1.6f, 1.7f, 4.6f}, {0.0f, 0.1f, 0.0f}, 42.0f, 0, 0.0f},
    {"bumpy_ball", {0.50f, 0.36f, 0.10f}, {0.05f, 0.05f, 0.05f}, {0.4f, 0.8f, 0.3f}, 0.9f,
     {1.1f, 1.5f, 5.0f}, {0.0f, -0.1f, 0.0f}, 40.0f, 0, 0.0f},
    {"plane", {0.4f, 0.4f, 0.4f}, {0}, {0}, 0.0f, {0}, {0}, 0.0f, 1, 0.0f},
    {"village_boxes", {0.44f, 0.40f, 0.36f}, {0.10f, 0.10f, 0.12f}, {0.5f, 0.2f, 0.4f}, 0.3f,
     {0}, {0}, 0.0f, 1, 0.0f},
    {"jewel", {0.07f, 0.20f, 0.36f}, {0.03f, 0.06f, 0.06f}, {0.9f, 0.8f, 0.6f}, 1.0f,
     {0}, {0}, 0.0f, 0, 0.0f},
    {"city", {0.42f, 0.38f, 0.35f}, {0.12f, 0.10f, 0.09f}, {0.7f, 0.2f, 0.5f}, 0.2f,
     {0}, {0}, 0.0f, 1, 0.0f},
    {"textured", {0.42f, 0.25f, 0.13f}, {0.06f, 0.04f, 0.03f}, {0.5f, 0.0f, 0.3f}, 0.5f,
     {0}, {0}, 0.0f, 0, 0.0f},
    {"silhouette", {0.34f, 0.36f, 0.40f}, {0.10f, 0.10f, 0.06f}, {0.8f, 0.9f, 0.4f}, 0.6f,
     {0}, {0}, 0.0f, 1, -2.6f},
};

static const look neutral = {
    "", {0.44f, 0.36f, 0.32f}, {0.16f, 0.14f, 0.14f}, {0.6f, 0.9f, 0.5f}, 0.6f,
    {0}, {0}, 0.0f, 0, 0.0f};
/* clang-format on */

const look *look_of(const char *scene) {
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; ++i) {
        if (strcmp(looks[i].scene, scene) == 0) return &looks[i];
    }
    return &neutral;
}

void look_albedo(const look *chosen, const float point[3], float albedo[3]) {
    static const float phase[3] = {0.0f, 1.9f, 3.6f};
    const float turn =
        chosen->turns[0] * point[0] + chosen->turns[1] * point[1] + chosen->turns[2] * point[2];
    for (int c = 0; c < 3; ++c) {
        albedo[c] = chosen->base[c] + chosen->swing[c] * cosf(turn + phase[c]);
    }
}

/* The integral of a square wave of period 2 and values -1 (first half) and 1: a triangle wave. */
static float triangle(float x) {
    const float place = x * 0.5f - floorf(x * 0.5f);
    return fabsf(place * 2.0f - 1.0f) - 1.0f;
}

/* The square wave averaged over [x - width/2, x + width/2]. */
static float filtered_wave(float x, float width) {
    return (triangle(x + 0.5f * width) - triangle(x - 0.5f * width)) / width;
}

void look_ground_albedo(float x, float z, float side, float footprint, float albedo[3]) {
    static const float light[3] = {0.36f, 0.36f, 0.35f}, dark[3] = {0.23f, 0.24f, 0.26f};
    const float width = footprint / side > 1e-3f ? footprint / side : 1e-3f;
    const float wave = filtered_wave(x / side, width) * filtered_wave(z / side, width);
    for (int c = 0; c < 3; ++c) {
        albedo[c] = 0.5f * (light[c] + dark[c]) + 0.5f * wave * (light[c] - dark[c]);
    }
}

void look_sky(const float direction[3], float light[3]) {
    static const float horizon[3] = {0.70f, 0.80f, 0.92f}, zenith[3] = {0.12f, 0.27f, 0.60f};
    const float height = direction[1] > 0.0f ? direction[1] : 0.0f;
    const float weight = 1.0f - expf(-4.5f * height);
    for (int c = 0; c < 3; ++c) light[c] = horizon[c] + weight * (zenith[c] - horizon[c]);
}
