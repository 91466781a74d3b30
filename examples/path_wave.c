/* SPDX-License-Identifier: MIT
 *
 * The steps of a wave: rays of the eye, what sky and surfaces bring, and new directions. What is
 * asked of the library between them is in path_trace.c. */
#include "path_wave.h"

#include <stdlib.h>
#include <string.h>

/* ---- Memory -------------------------------------------------------------------------------- */

path_wave *path_wave_create(const path_job *job) {
    path_wave *wave = malloc(sizeof *wave);
    if (wave == NULL) return NULL;
    wave->job = job;
    wave->status = SPT_OK;
    wave->count = 0;
    wave->statistics = path_statistics_default();
    wave->workspace_size = spt_scene_workspace(&job->scene, &job->scattered);
    wave->workspace = malloc(wave->workspace_size);
    if (wave->workspace == NULL) {
        free(wave);
        return NULL;
    }
    return wave;
}

void path_wave_free(path_wave *wave) {
    if (wave != NULL) free(wave->workspace);
    free(wave);
}

void path_wave_note(path_wave *wave, spt_status status) {
    if (status == SPT_OK) return;
    wave->status = status;
    wave->count = 0;
}

/* ---- Random numbers ------------------------------------------------------------------------ */

path_pair path_drawn(uint32_t seed, uint32_t x, uint32_t y, uint32_t bounce, path_draw draw,
                     uint32_t sample) {
    const uint32_t dimension = bounce * path_draws + (uint32_t)draw;
    return path_random((y << 16 | x) ^ path_hash(seed), dimension, sample);
}

path_pair path_wave_drawn(const path_wave *wave, uint32_t pixel, path_draw draw) {
    const uint32_t across = wave->area[2] - wave->area[0];
    return path_drawn(wave->job->settings.seed, wave->area[0] + pixel % across,
                      wave->area[1] + pixel / across, wave->bounce, draw, wave->sample);
}

/* ---- The parts of a step ------------------------------------------------------------------- */

/* The paths of a row of the area. */
static void begin_row(path_wave *wave, uint32_t row) {
    const path_job *job = wave->job;
    const uint32_t across = wave->area[2] - wave->area[0];
    float x[PATH_TILE] = {0}, y[PATH_TILE] = {0};
    spt_camera_ray rays[PATH_TILE];
    for (uint32_t i = 0; i < across; ++i) {
        const path_pair place = path_wave_drawn(wave, row * across + i, PATH_DRAW_PLACE);
        x[i] = (float)(wave->area[0] + i) + place.first;
        y[i] = (float)(wave->area[1] + row) + place.second;
    }
    const spt_status status =
        spt_camera_rays(&job->world.camera, job->width, job->height, across, x, y, rays);
    for (uint32_t i = 0; status == SPT_OK && i < across; ++i) {
        path_state *path = &wave->paths[wave->count];
        path->ray = rays[i].ray;
        path->travelled = rays[i].path;
        path->pixel = (uint32_t)wave->count++;
        for (int c = 0; c < 3; ++c) path->throughput[c] = 1.0f;
    }
    path_wave_note(wave, status);
}

void path_wave_begin(path_wave *wave, const uint32_t area[4], uint32_t sample) {
    memcpy(wave->area, area, sizeof wave->area);
    memset(wave->light, 0, sizeof wave->light);
    wave->sample = sample;
    wave->bounce = 0;
    wave->count = 0;
    for (uint32_t row = 0; row < area[3] - area[1]; ++row) begin_row(wave, row);
}

void path_wave_escape(path_wave *wave) {
    const path_world *world = &wave->job->world;
    size_t left = 0;
    for (size_t i = 0; i < wave->count; ++i) {
        const path_state *path = &wave->paths[i];
        if (wave->hits[i].outcome == SPT_HIT) {
            wave->hits[left] = wave->hits[i];
            wave->paths[left++] = *path;
        } else if (wave->hits[i].outcome == SPT_MISS && world->sky != NULL) {
            float *light = wave->light[path->pixel], sky[3];
            world->sky(world->sky_user, path->ray.direction, sky);
            for (int c = 0; c < 3; ++c) light[c] += path->throughput[c] * sky[c];
        } /* what came to no end is lost; the statistics tell how often */
    }
    wave->count = left;
}

/* Whether a path takes up the light of the panel here: where paths look for it, only the eye does,
 * so that no light counts twice. */
static int shows_panel(const path_wave *wave, size_t i) {
    const path_panel *panel = wave->job->world.panel;
    float front[3];
    if (panel == NULL || wave->bounce != 0 || wave->hits[i].component != panel->component) return 0;
    path_cross(panel->along, panel->across, front);
    return path_dot(front, wave->normal[i]) > 0.9f * sqrtf(path_dot(front, front));
}

void path_wave_shine(path_wave *wave) {
    for (size_t i = 0; i < wave->count; ++i) {
        const path_material *material = path_material_of(wave->job, wave->hits[i].component);
        const int panel = shows_panel(wave, i);
        path_state *path = &wave->paths[i];
        float *light = wave->light[path->pixel];
        for (int c = 0; c < 3; ++c) {
            const float more = panel ? wave->job->world.panel->radiance[c] : 0.0f;
            light[c] += path->throughput[c] * (material->emission[c] + more);
            path->throughput[c] *= material->albedo[c];
        }
        if (wave->bounce < wave->job->settings.bounces) ++wave->statistics.starts[wave->start[i]];
    }
    if (wave->bounce == wave->job->settings.bounces) wave->count = 0;
}

/* The chance that a path goes on. */
static float chance_to_go_on(const path_wave *wave, const path_state *path) {
    float most = path->throughput[0];
    if (most < path->throughput[1]) most = path->throughput[1];
    if (most < path->throughput[2]) most = path->throughput[2];
    return wave->bounce < wave->job->settings.roulette && most > 0.0f ? 1.0f : most;
}

void path_wave_scatter(path_wave *wave) {
    size_t left = 0;
    for (size_t i = 0; i < wave->count; ++i) {
        path_state path = wave->paths[i];
        const float chance = chance_to_go_on(wave, &path);
        if (chance < 1.0f) {
            const path_pair lot = path_wave_drawn(wave, path.pixel, PATH_DRAW_ROULETTE);
            if (!(lot.first < chance)) continue;
            for (int c = 0; c < 3; ++c) path.throughput[c] /= chance;
        }
        const path_pair drawn = path_wave_drawn(wave, path.pixel, PATH_DRAW_DIRECTION);
        memcpy(path.ray.origin, wave->origin[i], sizeof path.ray.origin);
        path_direction(wave->normal[i], drawn.first, drawn.second, path.ray.direction);
        path.ray.t_min = 0.0f;
        path.travelled = wave->travelled[i];
        wave->paths[left++] = path;
    }
    wave->count = left;
    ++wave->bounce;
}

int path_wave_step(path_wave *wave) {
    if (wave->count == 0) return 0;
    path_wave_trace(wave);
    path_wave_escape(wave);
    path_wave_land(wave);
    path_wave_shine(wave);
    path_wave_light(wave);
    path_wave_scatter(wave);
    return wave->count > 0 && wave->status == SPT_OK;
}
