/* SPDX-License-Identifier: MIT
 *
 * Sky, sun, haze and sea. None of it is measured: what looks right, in few lines. */
#include "models_air.h"

#include "models_noise.h"

#include <string.h>

static float dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void blend(float share, const float to[3], float colour[3]) {
    for (int c = 0; c < 3; ++c) colour[c] += share * (to[c] - colour[c]);
}

models_air models_air_of(const model *shown) {
    static const float day[3][3] = {
        {3.1f, 2.62f, 1.95f}, {0.56f, 0.72f, 1.0f}, {0.26f, 0.25f, 0.18f}};
    static const float sea[3][3] = {
        {3.7f, 3.1f, 2.5f}, {0.36f, 0.62f, 0.70f}, {0.09f, 0.15f, 0.18f}};
    const float(*light)[3] = shown->under_water ? sea : day;
    models_air air;
    double forward[3];
    memset(&air, 0, sizeof air);
    for (int axis = 0; axis < 3; ++axis) forward[axis] = shown->target[axis] - shown->eye[axis];
    const double flat = fmax(hypot(forward[0], forward[2]), 1e-6);
    air.under_water = shown->under_water;
    air.unit = (float)hypot(flat, forward[1]);
    air.haze = (float)shown->haze;
    air.surface = (float)(shown->eye[1] + 0.45 * shown->haze);
    /* From behind the eye's left shoulder, or nearly from above. */
    const double back = shown->under_water ? 0.50 : 0.45, left = shown->under_water ? 0.45 : 0.75;
    const double up = shown->under_water ? 0.95 : 0.72;
    const double x = (-back * forward[0] + left * forward[2]) / flat;
    const double z = (-back * forward[2] - left * forward[0]) / flat;
    const double length = sqrt(x * x + up * up + z * z);
    air.sun[0] = (float)(x / length);
    air.sun[1] = (float)(up / length);
    air.sun[2] = (float)(z / length);
    memcpy(air.sun_light, light[0], sizeof air.sun_light);
    memcpy(air.from_above, light[1], sizeof air.from_above);
    memcpy(air.from_below, light[2], sizeof air.from_below);
    return air;
}

/* ---- Behind everything --------------------------------------------------------------------- */

/* Thin clouds: noise on a plane high above, stretched by the wind. */
static float clouds(const float direction[3]) {
    if (!(direction[1] > 0.02f)) return 0.0f;
    const float away = 1.0f / (direction[1] + 0.12f);
    const float at[3] = {direction[0] * away * 0.8f, 0.3f, direction[2] * away * 1.9f};
    const float fine = 0.004f * away * away;
    const float cover = noise_octaves(at, 1.9f, 6, fine, NULL);
    return noise_step(0.02f, 0.75f, cover) * noise_step(0.02f, 0.25f, direction[1]);
}

static void clear_sky(const models_air *air, const float direction[3], float light[3]) {
    static const float horizon[3] = {0.76f, 0.98f, 1.26f}, zenith[3] = {0.06f, 0.24f, 0.66f};
    static const float glow[3] = {1.7f, 1.5f, 1.2f}, white[3] = {1.6f, 1.58f, 1.55f};
    const float height = direction[1] > 0.0f ? direction[1] : 0.0f;
    const float towards = noise_clamp(dot(direction, air->sun), 0.0f, 1.0f);
    memcpy(light, horizon, sizeof horizon);
    blend(1.0f - expf(-4.6f * height), zenith, light);
    blend(0.55f * clouds(direction), white, light);
    blend(0.45f * powf(towards, 12.0f), glow, light);
}

/* Light that breaks through the waves in shafts, all of which point to the sun. */
static float shafts(const models_air *air, const float direction[3]) {
    float across[3], other[3];
    path_frame(air->sun, across, other);
    const float x = dot(direction, across), y = dot(direction, other);
    const float away = fmaxf(sqrtf(x * x + y * y), 1e-4f);
    const float at[3] = {3.1f * x / away, 3.1f * y / away, 2.0f};
    const float beam = noise_octaves(at, 1.1f, 3, 0.02f / away, NULL);
    return noise_step(-0.1f, 0.9f, beam) * noise_step(-0.35f, 0.6f, direction[1]);
}

static void open_water(const models_air *air, const float direction[3], float light[3]) {
    static const float deep[3] = {0.006f, 0.050f, 0.11f}, level[3] = {0.025f, 0.22f, 0.36f};
    static const float high[3] = {0.42f, 1.05f, 1.10f};
    const float up = direction[1];
    const float towards = noise_clamp(0.5f + 0.5f * dot(direction, air->sun), 0.0f, 1.0f);
    memcpy(light, level, sizeof level);
    blend(noise_step(0.1f, -0.8f, up), deep, light);
    blend(0.85f * noise_step(-0.15f, 1.0f, up), high, light);
    blend(0.6f * towards * towards * towards * towards, high, light);
    blend(0.35f * shafts(air, direction), high, light);
}

void models_sky(const models_air *air, const float direction[3], float light[3]) {
    if (air->under_water) {
        open_water(air, direction, light);
    } else {
        clear_sky(air, direction, light);
    }
}

/* ---- On the way ---------------------------------------------------------------------------- */

void models_haze(const models_air *air, const float direction[3], float distance, float colour[3]) {
    const float far = distance / air->haze;
    float behind[3];
    if (air->under_water) {
        /* Water takes red first, and gives its own colour for it. */
        static const float taken[3] = {1.55f, 1.0f, 0.9f};
        open_water(air, direction, behind);
        for (int c = 0; c < 3; ++c) {
            colour[c] = behind[c] + expf(-taken[c] * far) * (colour[c] - behind[c]);
        }
        return;
    }
    /* The blue air before all that is far, and at the end the sky at the horizon itself. */
    static const float blue[3] = {0.56f, 0.78f, 1.08f};
    blend(0.42f * (1.0f - expf(-1.0f * far)), blue, colour);
    const float level[3] = {direction[0], 0.0f, direction[2]};
    clear_sky(air, level, behind);
    blend(1.0f - expf(-5.0f * far * far * far * far), behind, colour);
}

/* Waves focus the sun into a net: where two warped waves both pass zero it is bright. */
static float net_of_light(const models_air *air, const float point[3], float footprint) {
    const float side = 0.16f * air->unit, down = point[1] / air->sun[1];
    const float at[3] = {(point[0] - down * air->sun[0]) / side, 0.0f,
                         (point[2] - down * air->sun[2]) / side};
    float light = 0.0f;
    for (int layer = 0; layer < 2; ++layer) {
        const float seed = 7.7f + 9.1f * (float)layer;
        const float warp[3] = {at[0], seed, at[2]};
        const float shift = noise_octaves(warp, 2.6f, 2, footprint / side, NULL);
        const float from[3] = {at[0] + 0.5f * shift, seed + 3.0f, at[2] - 0.5f * shift};
        const float wave = noise_octaves(from, 1.7f, 1, footprint / side, NULL);
        light += expf(-9.0f * fabsf(wave));
    }
    return 0.55f + 0.9f * light * light;
}

void models_depth(const models_air *air, const float point[3], float footprint, float left[3],
                  float *pattern) {
    static const float taken[3] = {0.75f, 0.3f, 0.25f};
    left[0] = left[1] = left[2] = *pattern = 1.0f;
    if (!air->under_water) return;
    const float depth = noise_clamp((air->surface - point[1]) / air->haze, 0.0f, 10.0f);
    for (int c = 0; c < 3; ++c) left[c] = expf(-taken[c] * depth);
    *pattern = net_of_light(air, point, footprint);
}

/* The curve of film as Hable (2010) fitted it, white at 6 times middle grey or so. */
static float film(float x) {
    return (x * (0.22f * x + 0.03f) + 0.002f) / (x * (0.22f * x + 0.3f) + 0.06f) - 0.0333333f;
}

void models_develop(float colour[3]) {
    const float white = film(6.0f);
    const float grey = 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
    for (int c = 0; c < 3; ++c) {
        /* The curve takes some of the colour away. */
        const float vivid = fmaxf(grey + 1.18f * (colour[c] - grey), 0.0f);
        colour[c] = noise_clamp(film(1.42f * vivid) / white, 0.0f, 1.0f);
    }
}
