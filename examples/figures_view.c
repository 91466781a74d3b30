/* SPDX-License-Identifier: MIT
 *
 * Views of scenes as batches of rays: one call each for tracing, refining and normals. */
#include "figures.h"

#include <spheretrace/surface.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int figure_expect(int holds, const char *words) {
    if (!holds) printf("    NOT AS EXPECTED: %s\n", words);
    return holds;
}

static void need(figure_view *view, spt_status status) {
    if (status == SPT_OK) return;
    if (!view->failed) fprintf(stderr, "the library refused: %s\n", spt_status_name(status));
    view->failed = 1;
}

int figure_open(figure_view *view, const char *scene_name, const figure_wish *wish) {
    const size_t count = (size_t)wish->width * (size_t)wish->height;
    view->shown = scene_named(scene_name);
    view->width = wish->width;
    view->height = wish->height;
    view->count = count;
    view->failed = 0;
    view->rays = malloc(count * sizeof *view->rays);
    view->hits = malloc(count * sizeof *view->hits);
    view->t = malloc(count * sizeof *view->t);
    view->normals = malloc(count * 3 * sizeof *view->normals);
    if (view->shown == NULL || view->rays == NULL || view->hits == NULL || view->t == NULL ||
        view->normals == NULL) {
        fprintf(stderr, "%s: no such scene, or out of memory\n", scene_name);
        figure_close(view);
        return 0;
    }
    view->field = scene_field(view->shown, spt_lanes());
    view->settings = spt_settings_default();
    scene_rays(view->shown, view->width, view->height, view->rays, &view->settings.pixel_radius);
    return 1;
}

void figure_close(figure_view *view) {
    free(view->normals);
    free(view->t);
    free(view->hits);
    free(view->rays);
}

static void show_hits(figure_view *view) {
    for (size_t i = 0; i < view->count; ++i) {
        view->t[i] = view->hits[i].outcome == SPT_HIT ? view->hits[i].t : INFINITY;
    }
}

double figure_trace(figure_view *view) {
    const spt_rays rays = spt_rays_of(view->rays);
    const spt_hits hits = spt_hits_of(view->hits);
    spt_statistics statistics = spt_statistics_default();
    need(view, spt_trace(&view->field, &view->settings, view->count, &rays, &hits, &statistics));
    show_hits(view);
    return (double)statistics.evaluations / (double)view->count;
}

void figure_refine(figure_view *view, uint32_t rounds) {
    const spt_rays rays = spt_rays_of(view->rays);
    const spt_hits hits = spt_hits_of(view->hits);
    need(view, spt_refine(&view->field, 1, &view->settings, rounds, view->count, &rays, &hits));
    show_hits(view);
}

void figure_find_normals(figure_view *view) {
    const spt_rays rays = spt_rays_of(view->rays);
    const spt_vector_sinks normals = spt_vector_sinks_of(view->normals);
    spt_hits shown = {0};
    int32_t *const outcomes = malloc(view->count * sizeof *outcomes);
    if (outcomes == NULL) {
        need(view, SPT_BAD_ARGUMENT);
        return;
    }
    /* Anything that is shown counts as a hit: the last sample and the candidate, too. */
    for (size_t i = 0; i < view->count; ++i) {
        outcomes[i] = view->t[i] < INFINITY ? SPT_HIT : SPT_MISS;
    }
    shown.t.first = view->t;
    shown.t.stride = sizeof *view->t;
    shown.outcome.first = outcomes;
    shown.outcome.stride = sizeof *outcomes;
    need(view, spt_normals(&view->field, 1, &view->settings, SPT_NORMAL_CENTRAL, 0, view->count,
                           &rays, &shown, &normals));
    free(outcomes);
}

void figure_point(const figure_view *view, size_t pixel, float point[3]) {
    const spt_ray *const ray = &view->rays[pixel];
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = ray->origin[axis] + view->t[pixel] * ray->direction[axis];
    }
}

float figure_half_pixel(const figure_view *view, size_t pixel) {
    return view->settings.pixel_radius * view->t[pixel]; /* directions have unit length */
}
