/* SPDX-License-Identifier: MIT
 *
 * A wave of paths: all that start in one tile, and are traced together, bounce by bounce. In steps,
 * so that tests can look between them:
 *     path_wave_begin(wave, area, sample);
 *     while (path_wave_step(wave)) ...
 * Left out: films and threads, see path_render.c. */
#ifndef EXAMPLES_PATH_WAVE_H
#define EXAMPLES_PATH_WAVE_H

#include "path_random.h"
#include "path_tracer.h"

enum { PATH_TILE = 64, PATH_WAVE = PATH_TILE * PATH_TILE };

/* What all threads share; none writes it. */
typedef struct path_job {
    path_world world;
    spt_scene scene;   /* the world's, but of these fields: */
    spt_field *fields; /* convex only where the settings leave the choice of the rule */
    path_settings settings;
    spt_settings primary;   /* of the rays of the eye, */
    spt_settings scattered; /* and of those that begin on a surface */
    uint32_t width, height;
} path_job;

/* Returns 0 where memory ran out. */
int path_job_create(path_job *job, const path_world *world, const path_settings *settings,
                    int width, int height);
void path_job_free(path_job *job);

/* A path that is under way. */
typedef struct path_state {
    spt_ray ray;
    float travelled;     /* by the path before this ray: rays.path */
    float throughput[3]; /* what light from here would bring to the eye */
    uint32_t pixel;      /* of the tile */
} path_state;

/* A ray from a surface to a light, and what it brings to the eye if nothing is between. */
typedef struct path_shadow {
    spt_ray ray;
    float travelled, light[3];
    uint32_t pixel;
} path_shadow;

/* What a thread needs for itself. */
typedef struct path_wave {
    const path_job *job;
    spt_status status; /* the first that was not SPT_OK */
    uint32_t area[4], sample, bounce;
    size_t count; /* paths under way */
    path_state paths[PATH_WAVE];
    spt_hit hits[PATH_WAVE]; /* of the paths: t, residual, outcome and component */
    float normal[PATH_WAVE][3], origin[PATH_WAVE][3], travelled[PATH_WAVE]; /* at the hits */
    int32_t start[PATH_WAVE], occluded[2 * PATH_WAVE];
    path_shadow shadows[2 * PATH_WAVE];
    size_t shadow_count;
    float light[PATH_WAVE][3]; /* of the pixels of the tile, row by row */
    path_statistics statistics;
    void *workspace;
    size_t workspace_size;
} path_wave;

/* From malloc(), or NULL. */
path_wave *path_wave_create(const path_job *job);
void path_wave_free(path_wave *wave);

/* Begins one path in each pixel of an area: left, top, right, bottom, at most a tile. */
void path_wave_begin(path_wave *wave, const uint32_t area[4], uint32_t sample);

/* Takes all paths one surface on. Returns 0 where none is left, or something was refused. */
int path_wave_step(path_wave *wave);

/* The parts of a step, in this order. */
void path_wave_trace(path_wave *wave);   /* to hits */
void path_wave_escape(path_wave *wave);  /* paths that hit nothing take up the sky, and end */
void path_wave_land(path_wave *wave);    /* hits to normals and origins */
void path_wave_shine(path_wave *wave);   /* what the surface itself brings, and leaves */
void path_wave_light(path_wave *wave);   /* lights that are seen from there (path_light.c) */
void path_wave_scatter(path_wave *wave); /* on in a new direction */

/* The random numbers of a path (path_random.h): a pair for each draw at each bounce. */
typedef enum path_draw {
    PATH_DRAW_PLACE, /* in the pixel, at bounce 0 */
    PATH_DRAW_DIRECTION,
    PATH_DRAW_PANEL,
    PATH_DRAW_SUN,
    PATH_DRAW_ROULETTE,
    path_draws
} path_draw;

/* The pair of a path of the picture's pixel (x, y). */
path_pair path_drawn(uint32_t seed, uint32_t x, uint32_t y, uint32_t bounce, path_draw draw,
                     uint32_t sample);

/* The same for a pixel of the wave, at its bounce. */
path_pair path_wave_drawn(const path_wave *wave, uint32_t pixel, path_draw draw);

/* Traces the shadow rays: fills wave->occluded. */
void path_wave_trace_shadows(path_wave *wave);

/* What was refused ends the wave. */
void path_wave_note(path_wave *wave, spt_status status);

static inline float path_dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void path_cross(const float a[3], const float b[3], float product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* What a component is made of. */
static inline const path_material *path_material_of(const path_job *job, int32_t component) {
    const int32_t material = spt_scene_material(&job->scene, component);
    return &job->world.materials[material > 0 ? material : 0];
}

#endif
