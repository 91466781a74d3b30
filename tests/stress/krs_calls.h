/* SPDX-License-Identifier: MIT
 *
 * The calls of krs.h and mobius.h as one table, so that a test of arguments, views, callbacks or
 * hosts runs over all of them. Knows nothing of check.h: the fuzzing harness uses it, too. For a
 * world to call them on see krs_world.h. */
#ifndef TESTS_KRS_CALLS_H
#define TESTS_KRS_CALLS_H

#include <spheretrace/krs.h>
#include <spheretrace/mobius.h>

#include <stddef.h>
#include <stdint.h>

typedef enum krs_door {
    KRS_DOOR_SEQUENCE,        /* spt_trace() of spt_krs_field() */
    KRS_DOOR_MAPPED,          /* spt_trace() of spt_moekrs_field() */
    KRS_DOOR_CONFORMAL,       /* spt_trace() of spt_conformal_field() */
    KRS_DOOR_DISTORTED,       /* spt_trace() of spt_distorted_field() */
    KRS_DOOR_UNMAPPED,        /* the same of a caller's map */
    KRS_DOOR_EXITS,           /* spt_conformal_trace() */
    KRS_DOOR_PROBES,          /* spt_binary_trace() of spt_moekrs_probe() */
    KRS_DOOR_FIELD_PROBES,    /* spt_binary_trace() of spt_probe_of_field() of spt_krs_field() */
    KRS_DOOR_PLACES,          /* spt_krs_locate() */
    KRS_DOOR_MAPPED_PLACES,   /* spt_moekrs_locate() */
    KRS_DOOR_POINTS,          /* spt_distorted_points() */
    KRS_DOOR_UNMAPPED_POINTS, /* the same of a caller's map */
    krs_doors
} krs_door;

/* Inputs are the columns of spt_rays, in its order; points are its origins. */
enum { KRS_IN_T_MIN = 6, KRS_IN_T_MAX = 7, KRS_IN_PATH = 8, KRS_IN_ACTIVE = 9, krs_inputs = 10 };

/* Outputs are the sinks of spt_hits, or those of spt_krs_places, or three of points. */
enum {
    KRS_OUT_T = 0,
    KRS_OUT_RESIDUAL = 1,
    KRS_OUT_OUTCOME = 2,
    KRS_OUT_EVALUATIONS = 3,
    KRS_OUT_FLAGS = 4,
    KRS_OUT_COMPONENT = 5,
    KRS_OUT_FALLBACKS = 8,
    krs_hit_sinks = 9,
    KRS_OUT_KERNEL = 0,
    KRS_OUT_MIRRORS = 1,
    KRS_OUT_POINT = 2,
    KRS_OUT_NORMAL = 5,
    KRS_OUT_KERNEL_NORMAL = 8,
    KRS_OUT_U = 11,
    KRS_OUT_V = 12,
    KRS_OUT_SCALE = 13,
    krs_outputs = 14
};

/* The structures that a call takes by pointer. */
enum {
    KRS_TAKES_MODEL = 1u << 0, /* the field, the built model or the probe */
    KRS_TAKES_SETTINGS = 1u << 1,
    KRS_TAKES_RAYS = 1u << 2, /* or points */
    KRS_TAKES_HITS = 1u << 3,
    KRS_TAKES_PLACES = 1u << 4, /* or sinks of points */
    KRS_TAKES_STATISTICS = 1u << 5,
    KRS_TAKES_BINARY = 1u << 6
};

typedef struct krs_facts {
    const char *name;
    uint32_t takes;
    int inputs, inputs_needed; /* the first of the columns */
    int outputs;
    int outputs_needed; /* all of them must be there; else none */
    int own_pass;       /* settings.flags must be 0 */
} krs_facts;

extern const krs_facts krs_table[krs_doors];

/* The bytes of an element of an output. */
size_t krs_width(krs_door door, int column);

static inline int krs_locates(krs_door door) {
    return door == KRS_DOOR_PLACES || door == KRS_DOOR_MAPPED_PLACES;
}

static inline int krs_moves(krs_door door) {
    return door == KRS_DOOR_POINTS || door == KRS_DOOR_UNMAPPED_POINTS;
}

typedef struct krs_call {
    krs_door door;
    const spt_field *field;
    const spt_krs *krs;
    const spt_moekrs *moekrs;
    const spt_conformal *conformal;
    const spt_distorted *distorted;
    const spt_probe *probe;
    const spt_binary *binary; /* or NULL */
    const spt_settings *settings;
    spt_statistics *statistics; /* or NULL */
    int32_t component;
    size_t count;
    spt_column in[krs_inputs];
    spt_sink found[krs_hit_sinks]; /* the hits that are located */
    spt_sink out[krs_outputs];
    uint32_t withheld; /* KRS_TAKES_*: NULL is handed over in its place */
} krs_call;

spt_status krs_place_call(const krs_call *call);

uint32_t krs_bits(float a);
float krs_float(uint32_t bits);

#endif
