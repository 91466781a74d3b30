/* SPDX-License-Identifier: MIT
 *
 * Cameras: made and checked. */
#include <float.h>
#include <math.h>

#include "../base/arguments.h"
#include "job.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* Returns 0 where there is no direction. */
static int normalize(double v[3]) {
    const double length = sqrt(dot(v, v));
    if (!(length > 0) || !(length < (double)INFINITY)) return 0;
    for (int axis = 0; axis < 3; ++axis) v[axis] /= length;
    return 1;
}

/* A camera that looks from eye to target, with a window of half the given width. */
static spt_status look_at(spt_camera *camera, uint32_t kind, const float eye[3],
                          const float target[3], const float up[3], float half_width,
                          uint32_t width, uint32_t height) {
    double forward[3], right[3], above[3], upward[3];
    spt_camera made = spt_camera_of_rays(NULL, NULL);
    if (camera == NULL || eye == NULL || target == NULL || up == NULL) return SPT_BAD_ARGUMENT;
    if (width == 0 || height == 0 || !(half_width > 0.0f) || !spti_finite(half_width)) {
        return SPT_BAD_ARGUMENT;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(eye[axis]) || !spti_finite(target[axis]) || !spti_finite(up[axis])) {
            return SPT_BAD_ARGUMENT;
        }
        forward[axis] = (double)target[axis] - (double)eye[axis];
        above[axis] = (double)up[axis];
        made.eye[axis] = eye[axis];
    }
    if (!normalize(forward) || !normalize(above)) return SPT_BAD_ARGUMENT;
    cross(forward, above, right);
    /* Below this the picture's upright is what rounding left over. */
    if (dot(right, right) < 1e-12 || !normalize(right)) return SPT_BAD_ARGUMENT;
    cross(right, forward, upward);
    for (int axis = 0; axis < 3; ++axis) {
        made.right[axis] = (float)right[axis];
        made.up[axis] = (float)upward[axis];
        made.forward[axis] = (float)forward[axis];
    }
    const float half_height = (float)((double)half_width * (double)height / (double)width);
    made.kind = kind;
    made.x_low = -half_width;
    made.x_high = half_width;
    made.y_low = -half_height;
    made.y_high = half_height;
    made.t_max = INFINITY;
    spt_camera checked;
    if (!spti_camera_copy(&checked, &made)) return SPT_BAD_ARGUMENT;
    *camera = made;
    return SPT_OK;
}

spt_status spt_camera_pinhole(spt_camera *camera, const float eye[3], const float target[3],
                              const float up[3], float tangent, uint32_t width, uint32_t height) {
    return look_at(camera, SPT_CAMERA_PINHOLE, eye, target, up, tangent, width, height);
}

spt_status spt_camera_orthographic(spt_camera *camera, const float eye[3], const float target[3],
                                   const float up[3], float half_width, uint32_t width,
                                   uint32_t height) {
    return look_at(camera, SPT_CAMERA_ORTHOGRAPHIC, eye, target, up, half_width, width, height);
}

/* The directions and origins that rays can have must not overflow when squared, nor vanish. */
static int rays_are_sound(const spt_camera *camera) {
    for (int corner = 0; corner < 4; ++corner) {
        const double u = (double)(corner % 2 == 0 ? camera->x_low : camera->x_high);
        const double v = (double)(corner / 2 == 0 ? camera->y_low : camera->y_high);
        double plane = 0, direction = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double offset = u * (double)camera->right[axis] + v * (double)camera->up[axis];
            const double forward = (double)camera->forward[axis];
            const double along = camera->kind == SPT_CAMERA_PINHOLE ? forward + offset : forward;
            plane += offset * offset;
            direction += along * along;
        }
        if (!(plane < 1e36) || !(direction < 1e36) || !(direction > 1e-36)) return 0;
    }
    return 1;
}

int spti_camera_copy(spt_camera *to, const spt_camera *from) {
    double right[3], up[3], forward[3], normal[3];
    *to = spt_camera_of_rays(NULL, NULL);
    if (from == NULL || !spti_copy_sized(to, from, sizeof *to)) return 0;
    if (to->kind == SPT_CAMERA_RAYS) return to->rays != NULL;
    if (to->kind != SPT_CAMERA_PINHOLE && to->kind != SPT_CAMERA_ORTHOGRAPHIC) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!spti_finite(to->eye[axis]) || !spti_finite(to->right[axis]) ||
            !spti_finite(to->up[axis]) || !spti_finite(to->forward[axis])) {
            return 0;
        }
        right[axis] = (double)to->right[axis];
        up[axis] = (double)to->up[axis];
        forward[axis] = (double)to->forward[axis];
    }
    cross(right, up, normal);
    const double volume = fabs(dot(normal, forward));
    if (!(volume > 1e-6 * sqrt(dot(right, right) * dot(up, up) * dot(forward, forward)))) return 0;
    if (!spti_finite(to->x_low) || !spti_finite(to->x_high) || !spti_finite(to->y_low) ||
        !spti_finite(to->y_high) || fabsf(to->x_high - to->x_low) <= 0.0f ||
        fabsf(to->y_high - to->y_low) <= 0.0f) {
        return 0;
    }
    if (!spti_within(to->t_min, 0.0f, FLT_MAX) || !(to->t_max <= INFINITY)) return 0;
    return rays_are_sound(to);
}
