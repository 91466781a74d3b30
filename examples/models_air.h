/* SPDX-License-Identifier: MIT
 *
 * Where the models of nature stand: under a clear sky or in the sea. The light that comes from
 * there, what becomes of it on its way to the eye, and how a picture is developed. */
#ifndef EXAMPLES_MODELS_AIR_H
#define EXAMPLES_MODELS_AIR_H

#include "scenes/models.h"

/* Light is linear; lengths in world units. */
typedef struct models_air {
    int under_water;
    float unit;          /* from the eye to what it looks at: the measure of all textures */
    float sun[3];        /* unit length, towards the sun */
    float sun_light[3];  /* what falls on a surface that faces it */
    float from_above[3]; /* what the sky sends to a surface that looks up, */
    float from_below[3]; /* and what comes back from the ground */
    float haze;          /* where all has melted into it */
    float surface;       /* of the water: its height */
} models_air;

/* The air of a model; it stays the same where the eye goes. */
models_air models_air_of(const model *shown);

/* What is seen in a unit direction where nothing is. */
void models_sky(const models_air *air, const float direction[3], float light[3]);

/* What is left of a colour that is so far away in a unit direction. */
void models_haze(const models_air *air, const float direction[3], float distance, float colour[3]);

/* What is left of the light from above at a point: 1, but for the sea. pattern: the net of light
 * that waves throw there, about 1 on average; footprint as for noise_octaves(). */
void models_depth(const models_air *air, const float point[3], float footprint, float left[3],
                  float *pattern);

/* From light to what a picture shows, 0 to 1. */
void models_develop(float colour[3]);

#endif
