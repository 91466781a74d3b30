/* SPDX-License-Identifier: MIT
 *
 * Kernel-reflection sequences as GLSL, with mirrors or maps between the levels: what the writers of
 * both share, and what is written beside their fields. */
#ifndef SPTI_GLSL_WRITE_KRS_H
#define SPTI_GLSL_WRITE_KRS_H

#include <spheretrace/mobius.h>

#include "writer.h"

/* Writes `float spt_probe(vec3 center, float radius)` of the one field there is: of a MoeKRS model
 * its own, of others f / lipschitz - radius. With a bound also `float spt_probe_extent()`, half of
 * its largest half side, or 0 where that has no end. */
void spti_glsl_probe(spti_glsl *out, const spt_field *field);

/* Writes `int spt_kernel_at(vec3 p)` of the one field there is, a KRS or MoeKRS model: the nearest
 * kernel's number, of equals the higher, -1 where all are empty. */
void spti_glsl_place(spti_glsl *out, const spt_field *field);

/* ---- Models ---------------------------------------------------------------------------------- */

/* A model of either kind. */
typedef struct spti_glsl_model {
    uint32_t levels;
    const spt_built_kernel *kernels;
    const spt_mirror *mirrors; /* of a KRS, or else: */
    const spt_built_map *maps;
    uint64_t unmirrored;
    int fields[SPT_KRS_LEVELS + 1]; /* numbers of the functions of kernels that are fields */
} spti_glsl_model;

typedef enum spti_glsl_question {
    SPTI_GLSL_DISTANCE,  /* of the point p */
    SPTI_GLSL_CLEARANCE, /* of the ball (center, radius); of models with maps */
    SPTI_GLSL_NEAREST    /* kernel at the point p */
} spti_glsl_question;

/* The model that a field is; 0 where it is none. Its kernels that are fields have no numbers. */
int spti_glsl_model_of(const spt_field *field, spti_glsl_model *model);

/* Writes those fields, each once; */
void spti_glsl_model_fields(spti_glsl *out, spti_glsl_model *model);

/* of the one field there is only where they are not written yet. */
void spti_glsl_model_fields_once(spti_glsl *out, spti_glsl_model *model);

/* Writes the body of a function that answers a question, without its head. */
void spti_glsl_model_body(spti_glsl *out, const spti_glsl_model *model,
                          spti_glsl_question question);

/* The field that a kernel is. */
spt_field spti_glsl_kernel_field(const spt_built_kernel *kernel);

/* Writes what divides by the constant of a field: " / 2.0", or nothing for 1. */
void spti_glsl_over(spti_glsl *out, float lipschitz);

/* ---- Constants ------------------------------------------------------------------------------- */

enum {
    SPTI_GLSL_COLUMNS = 8, /* arguments that are constants, most of a function, */
    SPTI_GLSL_ROW = 26     /* and their numbers */
};

/* A function of a kernel, a mirror or a map. All its arguments but the first, a point, are
 * constants; their numbers follow each other in a row. */
typedef struct spti_glsl_call {
    const char *function;
    struct {
        const char *name; /* of the array of this argument */
        int width;        /* how many numbers it is, 1 to 4; 0: there are no more */
    } columns[SPTI_GLSL_COLUMNS + 1];
} spti_glsl_call;

/* What one function is called with at all levels. */
typedef struct spti_glsl_table {
    int count;
    float rows[SPT_KRS_LEVELS + 1][SPTI_GLSL_ROW];
} spti_glsl_table;

/* Writes arrays of the constants. */
void spti_glsl_put_arrays(spti_glsl *out, const spti_glsl_call *call, const spti_glsl_table *table);

/* Writes a call with the numbers of a row, or, where that is NULL, with elements [index] of the
 * arrays. Where there are many arguments they stand in lines of their own, behind `indent`. */
void spti_glsl_put_call(spti_glsl *out, const spti_glsl_call *call, const char *at,
                        const float *row, const char *index, const char *indent);

/* Writes an array of int, or with width 2 of ivec2. */
void spti_glsl_put_integers(spti_glsl *out, const char *name, int width, int count,
                            const int *numbers);

/* ---- Maps (write_mobius.c) ------------------------------------------------------------------- */

/* Writes how a level goes through its map, */
void spti_glsl_map(spti_glsl *out, const spt_built_map *map, spti_glsl_question question);

/* or the arrays of all maps, and how a level goes through its own in a loop. */
void spti_glsl_map_arrays(spti_glsl *out, const spti_glsl_model *model);
void spti_glsl_map_of_level(spti_glsl *out, const spti_glsl_model *model,
                            spti_glsl_question question);

#endif
