/* SPDX-License-Identifier: MIT
 *
 * The calls of surface.h as one table, so that a test of arguments, views, callbacks or hosts runs
 * over all of them: which columns each reads and writes, and a call that any of them can be. For a
 * world to call them on see surface_world.h, for what results must satisfy surface_results.h. Knows
 * nothing of check.h: the fuzzing harness uses it, too. */
#ifndef TESTS_SURFACE_CALLS_H
#define TESTS_SURFACE_CALLS_H

#include <spheretrace/surface.h>

#include <stddef.h>
#include <stdint.h>

/* ---- Columns --------------------------------------------------------------------------------- */

typedef enum surface_input {
    IN_ORIGIN = 0,    /* 3 */
    IN_DIRECTION = 3, /* 3 */
    IN_T_MIN = 6,
    IN_T_MAX = 7,
    IN_PATH = 8,
    IN_ACTIVE = 9,   /* int32_t */
    IN_NORMAL = 10,  /* 3 */
    IN_CROSS = 13,   /* int32_t */
    IN_TANGENT = 14, /* of lights */
    IN_POINT = 15,   /* 3: points, and the first ends of bodies */
    IN_TO = 18,      /* 3 */
    IN_RADIUS = 21,
    surface_inputs = 22
} surface_input;

typedef enum surface_output {
    OUT_T = 0, /* 9: those of spt_hit, in its order */
    OUT_RESIDUAL = 1,
    OUT_OUTCOME = 2,
    OUT_EVALUATIONS = 3,
    OUT_FLAGS = 4,
    OUT_COMPONENT = 5,
    OUT_CANDIDATE_T = 6,
    OUT_CANDIDATE_RATIO = 7,
    OUT_FALLBACKS = 8,
    OUT_VECTOR = 9, /* 3: normals, new origins, normals of contacts */
    OUT_NEW_PATH = 12,
    OUT_START = 13,
    OUT_ANSWER = 14,   /* occluded, visibility, openness, distance */
    OUT_CROSSING = 15, /* surface_most_crossings words a ray */
    OUT_NUMBER = 16,
    OUT_INSIDE = 17,
    OUT_THICKNESS = 18,
    OUT_ENDED = 19,
    OUT_PLACE = 20,
    OUT_WHICH = 21,
    surface_outputs = 22
} surface_output;

enum { surface_most_crossings = 4, surface_most_fields = 2 };

#define SURFACE_BIT(column) ((uint32_t)1 << (column))
#define SURFACE_BITS(first, number) ((((uint32_t)1 << (number)) - 1) << (first))
#define SURFACE_HAS(set, column) (((set) >> (column)&1u) != 0)

/* The bytes of an element of an output. */
size_t surface_width(int column);

/* ---- The table ------------------------------------------------------------------------------- */

typedef enum surface_door {
    DOOR_REFINE,
    DOOR_NORMALS,
    DOOR_OFFSET,
    DOOR_CONVEX,
    DOOR_OCCLUDED,
    DOOR_CROSSINGS,
    DOOR_SHADOW,
    DOOR_AMBIENT,
    DOOR_COLLIDE,
    surface_doors
} surface_door;

/* The structures that a call takes by pointer. */
enum {
    TAKES_FIELD = 1u << 0,
    TAKES_SETTINGS = 1u << 1,
    TAKES_RAYS = 1u << 2,
    TAKES_HITS = 1u << 3,
    TAKES_POINTS = 1u << 4,  /* or bodies */
    TAKES_NORMALS = 1u << 5, /* to be read */
    TAKES_TANGENT = 1u << 6,
    TAKES_SINKS = 1u << 7,      /* for what the call answers, besides hits */
    TAKES_STATISTICS = 1u << 8, /* may be NULL */
    TAKES_FIELDS = 1u << 9      /* an array and a count; with TAKES_FIELD */
};

typedef struct surface_facts {
    const char *name;
    uint32_t takes;
    uint32_t inputs, inputs_needed;
    uint32_t outputs, outputs_needed; /* all that it writes or reads */
    uint32_t outputs_kept;            /* of those, the ones that it only reads */
    uint32_t outputs_changed;         /* the ones that it reads and writes */
} surface_facts;

extern const surface_facts surface_table[surface_doors];

/* ---- Calls ----------------------------------------------------------------------------------- */

typedef struct surface_call {
    surface_door door;
    const spt_field *fields;
    size_t field_count;
    const spt_settings *settings;
    spt_statistics *statistics;
    size_t count;
    spt_column in[surface_inputs];
    spt_sink out[surface_outputs];
    ptrdiff_t crossing_step;
    uint32_t most_crossings, iterations, checks, samples;
    float detail, distance;
    spt_normal_rule rule;
    int smooth;
    uint32_t withheld; /* TAKES_*: NULL is handed over in its place */
} surface_call;

spt_status surface_place(const surface_call *call);

/* The rays and hits of a call. */
spt_rays surface_rays(const surface_call *call);
spt_hits surface_hits(const surface_call *call);

/* A word of a column, whatever its stride; absent columns give the word absent. */
uint32_t surface_read(const spt_column *column, size_t index, uint32_t absent);

uint32_t surface_bits(float a);
float surface_float(uint32_t bits);

#endif
