/* SPDX-License-Identifier: MIT
 *
 * What a picture is made of: its pieces, and the film that holds some of them. Tracing is in
 * picture_trace.c, the layout in picture_print.c. */
#include "picture.h"

#include <stdlib.h>
#include <string.h>

const char *const picture_kind_names[picture_kinds] = {"shaded", "normal",  "heat", "fallback",
                                                       "depth",  "outcome", "kept"};

enum { tile_pixels = SPT_TILE * SPT_TILE };

picture_job picture_job_default(const scene *shown) {
    const spt_settings settings = spt_settings_default();
    picture_job job;
    memset(&job, 0, sizeof job);
    job.shown = shown;
    job.panels[0].method = settings.method;
    job.panel_count = 1;
    picture_set_size(&job, 640, 360);
    job.samples = 2;
    job.budget = settings.budget;
    job.epsilon = settings.epsilon;
    job.pixel_cone = 1;
    job.shadows = 1;
    return job;
}

void picture_set_size(picture_job *job, int width, int height) {
    job->left = job->top = 0;
    job->width = job->right = width;
    job->height = job->bottom = height;
}

/* ---- Pieces -------------------------------------------------------------------------------- */

int picture_is_averaged(picture_kind kind) {
    return kind == PICTURE_SHADED || kind == PICTURE_NORMAL;
}

static int tiles_between(int low, int high) {
    return (high - 1) / SPT_TILE - low / SPT_TILE + 1;
}

size_t picture_pieces(const picture_job *job) {
    return (size_t)tiles_between(job->left, job->right) *
           (size_t)tiles_between(job->top, job->bottom) * (size_t)job->panel_count;
}

int picture_piece_area(const picture_job *job, size_t piece, int area[4]) {
    const size_t across = (size_t)tiles_between(job->left, job->right);
    const size_t tiles = across * (size_t)tiles_between(job->top, job->bottom);
    const int left = (job->left / SPT_TILE + (int)(piece % tiles % across)) * SPT_TILE;
    const int top = (job->top / SPT_TILE + (int)(piece % tiles / across)) * SPT_TILE;
    area[0] = left > job->left ? left : job->left;
    area[1] = top > job->top ? top : job->top;
    area[2] = left + SPT_TILE < job->right ? left + SPT_TILE : job->right;
    area[3] = top + SPT_TILE < job->bottom ? top + SPT_TILE : job->bottom;
    return (int)(piece / tiles);
}

film film_create(const picture_job *job, size_t first, size_t end) {
    film result;
    memset(&result, 0, sizeof result);
    result.job = *job;
    result.first = first;
    result.end = end;
    result.channels = job->kind == PICTURE_SHADED ? 3 : job->kind == PICTURE_NORMAL ? 4 : 1;
    const size_t pieces = end > first ? end - first : 1; /* malloc(0) may give NULL */
    result.values = calloc(pieces, tile_pixels * (size_t)result.channels * sizeof(float));
    result.done = calloc(pieces, 1);
    if (result.values == NULL || result.done == NULL) film_free(&result);
    for (int i = 0; i < picture_panels; ++i) result.statistics[i] = spt_statistics_default();
    return result;
}

void film_free(film *exposed) {
    free(exposed->values);
    free(exposed->done);
    exposed->values = NULL;
    exposed->done = NULL;
}

float *film_piece(const film *exposed, size_t piece) {
    return exposed->values + (piece - exposed->first) * tile_pixels * (size_t)exposed->channels;
}
