/* SPDX-License-Identifier: MIT
 *
 * What the rays of a conformal model cost: by binary sphere tracing, for which the paper finds no
 * substitute, and by sphere tracing with the library's distance bound (Szécsi et al. 2016, Figure
 * 13 and section 7). */
#include "models_pictures.h"

#include "heat.h"
#include "workers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct counting {
    const spt_moekrs *moekrs;
    spt_camera camera;
    spt_settings settings;
    image *picture;
    int width, height; /* of a panel */
    int failed;
    uint64_t sums[2], hits[2]; /* evaluations of the rays that hit, and how many those are */
} counting;

enum { panels = 2, largest = 64 };

/* One row of one panel. */
static spt_status trace_row(const counting *all, int panel, int row, uint64_t *sum, uint64_t *met) {
    const spt_field field = spt_moekrs_field(all->moekrs);
    const spt_probe probe = spt_moekrs_probe(all->moekrs);
    float x[SPT_BATCH], y[SPT_BATCH];
    spt_camera_ray made[SPT_BATCH];
    spt_ray rays[SPT_BATCH];
    spt_hit hits[SPT_BATCH];
    const spt_rays ray_views = spt_rays_of(rays);
    const spt_hits hit_views = spt_hits_of(hits);
    for (int left = 0; left < all->width; left += SPT_BATCH) {
        const size_t count =
            (size_t)(all->width - left < SPT_BATCH ? all->width - left : SPT_BATCH);
        for (size_t i = 0; i < SPT_BATCH; ++i) {
            x[i] = (float)left + (float)i + 0.5f;
            y[i] = (float)row + 0.5f;
        }
        spt_status status = spt_camera_rays(&all->camera, (uint32_t)all->width,
                                            (uint32_t)all->height, count, x, y, made);
        if (status != SPT_OK) return status;
        for (size_t i = 0; i < count; ++i) rays[i] = made[i].ray;
        status = panel == 0
                     ? spt_binary_trace(&probe, NULL, &all->settings, count, &ray_views, &hit_views,
                                        NULL)
                     : spt_trace(&field, &all->settings, count, &ray_views, &hit_views, NULL);
        if (status != SPT_OK) return status;
        for (size_t i = 0; i < count; ++i) {
            *sum += hits[i].outcome == SPT_HIT ? hits[i].evaluations : 0;
            *met += hits[i].outcome == SPT_HIT;
            heat_colour((float)hits[i].evaluations / (float)largest,
                        image_at(all->picture, panel * all->width + left + (int)i, row));
        }
    }
    return SPT_OK;
}

static void run_thread(void *user, workers *crew) {
    counting *all = user;
    uint64_t sums[panels] = {0, 0}, hits[panels] = {0, 0};
    size_t piece;
    spt_status status = SPT_OK;
    while (status == SPT_OK && workers_take(crew, &piece)) {
        const int panel = (int)(piece % panels);
        status = trace_row(all, panel, (int)(piece / panels), &sums[panel], &hits[panel]);
        if (status == SPT_OK) workers_finish(crew);
    }
    if (status != SPT_OK) workers_stop(crew);
    workers_lock(crew);
    all->failed |= status != SPT_OK;
    for (int i = 0; i < panels; ++i) {
        all->sums[i] += sums[i];
        all->hits[i] += hits[i];
    }
    workers_unlock(crew);
}

int models_iterations(const models_view *view, image *picture) {
    static const char *const titles[panels] = {"binary tracing", "distance bound"};
    counting all;
    models_view closer = *view;
    memset(&all, 0, sizeof all);
    for (size_t i = 0; i < view->world->count && all.moekrs == NULL; ++i) {
        all.moekrs = view->world->components[i].moekrs;
    }
    if (all.moekrs == NULL || !all.moekrs->bounded ||
        !models_look_at(&all.moekrs->bound, 0.84, &closer)) {
        return 0;
    }
    all.picture = picture;
    all.width = picture->width / panels;
    all.height = picture->height - heat_legend_height;
    all.settings = spt_settings_default();
    all.settings.budget = 1024;
    all.settings.epsilon = 1e-5f * (float)view->shown->t_max;
    const double half = view->shown->field_of_view * 3.14159265358979 / 360.0;
    all.settings.pixel_radius = (float)(tan(half) / all.width);
    if (models_camera(&closer, (uint32_t)all.width, (uint32_t)all.height, &all.camera) != SPT_OK) {
        return 0;
    }
    const size_t pieces = (size_t)all.height * panels;
    if (workers_run(view->threads, 0, pieces, run_thread, &all, "iterations") != pieces ||
        all.failed) {
        return 0;
    }
    for (int i = 0; i < panels; ++i) {
        const double mean = (double)all.sums[i] / (all.hits[i] != 0 ? (double)all.hits[i] : 1.0);
        char title[80];
        snprintf(title, sizeof title, "%s: %.1f evaluations a hit", titles[i], mean);
        heat_legend(picture, i * all.width, all.height, all.width, title, largest, "");
        printf("%-22s %s\n", i == 0 ? "model_palm_iterations" : "", title);
    }
    return 1;
}
