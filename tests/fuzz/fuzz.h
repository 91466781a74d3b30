/* SPDX-License-Identifier: MIT
 *
 * The harness that libFuzzer drives and that the unit run drives as well. */
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include <spheretrace/bound.h>
#include <spheretrace/trace.h>

#include <stddef.h>
#include <stdint.h>

/* Reads any bytes as rays, settings and a field, traces them and checks what trace.h says of every
 * result. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Receives each condition that does not hold; NULL, as at first: abort. */
typedef void fuzz_failed_fn(const char *condition, const char *file, int line);
extern fuzz_failed_fn *fuzz_failed;

#define FUZZ_CHECK(condition) ((condition) ? (void)0 : fuzz_fail(#condition, __FILE__, __LINE__))
void fuzz_fail(const char *condition, const char *file, int line);

/* ---- What the bytes say -------------------------------------------------------------------- */

enum { fuzz_most_rays = 300, fuzz_kinds = 13 };

typedef struct fuzz_ray {
    float origin[3], direction[3], t_min, t_max, path;
    int32_t active;
} fuzz_ray;

/* A field made of a few numbers, and what its callbacks saw. */
typedef struct fuzz_field {
    uint32_t kind;
    float number[4];
    int point;         /* the callback for one point */
    int scribble;      /* uses its points as scratch */
    uint64_t points;   /* asked for, with padding */
    uint64_t faults;   /* broken promises of field.h */
    float first_value; /* of the first point */
} fuzz_field;

typedef struct fuzz_case {
    fuzz_field distance;
    spt_field field;
    spt_bound bound;
    spt_settings settings;
    int hostile; /* numbers may be anything */
    int masked;  /* rays have the column active */
    size_t count;
    fuzz_ray rays[fuzz_most_rays];
} fuzz_case;

/* Fills the case, whose address stays in the field. */
void fuzz_read(fuzz_case *what, const uint8_t *data, size_t size);
float fuzz_value(const fuzz_field *field, float x, float y, float z);

#endif
