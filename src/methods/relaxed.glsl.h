/* SPDX-License-Identifier: MIT
 *
 * relaxed.h as GLSL. */
#include "../base/glsl_piece.h"

static const spti_rule_glsl rule_glsl = {
    "",
    "$precise float wish = $relaxation * radius;\n",
    "",
    "",
    "over-relaxed steps (Keinert et al. 2014, 3.1 and Listing 2, mended)",
};
