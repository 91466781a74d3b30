/* SPDX-License-Identifier: MIT
 *
 * From points back to pixels. */
#include "frame_listen.h"
#include "frame_camera.h"

#include <math.h>

static const double near_ray = 0.02, near_eye = 0.05;

/* The inverse of the matrix whose columns are right, up and forward, by cross products. */
static void invert(listener *ears, const spt_camera *camera) {
    double axes[3][3], determinant;
    for (int axis = 0; axis < 3; ++axis) {
        axes[0][axis] = (double)camera->right[axis];
        axes[1][axis] = (double)camera->up[axis];
        axes[2][axis] = (double)camera->forward[axis];
    }
    for (int row = 0; row < 3; ++row) {
        camera_cross(axes[(row + 1) % 3], axes[(row + 2) % 3], ears->inverse[row]);
    }
    determinant = camera_dot(axes[0], ears->inverse[0]);
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) ears->inverse[row][axis] /= determinant;
    }
    ears->forward_length = sqrt(camera_dot(axes[2], axes[2]));
}

/* Which of `size` pixels from low to high has its middle here; -1 for none. */
static double pixel_of(double place, double low, double high, double size) {
    const double pixel = (place - low) / (high - low) * size - 0.5, nearest = floor(pixel + 0.5);
    return fabs(pixel - nearest) <= near_ray ? nearest : -1;
}

static void note(listener *ears, double x, double y, double z) {
    const spt_frame *frame = &ears->frame;
    const spt_camera *camera = frame->camera;
    const int pinhole = camera->kind == SPT_CAMERA_PINHOLE;
    const double offset[3] = {x - (double)camera->eye[0], y - (double)camera->eye[1],
                              z - (double)camera->eye[2]};
    const double along = camera_dot(ears->inverse[2], offset);
    const double scale = pinhole ? along : 1;
    const double t = pinhole ? sqrt(camera_dot(offset, offset)) : along * ears->forward_length;
    double column, row;
    if (pinhole && !(along > 0 && t > near_eye)) return;
    column = pixel_of(camera_dot(ears->inverse[0], offset) / scale, (double)camera->x_low,
                      (double)camera->x_high, (double)frame->width);
    row = pixel_of(camera_dot(ears->inverse[1], offset) / scale, (double)camera->y_high,
                   (double)camera->y_low, (double)frame->height);
    if (column < (double)frame->left || column >= (double)frame->right) return;
    if (row < (double)frame->top || row >= (double)frame->bottom) return;
    double *first = &ears->first[((size_t)row - frame->top) * (frame->right - frame->left) +
                                 (size_t)column - frame->left];
    *first = fmin(*first, t);
}

static void listened(void *user, size_t n, const float *x, const float *y, const float *z,
                     float *distance) {
    const listened_part *part = user;
    for (size_t i = 0; i < n; ++i) note(part->to, (double)x[i], (double)y[i], (double)z[i]);
    part->field->batch(part->field->user, n, x, y, z, distance);
}

void listen_trace(listener *ears, const spt_frame *frame, uint32_t flags, spt_hit *hits) {
    ears->frame = *frame;
    ears->scene = *frame->scene;
    ears->scene.fields = ears->fields;
    ears->frame.scene = &ears->scene;
    invert(ears, frame->camera);
    for (size_t i = 0; i < frame->scene->count; ++i) {
        ears->parts[i].field = &frame->scene->fields[i];
        ears->parts[i].to = ears;
        ears->fields[i] = frame->scene->fields[i];
        ears->fields[i].batch = listened;
        ears->fields[i].user = &ears->parts[i];
    }
    for (size_t i = 0; i < view_pixels_most; ++i) ears->first[i] = HUGE_VAL;
    frame_trace(&ears->frame, flags, hits);
}
