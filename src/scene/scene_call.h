/* SPDX-License-Identifier: MIT
 *
 * What scenes and frames share: a scene taken in, a call of each component, and results written. */
#ifndef SPTI_SCENE_CALL_H
#define SPTI_SCENE_CALL_H

#include "union.h"

enum { SPTI_MOST_COMPONENTS = 1 << 23, SPTI_MOST_ZONES = 1 << 16 };

/* Takes in a caller's scene without looking at its fields; 0 where it breaks its rules. */
int spti_scene_copy(spt_scene *to, const spt_scene *from);

/* Whether the fields of a scene keep theirs, and may be traced with these settings. */
int spti_scene_check(const spt_scene *scene, const spt_settings *settings);

/* The call of a checked scene's component in a union; hits says which results are wanted. */
void spti_scene_call(spti_call *call, spti_union *lazy, const spt_scene *scene, size_t component,
                     const spt_settings *settings, const spt_hits *hits,
                     spt_statistics *statistics);

/* Makes a union of such calls that lists as many; list, calls and rays are to be filled in. */
void spti_union_scene(spti_union *lazy, spti_call *calls, uint32_t *list, const spt_scene *scene,
                      const spt_settings *settings);

/* Writes the results of active rays at their end: those of ray i to places[i], or first + i. */
void spti_union_write(const spti_union *lazy, const spt_hits *hits, size_t first,
                      const size_t *places);

/* Those of one ray; a miss where it is not active. */
void spti_union_hit(const spti_union *lazy, size_t ray, spt_hit *hit);

/* Misses of rays that no component can meet; active may be NULL. */
void spti_write_misses(size_t count, const int32_t *active, const size_t *places,
                       const spt_hits *hits);

/* Counts the active rays; evaluations were counted as they were made. */
void spti_union_count(const spti_union *lazy, spt_statistics *statistics);

#endif
