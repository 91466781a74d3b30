/* SPDX-License-Identifier: MIT
 *
 * The frame of a picture: camera, tiles with cones and culling, and what each thread does. */
#include "models_render.h"

#include "models_shade.h"
#include "workers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { chunk_side = 16 };

/* What the threads share. The frame is finer than the picture by the samples a side. */
typedef struct rendering {
    const models_view *view;
    image *picture;
    spt_camera camera;
    spt_frame frame;
    models_stage stage;
    models_count count;
    int failed;
} rendering;

/* What a thread needs for itself. */
typedef struct easel {
    spt_hit *hits; /* of a piece */
    void *workspace;
    models_desk desk;
    models_count count;
} easel;

models_view models_view_of(const model *shown, const model_world *world) {
    models_view view;
    memset(&view, 0, sizeof view);
    view.shown = shown;
    view.world = world;
    memcpy(view.eye, shown->eye, sizeof view.eye);
    memcpy(view.target, shown->target, sizeof view.target);
    view.width = 960;
    view.height = 540;
    view.samples = view.threads = 1;
    view.sun = shown->under_water ? 0.09f : 0.03f;
    return view;
}

static double half_angle(const models_view *view) {
    return view->shown->field_of_view * 3.14159265358979 / 360.0;
}

int models_look_at(const spt_bound *bound, double share, models_view *view) {
    float low[3], high[3];
    double square = 0.0, away = 0.0;
    if (spt_bound_extent(bound, low, high) != SPT_OK) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = (double)high[axis] - (double)low[axis];
        const double back = view->eye[axis] - view->target[axis];
        square += side * side / 12.0; /* half the mean side */
        away += back * back;
    }
    const double distance = share * sqrt(square) / tan(half_angle(view));
    for (int axis = 0; axis < 3; ++axis) {
        const double direction = (view->eye[axis] - view->target[axis]) / sqrt(away);
        view->target[axis] = 0.5 * ((double)low[axis] + (double)high[axis]);
        view->eye[axis] = view->target[axis] + distance * direction;
    }
    return square < (double)INFINITY;
}

spt_status models_camera(const models_view *view, uint32_t width, uint32_t height,
                         spt_camera *camera) {
    static const float up[3] = {0.0f, 1.0f, 0.0f};
    float eye[3], target[3];
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)view->eye[axis];
        target[axis] = (float)view->target[axis];
    }
    const spt_status status =
        spt_camera_pinhole(camera, eye, target, up, (float)tan(half_angle(view)), width, height);
    if (status == SPT_OK) camera->t_max = (float)view->shown->t_max;
    return status;
}

/* ---- Pieces -------------------------------------------------------------------------------- */

/* Of one chunk in a piece: its samples in the frame, and where they are in the picture. */
static size_t gather(const rendering *all, const spt_frame *piece, const spt_hit *hits,
                     uint32_t left, uint32_t top, spt_hit *chunk, spt_ray *rays, size_t *pixels) {
    const uint32_t samples = (uint32_t)all->view->samples;
    float x[SPT_BATCH] = {0.0f}, y[SPT_BATCH] = {0.0f};
    spt_camera_ray camera_rays[SPT_BATCH];
    size_t count = 0;
    for (uint32_t row = top; row < top + chunk_side && row < piece->bottom; ++row) {
        for (uint32_t column = left; column < left + chunk_side && column < piece->right;
             ++column) {
            const size_t across = piece->right - piece->left;
            chunk[count] = hits[(row - piece->top) * across + (column - piece->left)];
            pixels[count] =
                (size_t)(row / samples) * (size_t)all->picture->width + column / samples;
            x[count] = (float)column + 0.5f;
            y[count++] = (float)row + 0.5f;
        }
    }
    spt_camera_rays(&all->camera, piece->width, piece->height, count, x, y, camera_rays);
    for (size_t k = 0; k < count; ++k) rays[k] = camera_rays[k].ray;
    return count;
}

static spt_status shade_chunk(const rendering *all, const spt_frame *piece, uint32_t left,
                              uint32_t top, easel *mine) {
    const float weight = 1.0f / (float)(all->view->samples * all->view->samples);
    spt_hit hits[SPT_BATCH];
    spt_ray rays[SPT_BATCH];
    float colours[SPT_BATCH][3];
    size_t pixels[SPT_BATCH];
    const size_t count = gather(all, piece, mine->hits, left, top, hits, rays, pixels);
    const spt_status status = models_shade(&all->stage, &mine->desk, count, rays, hits, colours);
    if (status != SPT_OK) return status;
    for (size_t k = 0; k < count; ++k) {
        mine->count.steep += (hits[k].flags & SPT_FLAG_STEEP) != 0;
        for (size_t c = 0; c < 3; ++c) {
            all->picture->pixels[3 * pixels[k] + c] += weight * colours[k][c];
        }
    }
    return SPT_OK;
}

/* A piece is a square of SPT_TILE pixels of the picture: whole tiles of the frame. */
static spt_status render_piece(const rendering *all, size_t index, easel *mine) {
    const uint32_t side = SPT_TILE * (uint32_t)all->view->samples;
    const uint32_t across = (all->frame.width + side - 1) / side;
    const spt_hits sinks = spt_hits_of(mine->hits);
    spt_frame piece = all->frame;
    piece.left = (uint32_t)(index % across) * side;
    piece.top = (uint32_t)(index / across) * side;
    piece.right = piece.left + side < piece.width ? piece.left + side : piece.width;
    piece.bottom = piece.top + side < piece.height ? piece.top + side : piece.height;
    piece.workspace = mine->workspace;
    piece.workspace_size = spt_frame_workspace(&all->frame);
    piece.statistics = &mine->count.statistics;
    spt_status status = spt_frame_trace(&piece, 0, spt_frame_tiles(&piece), &sinks, NULL);
    for (uint32_t y = piece.top; y < piece.bottom; y += chunk_side) {
        for (uint32_t x = piece.left; status == SPT_OK && x < piece.right; x += chunk_side) {
            status = shade_chunk(all, &piece, x, y, mine);
        }
    }
    return status;
}

/* ---- Threads ------------------------------------------------------------------------------- */

static void add_count(models_count *sum, const models_count *more) {
    sum->steep += more->steep;
    sum->statistics.rays += more->statistics.rays;
    for (int i = 0; i < SPT_OUTCOMES; ++i) {
        sum->statistics.outcomes[i] += more->statistics.outcomes[i];
    }
    sum->statistics.evaluations += more->statistics.evaluations;
    sum->statistics.cone_evaluations += more->statistics.cone_evaluations;
    sum->statistics.largest_slope =
        fmaxf(sum->statistics.largest_slope, more->statistics.largest_slope);
}

static void fail(rendering *all, workers *crew, const char *message) {
    workers_lock(crew);
    if (!all->failed) fprintf(stderr, "%s: %s\n", all->view->shown->name, message);
    all->failed = 1;
    workers_unlock(crew);
    workers_stop(crew);
}

static void run_thread(void *user, workers *crew) {
    rendering *all = user;
    const size_t side = SPT_TILE * (size_t)all->view->samples;
    easel *mine = malloc(sizeof *mine);
    spt_hit *hits = malloc(side * side * sizeof *hits);
    void *workspace = malloc(spt_frame_workspace(&all->frame));
    size_t piece;
    if (mine == NULL || hits == NULL || workspace == NULL ||
        !models_desk_create(&mine->desk, &all->stage)) {
        fail(all, crew, "out of memory");
    } else {
        mine->hits = hits;
        mine->workspace = workspace;
        mine->count.steep = 0;
        mine->count.statistics = spt_statistics_default();
        while (workers_take(crew, &piece)) {
            const spt_status status = render_piece(all, piece, mine);
            if (status != SPT_OK) {
                fail(all, crew, spt_status_name(status));
                break;
            }
            workers_finish(crew);
        }
        workers_lock(crew);
        add_count(&all->count, &mine->count);
        workers_unlock(crew);
        models_desk_free(&mine->desk);
    }
    free(workspace);
    free(hits);
    free(mine);
}

int models_render(const models_view *view, const char *label, image *picture, models_count *count) {
    const uint32_t width = (uint32_t)(view->width * view->samples);
    const uint32_t height = (uint32_t)(view->height * view->samples);
    const size_t across = ((size_t)view->width + SPT_TILE - 1) / SPT_TILE;
    const size_t pieces = across * (((size_t)view->height + SPT_TILE - 1) / SPT_TILE);
    rendering *all = calloc(1, sizeof *all);
    if (all == NULL) return 0;
    all->view = view;
    all->picture = picture;
    all->count.statistics = spt_statistics_default();
    spt_status status = models_camera(view, width, height, &all->camera);
    if (status == SPT_OK) {
        status = spt_frame_init(&all->frame, &view->world->scene, &all->camera, width, height);
    }
    int done = status == SPT_OK;
    if (done) {
        /* Longer steps pass over what they only graze, here and there, and silhouettes flicker from
         * frame to frame: with spt_adaptive() that is a quarter of all that changes. */
        all->frame.settings.method = spt_relaxed();
        all->frame.settings.budget = 512;
        all->frame.settings.epsilon = 1e-5f * (float)view->shown->t_max;
        models_stage_set(&all->stage, view->shown, view->world, &all->frame.settings, view->sun);
        memset(picture->pixels, 0, 3 * (size_t)view->width * (size_t)view->height * sizeof(float));
        done =
            workers_run(view->threads, 0, pieces, run_thread, all, label) == pieces && !all->failed;
    } else {
        fprintf(stderr, "%s: %s\n", view->shown->name, spt_status_name(status));
    }
    if (count != NULL) *count = all->count;
    free(all);
    return done;
}
