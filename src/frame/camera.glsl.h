/* SPDX-License-Identifier: MIT
 *
 * The rays of cameras as GLSL: cone_kernel.h. Left out: cameras of the caller's rays. */
#ifndef SPTI_CAMERA_GLSL_H
#define SPTI_CAMERA_GLSL_H

#include "../base/glsl_piece.h"

/* C divides the window by the size in double and rounds the quotient. Where x_high - x_low and
 * y_low - y_high are floats, as in every window that is centred, the float division here gives the
 * same bits (a quotient of floats is not changed by rounding to 53 bits first), and so rays have
 * the bits of spt_camera_rays(). In other windows the step to the next pixel is off by at most two
 * units in the last place. */
static const spti_glsl_piece spti_glsl_camera[] = {
    {"spt_camera_ray",
     "// The ray through a point of the picture: (0, 0) is its upper left corner, and a pixel's\n"
     "// centre is at + 0.5.\n"
     "SptRay spt_camera_ray(vec2 pixel) {\n"
     "    vec4 window = $window;\n"
     "    vec2 size = vec2($size), range = $range;\n"
     "    $precise float u = window.x + pixel.x * ((window.y - window.x) / size.x);\n"
     "    $precise float v = window.w + pixel.y * ((window.z - window.w) / size.y);\n"
     "    SptRay ray;\n"
     "    vec3 right = $right;\n"
     "    vec3 up = $up;\n"
     "[pinhole]    vec3 forward = $forward;\n"
     "[pinhole]    $precise vec3 d = (forward + u * right) + v * up;\n"
     "[pinhole]    ray.origin = $eye;\n"
     "[!pinhole]    vec3 eye = $eye;\n"
     "[!pinhole]    vec3 d = $forward;\n"
     "[!pinhole]    $precise vec3 o = (eye + u * right) + v * up;\n"
     "[!pinhole]    ray.origin = o;\n"
     "    $precise vec3 unit = d / sqrt((d.x * d.x + d.y * d.y) + d.z * d.z);\n"
     "    ray.direction = unit;\n"
     "    ray.t_min = range.x;\n"
     "    ray.t_max = range.y;\n"
     "[path]    ray.path = 0.0;\n"
     "    return ray;\n"
     "}\n"},
};

#endif
