/* SPDX-License-Identifier: MIT
 *
 * enhanced.h as GLSL. */
#include "planar.glsl.h"

static const spti_rule_glsl rule_glsl = {
    PLANAR_DECLARED,
    PLANAR_STEP,
    PLANAR_ACCEPTED,
    "",
    "planar extrapolation (Balint & Valasek 2018, section 3)",
};
