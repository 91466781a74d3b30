/* SPDX-License-Identifier: MIT
 *
 * Light and colours of the worlds of glass: sun, sky, ground and matt balls. */
#include "glass_world.h"
#include "look.h"
#include "shade_light.h"

#include <math.h>

static const float sunlight[3] = {2.60f, 2.30f, 1.90f};
static const float above[3] = {0.36f, 0.45f, 0.60f}, below[3] = {0.20f, 0.18f, 0.16f};

/* The ground's light seen from far above: its mean albedo in sun and sky. */
static const float mean_albedo[3] = {0.295f, 0.300f, 0.305f};

void glass_environment(const glass_world *world, const float direction[3], float light[3]) {
    for (int c = 0; c < 3; ++c) light[c] = 1.0f;
    if (world->furnace) return;
    look_sky(direction, light);
    for (int c = 0; c < 3; ++c) light[c] *= world->sky;
    if (direction[1] < 0.0f && world->has_ground) {
        /* Little by little: no edge at the horizon. */
        const float weight = 1.0f - expf(6.0f * direction[1]);
        for (int c = 0; c < 3; ++c) {
            const float around = world->sky * above[c];
            const float ground = mean_albedo[c] * (sunlight[c] * light_sun_direction[1] + around);
            light[c] += weight * (ground - light[c]);
        }
        return;
    }
    for (const glass_lamp *lamp = world->lamps; lamp < world->lamps + world->lamp_count; ++lamp) {
        const float cosine = light_dot(direction, lamp->direction);
        const float spot = expf(lamp->sharpness * (cosine - 1.0f));
        for (int c = 0; c < 3; ++c) light[c] += spot * lamp->light[c];
    }
}

/* How much of the sky over a point the balls leave free, weighted by the cosine: a ball at distance
 * d whose centre is in the direction w takes (n.w) (r / d)^2. */
static float openness(const glass_world *world, const glass_point *at) {
    float open = 1.0f;
    for (int i = 0; i < world->ball_count; ++i) {
        const glass_ball *const ball = &world->balls[i];
        float to_center[3], square = 0.0f;
        if (i == at->object || ball->material.surface == GLASS_CLEAR) continue;
        for (int axis = 0; axis < 3; ++axis) {
            to_center[axis] = ball->center[axis] - at->position[axis];
            square += to_center[axis] * to_center[axis];
        }
        const float cosine = light_dot(to_center, at->normal) / sqrtf(square);
        open *= 1.0f -
                spt_least(spt_greatest(cosine, 0.0f) * ball->radius * ball->radius / square, 1.0f);
    }
    return open;
}

void glass_shade(const glass_world *world, const glass_point *at, float by_sun[3], float rest[3]) {
    const float cosine = spt_greatest(light_dot(at->normal, light_sun_direction), 0.0f);
    const float open = openness(world, at);
    float albedo[3];
    if (at->object == GLASS_GROUND) {
        look_ground_albedo(at->position[0], at->position[2], world->square, at->footprint, albedo);
    } else {
        for (int c = 0; c < 3; ++c) albedo[c] = world->balls[at->object].material.colour[c];
    }
    for (int c = 0; c < 3; ++c) {
        const float around = below[c] + (0.5f + 0.5f * at->normal[1]) * (above[c] - below[c]);
        const float sky = world->sky * around;
        by_sun[c] = albedo[c] * cosine * sunlight[c];
        rest[c] = albedo[c] * sky * open;
    }
    if (at->object != GLASS_GROUND) return;
    /* Far ground melts into the sky at the horizon, so that its edge is never seen. */
    const float far = at->way / world->haze, clear = expf(-far * far * far * far);
    float sky[3];
    look_sky((const float[3]){at->view[0], 0.0f, at->view[2]}, sky);
    for (int c = 0; c < 3; ++c) {
        by_sun[c] *= clear;
        rest[c] = world->sky * sky[c] + clear * (rest[c] - world->sky * sky[c]);
    }
}
