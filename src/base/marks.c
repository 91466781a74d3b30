/* SPDX-License-Identifier: MIT
 *
 * The marks themselves. None is GLSL, so that none is a caller's text. */
#include "marks.h"

const char spti_mark_krs[] = "# spt_krs";
const char spti_mark_moekrs[] = "# spt_moekrs";
const char spti_mark_conformal[] = "# spt_conformal";
const char spti_mark_distorted[] = "# spt_distorted";
const char spti_mark_level_set[] = "# spt_level_set";
