/* SPDX-License-Identifier: MIT
 *
 * planar.h as GLSL. */
#ifndef SPTI_PLANAR_GLSL_H
#define SPTI_PLANAR_GLSL_H

#include "../base/glsl_piece.h"

#define PLANAR_DECLARED "float next_ratio = 0.0; // of the next radius to this one's, on a plane\n"
#define PLANAR_STEP "$precise float wish = radius + $extrapolation * (radius * next_ratio);\n"
#define PLANAR_ACCEPTED \
    "// Equation 1, the drop clamped so that no divisor is 0\n" \
    "$precise float drop = min(max(before - after, -0.98 * step), step);\n" \
    "$precise float ratio = (step - drop) / (step + drop);\n" \
    "next_ratio = ratio;\n"

#endif
