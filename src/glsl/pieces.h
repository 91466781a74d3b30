/* SPDX-License-Identifier: MIT
 *
 * The table of all pieces of all rooms, in the order in which they are written. */
#ifndef SPTI_GLSL_PIECES_H
#define SPTI_GLSL_PIECES_H

#include "writer.h"

/* While scanning: marks the piece of this name, if there is one. */
void spti_glsl_reach(spti_glsl *out, const char *word);

/* While scanning: from the last piece to the first, looks at what those name that are reached. */
void spti_glsl_reach_all(spti_glsl *out);

/* Writes all pieces that are reached. */
void spti_glsl_write_pieces(spti_glsl *out);

/* What a library's host can replace stands between these. Pieces have them, but those of several
 * functions, which have them around what others call. */
void spti_glsl_begin_guard(spti_glsl *out, const char *name);
void spti_glsl_end_guard(spti_glsl *out, const char *name);

#endif
