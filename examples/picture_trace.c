/* SPDX-License-Identifier: MIT
 *
 * Traces the pieces of a picture, each by the thread that comes first. Shading is in shade.c. */
#include "picture.h"

#include "shade.h"
#include "workers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { tile_rays = SPT_TILE * SPT_TILE, chunk_side = 16 };

/* What the threads share. The frame is finer than the picture by the samples a side, so that a
 * piece is whole tiles of it. */
typedef struct tracing {
    film *exposed;
    scene_parts parts;
    spt_camera camera;
    spt_frame frame;
    shading shader;
    int samples, failed;
} tracing;

/* What a thread needs for itself. */
typedef struct desk {
    float x[tile_rays], y[tile_rays], t_max[tile_rays];
    spt_camera_ray rays[tile_rays];
    spt_hit hits[tile_rays];
    shade_scratch scratch;
    void *workspace;
    size_t workspace_size;
} desk;

/* ---- One tile ------------------------------------------------------------------------------ */

/* Of one chunk in a tile: where its rays are in the tile, and in the piece. */
typedef struct chunk {
    size_t count;
    size_t rays[SPT_BATCH], pixels[SPT_BATCH];
    int part[SPT_BATCH]; /* of the sun */
} chunk;

/* Which part of the sun a sample sees: in a pixel every part once, and neighbours in a row or a
 * column see parts far apart. */
static int sun_part_of(int samples, int x, int y) {
    return (x % samples + 2 * (y % samples)) % samples * samples + (x + y) % samples;
}

/* A chunk is a compact block of rays, which look at much the same things. */
static void fill_chunk(const tracing *all, const spt_frame *tile, const int area[4],
                       uint32_t chunk_left, uint32_t chunk_top, chunk *filled) {
    const int samples = all->samples;
    filled->count = 0;
    for (uint32_t y = chunk_top; y < chunk_top + chunk_side && y < tile->bottom; ++y) {
        for (uint32_t x = chunk_left; x < chunk_left + chunk_side && x < tile->right; ++x) {
            const size_t k = filled->count++;
            const int column = (int)x / samples - area[0], row = (int)y / samples - area[1];
            filled->rays[k] =
                (size_t)(y - tile->top) * (tile->right - tile->left) + (x - tile->left);
            filled->pixels[k] = (size_t)row * (size_t)(area[2] - area[0]) + (size_t)column;
            filled->part[k] = sun_part_of(samples, (int)x, (int)y);
        }
    }
}

/* Adds what the rays of a chunk see to their pixels. */
static void add_colours(const tracing *all, desk *mine, const chunk *of, float *values) {
    const float weight = 1.0f / (float)(all->samples * all->samples);
    spt_ray rays[SPT_BATCH];
    spt_hit hits[SPT_BATCH];
    float colours[SPT_BATCH][3];
    for (size_t k = 0; k < of->count; ++k) {
        rays[k] = mine->rays[of->rays[k]].ray;
        hits[k] = mine->hits[of->rays[k]];
    }
    shade_rays(&all->shader, &mine->scratch, of->count, rays, hits, of->part, colours);
    for (size_t k = 0; k < of->count; ++k) {
        for (size_t c = 0; c < 3; ++c) values[3 * of->pixels[k] + c] += weight * colours[k][c];
    }
}

static void add_normals(const tracing *all, desk *mine, const chunk *of, float *values) {
    const float weight = 1.0f / (float)(all->samples * all->samples);
    float points[SPT_BATCH][3], half_pixel[SPT_BATCH], normals[SPT_BATCH][3];
    size_t pixels[SPT_BATCH], count = 0;
    for (size_t k = 0; k < of->count; ++k) {
        const spt_ray *ray = &mine->rays[of->rays[k]].ray;
        const spt_hit *hit = &mine->hits[of->rays[k]];
        if (hit->outcome != SPT_HIT) continue;
        for (int axis = 0; axis < 3; ++axis) {
            points[count][axis] = ray->origin[axis] + hit->t * ray->direction[axis];
        }
        half_pixel[count] = all->shader.pixel_radius * hit->t;
        pixels[count++] = of->pixels[k];
    }
    if (count == 0) return;
    shade_normals(&all->shader, &mine->scratch, count, (const float(*)[3])points, half_pixel,
                  normals);
    for (size_t k = 0; k < count; ++k) {
        for (size_t axis = 0; axis < 3; ++axis) {
            values[4 * pixels[k] + axis] += weight * normals[k][axis];
        }
        values[4 * pixels[k] + 3] += weight;
    }
}

static float number_of(picture_kind kind, const spt_hit *hit, uint64_t kept) {
    switch (kind) {
    case PICTURE_HEAT:
        return (float)hit->evaluations;
    case PICTURE_FALLBACK: {
        /* Each step is one evaluation, or two where the probe before it was rejected; the first
         * evaluation is at the start. */
        const float steps = (float)hit->evaluations - 1.0f - (float)hit->fallbacks;
        if (hit->fallbacks == 0) return 0.0f;
        return steps > (float)hit->fallbacks ? (float)hit->fallbacks / steps : 1.0f;
    }
    case PICTURE_DEPTH:
        return hit->outcome == SPT_HIT ? hit->t : (float)INFINITY;
    case PICTURE_KEPT:
        return (float)kept;
    default:
        return (float)hit->outcome;
    }
}

/* The rays of a tile, and where each is to end. */
static spt_status aim(const tracing *all, spt_frame *tile, desk *mine) {
    const uint32_t width = tile->right - tile->left;
    const size_t count = (size_t)width * (tile->bottom - tile->top);
    for (size_t i = 0; i < count; ++i) {
        mine->x[i] = (float)(tile->left + i % width) + 0.5f;
        mine->y[i] = (float)(tile->top + i / width) + 0.5f;
    }
    const spt_status status = spt_camera_rays(&all->camera, tile->width, tile->height, count,
                                              mine->x, mine->y, mine->rays);
    if (status == SPT_OK && all->exposed->job.kind == PICTURE_SHADED) {
        for (size_t i = 0; i < count; ++i) {
            mine->t_max[i] = shade_ground_at(&all->shader, &mine->rays[i].ray);
        }
        tile->t_max.first = mine->t_max;
        tile->t_max.stride = sizeof mine->t_max[0];
    }
    return status;
}

/* Traces one tile of the frame, or what a piece needs of it. */
static spt_status trace_tile(const tracing *all, spt_frame *tile, const int area[4], desk *mine,
                             float *values) {
    const picture_kind kind = all->exposed->job.kind;
    const uint64_t kept_before = tile->statistics->kept;
    const spt_hits sinks = spt_hits_of(mine->hits);
    spt_status status = aim(all, tile, mine);
    if (status == SPT_OK) status = spt_frame_tile(tile, 0, &sinks);
    if (status != SPT_OK) return status;
    if (!picture_is_averaged(kind)) {
        const size_t count =
            (size_t)(tile->right - tile->left) * (size_t)(tile->bottom - tile->top);
        const uint64_t kept = tile->statistics->kept - kept_before;
        for (size_t i = 0; i < count; ++i) values[i] = number_of(kind, &mine->hits[i], kept);
        return SPT_OK;
    }
    for (uint32_t y = tile->top; y < tile->bottom; y += chunk_side) {
        for (uint32_t x = tile->left; x < tile->right; x += chunk_side) {
            chunk filled;
            fill_chunk(all, tile, area, x, y, &filled);
            if (kind == PICTURE_SHADED) {
                add_colours(all, mine, &filled, values);
            } else {
                add_normals(all, mine, &filled, values);
            }
        }
    }
    return SPT_OK;
}

/* ---- One piece, one thread ----------------------------------------------------------------- */

static uint32_t tile_end(uint32_t at, uint32_t end) {
    const uint32_t next = (at / SPT_TILE + 1) * SPT_TILE;
    return next < end ? next : end;
}

static spt_status trace_piece(const tracing *all, size_t piece, desk *mine,
                              spt_statistics *statistics) {
    const picture_job *job = &all->exposed->job;
    const uint32_t samples = (uint32_t)all->samples;
    int area[4];
    const picture_panel *panel = &job->panels[picture_piece_area(job, piece, area)];
    spt_status status = SPT_OK;
    spt_frame tile = all->frame;
    tile.settings.method = panel->method;
    tile.flags = panel->flags;
    tile.workspace = mine->workspace;
    tile.workspace_size = mine->workspace_size;
    tile.statistics = statistics;
    const uint32_t right = (uint32_t)area[2] * samples, bottom = (uint32_t)area[3] * samples;
    for (uint32_t y = (uint32_t)area[1] * samples; y < bottom; y = tile.bottom) {
        tile.top = y;
        tile.bottom = tile_end(y, bottom);
        for (uint32_t x = (uint32_t)area[0] * samples; x < right; x = tile.right) {
            tile.left = x;
            tile.right = tile_end(x, right);
            if (status == SPT_OK) {
                status = trace_tile(all, &tile, area, mine, film_piece(all->exposed, piece));
            }
        }
    }
    return status;
}

static void add_statistics(spt_statistics *sum, const spt_statistics *more) {
    sum->rays += more->rays;
    for (int i = 0; i < SPT_OUTCOMES; ++i) sum->outcomes[i] += more->outcomes[i];
    sum->evaluations += more->evaluations;
    sum->slots += more->slots;
    sum->passes += more->passes;
    sum->fallbacks += more->fallbacks;
    if (more->largest_slope > sum->largest_slope) sum->largest_slope = more->largest_slope;
    if (more->lanes != 0) sum->lanes = more->lanes;
    sum->cone_evaluations += more->cone_evaluations;
    sum->kept += more->kept;
    sum->culled += more->culled;
}

static void fail(tracing *all, workers *crew, const char *message) {
    workers_lock(crew);
    if (!all->failed) fprintf(stderr, "%s\n", message);
    all->failed = 1;
    workers_unlock(crew);
    workers_stop(crew);
}

static void run_thread(void *user, workers *crew) {
    tracing *all = user;
    desk *mine = malloc(sizeof *mine);
    const size_t workspace_size = spt_frame_workspace(&all->frame);
    void *workspace = malloc(workspace_size);
    size_t piece;
    if (mine == NULL || workspace == NULL || !shade_scratch_create(&mine->scratch, &all->shader)) {
        fail(all, crew, "out of memory");
        free(workspace);
        free(mine);
        return;
    }
    mine->workspace = workspace;
    mine->workspace_size = workspace_size;
    while (workers_take(crew, &piece)) {
        int area[4];
        spt_statistics statistics = spt_statistics_default();
        const spt_status status = trace_piece(all, piece, mine, &statistics);
        if (status != SPT_OK) {
            fail(all, crew, spt_status_name(status));
            break;
        }
        const int panel = picture_piece_area(&all->exposed->job, piece, area);
        workers_lock(crew);
        add_statistics(&all->exposed->statistics[panel], &statistics);
        all->exposed->done[piece - all->exposed->first] = 1;
        workers_unlock(crew);
        workers_finish(crew);
    }
    shade_scratch_free(&mine->scratch);
    free(workspace);
    free(mine);
}

/* ---- The film ------------------------------------------------------------------------------ */

/* The scene, seen as its look asks for. */
static scene framed(const scene *shown) {
    scene result = *shown;
    const look *chosen = look_of(shown->name);
    if (chosen->field_of_view > 0.0f) {
        result.field_of_view = (double)chosen->field_of_view;
        for (int axis = 0; axis < 3; ++axis) {
            result.eye[axis] = (double)chosen->eye[axis];
            result.target[axis] = (double)chosen->target[axis];
        }
    }
    return result;
}

/* Returns 0 after a message. */
static int prepare(film *exposed, tracing *all) {
    const picture_job *job = &exposed->job;
    const scene shown = framed(job->shown);
    const scene_grain grain = job->whole ? SCENE_WHOLE : SCENE_OBJECTS;
    all->exposed = exposed;
    all->failed = 0;
    all->samples = picture_is_averaged(job->kind) ? job->samples : 1;
    const uint32_t width = (uint32_t)(job->width * all->samples);
    const uint32_t height = (uint32_t)(job->height * all->samples);
    scene_parts_of(&shown, grain, shade_lanes(job->max_lanes), &all->parts);
    all->camera = scene_camera(&shown, width, height);
    const spt_status status =
        spt_frame_init(&all->frame, &all->parts.scene, &all->camera, width, height);
    if (status != SPT_OK) {
        fprintf(stderr, "the library refused: %s\n", spt_status_name(status));
        return 0;
    }
    const float pixel_radius = all->frame.settings.pixel_radius;
    all->frame.settings.budget = job->budget;
    all->frame.settings.epsilon = job->epsilon;
    all->frame.settings.max_lanes = job->max_lanes;
    if (!job->pixel_cone) all->frame.settings.pixel_radius = 0.0f;
    if (!shading_create(&all->shader, &shown, grain, job->epsilon, pixel_radius, all->samples,
                        job->max_lanes)) {
        fprintf(stderr, "out of memory\n");
        return 0;
    }
    all->shader.shadows = job->shadows;
    return 1;
}

long film_expose(film *exposed, int threads, const char *label) {
    long missing = -1;
    tracing *all = malloc(sizeof *all);
    if (all == NULL) fprintf(stderr, "out of memory\n");
    if (all != NULL && prepare(exposed, all)) {
        const size_t finished =
            workers_run(threads, exposed->first, exposed->end, run_thread, all, label);
        if (!all->failed) missing = (long)(exposed->end - exposed->first - finished);
    }
    free(all);
    return missing;
}
