/* SPDX-License-Identifier: MIT
 *
 * basic.h as GLSL. */
#include "../base/glsl_piece.h"

static const spti_rule_glsl rule_glsl = {
    "", "radius", "", "", "basic steps (Hart 1996; Keinert et al. 2014, Listing 1)",
};
