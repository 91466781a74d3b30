/* SPDX-License-Identifier: MIT
 *
 * Cameras in double. The axes and windows are the floats of the spt_camera, taken as exact. */
#include "frame_camera.h"
#include "../check.h"

#include <math.h>

static const double unit_roundoff = 0x1p-24;

double camera_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void camera_cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

void camera_unit(double v[3]) {
    const double length = sqrt(camera_dot(v, v));
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
}

/* The point of the window has the coordinates a = x_low + x (x_high - x_low) / width and b. With W
 * = |low| + |high| at least |a|, a difference, a quotient, a product and a sum leave an error of at
 * most 4 u W. In base + a right + b up each product adds u and each of two sums u of what is summed
 * so far, so a component is off by less than 8 u (|base| + W_x |right| + W_y |up|). */
camera_ray camera_ray_at(const spt_camera *camera, uint32_t width, uint32_t height, double x,
                         double y) {
    const double left = (double)camera->x_low, right = (double)camera->x_high,
                 bottom = (double)camera->y_low, top = (double)camera->y_high;
    const double a = left + x / (double)width * (right - left);
    const double b = top + y / (double)height * (bottom - top);
    const double wide = fabs(left) + fabs(right), tall = fabs(bottom) + fabs(top);
    const int pinhole = camera->kind == SPT_CAMERA_PINHOLE;
    const float *base = pinhole ? camera->forward : camera->eye;
    double sum[3], error[3], size, length;
    camera_ray ray;
    for (int axis = 0; axis < 3; ++axis) {
        const double sideways = (double)camera->right[axis], upwards = (double)camera->up[axis];
        sum[axis] = (double)base[axis] + a * sideways + b * upwards;
        error[axis] = 8 * unit_roundoff *
                      (fabs((double)base[axis]) + wide * fabs(sideways) + tall * fabs(upwards));
    }
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = pinhole ? (double)camera->eye[axis] : sum[axis];
        ray.origin_error[axis] = pinhole ? 0 : error[axis];
        ray.direction[axis] = pinhole ? sum[axis] : (double)camera->forward[axis];
    }
    /* Bringing v + e to length 1 turns it by at most |e| / |v|. The length is off by less than 2 u
     * (squares and sums 3 u of the square, half of it after the root, u for the root), the quotient
     * adds u. */
    size = pinhole ? sqrt(camera_dot(error, error)) : 0;
    length = sqrt(camera_dot(ray.direction, ray.direction));
    ray.direction_error = size / length + 4 * unit_roundoff;
    camera_unit(ray.direction);
    return ray;
}

static void axes_of(const double forward[3], double right[3], double up[3]) {
    const double vertical[3] = {0.1, 1, 0.05};
    camera_cross(forward, vertical, right);
    camera_unit(right);
    camera_cross(right, forward, up);
}

spt_camera camera_draw(spt_camera_kind kind, uint32_t variant, const double eye[3],
                       const double target[3], double spread, double tangent, double aspect) {
    spt_camera camera = spt_camera_of_rays(NULL, NULL);
    double forward[3], right[3], up[3], shift_x = 0, shift_y = 0;
    const double tall = tangent / aspect * ((variant & CAMERA_OBLONG) != 0 ? 1.7 : 1);
    for (int axis = 0; axis < 3; ++axis) {
        const double from = eye[axis] + check_uniform(-spread, spread);
        camera.eye[axis] = (float)from;
        forward[axis] = target[axis] + check_uniform(-spread, spread) - from;
    }
    camera_unit(forward);
    axes_of(forward, right, up);
    if ((variant & CAMERA_SKEWED) != 0) {
        /* At most .3 of an axis on another: they still span space. */
        for (int axis = 0; axis < 3; ++axis) {
            const double along = forward[axis];
            forward[axis] = 1.9 * (along + 0.3 * up[axis]);
            up[axis] = 0.7 * (up[axis] - 0.3 * right[axis]);
            right[axis] = 1.2 * (right[axis] + 0.25 * along);
        }
    }
    if ((variant & CAMERA_OFF_AXIS) != 0) {
        shift_x = tangent * check_uniform(0.5, 1.5);
        shift_y = -tall * check_uniform(0.3, 1.2);
    }
    camera.kind = kind;
    for (int axis = 0; axis < 3; ++axis) {
        camera.forward[axis] = (float)forward[axis];
        camera.right[axis] = (float)right[axis];
        camera.up[axis] = (float)up[axis];
    }
    camera.x_low = (float)(shift_x - tangent);
    camera.x_high = (float)(shift_x + tangent);
    camera.y_low = (float)(shift_y - tall);
    camera.y_high = (float)(shift_y + tall);
    if ((variant & CAMERA_MIRROR_X) != 0) {
        camera.x_low = (float)(shift_x + tangent);
        camera.x_high = (float)(shift_x - tangent);
    }
    if ((variant & CAMERA_MIRROR_Y) != 0) {
        camera.y_low = (float)(shift_y + tall);
        camera.y_high = (float)(shift_y - tall);
    }
    camera.t_min = 0;
    camera.t_max = (float)HUGE_VAL;
    return camera;
}
