/* SPDX-License-Identifier: MIT
 *
 * The rays of a chunk: where they are in the image, which are traced, and how far. */
#include <math.h>

#include "desk.h"

/* The points of a chunk's rays, and which are traced. Returns 0 where none is. */
static int place_rays(spti_desk *desk) {
    const spti_grid *const grid = &desk->grid;
    const spti_rectangle *const part = &grid->part;
    const uint32_t side = SPTI_CHUNK_SIDE;
    float across[SPTI_CHUNK_SIDE], down[SPTI_CHUNK_SIDE];
    int any = 0;
    desk->all = desk->left >= part->x_0 && desk->left + side <= part->x_1 &&
                desk->top >= part->y_0 && desk->top + side <= part->y_1;
    for (uint32_t i = 0; i < side; ++i) {
        const uint32_t x = desk->left + i < grid->width ? desk->left + i : grid->width - 1;
        const uint32_t y = desk->top + i < grid->height ? desk->top + i : grid->height - 1;
        across[i] = ((float)x + 0.5f) * grid->step_x;
        down[i] = ((float)y + 0.5f) * grid->step_y;
    }
    for (size_t i = 0; i < SPT_BATCH; i += 4) { /* a row of a block */
        const size_t left = i / 16 % 4 * 4, row = i / 64 * 4 + i / 4 % 4;
        const size_t place = spti_desk_place_of(desk, i);
        for (size_t k = 0; k < 4; ++k) {
            desk->x[i + k] = across[left + k];
            desk->y[i + k] = down[row];
            desk->own_places[i + k] = place + k;
        }
    }
    if (desk->all) return 1;
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const uint32_t column = spti_desk_column(desk, i), row = spti_desk_row(desk, i);
        const int traced =
            column >= part->x_0 && column < part->x_1 && row >= part->y_0 && row < part->y_1;
        desk->active[i] = traced ? -1 : 0;
        any |= traced;
    }
    return any;
}

/* The rays of a caller's camera; also of pixels that are not traced, so that the bundles do not
 * depend on which part of the image is. */
static void ask_camera(spti_desk *desk) {
    spti_view_rays(&desk->job->view, &desk->job->camera, desk->isa, SPT_BATCH, desk->x, desk->y,
                   desk->camera_rays);
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        const spt_camera_ray *const ray = &desk->camera_rays[i];
        desk->active[i] = desk->all || desk->active[i] != 0 ? ray->active : 0;
        for (int axis = 0; axis < 3; ++axis) {
            desk->rays.origin[axis][i] = ray->ray.origin[axis];
            desk->rays.direction[axis][i] = ray->ray.direction[axis];
        }
        desk->t_min[i] = ray->ray.t_min;
        desk->t_max[i] = ray->ray.t_max;
        desk->path[i] = ray->path;
    }
    desk->all = 0;
    spti_set_column(&desk->columns.t_min, desk->t_min, 4);
    spti_set_column(&desk->columns.t_max, desk->t_max, 4);
    spti_set_column(&desk->columns.path, desk->path, 4);
}

/* Cuts rays of the full image off at the caller's depths. */
static void cut_at_depths(spti_desk *desk) {
    const spt_frame *const frame = &desk->job->frame;
    const spt_column *const depths = &frame->t_max;
    if (depths->first == NULL || desk->grid.width != frame->width ||
        desk->grid.height != frame->height) {
        return;
    }
    for (size_t i = 0; i < SPT_BATCH; ++i) {
        float t;
        const int own = spti_desk_owns_rays(desk);
        const float before = own ? desk->t_max[i] : desk->job->view.t_max;
        desk->t_max[i] = before;
        if (!desk->all && desk->active[i] == 0) continue;
        memcpy(&t, (const char *)depths->first + (ptrdiff_t)desk->own_places[i] * depths->stride,
               sizeof t);
        if (t < before || !(t <= INFINITY)) desk->t_max[i] = t; /* NaN stays, a bad ray */
    }
    spti_set_column(&desk->columns.t_max, desk->t_max, 4);
}

int spti_desk_make_rays(spti_desk *desk) {
    const spti_view *const view = &desk->job->view;
    const ptrdiff_t pinhole = view->kind == SPT_CAMERA_PINHOLE ? 0 : 4; /* all from the eye */
    if (!place_rays(desk)) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        spti_set_column(&desk->columns.origin[axis], desk->rays.origin[axis], pinhole);
        spti_set_column(&desk->columns.direction[axis], desk->rays.direction[axis], 4);
    }
    if (spti_desk_owns_rays(desk)) {
        ask_camera(desk);
    } else {
        spti_set_column(&desk->columns.t_min, &view->t_min, 0);
        spti_set_column(&desk->columns.t_max, &view->t_max, 0);
        spti_set_column(&desk->columns.path, NULL, 0);
    }
    spti_set_column(&desk->columns.active, desk->all ? NULL : desk->active, 4);
    cut_at_depths(desk);
    return 1;
}

/* The origins and directions of our own cameras: only of chunks that may meet something. */
void spti_desk_fill_rays(spti_desk *desk) {
    if (spti_desk_owns_rays(desk)) return;
    spti_cone_kernels_of[desk->isa]->rays(&desk->job->view, SPT_BATCH, desk->x, desk->y,
                                          &desk->rays);
}
