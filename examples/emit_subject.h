/* SPDX-License-Identifier: MIT
 *
 * What emit writes shaders of: a scene of scenes.h or a model of models.h, found by its name. */
#ifndef EXAMPLES_EMIT_SUBJECT_H
#define EXAMPLES_EMIT_SUBJECT_H

#include "scenes/models.h"
#include "scenes/scenes.h"

/* Not to be copied while it is open: its world points into it. */
typedef struct emit_subject {
    const char *name, *description;
    double eye[3], target[3]; /* y is up */
    double field_of_view;     /* horizontal, degrees */
    double t_max;
    const scene *shown;                  /* a scene, which is one field, */
    spt_field field;                     /* */
    model_world *world;                  /* or a model, which is a union of fields, */
    int32_t materials[MODEL_COMPONENTS]; /* with a material each */
} emit_subject;

/* The name of a subject by its number, NULL behind the last; scenes come before models. */
const char *emit_subject_name(size_t number);
const char *emit_subject_description(size_t number);

/* Finds and builds it. Returns 0 where there is none of that name or memory ran out; there is
 * nothing to be closed then. */
int emit_subject_open(emit_subject *subject, const char *name);
void emit_subject_close(emit_subject *subject);

/* Half the width of its picture at distance 1. */
double emit_subject_tangent(const emit_subject *subject);

/* Its camera, for a picture of that size. */
spt_camera emit_subject_camera(const emit_subject *subject, uint32_t width, uint32_t height);

#endif
