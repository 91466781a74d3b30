/* SPDX-License-Identifier: MIT
 *
 * The cameras of the scenes as frames take them. Apart from their rays (scenes_camera.c), so that a
 * program that traces rays only links no frames. */
#include "scenes.h"

#include <math.h>

spt_camera scene_camera(const scene *shown, uint32_t width, uint32_t height) {
    const double radians = 3.14159265358979323846 / 180;
    const double tangent = tan(shown->field_of_view / 2 * radians);
    const float up[3] = {0, 1, 0};
    float eye[3], target[3];
    spt_camera camera;
    for (int axis = 0; axis < 3; ++axis) {
        eye[axis] = (float)shown->eye[axis];
        target[axis] = (float)shown->target[axis];
    }
    (void)spt_camera_pinhole(&camera, eye, target, up, (float)tangent, width, height);
    camera.t_max = (float)shown->t_max;
    return camera;
}
