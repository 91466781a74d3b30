/* SPDX-License-Identifier: MIT
 *
 * The harness for krs.h and mobius.h, which libFuzzer drives and the unit run as well. Rays,
 * settings and callers' fields are those of fuzz.h; calls and what their results must satisfy are
 * those of krs_calls.h and krs_results.h. */
#ifndef TESTS_FUZZ_KRS_H
#define TESTS_FUZZ_KRS_H

#include "fuzz.h"

#include "stress/krs_calls.h"

enum { fuzz_krs_most = 24, fuzz_krs_fields = 2, fuzz_krs_fill = 0xa5 };

typedef struct fuzz_krs_case {
    int hostile; /* numbers may be anything */
    uint32_t promises;
    fuzz_field parts[fuzz_krs_fields];
    spt_field fields[fuzz_krs_fields];
    spt_bound bounds[fuzz_krs_fields];
    fuzz_field unmapped; /* counts what the map of a distortion was asked */
    spt_bound map_bound, model_bound;
    spt_kernel kernels[SPT_KRS_LEVELS + 1];
    spt_mirror mirrors[SPT_KRS_LEVELS];
    spt_mobius maps[SPT_KRS_LEVELS];
    spt_krs_model model;
    spt_moekrs_model mapped_model;
    spt_distortion distortion;
    spt_binary binary;
    spt_settings settings;
    spt_krs krs;
    spt_moekrs moekrs;
    spt_conformal conformal;
    spt_distorted distorted;
    spt_field field; /* of the model that the door is about */
    spt_probe probe;
    uint32_t choice, seed;
    krs_call call; /* of the arrays below */
    uint32_t in[krs_inputs][fuzz_krs_most];
    uint32_t found[krs_hit_sinks][fuzz_krs_most];
    unsigned char out[krs_outputs][fuzz_krs_most][8];
} fuzz_krs_case;

/* Fills the descriptions and the call, whose addresses stay in the case; no model is made yet. */
void fuzz_krs_read(fuzz_krs_case *what, const uint8_t *data, size_t size);

uint64_t fuzz_krs_faults(const fuzz_krs_case *what);

/* Reads any bytes as a call, makes it and checks what the headers say of its results. Returns 0. */
int fuzz_krs_input(const uint8_t *data, size_t size);

/* The functions that take no rays: maps of points and regions, and spt_krs_check(). */
void fuzz_krs_other_calls(const fuzz_krs_case *what);

#endif
