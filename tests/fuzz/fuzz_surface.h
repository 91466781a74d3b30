/* SPDX-License-Identifier: MIT
 *
 * The harness for surface.h and for volumes, which libFuzzer drives and the unit run as well. Rays,
 * settings and fields are those of fuzz.h; calls and what their results must satisfy are those of
 * surface_calls.h and surface_results.h. */
#ifndef TESTS_FUZZ_SURFACE_H
#define TESTS_FUZZ_SURFACE_H

#include "fuzz.h"

#include "stress/surface_calls.h"

enum { fuzz_surface_most = 40, fuzz_surface_planes = 6 };

/* Whether a call must be accepted. */
typedef enum fuzz_legal {
    FUZZ_REFUSED,
    FUZZ_LEGAL,
    FUZZ_EITHER /* numbers at the ends of the range that bound.h documents */
} fuzz_legal;

/* A field with a volume of any kind around it. */
typedef struct fuzz_volume_part {
    fuzz_field distance; /* its points and faults are counted here */
    uint32_t answer;     /* of the callback for intervals */
    uint64_t intervals;  /* rays that it was asked about, with padding */
    spt_bound bound;
    spt_bound_plane planes[fuzz_surface_planes];
} fuzz_volume_part;

typedef struct fuzz_surface_case {
    fuzz_volume_part parts[surface_most_fields];
    spt_field fields[surface_most_fields];
    spt_settings settings;
    surface_call call; /* of the arrays below */
    uint32_t in[surface_inputs][fuzz_surface_most];
    uint32_t out[surface_outputs][fuzz_surface_most * surface_most_crossings];
    uint32_t before[surface_outputs][fuzz_surface_most * surface_most_crossings];
    uint32_t seed;   /* for spt_field_check() */
    int other_calls; /* bounds, check and level set are tried as well */
} fuzz_surface_case;

/* Fills the case, whose address stays in it. Its outputs hold hits where the call reads them. */
void fuzz_surface_read(fuzz_surface_case *what, const uint8_t *data, size_t size);

float fuzz_surface_value(const void *parts, size_t field, float x, float y, float z);
/* The largest coordinate of the volumes, which counts in tolerances. */
double fuzz_surface_size(const fuzz_surface_case *what);

uint64_t fuzz_surface_points(const fuzz_surface_case *what);
uint64_t fuzz_surface_faults(const fuzz_surface_case *what);
void fuzz_surface_clear(fuzz_surface_case *what);

fuzz_legal fuzz_bound_legal(const spt_bound *bound);
/* A field with a volume or without one. */
fuzz_legal fuzz_field_legal(const spt_field *field);
int fuzz_settings_legal(const spt_settings *settings);
fuzz_legal fuzz_surface_legal(const fuzz_surface_case *what);

/* Reads any bytes as a call, makes it and checks what surface.h says of its results. Returns 0. */
int fuzz_surface_input(const uint8_t *data, size_t size);

#endif
