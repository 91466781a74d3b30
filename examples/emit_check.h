/* SPDX-License-Identifier: MIT
 *
 * What emit checks without arguments. */
#ifndef EXAMPLES_EMIT_CHECK_H
#define EXAMPLES_EMIT_CHECK_H

/* Whether every scene and model can be written for every target and program, and as a page, and
 * whether the texts are sound. Prints lines of GLSL by scene. Returns 0 where all is well. */
int emit_check(void);

#endif
