/* SPDX-License-Identifier: MIT
 *
 * convex.h as GLSL. */
#include "../base/glsl_piece.h"

static const spti_rule_glsl rule_glsl = {
    "float last_step = 0.0, last_radius = 0.0;\n"
    "bool rising = false;\n",
    "spt_secant(radius, floor_here, last_step, last_radius, scale, rising)",
    "last_step = step;\nlast_radius = before;\n",
    "",
    "secant steps on a convex function",
};
