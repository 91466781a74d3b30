/* SPDX-License-Identifier: MIT
 *
 * What is traced by the C library and by a shader alike: fields with a callback and the same as a
 * text, models of the library's own, scenes, and rays for them. */
#ifndef TESTS_GLSL_SCENES_H
#define TESTS_GLSL_SCENES_H

#include <spheretrace/spheretrace.h>

enum {
    GLSL_ODD = 1 << 0,            /* no distance bound, or not finite: needs SPT_GLSL_GUARDS */
    GLSL_TRANSCENDENTAL = 1 << 1, /* its text calls sin, cos or pow: bits differ */
    GLSL_MODEL = 1 << 2 /* KRS or MöKRS: SPT_GLSL_ARRAYS and SPT_GLSL_PLACE do something */
};

typedef struct glsl_subject {
    const char *name;
    const spt_field *field; /* or */
    const spt_scene *scene;
    unsigned traits;
    float wobble; /* the factor of a transcendental function in f / lipschitz: its error times this
                   * is that of the distance */
} glsl_subject;

/* All of them, bodies of about unit size around the origin. */
const glsl_subject *glsl_subjects(int *count);
const glsl_subject *glsl_subject_named(const char *name);

/* Rays from outside and inside, of many lengths, with t_min and t_max, and their paths. With
 * `odd` every seventh is none that can be traced. Equal arguments give equal rays. */
void glsl_rays(int odd, int count, spt_ray *rays, float *paths);

#endif
