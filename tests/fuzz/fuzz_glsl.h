/* SPDX-License-Identifier: MIT
 *
 * The harness for glsl.h, which libFuzzer drives and the unit run as well. */
#ifndef TESTS_FUZZ_GLSL_H
#define TESTS_FUZZ_GLSL_H

#include "fuzz.h"

#include <spheretrace/spheretrace.h>

enum {
    fuzz_glsl_fields = 4,
    fuzz_glsl_levels = 6,
    fuzz_glsl_text = 160, /* longest text of a caller's, with its end */
    fuzz_glsl_name = 80
};

/* Options, and all that they point to. */
typedef struct fuzz_glsl_case {
    int hostile; /* numbers may be anything */
    spt_field fields[fuzz_glsl_fields];
    spt_bound bounds[fuzz_glsl_fields];
    char texts[fuzz_glsl_fields][fuzz_glsl_text];
    char preludes[fuzz_glsl_fields][fuzz_glsl_text];
    spt_kernel kernels[fuzz_glsl_levels + 1];
    spt_mirror mirrors[fuzz_glsl_levels];
    spt_mobius maps[fuzz_glsl_levels];
    spt_krs krs;
    spt_moekrs moekrs;
    spt_conformal conformal;
    spt_distorted distorted;
    spt_level_set level_set;
    spt_field made;
    int32_t materials[fuzz_glsl_fields];
    spt_scene scene;
    spt_settings settings;
    spt_camera camera;
    char name_texts[SPT_GLSL_NAMES][fuzz_glsl_name];
    const char *names[SPT_GLSL_NAMES];
    spt_glsl_options options;
    uint32_t seed;     /* of the points to compare at */
    uint32_t capacity; /* of the buffer, in 1 / 2^16 of the length */
} fuzz_glsl_case;

/* Reads any bytes as a case, whose address stays in it. */
void fuzz_glsl_read(fuzz_glsl_case *what, const uint8_t *data, size_t size);

/* Reads any bytes as options, emits by them and checks what glsl.h says of the text and the status.
 * Returns 0. */
int fuzz_glsl_input(const uint8_t *data, size_t size);

#endif
