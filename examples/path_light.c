/* SPDX-License-Identifier: MIT
 *
 * Next-event lighting: from every surface that a path meets one ray to a point of the panel and one
 * to a point of the sun's disc. The sky is left to the paths themselves. */
#include "path_wave.h"

#include <math.h>
#include <string.h>

static const float one_over_pi = 0x1.45f306p-2f;

/* Adds the ray of a path to a light: t is 1 at the light, or there is no end. each: what a radiance
 * of 1 there would bring. */
static void add_shadow(path_wave *wave, size_t i, const float direction[3], float t_max,
                       const float light[3], float each) {
    const path_state *path = &wave->paths[i];
    path_shadow *shadow = &wave->shadows[wave->shadow_count++];
    memcpy(shadow->ray.origin, wave->origin[i], sizeof shadow->ray.origin);
    memcpy(shadow->ray.direction, direction, sizeof shadow->ray.direction);
    shadow->ray.t_min = 0.0f;
    shadow->ray.t_max = t_max;
    shadow->travelled = wave->travelled[i];
    shadow->pixel = path->pixel;
    for (int c = 0; c < 3; ++c) shadow->light[c] = path->throughput[c] * light[c] * each;
}

static void look_for_panel(path_wave *wave, size_t i) {
    const path_panel *panel = wave->job->world.panel;
    const spt_settings *settings = &wave->job->scattered;
    const path_pair drawn = path_wave_drawn(wave, wave->paths[i].pixel, PATH_DRAW_PANEL);
    float front[3], to[3];
    path_cross(panel->along, panel->across, front); /* as long as the panel is large */
    for (int c = 0; c < 3; ++c) {
        to[c] = panel->corner[c] + drawn.first * panel->along[c] + drawn.second * panel->across[c] -
                wave->origin[i][c];
    }
    const float square = path_dot(to, to), cosine = path_dot(to, wave->normal[i]);
    const float faced = -path_dot(to, front); /* times length and area */
    if (!(cosine > 0.0f && faced > 0.0f)) return;
    /* The panel itself stops the ray where it comes within the tolerance; it ends before that. */
    const float length = sqrtf(square), cone = settings->pixel_radius;
    const float tolerance = fmaxf(settings->epsilon, cone * (wave->travelled[i] + length));
    const float slope = faced / (length * sqrtf(path_dot(front, front)));
    add_shadow(wave, i, to, 1.0f - 2.0f * tolerance / (slope * length), panel->radiance,
               one_over_pi * cosine * faced / (square * square));
}

static void look_for_sun(path_wave *wave, size_t i) {
    const path_sun *sun = wave->job->world.sun;
    const path_pair drawn = path_wave_drawn(wave, wave->paths[i].pixel, PATH_DRAW_SUN);
    float to[3];
    path_direction(sun->direction, drawn.first * sun->sine * sun->sine, drawn.second, to);
    const float cosine = path_dot(to, wave->normal[i]);
    if (cosine > 0.0f) {
        add_shadow(wave, i, to, wave->paths[i].ray.t_max, sun->irradiance, one_over_pi * cosine);
    }
}

void path_wave_light(path_wave *wave) {
    const path_world *world = &wave->job->world;
    wave->shadow_count = 0;
    for (size_t i = 0; i < wave->count; ++i) {
        const float *throughput = wave->paths[i].throughput;
        if (!(throughput[0] + throughput[1] + throughput[2] > 0.0f)) continue;
        if (world->panel != NULL) look_for_panel(wave, i);
        if (world->sun != NULL) look_for_sun(wave, i);
    }
    if (wave->shadow_count == 0) return;
    path_wave_trace_shadows(wave);
    for (size_t i = 0; wave->status == SPT_OK && i < wave->shadow_count; ++i) {
        const path_shadow *shadow = &wave->shadows[i];
        if (wave->occluded[i]) continue;
        for (int c = 0; c < 3; ++c) wave->light[shadow->pixel][c] += shadow->light[c];
    }
}
