/* SPDX-License-Identifier: MIT
 *
 * adaptive.h as GLSL. */
#include "planar.glsl.h"

static const spti_rule_glsl rule_glsl = {
    PLANAR_DECLARED,
    PLANAR_STEP "wish = min(wish, $step_cap * radius);\n",
    PLANAR_ACCEPTED,
    "",
    "capped planar extrapolation (after Balint & Valasek 2018, section 3)",
};
