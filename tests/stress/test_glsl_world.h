/* SPDX-License-Identifier: MIT
 *
 * Fields, models and scenes of every kind that spt_glsl_emit() writes, options for them, and what
 * glsl.h says of each combination: must be written, must be refused, or is left open. */
#ifndef TESTS_GLSL_WORLD_H
#define TESTS_GLSL_WORLD_H

#include <spheretrace/spheretrace.h>

#include "test_glsl_text.h"

typedef enum glsl_subject {
    GLSL_BALL,   /* a caller's field of one line */
    GLSL_BODY,   /* convex, with a bound */
    GLSL_SHAPES, /* a caller's field of shapes.h, with a prelude */
    GLSL_STEEP,  /* with a Lipschitz constant */
    GLSL_KRS_0,  /* models of 0, 1 and 64 levels */
    GLSL_KRS_1,
    GLSL_KRS_64,
    GLSL_KRS_FIELD, /* with a caller's field among the kernels */
    GLSL_MOEKRS,
    GLSL_CONFORMAL,
    GLSL_TWIST,
    GLSL_BEND,
    GLSL_TAPER,
    GLSL_SWAY,
    GLSL_MAP,
    GLSL_LEVEL_SET,
    GLSL_NESTED,  /* a level set of a twist of a conformal field of a model with a field */
    GLSL_SCENE_1, /* scenes of one, and of many fields, with every kind of bound and materials */
    GLSL_SCENE,
    GLSL_CONVEX_SCENE,
    glsl_subjects
} glsl_subject;

extern const char *const glsl_subject_names[glsl_subjects];

enum { glsl_most_fields = 16, glsl_most_callers = 8, glsl_room = 1 << 20 };

typedef struct glsl_world {
    glsl_subject subject;
    spt_field ball, body, shapes, field;
    spt_bound bound, box, bounds[glsl_most_fields];
    spt_bound_plane planes[3];
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    spt_mobius maps[SPT_KRS_LEVELS];
    spt_krs krs, krs_other;
    spt_moekrs moekrs;
    spt_conformal conformal;
    spt_distorted distorted;
    spt_level_set level_set;
    spt_field fields[glsl_most_fields];
    int32_t materials[glsl_most_fields];
    spt_scene scene;
    spt_settings settings;
    spt_camera camera;
    const char *names[SPT_GLSL_NAMES];
    const char *callers[glsl_most_callers]; /* texts, as they stand in what is written */
    spt_glsl_options options;
    char *text; /* what was written last, and how much */
    size_t length;
} glsl_world;

/* A world whose options are right: a library, no features, spt_basic(). Its memory must not be
 * moved. Returns whether the library made the models, which is checked. */
int glsl_world_make(glsl_world *world, glsl_subject subject);

/* The field that is traced, or the first of the scene. */
const spt_field *glsl_world_field(const glsl_world *world);

/* Calls the emitter with the memory of the world, which is the same for all worlds, and checks what
 * holds of every call: the text ends where length says, nothing is written behind it, and with a
 * refusal nothing at all. */
spt_status glsl_world_emit(glsl_world *world);

/* Tells the reader what of a text is the caller's. */
void glsl_world_allow(const glsl_world *world, glsl_text *text);

/* Emits, which must succeed, and audits what was written. */
int glsl_world_audit(glsl_world *world, glsl_text *text);

/* What glsl.h says: 1 must be written, -1 must be refused, 0 it does not say. */
int glsl_world_verdict(const glsl_world *world);

/* Emits, and audits or expects a refusal by the verdict. */
void glsl_world_try(glsl_world *world, glsl_text *text);

#endif
