/* SPDX-License-Identifier: MIT
 *
 * Pieces whose text depends on a scene: who writes them. */
#ifndef SPTI_GLSL_WRITE_H
#define SPTI_GLSL_WRITE_H

#include "writer.h"

typedef void spti_glsl_write_fn(spti_glsl *out);

/* Fields and what is known of them. In the order in which they stand in a text. */
spti_glsl_write_fn spti_glsl_write_map, spti_glsl_write_nearest, spti_glsl_write_component_at,
    spti_glsl_write_inverse_lipschitz, spti_glsl_write_floor_of_size, spti_glsl_write_detail,
    spti_glsl_write_material, spti_glsl_write_clip_0, spti_glsl_write_clip, spti_glsl_write_hull_0,
    spti_glsl_write_hull, spti_glsl_write_probe, spti_glsl_write_place;

/* Tracing. */
spti_glsl_write_fn spti_glsl_write_trace, spti_glsl_write_trace_shadow, spti_glsl_write_trace_back;

#endif
