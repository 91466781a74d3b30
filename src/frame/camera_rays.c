/* SPDX-License-Identifier: MIT
 *
 * Cameras asked for rays. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "job.h"

spti_view spti_view_of(const spt_camera *camera, uint32_t width, uint32_t height) {
    spti_view view;
    memset(&view, 0, sizeof view);
    view.kind = camera->kind;
    for (int axis = 0; axis < 3; ++axis) {
        view.eye[axis] = camera->eye[axis];
        view.right[axis] = camera->right[axis];
        view.up[axis] = camera->up[axis];
        view.forward[axis] = camera->forward[axis];
    }
    view.u_0 = camera->x_low;
    view.u_step = (float)(((double)camera->x_high - (double)camera->x_low) / (double)width);
    view.v_0 = camera->y_high;
    view.v_step = (float)(((double)camera->y_low - (double)camera->y_high) / (double)height);
    view.t_min = camera->t_min;
    view.t_max = camera->t_max;
    return view;
}

static void preset(spt_camera_ray *rays, size_t count) {
    memset(rays, 0, count * sizeof *rays);
    for (size_t i = 0; i < count; ++i) {
        rays[i].ray.t_max = INFINITY;
        rays[i].active = -1;
    }
}

void spti_view_rays(const spti_view *view, const spt_camera *camera, spti_isa isa, size_t count,
                    const float *x, const float *y, spt_camera_ray *rays) {
    preset(rays, count);
    if (view->kind == SPT_CAMERA_RAYS) {
        camera->rays(camera->user, count, x, y, rays);
        return;
    }
    spti_ray_arrays arrays;
    SPTI_ALIGNED(64) float across[SPT_BATCH];
    SPTI_ALIGNED(64) float down[SPT_BATCH];
    for (size_t i = 0; i < count || i % SPTI_GROUP != 0; ++i) {
        across[i] = x[i < count ? i : count - 1];
        down[i] = y[i < count ? i : count - 1];
    }
    spti_cone_kernels_of[isa]->rays(view, count, across, down, &arrays);
    for (size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            rays[i].ray.origin[axis] = arrays.origin[axis][i];
            rays[i].ray.direction[axis] = arrays.direction[axis][i];
        }
        rays[i].ray.t_min = view->t_min;
        rays[i].ray.t_max = view->t_max;
    }
}

spt_status spt_camera_rays(const spt_camera *camera, uint32_t width, uint32_t height, size_t count,
                           const float *x, const float *y, spt_camera_ray *rays) {
    spt_camera copy;
    if (!spti_camera_copy(&copy, camera) || width == 0 || height == 0) return SPT_BAD_ARGUMENT;
    if (count > 0 && (x == NULL || y == NULL || rays == NULL)) return SPT_BAD_ARGUMENT;
    const spti_view view = spti_view_of(&copy, width, height);
    const spti_isa isa = spti_isa_choose(0);
    for (size_t first = 0; first < count; first += SPT_BATCH) {
        const size_t left = count - first, size = left < SPT_BATCH ? left : SPT_BATCH;
        spti_view_rays(&view, &copy, isa, size, x + first, y + first, rays + first);
    }
    return SPT_OK;
}
