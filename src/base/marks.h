/* SPDX-License-Identifier: MIT
 *
 * What the library's own fields have in the place of a text: by the address of these the emitter
 * of GLSL knows what spt_field.user is. */
#ifndef SPTI_MARKS_H
#define SPTI_MARKS_H

/* user is an spt_krs, spt_moekrs, spt_conformal, spt_distorted, spt_level_set. */
extern const char spti_mark_krs[], spti_mark_moekrs[], spti_mark_conformal[], spti_mark_distorted[],
    spti_mark_level_set[];

#endif
