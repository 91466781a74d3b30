/* SPDX-License-Identifier: MIT
 *
 * A path tracer of diffuse surfaces: what it renders, how, and onto what. Rays go to the library in
 * waves, all paths of a tile at a time. Left out: mirrors, glass, textures. */
#ifndef EXAMPLES_PATH_TRACER_H
#define EXAMPLES_PATH_TRACER_H

#include <spheretrace/spheretrace.h>

/* ---- What is rendered ---------------------------------------------------------------------- */

typedef struct path_material {
    float albedo[3]; /* 0 to 1: the share of the light that is scattered, by Lambert's law */
    float emission[3];
} path_material;

/* A parallelogram that shines to one side, that of along x across: the face of a component, which
 * shines nowhere else. Paths look for it from every point that they meet. */
typedef struct path_panel {
    float corner[3], along[3], across[3];
    float radiance[3];
    int32_t component;
} path_panel;

/* A far disc, which paths look for likewise; the eye does not see it. */
typedef struct path_sun {
    float direction[3];  /* towards it, unit length */
    float sine;          /* of its angular radius */
    float irradiance[3]; /* on a plane that faces it */
} path_sun;

/* The light that comes from a unit direction in which nothing is. */
typedef void path_sky_fn(void *user, const float direction[3], float radiance[3]);

typedef struct path_world {
    const spt_scene *scene; /* its materials count those below; without, all is of the first */
    const path_material *materials; /* one for each number in scene->materials */
    const path_panel *panel;        /* or NULL */
    const path_sun *sun;            /* or NULL */
    path_sky_fn *sky;               /* or NULL: it is dark */
    void *sky_user;
    spt_camera camera; /* a pinhole, outside of all bodies */
} path_world;

/* ---- How ----------------------------------------------------------------------------------- */

typedef struct path_settings {
    const spt_method *method; /* for all components; NULL: the default, and spt_convex() for those
                               * that allow it */
    uint32_t bounces;         /* a path meets one surface more. Default 10 */
    uint32_t roulette;        /* from this bounce on, a path of which little is left ends by chance,
                               * and if it goes on stands for those that ended. Default 4; more than
                               * bounces: never */
    float epsilon;            /* default 1e-4 */
    int pixel_cone;           /* end rays at half a pixel; default 1 */
    uint32_t budget;          /* evaluations a ray. Default 4096: a ray that leaves a plane at the
                               * angle a takes basic steps of about 1 / a */
    uint32_t max_lanes;       /* default 0: as wide as the machine is */
    uint32_t seed;            /* another one: other noise. Default 0 */
    int threads;              /* 1 to 1024. Default 1 */
} path_settings;

path_settings path_settings_default(void);

typedef enum path_ray { PATH_PRIMARY, PATH_SECONDARY, PATH_SHADOW, path_rays } path_ray;

/* What it took. Calls add to it. */
typedef struct path_statistics {
    spt_statistics traced[path_rays]; /* by kind of ray */
    double seconds[path_rays];        /* of processor time, of all threads, inside the library's
                                       * tracing calls */
    double all_seconds;               /* of the whole program while paths were traced */
    uint64_t starts[3];               /* secondary origins by spt_start */
} path_statistics;

path_statistics path_statistics_default(void);

/* A line for each kind of ray, on standard output. */
void path_statistics_print(const path_statistics *all);

/* Linear light of each pixel, row by row from the top: three floats. The same bits for any number of
 * threads. Returns how many tiles an interrupt (workers.h) left black, or -1 after a message on
 * standard error, where memory ran out or the library refused. statistics may be NULL. */
long path_render(const path_world *world, const path_settings *settings, int width, int height,
                 uint32_t samples, float *pixels, path_statistics *statistics);

/* ---- Onto what, to go on later ------------------------------------------------------------- */

/* Samples so far. Each tile has its own number of them, so that a picture can be had at any time. */
typedef struct path_film {
    int width, height;
    double *sums;      /* three a pixel; NULL where memory ran out */
    uint32_t *samples; /* by tile */
} path_film;

path_film path_film_create(int width, int height);
void path_film_free(path_film *film);

/* Adds so many samples to every pixel; the bits do not depend on how samples are divided into calls.
 * label names the progress bar. Returns how many tiles an interrupt has kept from it, or -1. */
long path_expose(path_film *film, const path_world *world, const path_settings *settings,
                 uint32_t samples, const char *label, path_statistics *statistics);

/* The mean of the samples, pixels as for path_render(). */
void path_film_print(const path_film *film, float *pixels);

#endif
