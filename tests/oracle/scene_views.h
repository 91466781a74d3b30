/* SPDX-License-Identifier: MIT
 *
 * The shared scenes that are unions, each with the rays of a small picture and secondary rays. */
#ifndef TESTS_ORACLE_SCENE_VIEWS_H
#define TESTS_ORACLE_SCENE_VIEWS_H

#include "scene_run.h"

#include <scenes/parts.h>

/* Visits every shared scene of more than one component at every grain that makes a difference, and
 * names it:
 *     for (scene_view view = scene_first_view; scene_next_view(&view);) ... */
typedef struct scene_view {
    size_t place;
    size_t count; /* of components, at this grain */
    const scene *shown;
    scene_grain grain;
    char title[64];
} scene_view;
static const scene_view scene_first_view = {0, 0, NULL, SCENE_WHOLE, ""};
int scene_next_view(scene_view *view);

enum {
    view_width = 64,
    view_height = 36,
    view_pixels = view_width * view_height,
    view_secondary = 700,
    view_rays = view_pixels + view_secondary
};

/* The rays of the picture, and secondary ones: from points on and near what the picture shows, in
 * any direction, some of another length than 1, some with t_min, t_max and path. rays holds
 * view_rays; the result is half a pixel at distance 1. */
float scene_view_rays(const scene *shown, scene_ray *rays);

#endif
