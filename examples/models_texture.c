/* SPDX-License-Identifier: MIT
 *
 * The textures themselves. Each fades where it becomes finer than a pixel, or pictures would
 * flicker from frame to frame. */
#include "models_texture.h"

#include "models_noise.h"

#include <string.h>

static void set(float colour[3], float red, float green, float blue) {
    colour[0] = red;
    colour[1] = green;
    colour[2] = blue;
}

static void blend(float share, float red, float green, float blue, float colour[3]) {
    colour[0] += share * (red - colour[0]);
    colour[1] += share * (green - colour[1]);
    colour[2] += share * (blue - colour[2]);
}

static void scale(float factor, float colour[3]) {
    for (int c = 0; c < 3; ++c) colour[c] *= factor;
}

/* A number in [0, 1) of an instance or a branch, for each of several purposes. */
static float chance(uint32_t identity, uint32_t purpose) {
    return (float)(path_hash(identity + 0x9e3779b9u * purpose) >> 8) * 0x1p-24f;
}

/* How much of a wave is shown where a pixel is so wide: all up to a quarter, none from half on. */
static float shown_of(float wide, float wavelength) {
    return noise_clamp(2.0f - 4.0f * wide / wavelength, 0.0f, 1.0f);
}

/* ---- Plants -------------------------------------------------------------------------------- */

/* Ridges along the branch that break across it, from u and v: the circle of v keeps the seam
 * closed. */
static void bark(const texture_place *at, texture_look *look) {
    const float angle = 0x1.921fb6p+2f * at->v;
    const float seed = 40.0f * chance(at->identity, 1), x = cosf(angle), y = sinf(angle);
    const float ridge_at[3] = {2.2f * x, 2.2f * y, 1.6f * at->u + seed};
    const float crack_at[3] = {3.0f * x, 3.0f * y, 5.0f * at->u + seed};
    /* Twigs are finer than their textures long before they vanish. */
    const float fine = fmaxf(3.0f * 0x1.921fb6p+2f * at->v_wide, 5.0f * at->u_wide);
    const float ridge = noise_octaves(ridge_at, 0.9f, 4, fine, NULL);
    const float crack = noise_octaves(crack_at, 1.1f, 3, fine, NULL);
    const float grain =
        noise_octaves(at->kernel_point, 0.03f * at->unit, 6, at->footprint, look->relief);
    const float height = 0.5f + 0.5f * ridge + 0.14f * crack + 0.3f * grain;
    set(look->albedo, 0.095f, 0.068f, 0.050f);
    blend(noise_clamp(height, 0.0f, 1.0f), 0.36f, 0.285f, 0.21f, look->albedo);
    /* Lichen on what looks to the north and up. */
    const float damp = noise_octaves(at->world, 0.2f * at->unit, 3, at->footprint, NULL);
    blend(0.5f * noise_step(0.1f, 0.6f, damp), 0.22f, 0.25f, 0.14f, look->albedo);
    for (int axis = 0; axis < 3; ++axis) look->relief[axis] *= 0.006f * at->unit;
    look->in_kernel = 1;
}

/* A midrib along u and veins that leave it forward; v is from edge to edge. */
static void leaf(const texture_place *at, texture_look *look) {
    const float side = fabsf(2.0f * at->v - 1.0f), turn = 9.0f * at->u - 3.5f * side;
    const float wave = fabsf(turn - floorf(turn) - 0.5f);
    const float rib = shown_of(at->v_wide, 0.1f) * (1.0f - noise_step(0.03f, 0.10f, side));
    const float vein = shown_of(at->u_wide, 0.2f) * (1.0f - noise_step(0.02f, 0.12f, wave)) *
                       noise_step(1.0f, 0.5f, side);
    /* Leaves of a pixel or less look like their mean. */
    const float single = shown_of(at->u_wide, 1.6f);
    const float age = 0.4f + single * (chance(at->identity, 2) - 0.4f);
    const float shade = 0.5f + single * (chance(at->identity, 3) - 0.5f);
    set(look->albedo, 0.065f, 0.165f, 0.028f);
    blend(0.6f * age * age + 0.2f * chance(at->branch, 8), 0.20f, 0.28f, 0.045f, look->albedo);
    blend(0.5f * noise_step(0.93f, 1.0f, shade), 0.42f, 0.26f, 0.05f, look->albedo);
    scale(0.80f + 0.4f * shade, look->albedo);
    blend(0.55f * rib + 0.3f * vein, 0.30f, 0.40f, 0.12f, look->albedo);
    look->gloss = 0.35f;
    look->through = 0.55f;
}

static void grass(const texture_place *at, texture_look *look) {
    float fine[3];
    const float patch = noise_octaves(at->world, 0.9f * at->unit, 4, at->footprint, NULL);
    const float blades =
        noise_octaves(at->world, 0.035f * at->unit, 7, at->footprint, look->relief);
    const float dry = noise_octaves(at->world, 0.25f * at->unit, 4, at->footprint, fine);
    set(look->albedo, 0.076f, 0.120f, 0.035f);
    blend(noise_step(-0.35f, 0.5f, patch), 0.135f, 0.165f, 0.055f, look->albedo);
    blend(0.75f * noise_step(0.05f, 0.6f, dry), 0.25f, 0.205f, 0.095f, look->albedo);
    scale(1.0f + 0.6f * blades, look->albedo);
    for (int axis = 0; axis < 3; ++axis) look->relief[axis] *= 0.004f * at->unit;
}

/* ---- Stone --------------------------------------------------------------------------------- */

/* A layer of noise over the three planes of a point, blended by its normal. */
static float triplanar(const float point[3], const float normal[3], float wavelength, int octaves,
                       float footprint, float slope[3]) {
    float weights[3], sum = 0.0f;
    spt_triplanar(normal, 2, weights);
    set(slope, 0.0f, 0.0f, 0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const int across = (axis + 1) % 3, along = (axis + 2) % 3;
        const float at[3] = {point[across], point[along], 31.0f * wavelength * (float)axis};
        float part[3];
        if (!(weights[axis] > 1e-3f)) continue;
        sum += weights[axis] * noise_octaves(at, wavelength, octaves, footprint, part);
        slope[across] += weights[axis] * part[0];
        slope[along] += weights[axis] * part[1];
    }
    return sum;
}

static void rock(const texture_place *at, texture_look *look) {
    float coarse[3], fine[3];
    const float large =
        triplanar(at->world, at->normal, 0.35f * at->unit, 5, at->footprint, coarse);
    const float small = triplanar(at->world, at->normal, 0.045f * at->unit, 5, at->footprint, fine);
    /* Strata: layers that the large noise has bent. */
    const float layer = at->world[1] / (0.07f * at->unit) + 1.4f * large;
    const float shown = noise_clamp(2.0f - 60.0f * at->footprint / at->unit, 0.0f, 1.0f);
    const float strata = shown * cosf(layer) * (0.6f + 0.4f * cosf(2.7f * layer + 1.0f));
    set(look->albedo, 0.185f, 0.17f, 0.16f);
    blend(noise_step(-0.3f, 0.5f, large), 0.30f, 0.265f, 0.225f, look->albedo);
    scale(1.0f + 0.16f * strata + 0.38f * small, look->albedo);
    /* Moss where rain stays. */
    const float moss = noise_step(0.45f, 0.85f, at->normal[1] + 0.35f * large + 0.3f * small);
    blend(0.5f * moss, 0.085f, 0.11f, 0.042f, look->albedo);
    for (int axis = 0; axis < 3; ++axis) {
        look->relief[axis] = at->unit * (0.008f * coarse[axis] + 0.0035f * fine[axis]);
    }
    look->gloss = 0.08f;
}

/* Ripples across the wind, over fine grain. */
static void sand(const texture_place *at, texture_look *look) {
    float bend[3];
    const float grain = noise_octaves(at->world, 0.012f * at->unit, 3, at->footprint, look->relief);
    const float warp = noise_octaves(at->world, 0.5f * at->unit, 3, at->footprint, bend);
    const float period = 0.055f * at->unit, rate = 0x1.921fb6p+2f / period;
    const float turn = rate * (0.86f * at->world[0] + 0.5f * at->world[2]) + 5.0f * warp;
    const float shown = noise_clamp(2.0f - 4.0f * at->footprint / period, 0.0f, 1.0f) *
                        noise_step(0.5f, 0.9f, at->normal[1]);
    const float rise = shown * 0.022f * cosf(turn); /* of waves 0.022 / rate high */
    set(look->albedo, 0.42f, 0.345f, 0.235f);
    scale(1.0f + 0.15f * grain + 0.12f * warp + 0.10f * shown * sinf(turn), look->albedo);
    for (int axis = 0; axis < 3; ++axis) {
        look->relief[axis] =
            0.0012f * at->unit * look->relief[axis] + rise * 5.0f * bend[axis] * period;
    }
    look->relief[0] += 8.0f * rise * 0.86f;
    look->relief[2] += 8.0f * rise * 0.5f;
}

/* ---- The sea ------------------------------------------------------------------------------- */

/* Polyps: small light dots in the kernel's space, on a colour of the branch. */
static void coral(const texture_place *at, texture_look *look) {
    const float pixel = at->footprint / at->scale;
    const float dots =
        triplanar(at->kernel_point, at->kernel_normal, 0.02f * at->unit, 2, pixel, look->relief);
    const float hue = noise_octaves(at->world, 0.6f * at->unit, 3, at->footprint, NULL);
    set(look->albedo, 0.76f, 0.16f, 0.12f);
    blend(noise_step(-0.3f, 0.4f, hue), 0.80f, 0.27f, 0.08f, look->albedo);
    blend(0.6f * chance(at->branch, 4), 0.62f, 0.12f, 0.30f, look->albedo);
    blend(0.4f * noise_step(0.15f, 0.45f, dots), 0.85f, 0.58f, 0.42f, look->albedo);
    for (int axis = 0; axis < 3; ++axis) look->relief[axis] *= 0.004f * at->unit;
    look->in_kernel = 1;
    look->gloss = 0.15f;
}

/* Pores: dark pits in the kernel's space. */
static void sponge(const texture_place *at, texture_look *look) {
    const float pixel = at->footprint / at->scale;
    const float pores =
        triplanar(at->kernel_point, at->kernel_normal, 0.035f * at->unit, 3, pixel, look->relief);
    const float hue = noise_octaves(at->world, 0.5f * at->unit, 3, at->footprint, NULL);
    set(look->albedo, 0.66f, 0.46f, 0.14f);
    blend(noise_step(-0.3f, 0.5f, hue), 0.68f, 0.36f, 0.13f, look->albedo);
    scale(0.80f + 0.4f * chance(at->identity, 5), look->albedo);
    blend(0.6f * noise_step(0.1f, -0.5f, pores), 0.20f, 0.11f, 0.04f, look->albedo);
    for (int axis = 0; axis < 3; ++axis) look->relief[axis] *= 0.004f * at->unit;
    look->in_kernel = 1;
}

/* A dark back and a light belly, as the sea shows them, a golden band along the flanks and on the
 * tail, and scales: fish swim along their kernel's x, their flanks look along its z. */
static void fish(const texture_place *at, texture_look *look) {
    const float pixel = at->footprint / at->scale, length = 0.05f * at->unit;
    const float flank = fabsf(at->kernel_normal[1]) + 0.5f * fabsf(at->kernel_normal[0]);
    const float grain = noise_octaves(at->kernel_point, 0.05f * length, 2, pixel, look->relief);
    const float spots = noise_octaves(at->kernel_point, 0.4f * length, 2, pixel, NULL);
    set(look->albedo, 0.34f, 0.50f, 0.66f);
    blend(noise_step(-0.2f, 0.75f, at->normal[1]), 0.05f, 0.13f, 0.30f, look->albedo);
    blend(noise_step(-0.15f, -0.8f, at->normal[1]), 0.85f, 0.86f, 0.82f, look->albedo);
    blend(0.9f * noise_step(0.42f, 0.12f, flank + 0.12f * spots), 0.95f, 0.62f, 0.08f,
          look->albedo);
    scale(0.85f + 0.3f * chance(at->identity, 7) + 0.12f * grain, look->albedo);
    for (int axis = 0; axis < 3; ++axis) look->relief[axis] *= 0.001f * length;
    look->in_kernel = 1;
    look->gloss = 1.0f;
}

void models_texture(const texture_place *at, texture_look *look) {
    static void (*const of[model_materials])(const texture_place *, texture_look *) = {
        [MODEL_BARK] = bark, [MODEL_LEAF] = leaf,   [MODEL_GRASS] = grass,   [MODEL_SAND] = sand,
        [MODEL_ROCK] = rock, [MODEL_CORAL] = coral, [MODEL_SPONGE] = sponge, [MODEL_FISH] = fish,
    };
    memset(look, 0, sizeof *look);
    of[at->material](at, look);
    for (int c = 0; c < 3; ++c) {
        look->albedo[c] = noise_clamp(look->albedo[c] * at->tint[c], 0.0f, 1.0f);
    }
}
