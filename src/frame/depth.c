/* SPDX-License-Identifier: MIT
 *
 * Depth buffers: between the t of a ray and what rasterisers store. In double, once a pixel. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "job.h"

/* How far along forward the ray of a pixel comes for each unit of t, and how much of that is there
 * at t = 0: nothing, since the image plane of an orthographic camera goes through its eye. */
static double forward_share(const spti_job *job, size_t x, size_t y) {
    const spti_view *const view = &job->view;
    const double u = (double)view->u_0 + ((double)x + 0.5) * (double)view->u_step;
    const double v = (double)view->v_0 + ((double)y + 0.5) * (double)view->v_step;
    double along = 0, square = 0, forward = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double ahead = (double)view->forward[axis];
        const double direction =
            view->kind == SPT_CAMERA_PINHOLE
                ? ahead + u * (double)view->right[axis] + v * (double)view->up[axis]
                : ahead;
        along += direction * ahead;
        square += direction * direction;
        forward += ahead * ahead;
    }
    return along / sqrt(square * forward);
}

static int depth_is_good(const spt_depth *depth, uint32_t camera) {
    if (depth == NULL) return 0;
    if (depth->kind == SPT_DEPTH_LINEAR) return 1;
    if (depth->kind != SPT_DEPTH_DEVICE && depth->kind != SPT_DEPTH_DEVICE_GL) return 0;
    const float near_plane = depth->near_plane, far_plane = depth->far_plane;
    if (!(near_plane < far_plane) && !(near_plane > far_plane)) return 0; /* NaN, too */
    if (camera == SPT_CAMERA_ORTHOGRAPHIC) {
        return spti_finite(near_plane) && spti_finite(far_plane);
    }
    return near_plane > 0.0f && far_plane > 0.0f;
}

/* Device depths are linear in this: the depth itself, or what perspective makes of it. */
static double device_scale(uint32_t camera, double length) {
    return camera == SPT_CAMERA_ORTHOGRAPHIC ? length : 1 / length;
}

static double depth_of(const spt_depth *depth, uint32_t camera, double length) {
    if (depth->kind == SPT_DEPTH_LINEAR) return length;
    const double near_scale = device_scale(camera, (double)depth->near_plane);
    const double far_scale = device_scale(camera, (double)depth->far_plane);
    double share = (device_scale(camera, length) - near_scale) / (far_scale - near_scale);
    share = share > 0 ? (share < 1 ? share : 1) : 0;
    return depth->kind == SPT_DEPTH_DEVICE_GL ? 2 * share - 1 : share;
}

static double length_of(const spt_depth *depth, uint32_t camera, double stored) {
    if (depth->kind == SPT_DEPTH_LINEAR) return stored;
    const double near_scale = device_scale(camera, (double)depth->near_plane);
    const double far_scale = device_scale(camera, (double)depth->far_plane);
    const double share = depth->kind == SPT_DEPTH_DEVICE_GL ? 0.5 * (stored + 1) : stored;
    const double scale = near_scale + share * (far_scale - near_scale);
    return camera == SPT_CAMERA_ORTHOGRAPHIC ? scale : scale > 0 ? 1 / scale : (double)INFINITY;
}

typedef double convert_fn(const spt_depth *depth, uint32_t camera, double share, double value);

static double depth_of_t(const spt_depth *depth, uint32_t camera, double share, double t) {
    return depth_of(depth, camera, t * share);
}

static double t_of_depth(const spt_depth *depth, uint32_t camera, double share, double stored) {
    return length_of(depth, camera, stored) / share;
}

static spt_status convert(const spt_frame *frame, const spt_depth *depth, const spt_column *from,
                          const spt_sink *to, convert_fn *function) {
    spti_job job;
    spt_hits image;
    if (!spti_job_of(&job, frame) || from == NULL || to == NULL || from->first == NULL ||
        to->first == NULL) {
        return SPT_BAD_ARGUMENT;
    }
    memset(&image, 0, sizeof image);
    image.t = *to;
    spt_frame read = job.frame;
    read.t_max = *from;
    if (!spti_image_fits(&read, &image) || !depth_is_good(depth, job.camera.kind)) {
        return SPT_BAD_ARGUMENT;
    }
    if (job.camera.kind == SPT_CAMERA_RAYS) return SPT_UNSUPPORTED;
    size_t place = 0;
    for (uint32_t y = job.frame.top; y < job.frame.bottom; ++y) {
        for (uint32_t x = job.frame.left; x < job.frame.right; ++x, ++place) {
            float value;
            memcpy(&value, (const char *)from->first + (ptrdiff_t)place * from->stride,
                   sizeof value);
            value =
                (float)function(depth, job.camera.kind, forward_share(&job, x, y), (double)value);
            memcpy((char *)to->first + (ptrdiff_t)place * to->stride, &value, sizeof value);
        }
    }
    return SPT_OK;
}

spt_status spt_frame_depth(const spt_frame *frame, const spt_depth *depth, const spt_column *t,
                           const spt_sink *to) {
    return convert(frame, depth, t, to, depth_of_t);
}

spt_status spt_frame_t_of_depth(const spt_frame *frame, const spt_depth *depth,
                                const spt_column *from, const spt_sink *t) {
    return convert(frame, depth, from, t, t_of_depth);
}
