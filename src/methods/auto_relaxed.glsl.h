/* SPDX-License-Identifier: MIT
 *
 * auto_relaxed.h as GLSL. */
#include "../base/glsl_piece.h"

static const spti_rule_glsl rule_glsl = {
    "float slope = -1.0; // of the radius, averaged along the ray\n",
    "$precise float wish = radius * (2.0 / (1.0 - min(slope, 0.98)));\n",
    "$precise float change = $slope_blend * ((after - before) / step - slope);\n"
    "slope += change;\n",
    "slope = -1.0;\n",
    "auto-relaxed steps (Ban & Valasek 2023)",
};
